// What a bake found, as a line and as JSON; docs/schemas/bake.schema.json describes the latter.
#pragma once

#include "app/bake_options.hpp"

namespace nacre::app {

struct BakeResult {
    std::string scene;
    std::vector<std::string> notes; ///< Scene::notes
    std::string surface;            ///< its name; empty for all
    std::string law;                ///< a material's name, or "neutral"
    bake::ThicknessState state;
    std::size_t texels = 0; ///< of the picture; 0 for a mesh
    double white = 0;       ///< [mm] what a PNG's white stands for; 0 for others
    double secondsOfRun = 0;
    std::vector<std::string> warnings;
};

/// Smallest, mean and largest thickness, mm.
struct ThicknessRange {
    double least = 0;
    double mean = 0;
    double most = 0;
};
ThicknessRange rangeOf(std::span<const float> millimetres);

std::string makeReport(const BakeOptions& options, const BakeResult& result);

/// One line for the terminal.
std::string describeBake(const BakeOptions& options, const BakeResult& result);

} // namespace nacre::app
