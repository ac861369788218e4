// A number that tells whether two inputs are the same.
#pragma once

#include "scene/scene.hpp"

#include <span>

namespace nacre::trace {

/// FNV-1a over bytes (Fowler, Noll and Vo), 64 bits.
class Fingerprint {
public:
    void add(std::span<const std::byte> bytes);
    /// A value without padding.
    template <typename Value> void addValue(const Value& value) { add(std::as_bytes(std::span(&value, 1))); }
    template <typename Value> void addAll(const std::vector<Value>& values) {
        addValue(values.size());
        add(std::as_bytes(std::span(values)));
    }
    std::uint64_t value() const { return value_; }
    /// 16 hexadecimal digits.
    std::string text() const;

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

/// Of everything in the scene that light under its surfaces depends on: geometry, surfaces, materials, lights and
/// surroundings.
std::string fingerprintOf(const scene::Scene& scene);
std::string fingerprintOf(const scene::Camera& camera);
std::string fingerprintOf(const nacre::Image& image);

} // namespace nacre::trace
