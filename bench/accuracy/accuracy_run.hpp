// Renders every view with every technique and holds the pictures against references.
#pragma once

#include "bench/accuracy/accuracy_results.hpp"
#include "bench/accuracy/accuracy_view.hpp"
#include "reference/reference.hpp"

namespace nacre::bench {

/// A way to draw the light of subsurface bodies.
struct AccuracyTechnique {
    std::string name;
    std::string what;
    renderer::EffectSettings effect;
};

/// Without the effect, with scatter alone, and every technique of nacreGetTechniques with scatter and transmit. The
/// thesis's has its own transmittance, and a strength that suits the view (setThesisStrength in the run).
std::vector<AccuracyTechnique> accuracyTechniques();

struct AccuracyPlan {
    std::vector<AccuracyViewEntry> views;
    std::vector<AccuracyTechnique> techniques;
    std::vector<reference::Method> references;
    Size size{240, 135};
    reference::Stop stop;           ///< of each reference
    std::filesystem::path store;    ///< ReferenceStore's folder
    std::filesystem::path pictures; ///< where to leave PNG files; empty: none are made
};

/// What the run tells on its way.
struct AccuracyReporter {
    /// Of long work, between slices of it. False ends the run at the next `say`, which has to throw then.
    std::function<bool(const reference::Progress&)> proceed;
    /// One line.
    std::function<void(const std::string&)> say;
    /// A view is complete.
    std::function<void(const AccuracyViewResult&)> finished;
};

/// Throws what rendering and references throw, naming the view.
AccuracyResults runAccuracy(renderer::Device& device, const AccuracyPlan& plan, const AccuracyReporter& reporter);

} // namespace nacre::bench
