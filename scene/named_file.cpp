#include "scene/named_file.hpp"

#include "scene/json_text.hpp"

#include <algorithm>
#include <cctype>

namespace nacre::scene {
namespace {

namespace fs = std::filesystem;

/// A path, or what is wrong with the reference.
struct Found {
    fs::path path;
    std::string fault;
};

/// Whether `path` is in `folder` or below; both without links.
bool isBelow(const fs::path& path, const fs::path& folder) {
    const auto [end, inPath] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() && inPath != path.end();
}

Found find(const fs::path& owner, std::string reference) {
    if (reference.find('\0') != std::string::npos) {
        return {{}, "has a character that file names cannot have"};
    }
    std::ranges::replace(reference, '\\', '/');
    const fs::path name = fs::path(reference).lexically_normal(); // as in a uri: "a/.." is nothing, whatever a is
    if (reference.empty() || name.is_absolute()) {
        return {{}, reference.empty() ? "is empty" : "is not a path relative to the file that names it"};
    }
    const fs::path given = owner.parent_path() / name;
    std::error_code error;
    const fs::path folder = fs::canonical(owner.has_parent_path() ? owner.parent_path() : fs::path("."), error);
    const fs::path target = error ? fs::path() : fs::canonical(given, error);
    if (error) {
        return {{},
                error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory
                    ? "does not exist"
                    : "cannot be read: " + error.message()};
    }
    if (!isBelow(target, folder)) {
        return {{}, "lies outside the folder of the file that names it"};
    }
    if (!fs::is_regular_file(target, error)) {
        return {{}, "is not a regular file"};
    }
    return {given, ""};
}

} // namespace

fs::path findNamedFile(const fs::path& owner, const std::string& reference, const std::string& where) {
    Found found = find(owner, reference);
    if (!found.fault.empty()) {
        throw SceneError(where + " " + shorten(reference) + " " + found.fault);
    }
    return std::move(found.path);
}

std::string faultOfNamedFile(const fs::path& owner, const std::string& reference) {
    return find(owner, reference).fault;
}

fs::path tryNamedFile(const fs::path& owner, const std::string& reference) {
    return find(owner, reference).path;
}

std::span<const std::uint8_t> NamedFiles::read(const std::string& reference, const std::string& where) {
    const fs::path path = findNamedFile(owner_, reference, where);
    std::error_code error;
    const auto [entry, isNew] = files_.try_emplace(fs::canonical(path, error));
    if (isNew) {
        entry->second = readFile(path);
        totalBytes_ += entry->second.size();
        if (totalBytes_ > maxFileBytes) {
            throw SceneError(owner_.string() + ": names files of more than " + std::to_string(maxFileBytes >> 20) +
                             " MiB, the most that is read");
        }
    }
    return entry->second;
}

std::string extensionOf(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

std::vector<std::string> NamedFiles::paths() const {
    std::vector<std::string> result;
    for (const auto& [path, bytes] : files_) {
        result.push_back(path.string());
    }
    return result;
}

} // namespace nacre::scene
