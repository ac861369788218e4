// The mean of many estimates, and how far it can be trusted.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace nacre::test {

class Mean {
public:
    void add(const glm::dvec3& value) {
        sum_ += value;
        squares_ += value * value;
        ++count_;
    }
    glm::dvec3 value() const { return sum_ / count_; }
    glm::dvec3 standardError() const {
        return glm::sqrt(glm::max(squares_ / count_ - value() * value(), 0.0) / (count_ - 1));
    }

private:
    glm::dvec3 sum_{0};
    glm::dvec3 squares_{0};
    double count_ = 0;
};

} // namespace nacre::test
