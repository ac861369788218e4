// The one table of techniques. It is in the order of NacreTechnique, then transmission and composing.
#include "technique.hpp"

namespace nacre::effect {

extern const Technique separableTechnique;
extern const Technique bankTechnique;
extern const Technique burleyTechnique;
extern const Technique bankSurfacesTechnique;
#if NACRE_BASELINES
extern const Technique bruteTechnique;
extern const Technique thesisTechnique;
#else
static const Technique bruteTechnique{};
static const Technique thesisTechnique{};
#endif

const std::array<const Technique*, techniqueCount> techniques{
    &separableTechnique, &bruteTechnique,        &bankTechnique,     &burleyTechnique,
    &thesisTechnique,    &bankSurfacesTechnique, &transmitTechnique, &composeTechnique};

IntermediateSet Technique::uses() const {
    IntermediateSet set = 0;
    for (const std::span<const Pass> part : {passes, materialPasses}) {
        for (const Pass& pass : part) {
            set |= pass.reads | pass.writes;
        }
    }
    return set;
}

const std::array<Intermediate, maxIntermediates>& intermediates() {
    static const auto all = [] {
        std::array<Intermediate, maxIntermediates> result{};
        for (const Technique* technique : techniques) {
            for (const Intermediate& one : technique->intermediates) {
                result[one.number] = one;
            }
        }
        return result;
    }();
    return all;
}

} // namespace nacre::effect
