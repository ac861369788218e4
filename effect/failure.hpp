// Errors inside the effect are exceptions; the C border (guard in context.hpp) turns them into a code and a message.
#pragma once

#include "nacre/nacre.h"

#include <sstream>
#include <stdexcept>

namespace nacre::effect {

/// A result code and one sentence that names the field and its value.
struct Failure : std::runtime_error {
    Failure(NacreResult code, const std::string& message) : std::runtime_error(message), result(code) {}
    NacreResult result;
};

/// Throws a Failure whose message is the parts, one after the other.
template <typename... Parts> [[noreturn]] void fail(NacreResult result, const Parts&... parts) {
    std::ostringstream message;
    (message << ... << parts);
    throw Failure(result, message.str());
}

/// Throws when a Vulkan call did not succeed; `call` is its name.
inline void check(VkResult result, const char* call) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        fail(NACRE_ERROR_OUT_OF_MEMORY, call, " ran out of ", result == VK_ERROR_OUT_OF_HOST_MEMORY ? "host" : "device",
             " memory");
    }
    if (result != VK_SUCCESS) {
        fail(NACRE_ERROR_VULKAN, call, " returned VkResult ", static_cast<int>(result));
    }
}

} // namespace nacre::effect
