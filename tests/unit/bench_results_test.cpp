// results.json, its table and its schema, and `bench diff` on results with known differences.
#include "bench/results/results.hpp"
#include "bench/results/results_diff.hpp"
#include "bench/results/series_fits.hpp"
#include "nacre/files.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>
#include <tuple>

using namespace nacre::bench;
using Json = nlohmann::json;

namespace {

Summary times(double median) {
    return {.count = 100,
            .median = median,
            .p5 = 97 * median / 100,
            .p95 = 110 * median / 100,
            .low = 995 * median / 1000,
            .high = 1005 * median / 1000,
            .confidence = intervalConfidence(100)};
}

Measurement measurement(double radius, double effect) {
    return {.id = "experiment 2/thesis/1280x720/radius 3, \"skin\"/" + std::to_string(static_cast<int>(radius)),
            .series = "experiment 2",
            .view = "gallery, front",
            .technique = "thesis",
            .width = 1280,
            .height = 720,
            .variable = "radius",
            .unit = "texels",
            .value = radius,
            .frame = times(1000 + effect),
            .effect = times(effect),
            .copy = times(10),
            .repetitions = 20,
            .recording = times(40),
            .passes = {{"shadow maps", times(400)}, {"scatter: horizontal", times(effect)}},
            .passShare = 0.99,
            .copyBytes = 20'275'200,
            .coverage = 0.41,
            .footprint = 12.5,
            .triangles = 436'508,
            .lights = 3,
            .materials = 5,
            .layers = 10,
            .dispatches = 10,
            .memory = {{"G-buffer", 1'000'000}},
            .noise = 0.02,
            .error = ImageError{.psnr = 33.25, .relMse = 0.004, .energyRatio = 0.998}};
}

Results sample() {
    Results results{
        .suite = "thesis",
        .nacreVersion = "0.1.0",
        .commit = "0123abc",
        .created = "2026-01-02T03:04:05Z",
        .scene = "gallery",
        .notes = std::vector<std::string>{"bust.obj: does not state its unit"},
        .machine = {"A device", "discrete", "driver 1", "1.3.0", "A processor", 8, {{"graphics", 1980, 1965}}},
        .procedure = {.quick = true, .warmUpFrames = 3, .repetitions = 100, .seconds = 12.5},
        .noiseFloors = {{"id", "experiment 2", times(100), times(101), 0.01}},
        .measurements = {},
        .fits = {},
        .images = {{"experiment 2", "Figure 4.4", "effect off", "off.png", "effect on", "on.png"}}};
    for (const double radius : {3.0, 5.0, 7.0}) {
        results.measurements.push_back(measurement(radius, 100 * radius));
    }
    return results;
}

std::string refusal(const std::string& text) {
    try {
        parseResults(text, "results.json");
    } catch (const nacre::FileError& error) {
        return error.what();
    }
    return "accepted";
}

Json sampleJson() {
    return Json::parse(formatResults(sample()));
}

std::set<std::string> keysOf(const Json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) {
        keys.insert(key);
    }
    return keys;
}

// The schema an object of the sample answers to: `schema` itself, or what its $ref names.
const Json& resolve(const Json& root, const Json& schema) {
    return schema.contains("$ref") ? root.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))) : schema;
}

void expectSchemaFits(const Json& root, const Json& reference, const Json& value, const std::string& field) {
    const Json& schema = resolve(root, reference);
    ASSERT_TRUE(schema.contains("type") || schema.contains("const") || schema.contains("enum")) << field;
    if (value.is_object() && schema["additionalProperties"].is_object()) { // values by name
        ASSERT_FALSE(value.empty()) << field;
        expectSchemaFits(root, schema["additionalProperties"], value.front(), field + ".*");
    } else if (value.is_object()) {
        EXPECT_EQ(schema["type"], "object") << field;
        EXPECT_EQ(schema["additionalProperties"], false) << field;
        std::set<std::string> properties = keysOf(schema["properties"]);
        properties.erase("$schema");
        EXPECT_EQ(properties, keysOf(value)) << field;
        for (const auto& [key, member] : value.items()) {
            ASSERT_TRUE(schema["properties"].contains(key)) << field << '.' << key;
            expectSchemaFits(root, schema["properties"][key], member, field + '.' + key);
        }
        for (const Json& key : schema["required"]) {
            EXPECT_TRUE(value.contains(key)) << field << '.' << key;
        }
    } else if (value.is_array()) {
        EXPECT_EQ(schema["type"], "array") << field;
        ASSERT_FALSE(value.empty()) << field;
        EXPECT_GE(value.size(), schema.value("minItems", 0u)) << field;
        EXPECT_LE(value.size(), schema.value("maxItems", 1000u)) << field;
        expectSchemaFits(root, schema["items"], value[0], field + "[0]");
    } else if (schema.contains("type")) {
        const std::string type = value.is_string() ? "string" : value.is_boolean() ? "boolean" : "number";
        EXPECT_TRUE(schema["type"] == type || (type == "number" && schema["type"] == "integer")) << field;
    }
}

} // namespace

TEST(Results, SurviveTheirFile) {
    EXPECT_EQ(parseResults(formatResults(sample()), "sample"), sample());
}

TEST(Results, WithoutAnErrorStayWithout) {
    Results results = sample();
    results.measurements[1].error.reset();
    results.fits = fitSeries(results.measurements);
    EXPECT_EQ(parseResults(formatResults(results), "sample"), results);
}

TEST(Results, RefuseWhatIsNoResultsFile) {
    EXPECT_NE(refusal("{\"format\": \"nacre-bench").find("results.json: parse error"), std::string::npos);
    EXPECT_EQ(refusal("[1, 2]"), "results.json: is not a benchmark result (its \"format\" is not \"nacre-benchmark\")");
    EXPECT_EQ(refusal("{\"layers\": []}"),
              "results.json: is not a benchmark result (its \"format\" is not \"nacre-benchmark\")");
    EXPECT_NE(refusal(""), "accepted");
    EXPECT_THROW(loadResults("/nowhere/results.json"), nacre::FileError);
}

TEST(Results, EveryTruncationIsRefusedInOneSentence) {
    const std::string text = formatResults(sample());
    for (std::size_t length = 0; length + 2 < text.size(); length += 97) {
        const std::string sentence = refusal(text.substr(0, length));
        EXPECT_NE(sentence, "accepted") << length;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
}

TEST(Results, RefusalNamesTheFieldAndItsValue) {
    Json json = sampleJson();
    json["schemaVersion"] = 1;
    EXPECT_EQ(refusal(json.dump()), "results.json: schemaVersion is 1, must be 2");

    json = sampleJson();
    json["measurements"][1].erase("effect");
    EXPECT_EQ(refusal(json.dump()), "results.json: measurements[1].effect is missing");

    json = sampleJson();
    json["measurements"][1]["colour"] = "red";
    EXPECT_EQ(refusal(json.dump()), "results.json: the key \"measurements[1].colour\" is unknown");

    json = sampleJson();
    json["measurements"][0]["width"] = -4;
    EXPECT_EQ(refusal(json.dump()),
              "results.json: measurements[0].width is -4, must be a whole number from 0 to 4294967295");

    json = sampleJson();
    json["machine"]["device"] = 7;
    EXPECT_EQ(refusal(json.dump()), "results.json: machine.device is 7, must be a string");

    json = sampleJson();
    json["measurements"][2]["effect"][1] = "fast";
    EXPECT_EQ(refusal(json.dump()), "results.json: measurements[2].effect[1] is \"fast\", must be a number");

    json = sampleJson();
    json["measurements"][0]["copy"].erase(5);
    EXPECT_EQ(refusal(json.dump()), "results.json: measurements[0].copy is [100,10.0,9.7,11.0,9.95], must be "
                                    "[count, median, p5, p95, low, high]");

    json = sampleJson();
    json["measurements"][0]["memory"] = 7;
    EXPECT_EQ(refusal(json.dump()), "results.json: measurements[0].memory is 7, must be an object");

    json = sampleJson();
    json["measurements"][2]["effect"][1] = 1e9;
    EXPECT_EQ(refusal(json.dump()), "results.json: measurements[2].effect is no summary of measured times");

    json = sampleJson();
    json["measurements"][1]["id"] = json["measurements"][0]["id"];
    EXPECT_NE(refusal(json.dump()).find("is given twice"), std::string::npos);
}

TEST(Results, KeepToTheSchemasRanges) {
    const std::tuple<const char*, Json, const char*> faults[] = {
        {"/measurements/0/coverage", 1.5, "measurements[0].coverage is 1.5, must be a number from 0 to 1"},
        {"/measurements/0/height", 0, "measurements[0].height is 0, must be a number from 1"},
        {"/measurements/0/effect/4", -1, "measurements[0].effect[4] is -1, must be a number from 0"},
        {"/measurements/0/effect/0", 0, "measurements[0].effect[0] is 0, must be a number from 1"},
        {"/measurements/1/error/psnr", 300, "measurements[1].error.psnr is 300, must be a number from 0 to 200"},
        {"/noiseFloors/0/share", -0.1, "noiseFloors[0].share is -0.1, must be a number from 0"},
        {"/suite", "guess", R"(suite is "guess", must be one of "thesis", "sweep", "pareto")"},
        {"/machine/kind", "abacus", R"(machine.kind is "abacus", must be one of "discrete")"}};
    for (const auto& [pointer, value, sentence] : faults) {
        Json json = sampleJson();
        json[Json::json_pointer(pointer)] = value;
        EXPECT_NE(refusal(json.dump()).find(sentence), std::string::npos) << refusal(json.dump());
    }
}

TEST(Results, ThatMakeNoSenseAreNotWritten) {
    Results results = sample();
    results.measurements[0].effect.median = -1;
    EXPECT_THROW(formatResults(results), std::invalid_argument);
}

TEST(Results, OfWhichAPassIsGivenTwiceAreNotWritten) {
    Results results = sample();
    results.measurements[0].passes.push_back(results.measurements[0].passes[0]);
    EXPECT_THROW(formatResults(results), std::invalid_argument);
}

TEST(Results, HaveALineForEachConfigurationAndNineDigits) {
    Results results = sample();
    results.measurements[1].effect = times(100.0 / 3);
    const std::string text = formatResults(results);
    EXPECT_NE(text.find("\"effect\":[100,33.3333333,32.3333333,36.6666667,33.1666667,33.5]"), std::string::npos)
        << text;
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = text.find("\n{\"id\":", at)) != std::string::npos; ++at) {
        ++lines;
    }
    EXPECT_EQ(lines, results.measurements.size() + results.noiseFloors.size());
}

TEST(Results, HaveTheLinesThroughTheirSeries) {
    Results results = sample();
    for (Measurement& measurement : results.measurements) {
        measurement.error.reset();
    }
    const Results read = parseResults(formatResults(results), "sample");
    EXPECT_EQ(read.fits, fitSeries(results.measurements));
    EXPECT_FALSE(read.fits.empty());
}

TEST(Results, SchemaDescribesTheFile) {
    std::ifstream file(NACRE_SOURCE_DIR "/docs/schemas/benchmark.schema.json");
    const Json schema = Json::parse(file);
    expectSchemaFits(schema, schema, sampleJson(), "results");
}

TEST(Csv, HasOneLinePerQuantityAndQuotesText) {
    const std::string csv = formatCsv(sample());
    const auto lines = std::count(csv.begin(), csv.end(), '\n');
    EXPECT_EQ(lines, 1 + 3 * (4 + 2));
    EXPECT_NE(csv.find("\"experiment 2/thesis/1280x720/radius 3, \"\"skin\"\"/3\",experiment 2,\"gallery, front\""),
              std::string::npos);
    EXPECT_NE(csv.find(",effect,100,300,291,330,"), std::string::npos);
}

TEST(Diff, OfARunWithItselfIsNothing) {
    const Comparison comparison = compare(sample(), sample());
    EXPECT_FALSE(comparison.regressed());
    EXPECT_EQ(comparison.changes.size(), 9u);
    EXPECT_TRUE(comparison.caution.empty());
    EXPECT_EQ(formatComparison(comparison), "the same within noise: 9 of 9 quantities\n");
}

TEST(Diff, FindsWhatGotSlower) {
    Results after = sample();
    after.measurements[1].effect = times(1.1 * after.measurements[1].effect.median);
    const Comparison comparison = compare(sample(), after);
    EXPECT_TRUE(comparison.regressed());
    const std::string text = formatComparison(comparison);
    EXPECT_NE(text.find("slower or less accurate: 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("effect 550.0 µs, was 500.0 µs: +10.0 % (noise 3.2 %)"), std::string::npos) << text;
    EXPECT_FALSE(compare(after, sample()).regressed()) << "faster is no regression";
}

TEST(Diff, GivesNoVerdictOnSingleFrames) {
    Results before = sample();
    Results after = sample();
    before.measurements[1].frame = summarize(std::vector{1000.0});
    after.measurements[1].frame = summarize(std::vector{2000.0});
    const Comparison comparison = compare(before, after);
    EXPECT_FALSE(comparison.regressed());
    EXPECT_NE(formatComparison(comparison).find("measured too seldom to tell: 1\n"), std::string::npos);
}

TEST(Diff, TakesMoreForNoiseTheMoreItCompares) {
    // The sample has one floor in each run, of 2 %, and 6 times to compare: √(ln 6 / ln 2) = 1.61 times as much.
    Results after = sample();
    after.measurements[1].effect = times(1.031 * after.measurements[1].effect.median);
    EXPECT_FALSE(compare(sample(), after).regressed());
    after.measurements[1].effect = times(1.034 * sample().measurements[1].effect.median);
    EXPECT_TRUE(compare(sample(), after).regressed());
    // As many floors as times: no more than the floor.
    Results before = sample();
    before.noiseFloors.assign(3, before.noiseFloors[0]);
    after.noiseFloors = before.noiseFloors;
    after.measurements[1].effect = times(1.021 * sample().measurements[1].effect.median);
    EXPECT_TRUE(compare(before, after).regressed());
}

TEST(Diff, KeepsToTheLargerNoiseFloor) {
    Results after = sample();
    after.measurements[1].effect = times(1.1 * after.measurements[1].effect.median);
    after.measurements[0].noise = 0.15; // of any configuration
    EXPECT_FALSE(compare(sample(), after).regressed());
}

TEST(Diff, FindsWhatGotLessAccurate) {
    Results after = sample();
    after.measurements[2].error->psnr -= 0.5;
    EXPECT_TRUE(compare(sample(), after).regressed());
    after.measurements[2].error->psnr += 0.45;
    EXPECT_FALSE(compare(sample(), after).regressed());
}

TEST(Diff, ListsWhatOnlyOneRunHas) {
    Results after = sample();
    after.measurements[0].id = "new";
    const Comparison comparison = compare(sample(), after);
    EXPECT_EQ(comparison.added, std::vector<std::string>{"new"});
    ASSERT_EQ(comparison.removed.size(), 1u);
    EXPECT_EQ(comparison.removed[0], sample().measurements[0].id);
}

TEST(Diff, WarnsAboutAnotherDeviceAndRefusesRunsWithNothingInCommon) {
    Results after = sample();
    after.machine.device = "Another device";
    EXPECT_NE(compare(sample(), after).caution.find("Another device"), std::string::npos);
    after.measurements.clear();
    EXPECT_THROW(compare(sample(), after), std::invalid_argument);
}
