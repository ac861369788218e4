#include "scene/assimp/assimp_files.hpp"

#include <algorithm>

namespace nacre::scene {

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
    if (path.empty() || std::string_view(mode).find_first_of("wa+") != std::string_view::npos) {
        return nullptr;
    }
    if (path != model_) {
        inputs_.push_back(path.string());
    }
    return Assimp::DefaultIOSystem::Open(path.c_str(), mode);
}

} // namespace nacre::scene
