// Errors inside the effect are exceptions; the C border (guard.hpp) turns them into a code and a message.
#pragma once

#include "contract/vulkan_names.hpp"
#include "nacre/nacre.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace nacre::effect {

/// A result code and one sentence that names the field and its value.
struct EffectError : std::runtime_error {
    EffectError(NacreResult code, const std::string& message) : std::runtime_error(message), result(code) {}
    NacreResult result;
};

/// The name of a field, put together without an allocation: recording makes one for every check.
class FieldName {
public:
    FieldName(std::string_view text) { append(text); } // NOLINT: every text is a name
    FieldName(const char* text) : FieldName(std::string_view(text)) {}
    FieldName operator+(std::string_view text) const {
        FieldName longer = *this;
        longer.append(text);
        return longer;
    }
    FieldName at(std::uint32_t index) const {
        std::array<char, 10> digits;
        const char* end = std::to_chars(digits.data(), digits.data() + digits.size(), index).ptr;
        return *this + "[" + std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())) + "]";
    }
    friend std::ostream& operator<<(std::ostream& stream, const FieldName& name) {
        return stream << std::string_view(name.text_.data(), name.size_);
    }

private:
    void append(std::string_view text) { size_ += text.copy(text_.data() + size_, text_.size() - size_); }
    std::array<char, 96> text_;
    std::size_t size_ = 0;
};

/// Throws an EffectError whose message is the parts, one after the other.
template <typename... Parts> [[noreturn]] void fail(NacreResult result, const Parts&... parts) {
    std::ostringstream message;
    (message << ... << parts);
    throw EffectError(result, message.str());
}

/// Throws when a Vulkan call did not succeed; `call` is its name.
inline void check(VkResult result, const char* call) {
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
        fail(NACRE_ERROR_OUT_OF_MEMORY, call, " ran out of ", result == VK_ERROR_OUT_OF_HOST_MEMORY ? "host" : "device",
             " memory");
    }
    if (result != VK_SUCCESS) {
        fail(NACRE_ERROR_VULKAN, call, " returned ", ResultName{result});
    }
}

} // namespace nacre::effect
