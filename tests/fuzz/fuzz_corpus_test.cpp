// The corpora of the fuzzers through what the fuzzers call, as they are and damaged: a run without libFuzzer, for every
// compiler. `scripts/dev fuzz` looks further.
#include "tests/fuzz/fuzz_entries.hpp"

#include "nacre/files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

using namespace nacre;
namespace fs = std::filesystem;

namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<fs::path> corpusOf(const fuzz::Entry& entry) {
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(fs::path(NACRE_SOURCE_DIR) / "tests/fuzz/corpus" / entry.name)) {
        files.push_back(file.path());
    }
    std::ranges::sort(files);
    return files;
}

class FuzzCorpus : public testing::TestWithParam<fuzz::Entry> {};

/// One to four changes: a byte, a run of bytes taken out or repeated, an end cut off.
Bytes damaged(Bytes bytes, std::mt19937& random) {
    const auto below = [&](std::size_t limit) { return random() % std::max<std::size_t>(limit, 1); };
    for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
        const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
        const auto end = at + static_cast<std::ptrdiff_t>(below(std::min<std::size_t>(bytes.end() - at, 16)));
        switch (below(5)) {
        case 0:
            *at = static_cast<std::uint8_t>(random());
            break;
        case 1:
            *at ^= static_cast<std::uint8_t>(1u << below(8));
            break;
        case 2:
            bytes.erase(at, end);
            break;
        case 3: {
            const Bytes run(at, end);
            bytes.insert(at, run.begin(), run.end());
            break;
        }
        default:
            bytes.erase(at, bytes.end());
        }
    }
    return bytes;
}

TEST_P(FuzzCorpus, IsReadOrRefused) {
    const std::vector<fs::path> files = corpusOf(GetParam());
    EXPECT_GE(files.size(), 3u);
    for (const fs::path& file : files) {
        SCOPED_TRACE(file);
        GetParam().read(readFile(file));
    }
}

class DamagedCorpus : public testing::TestWithParam<fuzz::Entry> {};

TEST_P(DamagedCorpus, IsReadOrRefused) {
    std::mt19937 random(1);
    for (const fs::path& file : corpusOf(GetParam())) {
        SCOPED_TRACE(file);
        const Bytes bytes = readFile(file);
        for (int i = 0; i < 5; ++i) {
            GetParam().read(damaged(bytes, random));
        }
    }
}

/// Without the one that starts a process for each file and gives it seconds: import_test damages models.
std::vector<fuzz::Entry> inThisProcess() {
    std::vector<fuzz::Entry> result(fuzz::entries().begin(), fuzz::entries().end());
    std::erase_if(result, [](const fuzz::Entry& entry) { return std::string_view(entry.name) == "assimp"; });
    return result;
}

std::string nameOf(const testing::TestParamInfo<fuzz::Entry>& tested) {
    return tested.param.name;
}

INSTANTIATE_TEST_SUITE_P(All, FuzzCorpus, testing::ValuesIn(fuzz::entries().begin(), fuzz::entries().end()), nameOf);
INSTANTIATE_TEST_SUITE_P(All, DamagedCorpus, testing::ValuesIn(inThisProcess()), nameOf);

} // namespace
