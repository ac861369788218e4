// The benchmark's synthetic scenes (bench/synthetic), by their own names in tests.
#pragma once

#include "bench/synthetic/scatter_scenes.hpp"
#include "bench/synthetic/vector3.hpp"

namespace nacre::tests {

using bench::heldOutSceneKinds;
using bench::makeScatterScene;
using bench::ScatterScene;
using bench::SceneKind;
using bench::sceneKindName;
using bench::SceneSettings;
using bench::testMaterials;
using bench::tunedSceneKinds;
using bench::Vector3;
using bench::operator+;
using bench::operator-;
using bench::operator*;
using bench::cross;
using bench::dot;
using bench::normalized;

} // namespace nacre::tests
