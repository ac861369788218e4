// The Gaussian bank: one fixed set of eight pixel-grid kernels, identity to 72 px, that any diffusion profile at any
// scale is a non-negative mixture of. The `bank` technique blurs once with every kernel; profiles, layers and materials
// differ only in the mixture's weights, so they cost next to nothing. docs/scatter.md tells the whole story.
#pragma once

#include "nacre/profile.hpp"

#include <cstdint>

namespace nacre {

/// Levels of the pyramid; level l has texels 2^l px wide.
inline constexpr int bankLevels = 6;
/// Kernels: 0 is the identity, 1 the full-resolution [1 2 1]²/16, 1 + l the blurred pyramid level l.
inline constexpr int bankSize = bankLevels + 2;

/// Least share of a kernel in a channel of a mixture, but for none: pixels read only levels that have one, and with 0
/// they would read two fifths more of them, with edge responses that differ by at most 0.0074.
inline constexpr double bankLeastShare = 0.03;
/// What share of each kernel makes up a profile: weights[kernel][channel] ≥ 0, summing to 1 over the kernels.
using BankWeights = std::array<Rgb, bankSize>;

/// Variance of a kernel along one axis, px². Level l ≥ 2: 4^l · 5/4 = (4^l − 1)/12 + 4^l + (4^l/6 + 1/12): the box of
/// the reduction, the 5x5 binomial, and the bilinear tent read at pixel centres. Level 1, with a 3x3 mean in place of
/// the binomial: 11/3.
double bankVariance(int kernel);

/// Edge response of a kernel on the pixel grid: element k is the share of light that crosses k + ½ px, 0 ≤ k < 256.
/// Exact for the three filters applied one after the other, averaged over the pixel's position within the texel.
std::span<const double> bankEdgeTail(int kernel);

/// The mixture of kernels whose response to a shadow edge, at `pixelsPerMillimeter` [> 0], is closest to the profile's:
/// least squares of the edge response plus a tenth of that of its derivative, over the 256 px next to the edge. Shares
/// are 0 or at least bankLeastShare.
BankWeights projectOnBank(const Profile& profile, double pixelsPerMillimeter);

/// A profile's mixtures over all scales, as the shader reads them.
class BankTable {
public:
    /// Bins of the table per doubling of px/mm. Weights between two bins are interpolated linearly: with 8 the edge
    /// response is within 4e-4 of the projection at that very scale, with 4 within 1.5e-3; where one bin leaves a
    /// kernel out and the next does not, within 7e-3 (tests/unit/bank_test.cpp).
    static constexpr int binsPerOctave = 8;
    /// Bins stand at the same scales for every profile: 2^firstOctave to 2^lastOctave px/mm, which is pixels of a metre
    /// to those of 61 nm. Scales beyond have the mixture of the first or the last.
    static constexpr int firstOctave = -10;
    static constexpr int lastOctave = 14;
    static constexpr int binCount = (lastOctave - firstOctave) * binsPerOctave + 1;
    /// Half floats per bin: kernel 0 red, green, blue, kernel 1 red … (48 bytes).
    static constexpr int halvesPerBin = 3 * bankSize;

    explicit BankTable(const Profile& profile);

    /// binCount · halvesPerBin IEEE half floats. The bin at a scale is binsPerOctave · (log2(px/mm) − firstOctave).
    std::span<const std::uint16_t> halves() const { return halves_; }
    /// The weights as the shader interpolates them.
    BankWeights at(double pixelsPerMillimeter) const;

private:
    std::vector<std::uint16_t> halves_;
};

} // namespace nacre
