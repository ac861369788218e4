// nacre::core by itself, as installed: a material's kernel for an engine with its own passes. No Vulkan.
#include <nacre/bank.hpp>
#include <nacre/kernel.hpp>
#include <nacre/presets.hpp>

#include <cmath>
#include <cstdio>

int main() {
    const nacre::Material skin = nacre::presets().front();
    double sum = 0;
    for (const nacre::KernelTap& tap : nacre::sliceKernel(nacre::makeLayers(skin), 5, 2)) {
        sum += tap.weight[1];
    }
    const nacre::BankTable table(*nacre::makeProfile(skin));
    std::printf("%s: kernel sums to %g, table of %zu halves\n", skin.name.c_str(), sum, table.halves().size());
    return std::abs(sum - 1) < 1e-6 ? 0 : 1;
}
