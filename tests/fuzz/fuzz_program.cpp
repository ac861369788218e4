// One of the fuzzers: NACRE_FUZZ_NAME says which. libFuzzer brings main.
#include "tests/fuzz/fuzz_entries.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto entries = nacre::fuzz::entries();
    static const auto entry = std::ranges::find(entries, std::string_view(NACRE_FUZZ_NAME), &nacre::fuzz::Entry::name);
    entry->read({data, size});
    return 0;
}
