// Runs an importer in a child process, so that a damaged file that makes a library crash, hang or eat all memory is an
// error like any other.
#pragma once

#include "scene/scene.hpp"

#include <functional>

namespace nacre::scene {

/// What the child may use.
struct ImportLimits {
    unsigned seconds = 3;             ///< of processor time; three times as many on the clock
    std::uint64_t bytes = 1ull << 31; ///< of memory on top of what this process has mapped
};

/// Limits for a file of this size: 3 s and 2 s a MiB; 2 GiB and 64 times the file.
ImportLimits limitsFor(std::uint64_t fileBytes);

/// read()'s result, from a child process. A SceneError thrown by read() is thrown here; a child that crashes or exceeds
/// its limits is a SceneError that begins with `name`. Materials and the environment do not come across.
Scene runIsolated(const std::string& name, const ImportLimits& limits, const std::function<Scene()>& read);

} // namespace nacre::scene
