// Lights and numbers of scene files, read and written.
#pragma once

#include "scene/files/scene_file_object.hpp"

namespace nacre::scene {

/// The shortest decimal that reads back as this float.
nlohmann::json shortNumber(float value);
nlohmann::json shortTriple(const glm::vec3& value);
/// An angle in degrees.
nlohmann::json degreesOf(float radians);

/// Refuses (0, 0, 0).
void checkDirection(const SceneFileObject& object, const char* key, const glm::vec3& direction);

/// An entry of `lights`, and back.
Light readLight(SceneFileObject& object);
nlohmann::json writeLight(const Light& light);

} // namespace nacre::scene
