#include "bench/suites/series_run.hpp"

#include "bench/report/report_text.hpp"
#include "bench/suites/configuration_stage.hpp"
#include "bench/suites/frame_samples.hpp"
#include "bench/suites/image_error.hpp"

#include <algorithm>
#include <stdexcept>

namespace nacre::bench {
namespace {

constexpr std::uint32_t minimumRounds = 3;
constexpr double secondsBetweenLines = 5;

std::string idOf(const Series& series, const Configuration& configuration) {
    return series.name + "/" + configuration.view->name + "/" + configuration.technique + "/" +
           formatSize(configuration.size.width, configuration.size.height) + "/" + series.variable + " " +
           formatNumber(configuration.value, 6);
}

std::uint32_t mostLayers(const std::vector<Material>& materials) {
    std::size_t most = 0;
    for (const Material& material : materials) {
        most = std::max(most, makeLayers(material).size());
    }
    return static_cast<std::uint32_t>(most);
}

bool sameSize(const Size& a, const Size& b) {
    return a.width == b.width && a.height == b.height;
}

// As many as make up a time of repetitionsDuration, unless one alone is longer.
std::uint32_t repetitionsOf(double microseconds) {
    constexpr double repetitionsDuration = 5000; // µs
    const double count = std::min<double>(repetitionsDuration / std::max(microseconds, 1.0), mostRepetitions);
    return count < 2 ? 0 : static_cast<std::uint32_t>(count);
}

// A configuration and what its frames took.
struct Candidate {
    const Configuration* configuration;
    Samples samples;
    /// This candidate's configuration once more, for the noise floor.
    bool isTwin = false;
    std::uint32_t repetitions = 0; ///< Stage::renderEffect
};

class SeriesRun {
public:
    SeriesRun(renderer::Device& device, const Series& series, const HarnessSettings& settings, const Reporter& say)
        : series_(series), settings_(settings), say_(say), stage_(device), twinStage_(device) {
        for (const Configuration& configuration : series.configurations) {
            candidates_.push_back({&configuration, {}, false});
        }
        addTwins();
    }

    SeriesResult run() {
        const std::vector<ImageError> errors = findErrors();
        measureRounds();
        SeriesResult result;
        result.noiseFloors = findNoiseFloors();
        for (const Candidate& candidate : candidates_) {
            if (!candidate.isTwin) {
                result.measurements.push_back(describe(candidate, result.noiseFloors));
            }
        }
        for (std::size_t i = 0; i < errors.size(); ++i) {
            result.measurements[i].error = errors[i];
        }
        return result;
    }

private:
    // They come after all others, so that a configuration and its twin are at two ends of a round.
    void addTwins() {
        for (const Configuration& configuration : series_.configurations) {
            const auto hasSize = [&](const Configuration& other) { return sameSize(other.size, configuration.size); };
            const auto& all = series_.configurations;
            const Configuration& first = *std::find_if(all.begin(), all.end(), hasSize);
            const Configuration& last = *std::find_if(all.rbegin(), all.rend(), hasSize);
            if (&configuration == &first || &configuration == &last) {
                twins_.push_back(&configuration);
            }
        }
        for (const Configuration* configuration : twins_) {
            candidates_.push_back({configuration, {}, true});
        }
    }

    void measureRounds() {
        std::vector<Turn> turns;
        for (Candidate& candidate : candidates_) {
            turns.push_back({[&] { warmUp(candidate); }, {[&](std::uint32_t round) { takeTurn(candidate, round); }}});
        }
        const TurnSettings settings{.rounds = settings_.rounds,
                                    .leastRounds = minimumRounds,
                                    .seconds = settings_.secondsPerSeries - secondsSince(begin_)};
        const std::uint32_t rounds = takeTurns(
            turns, settings, [this](const char* what, std::size_t done, std::size_t all) { progress(what, done, all); },
            [this] { raiseClocks(); });
        if (rounds < settings_.rounds) {
            say_(series_.name + ": " + std::to_string(rounds) + " of " + std::to_string(settings_.rounds) +
                 " rounds in the time there is");
        }
    }

    void warmUp(const Candidate& candidate) {
        Stage& stage = stageOf(candidate);
        stage.select(*candidate.configuration);
        for (std::uint32_t frame = 0; frame < settings_.warmUpFrames; ++frame) {
            stage.renderEffect();
        }
    }

    void raiseClocks() {
        const auto begin = std::chrono::steady_clock::now();
        while (secondsSince(begin) < settings_.warmUpSeconds) {
            stage_.renderFrame();
        }
        for (Candidate& candidate : candidates_) { // with the clocks risen
            Stage& stage = stageOf(candidate);
            stage.select(*candidate.configuration);
            candidate.repetitions = repetitionsOf(stage.renderEffect().effectMicroseconds);
        }
    }

    void takeTurn(Candidate& candidate, std::uint32_t round) {
        Stage& stage = stageOf(candidate);
        stage.select(*candidate.configuration);
        if (round < settings_.frameRounds) {
            candidate.samples.addPasses(stage.renderFrame());
            candidate.samples.addWhole(stage.renderFrame(renderer::Timing::Whole));
        }
        if (settings_.settle) {
            stage.renderEffect();
        }
        for (std::uint32_t effect = 0; effect < settings_.effectsPerTurn; ++effect) {
            candidate.samples.addEffect(stage.renderEffect(candidate.repetitions));
        }
    }

    Stage& stageOf(const Candidate& candidate) { return candidate.isTwin ? twinStage_ : stage_; }

    void progress(const char* what, std::size_t done, std::size_t all) {
        if (secondsSince(lastLine_) > secondsBetweenLines || done == all) {
            say_(series_.name + ": " + what + " " + std::to_string(done) + " of " + std::to_string(all) + ", " +
                 std::to_string(series_.configurations.size()) + " configurations, " +
                 formatNumber(secondsSince(begin_)) + " s");
            lastLine_ = std::chrono::steady_clock::now();
        }
    }

    const Candidate& find(const Configuration* configuration, bool isTwin) const {
        return *std::find_if(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
            return candidate.configuration == configuration && candidate.isTwin == isTwin;
        });
    }

    std::vector<NoiseFloor> findNoiseFloors() const {
        std::vector<NoiseFloor> floors;
        for (const Configuration* configuration : twins_) {
            const Summary first = find(configuration, false).samples.effect();
            const Summary second = find(configuration, true).samples.effect();
            floors.push_back({idOf(series_, *configuration), series_.name, first, second, noiseFloor(first, second)});
        }
        return floors;
    }

    // The largest of its size.
    double noiseOf(const Configuration& configuration, const std::vector<NoiseFloor>& floors) const {
        double noise = 0;
        for (std::size_t i = 0; i < twins_.size(); ++i) {
            noise = sameSize(twins_[i]->size, configuration.size) ? std::max(noise, floors[i].share) : noise;
        }
        return noise;
    }

    Measurement describe(const Candidate& candidate, const std::vector<NoiseFloor>& floors) const {
        const Configuration& configuration = *candidate.configuration;
        Measurement measurement;
        measurement.id = idOf(series_, configuration);
        measurement.series = series_.name;
        measurement.view = configuration.view->name;
        measurement.technique = configuration.technique;
        measurement.width = configuration.size.width;
        measurement.height = configuration.size.height;
        measurement.variable = series_.variable;
        measurement.unit = configuration.unit.empty() ? series_.unit : configuration.unit;
        measurement.value = configuration.value;
        candidate.samples.fill(measurement);
        if (candidate.repetitions > 0) {
            measurement.repetitions = candidate.repetitions;
        }
        measurement.footprint = footprint(*configuration.view, configuration.size, configuration.materials);
        measurement.layers = mostLayers(configuration.materials);
        measurement.noise = noiseOf(configuration, floors);
        return measurement;
    }

    // One for each configuration of the series, where it asks for them.
    std::vector<ImageError> findErrors() {
        if (!series_.errorAt) {
            return {};
        }
        Configuration exact = series_.configurations.front();
        exact.effect.technique = NACRE_TECHNIQUE_BRUTE;
        exact.size = *series_.errorAt;
        const ReferencePicture reference(picture(exact));
        std::vector<ImageError> errors;
        for (const Configuration& configuration : series_.configurations) {
            errors.push_back(reference.compare(picture(configuration)));
            progress("comparing with brute", errors.size(), series_.configurations.size());
        }
        return errors;
    }

    IdentifiedPicture picture(const Configuration& configuration) {
        stage_.select(configuration);
        stage_.renderFrame();
        return {stage_.read(renderer::Output::Scattered), stage_.read(renderer::Output::Material).values};
    }

    const Series& series_;
    const HarnessSettings& settings_;
    const Reporter& say_;
    Stage stage_;
    Stage twinStage_; ///< with images of its own
    std::vector<Candidate> candidates_;
    std::vector<const Configuration*> twins_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point lastLine_ = std::chrono::steady_clock::now();
};

} // namespace

SeriesResult measure(renderer::Device& device, const Series& series, const HarnessSettings& settings,
                     const Reporter& say) {
    return SeriesRun(device, series, settings, say).run();
}

} // namespace nacre::bench
