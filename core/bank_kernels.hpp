// The bank's kernels as the projection sees them: edge responses and their inner products.
#pragma once

#include "nacre/bank.hpp"

namespace nacre {

/// Edge responses are compared at k + ½ px for 0 ≤ k < bankReach. The widest kernel ends at 224 px.
inline constexpr int bankReach = 256;

using EdgeTail = std::array<double, bankReach>;

/// What the projection minimises is a quadratic form in the tails' difference: Σ (response)² over both sides of the
/// edge
/// + 0.1 · Σ (kernel)². The second term keeps texture right where many mixtures have nearly the same edge; the factor
/// may be 0.05 to 0.3 without a change above 0.1 dB.
struct BankForm {
    std::array<EdgeTail, bankSize> tails;
    std::array<EdgeTail, bankSize> weightedTails; ///< form · tail: inner products with a tail are plain sums over this
    std::array<std::array<double, bankSize>, bankSize> gram;
};

/// Built once.
const BankForm& bankForm();

/// The mixture x minimising xᵀ·gram·x − 2·rightHandSideᵀ·x, with the bank's gram, over x ≥ 0, Σx = 1 (active set, at
/// most a few 8x8 solves). `x` holds a feasible start, such as the mixture of a similar problem, and receives the
/// result.
void solveMixture(const std::array<double, bankSize>& rightHandSide, std::array<double, bankSize>& x);

/// Leaves out of such a mixture the kernels that have less than bankLeastShare, the smallest first, and solves for the
/// others' shares again.
void leaveOutSmallShares(const std::array<double, bankSize>& rightHandSide, std::array<double, bankSize>& x);

} // namespace nacre
