// Runs the command `nacre` as a user would, and looks at what it leaves behind.
#pragma once

#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nacre::test {

struct Outcome {
    int exitCode = -1; ///< 128 + the signal's number when the command was killed
    std::string output;
    std::string error;
};

using Environment = std::vector<std::pair<std::string, std::string>>;

/// `nacre` with these arguments in `folder`, with `environment` on top of ours. To be waited for.
class RunningNacre {
public:
    RunningNacre(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 const Environment& environment = {});
    void send(int signal) const;
    /// What it has said on standard error until now.
    std::string error() const;
    Outcome wait() const;

private:
    tests::TemporaryFolder logs_;
    pid_t process_;
};

/// Runs it to its end.
Outcome runNacre(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 const Environment& environment = {});

/// What the command said on standard error besides its progress lines and notes on the scene.
std::vector<std::string> complaints(const Outcome& outcome);

/// Asserts the exit code and that standard error is one sentence that contains every one of `parts`.
void expectComplaint(const Outcome& outcome, int exitCode, const std::vector<std::string>& parts);

std::string readText(const std::filesystem::path& file);
void writeText(const std::filesystem::path& file, const std::string& text);

/// A Wavefront OBJ cube of one unit.
extern const char* const cubeObj;

/// A tetrahedron of 100 units, which are taken for centimetres, with a note.
extern const char* const largeObj;

/// A test with a folder of its own, removed afterwards.
class CommandTest : public testing::Test {
protected:
    Outcome run(const std::vector<std::string>& arguments, const Environment& environment = {}) const {
        return runNacre(arguments, folder(), environment);
    }
    /// Names of the files in the folder, sorted.
    std::vector<std::string> files() const;
    const std::filesystem::path& folder() const { return folder_.path; }

private:
    tests::TemporaryFolder folder_;
};

} // namespace nacre::test
