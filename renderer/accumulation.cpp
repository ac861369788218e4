#include "renderer/accumulation.hpp"

#include "accumulate_comp.spv.h"
#include "renderer/passes/shader_types.h"
#include "show_sides_comp.spv.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nacre::renderer {
namespace {

constexpr auto storageAndCopies = vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferSrc;

std::uint64_t pixelsOf(vk::Extent2D extent) {
    return std::uint64_t{extent.width} * extent.height;
}

void recordBarrier(const vk::raii::CommandBuffer& commandBuffer, vk::PipelineStageFlags2 from,
                   vk::AccessFlags2 fromAccess, vk::PipelineStageFlags2 to, vk::AccessFlags2 toAccess) {
    const vk::MemoryBarrier2 barrier{
        .srcStageMask = from, .srcAccessMask = fromAccess, .dstStageMask = to, .dstAccessMask = toAccess};
    commandBuffer.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
}

/// Everything before that the passes here may have to wait for: each other, and copies of the window's pixels.
void recordBarrierBefore(const vk::raii::CommandBuffer& commandBuffer) {
    using usage::Access;
    using usage::Stage;
    recordBarrier(commandBuffer, Stage::eComputeShader | Stage::eTransfer, Access::eShaderStorageWrite,
                  Stage::eComputeShader, Access::eShaderStorageRead | Access::eShaderStorageWrite);
}

/// AccumulateConstants::range.y
float rangeEnd(const SampleLook& look) {
    switch (look.image) {
    case ShownImage::Thickness:
        return look.thicknessRange;
    case ShownImage::Regions:
        return look.separation;
    default:
        return look.depthRange.y;
    }
}

/// The value of one channel between pixels.
float between(const nacre::Image& image, double x, double y, std::size_t channel) {
    const auto column = static_cast<std::uint32_t>(std::clamp(x, 0.0, image.width - 1.0));
    const auto row = static_cast<std::uint32_t>(std::clamp(y, 0.0, image.height - 1.0));
    const std::uint32_t right = std::min(column + 1, image.width - 1);
    const std::uint32_t below = std::min(row + 1, image.height - 1);
    const auto u = static_cast<float>(std::clamp(x - column, 0.0, 1.0));
    const auto v = static_cast<float>(std::clamp(y - row, 0.0, 1.0));
    const auto value = [&](std::uint32_t px, std::uint32_t py) { return image.at(px, py)[channel]; };
    return std::lerp(std::lerp(value(column, row), value(right, row), u),
                     std::lerp(value(column, below), value(right, below), u), v);
}

} // namespace

Accumulation::Accumulation(Gpu& gpu, vk::Extent2D capacity, std::size_t materials, std::uint32_t framesInFlight)
    : gpu_(gpu),
      capacity_(capacity),
      nearest_(gpu.device, vk::SamplerCreateInfo{}),
      radii_(gpu, "radii", std::max<std::size_t>(materials, 1) * sizeof(glm::vec4),
             vk::BufferUsageFlagBits::eStorageBuffer, framesInFlight),
      marks_(gpu, "marks", ShowLook::mostMarks * sizeof(shared::Mark), vk::BufferUsageFlagBits::eStorageBuffer,
             framesInFlight) {
    const std::uint64_t pixels = pixelsOf(capacity);
    given_ = Buffer(gpu, "given picture", pixels * sizeof(glm::vec4), vk::BufferUsageFlagBits::eStorageBuffer,
                    Buffer::Place::Constants);
    sums_ = Buffer(gpu, "sums of the sides", sideCount * pixels * 2 * sizeof(glm::vec4), storageAndCopies,
                   Buffer::Place::Device);
    makeRoomFor(capacity);
}

std::size_t Accumulation::attach(const FrameImages& images) {
    const auto pixels = [&](Image& image) { return sampled(image, nearest_); };
    Image& thickness = images.thickness != nullptr ? *images.thickness : images.depth;
    passes_.emplace_back(gpu_, "accumulate", accumulate_comp_spv,
                         std::vector<Binding>{pixels(images.radiance), pixels(images.specular),
                                              pixels(images.irradiance), pixels(images.scattered),
                                              pixels(images.transmitted), pixels(images.albedo),
                                              pixels(images.shadingNormal), pixels(images.depth), pixels(thickness),
                                              pixels(images.materialId), storage(given_), storage(sums_),
                                              pixels(images.shadowMaps), storage(radii_)},
                         static_cast<std::uint32_t>(sizeof(shared::AccumulateConstants)));
    return passes_.size() - 1;
}

bool Accumulation::hasRoomFor(vk::Extent2D window) const {
    return pixels_.bytes() >= pixelsOf(window) * sizeof(std::uint32_t);
}

void Accumulation::makeRoomFor(vk::Extent2D window) {
    pixels_ = Buffer(gpu_, "window", pixelsOf(window) * sizeof(std::uint32_t), storageAndCopies, Buffer::Place::Device);
    show_ = ComputePass(gpu_, "show sides", show_sides_comp_spv, {storage(sums_), storage(pixels_), storage(marks_)},
                        static_cast<std::uint32_t>(sizeof(shared::ShowConstants)));
}

void Accumulation::setGiven(const nacre::Image& image, vk::Extent2D extent) {
    auto* values = reinterpret_cast<float*>(given_.mapped());
    const double stepX = double(image.width) / extent.width;
    const double stepY = double(image.height) / extent.height;
    for (std::uint32_t y = 0; y < extent.height; ++y) {
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                *values++ = between(image, (x + 0.5) * stepX - 0.5, (y + 0.5) * stepY - 0.5, channel);
            }
            *values++ = 1;
        }
    }
}

void Accumulation::setRadii(std::uint32_t frame, std::span<const float> radii) {
    auto* values = reinterpret_cast<glm::vec4*>(radii_.mapped(frame));
    for (const float radius : radii) {
        *values++ = glm::vec4(radius);
    }
}

void Accumulation::recordSample(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, std::size_t pass,
                                std::uint32_t side, vk::Extent2D extent, const SampleLook& look, const EffectUse& use) {
    Side& target = sides_[side];
    if (target.extent != extent) {
        target = {extent, 0};
    }
    const shared::AccumulateConstants constants{
        .image = {static_cast<std::uint32_t>(look.image), target.samples, look.shadowLayer,
                  look.givenIsDisplayed ? 1u : 0u},
        .size = {extent.width, extent.height, firstPixel(side), static_cast<std::uint32_t>(look.backdrop)},
        .effect = {use.scatter ? 1u : 0u, use.scatteredHasAlbedo ? 1u : 0u, use.transmit ? 1u : 0u,
                   static_cast<std::uint32_t>(look.curve)},
        .range = {look.depthRange.x, rangeEnd(look), look.exposure, look.pixelScale}};
    recordBarrierBefore(commandBuffer);
    passes_[pass].record(commandBuffer, frame, extent, bytesOf(constants));
    ++target.samples;
}

void Accumulation::writeMarks(std::uint32_t frame, std::span<const PictureMark> marks) {
    auto* written = reinterpret_cast<shared::Mark*>(marks_.mapped(frame));
    for (const PictureMark& mark : marks) {
        *written++ = {glm::vec4(mark.place, mark.end), glm::vec4(mark.color, mark.hollow ? -mark.radius : mark.radius)};
    }
}

void Accumulation::recordShow(const vk::raii::CommandBuffer& commandBuffer, std::uint32_t frame, vk::Extent2D window,
                              const ShowLook& look, bool swapped) {
    using usage::Access;
    using usage::Stage;
    const bool hasSecond = sides_[1].extent.width > 0;
    const std::size_t marks = std::min(look.marks.size(), ShowLook::mostMarks);
    writeMarks(frame, std::span(look.marks).first(marks));
    shared::ShowConstants constants{.place = {window.width, window.height,
                                              static_cast<std::uint32_t>(hasSecond ? look.sides : ShownSides::First),
                                              swapped ? 1u : 0u},
                                    .sides = {},
                                    .divider = {look.divider, look.differenceGain, static_cast<float>(marks), 0}};
    for (std::uint32_t side = 0; side < sideCount; ++side) {
        constants.sides[side] = {sides_[side].extent.width, sides_[side].extent.height, firstPixel(side), 0};
    }
    recordBarrierBefore(commandBuffer);
    show_.record(commandBuffer, frame, window, bytesOf(constants));
    recordBarrier(commandBuffer, Stage::eComputeShader, Access::eShaderStorageWrite, Stage::eTransfer,
                  Access::eTransferRead);
}

nacre::Image Accumulation::readWindow(vk::Extent2D window, const ShowLook& look) {
    if (!hasRoomFor(window)) {
        makeRoomFor(window);
    }
    const std::uint64_t bytes = pixelsOf(window) * sizeof(std::uint32_t);
    const Buffer host(gpu_, "read window", bytes, vk::BufferUsageFlagBits::eTransferDst, Buffer::Place::ReadBack);
    gpu_.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        recordShow(commandBuffer, 0, window, look, false);
        commandBuffer.copyBuffer(pixels_.handle(), host.handle(), vk::BufferCopy{.size = bytes});
        recordBarrier(commandBuffer, usage::Stage::eTransfer, usage::Access::eTransferWrite, usage::Stage::eHost,
                      usage::Access::eHostRead);
    });
    nacre::Image result = makeImage(window.width, window.height, {"R", "G", "B"}, Encoding::Srgb);
    for (std::uint64_t pixel = 0; pixel < pixelsOf(window); ++pixel) {
        for (std::uint64_t channel = 0; channel < 3; ++channel) {
            result.values[3 * pixel + channel] =
                static_cast<float>(std::to_integer<std::uint32_t>(host.mapped()[4 * pixel + channel])) / 255;
        }
    }
    return result;
}

SidePicture Accumulation::read(std::uint32_t side) {
    const Side& from = sides_[side];
    const std::uint64_t pixels = pixelsOf(from.extent);
    SidePicture result{makeImage(from.extent.width, from.extent.height, {"R", "G", "B"}),
                       makeImage(from.extent.width, from.extent.height, {"R", "G", "B"}), from.samples};
    const std::uint64_t bytes = pixels * 2 * sizeof(glm::vec4);
    const Buffer host(gpu_, "read side", bytes, vk::BufferUsageFlagBits::eTransferDst, Buffer::Place::ReadBack);
    gpu_.submitAndWait([&](const vk::raii::CommandBuffer& commandBuffer) {
        recordBarrier(commandBuffer, usage::Stage::eComputeShader, usage::Access::eShaderStorageWrite,
                      usage::Stage::eTransfer, usage::Access::eTransferRead);
        commandBuffer.copyBuffer(
            sums_.handle(), host.handle(),
            vk::BufferCopy{.srcOffset = 2 * sizeof(glm::vec4) * std::uint64_t{firstPixel(side)}, .size = bytes});
        recordBarrier(commandBuffer, usage::Stage::eTransfer, usage::Access::eTransferWrite, usage::Stage::eHost,
                      usage::Access::eHostRead);
    });
    const auto* values = reinterpret_cast<const float*>(host.mapped());
    for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
        for (std::uint64_t channel = 0; channel < 3; ++channel) {
            result.shown.values[3 * pixel + channel] = values[8 * pixel + channel] / values[8 * pixel + 3];
            result.light.values[3 * pixel + channel] = values[8 * pixel + 4 + channel] / values[8 * pixel + 7];
        }
    }
    return result;
}

} // namespace nacre::renderer
