// A folder of a test's own.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>

namespace nacre::tests {

/// A new, empty folder, removed with all that is in it when this ends.
class TemporaryFolder {
public:
    TemporaryFolder() : path(make()) {}
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(path); }

    std::size_t fileCount() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator()));
    }

    const std::filesystem::path path;

private:
    static std::filesystem::path make() {
        std::string name = (std::filesystem::temp_directory_path() / "nacre-test-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("no temporary folder");
        }
        return name;
    }
};

} // namespace nacre::tests
