#include "scene/gltf/gltf_animation.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>

namespace nacre::scene {
namespace {

struct Path {
    std::string_view name;
    int width; ///< of its accessor
    std::vector<double> tinygltf::Node::*member;
};
constexpr std::string_view rotationPath = "rotation";
constexpr std::array paths{Path{"translation", 3, &tinygltf::Node::translation},
                           Path{rotationPath, 4, &tinygltf::Node::rotation}, Path{"scale", 3, &tinygltf::Node::scale},
                           Path{"weights", 1, &tinygltf::Node::weights}};

/// Where a time lies between two keys.
struct Place {
    std::size_t before = 0;
    std::size_t after = 0;
    float share = 0;   ///< [0, 1] of the way
    float seconds = 0; ///< between them
};

Place placeOf(const std::vector<float>& times, float time) {
    const auto after = static_cast<std::size_t>(std::ranges::upper_bound(times, time) - times.begin());
    if (after == 0 || after == times.size()) {
        const std::size_t end = after == 0 ? 0 : times.size() - 1;
        return {end, end, 0, 0};
    }
    const float seconds = times[after] - times[after - 1];
    const float share = seconds > 0 ? std::clamp((time - times[after - 1]) / seconds, 0.0f, 1.0f) : 0.0f;
    return {after - 1, after, share, seconds};
}

/// The values of a sampler: for each key as many as a channel's target has, of a cubic spline thrice as many.
class Curve {
public:
    Curve(const GltfFile& file, const tinygltf::AnimationSampler& sampler, int width, const std::string& field)
        : isStep_(sampler.interpolation == "STEP"), isCubic_(sampler.interpolation == "CUBICSPLINE") {
        if (!isStep_ && !isCubic_ && sampler.interpolation != "LINEAR") {
            failGltf(file, field + ".interpolation must be LINEAR, STEP or CUBICSPLINE");
        }
        times_ = readFloats(file, sampler.input, 1, field + ".input");
        values_ = readFloats(file, sampler.output, width, field + ".output");
        file.budget->charge((times_.size() + values_.size()) *
                            sizeof(times_[0])); // many channels may share one sampler
        const std::size_t parts = times_.size() * (isCubic_ ? 3 : 1);
        count_ = parts == 0 ? 0 : values_.size() / parts;
        if (count_ == 0 || count_ * parts != values_.size() ||
            (width > 1 && count_ != static_cast<std::size_t>(width))) {
            failGltf(file, field + ".output has " + std::to_string(values_.size()) + " numbers, which do not fit its " +
                               std::to_string(times_.size()) + " keys");
        }
    }

    std::vector<double> at(float time, bool isRotation) const {
        const Place place = placeOf(times_, time);
        std::vector<double> result(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            result[i] = isCubic_ ? cubic(place, i) : linear(place, i);
        }
        if (isRotation && !isCubic_ && !isStep_) {
            const glm::quat turned = glm::slerp(rotation(place.before), rotation(place.after), place.share);
            result = {turned.x, turned.y, turned.z, turned.w};
        }
        return result;
    }

private:
    /// `part` of a cubic spline's key: 0 is the tangent that comes in, 1 the value, 2 the tangent that goes out.
    float value(std::size_t key, std::size_t part, std::size_t i) const {
        return values_[((isCubic_ ? 3 * key : key) + part) * count_ + i];
    }

    double linear(const Place& place, std::size_t i) const {
        const double before = value(place.before, 0, i);
        return isStep_ ? before : before + (value(place.after, 0, i) - before) * place.share;
    }

    /// glTF 2.0, appendix C.5.
    double cubic(const Place& place, std::size_t i) const {
        const double t = place.share;
        const double t2 = t * t;
        const double t3 = t2 * t;
        return (2 * t3 - 3 * t2 + 1) * value(place.before, 1, i) +
               place.seconds * (t3 - 2 * t2 + t) * value(place.before, 2, i) +
               (-2 * t3 + 3 * t2) * value(place.after, 1, i) + place.seconds * (t3 - t2) * value(place.after, 0, i);
    }

    glm::quat rotation(std::size_t key) const {
        return {value(key, 0, 3), value(key, 0, 0), value(key, 0, 1), value(key, 0, 2)};
    }

    bool isStep_;
    bool isCubic_;
    std::vector<float> times_;
    std::vector<float> values_;
    std::size_t count_ = 0; ///< numbers of a value
};

/// Whether the channel was read.
bool pose(GltfFile& file, const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel, double time,
          const std::string& field) {
    const auto* path = std::ranges::find(paths, std::string_view(channel.target_path), &Path::name);
    if (path == paths.end() || channel.target_node < 0) {
        return false;
    }
    elementOf(file, file.model.nodes, channel.target_node, field + ".target.node");
    const auto& sampler = elementOf(file, animation.samplers, channel.sampler, field + ".sampler");
    const Curve curve(file, sampler, path->width, "animations[0].samplers[" + std::to_string(channel.sampler) + "]");
    tinygltf::Node& node = file.model.nodes[static_cast<std::size_t>(channel.target_node)];
    node.*path->member = curve.at(static_cast<float>(time), path->name == rotationPath);
    if (path->member != &tinygltf::Node::weights) {
        node.matrix.clear(); // which a node that moves may not have
    }
    return true;
}

} // namespace

void poseAt(GltfFile& file, double time) {
    const std::string name = file.path.string();
    if (file.model.animations.empty()) {
        file.notes.push_back(name + ": has no animation, and looks the same at every time");
        return;
    }
    if (file.model.animations.size() > 1) {
        file.notes.push_back(name + ": has " + std::to_string(file.model.animations.size()) +
                             " animations, of which the first is shown");
    }
    const tinygltf::Animation& animation = file.model.animations.front();
    std::size_t left = 0;
    for (std::size_t i = 0; i < animation.channels.size(); ++i) {
        const std::string field = "animations[0].channels[" + std::to_string(i) + "]";
        left += pose(file, animation, animation.channels[i], time, field) ? 0 : 1;
    }
    if (left > 0) {
        file.notes.push_back(name + ": " + std::to_string(left) +
                             " channels of its animation move something that is not read");
    }
}

} // namespace nacre::scene
