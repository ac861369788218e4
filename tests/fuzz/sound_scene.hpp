// What the renderer takes for granted in a scene.
#pragma once

#include "scene/scene.hpp"

namespace nacre::fuzz {

/// [bytes] No sentence is longer, whatever it quotes.
inline constexpr std::size_t mostOfSentence = 4096;

/// Ends the process with a message unless every index of the scene is in range, every texture has its pixels, every
/// material is valid, every number is finite, and every note is a sentence.
void requireSound(const scene::Scene& scene);

} // namespace nacre::fuzz
