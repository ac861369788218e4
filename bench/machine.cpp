#include "bench/machine.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

namespace nacre::bench {
namespace {

std::vector<std::string> linesOf(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::optional<double> numberIn(std::string_view text) {
    const std::size_t begin = text.find_first_of("0123456789");
    double value = 0;
    if (begin == std::string_view::npos ||
        std::from_chars(text.data() + begin, text.data() + text.size(), value).ec != std::errc{}) {
        return std::nullopt;
    }
    return value;
}

// The values of every "key : value" line of /proc/cpuinfo with this key.
std::vector<std::string> processorValues(std::string_view key) {
    std::vector<std::string> values;
    for (const std::string& line : linesOf("/proc/cpuinfo")) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with(key) && colon != std::string::npos) {
            values.push_back(line.substr(colon + 2));
        }
    }
    return values;
}

std::vector<Clock> processorClocks() {
    double fastest = 0;
    for (const std::string& value : processorValues("cpu MHz")) {
        fastest = std::max(fastest, numberIn(value).value_or(0));
    }
    return fastest > 0 ? std::vector<Clock>{{"processor, fastest core", fastest, 0}} : std::vector<Clock>{};
}

// NVIDIA's management library (nvml.h); its constants and signatures are part of its stable interface.
class ManagementLibrary {
public:
    ManagementLibrary() : library_(dlopen("libnvidia-ml.so.1", RTLD_NOW | RTLD_LOCAL)) {
        using Function = int (*)();
        const auto initialize = find<Function>("nvmlInit_v2");
        ready_ = initialize != nullptr && initialize() == 0;
    }
    ~ManagementLibrary() {
        if (const auto shutdown = find<int (*)()>("nvmlShutdown"); ready_ && shutdown != nullptr) {
            shutdown();
        }
        if (library_ != nullptr) {
            dlclose(library_);
        }
    }
    ManagementLibrary(const ManagementLibrary&) = delete;
    ManagementLibrary& operator=(const ManagementLibrary&) = delete;

    std::vector<Clock> clocksOf(std::string_view device) const {
        const auto count = find<int (*)(unsigned*)>("nvmlDeviceGetCount_v2");
        const auto handleOf = find<int (*)(unsigned, void**)>("nvmlDeviceGetHandleByIndex_v2");
        const auto nameOf = find<int (*)(void*, char*, unsigned)>("nvmlDeviceGetName");
        const auto clockOf = find<int (*)(void*, int, unsigned*)>("nvmlDeviceGetClockInfo");
        unsigned devices = 0;
        if (!ready_ || !count || !handleOf || !nameOf || !clockOf || count(&devices) != 0) {
            return {};
        }
        for (unsigned index = 0; index < devices; ++index) {
            void* handle = nullptr;
            char name[96] = {};
            if (handleOf(index, &handle) != 0 || nameOf(handle, name, sizeof name) != 0 || device != name) {
                continue;
            }
            std::vector<Clock> clocks;
            for (const auto& [kind, label] : {std::pair{1, "streaming multiprocessors"}, std::pair{2, "memory"}}) {
                unsigned frequency = 0;
                if (clockOf(handle, kind, &frequency) == 0) {
                    clocks.push_back({label, static_cast<double>(frequency), 0});
                }
            }
            return clocks;
        }
        return {};
    }

private:
    template <typename Function> Function find(const char* name) const {
        return library_ == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(library_, name));
    }

    void* library_;
    bool ready_ = false;
};

// The one card of this machine that the kernel shows: amdgpu marks the current state of pp_dpm_* with a star, i915 has
// a file for it.
std::vector<Clock> kernelClocks() {
    std::vector<Clock> clocks;
    std::error_code error;
    for (const auto& card : std::filesystem::directory_iterator("/sys/class/drm", error)) {
        for (const auto& [file, label] :
             {std::pair{"device/pp_dpm_sclk", "shader"}, {"device/pp_dpm_mclk", "memory"}}) {
            for (const std::string& line : linesOf(card.path() / file)) {
                const std::size_t colon = line.find(':');
                if (line.ends_with('*') && colon != std::string::npos) {
                    clocks.push_back({label, numberIn(line.substr(colon)).value_or(0), 0});
                }
            }
        }
        for (const std::string& line : linesOf(card.path() / "gt_act_freq_mhz")) {
            clocks.push_back({"graphics", numberIn(line).value_or(0), 0});
        }
    }
    return clocks;
}

} // namespace

std::string processorName() {
    const std::vector<std::string> names = processorValues("model name");
    return names.empty() ? "unknown" : names.front();
}

std::vector<Clock> readClocks(std::string_view device, bool software) {
    if (software) {
        return processorClocks();
    }
    const std::vector<Clock> clocks = ManagementLibrary().clocksOf(device);
    return clocks.empty() ? kernelClocks() : clocks;
}

} // namespace nacre::bench
