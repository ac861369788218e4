// The folder that a benchmark leaves its results in.
#pragma once

#include <filesystem>

namespace nacre::bench {

/// Takes a folder for one run. What the run writes stands in a folder within it until it is whole; nothing else in the
/// folder is touched. Unless the run publishes, it leaves everything as it was.
class ResultsFolder {
public:
    /// Makes the folder where there is none. Throws std::runtime_error naming it where it cannot be made or written to,
    /// or another run has it.
    explicit ResultsFolder(const std::filesystem::path& folder);
    ResultsFolder(const ResultsFolder&) = delete;
    ~ResultsFolder();

    /// Where the run's files go until they are published.
    const std::filesystem::path& draft() const { return draft_; }
    /// Moves them into the folder, in place of earlier ones of the same names, and keeps the folder.
    void publish();

private:
    void make();
    void lock();
    void removeMade();

    std::filesystem::path folder_;
    std::filesystem::path draft_;
    std::filesystem::path firstMade_; ///< the outermost folder that did not exist; empty where all did
    int descriptor_ = -1;             ///< of the folder, locked
};

} // namespace nacre::bench
