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

renderer::RenderSettings renderSettings(const LoopSettings& loop) {
    renderer::RenderSettings settings;
    settings.width = loop.width;
    settings.height = loop.height;
    settings.shadowMapSize = loop.shadowMapSize;
    settings.thickness = loop.thickness;
    settings.shadowMapsEveryFrame = loop.shadowMapsEveryFrame;
    return settings;
}

/// A slider can make a material ask for second surfaces. No frame is to wait for their passes then.
renderer::FrameLimits frameLimits(const LoopSettings& loop, const scene::Scene& scene) {
    return {.framesInFlight = loop.framesInFlight,
            .lights = loop.lights,
            .shadowLayers = loop.shadowLayers,
            .secondSurfaces = !scene.materials.empty()};
}

} // namespace

PictureLoop::PictureLoop(renderer::Device& device, const scene::Scene& scene, const LoopSettings& settings)
    : gpu_(device.implementation()),
      scene_(scene),
      settings_(settings),
      frames_(device, scene, renderSettings(settings), frameLimits(settings, scene)),
      pool_(gpu_.device,
            {.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer, .queueFamilyIndex = gpu_.queueFamily}),
      camera_(scene.cameras.at(0)) {
    for (SideSettings& side : sides_) {
        side.look.exposure = scene.exposure;
    }
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
        std::make_unique<Accumulation>(gpu_, extent(), frames_.drawn().materials.size(), settings_.framesInFlight);
    frames_.attach(*accumulation_);
    if (!given_.values.empty()) {
        accumulation_->setGiven(given_, extent());
    }
}

/// The first frame draws the shadow maps; the second is as slow as those that follow.
void PictureLoop::makeCoarse() {
    const double tolerable = settings_.tolerableMilliseconds * 1e3;
    if (frames_.coarse() != nullptr || framesFinished_ < 2 || report_.totalMicroseconds <= tolerable) {
        return;
    }
    const double share = std::clamp(std::sqrt(tolerable / report_.totalMicroseconds), coarsestShare, finestCoarseShare);
    frames_.makeCoarse(share, sides_[0].effect, *accumulation_);
}

SizedFrame& PictureLoop::current() {
    return isCoarse() ? *frames_.coarse() : frames_.full();
}

bool PictureLoop::isCoarse() const {
    return moving_ && frames_.coarse() != nullptr;
}

vk::Extent2D PictureLoop::drawnExtent() const {
    return isCoarse() ? frames_.coarse()->extent : extent();
}

void PictureLoop::restart() {
    for (std::uint32_t side = 0; side < Accumulation::sideCount; ++side) {
        accumulation_->restart(side);
    }
}

void PictureLoop::setSurface(vk::SurfaceKHR surface, std::function<vk::Extent2D()> windowExtent) {
    wait();
    windowImages_.reset();
    if (surface) {
        windowImages_.emplace(gpu_, surface, std::move(windowExtent));
        showAgain_ = true;
    }
}

void PictureLoop::windowChanged() {
    showAgain_ = true;
    if (windowImages_) {
        windowImages_->rebuild();
    }
}

void PictureLoop::resize(std::uint32_t width, std::uint32_t height) {
    if (width == settings_.width && height == settings_.height) {
        return;
    }
    wait();
    frames_.resize({width, height});
    settings_.width = width;
    settings_.height = height;
    translateErrors([&] { attachAll(); });
    showAgain_ = true;
}

void PictureLoop::setCamera(const scene::Camera& camera) {
    camera_ = camera;
    restart();
}

void PictureLoop::setMaterials(const std::vector<Material>& materials) {
    frames_.setMaterials(materials);
    radii_.clear();
    restart();
}

void PictureLoop::setSurfaces(std::span<const scene::Surface> surfaces) {
    frames_.setSurfaces(surfaces);
    restart();
}

void PictureLoop::setLights(std::span<const scene::Light> lights) {
    frames_.setLights(lights);
    restart();
}

void PictureLoop::setEnvironment(float intensity, float rotation) {
    frames_.setEnvironment(intensity, rotation);
    restart();
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
    accumulation_->setGiven(given_, extent());
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
    if (frames_.coarse() != nullptr) {
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
    if (!windowImages_ || windowImages_->isUsable()) {
        return true;
    }
    if (!windowImages_->rebuild()) {
        return false;
    }
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
        if (!side && !(showAgain_ && windowImages_)) {
            return finishAll() ? Step::Converged : Step::Busy;
        }
        if (!prepareWindow()) {
            return Step::Hidden;
        }
        const auto begin = std::chrono::steady_clock::now();
        const std::optional<WindowImages::Image> image = acquire(slot);
        if (windowImages_ && !image) {
            return Step::Busy;
        }
        try {
            slot.commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
            slot.drawn = nullptr;
            if (side) {
                recordFrame(slot, next_, *side);
            }
            if (image) {
                windowImages_->record(slot.commands, next_, *accumulation_, shown_, *image);
                showAgain_ = false;
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

std::optional<WindowImages::Image> PictureLoop::acquire(Slot& slot) {
    if (!windowImages_) {
        return std::nullopt;
    }
    windowImages_->releaseRetired(slots_.size());
    if (!accumulation_->hasRoomFor(windowImages_->extent())) {
        wait();
        accumulation_->makeRoomFor(windowImages_->extent());
    }
    return windowImages_->acquire(*slot.imageFree);
}

void PictureLoop::prepareEffect(SizedFrame& sized, const renderer::EffectSettings& effect) {
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
        result.separation =
            std::ranges::any_of(frames_.drawn().materials, asksForSecondSurfaces) ? ofTwoSurfaces : ofOneSurface;
    }
    if (look.image != ShownImage::Footprint) {
        return result;
    }
    if (radii_.empty()) {
        for (const Material& material : frames_.drawn().materials) {
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
        accumulation_->recordSample(slot.commands, index, frames_.full().pass, side, extent(), settings.look, {});
        return;
    }
    SizedFrame& sized = current();
    prepareEffect(sized, settings.effect);
    const std::uint32_t sample = moving_ ? 0 : accumulation_->samples(side);
    slot.drawn = &sized;
    sized.frame.record(slot.commands, index, {camera_, jitterOf(sample)});
    accumulation_->recordSample(slot.commands, index, sized.pass, side, sized.extent,
                                prepareLook(settings.look, index, sized.extent.height), sized.frame.effectUse(index));
}

void PictureLoop::submit(Slot& slot, const std::optional<WindowImages::Image>& image) {
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
        windowImages_->present(*image);
    }
}

void PictureLoop::reloadShaders() {
    wait();
    frames_.reloadShaders();
    restart();
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
        if (slots_[last].drawn == &frames_.full()) {
            return translateErrors([&] {
                return renderer::readOutput(gpu_, output, frames_.full().frame.images(),
                                            frames_.full().frame.effectUse(last));
            });
        }
    }
    throw renderer::RendererError("there is no picture to read before one has been drawn");
}

} // namespace nacre::view
