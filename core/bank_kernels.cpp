#include "bank_kernels.hpp"

#include <algorithm>

namespace nacre {
namespace {

constexpr double kernelTermWeight = 0.1;

// A symmetric kernel on the pixel grid; element `reach` is its centre.
using Taps = std::vector<double>;

Taps convolve(const Taps& a, const Taps& b) {
    Taps result(a.size() + b.size() - 1, 0.0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            result[i + j] += a[i] * b[j];
        }
    }
    return result;
}

Taps box(int width) {
    return Taps(width, 1.0 / width);
}

Taps spread(const Taps& taps, int spacing) {
    Taps result((taps.size() - 1) * spacing + 1, 0.0);
    for (std::size_t i = 0; i < taps.size(); ++i) {
        result[i * spacing] = taps[i];
    }
    return result;
}

// Reading a texel grid bilinearly, averaged over the pixel's position in the texel. Texel centres lie on pixel corners,
// so the tent is sampled at half-integer distances.
Taps averagedTent(int width) {
    Taps result;
    for (int offset = 1 - 2 * width; offset < 2 * width; offset += 2) {
        const double distance = std::abs(offset) / (2.0 * width);
        result.push_back((1 - distance) / width);
    }
    return result;
}

Taps kernelTaps(int kernel) {
    if (kernel == 0) {
        return {1.0};
    }
    if (kernel == 1) {
        return {0.25, 0.5, 0.25};
    }
    const int width = 1 << (kernel - 1);
    const Taps blur =
        kernel == 2 ? Taps{1 / 3.0, 1 / 3.0, 1 / 3.0} : Taps{1 / 16.0, 4 / 16.0, 6 / 16.0, 4 / 16.0, 1 / 16.0};
    return convolve(convolve(box(width), spread(blur, width)), averagedTent(width));
}

EdgeTail edgeTail(const Taps& taps) {
    EdgeTail tail{};
    const int centre = static_cast<int>(taps.size() / 2);
    double beyond = 0;
    for (int k = centre; k >= 1; --k) {
        beyond += taps[centre + k];
        tail[k - 1] = beyond;
    }
    return tail;
}

// Row k of the form applied to a tail. With tail(−½ − k) = 1 − tail(k + ½), the differences at both sides of the edge
// are equal and opposite, and the kernel is the tail's difference: K(0) = 1 − 2·tail(½), K(k) = tail(k − ½) − tail(k +
// ½).
double applyForm(const EdgeTail& tail, int k) {
    const double own = tail[k];
    const double before = k == 0 ? -own : tail[k - 1];
    const double after = k + 1 < bankReach ? tail[k + 1] : 0.0;
    return 2 * own + 2 * kernelTermWeight * ((own - before) + (own - after));
}

double dot(const EdgeTail& a, const EdgeTail& b) {
    double sum = 0;
    for (int k = 0; k < bankReach; ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}

BankForm makeBankForm() {
    BankForm form;
    for (int kernel = 0; kernel < bankSize; ++kernel) {
        form.tails[kernel] = edgeTail(kernelTaps(kernel));
        for (int k = 0; k < bankReach; ++k) {
            form.weightedTails[kernel][k] = applyForm(form.tails[kernel], k);
        }
    }
    for (int a = 0; a < bankSize; ++a) {
        for (int b = 0; b < bankSize; ++b) {
            form.gram[a][b] = dot(form.tails[a], form.weightedTails[b]);
        }
    }
    return form;
}

} // namespace

const BankForm& bankForm() {
    static const BankForm form = makeBankForm();
    return form;
}

double bankVariance(int kernel) {
    if (kernel < 3) {
        return kernel == 2 ? 11 / 3.0 : 0.5 * kernel;
    }
    return 1.25 * (1 << 2 * (kernel - 1));
}

std::span<const double> bankEdgeTail(int kernel) {
    return bankForm().tails[kernel];
}

} // namespace nacre
