// Least squares over the simplex by an active set (Lawson and Hanson 1974, ch. 23, with the equality Σx = 1 added).
#include "bank_kernels.hpp"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

using Vector = std::array<double, bankSize>;
using Matrix = std::array<Vector, bankSize>;

constexpr double tolerance = 1e-12;

// The kernels in use, and the minimum over them without the sign constraint.
struct Support {
    std::array<int, bankSize> kernels{};
    int count = 0;
    Vector solution{};     // indexed by kernel, 0 outside
    double multiplier = 0; // of Σx = 1
};

Support supportOf(const Vector& x) {
    Support support;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        if (x[kernel] > 0) {
            support.kernels[support.count++] = kernel;
        }
    }
    return support;
}

// Solves gram·y = rightHandSide and gram·z = 1 over the support by Cholesky; x = y + multiplier·z sums to 1.
void minimize(const Matrix& gram, const Vector& rightHandSide, Support& support) {
    Matrix factor{};
    Vector y{};
    Vector z{};
    for (int i = 0; i < support.count; ++i) {
        const int row = support.kernels[i];
        for (int j = 0; j <= i; ++j) {
            double sum = gram[row][support.kernels[j]];
            for (int k = 0; k < j; ++k) {
                sum -= factor[i][k] * factor[j][k];
            }
            factor[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / factor[j][j];
        }
        y[i] = rightHandSide[row];
        z[i] = 1;
        for (int k = 0; k < i; ++k) {
            y[i] -= factor[i][k] * y[k];
            z[i] -= factor[i][k] * z[k];
        }
        y[i] /= factor[i][i];
        z[i] /= factor[i][i];
    }
    double sumY = 0;
    double sumZ = 0;
    for (int i = support.count - 1; i >= 0; --i) {
        for (int k = i + 1; k < support.count; ++k) {
            y[i] -= factor[k][i] * y[k];
            z[i] -= factor[k][i] * z[k];
        }
        y[i] /= factor[i][i];
        z[i] /= factor[i][i];
        sumY += y[i];
        sumZ += z[i];
    }
    support.multiplier = (1 - sumY) / sumZ;
    support.solution = {};
    for (int i = 0; i < support.count; ++i) {
        support.solution[support.kernels[i]] = y[i] + support.multiplier * z[i];
    }
}

// Walks from x towards the support's solution as far as the signs allow. True when it got there.
bool walkTo(const Support& support, Vector& x) {
    double step = 1;
    int blocking = -1;
    for (int i = 0; i < support.count; ++i) {
        const int kernel = support.kernels[i];
        const double target = support.solution[kernel];
        if (target <= 0 && x[kernel] < step * (x[kernel] - target)) {
            step = x[kernel] / (x[kernel] - target);
            blocking = kernel;
        }
    }
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        x[kernel] = std::max(0.0, x[kernel] + step * (support.solution[kernel] - x[kernel]));
    }
    if (blocking < 0) {
        return true;
    }
    x[blocking] = 0;
    return false;
}

// The kernel whose share would reduce the error fastest, or −1 when none would.
int findEntering(const Matrix& gram, const Vector& rightHandSide, const Support& support) {
    int entering = -1;
    double steepest = -tolerance;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        if (support.solution[kernel] > 0) {
            continue;
        }
        double slope = -rightHandSide[kernel] - support.multiplier;
        for (int i = 0; i < support.count; ++i) {
            slope += gram[kernel][support.kernels[i]] * support.solution[support.kernels[i]];
        }
        if (slope < steepest) {
            steepest = slope;
            entering = kernel;
        }
    }
    return entering;
}

} // namespace

void solveOnSimplex(const Matrix& gram, const Vector& rightHandSide, Vector& x) {
    // Every round either removes a kernel or lowers the error; 4·bankSize is far more than any profile needs and ends
    // a cycle that rounding might start.
    int entering = -1;
    for (int round = 0; round < 4 * bankSize; ++round) {
        Support support = supportOf(x);
        if (entering >= 0) {
            support.kernels[support.count++] = entering;
        }
        minimize(gram, rightHandSide, support);
        if (entering >= 0 && support.solution[entering] <= 0) {
            return; // within rounding of the optimum
        }
        entering = -1;
        if (!walkTo(support, x)) {
            continue;
        }
        entering = findEntering(gram, rightHandSide, support);
        if (entering < 0) {
            return;
        }
    }
}

} // namespace nacre
