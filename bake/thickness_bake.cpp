#include "bake/thickness_bake.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace nacre::bake {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view magic = "nacre bake thickness checkpoint 1\n";
constexpr double sliceSeconds = 0.33;
constexpr std::size_t firstSliceRays = 65536;
constexpr std::size_t leastSlice = 16; ///< places

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

struct ThicknessBake::Implementation {
    std::vector<trace::Hit> places;
    ThicknessLaw law;
    ThicknessSettings settings;
    trace::Geometry geometry;
    Chords chords;
    ThicknessState state;
    tbb::task_arena arena;

    Implementation(const scene::Scene& scene, std::vector<trace::Hit> thicknessPlaces, ThicknessLaw thicknessLaw,
                   const ThicknessSettings& thicknessSettings)
        : places(std::move(thicknessPlaces)),
          law(std::move(thicknessLaw)),
          settings(thicknessSettings),
          geometry(scene),
          chords(geometry),
          arena(settings.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(settings.threads)) {}

    void addSlice(std::size_t count);
};

void ThicknessBake::Implementation::addSlice(std::size_t count) {
    const std::size_t first = state.millimetres.size();
    state.millimetres.resize(first + count);
    std::vector<std::uint32_t> escaped(count);
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const trace::Random random(settings.seed, static_cast<std::uint32_t>(first + i), 0);
                const LocalThickness local = localThickness(chords, law, places[first + i], settings.samples, random);
                state.millimetres[first + i] = static_cast<float>(local.millimetres);
                escaped[i] = local.escaped;
            }
        });
    });
    for (const std::uint32_t rays : escaped) {
        state.escaped += rays;
    }
}

ThicknessBake::ThicknessBake(const scene::Scene& scene, std::vector<trace::Hit> places, ThicknessLaw law,
                             const ThicknessSettings& settings)
    : implementation_(std::make_unique<Implementation>(scene, std::move(places), std::move(law), settings)) {}

ThicknessBake::~ThicknessBake() = default;

const ThicknessState& ThicknessBake::state() const {
    return implementation_->state;
}

std::size_t ThicknessBake::placeCount() const {
    return implementation_->places.size();
}

void ThicknessBake::resume(ThicknessState state) {
    if (state.millimetres.size() > placeCount()) {
        throw std::invalid_argument("the state to go on from has more places");
    }
    implementation_->state = std::move(state);
}

void ThicknessBake::run(const std::function<bool()>& proceed) {
    ThicknessState& state = implementation_->state;
    std::size_t size = std::max(firstSliceRays / implementation_->settings.samples, leastSlice);
    while (!isComplete()) {
        const Clock::time_point start = Clock::now();
        const std::size_t count = std::min(size, placeCount() - state.millimetres.size());
        implementation_->addSlice(count);
        const double seconds = std::max(secondsSince(start), 1e-6);
        state.seconds += seconds;
        size = static_cast<std::size_t>(std::clamp(static_cast<double>(count) * sliceSeconds / seconds,
                                                   static_cast<double>(leastSlice), 4.0 * static_cast<double>(size)));
        if (!proceed()) {
            return;
        }
    }
}

std::vector<std::string> ThicknessBake::warnings() const {
    std::vector<std::string> result;
    const Implementation& self = *implementation_;
    if (const std::uint64_t open = self.chords.openEdges(); open > 0) {
        result.push_back("the bodies are not closed (" + std::to_string(open) +
                         " open edges); where a ray flies away through a gap, nothing is thought to come through");
    }
    const double rays = static_cast<double>(self.state.millimetres.size()) * self.settings.samples;
    const double percent = rays > 0 ? 100 * static_cast<double>(self.state.escaped) / rays : 0;
    if (percent >= 0.05) {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), "%.1f %% of the rays flew away through gaps", percent);
        result.emplace_back(text.data());
    }
    return result;
}

void saveThickness(const std::filesystem::path& file, const trace::Identity& identity, const ThicknessState& state) {
    trace::WorkWriter writer(magic, identity);
    writer.put(static_cast<std::uint64_t>(state.millimetres.size()));
    writer.put(state.escaped);
    writer.put(state.seconds);
    writer.putAll(std::span(state.millimetres));
    writer.save(file);
}

ThicknessState loadThickness(const std::filesystem::path& file, const trace::Identity& identity, std::size_t places) {
    trace::WorkReader reader(file, magic, "a checkpoint of `nacre bake thickness`");
    trace::requireSameIdentity(file, reader.identity(), identity);
    const auto count = reader.get<std::uint64_t>();
    ThicknessState state;
    state.escaped = reader.get<std::uint64_t>();
    state.seconds = reader.get<double>();
    reader.require(count <= places && reader.left() == count * sizeof(float));
    state.millimetres.resize(count);
    reader.getAll(std::span(state.millimetres));
    return state;
}

} // namespace nacre::bake
