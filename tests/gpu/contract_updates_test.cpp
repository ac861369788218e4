// Ten thousand material updates while three frames are in flight: no message, no growth, no torn picture.
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"

#include <fstream>

using namespace nacre;
using namespace nacre::tests;

namespace {

constexpr VkExtent2D extent{16, 8};
constexpr std::uint32_t framesInFlight = 3;

/// A frame in flight: its output image, and a command buffer with a fence.
struct Flight {
    explicit Flight(Gpu& owner, const ScatterInput& input) : gpu(owner), images(owner, input) {
        VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.queueFamilyIndex = gpu.queueFamily;
        EXPECT_EQ(vkCreateCommandPool(gpu.device, &pool, nullptr, &commandPool), VK_SUCCESS);
        allocation.commandPool = commandPool;
        allocation.commandBufferCount = 1;
        EXPECT_EQ(vkAllocateCommandBuffers(gpu.device, &allocation, &commandBuffer), VK_SUCCESS);
        const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr, VK_FENCE_CREATE_SIGNALED_BIT};
        EXPECT_EQ(vkCreateFence(gpu.device, &fenceInfo, nullptr, &fence), VK_SUCCESS);
    }
    ~Flight() {
        vkWaitForFences(gpu.device, 1, &fence, VK_TRUE, UINT64_MAX);
        vkDestroyFence(gpu.device, fence, nullptr);
        vkDestroyCommandPool(gpu.device, commandPool, nullptr);
    }
    Flight(const Flight&) = delete;

    Gpu& gpu;
    ScatterImages images;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool submitted = false;
};

/// [KiB] The process's resident memory.
long residentMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) {
            return std::stol(line.substr(6));
        }
    }
    return 0;
}

class UpdatesTest : public GpuTest {
protected:
    UpdatesTest()
        : input_(ScatterInput::plane(extent.width, extent.height, Projection::perspective(16, 8, 1000), 500)) {
        for (std::uint32_t y = 0; y < extent.height; ++y) {
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                input_.irradiance[input_.index(x, y)] = x < 8 ? Float4{0, 0, 0, 1} : Float4{1, 1, 1, 1};
                input_.materialId[input_.index(x, y)] = y < 4 ? 1 : 2;
            }
        }
    }
    void submit(Effect& effect, Flight& flight, std::uint32_t frame) {
        ASSERT_EQ(vkResetFences(gpu.device, 1, &flight.fence), VK_SUCCESS);
        ASSERT_EQ(vkResetCommandPool(gpu.device, flight.commandPool, 0), VK_SUCCESS);
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        ASSERT_EQ(vkBeginCommandBuffer(flight.commandBuffer, &begin), VK_SUCCESS);
        ASSERT_EQ(nacreBeginFrame(effect.context, frame), NACRE_SUCCESS);
        ASSERT_EQ(nacreCmdScatter(effect.context, flight.commandBuffer, &flight.images.info), NACRE_SUCCESS);
        ASSERT_EQ(vkEndCommandBuffer(flight.commandBuffer), VK_SUCCESS);
        VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        info.commandBufferCount = 1;
        info.pCommandBuffers = &flight.commandBuffer;
        ASSERT_EQ(vkQueueSubmit(gpu.queue, 1, &info, flight.fence), VK_SUCCESS);
        flight.submitted = true;
    }
    ScatterInput input_;
};

TEST_F(UpdatesTest, TenThousandWithThreeFramesInFlight) {
    constexpr int updates = 10000;
    constexpr int updatesPerFrame = 8;
    NacreContextInfo info = gpu.contextInfo(extent);
    info.getInstanceProcAddr = countingGetInstanceProcAddr;
    info.framesInFlight = framesInFlight;
    info.maxMaterials = 2;
    info.techniques = 1u << NACRE_TECHNIQUE_BANK;
    Effect effect(gpu, info);
    // Both materials are of one variant at a time: a frame that mixes two variants equals none of the pictures.
    std::vector<std::vector<Material>> variants;
    std::vector<std::vector<Float4>> pictures;
    for (const double variance : {0.05, 0.3, 1.0, 3.0, 9.0}) {
        Material material;
        material.layers = {{{1, 0.5, 0.2}, variance}, {{0, 0.5, 0.8}, variance / 4}};
        variants.push_back({material, material});
        effect.setMaterials(variants.back());
        pictures.push_back(effect.scatter(input_, NACRE_TECHNIQUE_BANK));
    }
    std::vector<std::unique_ptr<Flight>> flights;
    for (std::uint32_t i = 0; i < framesInFlight; ++i) {
        flights.push_back(std::make_unique<Flight>(gpu, input_));
        flights.back()->images.info.technique = NACRE_TECHNIQUE_BANK;
    }
    callCounts() = {};
    long early = 0;
    int torn = 0;
    int frames = 0;
    std::vector<int> seen(pictures.size());
    const auto look = [&](Flight& flight) {
        ASSERT_EQ(vkWaitForFences(gpu.device, 1, &flight.fence, VK_TRUE, UINT64_MAX), VK_SUCCESS);
        if (!flight.submitted || frames++ % 8 != 0) {
            return; // reading back waits for every frame in flight
        }
        const auto found = std::find(pictures.begin(), pictures.end(), gpu.download<Float4>(flight.images.scattered));
        torn += found == pictures.end() ? 1 : 0;
        if (found != pictures.end()) {
            ++seen[static_cast<std::size_t>(found - pictures.begin())];
        }
    };
    for (int i = 0; i < updates; ++i) {
        effect.setMaterials(variants[static_cast<std::size_t>(i) * 7 / 3 % variants.size()]);
        if (i % updatesPerFrame == 0) {
            const auto frame = static_cast<std::uint32_t>(i / updatesPerFrame) % framesInFlight;
            look(*flights[frame]);
            submit(effect, *flights[frame], frame);
        }
        early = i == updates / 10 ? residentMemory() : early;
    }
    for (const std::unique_ptr<Flight>& flight : flights) {
        look(*flight);
    }
    EXPECT_EQ(torn, 0);
    for (const int count : seen) {
        EXPECT_GT(count, 10) << "every variant is seen";
    }
    EXPECT_EQ(callCounts().allocations, 0);
    const long growth = residentMemory() - early;
    std::printf("%d frames, resident memory grew by %ld KiB after the first tenth\n", frames, growth);
    EXPECT_LT(growth, 8 * 1024) << "KiB: 1 byte an update would be 10, a kernel an update 45,000";
}

} // namespace
