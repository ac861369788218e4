// The effect without its baselines.
#include "baselines/baselines.hpp"

#include "contract/effect_error.hpp"

namespace nacre::effect {

bool takesBakedKernel(const Context&, const NacreScatterInfo&) {
    return false; // its technique has been refused
}

void bakeThesisKernel(Context&, std::uint32_t, std::uint32_t) {
    fail(NACRE_ERROR_UNSUPPORTED,
         "nacreBakeThesisKernel: this library was built without baselines (NACRE_BUILD_BASELINES)");
}

bool takesThesisTransmittance(const NacreTransmitInfo& info) {
    if (info.baselines && info.baselines->thesisTransmittance) {
        fail(NACRE_ERROR_UNSUPPORTED, "NacreBaselineSettings::thesisTransmittance is ",
             info.baselines->thesisTransmittance,
             ", but this library was built without baselines (NACRE_BUILD_BASELINES)");
    }
    return false;
}

} // namespace nacre::effect
