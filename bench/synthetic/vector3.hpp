// Three numbers and what geometry does with them, where no library is at hand.
#pragma once

#include <array>
#include <cmath>
#include <type_traits>

namespace nacre::bench {

template <typename Real> using Vector3 = std::array<Real, 3>;

template <typename Real> Vector3<Real> operator+(const Vector3<Real>& a, const Vector3<Real>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <typename Real> Vector3<Real> operator-(const Vector3<Real>& a, const Vector3<Real>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <typename Real> Vector3<Real> operator*(std::type_identity_t<Real> s, const Vector3<Real>& a) {
    return {s * a[0], s * a[1], s * a[2]};
}

template <typename Real> Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Real> Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <typename Real> Vector3<Real> normalized(const Vector3<Real>& a) {
    return 1 / std::sqrt(dot(a, a)) * a;
}

} // namespace nacre::bench
