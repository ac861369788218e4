// Random numbers that depend on a seed, a stream and a sample alone, so that a result does not depend on which thread
// asks for them or when.
#pragma once

#include <array>
#include <cstdint>

namespace nacre::trace {

/// Ten rounds of Philox 4x32 (Salmon, Moraes, Dror and Shaw 2011, "Parallel random numbers: as easy as 1, 2, 3").
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t low = std::uint64_t{0xD2511F53} * counter[0];
        const std::uint64_t high = std::uint64_t{0xCD9E8D57} * counter[2];
        counter = {static_cast<std::uint32_t>(high >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(high),
                   static_cast<std::uint32_t>(low >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(low)};
        key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
    }
    return counter;
}

/// The numbers of one sample of one stream, e.g. of a pixel. Independent of all others.
class Random {
public:
    Random(std::uint64_t seed, std::uint32_t stream, std::uint32_t sample)
        : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
          counter_{0, 0, sample, stream} {}

    /// Even in (0, 1); never 0 and never 1.
    double uniform() {
        if (used_ == block_.size()) {
            block_ = philox(counter_, key_);
            counter_[1] += ++counter_[0] == 0 ? 1 : 0;
            used_ = 0;
        }
        return (block_[used_++] + 0.5) * 0x1p-32;
    }

private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;
    std::array<std::uint32_t, 4> block_{};
    std::size_t used_ = 4;
};

} // namespace nacre::trace
