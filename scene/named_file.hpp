// Files that a file names. A file from a stranger may name what it likes; what is read lies beside it or below.
#pragma once

#include "scene/scene.hpp"

#include <map>
#include <span>

namespace nacre::scene {

/// The path of `reference`, as the file `owner` writes it. Backslashes separate folders as slashes do. What it leads
/// to, once "..", links and the like are followed, has to be a regular file in the owner's folder or below it. Throws
/// SceneError: "`where` "REFERENCE" does not exist", or whatever else is wrong with it.
std::filesystem::path findNamedFile(const std::filesystem::path& owner, const std::string& reference,
                                    const std::string& where);

/// What findNamedFile would say of the reference: "does not exist", or empty when nothing is wrong.
std::string faultOfNamedFile(const std::filesystem::path& owner, const std::string& reference);

/// findNamedFile, with an empty path in place of an error.
std::filesystem::path tryNamedFile(const std::filesystem::path& owner, const std::string& reference);

/// With its dot, in small letters; empty where there is none.
std::string extensionOf(const std::filesystem::path& file);

/// Reads each file that a file names once, however often it is named.
class NamedFiles {
public:
    explicit NamedFiles(std::filesystem::path owner) : owner_(std::move(owner)) {}

    /// The file's bytes, for as long as this object lives. Throws what findNamedFile and readFile throw, and for more
    /// than maxFileBytes in all files together.
    std::span<const std::uint8_t> read(const std::string& reference, const std::string& where);

    /// What was read.
    std::vector<std::string> paths() const;
    std::uint64_t totalBytes() const { return totalBytes_; }

private:
    std::filesystem::path owner_;
    std::map<std::filesystem::path, std::vector<std::uint8_t>> files_; ///< by path without links
    std::uint64_t totalBytes_ = 0;
};

} // namespace nacre::scene
