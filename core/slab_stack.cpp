#include "nacre/slab_stack.hpp"

#include "fault.hpp"

#include <cmath>
#include <limits>

namespace nacre {
namespace {

constexpr Range thicknessRange{1e-6, std::numeric_limits<double>::infinity(), " mm"};

std::string findFault(const Slab& slab, bool isLast) {
    if (slab.skin) {
        if (auto fault = nacre::findFault(*slab.skin); !fault.empty()) {
            return "skin." + fault;
        }
    }
    if (auto fault = nacre::findFault(slab.medium); !fault.empty()) {
        return fault;
    }
    if (auto fault = findFault("thickness", slab.thickness, thicknessRange); !fault.empty()) {
        return fault;
    }
    return std::isinf(slab.thickness) && !isLast ? "thickness is infinite, which only the last may be" : "";
}

} // namespace

Slab makeSkinSlab(const SkinContent& content, double thickness) {
    return {{"skin", skinReducedScattering(), skinAbsorption(content), tissueRefractiveIndex, {0.8, 0.8, 0.8}},
            thickness,
            content};
}

std::string findFault(std::span<const Slab> slabs) {
    if (slabs.empty() || slabs.size() > maxLayers) {
        return "slabs has " + std::to_string(slabs.size()) + " entries, must have 1 to " + std::to_string(maxLayers);
    }
    for (std::size_t i = 0; i < slabs.size(); ++i) {
        if (const std::string fault = findFault(slabs[i], i + 1 == slabs.size()); !fault.empty()) {
            return indexed("slabs", i) + "." + fault;
        }
    }
    return {};
}

} // namespace nacre
