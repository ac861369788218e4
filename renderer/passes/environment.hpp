// Light from all around: an equirectangular image, its diffuse irradiance as spherical harmonics and its specular
// reflection as a prefiltered cube map. Internal to the renderer.
//
// Equirectangular images have -Z at their centre, +X a quarter to the right, +Y at the top.
#pragma once

#include "renderer/passes/shader_types.h"
#include "renderer/vulkan/compute_pass.hpp"
#include "scene/scene.hpp"

#include <array>

namespace nacre::renderer {

class Environment {
public:
    Environment(Gpu& gpu, const scene::Environment& environment, std::uint32_t framesInFlight);

    /// Replaces scene::Environment's intensity and rotation, for frames that begin later.
    void setLook(float intensity, float rotation);
    /// Before what reads the environment in frame `frame` is recorded; its previous use must have finished.
    void beginFrame(std::uint32_t frame) { constantsBuffer_.write(frame, bytesOf(constants_)); }

    /// The surroundings as they are seen, RGBA16F, with mip levels.
    Image& radiance() { return radiance_; }
    /// GGX-weighted radiance, one cube level per roughness (shared::specularLevels).
    Image& specular() { return specular_; }
    /// Split-sum terms over N·V (x) and roughness (y): reflection = F0 · r + g.
    Image& reflectance() { return reflectance_; }
    const FrameBuffer& constants() const { return constantsBuffer_; }
    /// Linear, wraps around in longitude.
    const vk::raii::Sampler& sampler() const { return sampler_; }
    /// Linear, for reflectance().
    const vk::raii::Sampler& clampSampler() const { return clampSampler_; }

private:
    void uploadRadiance(Gpu& gpu, const nacre::Image& image);
    void prefilter(Gpu& gpu);

    Image radiance_;
    Image specular_;
    Image reflectance_;
    shared::EnvironmentConstants constants_{};
    FrameBuffer constantsBuffer_;
    vk::raii::Sampler sampler_ = nullptr;
    vk::raii::Sampler clampSampler_ = nullptr;
};

/// Irradiance of an equirectangular image: E(n) = Σ result[i] · Y_i(n) over the nine harmonics of degree 0 to 2, the
/// cosine lobe's factors π, 2π/3 and π/4 included (Ramamoorthi and Hanrahan 2001, eqs. 8 and 12).
std::array<glm::vec3, 9> irradianceHarmonics(const nacre::Image& image);

} // namespace nacre::renderer
