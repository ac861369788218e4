// How much device memory the parts of the renderer take. Internal to the renderer.
#pragma once

#include "renderer/frame_report.hpp"
#include "renderer/vulkan/open_device.hpp"

#include <numeric>
#include <vector>

namespace nacre::renderer {

/// Makes a part of the renderer and notes what it allocates under `name`.
template <typename Make>
auto metered(const Gpu& gpu, std::vector<MemoryUse>& memory, const char* name, const Make& make) {
    const auto allocated = [&] {
        return std::accumulate(gpu.allocatedBytes.begin(), gpu.allocatedBytes.end(), std::uint64_t{0});
    };
    struct Note {
        const decltype(allocated)& now;
        std::vector<MemoryUse>& memory;
        const char* name;
        std::uint64_t before;
        ~Note() { memory.push_back({name, now() - before}); }
    } const note{allocated, memory, name, allocated()};
    return make();
}

} // namespace nacre::renderer
