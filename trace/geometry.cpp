#include "trace/geometry.hpp"

#include "trace/texture_lookup.hpp"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <unordered_map>

namespace nacre::trace {

using scene::SceneError;

struct ReleaseDevice {
    void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometryTy* geometry) const { rtcReleaseGeometry(geometry); }
};

namespace {

void requireConsistent(const scene::Scene& scene) {
    for (const scene::Instance& instance : scene.instances) {
        if (instance.mesh >= scene.meshes.size()) {
            throw SceneError("the instance '" + instance.name + "' has mesh " + std::to_string(instance.mesh) +
                             ", but the scene has " + std::to_string(scene.meshes.size()));
        }
    }
    for (const scene::Mesh& mesh : scene.meshes) {
        const bool inside = std::ranges::all_of(mesh.indices, [&](auto index) { return index < mesh.vertices.size(); });
        if (!inside || mesh.indices.size() % 3 != 0 || mesh.surface >= scene.surfaces.size()) {
            throw SceneError("the mesh '" + mesh.name + "' has indices that do not make triangles, or surface " +
                             std::to_string(mesh.surface) + " of " + std::to_string(scene.surfaces.size()));
        }
    }
    for (const scene::Surface& surface : scene.surfaces) {
        for (const scene::TextureSlot& slot : scene::textureSlots) {
            const std::uint32_t texture = surface.*slot.texture;
            if (texture != scene::none &&
                (texture >= scene.textures.size() ||
                 scene.textures[texture].pixels.size() !=
                     std::size_t{scene.textures[texture].width} * scene.textures[texture].height * 4 ||
                 scene.textures[texture].pixels.empty())) {
                throw SceneError("the surface '" + surface.name + "' has texture " + std::to_string(texture) +
                                 ", which the scene lacks or which lacks pixels");
            }
        }
        if (surface.material != scene::none && surface.material >= scene.materials.size()) {
            throw SceneError("the surface '" + surface.name + "' has material " + std::to_string(surface.material) +
                             ", but the scene has " + std::to_string(scene.materials.size()));
        }
    }
}

glm::vec3 normalizedOr(const glm::vec3& vector, const glm::vec3& other) {
    const float length = glm::length(vector);
    return length > 0 && std::isfinite(length) ? vector / length : other;
}

} // namespace

/// One instance in world space.
struct TracedInstance {
    const scene::Mesh* mesh = nullptr;
    const scene::Surface* surface = nullptr;
    std::vector<glm::vec3> positions; ///< one more than there are, which Embree may read
    glm::mat3 linear{1};
    glm::mat3 cofactors{1}; ///< carries normals
    float side = 1;         ///< −1 when the transform mirrors
    std::unique_ptr<RTCGeometryTy, ReleaseGeometry> geometry;

    std::array<std::uint32_t, 3> vertices(std::uint32_t triangle) const {
        const std::uint32_t* first = &mesh->indices[std::size_t{triangle} * 3];
        return {first[0], first[1], first[2]};
    }
};

/// What the filter of a masked surface needs.
struct Masked {
    const scene::Scene* scene = nullptr;
    const TracedInstance* instance = nullptr;
};

namespace {

/// A value between those of a triangle's corners.
template <typename Value> Value between(const std::array<Value, 3>& values, float u, float v) {
    return (1 - u - v) * values[0] + u * values[1] + v * values[2];
}

/// Before textures.
glm::vec4 baseColorAt(const TracedInstance& instance, std::uint32_t triangle, float u, float v) {
    const auto [a, b, c] = instance.vertices(triangle);
    const std::vector<scene::Vertex>& vertices = instance.mesh->vertices;
    const std::array colors{glm::vec4(vertices[a].color), glm::vec4(vertices[b].color), glm::vec4(vertices[c].color)};
    return instance.surface->baseColor * between(colors, u, v) / 65535.0f;
}

glm::vec2 textureCoordinates(const TracedInstance& instance, const scene::TextureCoordinates& coordinates,
                             std::uint32_t triangle, float u, float v) {
    const auto [a, b, c] = instance.vertices(triangle);
    const std::vector<scene::Vertex>& vertices = instance.mesh->vertices;
    const std::array corners{coordinates.of(vertices[a]), coordinates.of(vertices[b]), coordinates.of(vertices[c])};
    return glm::vec2(coordinates.transform * glm::vec3(between(corners, u, v), 1));
}

/// Alpha below which rays meet nothing. Of blended surfaces it is that of the renderer's shadow maps.
float cutoffOf(const scene::Surface& surface) {
    return surface.alphaMode == scene::AlphaMode::Blend ? scene::blendedShadowCutoff : surface.alphaCutoff;
}

/// Embree asks it of every hit on a masked surface.
void rejectHoles(const RTCFilterFunctionNArguments* arguments) {
    const Masked& masked = *static_cast<const Masked*>(arguments->geometryUserPtr);
    const scene::Surface& surface = *masked.instance->surface;
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, i);
        const float u = RTCHitN_u(arguments->hit, arguments->N, i);
        const float v = RTCHitN_v(arguments->hit, arguments->N, i);
        float alpha = baseColorAt(*masked.instance, triangle, u, v).a;
        if (surface.baseColorTexture != scene::none) {
            const glm::vec2 uv = textureCoordinates(*masked.instance, surface.baseColorUv, triangle, u, v);
            alpha *= sampleTexture(masked.scene->textures[surface.baseColorTexture], uv).a;
        }
        if (alpha < cutoffOf(surface)) {
            arguments->valid[i] = 0;
        }
    }
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.tnear = ray.tNear;
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = ray.tFar;
    result.mask = 0xffffffffU;
    return result;
}

} // namespace

struct Geometry::Implementation {
    const scene::Scene* scene = nullptr;
    std::unique_ptr<RTCDeviceTy, ReleaseDevice> device;
    std::vector<TracedInstance> instances;
    std::vector<Masked> masked;
    struct Set {
        std::unique_ptr<RTCSceneTy, ReleaseScene> scene;
        std::vector<std::uint32_t> instances;
        scene::Bounds bounds;
    };
    std::vector<Set> sets;
    float reach = 0; ///< largest coordinate

    void addInstance(const scene::Instance& instance);
    void attach(TracedInstance& instance, Masked& mask);
};

void Geometry::Implementation::addInstance(const scene::Instance& instance) {
    TracedInstance traced;
    traced.mesh = &scene->meshes[instance.mesh];
    traced.surface = &scene->surfaces[traced.mesh->surface];
    traced.linear = glm::mat3(instance.transform);
    const glm::mat3& m = traced.linear;
    traced.cofactors = glm::mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    traced.side = glm::determinant(m) < 0 ? -1.0f : 1.0f;
    traced.positions.reserve(traced.mesh->vertices.size() + 1);
    for (const scene::Vertex& vertex : traced.mesh->vertices) {
        traced.positions.emplace_back(instance.transform * glm::vec4(vertex.position, 1));
    }
    traced.positions.emplace_back(0);
    instances.push_back(std::move(traced));
}

void Geometry::Implementation::attach(TracedInstance& instance, Masked& mask) {
    instance.geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    RTCGeometry geometry = instance.geometry.get();
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, instance.positions.data(), 0,
                               sizeof(glm::vec3), instance.positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, instance.mesh->indices.data(), 0,
                               3 * sizeof(std::uint32_t), instance.mesh->indices.size() / 3);
    if (instance.surface->alphaMode != scene::AlphaMode::Opaque) {
        mask = {scene, &instance};
        rtcSetGeometryUserData(geometry, &mask);
        rtcSetGeometryIntersectFilterFunction(geometry, rejectHoles);
        rtcSetGeometryOccludedFilterFunction(geometry, rejectHoles);
    }
    rtcCommitGeometry(geometry);
}

Geometry::Geometry(const scene::Scene& scene) : implementation_(std::make_unique<Implementation>()) {
    requireConsistent(scene);
    implementation_->scene = &scene;
    implementation_->device.reset(rtcNewDevice(nullptr));
    if (!implementation_->device) {
        throw std::runtime_error("Embree cannot be started");
    }
    for (const scene::Instance& instance : scene.instances) {
        implementation_->addInstance(instance);
    }
    implementation_->masked.resize(implementation_->instances.size());
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < implementation_->instances.size(); ++i) {
        implementation_->attach(implementation_->instances[i], implementation_->masked[i]);
        all.push_back(static_cast<std::uint32_t>(i));
    }
    addSet(all);
    const scene::Bounds& box = bounds();
    const glm::vec3 reach = glm::max(glm::abs(box.low), glm::abs(box.high));
    implementation_->reach = std::max({reach.x, reach.y, reach.z});
}

Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;

const scene::Scene& Geometry::scene() const {
    return *implementation_->scene;
}

InstanceSet Geometry::addSet(std::span<const std::uint32_t> instances) {
    Implementation::Set set;
    set.scene.reset(rtcNewScene(implementation_->device.get()));
    rtcSetSceneFlags(set.scene.get(), RTC_SCENE_FLAG_ROBUST);
    set.instances.assign(instances.begin(), instances.end());
    for (const std::uint32_t index : instances) {
        const TracedInstance& instance = implementation_->instances.at(index);
        if (!instance.mesh->indices.empty()) {
            rtcAttachGeometryByID(set.scene.get(), instance.geometry.get(), index);
        }
        for (std::size_t i = 0; i + 1 < instance.positions.size(); ++i) {
            set.bounds.low = glm::min(set.bounds.low, instance.positions[i]);
            set.bounds.high = glm::max(set.bounds.high, instance.positions[i]);
        }
    }
    // One thread builds, so that the tree, and with it the choice between two triangles at one distance, does not
    // depend on how many there are.
    tbb::task_arena(1).execute([&] { rtcJoinCommitScene(set.scene.get()); });
    if (const RTCError error = rtcGetDeviceError(implementation_->device.get()); error != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree cannot take in the scene (error " + std::to_string(error) + ")");
    }
    implementation_->sets.push_back(std::move(set));
    return static_cast<InstanceSet>(implementation_->sets.size() - 1);
}

std::optional<Hit> Geometry::closest(const Ray& ray, InstanceSet set) const {
    RTCRayHit query{};
    query.ray = toEmbree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(implementation_->sets[set].scene.get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return Hit{query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

std::optional<Hit> Geometry::visible(const Ray& ray) const {
    Ray rest = ray;
    while (const std::optional<Hit> hit = closest(rest)) {
        if (implementation_->instances[hit->instance].surface->doubleSided ||
            glm::dot(placeOf(*hit).normal, ray.direction) < 0) {
            return hit;
        }
        rest.tNear = std::nextafter(hit->distance * (1 + 1e-6f), rest.tFar);
    }
    return std::nullopt;
}

bool Geometry::occluded(const Ray& ray, InstanceSet set) const {
    RTCRay query = toEmbree(ray);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(implementation_->sets[set].scene.get(), &context, &query);
    return query.tfar < 0;
}

std::array<glm::vec3, 3> Geometry::corners(std::uint32_t instance, std::uint32_t triangle) const {
    const TracedInstance& traced = implementation_->instances[instance];
    const auto [a, b, c] = traced.vertices(triangle);
    return {traced.positions[a], traced.positions[b], traced.positions[c]};
}

Place Geometry::placeOf(const Hit& hit) const {
    const auto [a, b, c] = corners(hit.instance, hit.triangle);
    const glm::vec3 normal = glm::cross(b - a, c - a) * implementation_->instances[hit.instance].side;
    return {a + hit.u * (b - a) + hit.v * (c - a), normalizedOr(normal, {0, 1, 0})};
}

SurfacePoint Geometry::surfaceAt(const Hit& hit) const {
    const TracedInstance& instance = implementation_->instances[hit.instance];
    const scene::Surface& surface = *instance.surface;
    const std::vector<scene::Texture>& textures = implementation_->scene->textures;
    SurfacePoint point;
    static_cast<Place&>(point) = placeOf(hit);
    const auto vertices = instance.vertices(hit.triangle);
    const std::array<float, 3> weights{1 - hit.u - hit.v, hit.u, hit.v};
    glm::vec3 normal(0);
    glm::vec3 tangent(0);
    glm::vec3 rise(0);
    float handedness = 0;
    for (int i = 0; i < 3; ++i) {
        const scene::Vertex& vertex = instance.mesh->vertices[vertices[i]];
        const glm::vec3 vertexNormal = normalizedOr(instance.side * (instance.cofactors * vertex.normal), point.normal);
        normal += weights[i] * vertexNormal;
        tangent += weights[i] * (instance.linear * glm::vec3(vertex.tangent));
        handedness += weights[i] * vertex.tangent.w * instance.side;
        const float below = glm::dot(point.position - instance.positions[vertices[i]], vertexNormal);
        rise -= weights[i] * std::min(below, 0.0f) * vertexNormal;
    }
    point.vertexNormal = normalizedOr(normal, point.normal);
    point.shadingNormal = point.vertexNormal;
    point.shadowOrigin = point.position + rise;
    const auto texel = [&](std::uint32_t texture, const scene::TextureCoordinates& coordinates) {
        const glm::vec2 uv = textureCoordinates(instance, coordinates, hit.triangle, hit.u, hit.v);
        return sampleTexture(textures[texture], uv);
    };
    glm::vec4 color = baseColorAt(instance, hit.triangle, hit.u, hit.v);
    if (surface.baseColorTexture != scene::none) {
        color *= texel(surface.baseColorTexture, surface.baseColorUv);
    }
    float metallic = surface.metallic;
    if (surface.metallicRoughnessTexture != scene::none) {
        metallic *= texel(surface.metallicRoughnessTexture, surface.metallicRoughnessUv).b;
    }
    point.albedo = glm::vec3(color) * (1 - metallic);
    tangent -= point.vertexNormal * glm::dot(point.vertexNormal, tangent);
    if (surface.normalTexture != scene::none && glm::length(tangent) >= 1e-12f) {
        tangent = glm::normalize(tangent);
        const glm::vec3 bitangent = glm::cross(point.vertexNormal, tangent) * handedness;
        glm::vec3 detail = glm::vec3(texel(surface.normalTexture, surface.normalUv)) * 2.0f - 1.0f;
        detail.x *= surface.normalScale;
        detail.y *= surface.normalScale;
        point.shadingNormal =
            glm::normalize(tangent * detail.x + bitangent * detail.y + point.vertexNormal * std::max(detail.z, 1e-3f));
    }
    point.scale = surface.scale;
    if (surface.scaleTexture != scene::none) {
        point.scale *= texel(surface.scaleTexture, surface.scaleUv).r;
    }
    point.scale = std::clamp(point.scale, scene::leastScale, scene::largestScale);
    if (surface.transmissionTexture != scene::none) {
        point.shareFactor = texel(surface.transmissionTexture, surface.transmissionUv).a;
        point.strengthFactor = surface.transmissionSetsStrength ? point.shareFactor : 1;
    }
    if (surface.transmissionColorTexture != scene::none) {
        point.transmissionColor = glm::vec3(texel(surface.transmissionColorTexture, surface.transmissionColorUv));
    }
    point.material = surface.material;
    point.doubleSided = surface.doubleSided;
    return point;
}

glm::vec3 Geometry::movedOff(const glm::vec3& point, const glm::vec3& normal) const {
    // Rounding grows with the coordinates; those of a large triangle's corners count even where it is near the origin.
    const glm::vec3 size = glm::abs(point);
    const float scale = std::max({size.x, size.y, size.z, implementation_->reach / 8});
    return point + normal * (8 * std::numeric_limits<float>::epsilon() * scale);
}

const scene::Bounds& Geometry::bounds(InstanceSet set) const {
    return implementation_->sets[set].bounds;
}

namespace {

struct PositionHash {
    std::size_t operator()(const std::array<float, 3>& position) const {
        std::size_t hash = 0;
        for (const float value : position) {
            hash = hash * 0x9E3779B97F4A7C15ULL + std::hash<float>()(value);
        }
        return hash;
    }
};

} // namespace

std::uint64_t Geometry::openEdges(InstanceSet set) const {
    std::unordered_map<std::array<float, 3>, std::uint32_t, PositionHash> numbers;
    std::unordered_map<std::uint64_t, std::int32_t> balance; // of an edge: there less back
    for (const std::uint32_t index : implementation_->sets[set].instances) {
        const TracedInstance& instance = implementation_->instances[index];
        std::vector<std::uint32_t> number(instance.positions.size());
        for (std::size_t i = 0; i + 1 < instance.positions.size(); ++i) {
            const glm::vec3& p = instance.positions[i];
            const std::array<float, 3> key{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; // −0 is 0
            number[i] = numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second;
        }
        for (std::size_t i = 0; i + 2 < instance.mesh->indices.size(); i += 3) {
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t from = number[instance.mesh->indices[i + k]];
                std::uint32_t to = number[instance.mesh->indices[i + (k + 1) % 3]];
                if (from != to) {
                    const std::int32_t direction = (from < to ? 1 : -1) * (instance.side < 0 ? -1 : 1);
                    balance[std::uint64_t{std::min(from, to)} << 32 | std::max(from, to)] += direction;
                }
            }
        }
    }
    return static_cast<std::uint64_t>(
        std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; }));
}

} // namespace nacre::trace
