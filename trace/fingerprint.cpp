#include "trace/fingerprint.hpp"

#include <array>
#include <cstddef>
#include <cstdio>

namespace nacre::trace {
namespace {

/// Textures that few scenes have and that references look at.
constexpr std::array rareTextures{
    scene::TextureSlot{&scene::Surface::scaleTexture, &scene::Surface::scaleUv},
    scene::TextureSlot{&scene::Surface::transmissionTexture, &scene::Surface::transmissionUv},
    scene::TextureSlot{&scene::Surface::transmissionColorTexture, &scene::Surface::transmissionColorUv}};

void addSurface(Fingerprint& print, const scene::Surface& surface) {
    print.addValue(surface.baseColor);
    print.addValue(surface.metallic);
    print.addValue(surface.normalScale);
    print.addValue(surface.baseColorTexture);
    print.addValue(surface.normalTexture);
    print.addValue(surface.metallicRoughnessTexture);
    print.addValue(surface.baseColorUv.transform);
    print.addValue(surface.alphaMode != scene::AlphaMode::Opaque);
    print.addValue(surface.alphaCutoff);
    print.addValue(surface.doubleSided);
    print.addValue(surface.material);
    // What few scenes have is added where they have it, so that the others keep the prints they had without it.
    const scene::TextureCoordinates common{.transform = surface.baseColorUv.transform};
    const std::array own{surface.baseColorUv, surface.normalUv, surface.metallicRoughnessUv};
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (own[i] != common) {
            print.addValue(i);
            print.addValue(own[i].transform);
            print.addValue(own[i].second);
        }
    }
    if (surface.alphaMode == scene::AlphaMode::Blend) {
        print.addValue(surface.alphaMode);
    }
    if (surface.scale != 1 || surface.transmissionSetsStrength) {
        print.addValue(surface.scale);
        print.addValue(surface.transmissionSetsStrength);
    }
    for (const scene::TextureSlot& slot : rareTextures) {
        if (surface.*slot.texture != scene::none) {
            print.addValue(&slot - rareTextures.data());
            print.addValue(surface.*slot.texture);
            print.addValue((surface.*slot.coordinates).transform);
            print.addValue((surface.*slot.coordinates).second);
        }
    }
}

void addVertices(Fingerprint& print, const std::vector<scene::Vertex>& vertices) {
    bool second = false;
    print.addValue(vertices.size());
    for (const scene::Vertex& vertex : vertices) {
        print.add(std::as_bytes(std::span(&vertex, 1)).first(offsetof(scene::Vertex, secondUv)));
        second = second || vertex.secondUv != glm::vec2(0);
    }
    for (const scene::Vertex& vertex : vertices) {
        if (second) {
            print.addValue(vertex.secondUv);
        }
    }
}

void addMaterial(Fingerprint& print, const Material& material) {
    print.addValue(material.layers.size());
    for (const Layer& layer : material.layers) {
        print.addValue(layer.weight);
        print.addValue(layer.variance);
    }
    print.addValue(material.meanFreePath.value_or(Rgb{}));
    print.addValue(material.albedoUse);
    print.addValue(material.strength);
    print.addValue(material.specular);
    print.addValue(material.diffuseTransmission);
    print.addValue(material.diffuseTransmissionColor.value_or(Rgb{-1, -1, -1}));
    print.addValue(material.scale);
}

void addLight(Fingerprint& print, const scene::Light& light) {
    print.addValue(light.kind);
    print.addValue(light.color);
    print.addValue(light.intensity);
    print.addValue(light.position);
    print.addValue(light.direction);
    print.addValue(light.range);
    print.addValue(light.innerConeAngle);
    print.addValue(light.outerConeAngle);
    print.addValue(light.castsShadow);
}

void addImage(Fingerprint& print, const nacre::Image& image) {
    print.addValue(image.width);
    print.addValue(image.height);
    print.addAll(image.values);
}

void addEnvironment(Fingerprint& print, const scene::Environment& environment) {
    if (environment.image) {
        addImage(print, *environment.image);
    }
    print.addValue(environment.intensity);
    print.addValue(environment.rotation);
    print.addValue(environment.zenith);
    print.addValue(environment.horizon);
    print.addValue(environment.ground);
}

} // namespace

void Fingerprint::add(std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) {
        value_ = (value_ ^ static_cast<std::uint64_t>(byte)) * 0x100000001B3ULL;
    }
}

std::string Fingerprint::text() const {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(value_));
    return digits.data();
}

std::string fingerprintOf(const scene::Scene& scene) {
    Fingerprint print;
    for (const scene::Mesh& mesh : scene.meshes) {
        addVertices(print, mesh.vertices);
        print.addAll(mesh.indices);
        print.addValue(mesh.surface);
    }
    for (const scene::Texture& texture : scene.textures) {
        print.addValue(texture.width);
        print.addValue(texture.srgb);
        print.addValue(texture.wrapU);
        print.addValue(texture.wrapV);
        print.addValue(texture.nearest);
        print.addAll(texture.pixels);
    }
    for (const scene::Surface& surface : scene.surfaces) {
        addSurface(print, surface);
    }
    for (const scene::Instance& instance : scene.instances) {
        print.addValue(instance.mesh);
        print.addValue(instance.transform);
    }
    for (const Material& material : scene.materials) {
        addMaterial(print, material);
    }
    for (const scene::Light& light : scene.lights) {
        addLight(print, light);
    }
    addEnvironment(print, scene.environment);
    print.addValue(scene.metersPerUnit);
    return print.text();
}

std::string fingerprintOf(const scene::Camera& camera) {
    Fingerprint print;
    print.addValue(camera.position);
    print.addValue(camera.target);
    print.addValue(camera.up);
    print.addValue(camera.projection);
    print.addValue(camera.verticalFieldOfView);
    print.addValue(camera.orthographicHeight);
    print.addValue(camera.offCenter);
    print.addValue(camera.nearPlane);
    print.addValue(camera.farPlane);
    return print.text();
}

std::string fingerprintOf(const nacre::Image& image) {
    Fingerprint print;
    addImage(print, image);
    return print.text();
}

} // namespace nacre::trace
