// The numbers of a material, a light and the picture that can be set, as tables: widgets and scripts are made of them.
#pragma once

#include "view/model/edited_scene.hpp"

#include <span>

namespace nacre::view {

/// A number of a `Target`.
template <typename Target> struct Parameter {
    const char* name;  ///< of its widget, in scripts
    const char* label; ///< what stands beside it
    const char* unit;  ///< "" for shares and counts
    double low;
    double high;
    bool logarithmic; ///< the slider's steps are factors
    int decimals;
    const char* toolTip;
    double (*get)(const Target&);
    void (*set)(Target&, double);
};

std::span<const Parameter<Material>> materialParameters();
std::span<const Parameter<Layer>> layerParameters();
std::span<const Parameter<scene::Light>> lightParameters();
std::span<const Parameter<EditedScene>> sceneParameters();

/// Root mean square radius of a layer [mm], sqrt(2 variance), and back.
double radiusOf(double variance);
double varianceOf(double radius);

} // namespace nacre::view
