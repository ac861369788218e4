#include "app/bench/harness.hpp"

#include "app/bench/image_error.hpp"
#include "app/bench/samples.hpp"
#include "app/bench/stage.hpp"
#include "app/bench/text.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace nacre::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t minimumRounds = 3;
constexpr double secondsBetweenLines = 5;

double secondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

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

// A configuration and what its frames took.
struct Candidate {
    const Configuration* configuration;
    Samples samples;
    /// This candidate's configuration once more, for the noise floor.
    bool isTwin = false;
};

class SeriesRun {
public:
    SeriesRun(renderer::Device& device, const Series& series, const HarnessSettings& settings, const Reporter& say)
        : series_(series), settings_(settings), say_(say), stage_(device) {
        for (const Configuration& configuration : series.configurations) {
            candidates_.push_back({&configuration, {}, false});
        }
        addTwins();
    }

    SeriesResult run() {
        warmUp();
        measureRounds();
        SeriesResult result;
        result.noiseFloors = findNoiseFloors();
        for (const Candidate& candidate : candidates_) {
            if (!candidate.isTwin) {
                result.measurements.push_back(describe(candidate, result.noiseFloors));
            }
        }
        if (series_.withError) {
            addErrors(result.measurements);
        }
        return result;
    }

private:
    // The first configuration of each size runs twice, at the start and at the end of every round.
    void addTwins() {
        for (const Configuration& configuration : series_.configurations) {
            const auto hasTwin = [&](const Configuration* other) { return sameSize(other->size, configuration.size); };
            if (std::none_of(twins_.begin(), twins_.end(), hasTwin)) {
                twins_.push_back(&configuration);
            }
        }
        for (const Configuration* configuration : twins_) {
            candidates_.push_back({configuration, {}, true});
        }
    }

    void warmUp() {
        std::size_t done = 0;
        for (const Candidate& candidate : candidates_) {
            stage_.select(*candidate.configuration);
            for (std::uint32_t frame = 0; frame < settings_.warmUpFrames; ++frame) {
                stage_.renderEffect();
            }
            progress("warming up", ++done, candidates_.size());
        }
    }

    void measureRounds() {
        const Clock::time_point begin = Clock::now();
        for (std::uint32_t round = 0; round < settings_.rounds; ++round) {
            if (round >= minimumRounds && secondsSince(begin) > settings_.secondsPerSeries) {
                say_(series_.name + ": " + std::to_string(round) + " of " + std::to_string(settings_.rounds) +
                     " rounds in the time there is");
                break;
            }
            for (Candidate& candidate : candidates_) {
                takeTurn(candidate, round < settings_.wholeFrameRounds);
            }
            progress("round", round + 1, settings_.rounds);
        }
    }

    void takeTurn(Candidate& candidate, bool wholeFrames) {
        const auto render = [&]() -> const renderer::FrameReport& {
            return wholeFrames ? stage_.renderFrame() : stage_.renderEffect();
        };
        if (stage_.select(*candidate.configuration) && settings_.settle) {
            render();
        }
        for (std::uint32_t frame = 0; frame < settings_.framesPerTurn; ++frame) {
            candidate.samples.add(render(), wholeFrames);
        }
    }

    void progress(const char* what, std::size_t done, std::size_t all) {
        if (secondsSince(lastLine_) > secondsBetweenLines || done == all) {
            say_(series_.name + ": " + what + " " + std::to_string(done) + " of " + std::to_string(all) + ", " +
                 std::to_string(series_.configurations.size()) + " configurations, " +
                 formatNumber(secondsSince(begin_)) + " s");
            lastLine_ = Clock::now();
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

    double noiseOf(const Configuration& configuration, const std::vector<NoiseFloor>& floors) const {
        for (std::size_t i = 0; i < twins_.size(); ++i) {
            if (sameSize(twins_[i]->size, configuration.size)) {
                return floors[i].share;
            }
        }
        return 1;
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
        measurement.unit = series_.unit;
        measurement.value = configuration.value;
        candidate.samples.fill(measurement);
        measurement.footprint = footprint(*configuration.view, configuration.size, configuration.materials);
        measurement.layers = mostLayers(configuration.materials);
        measurement.noise = noiseOf(configuration, floors);
        return measurement;
    }

    void addErrors(std::vector<Measurement>& measurements) {
        for (std::size_t i = 0; i < measurements.size(); ++i) {
            const Configuration& configuration = series_.configurations[i];
            measurements[i].error = errorOf(configuration);
            progress("comparing with brute", i + 1, measurements.size());
        }
    }

    ImageError errorOf(const Configuration& configuration) {
        const bool sameReference = !reference_.empty() && referenceOf_.view == configuration.view &&
                                   sameSize(referenceOf_.size, configuration.size) &&
                                   referenceOf_.materials == configuration.materials;
        if (!sameReference) {
            referenceOf_ = configuration;
            referenceOf_.effect.technique = renderer::Technique::Brute;
            stage_.select(referenceOf_);
            stage_.renderFrame();
            reference_ = stage_.read(renderer::Output::Scattered).values;
            materialIds_ = stage_.read(renderer::Output::Material).values;
        }
        stage_.select(configuration);
        stage_.renderFrame();
        return compareImages(stage_.read(renderer::Output::Scattered).values, reference_, materialIds_);
    }

    const Series& series_;
    const HarnessSettings& settings_;
    const Reporter& say_;
    Stage stage_;
    std::vector<Candidate> candidates_;
    std::vector<const Configuration*> twins_;
    Configuration referenceOf_;
    std::vector<float> reference_;
    std::vector<float> materialIds_;
    Clock::time_point begin_ = Clock::now();
    Clock::time_point lastLine_ = Clock::now();
};

} // namespace

SeriesResult measure(renderer::Device& device, const Series& series, const HarnessSettings& settings,
                     const Reporter& say) {
    return SeriesRun(device, series, settings, say).run();
}

} // namespace nacre::bench
