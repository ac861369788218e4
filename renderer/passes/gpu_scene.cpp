#include "renderer/passes/gpu_scene.hpp"

#include "renderer/vulkan/transfer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace nacre::renderer {
namespace {

/// What a vertex has besides its position, which shadow maps need alone.
struct VertexAttributes {
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv;
    glm::vec<4, std::uint16_t> color;
    glm::vec2 secondUv;
};

using scene::TextureSlot;
using scene::textureSlots;

constexpr bool isSlot(std::uint32_t slot, std::uint32_t scene::Surface::*texture) {
    return textureSlots[slot].texture == texture;
}
static_assert(textureSlots.size() == shared::textureSlotCount &&
              isSlot(shared::baseColorSlot, &scene::Surface::baseColorTexture) &&
              isSlot(shared::normalSlot, &scene::Surface::normalTexture) &&
              isSlot(shared::metallicRoughnessSlot, &scene::Surface::metallicRoughnessTexture) &&
              isSlot(shared::thicknessSlot, &scene::Surface::thicknessTexture) &&
              isSlot(shared::emissionSlot, &scene::Surface::emissionTexture) &&
              isSlot(shared::scaleSlot, &scene::Surface::scaleTexture) &&
              isSlot(shared::transmissionSlot, &scene::Surface::transmissionTexture) &&
              isSlot(shared::transmissionColorSlot, &scene::Surface::transmissionColorTexture));

/// An authored thickness of 0 mm is still authored; the effect reads 0 as "none".
constexpr float smallestThickness = 1e-3f;

void check(const scene::Scene& scene, const scene::Mesh& mesh) {
    if (mesh.surface >= scene.surfaces.size()) {
        throw RendererError("the mesh '" + mesh.name + "' has surface " + std::to_string(mesh.surface) +
                            ", but the scene has " + std::to_string(scene.surfaces.size()));
    }
    const bool inside = std::all_of(mesh.indices.begin(), mesh.indices.end(),
                                    [&](std::uint32_t index) { return index < mesh.vertices.size(); });
    if (!inside || mesh.indices.size() % 3 != 0) {
        throw RendererError("the mesh '" + mesh.name + "' has indices that do not make triangles of its " +
                            std::to_string(mesh.vertices.size()) + " vertices");
    }
}

void checkMaterial(const scene::Surface& surface, std::size_t materialCount) {
    if (surface.material != scene::none && surface.material >= materialCount) {
        throw RendererError("the surface '" + surface.name + "' has material " + std::to_string(surface.material) +
                            ", but the scene has " + std::to_string(materialCount));
    }
}

void check(const scene::Scene& scene, const scene::Surface& surface) {
    for (const TextureSlot& slot : textureSlots) {
        const std::uint32_t texture = surface.*slot.texture;
        if (texture != scene::none && texture >= scene.textures.size()) {
            throw RendererError("the surface '" + surface.name + "' has texture " + std::to_string(texture) +
                                ", but the scene has " + std::to_string(scene.textures.size()));
        }
    }
    checkMaterial(surface, scene.materials.size());
}

/// Whether the two are drawn alike but for their constants.
bool drawnAlike(const scene::Surface& a, const scene::Surface& b) {
    return a.alphaMode == b.alphaMode && a.doubleSided == b.doubleSided &&
           std::ranges::all_of(textureSlots,
                               [&](const TextureSlot& slot) { return a.*slot.texture == b.*slot.texture; });
}

/// Whether the two have the same holes.
bool masksAlike(const scene::Surface& a, const scene::Surface& b) {
    return a.alphaMode == scene::AlphaMode::Opaque ||
           (a.baseColor.a == b.baseColor.a && a.alphaCutoff == b.alphaCutoff && a.baseColorUv == b.baseColorUv);
}

std::uint32_t makeFlags(const scene::Surface& surface) {
    std::uint32_t flags = surface.doubleSided ? shared::isDoubleSided : 0u;
    for (std::size_t slot = 0; slot < textureSlots.size(); ++slot) {
        flags |= surface.*textureSlots[slot].texture == scene::none ? 0u : 1u << slot;
    }
    return flags;
}

shared::SurfaceConstants makeSurfaceConstants(const scene::Surface& surface) {
    const float thickness = surface.thickness < 0 ? 0.0f : std::max(surface.thickness, smallestThickness);
    const float cutoff =
        surface.alphaMode == scene::AlphaMode::Blend ? scene::blendedShadowCutoff : surface.alphaCutoff;
    shared::SurfaceConstants result{.baseColor = surface.baseColor,
                                    .emission = {surface.emission, surface.normalScale},
                                    .parameters = {surface.metallic, surface.roughness, surface.specular, cutoff},
                                    .lengths = {thickness, surface.scale, surface.transmissionSetsStrength ? 1 : 0, 0},
                                    .uvTransformU = {},
                                    .uvTransformV = {},
                                    .material = {surface.material == scene::none ? 0u : surface.material + 1, 0, 0, 0}};
    for (std::size_t slot = 0; slot < textureSlots.size(); ++slot) {
        const scene::TextureCoordinates& coordinates = surface.*textureSlots[slot].coordinates;
        const glm::mat3 rows = glm::transpose(coordinates.transform);
        result.uvTransformU[slot] = {rows[0], coordinates.second ? 1 : 0};
        result.uvTransformV[slot] = {rows[1], 0};
    }
    return result;
}

template <typename T> std::span<const std::byte> bytes(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

vk::SamplerAddressMode addressMode(scene::Wrap wrap) {
    using Mode = vk::SamplerAddressMode;
    constexpr std::array modes{Mode::eRepeat, Mode::eMirroredRepeat, Mode::eClampToEdge};
    return modes[static_cast<std::size_t>(wrap)];
}

vk::raii::Sampler makeTextureSampler(const Gpu& gpu, const scene::Texture& texture) {
    return {gpu.device,
            {.magFilter = texture.nearest ? vk::Filter::eNearest : vk::Filter::eLinear,
             .minFilter = vk::Filter::eLinear,
             .mipmapMode = vk::SamplerMipmapMode::eLinear,
             .addressModeU = addressMode(texture.wrapU),
             .addressModeV = addressMode(texture.wrapV),
             .addressModeW = addressMode(texture.wrapV),
             .anisotropyEnable = gpu.anisotropic,
             .maxAnisotropy = gpu.anisotropic ? std::min(8.0f, gpu.limits.maxSamplerAnisotropy) : 1.0f,
             .maxLod = VK_LOD_CLAMP_NONE}};
}

} // namespace

GpuScene::GpuScene(Gpu& gpu, const scene::Scene& scene, std::uint32_t framesInFlight)
    : materialCount_(scene.materials.size()), surfaces_(scene.surfaces) {
    std::for_each(scene.meshes.begin(), scene.meshes.end(), [&](const auto& mesh) { check(scene, mesh); });
    std::for_each(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& surface) { check(scene, surface); });
    uploadGeometry(gpu, scene);
    uploadTextures(gpu, scene);
    uploadSurfaces(gpu, scene, framesInFlight);
}

void GpuScene::uploadGeometry(Gpu& gpu, const scene::Scene& scene) {
    std::vector<glm::vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<std::uint32_t> indices;
    std::vector<Draw> meshDraws;
    for (const scene::Mesh& mesh : scene.meshes) {
        const scene::Surface& surface = scene.surfaces[mesh.surface];
        meshDraws.push_back({.firstIndex = static_cast<std::uint32_t>(indices.size()),
                             .indexCount = static_cast<std::uint32_t>(mesh.indices.size()),
                             .vertexOffset = static_cast<std::int32_t>(positions.size()),
                             .surface = mesh.surface,
                             .flags = makeFlags(surface),
                             .doubleSided = surface.doubleSided,
                             .alphaMode = surface.alphaMode});
        for (const scene::Vertex& vertex : mesh.vertices) {
            positions.push_back(vertex.position);
            attributes.push_back({vertex.normal, vertex.tangent, vertex.uv, vertex.color, vertex.secondUv});
        }
        indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    for (const scene::Instance& instance : scene.instances) {
        Draw draw = meshDraws.at(instance.mesh);
        draw.worldFromObject = instance.transform;
        draw.mirrored = glm::determinant(glm::mat3(instance.transform)) < 0;
        draws_.push_back(draw);
    }
    // Fewest pipeline changes.
    std::ranges::stable_sort(draws_, {}, &Draw::alphaMode);
    using Kind = vk::BufferUsageFlagBits;
    positions_ = uploadBuffer(gpu, "vertex positions", bytes(positions), Kind::eVertexBuffer);
    attributes_ = uploadBuffer(gpu, "vertex attributes", bytes(attributes), Kind::eVertexBuffer);
    indices_ = uploadBuffer(gpu, "indices", bytes(indices), Kind::eIndexBuffer);
}

void GpuScene::uploadTextures(Gpu& gpu, const scene::Scene& scene) {
    const scene::Texture white{
        .name = "white", .width = 1, .height = 1, .pixels = std::vector<std::uint8_t>(4, std::uint8_t{255})};
    const auto upload = [&](const scene::Texture& texture) {
        if (texture.width == 0 || texture.pixels.size() != std::size_t{texture.width} * texture.height * 4) {
            throw RendererError("the texture '" + texture.name + "' has " + std::to_string(texture.pixels.size()) +
                                " bytes for its " + std::to_string(texture.width) + "x" +
                                std::to_string(texture.height) + " pixels");
        }
        using Kind = vk::ImageUsageFlagBits;
        textures_.emplace_back(
            gpu, ImageInfo{.name = "texture '" + texture.name + "'",
                           .format = texture.srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                           .extent = {texture.width, texture.height},
                           .usage = Kind::eSampled | Kind::eTransferSrc | Kind::eTransferDst,
                           .mipLevels =
                               static_cast<std::uint32_t>(std::bit_width(std::max(texture.width, texture.height)))});
        uploadImage(gpu, textures_.back(), bytes(texture.pixels), usage::fragmentRead);
        const std::tuple kind(texture.wrapU, texture.wrapV, texture.nearest);
        auto sampler = samplers_.find(kind);
        if (sampler == samplers_.end()) {
            sampler = samplers_.emplace(kind, makeTextureSampler(gpu, texture)).first;
        }
        textureSamplers_.push_back(&sampler->second);
    };
    std::for_each(scene.textures.begin(), scene.textures.end(), upload);
    upload(white);
}

void GpuScene::setSurfaces(std::span<const scene::Surface> surfaces) {
    if (surfaces.size() != surfaces_.size()) {
        throw RendererError("the scene has " + std::to_string(surfaces_.size()) + " surfaces and cannot get " +
                            std::to_string(surfaces.size()));
    }
    bool sameHoles = true;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (!drawnAlike(surfaces[i], surfaces_[i])) {
            throw RendererError("the surface '" + surfaces[i].name +
                                "' cannot get other textures, another alphaMode or another doubleSided");
        }
        checkMaterial(surfaces[i], materialCount_);
        sameHoles = sameHoles && masksAlike(surfaces[i], surfaces_[i]);
    }
    surfaces_.assign(surfaces.begin(), surfaces.end());
    std::transform(surfaces_.begin(), surfaces_.end(), surfaceConstants_.begin(), makeSurfaceConstants);
    casterVersion_ += sameHoles ? 0 : 1;
}

void GpuScene::uploadSurfaces(Gpu& gpu, const scene::Scene& scene, std::uint32_t framesInFlight) {
    std::transform(surfaces_.begin(), surfaces_.end(), std::back_inserter(surfaceConstants_), makeSurfaceConstants);
    const std::uint32_t count = std::max<std::uint32_t>(static_cast<std::uint32_t>(scene.surfaces.size()), 1);
    constants_ = FrameBuffer(gpu, "surfaces", count * sizeof(shared::SurfaceConstants),
                             vk::BufferUsageFlagBits::eStorageBuffer, framesInFlight);
    const std::vector types(textureSlots.size(), vk::DescriptorType::eCombinedImageSampler);
    textureSetLayout_ = makeSetLayout(gpu, types, vk::ShaderStageFlagBits::eFragment);
    texturePool_ = makePool(gpu, types, count);
    const auto binding = [&](std::uint32_t texture) {
        const std::size_t place = texture == scene::none ? textures_.size() - 1 : texture;
        return sampled(textures_[place], *textureSamplers_[place]);
    };
    for (const scene::Surface& surface : scene.surfaces) {
        textureSets_.push_back(makeSet(gpu, texturePool_, textureSetLayout_));
        std::vector<Binding> bindings;
        for (const TextureSlot& slot : textureSlots) {
            bindings.push_back(binding(surface.*slot.texture));
        }
        writeSet(gpu, textureSets_.back(), bindings);
    }
}

std::vector<vk::VertexInputBindingDescription> GpuScene::vertexBindings() {
    return {{.binding = 0, .stride = sizeof(glm::vec3)}, {.binding = 1, .stride = sizeof(VertexAttributes)}};
}

std::vector<vk::VertexInputAttributeDescription> GpuScene::vertexAttributes() {
    return {
        {.location = 0, .binding = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = 0},
        {.location = 1, .binding = 1, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(VertexAttributes, uv)},
        {.location = 2,
         .binding = 1,
         .format = vk::Format::eR32G32B32Sfloat,
         .offset = offsetof(VertexAttributes, normal)},
        {.location = 3,
         .binding = 1,
         .format = vk::Format::eR32G32B32A32Sfloat,
         .offset = offsetof(VertexAttributes, tangent)},
        {.location = 4,
         .binding = 1,
         .format = vk::Format::eR16G16B16A16Unorm,
         .offset = offsetof(VertexAttributes, color)},
        {.location = 5,
         .binding = 1,
         .format = vk::Format::eR32G32Sfloat,
         .offset = offsetof(VertexAttributes, secondUv)}};
}

bool GpuScene::hasThickness() const {
    return std::ranges::any_of(surfaces_, [](const scene::Surface& surface) {
        return surface.material != scene::none && surface.thickness >= 0;
    });
}

bool GpuScene::hasScale() const {
    return std::ranges::any_of(surfaces_, [](const scene::Surface& surface) {
        return surface.material != scene::none && (surface.scale != 1 || surface.scaleTexture != scene::none);
    });
}

bool GpuScene::hasStrength() const {
    return std::ranges::any_of(surfaces_, [](const scene::Surface& surface) {
        return surface.material != scene::none && surface.transmissionSetsStrength &&
               surface.transmissionTexture != scene::none;
    });
}

bool GpuScene::hasTextures(std::uint32_t scene::Surface::*texture) const {
    return std::ranges::any_of(surfaces_,
                               [&](const scene::Surface& surface) { return surface.*texture != scene::none; });
}

void GpuScene::recordDraws(const vk::raii::CommandBuffer& commandBuffer, vk::PipelineLayout layout,
                           const Pipelines& pipelines, std::uint32_t passConstant, Cull cull) const {
    commandBuffer.bindVertexBuffers(0, {positions_.handle(), attributes_.handle()}, {0, 0});
    commandBuffer.bindIndexBuffer(indices_.handle(), 0, vk::IndexType::eUint32);
    vk::Pipeline bound;
    const std::array byMode{pipelines.opaque, pipelines.masked, pipelines.blended};
    for (const Draw& draw : draws_) {
        const vk::Pipeline pipeline = byMode[static_cast<std::size_t>(draw.alphaMode)];
        if (!pipeline) {
            continue;
        }
        if (pipeline != bound) {
            commandBuffer.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline);
            bound = pipeline;
        }
        const bool all = cull == Cull::Nothing || draw.doubleSided;
        commandBuffer.setCullMode(all ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
        commandBuffer.setFrontFace(draw.mirrored ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
        commandBuffer.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 1, *textureSets_[draw.surface], {});
        const shared::DrawConstants constants{
            .worldFromObject = draw.worldFromObject,
            .index = {draw.surface, passConstant, draw.mirrored ? 1u : 0u, draw.flags}};
        commandBuffer.pushConstants<shared::DrawConstants>(
            layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, constants);
        commandBuffer.drawIndexed(draw.indexCount, 1, draw.firstIndex, draw.vertexOffset, 0);
    }
}

} // namespace nacre::renderer
