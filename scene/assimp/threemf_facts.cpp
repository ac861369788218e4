#include "scene/assimp/threemf_facts.hpp"

#include "core/files/quoted_text.hpp"
#include "scene/scene.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <minizip/unzip.h>
#include <string_view>

namespace nacre::scene {
namespace {

struct ThreemfUnit {
    std::string_view name;
    double meters;
};
constexpr std::array threemfUnits{ThreemfUnit{"micron", 1e-6},     ThreemfUnit{"millimeter", 1e-3},
                                  ThreemfUnit{"centimeter", 1e-2}, ThreemfUnit{"inch", 0.0254},
                                  ThreemfUnit{"foot", 0.3048},     ThreemfUnit{"meter", 1}};

/// As much of the model as its first element may need.
constexpr unsigned headBytes = 1u << 16;

struct Close {
    void operator()(void* package) const { unzClose(package); }
};

bool isModel(void* package) {
    std::array<char, 256> name{};
    return unzGetCurrentFileInfo64(package, nullptr, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) == UNZ_OK &&
           std::string_view(name.data()).ends_with(".model");
}

/// Goes to the package's model, which nearly all call 3D/3dmodel.model.
bool locateModel(void* package) {
    constexpr int ignoresCase = 2;
    if (unzLocateFile(package, "3D/3dmodel.model", ignoresCase) == UNZ_OK) {
        return true;
    }
    int result = unzGoToFirstFile(package);
    while (result == UNZ_OK && !isModel(package)) {
        result = unzGoToNextFile(package);
    }
    return result == UNZ_OK;
}

/// The beginning of the package's model, empty where it cannot be read.
std::string readHead(const std::filesystem::path& file) {
    const std::unique_ptr<void, Close> package(unzOpen64(file.c_str()));
    std::string head;
    if (package && locateModel(package.get()) && unzOpenCurrentFile(package.get()) == UNZ_OK) {
        head.resize(headBytes);
        const int count = unzReadCurrentFile(package.get(), head.data(), headBytes);
        head.resize(static_cast<std::size_t>(std::max(count, 0)));
        unzCloseCurrentFile(package.get());
    }
    return head;
}

/// The value of an attribute of the element that begins at the start of `text`; empty where it has none.
std::string_view attributeOf(std::string_view text, std::string_view name) {
    text = text.substr(0, text.find('>'));
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        const bool begins = at > 0 && std::string_view(" \t\r\n").find(text[at - 1]) != std::string_view::npos;
        const std::size_t open = text.find_first_not_of(" \t\r\n=", at + name.size());
        if (begins && open != std::string_view::npos && (text[open] == '"' || text[open] == '\'')) {
            const std::string_view rest = text.substr(open + 1);
            return rest.substr(0, rest.find(text[open]));
        }
    }
    return {};
}

} // namespace

ThreemfFacts readThreemfFacts(const std::filesystem::path& file) {
    const std::string head = readHead(file);
    const std::size_t model = head.find("<model");
    const std::string_view unit =
        model == std::string::npos ? std::string_view() : attributeOf(std::string_view(head).substr(model), "unit");
    const std::string_view named = unit.empty() ? "millimeter" : unit;
    const auto* found = std::ranges::find(threemfUnits, named, &ThreemfUnit::name);
    if (found == threemfUnits.end()) {
        throw SceneError(file.string() + ": the model's unit is " + inQuotes(named) +
                         ", must be micron, millimeter, centimeter, inch, foot or meter");
    }
    const bool hasColors = head.find("colorgroup") != head.npos || head.find("texture2dgroup") != head.npos;
    return {found->meters, hasColors};
}

} // namespace nacre::scene
