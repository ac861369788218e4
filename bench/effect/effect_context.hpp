// The effect on the renderer's device, and the images of its calls, made on the CPU. Lengths in millimetres.
#pragma once

#include "bench/synthetic/scatter_scenes.hpp"
#include "renderer/effect_arguments.hpp"

#include <list>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nacre::bench {

/// A context of the effect. Throws renderer::RendererError with what the effect said.
class EffectContext {
public:
    EffectContext(const NacreContextInfo& info, std::span<const Material> materials);

    NacreContext handle() const { return context_.get(); }
    /// Throws unless the result is NACRE_SUCCESS.
    void check(NacreResult result) const;

private:
    struct Destroy {
        void operator()(NacreContext context) const { nacreDestroyContext(context); }
    };

    std::unique_ptr<std::string> message_ = std::make_unique<std::string>(); ///< its address is known to the context
    std::unique_ptr<NacreContext_T, Destroy> context_;
};

/// Column-major; a focal length in px and the principal point in the middle, reversed and infinite; the camera looks
/// along -Z, depth is linear.
NacreView perspectiveView(VkExtent2D extent, double focalLength);

/// Images of one size that the effect reads and writes.
class EffectImages {
public:
    EffectImages(renderer::Gpu& gpu, VkExtent2D extent) : gpu_(gpu), extent_{extent.width, extent.height} {}

    /// One that the effect reads. Light is rounded to what the format has.
    renderer::Image& addLight(const std::string& name, vk::Format format, std::span<const Rgb> light);
    renderer::Image& addDepth(std::span<const float> depth);
    renderer::Image& addIds(vk::Format format, std::span<const std::uint16_t> ids);
    /// Square, of linear depth, one layer or six.
    renderer::Image& addShadowMap(std::uint32_t size, std::span<const float> texels);
    /// RGBA16F, that the effect writes.
    renderer::Image& addOutput(const std::string& name, vk::Format format);

private:
    renderer::Image& addInput(renderer::ImageInfo info, std::span<const std::byte> texels);

    renderer::Gpu& gpu_;
    vk::Extent2D extent_;
    std::list<renderer::Image> images_;
};

} // namespace nacre::bench
