// The triangles of a scene in world space, and what a ray meets of them (Embree 3).
#pragma once

#include "scene/scene.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace nacre::trace {

/// A ray in scene units; what it meets lies between `tNear` and `tFar` times its direction's length.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, -1}; ///< any length above 0
    float tNear = 0;
    float tFar = std::numeric_limits<float>::infinity();
};

struct Hit {
    float distance = 0;         ///< in lengths of the ray's direction
    std::uint32_t instance = 0; ///< index into Scene::instances
    std::uint32_t triangle = 0; ///< of the instance's mesh
    float u = 0;                ///< barycentric coordinate of the second corner
    float v = 0;                ///< and of the third
};

/// Where on a surface, and which way it faces.
struct Place {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0}; ///< of the triangle, unit, towards the side from which it is counter-clockwise
};

/// A point of a surface as the renderer shades it.
struct SurfacePoint : Place {
    glm::vec3 vertexNormal{0, 1, 0};  ///< interpolated
    glm::vec3 shadingNormal{0, 1, 0}; ///< with the normal map
    /// From here shadow rays start. The position, moved to the curved surface that the vertex normals tell of, so that
    /// facets do not shade their neighbours (Hanika 2021, "Hacking the shadow terminator", Ray Tracing Gems II).
    glm::vec3 shadowOrigin{0};
    glm::vec3 albedo{0};                        ///< diffuse: base colour · (1 − metallic)
    float scale = 1;                            ///< of the material's lengths: Surface::scale with its texture
    float shareFactor = 1;                      ///< on the share of the light that comes through
    float strengthFactor = 1;                   ///< on the material's strength
    std::optional<glm::vec3> transmissionColor; ///< of what comes through, where a texture has it
    std::uint32_t material = scene::none;       ///< index into Scene::materials
    bool doubleSided = false;
};

/// Names a set of instances that rays can be sent through alone.
using InstanceSet = std::uint32_t;
inline constexpr InstanceSet allInstances = 0;

/// Everything that rays can meet. Texels below the alpha cut-off of a masked surface are holes. Safe to ask from many
/// threads. The same scene makes the same answers whatever the number of threads.
class Geometry {
public:
    /// `scene` must outlive it. Throws SceneError naming what does not fit together.
    explicit Geometry(const scene::Scene& scene);
    ~Geometry();
    Geometry(Geometry&&) noexcept;

    const scene::Scene& scene() const;

    /// A set of these instances. Not to be called while others ask.
    InstanceSet addSet(std::span<const std::uint32_t> instances);

    /// The nearest surface, from either side.
    std::optional<Hit> closest(const Ray& ray, InstanceSet set = allInstances) const;
    /// The nearest surface as a camera sees it: back faces of single-sided surfaces are not there.
    std::optional<Hit> visible(const Ray& ray) const;
    /// Whether anything lies in the ray's way, from either side.
    bool occluded(const Ray& ray, InstanceSet set = allInstances) const;

    Place placeOf(const Hit& hit) const;
    SurfacePoint surfaceAt(const Hit& hit) const;

    /// The three corners in world space.
    std::array<glm::vec3, 3> corners(std::uint32_t instance, std::uint32_t triangle) const;

    /// `point` moved off its surface along `normal`, far enough that a ray from there does not meet it again and too
    /// little for light to notice: eight steps of a float at its coordinates, or at an eighth of the scene's largest.
    glm::vec3 movedOff(const glm::vec3& point, const glm::vec3& normal) const;

    /// Edges that do not have one triangle on either side, vertices at one position taken for one. 0: the instances
    /// of the set close off a volume.
    std::uint64_t openEdges(InstanceSet set) const;

    const scene::Bounds& bounds(InstanceSet set = allInstances) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::trace
