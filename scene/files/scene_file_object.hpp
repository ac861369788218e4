// Checked reads of a JSON object: every error names the file, the field and the value.
#pragma once

#include "core/files/quoted_text.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json.hpp>
#include <numbers>
#include <span>

namespace nacre::scene {

/// [rad] Angles are in degrees in scene files.
inline constexpr float degree = std::numbers::pi_v<float> / 180;

/// What a number may be.
struct NumberRange {
    double low = -1e9;
    double high = 1e9;
    bool lowExcluded = false;
};
inline constexpr NumberRange nonNegative{0, 1e9};
inline constexpr NumberRange positive{0, 1e9, true};
inline constexpr NumberRange unitInterval{0, 1};

/// A JSON object whose members are asked for by name; finish() refuses those that nobody asked for.
class SceneFileObject {
public:
    /// `field` is empty for the whole file.
    SceneFileObject(const nlohmann::json& json, std::string file, std::string field);

    bool has(const char* key);
    double number(const char* key, double fallback, const NumberRange& range = {});
    float real(const char* key, float fallback, const NumberRange& range = {});
    glm::vec2 pair(const char* key, const glm::vec2& fallback, const NumberRange& range = {});
    glm::vec3 triple(const char* key, const glm::vec3& fallback, const NumberRange& range = {});
    bool boolean(const char* key, bool fallback);
    std::string text(const char* key, const std::string& fallback = {});
    /// The index of the member's text in `choices`.
    std::size_t choice(const char* key, std::size_t fallback, std::span<const char* const> choices);
    /// The member itself, or null.
    const nlohmann::json* member(const char* key);
    SceneFileObject object(const char* key);
    /// The objects of an array; empty when the member is missing.
    std::vector<SceneFileObject> objects(const char* key);

    /// The file that the member `key` names, which is its text `reference` (findNamedFile); refuses the member, which
    /// must be `expected`, where there is no such file.
    std::filesystem::path namedFile(const char* key, const std::string& reference, const std::string& expected) const;

    /// Throws SceneError: the member `key` is missing.
    void require(const char* key);
    /// Throws SceneError: "FILE: FIELD.key is VALUE, must be `expected`".
    [[noreturn]] void refuse(const char* key, const std::string& expected) const;
    /// Throws SceneError for members that were not asked for, and lists those that were.
    void finish() const;
    /// The member's path in the file, as sentences name it.
    std::string fieldOf(const std::string& key) const {
        return withoutMiddle(field_.empty() ? key : field_ + "." + key);
    }
    const std::string& file() const { return file_; }
    const nlohmann::json& json() const { return *json_; }

private:
    template <int size>
    glm::vec<size, float> vector(const char* key, glm::vec<size, float> fallback, const NumberRange&);

    const nlohmann::json* json_;
    std::string file_;
    std::string field_;
    std::vector<std::string> known_;
};

/// JSON text in which no key is given twice; throws SceneError with the line and column of a mistake.
nlohmann::json parseSceneJson(const std::string& file, std::span<const std::uint8_t> bytes);

} // namespace nacre::scene
