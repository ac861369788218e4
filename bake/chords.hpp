// Straight ways through the inside of a scene's bodies.
#pragma once

#include "bake/thickness_law.hpp"
#include "trace/geometry.hpp"
#include "trace/random.hpp"

#include <optional>

namespace nacre::bake {

/// The bodies with a subsurface material, or all where none has one. Together they are one volume: a way through it
/// ends where it has left every surface that it has entered. Other surfaces are not there. Safe to ask from many
/// threads.
class Chords {
public:
    /// `geometry` must outlive it.
    explicit Chords(trace::Geometry& geometry);

    /// [mm] From a point beneath the surface in a unit direction to where the volume ends. Nothing where the ray flies
    /// away through a gap of an open mesh.
    std::optional<double> length(const glm::vec3& origin, const glm::vec3& direction) const;

    /// Edges that do not have one triangle on either side; 0 when the bodies are closed.
    std::uint64_t openEdges() const { return geometry_.openEdges(set_); }
    /// [mm] The bodies' diagonal, which no chord exceeds.
    double diagonal() const;

    const trace::Geometry& geometry() const { return geometry_; }

private:
    const trace::Geometry& geometry_;
    trace::InstanceSet set_;
    double millimetresPerUnit_;
    float nearest_; ///< scene units
};

/// What the chords from one point of a surface say.
struct LocalThickness {
    double millimetres = 0;    ///< [0 … the law's longest(), or the bodies' diagonal]
    std::uint32_t escaped = 0; ///< rays that flew away through gaps, and count as infinitely long chords
};

/// The local thickness beneath `place` by `samples` [≥ 1] chords: their directions follow the cosine about the inward
/// vertex normal, spread evenly (a Hammersley set, shifted at random by `random`). Those that leave the surface
/// outwards, where its triangle is tilted against the vertex normal, are left out.
LocalThickness localThickness(const Chords& chords, const ThicknessLaw& law, const trace::Hit& place,
                              std::uint32_t samples, trace::Random random);

} // namespace nacre::bake
