#include "scene/materialx/materialx_document.hpp"

#include "image/color.hpp"
#include "nacre/files.hpp"
#include "scene/json_text.hpp"
#include "scene/named_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace nacre::scene {
namespace {

constexpr std::uint64_t mostBytes = std::uint64_t{16} << 20;
constexpr std::size_t mostFiles = 64;

pugi::xml_document parse(std::span<const std::uint8_t> bytes, const std::filesystem::path& file) {
    pugi::xml_document document;
    // Without document types there are no entities of a document's own: nothing expands, nothing is fetched.
    const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size(), pugi::parse_default);
    if (!parsed) {
        throw SceneError(file.string() + ": is not valid XML: " + parsed.description() + " at byte " +
                         std::to_string(parsed.offset));
    }
    if (!document.child("materialx")) {
        throw SceneError(file.string() + ": is not a MaterialX document: it has no element materialx");
    }
    return document;
}

/// XInclude's element, whatever prefix its namespace has.
bool isInclude(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    return name == "include" || name.ends_with(":include");
}

class Includer {
public:
    Includer(pugi::xml_node root, std::uint64_t bytes, std::vector<std::string>& notes,
             std::vector<std::string>& inputs)
        : root_(root), bytes_(bytes), notes_(notes), inputs_(inputs) {}

    void include(const pugi::xml_node& document, const std::filesystem::path& file) {
        files_.insert(std::filesystem::weakly_canonical(file));
        for (const pugi::xml_node& node : document.children()) {
            if (isInclude(node)) {
                follow(node.attribute("href").value(), file);
            }
        }
    }

private:
    void follow(const std::string& reference, const std::filesystem::path& owner) {
        const std::string where = owner.string() + ": includes " + shorten(reference) + ", which ";
        const std::filesystem::path file = tryNamedFile(owner, reference);
        if (file.empty()) {
            notes_.push_back(where + faultOfNamedFile(owner, reference) + "; it is left out");
            return;
        }
        if (files_.contains(std::filesystem::weakly_canonical(file))) {
            return;
        }
        if (files_.size() > mostFiles) {
            throw SceneError(owner.string() + ": includes more than " + std::to_string(mostFiles) + " documents");
        }
        const std::vector<std::uint8_t> bytes = readFile(file, mostBytes);
        bytes_ += bytes.size();
        if (bytes_ > mostBytes) {
            throw SceneError(owner.string() + ": and what it includes have more than " +
                             std::to_string(mostBytes >> 20) + " MiB, the most that is read");
        }
        inputs_.push_back(file.string());
        const pugi::xml_document document = parse(bytes, file);
        const pugi::xml_node included = document.child("materialx");
        include(included, file);
        for (const pugi::xml_node& node : included.children()) {
            if (!isInclude(node)) {
                keepColorSpace(included, root_.append_copy(node));
            }
        }
    }

    static void keepColorSpace(const pugi::xml_node& from, pugi::xml_node to) {
        if (from.attribute("colorspace") && !to.attribute("colorspace") && to.type() == pugi::node_element) {
            to.append_attribute("colorspace") = from.attribute("colorspace").value();
        }
    }

    pugi::xml_node root_;
    std::uint64_t bytes_;
    std::set<std::filesystem::path> files_;
    std::vector<std::string>& notes_;
    std::vector<std::string>& inputs_;
};

/// The output of a node graph by its name, or the only one.
pugi::xml_node outputOf(const pugi::xml_node& graph, const char* name) {
    const pugi::xml_node output =
        *name != '\0' ? graph.find_child_by_attribute("output", "name", name) : graph.child("output");
    return output;
}

/// The element that the connection of an input or an output leads to; empty where a node computes.
pugi::xml_node follow(const pugi::xml_node& end) {
    const pugi::xml_node owner = end.parent();
    const bool isOutput = std::string_view(end.name()) == "output";
    const pugi::xml_node scope = isOutput ? owner : owner.parent();
    if (const pugi::xml_attribute interface = end.attribute("interfacename")) {
        return scope.find_child_by_attribute("input", "name", interface.value());
    }
    const char* const output = end.attribute("output").value();
    if (const pugi::xml_attribute graph = end.attribute("nodegraph")) {
        return outputOf(end.root().child("materialx").find_child_by_attribute("nodegraph", "name", graph.value()),
                        output);
    }
    const char* const name = end.attribute("nodename").value();
    if (*name == '\0') {
        return {};
    }
    pugi::xml_node node = scope.find_child_by_attribute("name", name);
    node = node ? node : end.root().child("materialx").find_child_by_attribute("name", name);
    const std::string_view kind = node.name();
    return kind == "constant"    ? node.find_child_by_attribute("input", "name", "value")
           : kind == "dot"       ? node.find_child_by_attribute("input", "name", "in")
           : kind == "nodegraph" ? outputOf(node, output)
                                 : pugi::xml_node();
}

using Matrix = std::array<Rgb, 3>;
constexpr Matrix identity{Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0, 0, 1}};
// From the primaries, as rows; AP1's white is adapted by Bradford's method.
constexpr Matrix fromAp1{Rgb{1.705050993, -0.621792121, -0.083258872}, Rgb{-0.130256418, 1.140804737, -0.010548319},
                         Rgb{-0.024003357, -0.128968976, 1.152972333}};
constexpr Matrix fromAdobe{Rgb{1.398355744, -0.398355744, 0}, Rgb{0, 1, 0}, Rgb{0, -0.042928989, 1.042928989}};
constexpr Matrix fromDisplayP3{Rgb{1.224940176, -0.224940176, 0}, Rgb{-0.042056955, 1.042056955, 0},
                               Rgb{-0.019637555, -0.078636046, 1.098273600}};

double linear(double value) {
    return value;
}
double srgb(double value) {
    return double{decodeSrgb(static_cast<float>(value))};
}
template <int tenths> double gamma(double value) {
    return std::pow(value, tenths / 10.0);
}
double adobe(double value) {
    return std::pow(value, 563.0 / 256);
}

struct Space {
    std::string_view name;
    double (*decode)(double);
    const Matrix& matrix;
};
constexpr std::array spaces{Space{"", linear, identity},
                            Space{"none", linear, identity},
                            Space{"lin_rec709", linear, identity},
                            Space{"lin_rec709_scene", linear, identity},
                            Space{"srgb_texture", srgb, identity},
                            Space{"srgb_rec709_scene", srgb, identity},
                            Space{"g18_rec709", gamma<18>, identity},
                            Space{"g18_rec709_scene", gamma<18>, identity},
                            Space{"g22_rec709", gamma<22>, identity},
                            Space{"g22_rec709_scene", gamma<22>, identity},
                            Space{"rec709_display", gamma<24>, identity},
                            Space{"acescg", linear, fromAp1},
                            Space{"lin_ap1", linear, fromAp1},
                            Space{"lin_ap1_scene", linear, fromAp1},
                            Space{"g22_ap1", gamma<22>, fromAp1},
                            Space{"lin_adobergb", linear, fromAdobe},
                            Space{"adobergb", adobe, fromAdobe},
                            Space{"lin_displayp3", linear, fromDisplayP3},
                            Space{"srgb_displayp3", srgb, fromDisplayP3}};

} // namespace

pugi::xml_document parseMaterialX(std::span<const std::uint8_t> bytes, const std::filesystem::path& file,
                                  std::vector<std::string>& notes, std::vector<std::string>& inputs) {
    pugi::xml_document document = parse(bytes, file);
    const pugi::xml_node root = document.child("materialx");
    const std::vector<pugi::xml_node> own(root.begin(), root.end());
    if (std::ranges::any_of(own, isInclude)) {
        Includer(root, bytes.size(), notes, inputs).include(root, file);
    }
    return document;
}

pugi::xml_node valueOf(const pugi::xml_node& input) {
    constexpr int mostConnections = 32;
    pugi::xml_node element = input;
    for (int i = 0; i < mostConnections && element && !element.attribute("value"); ++i) {
        element = follow(element);
    }
    return element.attribute("value") ? element : pugi::xml_node();
}

std::string_view colorSpaceOf(const pugi::xml_node& element) {
    for (pugi::xml_node node = element; node; node = node.parent()) {
        if (const pugi::xml_attribute space = node.attribute("colorspace")) {
            return space.value();
        }
    }
    return "";
}

std::optional<Rgb> toLinearRec709(const Rgb& color, std::string_view space) {
    const auto* known = std::ranges::find(spaces, space, &Space::name);
    if (known == spaces.end()) {
        return std::nullopt;
    }
    Rgb decoded;
    std::ranges::transform(color, decoded.begin(), known->decode);
    Rgb result;
    for (std::size_t i = 0; i < 3; ++i) {
        const Rgb& row = known->matrix[i];
        // What Rec.709 does not have is cut off.
        result[i] = std::clamp(row[0] * decoded[0] + row[1] * decoded[1] + row[2] * decoded[2], 0.0, 1.0);
    }
    return result;
}

} // namespace nacre::scene
