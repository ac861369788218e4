// The viewer's loop without a window: it allocates nothing while something is dragged, and ends up where it was.
#include "image/metrics.hpp"
#include "nacre/presets.hpp"
#include "tests/gpu/support/recording_calls.hpp"
#include "tests/gpu/support/view_scene.hpp"
#include "tests/support/bank_twin.hpp"
#include "tests/support/processor_time.hpp"
#include "view/loop/headless.hpp"
#include "view/loop/picture_loop.hpp"
#include "view/loop/reference_task.hpp"
#include "view/loop/side_error.hpp"
#include "view/loop/swatch.hpp"
#include "view/model/edited_scene.hpp"
#include "view/model/inspection.hpp"

#include "trace/geometry.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

namespace nacre::tests {
namespace {

using view::PictureLoop;
using view::Step;

constexpr std::uint32_t side = 48;

view::LoopSettings smallLoop() {
    view::LoopSettings settings;
    settings.width = side;
    settings.height = side;
    settings.shadowMapSize = 64;
    settings.stillSamples = 4;
    settings.tolerableMilliseconds = 1e9;
    return settings;
}

void draw(PictureLoop& loop) {
    while (loop.step() == Step::Busy) {
        std::this_thread::yield();
    }
}

Image stillPicture(PictureLoop& loop) {
    while (!loop.isConverged()) {
        draw(loop);
    }
    return loop.read(0).shown;
}

/// One loop for all tests: a software device compiles its passes for seconds.
class ViewLoop : public RendererTest {
protected:
    static void SetUpTestSuite() {
        countCalls(device());
        scene_ = new scene::Scene(ballScene());
        loop_ = new PictureLoop(device(), *scene_, smallLoop());
    }
    static void TearDownTestSuite() {
        delete loop_;
        delete scene_;
    }

    static inline scene::Scene* scene_ = nullptr;
    static inline PictureLoop* loop_ = nullptr;
};

TEST_F(ViewLoop, DraggingASliderAllocatesNothingAndWaitsForNothing) {
    stillPicture(*loop_);
    // The coarser frame is made when something moves for the first time.
    loop_->setMoving(true);
    draw(*loop_);
    std::vector<Material> materials = scene_->materials;
    callCounts() = {};
    forbiddenCalls().clear();
    constexpr int frames = 200;
    std::int64_t memory = 0;
    for (int frame = 0; frame < frames; ++frame) {
        memory = frame == frames / 2 ? view::heapBytes() : memory;
        materials[0].scale = 1 + 0.01 * frame;
        loop_->setMoving(true);
        loop_->setMaterials(materials);
        draw(*loop_);
    }
    // Submissions are the loop's own, one a frame. It reads the times of a frame whose fence it has seen, without a
    // wait.
    std::erase_if(forbiddenCalls(),
                  [](const std::string& name) { return name == "vkQueueSubmit2" || name == "vkGetQueryPoolResults"; });
    EXPECT_EQ(forbiddenCalls(), std::vector<std::string>{});
    EXPECT_EQ(callCounts().allocations, 0);
    EXPECT_LT(view::heapBytes() - memory, 256 << 10); // of which the validation layer may keep something
    EXPECT_GE(loop_->framesFinished(), frames - 2u);
    loop_->setMoving(false);
    loop_->setMaterials(scene_->materials);
}

TEST_F(ViewLoop, SaysTheSizeOfItsCoarseFrames) {
    view::LoopSettings settings = smallLoop();
    settings.tolerableMilliseconds = 1e-3; // no device is so quick
    settings.stillSamples = 2;
    PictureLoop loop(device(), *scene_, settings);
    stillPicture(loop);
    draw(loop);
    EXPECT_EQ(loop.drawnExtent(), loop.extent());
    loop.setMoving(true);
    ASSERT_TRUE(loop.isCoarse());
    const vk::Extent2D size = loop.drawnExtent();
    EXPECT_EQ(size, (vk::Extent2D{side / 6, side / 6}));
    for (int frame = 0; frame < 4; ++frame) {
        loop.setMaterials(scene_->materials);
        draw(loop);
        EXPECT_EQ(loop.drawnExtent(), size);
    }
    loop.resize(2 * side, side);
    EXPECT_EQ(loop.drawnExtent(), (vk::Extent2D{side / 3, side / 6}));
}

TEST_F(ViewLoop, WhatIsTakenBackGivesThePictureBackToTheLastBit) {
    const Image before = stillPicture(*loop_);
    std::vector<Material> materials = scene_->materials;
    materials[0].scale = 4;
    loop_->setMaterials(materials);
    const Image changed = stillPicture(*loop_);
    EXPECT_FALSE(changed == before);
    loop_->setMaterials(scene_->materials);
    EXPECT_TRUE(stillPicture(*loop_) == before);
}

TEST_F(ViewLoop, SamplesOfAStillPictureSmoothItsEdges) {
    loop_->setCamera(scene_->cameras[0]);
    draw(*loop_);
    const Image one = loop_->read(0).shown;
    EXPECT_EQ(loop_->samples(0), 1u);
    const Image all = stillPicture(*loop_);
    EXPECT_EQ(loop_->samples(0), smallLoop().stillSamples);
    EXPECT_FALSE(one == all);
}

TEST_F(ViewLoop, TheSecondSideIsAnotherEffectOfTheSameFrame) {
    view::SideSettings off;
    off.effect.scatter = off.effect.transmit = false;
    off.look.exposure = scene_->exposure;
    loop_->setSide(1, off);
    loop_->setShown({renderer::ShownSides::Both, 0.5f});
    const Image with = stillPicture(*loop_);
    const Image without = loop_->read(1).shown;
    EXPECT_EQ(loop_->samples(0), loop_->samples(1));
    EXPECT_FALSE(with == without);
    loop_->setShown({});
}

TEST_F(ViewLoop, AGivenPictureIsShownAsItIs) {
    Image grey = makeImage(side, side, {"R", "G", "B"});
    std::ranges::fill(grey.values, 0.25f);
    view::SideSettings given;
    given.look.image = renderer::ShownImage::Given;
    given.look.givenIsDisplayed = true;
    loop_->setGiven(grey);
    loop_->setSide(1, given);
    loop_->setShown({renderer::ShownSides::Both, 0.5f});
    stillPicture(*loop_);
    EXPECT_TRUE(loop_->read(1).shown == grey);
    loop_->setShown({});
}

TEST_F(ViewLoop, APictureOfAnotherSizeAndBackIsTheSame) {
    const Image before = stillPicture(*loop_);
    loop_->resize(32, 20);
    const Image other = stillPicture(*loop_);
    EXPECT_EQ(other.width, 32u);
    EXPECT_EQ(other.height, 20u);
    loop_->resize(side, side);
    EXPECT_TRUE(stillPicture(*loop_) == before);
}

/// vkQueueSubmit2 of a device that is gone.
VKAPI_ATTR VkResult VKAPI_CALL loseDevice(VkQueue, std::uint32_t, const VkSubmitInfo2*, VkFence) {
    return VK_ERROR_DEVICE_LOST;
}

TEST_F(ViewLoop, ALostDeviceIsASentence) {
    const Image before = stillPicture(*loop_);
    auto& dispatcher = const_cast<vk::raii::DeviceDispatcher&>(*device().implementation().device.getDispatcher());
    const PFN_vkQueueSubmit2 submit = std::exchange(dispatcher.vkQueueSubmit2, &loseDevice);
    loop_->setCamera(scene_->cameras[0]);
    try {
        loop_->step();
        FAIL() << "the frame was submitted";
    } catch (const renderer::DeviceLost& error) {
        EXPECT_STREQ(error.what(), "the graphics device has stopped working and has to be opened again");
    }
    dispatcher.vkQueueSubmit2 = submit;
    EXPECT_TRUE(stillPicture(*loop_) == before); // what was recorded and not drawn counts for nothing
}

/// A surface that takes pictures, and a swapchain that cannot be had for it.
VKAPI_ATTR VkResult VKAPI_CALL supportSurface(VkPhysicalDevice, std::uint32_t, VkSurfaceKHR, VkBool32* supported) {
    *supported = VK_TRUE;
    return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL surfaceFormats(VkPhysicalDevice, VkSurfaceKHR, std::uint32_t* count,
                                              VkSurfaceFormatKHR* formats) {
    *count = 1;
    if (formats != nullptr) {
        *formats = {VK_FORMAT_B8G8R8A8_UNORM, VK_COLOR_SPACE_SRGB_NONLINEAR_KHR};
    }
    return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL surfaceCapabilities(VkPhysicalDevice, VkSurfaceKHR, VkSurfaceCapabilitiesKHR* result) {
    *result = {.minImageCount = 2,
               .currentExtent = {64, 64},
               .minImageExtent = {64, 64},
               .maxImageExtent = {64, 64},
               .supportedUsageFlags = VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    return VK_SUCCESS;
}
VKAPI_ATTR VkResult VKAPI_CALL failSwapchain(VkDevice, const VkSwapchainCreateInfoKHR*, const VkAllocationCallbacks*,
                                             VkSwapchainKHR*) {
    return VK_ERROR_INITIALIZATION_FAILED;
}

TEST_F(ViewLoop, AFailedSwapchainIsASentence) {
    const Image before = stillPicture(*loop_);
    const renderer::Gpu& gpu = device().implementation();
    auto& instance = const_cast<vk::raii::InstanceDispatcher&>(*gpu.physicalDevice.getDispatcher());
    auto& dispatcher = const_cast<vk::raii::DeviceDispatcher&>(*gpu.device.getDispatcher());
    instance.vkGetPhysicalDeviceSurfaceSupportKHR = &supportSurface;
    instance.vkGetPhysicalDeviceSurfaceFormatsKHR = &surfaceFormats;
    instance.vkGetPhysicalDeviceSurfaceCapabilitiesKHR = &surfaceCapabilities;
    dispatcher.vkCreateSwapchainKHR = &failSwapchain;
    const vk::SurfaceKHR surface(reinterpret_cast<VkSurfaceKHR>(std::uintptr_t{1}));
    for (int tries = 0; tries < 2; ++tries) {
        try {
            loop_->setSurface(surface, [] { return vk::Extent2D{64, 64}; });
            FAIL() << "there is a swapchain";
        } catch (const renderer::RendererError& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with("the window cannot show pictures: ")) << error.what();
        }
    }
    loop_->setSurface(nullptr, nullptr);
    EXPECT_TRUE(stillPicture(*loop_) == before);
}

TEST_F(ViewLoop, AFootprintIsWhatLightTravelsInPixels) {
    view::SideSettings look;
    look.look.image = renderer::ShownImage::Footprint;
    loop_->setSide(0, look);
    stillPicture(*loop_);
    const Image footprint = loop_->read(0).light;
    const trace::Geometry geometry(*scene_);
    scene::Scene copy = *scene_;
    const auto found = view::inspect(geometry, view::editedOf(copy), scene_->cameras[0], {}, {0.5, 0.5}, side, side);
    const double radius = makeProfile(presets().front())->rmsRadius(0); // skin's red goes farthest
    EXPECT_NEAR(footprint.at(side / 2, side / 2)[0], radius * found->pixelsPerMillimeter, 0.02 * radius);
    EXPECT_EQ(footprint.at(1, 1)[0], 0);
    view::SideSettings picture;
    picture.look.exposure = scene_->exposure;
    loop_->setSide(0, picture);
}

/// The technique's twin on the processor says which pipeline combines a pixel.
TEST_F(ViewLoop, RegionsAreThoseOfTheTechnique) {
    constexpr std::uint32_t width = 200;
    constexpr std::uint32_t height = 150;
    view::SideSettings look;
    look.look.image = renderer::ShownImage::Regions;
    loop_->resize(width, height);
    loop_->setSide(0, look);
    draw(*loop_); // the first sample is in the pixels' middle
    const Image regions = loop_->read(0).light;
    const Image depth = loop_->readImage(renderer::Output::Depth);
    const Image ids = loop_->readImage(renderer::Output::Material);
    ScatterScene scene;
    scene.width = width;
    scene.height = height;
    scene.focalLength = height / (2 * std::tan(scene_->cameras[0].verticalFieldOfView / 2));
    scene.profiles.push_back(makeProfile(presets().front()));
    for (std::uint32_t i = 0; i < width * height; ++i) {
        scene.irradiance.push_back({1, 1, 1});
        scene.depth.push_back(depth.at(i % width, i / width)[0] * scene_->metersPerUnit * 1000);
        scene.materialId.push_back(static_cast<std::uint8_t>(ids.at(i % width, i / width)[0]));
    }
    const BankTwin twin(scene);
    std::array<int, 2> pixels{};
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const auto x = static_cast<int>(i % width);
        const auto y = static_cast<int>(i / width);
        const std::span<const float> color = regions.at(i % width, i / width);
        if (scene.materialId[i] != 0) {
            const bool isSmooth = color[2] > color[0];
            ASSERT_EQ(isSmooth, twin.isCombinedSmoothly(x, y)) << x << ", " << y;
            ++pixels[isSmooth ? 1 : 0];
        }
    }
    EXPECT_GT(pixels[0], 500);
    EXPECT_GT(pixels[1], 500);
    view::SideSettings picture;
    picture.look.exposure = scene_->exposure;
    loop_->setSide(0, picture);
    loop_->resize(side, side);
}

TEST_F(ViewLoop, ABackdropIsSeenWhereThereIsNothing) {
    scene::Camera camera = scene_->cameras[0];
    camera.position += glm::vec3(0, 100, 0); // beside everything
    camera.target += glm::vec3(0, 100, 0);
    loop_->setCamera(camera);
    view::SideSettings white;
    white.look.backdrop = renderer::Backdrop::White;
    loop_->setSide(0, white);
    stillPicture(*loop_);
    EXPECT_EQ(loop_->read(0).shown.at(3, 3)[1], 1);
    EXPECT_LT(loop_->read(0).light.at(3, 3)[1], 0.5f); // it is no light
    view::SideSettings picture;
    picture.look.exposure = scene_->exposure;
    loop_->setSide(0, picture);
    loop_->setCamera(scene_->cameras[0]);
}

TEST_F(ViewLoop, AWindowHasTheMarksOfLights) {
    stillPicture(*loop_);
    loop_->setShown({.marks = {{.place = {0.25f, 0.5f}, .end = {0.25f, 0.5f}, .color = {1, 0, 0.5f}, .radius = 8}}});
    const Image window = loop_->readWindow(2 * side + 40, 2 * side); // bars beside the picture
    EXPECT_EQ(window.at(20 + side / 2, side)[0], 1);
    EXPECT_EQ(window.at(20 + side / 2, side)[1], 0);
    EXPECT_GT(window.at(20 + side, side)[1], 0);
    loop_->setShown({});
}

TEST_F(ViewLoop, ASwatchHasAShadowsEdgeAndAWedge) {
    view::Swatch swatch(device(), 1.28); // px per mm: 32 px a body
    const auto drawn = [&](const Material& material) {
        swatch.setMaterial(material);
        while (!swatch.step()) {
            std::this_thread::yield();
        }
        return swatch.picture();
    };
    Material still = presets().front();
    still.strength = still.translucency = 0;
    const Image without = drawn(still);
    const Image with = drawn(presets().front());
    ASSERT_EQ(with.width, 96u);
    ASSERT_EQ(with.height, 32u);
    const auto red = [](const Image& image, std::uint32_t x) { return image.at(x, 16)[0]; };
    EXPECT_GT(red(without, 28), red(without, 4) + 0.3f); // lit on the right
    EXPECT_GT(red(with, 14), red(without, 14) + 0.1f);   // red goes into the shadow
    EXPECT_GT(red(with, 34), red(without, 34) + 0.1f);   // and through where the wedge is thin
    EXPECT_LT(red(with, 62), red(with, 34) - 0.1f);
    EXPECT_GT(red(with, 80), 0.2f); // the ball
}

TEST(ViewSideError, IsThatOfTheMetrics) {
    Image grey = makeImage(40, 30, {"R", "G", "B"});
    std::ranges::fill(grey.values, 0.25f);
    Image half = grey;
    for (std::size_t i = 0; i < half.values.size() / 2; ++i) {
        half.values[i] = 0.5f;
    }
    view::SideErrorTask task;
    task.begin({half, grey, half, grey});
    task.begin({grey, grey, {}, {}}); // the last of those that wait
    std::vector<view::SideError> measured;
    while (task.isBusy()) {
        if (std::optional<view::SideError> error = task.take()) {
            measured.push_back(std::move(*error));
        }
        std::this_thread::yield();
    }
    ASSERT_EQ(measured.size(), 2u);
    EXPECT_NEAR(measured[0].energyRatio->at(1), 1.5, 1e-6);
    EXPECT_GT(measured[0].flip, 0.1);
    EXPECT_NEAR(measured[0].psnr, errors(toEncoding(half, Encoding::Srgb), toEncoding(grey, Encoding::Srgb)).psnr(1),
                1e-9);
    EXPECT_EQ(measured[0].map.width, 40u);
    EXPECT_TRUE(std::isinf(measured[1].psnr));
    EXPECT_FALSE(measured[1].energyRatio);
}

TEST(ViewReference, ClosingWhileItRunsTakesLessThanASecondOfProcessor) {
    auto task = std::make_unique<view::ReferenceTask>(ballScene(), ballScene().cameras[0], side, side);
    while (task->version() == 0 && task->state().fault.empty()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(task->state().fault, "");
    EXPECT_GT(task->state().light.at(side / 2, side / 2)[0], 0);
    const double begin = tests::processorSeconds();
    task.reset();
    EXPECT_LT(tests::processorSeconds() - begin, 1);
}

TEST(ViewReference, ClosingBeforeItsFirstSampleTakesLessThanASecondOfProcessor) {
    const double start = tests::processorSeconds();
    auto task = std::make_unique<view::ReferenceTask>(ballScene(), ballScene().cameras[0], 2048, 2048);
    while (tests::processorSeconds() - start < 0.4) { // it has its film, and looks where the picture shows a surface
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_EQ(task->state().samples, 0);
    const double begin = tests::processorSeconds();
    task.reset();
    EXPECT_LT(tests::processorSeconds() - begin, 1);
}

} // namespace
} // namespace nacre::tests
