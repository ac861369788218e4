// A reference picture, sample by sample: camera, method, when to stop. The result depends on the settings alone, not on
// threads, interruptions or how often it was resumed.
//
// The picture is diffuse radiance: what leaves subsurface bodies by the method, albedo / π · irradiance everywhere
// else. Specular reflection, emission and what lies behind everything are black.
#pragma once

#include "reference/film.hpp"
#include "reference/medium.hpp"
#include "scene/scene.hpp"
#include "trace/work_file.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

namespace nacre::reference {

/// How the light of subsurface bodies is computed.
enum class Method {
    Surface, ///< the surface integral of the material's profile, see SurfaceIntegral
    Walk     ///< paths through the material's medium, see RandomWalk
};

struct Settings {
    Method method = Method::Surface;
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    /// [1 … 4] places per axis and pixel through which the camera looks, as `nacre render --samples`; 1 is the pixel's
    /// middle.
    std::uint32_t samples = 1;
    std::uint64_t seed = 1;
    Part part;
    /// Surface: light crosses between bodies of different materials.
    bool exchange = true;
    Boundary boundary = Boundary::Matched; ///< Walk
    double anisotropy = 0;                 ///< Walk: (−1, 1) Henyey and Greenstein's g
    /// Irradiance as a renderer has it, see EntryLight.
    std::optional<nacre::Image> direct;
    unsigned threads = 0; ///< 0 = all cores
    /// [> 0] s, about, of a slice of work. Between slices `run` asks whether to proceed; shorter ones use the cores
    /// less well.
    double sliceSeconds = 0.33;
    /// Ends the constructor and `run` within a sample. What was drawn until then stays in the film.
    std::stop_token cancel;
};

/// When to stop: at what comes first.
struct Stop {
    std::optional<std::uint32_t> spp; ///< [≥ 1] samples of every pixel
    std::optional<double> seconds;    ///< [> 0] of this run
    std::optional<double> noise;      ///< [> 0] Film::noise, looked at after 2, 4, 8, 16, 32, 48, 64 … samples
};

enum class Stopped { Spp, Seconds, Noise, Interrupted };

/// How far it is, told between slices of work (Settings::sliceSeconds).
struct Progress {
    std::uint32_t spp = 0; ///< complete in every pixel
    double sppNow = 0;     ///< with the part of the next ones that is done
    double noise = 0;      ///< after `spp`; infinite below 2
    double seconds = 0;    ///< of this run
    double sppPerSecond = 0;
};

class Reference {
public:
    /// `scene` must outlive it. Throws SceneError or std::invalid_argument naming what is wrong.
    Reference(const scene::Scene& scene, const scene::Camera& camera, const Settings& settings);
    ~Reference();

    const Film& film() const;
    /// Goes on from another run's film, which must have the same identity and part.
    void resume(Film film);

    /// Adds samples until one of the conditions in `stop` holds or `proceed` says false.
    Stopped run(const Stop& stop, const std::function<bool(const Progress&)>& proceed);

    /// What this run shares with those that it can go on from.
    trace::Identity identity() const;
    /// What the user should know about the scene, and about what went wrong on the way; a sentence each.
    std::vector<std::string> warnings() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// The names on the command line and in reports.
const char* methodName(Method method);
const char* boundaryName(Boundary boundary);

} // namespace nacre::reference
