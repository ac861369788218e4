// What a benchmark run leaves behind: results.json (docs/schemas/benchmark.schema.json) and its table as CSV.
#pragma once

#include "bench/time_statistics.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nacre::bench {

/// A frequency that could be read, before and after the run.
struct Clock {
    std::string name;
    double before = 0; ///< MHz
    double after = 0;  ///< MHz

    bool operator==(const Clock&) const = default;
};

/// What it was measured on.
struct Machine {
    std::string device;
    std::string kind; ///< "discrete", "integrated", "virtual", "software" or "other"
    std::string driver;
    std::string apiVersion;
    std::string processor;
    std::uint32_t threads = 0; ///< hardware threads of the processor
    std::vector<Clock> clocks; ///< none where they cannot be read

    bool operator==(const Machine&) const = default;
};

/// How it was measured.
struct Procedure {
    bool quick = false;
    std::uint32_t warmUpFrames = 0; ///< per configuration, before the first round
    std::uint32_t repetitions = 0;  ///< most repetitions of the effect that a configuration was asked for
    double seconds = 0;             ///< duration of the whole run

    bool operator==(const Procedure&) const = default;
};

/// A value of which there are several, by name. In the file it is a key of an object.
template <typename Value> struct Named {
    std::string name;
    Value value{};

    bool operator==(const Named&) const = default;
};

using PassResult = Named<Summary>;      ///< µs
using MemoryUse = Named<std::uint64_t>; ///< bytes of device memory that belong to a pass or a group of them

/// Largest PSNR that is written: pictures that are equal have no other.
inline constexpr double maxPsnr = 200;

/// How far the picture is from tier 1 (technique `brute`), over the pixels with a subsurface material.
struct ImageError {
    double psnr = 0;        ///< [0, maxPsnr] dB; the peak is the reference's 99.9th percentile
    double relMse = 0;      ///< mean of (x − r)² / (r² + 0.01)
    double energyRatio = 1; ///< Σ x / Σ r

    bool operator==(const ImageError&) const = default;
};

/// One configuration, measured.
struct Measurement {
    std::string id;     ///< unique within the file and the same in every run of the suite; what `diff` matches by
    std::string series; ///< what it belongs to, e.g. "experiment 2"
    std::string view;   ///< scene and camera
    std::string technique;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::string variable; ///< what the series varies, e.g. "radius"
    std::string unit;     ///< of `value`, e.g. "texels"; empty = a count
    double value = 0;
    Summary frame;  ///< µs of a frame that has no timestamps but its first and last
    Summary effect; ///< µs, the effect, repeated on the images of a frame
    Summary copy;   ///< µs of a pass that only copies the effect's inputs to its output
    /// One after the other, without timestamps inside, whose mean a time of `effect` and `copy` is; none = single ones,
    /// the sum of the passes.
    std::optional<std::uint32_t> repetitions;
    Summary recording;              ///< µs of processor time to record the frame
    std::vector<PassResult> passes; ///< in order of execution
    double passShare = 0;           ///< Σ median of the passes, timed within frames / median of the frame
    std::uint64_t copyBytes = 0;    ///< what the copy reads and writes
    double coverage = 0;            ///< [0, 1] share of pixels with a subsurface material
    double footprint = 0;           ///< px, rms radius of the widest channel at the camera's target
    std::uint64_t triangles = 0;
    std::uint32_t lights = 0;
    std::uint32_t materials = 0;
    std::uint32_t layers = 0; ///< most of any material
    std::uint32_t dispatches = 0;
    std::vector<MemoryUse> memory;
    double noise = 0; ///< the noise floor that holds for it: a share of its times
    std::optional<ImageError> error;

    bool operator==(const Measurement&) const = default;
};

/// The time called "effect", "frame", "copy" or like a pass; null when there is none.
const Summary* findTime(const Measurement& measurement, std::string_view quantity);

/// One configuration measured twice, as if it were two.
struct NoiseFloor {
    std::string id; ///< of the measurement
    std::string series;
    Summary first;  ///< µs of the effect
    Summary second; ///< µs of the effect
    double share = 0;

    bool operator==(const NoiseFloor&) const = default;
};

/// How one technique's time grows along a series.
struct Fit {
    std::string series;
    std::string technique;
    std::uint32_t width = 0; ///< 0 where the series varies the resolution
    std::uint32_t height = 0;
    std::string variable;
    std::string unit;
    std::string quantity; ///< whose time: "effect", "frame", "scatter" (its passes) or a pass's name
    Line line;            ///< µs per unit of the variable
    double spread = 1;    ///< largest time of the series / smallest
    double noise = 0;     ///< largest of the series
    bool flat = false;    ///< isFlat

    bool operator==(const Fit&) const = default;
};

/// Two pictures of the same view, files beside results.json.
struct ImagePair {
    std::string series; ///< what they belong to
    std::string title;
    std::string before;
    std::string beforeFile;
    std::string after;
    std::string afterFile;

    bool operator==(const ImagePair&) const = default;
};

struct Results {
    std::string suite; ///< "thesis", "sweep" or "pareto"
    std::string nacreVersion;
    std::string commit;  ///< of the sources it was built from; "unknown" outside a repository
    std::string created; ///< UTC, ISO 8601
    std::string scene;
    std::optional<std::vector<std::string>> notes; ///< Scene::notes; absent in files of earlier versions
    Machine machine;
    Procedure procedure;
    std::vector<NoiseFloor> noiseFloors;
    std::vector<Measurement> measurements;
    std::vector<Fit> fits; ///< fitSeries of the measurements; not in the file
    std::vector<ImagePair> images;

    bool operator==(const Results&) const = default;
};

/// The text of results.json: one line for each configuration, numbers with nine significant digits. Throws
/// std::invalid_argument for results that loadResults would refuse.
std::string formatResults(const Results& results);

/// Reads the text of a results.json; `sourceName` is what an error calls it. Refused with a FileError of one sentence
/// (nacre/files.hpp): what is not JSON, not a benchmark's, of another version, a key that is unknown, missing or of the
/// wrong type, a number out of range, an id given twice.
Results parseResults(std::string_view json, std::string_view sourceName);

/// parseResults of a file of up to 256 MiB.
Results loadResults(const std::filesystem::path& file);

/// Every measurement's quantities as a table, one line each (RFC 4180, header first, times in µs).
std::string formatCsv(const Results& results);

} // namespace nacre::bench
