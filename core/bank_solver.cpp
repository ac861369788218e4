#include "bank_kernels.hpp"
#include "simplex.hpp"

namespace nacre {
namespace {

using MixtureProblem = SimplexProblem<bankSize>;

// The kernel with the smallest share, if that is less than bankLeastShare, else −1.
int smallestShare(const MixtureProblem::Vector& x) {
    int smallest = -1;
    double least = bankLeastShare;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        if (x[kernel] > 0 && x[kernel] < least) {
            smallest = kernel;
            least = x[kernel];
        }
    }
    return smallest;
}

// The same problem with no kernels but those that `x` has a share of.
void solveWithin(const MixtureProblem::Matrix& gram, const MixtureProblem::Vector& rightHandSide,
                 MixtureProblem::Vector& x) {
    std::array<int, bankSize> kernels{};
    int count = 0;
    double sum = 0;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        if (x[kernel] > 0) {
            kernels[count++] = kernel;
            sum += x[kernel];
        }
    }
    MixtureProblem::Matrix part{};
    MixtureProblem::Vector partRightHandSide{};
    MixtureProblem::Vector shares{};
    for (int i = 0; i < count; ++i) {
        partRightHandSide[i] = rightHandSide[kernels[i]];
        shares[i] = x[kernels[i]] / sum;
        for (int k = 0; k < count; ++k) {
            part[i][k] = gram[kernels[i]][kernels[k]];
        }
    }
    MixtureProblem(part, partRightHandSide, count).solve(shares);
    for (int i = 0; i < count; ++i) {
        x[kernels[i]] = shares[i];
    }
}

} // namespace

void solveMixture(const std::array<double, bankSize>& rightHandSide, std::array<double, bankSize>& x) {
    MixtureProblem(bankForm().gram, rightHandSide).solve(x);
}

void leaveOutSmallShares(const std::array<double, bankSize>& rightHandSide, std::array<double, bankSize>& x) {
    for (int kernel = smallestShare(x); kernel >= 0; kernel = smallestShare(x)) {
        x[kernel] = 0;
        solveWithin(bankForm().gram, rightHandSide, x);
    }
}

} // namespace nacre
