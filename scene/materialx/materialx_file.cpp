#include "scene/materialx/materialx_file.hpp"

#include "core/files/open_pbr.hpp"
#include "scene/json_text.hpp"
#include "scene/materialx/materialx_document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

namespace nacre::scene {
namespace {

constexpr std::uint64_t maxDocumentBytes = std::uint64_t{16} << 20;
constexpr double centimetre = 0.01;
constexpr double millimetresPerMetre = 1000;

struct Range {
    double low;
    double high;
};
constexpr Range unitRange{0, 1};
constexpr Range lengths{0, 1e6};
constexpr Range factors{0, 1e6};

std::string expected(std::size_t count, const Range& range) {
    std::ostringstream text;
    text << (count == 1 ? "a number, " : "three numbers, ") << range.low << " to " << range.high;
    return text.str();
}

using Nodes = std::vector<pugi::xml_node>;

/// The children of the document and of its node graphs. Deeper ones are inputs and outputs.
Nodes nodesOf(const pugi::xml_node& root) {
    Nodes nodes;
    for (const pugi::xml_node& node : root.children()) {
        nodes.push_back(node);
        if (std::string_view(node.name()) == "nodegraph") {
            nodes.insert(nodes.end(), node.begin(), node.end());
        }
    }
    return nodes;
}

pugi::xml_node named(const Nodes& nodes, std::string_view name) {
    const auto found =
        std::ranges::find_if(nodes, [&](const auto& node) { return name == node.attribute("name").value(); });
    return found != nodes.end() ? *found : pugi::xml_node();
}

/// A shader node, whose inputs are asked for by name.
class Shader {
public:
    Shader(const pugi::xml_node& node, std::string file, MaterialXImport& result)
        : node_(node),
          file_(std::move(file)),
          field_(std::string(node.name()) + " " + shorten(node.attribute("name").value())),
          result_(result) {}

    void read(const char* input, double& value, const Range& range = unitRange) {
        if (const pugi::xml_node source = sourceOf(input)) {
            value = numbers<1>(input, source, range)[0];
        }
    }

    void read(const char* input, bool& value) {
        if (const pugi::xml_node source = sourceOf(input)) {
            const std::string_view text = source.attribute("value").value();
            if (text != "true" && text != "false") {
                refuse(input, text, "true or false");
            }
            value = text == "true";
        }
    }

    void read(const char* input, Rgb& value, const Range& range) {
        if (const pugi::xml_node source = sourceOf(input)) {
            value = numbers<3>(input, source, range);
        }
    }

    void readColor(const char* input, Rgb& value) {
        const pugi::xml_node source = sourceOf(input);
        if (!source) {
            return;
        }
        value = numbers<3>(input, source, unitRange);
        const std::string_view space = colorSpaceOf(source);
        if (const std::optional<Rgb> linear = toLinearRec709(value, space)) {
            value = *linear;
        } else {
            note(std::string(input) + " is in the colour space " + shorten(std::string(space)) +
                 ", and taken for linear Rec.709");
        }
    }

    /// [m] One unit of an input's length.
    double unitOf(const char* input, std::optional<double> metersPerUnit) {
        struct Unit {
            std::string_view name;
            double metres;
        };
        constexpr std::array units{Unit{"millimeter", 0.001}, Unit{"centimeter", 0.01}, Unit{"meter", 1},
                                   Unit{"micron", 1e-6},      Unit{"nanometer", 1e-9},  Unit{"kilometer", 1000},
                                   Unit{"inch", 0.0254},      Unit{"foot", 0.3048},     Unit{"yard", 0.9144},
                                   Unit{"mile", 1609.344}};
        const std::string text = sourceOf(input).attribute("unit").value();
        if (text.empty()) {
            if (!metersPerUnit) {
                note(std::string(input) + " has no unit; taken for centimetres");
            }
            return metersPerUnit.value_or(centimetre);
        }
        const auto* unit = std::ranges::find(units, text, &Unit::name);
        if (unit == units.end()) {
            refuse(input, text, "a unit of length of MaterialX");
        }
        return unit->metres;
    }

    [[noreturn]] void fail(const std::string& what) const { throw SceneError(file_ + ": " + field_ + ": " + what); }

private:
    /// Where an input's value is; nothing where it has its default.
    pugi::xml_node sourceOf(const char* name) {
        const pugi::xml_node input = node_.find_child_by_attribute("input", "name", name);
        const pugi::xml_node value = valueOf(input);
        if (input && !value) {
            note(std::string(name) + " is computed by nodes, which are not read; it has its default");
        }
        return value;
    }

    template <std::size_t count>
    std::array<double, count> numbers(const char* input, const pugi::xml_node& source, const Range& range) {
        const std::string_view text = source.attribute("value").value();
        std::array<double, count> values{};
        std::string_view rest = text;
        const auto skip = [&rest](std::string_view characters) {
            rest.remove_prefix(std::min(rest.find_first_not_of(characters), rest.size()));
        };
        for (std::size_t i = 0; i < count; ++i) {
            skip(i == 0 ? " \t\r\n" : " \t\r\n,");
            rest.remove_prefix(rest.starts_with('+') && !rest.starts_with("+-") ? 1 : 0);
            const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), values[i]);
            if (error != std::errc() || !(values[i] >= range.low && values[i] <= range.high)) {
                refuse(input, text, expected(count, range).c_str());
            }
            rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        }
        skip(" \t\r\n");
        if (!rest.empty()) {
            refuse(input, text, expected(count, range).c_str());
        }
        return values;
    }

    [[noreturn]] void refuse(const char* input, std::string_view value, const char* expected) const {
        fail(std::string(input) + " is " + shorten(std::string(value)) + ", must be " + expected);
    }

    void note(const std::string& what) {
        const std::string sentence = file_ + ": " + field_ + ": " + what;
        if (std::ranges::find(result_.notes, sentence) == result_.notes.end()) {
            result_.notes.push_back(sentence);
        }
    }

    pugi::xml_node node_;
    std::string file_;
    std::string field_;
    MaterialXImport& result_;
};

double millimetres(Shader& shader, const char* input, std::optional<double> metersPerUnit) {
    return shader.unitOf(input, metersPerUnit) * millimetresPerMetre;
}

OpenPbr readOpenPbr(Shader& shader, std::optional<double> metersPerUnit) {
    OpenPbr surface;
    shader.readColor("base_color", surface.baseColor);
    shader.read("subsurface_weight", surface.subsurfaceWeight);
    shader.readColor("subsurface_color", surface.subsurfaceColor);
    shader.read("subsurface_radius", surface.subsurfaceRadius, lengths);
    shader.read("subsurface_radius_scale", surface.subsurfaceRadiusScale, factors);
    shader.read("subsurface_scatter_anisotropy", surface.subsurfaceAnisotropy, {-1, 1});
    shader.read("specular_weight", surface.specularWeight, factors);
    shader.read("specular_roughness", surface.specularRoughness);
    shader.read("specular_ior", surface.specularIor, {1, 3});
    shader.read("geometry_thin_walled", surface.thinWalled);
    if (!surface.thinWalled) {
        surface.subsurfaceRadius *= millimetres(shader, "subsurface_radius", metersPerUnit);
    }
    return surface;
}

/// Autodesk Standard Surface 1.0.1, whose radius is a colour and whose scale is a number.
OpenPbr readStandardSurface(Shader& shader, std::optional<double> metersPerUnit) {
    OpenPbr surface;
    surface.subsurfaceColor = surface.subsurfaceRadiusScale = {1, 1, 1};
    surface.specularRoughness = 0.2;
    double base = 1;
    shader.read("base", base);
    shader.readColor("base_color", surface.baseColor);
    shader.read("subsurface", surface.subsurfaceWeight);
    shader.readColor("subsurface_color", surface.subsurfaceColor);
    shader.read("subsurface_radius", surface.subsurfaceRadiusScale, factors);
    shader.read("subsurface_scale", surface.subsurfaceRadius, lengths);
    shader.read("subsurface_anisotropy", surface.subsurfaceAnisotropy, {-1, 1});
    shader.read("specular", surface.specularWeight, factors);
    shader.read("specular_roughness", surface.specularRoughness);
    shader.read("specular_IOR", surface.specularIor, {1, 3});
    shader.read("thin_walled", surface.thinWalled);
    for (double& channel : surface.baseColor) {
        channel *= base;
    }
    if (!surface.thinWalled) {
        surface.subsurfaceRadius *= millimetres(shader, "subsurface_radius", metersPerUnit);
    }
    return surface;
}

struct Kind {
    std::string_view node;
    OpenPbr (*read)(Shader& shader, std::optional<double> metersPerUnit);
};
constexpr std::array kinds{Kind{"open_pbr_surface", readOpenPbr}, Kind{"standard_surface", readStandardSurface}};

const Kind* kindOf(const pugi::xml_node& node) {
    const auto* kind = std::ranges::find(kinds, std::string_view(node.name()), &Kind::node);
    return kind != kinds.end() ? kind : nullptr;
}

std::string listShaders(const Nodes& shaders) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(shaders.size(), 10); ++i) {
        text += (i == 0 ? "" : ", ") + shorten(shaders[i].attribute("name").value());
    }
    return text + (shaders.size() > 10 ? ", ..." : "");
}

/// The shader node of that name, or of a material of that name.
pugi::xml_node chooseShader(const Nodes& nodes, const std::string& name, const std::string& file) {
    Nodes shaders;
    std::ranges::copy_if(nodes, std::back_inserter(shaders), [](const auto& node) { return kindOf(node) != nullptr; });
    if (shaders.empty()) {
        throw SceneError(file + ": has neither an open_pbr_surface nor a standard_surface");
    }
    if (name.empty()) {
        if (shaders.size() > 1) {
            throw SceneError(file +
                             ": has several shader nodes, one must be chosen by its name: " + listShaders(shaders));
        }
        return shaders.front();
    }
    if (pugi::xml_node shader = named(shaders, name)) {
        return shader;
    }
    const pugi::xml_node material = named(nodes, name);
    const pugi::xml_node input = material.find_child_by_attribute("input", "name", "surfaceshader");
    if (pugi::xml_node shader = input ? named(shaders, input.attribute("nodename").value()) : pugi::xml_node()) {
        return shader;
    }
    throw SceneError(file + ": has no shader node or material " + shorten(name) + ", only " + listShaders(shaders));
}

} // namespace

MaterialXImport importMaterialX(std::span<const std::uint8_t> bytes, const std::filesystem::path& file,
                                const std::string& name, std::optional<double> metersPerUnit) {
    MaterialXImport result;
    const pugi::xml_document document = parseMaterialX(bytes, file, result.notes, result.inputs);
    const pugi::xml_node node = chooseShader(nodesOf(document.child("materialx")), name, file.string());
    Shader shader(node, file.string(), result);
    const OpenPbr surface = kindOf(node)->read(shader, metersPerUnit);
    if (surface.subsurfaceWeight == 0) {
        shader.fail("has a subsurface weight of 0: no light travels under the surface");
    }
    result.material = materialOf(surface);
    result.material.name = name.empty() ? node.attribute("name").value() : name;
    result.material.description = std::string(node.name()) + " of " + file.filename().string();
    return result;
}

MaterialXImport importMaterialX(const std::filesystem::path& file, const std::string& name,
                                std::optional<double> metersPerUnit) {
    return importMaterialX(readFile(file, maxDocumentBytes), file, name, metersPerUnit);
}

} // namespace nacre::scene
