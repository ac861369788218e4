// Least squares over the simplex by an active set (Lawson and Hanson 1974, ch. 23, with the equality Σx = 1 added).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace nacre {

/// Minimises xᵀ·gram·x − 2·rightHandSideᵀ·x over x ≥ 0, Σx = 1, for up to `capacity` unknowns.
template <int capacity> class SimplexProblem {
public:
    using Vector = std::array<double, capacity>;
    using Matrix = std::array<Vector, capacity>;

    /// The first `count` rows and columns are used. The arrays must outlive the problem.
    SimplexProblem(const Matrix& gram, const Vector& rightHandSide, int count = capacity)
        : gram_(gram), rightHandSide_(rightHandSide), count_(count) {}

    /// `x` holds a feasible start, such as the solution of a similar problem, and receives the result.
    void solve(Vector& x) const {
        // Every round either removes an unknown or lowers the error; 4·count is far more than any profile needs and
        // ends a cycle that rounding might start.
        int entering = -1;
        for (int round = 0; round < 4 * count_; ++round) {
            Support support = supportOf(x);
            if (entering >= 0) {
                support.unknowns[support.count++] = entering;
            }
            minimize(support);
            if (entering >= 0 && support.solution[entering] <= 0) {
                return; // within rounding of the optimum
            }
            entering = -1;
            if (!walkTo(support, x)) {
                continue;
            }
            entering = findEntering(support);
            if (entering < 0) {
                return;
            }
        }
    }

private:
    static constexpr double tolerance = 1e-12;

    // The unknowns in use, and the minimum over them without the sign constraint.
    struct Support {
        std::array<int, capacity> unknowns{};
        int count = 0;
        Vector solution{};     // indexed by unknown, 0 outside
        double multiplier = 0; // of Σx = 1
    };

    Support supportOf(const Vector& x) const {
        Support support;
        for (int unknown = 0; unknown < count_; ++unknown) {
            if (x[unknown] > 0) {
                support.unknowns[support.count++] = unknown;
            }
        }
        return support;
    }

    // Solves gram·y = rightHandSide and gram·z = 1 over the support by Cholesky; x = y + multiplier·z sums to 1.
    void minimize(Support& support) const {
        Matrix factor;
        Vector y;
        Vector z;
        for (int i = 0; i < support.count; ++i) {
            const int row = support.unknowns[i];
            for (int j = 0; j <= i; ++j) {
                double sum = gram_[row][support.unknowns[j]];
                for (int k = 0; k < j; ++k) {
                    sum -= factor[i][k] * factor[j][k];
                }
                factor[i][j] = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / factor[j][j];
            }
            y[i] = rightHandSide_[row];
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
        for (int i = 0; i < support.count; ++i) {
            support.solution[support.unknowns[i]] = y[i] + support.multiplier * z[i];
        }
    }

    // Walks from x towards the support's solution as far as the signs allow. True when it got there.
    bool walkTo(const Support& support, Vector& x) const {
        double step = 1;
        int blocking = -1;
        for (int i = 0; i < support.count; ++i) {
            const int unknown = support.unknowns[i];
            const double target = support.solution[unknown];
            if (target <= 0 && x[unknown] < step * (x[unknown] - target)) {
                step = x[unknown] / (x[unknown] - target);
                blocking = unknown;
            }
        }
        for (int unknown = 0; unknown < count_; ++unknown) {
            x[unknown] = std::max(0.0, x[unknown] + step * (support.solution[unknown] - x[unknown]));
        }
        if (blocking < 0) {
            return true;
        }
        x[blocking] = 0;
        return false;
    }

    // The unknown whose share would reduce the error fastest, or −1 when none would.
    int findEntering(const Support& support) const {
        int entering = -1;
        double steepest = -tolerance;
        for (int unknown = 0; unknown < count_; ++unknown) {
            if (support.solution[unknown] > 0) {
                continue;
            }
            double slope = -rightHandSide_[unknown] - support.multiplier;
            for (int i = 0; i < support.count; ++i) {
                slope += gram_[unknown][support.unknowns[i]] * support.solution[support.unknowns[i]];
            }
            if (slope < steepest) {
                steepest = slope;
                entering = unknown;
            }
        }
        return entering;
    }

    const Matrix& gram_;
    const Vector& rightHandSide_;
    int count_;
};

} // namespace nacre
