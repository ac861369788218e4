#include "vulkan/technique_choice.hpp"

#include "contract/validation.hpp"

namespace nacre::effect {

std::size_t scatterTechniqueIndex(const Context& context, NacreTechnique technique, const char* field) {
    const NacreTechnique chosen = technique == NACRE_TECHNIQUE_DEFAULT ? defaultTechnique : technique;
    if (chosen < 1 || static_cast<std::size_t>(chosen) > scatterTechniqueCount) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", static_cast<int>(technique), ", must be a NacreTechnique");
    }
    const auto index = static_cast<std::size_t>(chosen) - 1;
    checkBuilt(index, field);
    if (!context.enabled[index]) {
        fail(NACRE_ERROR_INVALID_ARGUMENT, field, " is ", nacreTechniqueString(chosen),
             ", which is not among NacreContextInfo::techniques");
    }
    return index;
}

std::size_t chosenTechniqueIndex(const Context& context, std::size_t asked, const MaterialTable::Summary& materials) {
    constexpr std::size_t bank = NACRE_TECHNIQUE_BANK - 1;
    constexpr std::size_t bankSurfaces = NACRE_TECHNIQUE_BANK_SURFACES - 1;
    return asked == bank && materials.haveSecondSurfaces && context.enabled[bankSurfaces] ? bankSurfaces : asked;
}

} // namespace nacre::effect
