#include "view/loop/picture_loop.hpp"

#include "renderer/readback.hpp"
#include "renderer/vulkan/translate_errors.hpp"
#include "view/loop/sample_place.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace nacre::view {
namespace {

using renderer::Accumulation;
using renderer::ShownImage;
using renderer::ShownSides;
using renderer::translateErrors;

constexpr std::uint64_t forever = ~std::uint64_t{0};
/// Fewest pixels per axis, as a share, that something that moves is drawn with, and the most that are worth it.
constexpr double coarsestShare = 1.0 / 6;
constexpr double finestCoarseShare = 0.75;

/// An extent with that share of the pixels of each axis.
vk::Extent2D shrunk(vk::Extent2D extent, double share) {
    const auto side = [share](std::uint32_t pixels) {
        return std::max(1u, static_cast<std::uint32_t>(std::lround(pixels * share)));
    };
    return {side(extent.width), side(extent.height)};
}

/// A barrier of an image of the window.
void recordBarrier(const vk::raii::CommandBuffer& commands, vk::Image image, const renderer::Usage& from,
                   const renderer::Usage& to) {
    const auto barrier = renderer::barrierBetween(image, {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}, from, to);
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

} // namespace

PictureLoop::PictureLoop(renderer::Device& device, const scene::Scene& scene, const LoopSettings& settings)
    : gpu_(device.implementation()),
      device_(device),
      scene_(scene),
      settings_(settings),
      pool_(gpu_.device,
            {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = gpu_.queueFamily}),
      camera_(scene.cameras.at(0)),
      drawn_(scene) {
    for (SideSettings& side : sides_) {
        side.look.exposure = scene.exposure;
    }
    full_ = makeFrame(extent());
    translateErrors([&] {
        attachAll();
        makeSlots();
    });
}

PictureLoop::~PictureLoop() {
    try {
        gpu_.device.waitIdle();
    } catch (const vk::SystemError&) {
        // A lost device has nothing left to wait for.
    }
}

renderer::RenderSettings PictureLoop::renderSettings(vk::Extent2D extent) const {
    renderer::RenderSettings settings;
    static_cast<renderer::EffectSettings&>(settings) = sides_[0].effect;
    settings.width = extent.width;
    settings.height = extent.height;
    settings.shadowMapSize = settings_.shadowMapSize;
    settings.thickness = settings_.thickness;
    settings.shadowMapsEveryFrame = settings_.shadowMapsEveryFrame;
    return settings;
}

std::unique_ptr<PictureLoop::Sized> PictureLoop::makeFrame(vk::Extent2D extent) {
    // A slider can make a material ask for second surfaces. No frame is to wait for their passes then.
    const renderer::FrameLimits limits{.framesInFlight = settings_.framesInFlight,
                                       .lights = settings_.lights,
                                       .shadowLayers = settings_.shadowLayers,
                                       .secondSurfaces = !drawn_.materials.empty()};
    return std::make_unique<Sized>(Sized{renderer::Frame(device_, scene_, renderSettings(extent), limits), extent, 0});
}

void PictureLoop::makeSlots() {
    vk::raii::CommandBuffers buffers(gpu_.device, {.commandPool = *pool_,
                                                   .level = vk::CommandBufferLevel::ePrimary,
                                                   .commandBufferCount = settings_.framesInFlight});
    for (vk::raii::CommandBuffer& commands : buffers) {
        slots_.push_back({std::move(commands), vk::raii::Fence(gpu_.device, vk::FenceCreateInfo{}),
                          vk::raii::Semaphore(gpu_.device, vk::SemaphoreCreateInfo{}), false, nullptr});
    }
}

void PictureLoop::attachAll() {
    accumulation_ =
        std::make_unique<Accumulation>(gpu_, full_->extent, drawn_.materials.size(), settings_.framesInFlight);
    full_->pass = accumulation_->attach(full_->frame.images());
    if (coarse_) {
        coarse_->pass = accumulation_->attach(coarse_->frame.images());
    }
    if (!given_.values.empty()) {
        accumulation_->setGiven(given_, full_->extent);
    }
}

vk::Extent2D PictureLoop::coarseExtent() const {
    const double share = std::clamp(std::sqrt(settings_.tolerableMilliseconds * 1e3 / report_.totalMicroseconds),
                                    coarsestShare, finestCoarseShare);
    return shrunk(extent(), share);
}

/// The first frame draws the shadow maps; the second is as slow as those that follow.
void PictureLoop::makeCoarse() {
    const bool known = framesFinished_ >= 2 && report_.totalMicroseconds > 0;
    if (coarse_ || !known || report_.totalMicroseconds < settings_.tolerableMilliseconds * 1e3) {
        return;
    }
    coarse_ = makeFrame(coarseExtent());
    drawn_.apply(coarse_->frame);
    coarse_->pass = accumulation_->attach(coarse_->frame.images());
}

PictureLoop::Sized& PictureLoop::current() {
    return isCoarse() ? *coarse_ : *full_;
}

bool PictureLoop::isCoarse() const {
    return moving_ && coarse_ != nullptr;
}

template <typename Action> void PictureLoop::forEachFrame(const Action& action) {
    action(full_->frame);
    if (coarse_) {
        action(coarse_->frame);
    }
    restart();
}

void PictureLoop::restart() {
    for (std::uint32_t side = 0; side < Accumulation::sideCount; ++side) {
        accumulation_->restart(side);
    }
}

void PictureLoop::setSurface(vk::SurfaceKHR surface, std::function<vk::Extent2D()> windowExtent) {
    wait();
    swapchain_.reset();
    windowExtent_ = std::move(windowExtent);
    if (surface) {
        swapchain_ = std::make_unique<renderer::Swapchain>(gpu_, surface);
        windowChanged();
    }
}

void PictureLoop::windowChanged() {
    showAgain_ = true;
    if (swapchain_) {
        swapchain_->rebuild(windowExtent_());
        rebuilds_ = 0;
    }
}

void PictureLoop::resize(std::uint32_t width, std::uint32_t height) {
    if (width == settings_.width && height == settings_.height) {
        return;
    }
    wait();
    const double share = coarse_ ? double(coarse_->extent.width) / settings_.width : 0;
    full_->frame.resize(width, height);
    settings_.width = width;
    settings_.height = height;
    full_->extent = extent();
    if (coarse_) {
        coarse_->extent = shrunk(extent(), share);
        coarse_->frame.resize(coarse_->extent.width, coarse_->extent.height);
    }
    translateErrors([&] { attachAll(); });
    showAgain_ = true;
}

void PictureLoop::setCamera(const scene::Camera& camera) {
    camera_ = camera;
    restart();
}

void PictureLoop::setMaterials(const std::vector<Material>& materials) {
    forEachFrame([&](renderer::Frame& frame) { frame.setMaterials(materials); });
    drawn_.materials = materials;
    radii_.clear();
}

void PictureLoop::setSurfaces(std::span<const scene::Surface> surfaces) {
    forEachFrame([&](renderer::Frame& frame) { frame.setSurfaces(surfaces); });
    drawn_.surfaces.assign(surfaces.begin(), surfaces.end());
}

void PictureLoop::setLights(std::span<const scene::Light> lights) {
    forEachFrame([&](renderer::Frame& frame) { frame.setLights(lights); });
    drawn_.lights.assign(lights.begin(), lights.end());
}

void PictureLoop::setEnvironment(float intensity, float rotation) {
    forEachFrame([&](renderer::Frame& frame) { frame.setEnvironment(intensity, rotation); });
    drawn_.environmentIntensity = intensity;
    drawn_.environmentRotation = rotation;
}

void PictureLoop::setSide(std::uint32_t side, const SideSettings& settings) {
    sides_[side] = settings;
    accumulation_->restart(side);
}

void PictureLoop::setShown(const renderer::ShowLook& look) {
    shown_ = look;
    showAgain_ = true;
}

void PictureLoop::setGiven(const Image& image) {
    wait();
    given_ = image;
    accumulation_->setGiven(given_, full_->extent);
    for (std::uint32_t side = 0; side < Accumulation::sideCount; ++side) {
        if (sides_[side].look.image == ShownImage::Given) {
            accumulation_->restart(side);
        }
    }
}

void PictureLoop::setMoving(bool moving) {
    if (moving == moving_) {
        return;
    }
    moving_ = moving;
    if (coarse_) {
        restart();
    }
}

std::uint32_t PictureLoop::samples(std::uint32_t side) const {
    return accumulation_->samples(side);
}

bool PictureLoop::isConverged() const {
    return !sideToDraw().has_value();
}

std::optional<std::uint32_t> PictureLoop::sideToDraw() const {
    const std::uint32_t count = shown_.sides == ShownSides::First ? 1 : Accumulation::sideCount;
    std::optional<std::uint32_t> result;
    for (std::uint32_t side = 0; side < count; ++side) {
        const std::uint32_t wanted = sides_[side].look.image == ShownImage::Given ? 1 : settings_.stillSamples;
        const std::uint32_t there = accumulation_->samples(side);
        if (there < wanted && (!result || there < accumulation_->samples(*result))) {
            result = side;
        }
    }
    return result;
}

/// Takes in what a slot's frame was; false while the device is at it.
bool PictureLoop::finish(Slot& slot) {
    if (!slot.inFlight) {
        return true;
    }
    if (slot.fence.getStatus() != vk::Result::eSuccess) {
        return false;
    }
    slot.inFlight = false;
    if (slot.drawn != nullptr) {
        ++framesFinished_;
        report_ = slot.drawn->frame.report(static_cast<std::uint32_t>(&slot - slots_.data()));
        if (onFinished) {
            onFinished(report_);
        }
    }
    return true;
}

bool PictureLoop::finishAll() {
    bool all = true;
    for (Slot& slot : slots_) {
        all = finish(slot) && all;
    }
    return all;
}

void PictureLoop::wait() {
    ++waits_;
    translateErrors([&] {
        for (Slot& slot : slots_) {
            if (slot.inFlight && gpu_.device.waitForFences(*slot.fence, VK_TRUE, forever) == vk::Result::eSuccess) {
                finish(slot);
            }
        }
        gpu_.device.waitIdle(); // the window may still read its images
    });
}

/// False where the window cannot show anything now.
bool PictureLoop::prepareWindow() {
    if (!swapchain_ || swapchain_->isUsable()) {
        return true;
    }
    if (!swapchain_->rebuild(windowExtent_())) {
        return false;
    }
    rebuilds_ = 0;
    showAgain_ = true;
    return true;
}

Step PictureLoop::step() {
    return translateErrors([&] {
        Slot& slot = slots_[next_];
        if (!finish(slot)) {
            return Step::Busy;
        }
        if (settings_.restartEveryFrame) {
            restart();
        }
        if (!moving_) {
            makeCoarse();
        }
        const std::optional<std::uint32_t> side = sideToDraw();
        if (!side && !(showAgain_ && swapchain_)) {
            return finishAll() ? Step::Converged : Step::Busy;
        }
        if (!prepareWindow()) {
            return Step::Hidden;
        }
        const auto begin = std::chrono::steady_clock::now();
        const std::optional<renderer::Swapchain::Acquired> image = acquire(slot);
        if (swapchain_ && !image) {
            return Step::Busy;
        }
        try {
            slot.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
            slot.drawn = nullptr;
            if (side) {
                recordFrame(slot, next_, *side);
            }
            if (image) {
                recordWindow(slot.commands, next_, *image);
            }
            slot.commands.end();
            submit(slot, image);
        } catch (...) {
            if (slot.drawn != nullptr) {
                slot.drawn->frame.discard();
                slot.drawn = nullptr;
            }
            restart();
            // The semaphore of an image that is not drawn stays signalled.
            slot.imageFree = vk::raii::Semaphore(gpu_.device, vk::SemaphoreCreateInfo{});
            throw;
        }
        stepMilliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        next_ = (next_ + 1) % static_cast<std::uint32_t>(slots_.size());
        return Step::Drawn;
    });
}

std::optional<renderer::Swapchain::Acquired> PictureLoop::acquire(Slot& slot) {
    if (!swapchain_) {
        return std::nullopt;
    }
    if (rebuilds_ > slots_.size()) {
        swapchain_->releaseRetired();
    }
    if (!accumulation_->hasRoomFor(swapchain_->extent())) {
        wait();
        accumulation_->makeRoomFor(swapchain_->extent());
    }
    return swapchain_->acquire(*slot.imageFree);
}

void PictureLoop::prepareEffect(Sized& sized, const renderer::EffectSettings& effect) {
    if (!sized.frame.isPrepared(effect)) {
        wait();
        sized.frame.prepare(effect);
    }
    sized.frame.setEffect(effect);
}

/// What ShownImage::Footprint and ShownImage::Regions need.
renderer::SampleLook PictureLoop::prepareLook(const renderer::SampleLook& look, std::uint32_t index,
                                              std::uint32_t height) {
    renderer::SampleLook result = look;
    if (look.image == ShownImage::Regions) {
        constexpr float ofOneSurface = 6; // bank_constants.h: bankSurfaceSeparation, bankSecondSeparation
        constexpr float ofTwoSurfaces = 2;
        result.pixelScale = pixelWidth(camera_, height);
        result.separation = std::ranges::any_of(drawn_.materials, asksForSecondSurfaces) ? ofTwoSurfaces : ofOneSurface;
    }
    if (look.image != ShownImage::Footprint) {
        return result;
    }
    if (radii_.empty()) {
        for (const Material& material : drawn_.materials) {
            const std::unique_ptr<Profile> profile = makeProfile(material);
            radii_.push_back(
                static_cast<float>(std::max({profile->rmsRadius(0), profile->rmsRadius(1), profile->rmsRadius(2)})));
        }
    }
    accumulation_->setRadii(index, radii_);
    result.pixelScale = pixelsPerMillimeter(camera_, settings_.height, static_cast<float>(scene_.metersPerUnit));
    return result;
}

void PictureLoop::recordFrame(Slot& slot, std::uint32_t index, std::uint32_t side) {
    const SideSettings& settings = sides_[side];
    if (settings.look.image == ShownImage::Given) {
        accumulation_->recordSample(slot.commands, index, full_->pass, side, full_->extent, settings.look, {});
        return;
    }
    Sized& sized = current();
    prepareEffect(sized, settings.effect);
    const std::uint32_t sample = moving_ ? 0 : accumulation_->samples(side);
    slot.drawn = &sized;
    sized.frame.record(slot.commands, index, {camera_, jitterOf(sample)});
    accumulation_->recordSample(slot.commands, index, sized.pass, side, sized.extent,
                                prepareLook(settings.look, index, sized.extent.height), sized.frame.effectUse(index));
}

void PictureLoop::recordWindow(const vk::raii::CommandBuffer& commands, std::uint32_t index,
                               const renderer::Swapchain::Acquired& image) {
    const vk::Extent2D window = swapchain_->extent();
    accumulation_->recordShow(commands, index, window, shown_, swapchain_->isSwapped());
    // The semaphore is waited for by transfers, so that this barrier follows it.
    const renderer::Usage before{vk::PipelineStageFlagBits2::eTransfer, {}, vk::ImageLayout::eUndefined};
    const renderer::Usage after{vk::PipelineStageFlagBits2::eTransfer, {}, vk::ImageLayout::ePresentSrcKHR};
    recordBarrier(commands, image.image, before, renderer::usage::transferWrite);
    commands.copyBufferToImage(accumulation_->pixels(), image.image, vk::ImageLayout::eTransferDstOptimal,
                               vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                                   .imageExtent = {window.width, window.height, 1}});
    recordBarrier(commands, image.image, renderer::usage::transferWrite, after);
    showAgain_ = false;
}

void PictureLoop::submit(Slot& slot, const std::optional<renderer::Swapchain::Acquired>& image) {
    const vk::CommandBufferSubmitInfo commands{.commandBuffer = *slot.commands};
    vk::SemaphoreSubmitInfo free{.semaphore = *slot.imageFree, .stageMask = vk::PipelineStageFlagBits2::eTransfer};
    vk::SemaphoreSubmitInfo finished{.stageMask = vk::PipelineStageFlagBits2::eTransfer};
    vk::SubmitInfo2 info{.commandBufferInfoCount = 1, .pCommandBufferInfos = &commands};
    if (image) {
        finished.semaphore = image->finished;
        info.waitSemaphoreInfoCount = info.signalSemaphoreInfoCount = 1;
        info.pWaitSemaphoreInfos = &free;
        info.pSignalSemaphoreInfos = &finished;
    }
    gpu_.device.resetFences(*slot.fence);
    gpu_.queue.submit2(info, *slot.fence);
    slot.inFlight = true;
    if (image) {
        ++rebuilds_;
        swapchain_->present(*image);
    }
}

void PictureLoop::reloadShaders() {
    wait();
    full_->frame.reloadShaders();
    forEachFrame([&](renderer::Frame& frame) { frame.prepare(frame.settings()); });
}

renderer::SidePicture PictureLoop::read(std::uint32_t side) {
    wait();
    return translateErrors([&] { return accumulation_->read(side); });
}

Image PictureLoop::readWindow(std::uint32_t width, std::uint32_t height) {
    wait();
    return translateErrors([&] { return accumulation_->readWindow({width, height}, shown_); });
}

Image PictureLoop::readImage(renderer::Output output) {
    wait();
    for (std::uint32_t index = 0; index < slots_.size(); ++index) {
        const std::uint32_t last = (next_ + 2 * static_cast<std::uint32_t>(slots_.size()) - 1 - index) %
                                   static_cast<std::uint32_t>(slots_.size());
        if (slots_[last].drawn == full_.get()) {
            return translateErrors([&] {
                return renderer::readOutput(gpu_, output, full_->frame.images(), full_->frame.effectUse(last));
            });
        }
    }
    throw renderer::RendererError("there is no picture to read before one has been drawn");
}

} // namespace nacre::view
