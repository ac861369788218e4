// The border between exceptions and result codes.
#pragma once

#include "contract/effect_error.hpp"

#include <new>
#include <utility>

namespace nacre::effect {

/// Runs `body`; what it throws becomes a result code and a message.
template <typename Body> NacreResult guard(NacreMessageCallback callback, void* userData, Body&& body) noexcept {
    const auto report = [&](NacreResult result, const char* message) {
        if (callback) {
            callback(NACRE_SEVERITY_ERROR, message, userData);
        }
        return result;
    };
    try {
        body();
        return NACRE_SUCCESS;
    } catch (const EffectError& error) {
        return report(error.result, error.what());
    } catch (const std::bad_alloc&) {
        return report(NACRE_ERROR_OUT_OF_MEMORY, "out of host memory");
    } catch (const std::exception& exception) {
        return report(NACRE_ERROR_INVALID_ARGUMENT, exception.what());
    }
}

} // namespace nacre::effect
