#include "bench/accuracy/accuracy_run.hpp"

#include "bench/accuracy/accuracy_pictures.hpp"
#include "bench/accuracy/reference_store.hpp"
#include "bench/accuracy/thin_parts.hpp"
#include "image/comparison.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace nacre::bench {
namespace {

using renderer::Output;

/// Fewer say nothing.
constexpr std::size_t leastThinPixels = 50;
constexpr std::uint32_t thesisRadius = 5;

/// A reference as an image, and the pixels that can be compared with it.
struct Target {
    std::string method;
    Image picture; ///< R G B, black where `mask` is 0
    Image variance;
    Mask mask;
};

/// A technique's picture.
struct Rendered {
    Image picture; ///< diffuse radiance
    std::vector<float> materialIds;
};

Image imageOf(const reference::Film& film, glm::dvec3 (reference::PixelSum::*value)() const) {
    Image image = makeImage(film.width, film.height, {"R", "G", "B"});
    for (std::size_t pixel = 0; pixel < film.pixels.size(); ++pixel) {
        const glm::dvec3 color = (film.pixels[pixel].*value)();
        for (int channel = 0; channel < 3; ++channel) {
            image.values[3 * pixel + static_cast<std::size_t>(channel)] = static_cast<float>(color[channel]);
        }
    }
    return image;
}

/// FLIP looks at the neighbourhood of a pixel: what does not count is black in both pictures.
Image blackened(Image image, const Mask& mask) {
    for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = mask[i / 3] != 0 ? image.values[i] : 0;
    }
    return image;
}

Rendered render(renderer::Offscreen& renderer, const scene::Camera& camera, const renderer::EffectSettings& effect) {
    renderer.setEffect(effect);
    renderer.render(camera);
    Rendered result{renderer.read(Output::Radiance), renderer.read(Output::Material).values};
    const Image specular = renderer.read(Output::Specular); // of the surroundings, at grazing angles
    for (std::size_t i = 0; i < specular.values.size(); ++i) {
        result.picture.values[i] -= specular.values[i];
    }
    return result;
}

/// Mean over pixels that count and channels.
double meanVariance(const Image& variance, const Mask& mask) {
    double sum = 0;
    for (std::size_t i = 0; i < variance.values.size(); ++i) {
        sum += mask[i / 3] != 0 ? static_cast<double>(variance.values[i]) : 0;
    }
    return sum / (3.0 * static_cast<double>(countedPixels(variance, mask)));
}

AccuracyFigures figures(const Image& picture, const Target& target, const Mask& mask, double peak) {
    const std::vector<ErrorSums> sums = channelErrors(picture, target.picture, mask);
    AccuracyFigures result;
    result.pixels = sums[0].count();
    ErrorSums all;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        all += sums[channel];
        result.energy[channel] = sums[channel].energyRatio();
    }
    result.psnr = all.psnr(peak);
    const double noise = meanVariance(target.variance, mask);
    const double error = all.meanSquaredError() - noise;
    result.isBound = error < noiseResolution * noise;
    result.psnrWithoutNoise = psnr(std::max(error, noiseResolution * noise), peak);
    return result;
}

Mask both(const Mask& a, const Mask& b) {
    Mask result(a.size());
    std::ranges::transform(a, b, result.begin(),
                           [](std::uint8_t x, std::uint8_t y) { return static_cast<std::uint8_t>(x != 0 && y != 0); });
    return result;
}

AccuracyCell compare(const std::string& technique, const Rendered& rendered, const Target& target, const Mask& thin) {
    const Image picture = blackened(rendered.picture, target.mask);
    const double peak = quantile(target.picture, 1, target.mask);
    AccuracyCell cell;
    cell.technique = technique;
    cell.reference = target.method;
    cell.whole = figures(picture, target, target.mask, peak);
    const Mask thinHere = both(target.mask, thin);
    if (countedPixels(picture, thinHere) >= leastThinPixels) {
        cell.thin = figures(picture, target, thinHere, peak);
    }
    cell.flip = mean(hdrFlip(picture, target.picture), target.mask);
    return cell;
}

/// One view with all of its references and techniques.
class ViewRun {
public:
    ViewRun(renderer::Device& device, const AccuracyPlan& plan, const AccuracyReporter& reporter)
        : device_(device), plan_(plan), reporter_(reporter) {}

    AccuracyViewResult operator()(const AccuracyViewEntry& entry, const std::string& number) {
        reporter_.say(number + ' ' + entry.name + ": making the scene …");
        view_ = entry.make();
        view_.name = entry.name;
        result_ = {entry.name, entry.what, view_.shadowMapSize, {}, {}};
        std::vector<reference::Film> films;
        for (const reference::Method method : plan_.references) {
            reporter_.say(number + ' ' + entry.name + ": reference " + reference::methodName(method));
            StoredReference stored =
                ReferenceStore(plan_.store).get(view_, method, plan_.size, plan_.stop, reporter_.proceed);
            addReference(method, stored);
            films.push_back(std::move(stored.film));
        }
        reporter_.say(number + ' ' + entry.name + ": techniques");
        addCells(films);
        return std::move(result_);
    }

private:
    void addReference(reference::Method method, const StoredReference& stored) {
        AccuracyReference reference;
        reference.method = reference::methodName(method);
        reference.samples =
            static_cast<double>(stored.film.sampleCount()) / static_cast<double>(stored.film.pixels.size());
        reference.noise = stored.film.noise();
        reference.seconds = stored.film.seconds;
        reference.warnings = stored.warnings;
        result_.references.push_back(std::move(reference));
    }

    /// The mask has the pixels in which the renderer and the reference see the same material.
    Target targetOf(const reference::Film& film, const std::string& method,
                    const std::vector<float>& materialIds) const {
        Mask mask(film.pixels.size());
        for (std::size_t pixel = 0; pixel < mask.size(); ++pixel) {
            mask[pixel] = film.materials[pixel] != 0 && static_cast<float>(film.materials[pixel]) == materialIds[pixel];
        }
        if (std::ranges::count(mask, 1) == 0) {
            throw std::runtime_error(view_.name + ": shows no subsurface material");
        }
        return {method, blackened(imageOf(film, &reference::PixelSum::mean), mask),
                imageOf(film, &reference::PixelSum::variance), std::move(mask)};
    }

    void addCells(const std::vector<reference::Film>& films) {
        renderer::RenderSettings settings;
        settings.width = plan_.size.width;
        settings.height = plan_.size.height;
        settings.shadowMapSize = view_.shadowMapSize;
        renderer::Offscreen renderer(device_, *view_.scene, settings);
        const Mask thin = thinParts(view_, plan_.size);
        AccuracyPictures pictures(plan_.pictures, view_.name);
        std::vector<Target> targets;
        for (const AccuracyTechnique& technique : plan_.techniques) {
            renderer::EffectSettings effect = technique.effect;
            effect.baselines.thesisRadius = thesisRadius;
            effect.baselines.thesisStrength = thesisStrength(view_, plan_.size, thesisRadius);
            const Rendered rendered = render(renderer, view_.camera, effect);
            for (std::size_t i = targets.size(); i < films.size(); ++i) {
                targets.push_back(targetOf(films[i], result_.references[i].method, rendered.materialIds));
                const double peak = quantile(targets[i].picture, 1, targets[i].mask);
                result_.references[i].noisePsnr = psnr(meanVariance(targets[i].variance, targets[i].mask), peak);
                pictures.addReference(targets[i].method, targets[i].picture);
            }
            pictures.addTechnique(technique.name, blackened(rendered.picture, targets.front().mask));
            for (const Target& target : targets) {
                pictures.addDifference(technique.name, target.method, blackened(rendered.picture, target.mask),
                                       target.picture);
                result_.cells.push_back(compare(technique.name, rendered, target, thin));
            }
        }
    }

    renderer::Device& device_;
    const AccuracyPlan& plan_;
    const AccuracyReporter& reporter_;
    AccuracyView view_;
    AccuracyViewResult result_;
};

double secondsSince(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// "[3/32, about 12 min left]", as if the views to come took as long as those before
std::string progressOf(std::size_t done, std::size_t count, double seconds) {
    std::string text = '[' + std::to_string(done + 1) + '/' + std::to_string(count);
    if (done > 0) {
        const double left = seconds * static_cast<double>(count - done) / static_cast<double>(done);
        text += ", about " + std::to_string(std::lround(std::ceil(left / 60))) + " min left";
    }
    return text + ']';
}

} // namespace

std::vector<AccuracyTechnique> accuracyTechniques() {
    std::uint32_t count = 0;
    nacreGetTechniques(&count, nullptr);
    std::vector<NacreTechnique> all(count);
    nacreGetTechniques(&count, all.data());
    std::vector<AccuracyTechnique> techniques{
        {"off", "without the effect", {.scatter = false, .transmit = false}},
        {"scatter", "the default technique, without transmit", {.transmit = false}}};
    for (const NacreTechnique technique : all) {
        const std::string name = nacreTechniqueString(technique);
        AccuracyTechnique entry{name, "scatter by " + name + " and transmit", {.technique = technique}};
        entry.effect.baselines.thesisTransmittance = name == "thesis" ? VK_TRUE : VK_FALSE;
        techniques.push_back(std::move(entry));
    }
    return techniques;
}

AccuracyResults runAccuracy(renderer::Device& device, const AccuracyPlan& plan, const AccuracyReporter& reporter) {
    AccuracyResults results{.nacreVersion = NACRE_VERSION,
                            .device = device.description().name,
                            .width = plan.size.width,
                            .height = plan.size.height};
    ViewRun run(device, plan, reporter);
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < plan.views.size(); ++i) {
        results.views.push_back(run(plan.views[i], progressOf(i, plan.views.size(), secondsSince(begin))));
        reporter.finished(results.views.back());
    }
    return results;
}

} // namespace nacre::bench
