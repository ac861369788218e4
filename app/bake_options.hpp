// What `nacre bake thickness` was asked for, parsed and checked; nothing here opens a file.
#pragma once

#include "app/scene_options.hpp"
#include "bake/thickness_bake.hpp"

namespace nacre::app {

/// Where the values go.
enum class BakeForm {
    Exr, ///< a picture in mm
    Png, ///< a picture of 8 bits
    Ply  ///< a mesh with a value a vertex
};

struct BakeOptions : SceneOptions {
    std::filesystem::path output = "thickness.exr";
    std::filesystem::path json;
    BakeForm form = BakeForm::Exr;
    std::string surface;         ///< a surface's name; empty = the only one
    bool neutral = false;        ///< of no material
    std::optional<double> white; ///< [mm] Png; nothing = by the values
    bake::ThicknessSettings settings;
    bool resume = false;
    bool restart = false;
};

/// Adds the options to `command`. They are in `finish` once the command line has been parsed.
class BakeOptionParser {
public:
    explicit BakeOptionParser(CLI::App& command);

    /// The options, checked. Throws UsageError naming the option and its value.
    BakeOptions finish() const;

private:
    const CLI::App& command_;
    BakeOptions options_;
    std::string size_ = "1024x1024";
};

} // namespace nacre::app
