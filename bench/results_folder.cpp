#include "bench/results_folder.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace nacre::bench {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& reason) {
    throw std::runtime_error(folder.string() + ": " + reason);
}

} // namespace

ResultsFolder::ResultsFolder(const std::filesystem::path& folder) : folder_(folder.lexically_normal()) {
    if (!folder_.has_filename()) { // "results/"
        folder_ = folder_.parent_path();
    }
    make();
    lock();
    std::string draft = (folder_ / ".nacre-bench-XXXXXX").string();
    if (mkdtemp(draft.data()) == nullptr) {
        const std::string reason = std::generic_category().message(errno);
        close(descriptor_);
        removeMade();
        refuse(folder_, "cannot be written to: " + reason);
    }
    draft_ = draft;
}

ResultsFolder::~ResultsFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(draft_, ignored);
    removeMade();
    close(descriptor_);
}

void ResultsFolder::make() {
    std::error_code error;
    for (std::filesystem::path path = folder_; !path.empty() && !std::filesystem::exists(path, error);
         path = path.parent_path()) {
        firstMade_ = path;
    }
    std::filesystem::create_directories(folder_, error);
    if (error) {
        removeMade();
        refuse(folder_, "cannot be made: " + error.message());
    }
}

// The lock ends with the process, however it ends. A file system without locks, as some network ones are, shares.
void ResultsFolder::lock() {
    descriptor_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) {
        refuse(folder_, "cannot be opened: " + std::generic_category().message(errno));
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(descriptor_);
        refuse(folder_, "another benchmark is writing its results here");
    }
}

// From the inside out, and only those that nobody has put anything into.
void ResultsFolder::removeMade() {
    if (firstMade_.empty()) {
        return;
    }
    std::error_code error;
    for (std::filesystem::path path = folder_;; path = path.parent_path()) {
        if (!std::filesystem::remove(path, error) || path == firstMade_) {
            return;
        }
    }
}

void ResultsFolder::publish() {
    for (const auto& entry : std::filesystem::directory_iterator(draft_)) {
        std::filesystem::rename(entry.path(), folder_ / entry.path().filename());
    }
    firstMade_.clear();
}

} // namespace nacre::bench
