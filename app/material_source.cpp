#include "app/material_source.hpp"

#include "app/command.hpp"
#include "nacre/files.hpp"
#include "nacre/presets.hpp"

#include <filesystem>

namespace nacre::app {

Material readMaterial(const std::string& nameOrFile) {
    if (const Material* preset = findPreset(nameOrFile)) {
        return *preset;
    }
    const std::filesystem::path file = nameOrFile;
    if (!file.has_extension() && !file.has_parent_path() && !std::filesystem::exists(file)) {
        throw UsageError("there is no material '" + nameOrFile +
                         "', neither a preset (see `nacre material list`) nor a file");
    }
    return loadMaterial(file);
}

} // namespace nacre::app
