#include "scene/assimp/assimp_files.hpp"

#include "nacre/files.hpp"
#include "scene/assimp/assimp_text.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <assimp/MemoryIOWrapper.h>

namespace nacre::scene {
namespace {

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
    if (extension == ".mtl") {
        hasLibrary_ = true;
        hasTextureOptions_ = hasTextureOptions_ || placesTextures(text);
    }
    return text.empty() ? nullptr : new TextStream(std::move(text));
}

std::vector<std::string> AssimpFiles::notes() const {
    std::vector<std::string> notes;
    if (!hasLibrary_ && !missingLibraries_.empty()) {
        notes.push_back(model_.string() + ": names \"" + missingLibraries_.front() +
                        "\", which is not there; its materials are left out");
    }
    if (hasTextureOptions_) {
        notes.push_back(model_.string() + ": its materials scale or move textures (-s, -o), which is not read");
    }
    return notes;
}

} // namespace nacre::scene
