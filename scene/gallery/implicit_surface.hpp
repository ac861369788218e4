// Bodies as signed distance: shapes are added to, carved from and embossed on one another with smooth joints, and the
// zero level becomes a closed mesh. Lengths in mm.
#pragma once

#include "scene/gallery/solid.hpp"
#include "scene/scene.hpp"

namespace nacre::scene::gallery {

/// Signed distance in mm, negative inside. A bound or an estimate will do; near its surface it should grow like one.
using Distance = std::function<float(const glm::vec3&)>;

/// An ordered list of shapes, each combined with what came before it.
class ImplicitSurface {
public:
    /// Joins a shape that lies within `bounds`; the joint is rounded over `blend` [≥ 0] mm (smoothMinimum).
    void add(Bounds bounds, float blend, Distance shape) { combine(Combination::Add, bounds, blend, std::move(shape)); }
    /// Removes a shape, the edge rounded over `blend` mm.
    void carve(Bounds bounds, float blend, Distance shape) {
        combine(Combination::Carve, bounds, blend, std::move(shape));
    }
    /// Raises the surface by `height(p)` mm, which must vanish at the border of `bounds`.
    void emboss(Bounds bounds, Distance height) { combine(Combination::Emboss, bounds, 0, std::move(height)); }

    /// Signed distance of the whole.
    float value(const glm::vec3& p) const;
    /// Unit normal from central differences on a regular tetrahedron of size `step` mm.
    glm::vec3 normal(const glm::vec3& p, float step) const;
    /// The point moved along the gradient onto the surface (three Newton steps).
    glm::vec3 project(glm::vec3 p) const;

    /// Marching tetrahedra on a grid of `cell` mm (six tetrahedra about each cube's diagonal, which fit from cube to
    /// cube, so the mesh is closed and manifold whatever the values), every vertex moved along its grid edge onto the
    /// surface. Only 4³ blocks near the surface are evaluated.
    Solid polygonise(float cell) const;

private:
    enum class Combination { Add, Carve, Emboss };
    struct Term {
        Combination combination;
        Bounds bounds;
        Bounds reach; ///< the bounds and a margin: outside of it the term has no effect near the surface
        float margin;
        float blend;
        Distance shape;
    };

    void combine(Combination combination, Bounds bounds, float blend, Distance shape);
    float valueOf(const glm::vec3& p, const std::uint32_t* begin, const std::uint32_t* end) const;

    std::vector<Term> terms_;
    std::vector<std::uint32_t> all_;

    friend class Polygoniser;
};

} // namespace nacre::scene::gallery
