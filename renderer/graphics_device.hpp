// Finds a Vulkan 1.3 device and opens it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace nacre::renderer {

/// What went wrong, in one sentence.
struct RendererError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The device is gone: everything made with it has to be made anew, with another Device.
struct DeviceLost : RendererError {
    DeviceLost() : RendererError("the graphics device has stopped working and has to be opened again") {}
};

struct DeviceDescription {
    std::string name;
    std::string kind; ///< "discrete", "integrated", "virtual", "software" or "other"
    std::string driver;
    std::string apiVersion;
    bool usable = false;
    std::string reason; ///< why it is not usable, in one sentence
};

/// Every Vulkan device of this machine. Throws RendererError when there is no Vulkan loader or device.
std::vector<DeviceDescription> listDevices();

struct DeviceSettings {
    std::string name;        ///< an index, or part of a name; empty = the fastest kind there is
    bool validation = false; ///< validation layer with synchronisation validation; messages become validationMessages()
    std::vector<std::string> instanceExtensions; ///< to enable besides the renderer's own, as a window's surface needs
    std::vector<std::string> deviceExtensions;   ///< likewise, as a swapchain needs
};

/// An open device with one queue. Defined in renderer/vulkan/open_device.hpp; applications only pass it on.
class Device {
public:
    explicit Device(const DeviceSettings& settings);
    ~Device();
    Device(Device&&) noexcept;

    const DeviceDescription& description() const;
    /// Everything the validation layer has said so far.
    const std::vector<std::string>& validationMessages() const;

    struct Implementation;
    Implementation& implementation() { return *implementation_; }

private:
    std::unique_ptr<Implementation> implementation_;
};

} // namespace nacre::renderer
