#include "renderer/offscreen.hpp"

#include "renderer/frame.hpp"
#include "renderer/readback.hpp"
#include "renderer/vulkan/translate_errors.hpp"

namespace nacre::renderer {

struct Offscreen::Implementation {
    /// Records the one frame there is, submits it and waits.
    template <typename Recorder> void submit(const Recorder& recorder) {
        bool isRecorded = false; // what fails while it is recorded discards itself
        try {
            translateErrors([&] {
                gpu.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
                    recorder(commandBuffer);
                    isRecorded = true;
                });
            });
        } catch (const RendererError&) {
            if (isRecorded) {
                frame.discard();
            }
            throw;
        }
        report = frame.report(0);
    }

    Gpu& gpu;
    Frame frame;
    FrameReport report;
};

Offscreen::Offscreen(Device& device, const scene::Scene& scene, const RenderSettings& settings)
    : implementation_(new Implementation{device.implementation(), Frame(device, scene, settings), {}}) {}

Offscreen::~Offscreen() = default;
Offscreen::Offscreen(Offscreen&&) noexcept = default;

void Offscreen::render(const scene::Camera& camera, Timing timing) {
    implementation_->submit([&](const vk::raii::CommandBuffer& commandBuffer) {
        implementation_->frame.record(commandBuffer, 0, {camera}, timing);
    });
}

void Offscreen::renderEffect(std::uint32_t repetitions) {
    implementation_->submit([&](const vk::raii::CommandBuffer& commandBuffer) {
        implementation_->frame.recordEffect(commandBuffer, 0, repetitions);
    });
}

Pixels Offscreen::read(Output output) const {
    Implementation& self = *implementation_;
    const EffectUse& use = self.frame.effectUse(0);
    return translateErrors([&] { return readOutput(self.gpu, output, self.frame.images(), use); });
}

const FrameReport& Offscreen::report() const {
    return implementation_->report;
}

void Offscreen::setEffect(const EffectSettings& settings) {
    implementation_->frame.prepare(settings);
    implementation_->frame.setEffect(settings);
}

void Offscreen::setMaterials(const std::vector<Material>& materials) {
    implementation_->frame.setMaterials(materials);
    implementation_->frame.prepare(implementation_->frame.settings());
}

void Offscreen::reloadShaders() {
    implementation_->frame.reloadShaders();
    implementation_->frame.prepare(implementation_->frame.settings());
}

} // namespace nacre::renderer
