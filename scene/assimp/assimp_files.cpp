#include "scene/assimp/assimp_files.hpp"

#include "core/files/quoted_text.hpp"
#include "nacre/files.hpp"
#include "scene/assimp/assimp_text.hpp"
#include "scene/json_text.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <assimp/MemoryIOWrapper.h>

namespace nacre::scene {
namespace {

/// Of an OBJ. The time that Assimp takes grows with the square of their number: a minute for a hundred thousand.
constexpr std::size_t mostObjects = 20'000;

/// A stream that owns what it reads.
class TextStream : public Assimp::MemoryIOStream {
public:
    explicit TextStream(std::vector<std::uint8_t> text)
        : MemoryIOStream(text.data(), text.size()), text_(std::move(text)) {}

private:
    std::vector<std::uint8_t> text_; // whose bytes stay where they are when it is moved
};

} // namespace

std::filesystem::path AssimpFiles::allowed(const char* file) const {
    if (file == model_) {
        return model_;
    }
    // Readers put the model's folder before a name, or leave it out.
    std::filesystem::path name = file;
    if (const auto folder = model_.parent_path(); !folder.empty()) {
        const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), name.begin(), name.end());
        if (end == folder.end()) {
            std::filesystem::path below;
            std::for_each(rest, name.end(), [&](const std::filesystem::path& part) { below /= part; });
            name = below;
        }
    }
    return tryNamedFile(model_, name.string());
}

bool AssimpFiles::Exists(const char* file) const {
    return !allowed(file).empty();
}

Assimp::IOStream* AssimpFiles::Open(const char* file, const char* mode) {
    const std::filesystem::path path = allowed(file);
    if (path.empty() && extensionOf(file) == ".mtl") {
        missingLibraries_.push_back(std::filesystem::path(file).filename().string());
    }
    if (path.empty() || std::string_view(mode).find_first_of("wa+") != std::string_view::npos) {
        return nullptr;
    }
    if (path != model_) {
        inputs_.push_back(path.string());
    }
    const std::string extension = extensionOf(path);
    if (!isAssimpText(extension)) {
        return Assimp::DefaultIOSystem::Open(path.c_str(), mode);
    }
    std::vector<std::uint8_t> text = readFile(path);
    clearUp(text, extension);
    if (extension == ".obj") {
        usedMaterials_ = namesAfter("usemtl", text);
        hasJoinedObjects_ = joinObjects(text, mostObjects);
    } else if (extension == ".mtl") {
        hasLibrary_ = true;
        knownMaterials_.merge(namesAfter("newmtl", text));
        hasTextureOptions_ = hasTextureOptions_ || placesTextures(text);
    }
    return text.empty() ? nullptr : new TextStream(std::move(text));
}

std::vector<std::string> AssimpFiles::notes() const {
    std::vector<std::string> notes;
    if (!hasLibrary_ && !missingLibraries_.empty()) {
        notes.push_back(model_.string() + ": names " + inQuotes(missingLibraries_.front()) +
                        ", which is not there; its materials are left out");
    }
    std::vector<std::string> unknown;
    std::ranges::set_difference(usedMaterials_, knownMaterials_, std::back_inserter(unknown));
    if (hasLibrary_ && !unknown.empty()) {
        const std::string more = unknown.size() > 1 ? " and " + std::to_string(unknown.size() - 1) + " more" : "";
        notes.push_back(model_.string() + ": uses the material " + shorten(unknown.front()) + more +
                        ", which no library has; its faces are grey");
    }
    if (hasTextureOptions_) {
        notes.push_back(model_.string() + ": its materials scale or move textures (-s, -o), which is not read");
    }
    if (hasJoinedObjects_) {
        notes.push_back(model_.string() + ": has more than " + std::to_string(mostObjects) +
                        " objects and groups, which are read as one");
    }
    return notes;
}

} // namespace nacre::scene
