#include "app/material_source.hpp"

#include "app/command.hpp"
#include "nacre/files.hpp"
#include "nacre/presets.hpp"

#include <system_error>

namespace nacre::app {

std::filesystem::path materialFile(const std::string& nameOrFile) {
    return findPreset(nameOrFile) != nullptr ? std::filesystem::path() : std::filesystem::path(nameOrFile);
}

Material readMaterial(const std::string& nameOrFile) {
    if (const Material* preset = findPreset(nameOrFile)) {
        return *preset;
    }
    const std::filesystem::path file = nameOrFile;
    std::error_code ignored;
    if (!file.has_extension() && !file.has_parent_path() && !std::filesystem::exists(file, ignored)) {
        throw UsageError("there is no material '" + nameOrFile +
                         "', neither a preset (see `nacre material list`) nor a file");
    }
    return loadMaterial(file);
}

} // namespace nacre::app
