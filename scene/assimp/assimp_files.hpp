// The files that Assimp opens.
#pragma once

#include "scene/named_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <set>

namespace nacre::scene {

/// Lets Assimp read the model and what the model may name (`findNamedFile`): anything else is not there.
class AssimpFiles : public Assimp::DefaultIOSystem {
public:
    explicit AssimpFiles(std::filesystem::path model) : model_(std::move(model)) {}

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// What was opened, apart from the model.
    const std::vector<std::string>& inputs() const { return inputs_; }
    /// What was left out or is missing, a sentence each.
    std::vector<std::string> notes() const;

private:
    /// The path to open, empty for none.
    std::filesystem::path allowed(const char* file) const;

    std::filesystem::path model_;
    std::vector<std::string> inputs_;
    std::vector<std::string> missingLibraries_;
    std::set<std::string> usedMaterials_;
    std::set<std::string> knownMaterials_;
    bool hasLibrary_ = false;
    bool hasTextureOptions_ = false;
    bool hasJoinedObjects_ = false;
};

} // namespace nacre::scene
