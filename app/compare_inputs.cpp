#include "app/compare_inputs.hpp"

#include "image/image_file.hpp"
#include "nacre/files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace nacre::app {

namespace {

using Path = std::filesystem::path;

std::string sizeOf(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

void requireSize(const Image& image, const Path& file, const Image& reference, const Path& referenceFile) {
    if (image.width != reference.width || image.height != reference.height) {
        throw FileError(file.string() + ": is " + sizeOf(image) + ", but " + referenceFile.string() + " is " +
                        sizeOf(reference) + "; they must have one size");
    }
}

/// R, G, B of an image, or the channels with a prefix.
Image colorsOf(const Image& image, const Path& file, const std::string& prefix = "") {
    try {
        if (prefix.empty()) {
            return toRgb(image.channels.size() == 2 && findChannel(image, "Y") // grey with alpha
                             ? selectChannels(image, std::vector<std::string>{"Y"})
                             : image);
        }
        Image result = selectChannels(image, std::vector{prefix + "R", prefix + "G", prefix + "B"});
        result.channels = {"R", "G", "B"};
        return result;
    } catch (const std::invalid_argument& error) {
        throw FileError(file.string() + ": " + error.what());
    }
}

std::string listOf(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

/// Keeps of the mask what `keep` says of the channel's values.
template <typename Keep> void restrict(Mask& mask, const Image& image, std::size_t channel, Keep keep) {
    mask.resize(image.pixelCount(), 1);
    for (std::size_t pixel = 0; pixel < mask.size(); ++pixel) {
        if (!keep(image.values[pixel * image.channels.size() + channel])) {
            mask[pixel] = 0;
        }
    }
}

/// FILE, or FILE and CHANNEL where there is no file of the whole name.
std::pair<Path, std::string> splitMask(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || std::filesystem::exists(text)) {
        return {text, ""};
    }
    return {text.substr(0, colon), text.substr(colon + 1)};
}

void applyMask(const CompareOptions& options, const Image& reference, Mask& mask) {
    const auto [file, channel] = splitMask(options.mask);
    const Image image = readImage(file);
    requireSize(image, file, reference, options.reference);
    const std::optional<std::size_t> place = channel.empty() ? 0 : findChannel(image, channel);
    if (!place) {
        throw FileError(file.string() + ": has no channel " + channel + "; it has " + listOf(image.channels));
    }
    restrict(mask, image, *place, [](float value) { return value != 0 && !std::isnan(value); });
}

/// The materials' names, of which the first has id 1.
std::vector<std::string> materialNames(const Path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    const nlohmann::json report = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
    std::vector<std::string> names;
    try {
        for (const nlohmann::json& material : report.at("scene").at("materials")) {
            names.push_back(material.at("name").get<std::string>());
        }
    } catch (const nlohmann::json::exception&) {
        throw FileError(file.string() + ": is not a report of `nacre render --json`: it has no scene.materials");
    }
    return names;
}

std::optional<unsigned> parseId(const std::string& text) {
    unsigned id = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(id) : std::nullopt;
}

/// The ids that one --material means: a number, or all that have the name.
std::vector<float> idsOf(const std::string& material, const CompareOptions& options,
                         const std::vector<std::string>& names) {
    if (const std::optional<unsigned> id = parseId(material)) {
        return {static_cast<float>(*id)};
    }
    if (options.report.empty()) {
        throw FileError("--material '" + material + "' is a name, and names need --report FILE");
    }
    std::vector<float> ids;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == material) {
            ids.push_back(static_cast<float>(i + 1));
        }
    }
    if (ids.empty()) {
        throw FileError(options.report.string() + ": has no material '" + material + "'; it has " + listOf(names));
    }
    return ids;
}

/// The image with the ids, and the channel they are in.
std::pair<Image, std::size_t> findIds(const CompareOptions& options, const Image& test, const Image& reference) {
    const auto channelOf = [](const Image& image) {
        const std::optional<std::size_t> layered = findChannel(image, "material.ID");
        return layered ? layered : findChannel(image, "ID");
    };
    if (!options.materialImage.empty()) {
        Image image = readImage(options.materialImage);
        requireSize(image, options.materialImage, reference, options.reference);
        if (const auto channel = channelOf(image)) {
            return {std::move(image), *channel};
        }
        throw FileError(options.materialImage.string() + ": has no channel ID; it has " + listOf(image.channels));
    }
    for (const Image* image : {&reference, &test}) {
        if (const auto channel = channelOf(*image)) {
            return {*image, *channel};
        }
    }
    throw FileError("--material needs ids: neither " + options.reference.string() + " nor " + options.test.string() +
                    " has a channel ID, and there is no --material-image");
}

std::vector<std::string> applyMaterials(const CompareOptions& options, const Image& test, const Image& reference,
                                        Mask& mask) {
    const std::vector<std::string> names =
        options.report.empty() ? std::vector<std::string>() : materialNames(options.report);
    std::vector<float> ids;
    for (const std::string& material : options.materials) {
        std::ranges::copy(idsOf(material, options, names), std::back_inserter(ids));
    }
    const auto [image, channel] = findIds(options, test, reference);
    restrict(mask, image, channel, [&](float value) { return std::ranges::find(ids, value) != ids.end(); });
    std::vector<std::string> labels;
    for (const float id : ids) {
        const auto number = static_cast<std::size_t>(id);
        const bool isNamed = number >= 1 && number <= names.size();
        labels.push_back(std::to_string(number) + (isNamed ? " (" + names[number - 1] + ")" : ""));
    }
    return labels;
}

/// That of the difference: the sum of the variances that there are; empty where there is none.
Image findVariance(const CompareOptions& options, const Image& test, const Image& reference) {
    Image sum;
    const auto add = [&](const Image& variance) {
        if (sum.values.empty()) {
            sum = variance;
        } else {
            std::ranges::transform(variance.values, sum.values, sum.values.begin(), std::plus<>());
        }
    };
    if (!options.variance.empty()) {
        const Image image = readImage(options.variance);
        requireSize(image, options.variance, reference, options.reference);
        add(colorsOf(image, options.variance, findChannel(image, "variance.R") ? "variance." : ""));
    } else if (findChannel(reference, "variance.R")) {
        add(colorsOf(reference, options.reference, "variance."));
    }
    if (findChannel(test, "variance.R")) {
        add(colorsOf(test, options.test, "variance."));
    }
    return sum;
}

const char* kindOf(const Image& image) {
    return image.encoding == Encoding::Srgb ? "made to be shown" : "linear light";
}

} // namespace

CompareInputs readInputs(const CompareOptions& options) {
    const Image test = readImage(options.test);
    const Image reference = readImage(options.reference);
    requireSize(test, options.test, reference, options.reference);
    CompareInputs inputs;
    inputs.test = colorsOf(test, options.test);
    inputs.reference = colorsOf(reference, options.reference);
    ComparisonSettings& settings = inputs.settings;
    if (options.metric == CompareMetric::Auto) {
        if (test.encoding != reference.encoding) {
            throw FileError(options.test.string() + " is " + kindOf(test) + " and " + options.reference.string() +
                            " is " + kindOf(reference) + "; --metric ldr or hdr makes them alike");
        }
        settings.flip = test.encoding == Encoding::Srgb ? FlipKind::Ldr : FlipKind::Hdr;
    } else {
        settings.flip = options.metric == CompareMetric::Ldr ? FlipKind::Ldr : FlipKind::Hdr;
        const Encoding encoding = settings.flip == FlipKind::Ldr ? Encoding::Srgb : Encoding::Linear;
        inputs.test = toEncoding(std::move(inputs.test), encoding);
        inputs.reference = toEncoding(std::move(inputs.reference), encoding);
    }
    settings.pixelsPerDegree = options.pixelsPerDegree;
    settings.peak = options.peak;
    if (!options.mask.empty()) {
        applyMask(options, reference, settings.mask);
    }
    if (!options.materials.empty()) {
        inputs.materials = applyMaterials(options, test, reference, settings.mask);
    }
    if (countedPixels(reference, settings.mask) == 0) {
        throw FileError(options.reference.string() + ": no pixel is left to compare by --mask and --material");
    }
    if (inputs.reference.encoding == Encoding::Linear) {
        settings.variance = findVariance(options, test, reference);
    } else if (!options.variance.empty()) {
        throw FileError(options.variance.string() + ": a variance is of linear light, and the pictures are compared as "
                                                    "they are shown");
    }
    return inputs;
}

} // namespace nacre::app
