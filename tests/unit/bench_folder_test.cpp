// The folder that a benchmark takes for its results: what it leaves, what it leaves alone, and who may have it.
#include "bench/results_folder.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

using nacre::bench::ResultsFolder;

namespace {

class ResultsFolderTest : public testing::Test {
protected:
    static void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

    static std::string read(const std::filesystem::path& file) {
        std::string text;
        std::getline(std::ifstream(file), text);
        return text;
    }

    static std::string refusal(const std::filesystem::path& place) {
        try {
            const ResultsFolder results(place);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "taken";
    }

    const nacre::tests::TemporaryFolder temporary;
    const std::filesystem::path folder = temporary.path / "runs" / "results";
};

TEST_F(ResultsFolderTest, HoldsWhatIsPublishedAndNothingElse) {
    {
        ResultsFolder results(folder);
        write(results.draft() / "results.json", "new");
        EXPECT_FALSE(std::filesystem::exists(folder / "results.json")) << "before it is whole";
        results.publish();
    }
    EXPECT_EQ(read(folder / "results.json"), "new");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST_F(ResultsFolderTest, ThatWasMadeGoesWithTheRun) {
    {
        const ResultsFolder results(folder / ""); // as a shell completes it
        write(results.draft() / "picture.jpg", "half");
    }
    EXPECT_EQ(temporary.fileCount(), 0u) << "not the folders above it either";
}

TEST_F(ResultsFolderTest, KeepsWhatOthersPutIntoIt) {
    {
        const ResultsFolder results(folder);
        write(results.draft() / "picture.jpg", "half");
        write(folder / "other", "somebody's");
    }
    EXPECT_EQ(read(folder / "other"), "somebody's");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST_F(ResultsFolderTest, KeepsEarlierResultsUntilThereAreNewOnes) {
    std::filesystem::create_directories(folder);
    write(folder / "results.json", "old");
    {
        const ResultsFolder results(folder);
        write(results.draft() / "results.json", "new");
    }
    EXPECT_EQ(read(folder / "results.json"), "old");
    ResultsFolder results(folder);
    write(results.draft() / "results.json", "new");
    results.publish();
    EXPECT_EQ(read(folder / "results.json"), "new");
}

TEST_F(ResultsFolderTest, IsOneRunsAtATime) {
    {
        const ResultsFolder results(folder);
        EXPECT_EQ(refusal(folder), folder.string() + ": another benchmark is writing its results here");
        EXPECT_TRUE(std::filesystem::exists(results.draft()));
    }
    EXPECT_EQ(refusal(folder), "taken");
}

TEST_F(ResultsFolderTest, ThatCannotBeMadeLeavesNothing) {
    write(temporary.path / "file", "");
    const std::filesystem::path below = temporary.path / "file" / "results";
    EXPECT_EQ(refusal(below).find(below.string() + ": cannot be made"), 0u) << refusal(below);
    EXPECT_EQ(refusal(temporary.path / "file").find((temporary.path / "file").string() + ": cannot be"), 0u);
    EXPECT_EQ(temporary.fileCount(), 1u);
}

} // namespace
