#include "bench/techniques.hpp"

namespace nacre::bench {

std::vector<NacreTechnique> realTimeTechniques() {
    std::vector<NacreTechnique> techniques{NACRE_TECHNIQUE_BANK};
    std::uint32_t count = 0;
    nacreGetTechniques(&count, nullptr);
    std::vector<NacreTechnique> all(count);
    nacreGetTechniques(&count, all.data());
    for (const NacreTechnique technique : all) {
        if (technique != NACRE_TECHNIQUE_BRUTE && technique != NACRE_TECHNIQUE_BANK) {
            techniques.push_back(technique);
        }
    }
    return techniques;
}

} // namespace nacre::bench
