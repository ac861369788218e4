// Two contexts on two threads, with one device and one queue. Also built under ThreadSanitizer (preset tsan), without
// the validation layers, which are not instrumented.
#include "tests/gpu/support/effect.hpp"

#include <mutex>
#include <thread>

using namespace nacre;
using namespace nacre::tests;

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
/// Mesa's software device guards what its threads share by futexes, which the sanitizer does not see.
extern "C" const char* __tsan_default_suppressions() {
    return "race:libvulkan_lvp.so\n";
}
#endif
#endif

namespace {

/// What one thread needs of Vulkan: images, made before it starts, and a command pool of its own.
struct Worker {
    Worker(Gpu& owner, const ScatterInput& input, double variance) : gpu(owner), images(owner, input) {
        material.layers = {{{1, 1, 1}, variance}};
        VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        poolInfo.queueFamilyIndex = gpu.queueFamily;
        EXPECT_EQ(vkCreateCommandPool(gpu.device, &poolInfo, nullptr, &commandPool), VK_SUCCESS);
        VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocation.commandPool = commandPool;
        allocation.commandBufferCount = 1;
        EXPECT_EQ(vkAllocateCommandBuffers(gpu.device, &allocation, &commandBuffer), VK_SUCCESS);
        const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        EXPECT_EQ(vkCreateFence(gpu.device, &fenceInfo, nullptr, &fence), VK_SUCCESS);
    }
    ~Worker() {
        vkDestroyFence(gpu.device, fence, nullptr);
        vkDestroyCommandPool(gpu.device, commandPool, nullptr);
    }
    Worker(const Worker&) = delete;

    /// Makes a context, and scatters with it, setting the material anew every time.
    void work(std::mutex& queue, int frames) {
        NacreContextInfo info = gpu.contextInfo({32, 16});
        info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
        info.getInstanceProcAddr =
            vkGetInstanceProcAddr; // nothing may order the threads, such as what shares pipelines
        Effect effect(gpu, info);
        images.info.technique = NACRE_TECHNIQUE_SEPARABLE;
        for (int i = 0; i < frames; ++i) {
            effect.setMaterials({&material, 1});
            ok = ok && nacreBeginFrame(effect.context, static_cast<std::uint32_t>(i % 2)) == NACRE_SUCCESS;
            const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
            ok = ok && vkResetCommandPool(gpu.device, commandPool, 0) == VK_SUCCESS;
            ok = ok && vkBeginCommandBuffer(commandBuffer, &begin) == VK_SUCCESS;
            ok = ok && nacreCmdScatter(effect.context, commandBuffer, &images.info) == NACRE_SUCCESS;
            ok = ok && vkEndCommandBuffer(commandBuffer) == VK_SUCCESS;
            VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
            submit.commandBufferCount = 1;
            submit.pCommandBuffers = &commandBuffer;
            {
                const std::lock_guard lock(queue);
                ok = ok && vkQueueSubmit(gpu.queue, 1, &submit, fence) == VK_SUCCESS;
            }
            ok = ok && vkWaitForFences(gpu.device, 1, &fence, VK_TRUE, UINT64_MAX) == VK_SUCCESS;
            ok = ok && vkResetFences(gpu.device, 1, &fence) == VK_SUCCESS;
        }
    }

    Gpu& gpu;
    ScatterImages images;
    Material material;
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool ok = true;
};

TEST(ThreadsTest, TwoContextsDoNotKnowOfEachOther) {
    Gpu gpu(false);
    ScatterInput input = ScatterInput::plane(32, 16, Projection::perspective(32, 16, 1000), 500);
    for (std::size_t i = 0; i < input.irradiance.size(); i += 3) {
        input.irradiance[i] = {0, 0, 0, 1};
    }
    Worker first(gpu, input, 0.2);
    Worker second(gpu, input, 4);
    std::mutex queue;
    std::thread other([&] { second.work(queue, 20); });
    first.work(queue, 20);
    other.join();
    for (Worker* worker : {&first, &second}) {
        EXPECT_TRUE(worker->ok);
        const std::vector<Float4> together = gpu.download<Float4>(worker->images.scattered);
        worker->work(queue, 1);
        EXPECT_EQ(together, gpu.download<Float4>(worker->images.scattered));
    }
}

} // namespace
