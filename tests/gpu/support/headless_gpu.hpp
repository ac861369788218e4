// A small headless Vulkan: one device under the validation layers with synchronisation validation, images with upload
// and download, command submission, timestamps. For the tests of everything that runs on the GPU.
#pragma once

#include "nacre/nacre.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nacre::tests {

class Gpu;

/// A 2D image (a 2D array where `layers` > 1 or asked for) that lives in `layout`. Move-only.
class GpuImage {
public:
    GpuImage() = default;
    GpuImage(GpuImage&& other) noexcept { *this = std::move(other); }
    GpuImage& operator=(GpuImage&& other) noexcept;
    ~GpuImage();

    /// What the effect's structs take.
    NacreImage nacre() const { return {view, format, layout, extent, usage}; }
    /// One layer of it as a 2D image; see ImageSettings::layerViews.
    NacreImage nacreLayer(std::uint32_t layer) const { return {layerViews.at(layer), format, layout, extent, usage}; }

    Gpu* gpu = nullptr;
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
    VkExtent2D extent{};
    VkImageUsageFlags usage = 0;
    std::uint32_t layers = 1;
    std::vector<VkImageView> layerViews;
};

struct ImageSettings {
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    VkExtent2D extent{};
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
    VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
    std::uint32_t layers = 1;
    bool array = false;      ///< a 2D array view even of one layer
    bool layerViews = false; ///< also a 2D view of every layer
    bool stencil = false;    ///< the view's aspect is the stencil, where there is a depth, too
    VkComponentMapping components{};
};

/// Bytes of one texel; throws for formats the tests do not use.
std::size_t texelBytes(VkFormat format);

class Gpu {
public:
    /// Opens the first Vulkan 1.2 device with the features the effect requires; `validation`: under the validation
    /// layers. Throws std::runtime_error.
    explicit Gpu(bool validation = true);
    ~Gpu();
    Gpu(const Gpu&) = delete;

    /// The process's device.
    static Gpu& instance();

    /// What the validation layers said since the last call.
    std::vector<std::string> takeMessages();

    GpuImage createImage(const ImageSettings& settings);
    /// Fills an image with tightly packed texels, layer after layer.
    void upload(GpuImage& image, std::span<const std::byte> texels);
    template <typename T> void upload(GpuImage& image, const std::vector<T>& texels) {
        upload(image, std::as_bytes(std::span(texels)));
    }
    /// A square shadow map of linear depths, one layer or six, as nacreCmdTransmit reads it.
    GpuImage createShadowMap(std::uint32_t size, const std::vector<float>& texels);
    std::vector<std::byte> downloadBytes(const GpuImage& image);
    template <typename T> std::vector<T> download(const GpuImage& image) {
        const std::vector<std::byte> bytes = downloadBytes(image);
        std::vector<T> texels(bytes.size() / sizeof(T));
        std::memcpy(texels.data(), bytes.data(), bytes.size());
        return texels;
    }

    VkCommandBuffer begin();
    /// Ends, submits and waits.
    void submit(VkCommandBuffer commandBuffer);
    /// Records with `record`, submits and waits.
    void run(const std::function<void(VkCommandBuffer)>& record);
    /// As run, with a query pool of `count` timestamps; returns the microseconds between them.
    std::vector<double> runTimed(std::uint32_t count, const std::function<void(VkCommandBuffer, VkQueryPool)>& record);

    /// The first of these memory types with these properties; throws where there is none.
    std::uint32_t memoryType(std::uint32_t bits, VkMemoryPropertyFlags wanted) const;
    /// A context's info with this device filled in. Its contexts share pipelines, see sharingGetInstanceProcAddr.
    NacreContextInfo contextInfo(VkExtent2D maxExtent) const;

    VkInstance vkInstance = VK_NULL_HANDLE;
    VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    std::uint32_t queueFamily = 0;
    VkBool32 shaderFloat16 = VK_FALSE; ///< enabled where the device has it
    VkPhysicalDeviceProperties properties{};

private:
    struct Staging;
    Staging createStaging(VkDeviceSize size);
    void transition(VkCommandBuffer commandBuffer, const GpuImage& image, VkImageLayout from, VkImageLayout to) const;

    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::vector<std::string> messages_;
};

/// A test that fails on any message of the validation layers.
class GpuTest : public testing::Test {
protected:
    void SetUp() override { gpu.takeMessages(); }
    void TearDown() override {
        for (const std::string& message : gpu.takeMessages()) {
            ADD_FAILURE() << message;
        }
    }
    Gpu& gpu = Gpu::instance();
};

} // namespace nacre::tests
