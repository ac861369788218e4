// What `nacre reference` was asked for, parsed and checked; nothing here opens a file.
#pragma once

#include "app/scene_options.hpp"
#include "reference/reference.hpp"

namespace nacre::app {

struct ReferenceOptions : SceneOptions {
    std::filesystem::path output = "reference.exr";
    std::filesystem::path json;
    std::filesystem::path direct; ///< an irradiance image of `nacre render`; empty = traced
    reference::Settings settings; ///< all but `direct`
    reference::Stop stop;
    bool resume = false;
    bool restart = false;
};

/// Adds the options to `command`. They are in `finish` once the command line has been parsed.
class ReferenceOptionParser {
public:
    explicit ReferenceOptionParser(CLI::App& command);

    /// The options, checked. Throws UsageError naming the option and its value.
    ReferenceOptions finish() const;

private:
    const CLI::App& command_;
    ReferenceOptions options_;
    SceneOptionParser scene_;
    std::string method_ = "surface";
    std::string boundary_ = "matched";
    std::string part_;
    std::optional<std::uint32_t> spp_;
    std::optional<double> seconds_;
    std::optional<double> noise_; ///< [%]
    bool noExchange_ = false;
};

} // namespace nacre::app
