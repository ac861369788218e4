// What `nacre compare --suite` was asked for, parsed and checked; nothing here opens a device or a file.
#pragma once

#include "bench/accuracy/accuracy_run.hpp"

namespace CLI {
class App;
}

namespace nacre::app {

struct AccuracySuiteOptions {
    bench::AccuracyPlan plan; ///< all but `pictures`
    std::filesystem::path output = "nacre-accuracy";
    renderer::DeviceSettings device;
    bool list = false; ///< only say what there is
};

/// Adds the options to `command`, where they need --suite. They are in `finish` once the command line has been parsed.
class AccuracySuiteParser {
public:
    explicit AccuracySuiteParser(CLI::App& command);

    /// Whether --suite was given.
    bool isAsked() const { return suite_; }
    /// The options, checked. Throws UsageError naming the option and its value.
    AccuracySuiteOptions finish() const;

private:
    std::vector<bench::AccuracyViewEntry> chooseViews() const;

    bool suite_ = false;
    AccuracySuiteOptions options_;
    std::vector<std::string> views_;
    std::vector<std::string> techniques_;
    std::vector<std::string> references_;
    std::vector<std::filesystem::path> models_;
    std::string size_ = "240x135";
    std::optional<std::uint32_t> spp_;
    std::optional<double> seconds_;
    std::optional<double> noise_; ///< [%]
};

} // namespace nacre::app
