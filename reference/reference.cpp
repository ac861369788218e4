#include "reference/reference.hpp"

#include "reference/random_walk.hpp"
#include "reference/surface_integral.hpp"
#include "trace/fingerprint.hpp"
#include "trace/view.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace nacre::reference {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double firstSliceSamples = 64;  ///< until it is known what a sample takes
constexpr std::uint32_t passSamples = 16; ///< most samples a pixel between two looks at the noise
constexpr std::uint32_t maxSpp = std::numeric_limits<std::uint32_t>::max() - passSamples;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Where the noise is looked at next after `spp` samples.
std::uint32_t nextLook(std::uint32_t spp) {
    std::uint32_t target = 2;
    while (target <= spp && target < passSamples) {
        target *= 2;
    }
    return spp < passSamples ? target : (spp / passSamples + 1) * passSamples;
}

} // namespace

struct Reference::Implementation {
    const scene::Scene& scene;
    Settings settings;
    std::string cameraPrint;
    trace::Geometry geometry;
    trace::View view;
    EntryLight light;
    std::unique_ptr<Estimator> estimator;
    std::vector<std::string> warnings; ///< of the scene
    Film film;
    std::vector<std::uint32_t> pixels; ///< of this part
    tbb::task_arena arena;

    Implementation(const scene::Scene& referenceScene, const scene::Camera& camera, const Settings& referenceSettings)
        : scene(referenceScene),
          settings(referenceSettings),
          cameraPrint(trace::fingerprintOf(camera)),
          geometry(scene),
          view(camera, settings.width, settings.height),
          light(geometry),
          film(settings.width, settings.height),
          arena(settings.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(settings.threads)) {}

    /// Through a place in a pixel: x and y in [0, 1], from its upper left corner.
    trace::Ray rayWithin(std::uint32_t pixel, double x, double y) const;
    trace::Ray ray(std::uint32_t pixel, std::uint32_t sample) const;
    glm::dvec3 radiance(std::uint32_t pixel, std::uint32_t sample, Incidents& incidents) const;
    void look(std::uint32_t pixel);
    void addSamples(std::uint32_t pixel, std::uint32_t target, Incidents& incidents);
    void addSlice(std::span<const std::uint32_t> slice, std::uint32_t target);
    std::uint32_t completeSpp() const;
};

trace::Ray Reference::Implementation::rayWithin(std::uint32_t pixel, double x, double y) const {
    const std::uint32_t column = pixel % film.width;
    const std::uint32_t row = pixel / film.width;
    return view.ray(column + x, row + y);
}

trace::Ray Reference::Implementation::ray(std::uint32_t pixel, std::uint32_t sample) const {
    const std::uint32_t place = sample % (settings.samples * settings.samples);
    const std::uint32_t column = place % settings.samples;
    const std::uint32_t row = place / settings.samples;
    return rayWithin(pixel, (column + 0.5) / settings.samples, (row + 0.5) / settings.samples);
}

/// What does not depend on samples: where the picture shows a surface, and of which material.
void Reference::Implementation::look(std::uint32_t pixel) {
    const std::uint32_t places = settings.samples * settings.samples;
    std::uint32_t hits = 0;
    for (std::uint32_t place = 0; place < places; ++place) {
        hits += geometry.visible(ray(pixel, place)) ? 1 : 0;
    }
    film.coverage[pixel] = static_cast<float>(hits) / static_cast<float>(places);
    if (const auto hit = geometry.visible(rayWithin(pixel, 0.5, 0.5))) {
        const std::uint32_t material = geometry.surfaceAt(*hit).material;
        film.materials[pixel] = material == scene::none ? 0 : material + 1;
    }
}

glm::dvec3 Reference::Implementation::radiance(std::uint32_t pixel, std::uint32_t sample, Incidents& incidents) const {
    const trace::Ray toScene = ray(pixel, sample);
    const std::optional<trace::Hit> hit = geometry.visible(toScene);
    if (!hit) {
        return glm::dvec3(0);
    }
    const trace::SurfacePoint point = geometry.surfaceAt(*hit);
    const bool seenFromBehind = glm::dot(toScene.direction, point.normal) > 0;
    trace::Random random(settings.seed, pixel, sample);
    if (point.material != scene::none) {
        return estimator->radiance(point, seenFromBehind, random, incidents);
    }
    const trace::Side side = seenFromBehind ? trace::Side::Back : trace::Side::Front;
    return glm::dvec3(point.albedo) * light.irradiance(point, side, random) / std::numbers::pi;
}

void Reference::Implementation::addSamples(std::uint32_t pixel, std::uint32_t target, Incidents& incidents) {
    PixelSum& sum = film.pixels[pixel];
    if (film.coverage[pixel] == 0) {
        sum.count = std::max(sum.count, target);
    }
    while (sum.count < target && !settings.cancel.stop_requested()) {
        sum.add(radiance(pixel, sum.count, incidents));
    }
}

void Reference::Implementation::addSlice(std::span<const std::uint32_t> slice, std::uint32_t target) {
    std::vector<Incidents> incidents(slice.size());
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, slice.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                addSamples(slice[i], target, incidents[i]);
            }
        });
    });
    for (const Incidents& ofPixel : incidents) {
        film.incidents += ofPixel;
    }
}

std::uint32_t Reference::Implementation::completeSpp() const {
    std::uint32_t least = maxSpp;
    for (const std::uint32_t pixel : pixels) {
        least = std::min(least, film.pixels[pixel].count);
    }
    return pixels.empty() ? 0 : least;
}

Reference::Reference(const scene::Scene& scene, const scene::Camera& camera, const Settings& settings)
    : implementation_(std::make_unique<Implementation>(scene, camera, settings)) {
    Implementation& self = *implementation_;
    if (settings.direct) {
        self.light.setRendered(self.view, glm::dvec2(settings.width, settings.height), *settings.direct);
    }
    if (settings.method == Method::Walk) {
        auto walk = std::make_unique<RandomWalk>(self.geometry, self.light, settings.boundary, settings.anisotropy);
        self.warnings = walk->warnings();
        self.estimator = std::move(walk);
    } else {
        self.estimator = std::make_unique<SurfaceIntegral>(self.geometry, self.light, settings.exchange);
    }
    for (std::uint32_t pixel = 0; pixel < self.film.pixels.size() && !settings.cancel.stop_requested(); ++pixel) {
        if (settings.part.has(pixel)) {
            self.pixels.push_back(pixel);
        }
    }
    self.arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, self.pixels.size()), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end() && !settings.cancel.stop_requested(); ++i) {
                self.look(self.pixels[i]);
            }
        });
    });
}

Reference::~Reference() = default;

const Film& Reference::film() const {
    return implementation_->film;
}

void Reference::resume(Film film) {
    if (film.width != implementation_->film.width || film.height != implementation_->film.height) {
        throw std::invalid_argument("the film to go on from has another size");
    }
    implementation_->film = std::move(film);
}

Stopped Reference::run(const Stop& stop, const std::function<bool(const Progress&)>& proceed) {
    Implementation& self = *implementation_;
    const std::uint32_t last = stop.spp.value_or(maxSpp);
    const double secondsBefore = self.film.seconds;
    const Clock::time_point start = Clock::now();
    double sliceSamples = firstSliceSamples;
    double added = 0;
    if (self.settings.cancel.stop_requested()) {
        return Stopped::Interrupted;
    }
    Progress progress;
    progress.spp = self.completeSpp();
    progress.sppNow = progress.spp;
    progress.noise = self.film.noise();
    for (;;) {
        if (stop.noise && progress.spp >= 2 && progress.noise <= *stop.noise) {
            return Stopped::Noise;
        }
        if (progress.spp >= last || self.pixels.empty()) {
            return Stopped::Spp;
        }
        const std::uint32_t target = std::min(nextLook(progress.spp), last);
        for (std::size_t first = 0; first < self.pixels.size();) {
            const Clock::time_point sliceStart = Clock::now();
            const std::uint32_t samples = target - progress.spp; // of each pixel
            const auto count =
                std::min(static_cast<std::size_t>(std::ceil(sliceSamples / samples)), self.pixels.size() - first);
            self.addSlice(std::span(self.pixels).subspan(first, count), target);
            first += count;
            const double seconds = std::max(secondsSince(sliceStart), 1e-6);
            const double drawn = static_cast<double>(count) * samples;
            sliceSamples = std::clamp(drawn * self.settings.sliceSeconds / seconds, firstSliceSamples,
                                      4 * drawn + firstSliceSamples);
            const double sppOfSlice = drawn / static_cast<double>(self.pixels.size());
            added += sppOfSlice;
            progress.sppNow += sppOfSlice;
            progress.seconds = secondsSince(start);
            progress.sppPerSecond = added / progress.seconds;
            self.film.seconds = secondsBefore + progress.seconds;
            if (!proceed(progress) || self.settings.cancel.stop_requested()) {
                return Stopped::Interrupted;
            }
            if (stop.seconds && progress.seconds >= *stop.seconds) {
                return Stopped::Seconds;
            }
        }
        progress.spp = target;
        progress.sppNow = target;
        progress.noise = self.film.noise();
    }
}

trace::Identity Reference::identity() const {
    const Settings& settings = implementation_->settings;
    trace::Identity result{{"method", methodName(settings.method)},
                           {"size", std::to_string(settings.width) + "x" + std::to_string(settings.height)},
                           {"samples", std::to_string(settings.samples)},
                           {"seed", std::to_string(settings.seed)}};
    if (settings.method == Method::Walk) {
        result.emplace_back("boundary", boundaryName(settings.boundary));
        result.emplace_back("anisotropy", std::to_string(settings.anisotropy));
    } else {
        result.emplace_back("exchange", settings.exchange ? "yes" : "no");
    }
    result.emplace_back("direct", settings.direct ? trace::fingerprintOf(*settings.direct) : "traced");
    result.emplace_back("scene", trace::fingerprintOf(implementation_->scene));
    result.emplace_back("camera", implementation_->cameraPrint);
    return result;
}

namespace {

/// "3.1 % of the walks " and the rest; nothing where the share would be 0.0.
void addShare(std::vector<std::string>& sentences, std::uint64_t count, std::uint64_t all, const char* rest) {
    const double percent = all > 0 ? 100 * static_cast<double>(count) / static_cast<double>(all) : 0;
    if (percent >= 0.05) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.1f %% of the walks ", percent);
        sentences.push_back(text.data() + std::string(rest));
    }
}

} // namespace

std::vector<std::string> Reference::warnings() const {
    const Film& film = implementation_->film;
    std::vector<std::string> result = implementation_->warnings;
    const Incidents& incidents = film.incidents;
    addShare(result, incidents.lost, incidents.paths, "left a mesh that is open, and their light is missing");
    addShare(result, incidents.overlapped, incidents.paths, "crossed bodies of one material that overlap");
    addShare(result, incidents.cut, incidents.paths, "took a million steps and were ended, and their light is missing");
    if (std::ranges::none_of(film.materials, [](std::uint32_t material) { return material != 0; })) {
        result.emplace_back("no pixel shows a subsurface material, so that the picture is plain Lambert");
    }
    return result;
}

const char* methodName(Method method) {
    return method == Method::Walk ? "walk" : "surface";
}

const char* boundaryName(Boundary boundary) {
    return boundary == Boundary::Fresnel ? "fresnel" : "matched";
}

} // namespace nacre::reference
