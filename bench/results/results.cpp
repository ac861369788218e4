#include "bench/results/results.hpp"

#include "bench/results/series_fits.hpp"
#include "core/files/json_fault.hpp"
#include "nacre/files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace nacre::bench {
namespace {

// Keys keep the order of the format in the file.
using Json = nlohmann::ordered_json;

constexpr const char* formatName = "nacre-benchmark";
constexpr int formatVersion = 2;
constexpr int writtenDigits = 9; // a report made of the file is the one made at the run
constexpr std::uint64_t maxResultsBytes = std::uint64_t{256} << 20;

/// What a number may be, as the schema has it.
struct Range {
    double low = std::numeric_limits<double>::lowest();
    double high = std::numeric_limits<double>::max();
};
constexpr Range nonNegative{.low = 0};
constexpr Range unitInterval{.low = 0, .high = 1};

template <typename Struct, typename Type> struct Key {
    const char* name;
    Type Struct::*member;
    Range range{};
};
template <typename Struct, typename Type> Key(const char*, Type Struct::*) -> Key<Struct, Type>;
template <typename Struct, typename Type> Key(const char*, Type Struct::*, Range) -> Key<Struct, Type>;

// After the count, in the order of the file.
constexpr double Summary::*summaryValues[] = {&Summary::median, &Summary::p5, &Summary::p95, &Summary::low,
                                              &Summary::high};

// Every struct's keys, in the order of the file.
template <typename Struct> constexpr auto keys = nullptr;
template <>
constexpr auto keys<Clock> = std::tuple{Key{"name", &Clock::name}, Key{"before", &Clock::before, nonNegative},
                                        Key{"after", &Clock::after, nonNegative}};
template <>
constexpr auto keys<Machine> =
    std::tuple{Key{"device", &Machine::device},       Key{"kind", &Machine::kind},
               Key{"driver", &Machine::driver},       Key{"apiVersion", &Machine::apiVersion},
               Key{"processor", &Machine::processor}, Key{"threads", &Machine::threads},
               Key{"clocks", &Machine::clocks}};
template <>
constexpr auto keys<Procedure> =
    std::tuple{Key{"quick", &Procedure::quick}, Key{"warmUpFrames", &Procedure::warmUpFrames},
               Key{"repetitions", &Procedure::repetitions}, Key{"seconds", &Procedure::seconds, nonNegative}};
template <>
constexpr auto keys<ImageError> = std::tuple{Key{"psnr", &ImageError::psnr, Range{.low = 0, .high = 200}},
                                             Key{"relMse", &ImageError::relMse, nonNegative},
                                             Key{"energyRatio", &ImageError::energyRatio, nonNegative}};
template <>
constexpr auto keys<Measurement> = std::tuple{Key{"id", &Measurement::id},
                                              Key{"series", &Measurement::series},
                                              Key{"view", &Measurement::view},
                                              Key{"technique", &Measurement::technique},
                                              Key{"width", &Measurement::width, Range{.low = 1}},
                                              Key{"height", &Measurement::height, Range{.low = 1}},
                                              Key{"variable", &Measurement::variable},
                                              Key{"unit", &Measurement::unit},
                                              Key{"value", &Measurement::value},
                                              Key{"frame", &Measurement::frame},
                                              Key{"effect", &Measurement::effect},
                                              Key{"copy", &Measurement::copy},
                                              Key{"repetitions", &Measurement::repetitions},
                                              Key{"recording", &Measurement::recording},
                                              Key{"passes", &Measurement::passes},
                                              Key{"passShare", &Measurement::passShare, nonNegative},
                                              Key{"copyBytes", &Measurement::copyBytes},
                                              Key{"coverage", &Measurement::coverage, unitInterval},
                                              Key{"footprint", &Measurement::footprint, nonNegative},
                                              Key{"triangles", &Measurement::triangles},
                                              Key{"lights", &Measurement::lights},
                                              Key{"materials", &Measurement::materials},
                                              Key{"layers", &Measurement::layers},
                                              Key{"dispatches", &Measurement::dispatches},
                                              Key{"memory", &Measurement::memory},
                                              Key{"noise", &Measurement::noise, nonNegative},
                                              Key{"error", &Measurement::error}};
template <>
constexpr auto keys<NoiseFloor> =
    std::tuple{Key{"id", &NoiseFloor::id}, Key{"series", &NoiseFloor::series}, Key{"first", &NoiseFloor::first},
               Key{"second", &NoiseFloor::second}, Key{"share", &NoiseFloor::share, nonNegative}};
template <>
constexpr auto keys<ImagePair> =
    std::tuple{Key{"series", &ImagePair::series}, Key{"title", &ImagePair::title},
               Key{"before", &ImagePair::before}, Key{"beforeFile", &ImagePair::beforeFile},
               Key{"after", &ImagePair::after},   Key{"afterFile", &ImagePair::afterFile}};
template <>
constexpr auto keys<Results> = std::tuple{Key{"suite", &Results::suite},
                                          Key{"nacreVersion", &Results::nacreVersion},
                                          Key{"commit", &Results::commit},
                                          Key{"created", &Results::created},
                                          Key{"scene", &Results::scene},
                                          Key{"notes", &Results::notes},
                                          Key{"machine", &Results::machine},
                                          Key{"procedure", &Results::procedure},
                                          Key{"noiseFloors", &Results::noiseFloors},
                                          Key{"measurements", &Results::measurements},
                                          Key{"images", &Results::images}};

// -- writing

Json write(const std::string& value) {
    return value;
}
template <typename Number>
requires std::integral<Number> Json write(Number value) {
    return value;
}
Json write(double value) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::general, writtenDigits);
    std::from_chars(text, end, value);
    return value;
}
Json write(const Summary& summary) {
    Json array = Json::array({summary.count});
    for (const double Summary::*value : summaryValues) {
        array.push_back(write(summary.*value));
    }
    return array;
}
template <typename Struct>
requires(!std::is_null_pointer_v<std::remove_cvref_t<decltype(keys<Struct>)>>) Json write(const Struct& value);

template <typename Value> Json write(const std::vector<Named<Value>>& values) {
    Json object = Json::object();
    for (const Named<Value>& value : values) {
        if (!object.emplace(value.name, write(value.value)).second) {
            throw FileError("\"" + value.name + "\" is given twice");
        }
    }
    return object;
}
template <typename Element> Json write(const std::vector<Element>& values) {
    Json array = Json::array();
    for (const Element& value : values) {
        array.push_back(write(value));
    }
    return array;
}
template <typename Value> Json write(const std::optional<Value>& value) {
    return value ? write(*value) : Json();
}
template <typename Struct>
requires(!std::is_null_pointer_v<std::remove_cvref_t<decltype(keys<Struct>)>>) Json write(const Struct& value) {
    Json object = Json::object();
    const auto add = [&](const auto& key) {
        if (Json member = write(value.*key.member); !member.is_null()) {
            object[key.name] = std::move(member);
        }
    };
    std::apply([&](const auto&... key) { (add(key), ...); }, keys<Struct>);
    return object;
}

// -- reading

[[noreturn]] void refuse(const std::string& field, const Json& value, const std::string& expected) {
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 60) {
        text = text.substr(0, 57) + "...";
    }
    throw FileError(field + " is " + text + ", must be " + expected);
}

void read(const Json& value, const std::string& field, std::string& result) {
    if (!value.is_string()) {
        refuse(field, value, "a string");
    }
    result = value.get<std::string>();
}
void read(const Json& value, const std::string& field, bool& result) {
    if (!value.is_boolean()) {
        refuse(field, value, "true or false");
    }
    result = value.get<bool>();
}
void read(const Json& value, const std::string& field, double& result) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
        refuse(field, value, "a number");
    }
    result = value.get<double>();
}
template <std::unsigned_integral Count> void read(const Json& value, const std::string& field, Count& result) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<Count>::max()) {
        refuse(field, value, "a whole number from 0 to " + std::to_string(std::numeric_limits<Count>::max()));
    }
    result = value.get<Count>();
}
template <typename Struct>
requires(!std::is_null_pointer_v<std::remove_cvref_t<decltype(keys<Struct>)>>) void read(const Json& value,
                                                                                         const std::string& field,
                                                                                         Struct& result);
void read(const Json& value, const std::string& field, Summary& result);

template <typename Value> void read(const Json& value, const std::string& field, std::vector<Named<Value>>& result) {
    if (!value.is_object()) {
        refuse(field, value, "an object");
    }
    for (const auto& [name, member] : value.items()) {
        result.push_back({name, {}});
        read(member, field + "." + name, result.back().value);
    }
}
template <typename Element> void read(const Json& value, const std::string& field, std::vector<Element>& result) {
    if (!value.is_array()) {
        refuse(field, value, "an array");
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        read(value[i], field + "[" + std::to_string(i) + "]", result.emplace_back());
    }
}
template <typename Value> void read(const Json& value, const std::string& field, std::optional<Value>& result) {
    read(value, field, result.emplace());
}

std::string describe(const Range& range) {
    std::ostringstream text;
    const Range any;
    text << "a number ";
    if (range.low == any.low) {
        text << "up to " << range.high;
    } else if (range.high == any.high) {
        text << "from " << range.low;
    } else {
        text << "from " << range.low << " to " << range.high;
    }
    return text.str();
}

void checkRange(const Json& value, const std::string& field, const Range& range) {
    if (value.is_number() && (value.get<double>() < range.low || value.get<double>() > range.high)) {
        refuse(field, value, describe(range));
    }
}

void read(const Json& value, const std::string& field, Summary& result) {
    if (!value.is_array() || value.size() != 1 + std::size(summaryValues)) {
        refuse(field, value, "[count, median, p5, p95, low, high]");
    }
    const auto readAt = [&](std::size_t index, auto& target, const Range& range) {
        const std::string place = field + "[" + std::to_string(index) + "]";
        read(value[index], place, target);
        checkRange(value[index], place, range);
    };
    readAt(0, result.count, {.low = 1});
    for (std::size_t i = 0; i < std::size(summaryValues); ++i) {
        readAt(i + 1, result.*summaryValues[i], nonNegative);
    }
    result.confidence = intervalConfidence(result.count);
}

template <typename Type> constexpr bool isOptional = false;
template <typename Type> constexpr bool isOptional<std::optional<Type>> = true;

template <typename Struct>
requires(!std::is_null_pointer_v<std::remove_cvref_t<decltype(keys<Struct>)>>) void read(const Json& value,
                                                                                         const std::string& field,
                                                                                         Struct& result) {
    if (!value.is_object()) {
        refuse(field.empty() ? "the content" : field, value, "an object");
    }
    const std::string prefix = field.empty() ? "" : field + ".";
    std::size_t found = 0;
    const auto readMember = [&](const auto& key) {
        const auto member = value.find(key.name);
        if (member != value.end()) {
            read(*member, prefix + key.name, result.*key.member);
            checkRange(*member, prefix + key.name, key.range);
            ++found;
        } else if (!isOptional<std::remove_cvref_t<decltype(result.*key.member)>>) {
            throw FileError(prefix + key.name + " is missing");
        }
    };
    std::apply([&](const auto&... key) { (readMember(key), ...); }, keys<Struct>);
    if (found == value.size()) {
        return;
    }
    const auto isKnown = [](const std::string& name) {
        return std::apply([&](const auto&... key) { return ((name == key.name) || ...); }, keys<Struct>);
    };
    for (const auto& [name, member] : value.items()) {
        if (!isKnown(name)) {
            throw FileError("the key \"" + prefix + name + "\" is unknown");
        }
    }
}

// -- what no single value shows

void check(const Summary& summary, const std::string& field) {
    const bool ordered = summary.p5 <= summary.median && summary.median <= summary.p95 &&
                         summary.low <= summary.median && summary.median <= summary.high;
    if (summary.count == 0 || !ordered || summary.p5 < 0) {
        throw FileError(field + " is no summary of measured times");
    }
}

void check(const Measurement& measurement, const std::string& field) {
    check(measurement.frame, field + ".frame");
    check(measurement.effect, field + ".effect");
    check(measurement.copy, field + ".copy");
    check(measurement.recording, field + ".recording");
    for (const PassResult& pass : measurement.passes) {
        check(pass.value, field + ".passes: " + pass.name);
    }
}

void check(const std::string& value, const std::string& field, std::initializer_list<const char*> choices) {
    if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
        std::string list;
        for (const char* choice : choices) {
            list += (list.empty() ? "\"" : ", \"") + std::string(choice) + '"';
        }
        refuse(field, value, "one of " + list);
    }
}

void check(const Results& results) {
    check(results.suite, "suite", {"thesis", "sweep", "pareto"});
    check(results.machine.kind, "machine.kind", {"discrete", "integrated", "virtual", "software", "other"});
    std::set<std::string> ids;
    for (std::size_t i = 0; i < results.measurements.size(); ++i) {
        const std::string field = "measurements[" + std::to_string(i) + "]";
        check(results.measurements[i], field);
        if (!ids.insert(results.measurements[i].id).second) {
            throw FileError(field + ".id \"" + results.measurements[i].id + "\" is given twice");
        }
    }
}

Results readResults(std::string_view text) {
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::exception& error) {
        throw FileError(jsonFault(error.what()));
    }
    if (!json.is_object() || json.value("format", Json()) != formatName) {
        throw FileError("is not a benchmark result (its \"format\" is not \"" + std::string(formatName) + "\")");
    }
    if (json.value("schemaVersion", Json()) != formatVersion) {
        refuse("schemaVersion", json.value("schemaVersion", Json()), std::to_string(formatVersion));
    }
    json.erase("$schema");
    json.erase("format");
    json.erase("schemaVersion");
    Results results;
    read(json, "", results);
    check(results);
    results.fits = fitSeries(results.measurements);
    return results;
}

// Every field on a line of its own, and every element of an array: a configuration that is measured anew changes one.
std::string layOut(const Json& json) {
    std::string text;
    for (const auto& [key, value] : json.items()) {
        text += (text.empty() ? "{\n" : ",\n") + Json(key).dump() + ": ";
        if (!value.is_array() || value.empty()) {
            text += value.dump();
            continue;
        }
        const char* separator = "[\n";
        for (const Json& element : value) {
            text += separator + element.dump();
            separator = ",\n";
        }
        text += "\n]";
    }
    return text + "\n}\n";
}

} // namespace

const Summary* findTime(const Measurement& measurement, std::string_view quantity) {
    if (quantity == "effect") {
        return &measurement.effect;
    }
    if (quantity == "frame") {
        return &measurement.frame;
    }
    if (quantity == "copy") {
        return &measurement.copy;
    }
    for (const PassResult& pass : measurement.passes) {
        if (pass.name == quantity) {
            return &pass.value;
        }
    }
    return nullptr;
}

std::string formatResults(const Results& results) {
    try {
        check(results);
        Json json{{"format", formatName}, {"schemaVersion", formatVersion}};
        json.update(write(results));
        return layOut(json);
    } catch (const std::exception& error) {
        throw std::invalid_argument(std::string("these results cannot be written: ") + error.what());
    }
}

Results parseResults(std::string_view json, std::string_view sourceName) {
    try {
        return readResults(json);
    } catch (const FileError& error) {
        throw FileError(std::string(sourceName) + ": " + error.what());
    }
}

Results loadResults(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file, maxResultsBytes);
    return parseResults({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

} // namespace nacre::bench
