#include "bank_kernels.hpp"
#include "simplex.hpp"

namespace nacre {

void solveOnSimplex(const std::array<std::array<double, bankSize>, bankSize>& gram,
                    const std::array<double, bankSize>& rightHandSide, std::array<double, bankSize>& x) {
    SimplexProblem<bankSize>(gram, rightHandSide).solve(x);
}

} // namespace nacre
