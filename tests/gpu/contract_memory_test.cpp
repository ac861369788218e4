// Memory: asked for beforehand, placed in the caller's, and enough for every material id.
#include "tests/gpu/support/counted_calls.hpp"
#include "tests/gpu/support/effect.hpp"

#include <cstdlib>
#include <string_view>

using namespace nacre;
using namespace nacre::tests;

namespace {

/// A piece of device memory of the test's own.
struct Piece {
    Piece(Gpu& owner, const VkMemoryRequirements& requirements, bool host) : gpu(owner) {
        VkPhysicalDeviceMemoryProperties properties;
        vkGetPhysicalDeviceMemoryProperties(gpu.physicalDevice, &properties);
        const VkMemoryPropertyFlags wanted =
            host ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        while ((requirements.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
               (properties.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted) {
            ++info.memoryTypeIndex;
        }
        // Not at the start, so that the offset is seen to be used.
        given.offset = requirements.alignment;
        given.size = requirements.size;
        info.allocationSize = given.offset + given.size;
        EXPECT_EQ(vkAllocateMemory(gpu.device, &info, nullptr, &given.memory), VK_SUCCESS);
        if (host) {
            EXPECT_EQ(vkMapMemory(gpu.device, given.memory, given.offset, given.size, 0, &given.mapped), VK_SUCCESS);
        }
    }
    ~Piece() { vkFreeMemory(gpu.device, given.memory, nullptr); }
    Piece(const Piece&) = delete;

    Gpu& gpu;
    NacreMemory given{};
};

// A device that pretends to have one more type of memory, in device memory and for the host, of which nothing is left.
struct FullHeap {
    static inline std::uint32_t type;
    static inline VkDeviceSize size;
    static inline int asked;

    static VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice device, VkPhysicalDeviceMemoryProperties* result) {
        vkGetPhysicalDeviceMemoryProperties(device, result);
        type = result->memoryTypeCount++;
        result->memoryTypes[type] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                         VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                     result->memoryHeapCount};
        result->memoryHeaps[result->memoryHeapCount++] = {size, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
        for (std::uint32_t other = 0; other < type; ++other) { // so that it is preferred
            result->memoryTypes[other].propertyFlags &= ~VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        }
    }
    static VKAPI_ATTR void VKAPI_CALL requirements(VkDevice device, VkBuffer buffer, VkMemoryRequirements* result) {
        vkGetBufferMemoryRequirements(device, buffer, result);
        result->memoryTypeBits |= 1u << type;
    }
    static VKAPI_ATTR VkResult VKAPI_CALL allocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                                   const VkAllocationCallbacks* callbacks, VkDeviceMemory* memory) {
        if (info->memoryTypeIndex == type) {
            ++asked;
            return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        }
        return vkAllocateMemory(device, info, callbacks, memory);
    }
    template <typename Function> static PFN_vkVoidFunction plain(Function* function) {
        return reinterpret_cast<PFN_vkVoidFunction>(function);
    }
    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
        const std::string_view function(name);
        return function == "vkAllocateMemory"                ? plain(&allocate)
               : function == "vkGetBufferMemoryRequirements" ? plain(&requirements)
                                                             : vkGetDeviceProcAddr(device, name);
    }
    static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance instance, const char* name) {
        const std::string_view function(name);
        return function == "vkGetDeviceProcAddr"                   ? plain(&deviceFunction)
               : function == "vkGetPhysicalDeviceMemoryProperties" ? plain(&properties)
                                                                   : vkGetInstanceProcAddr(instance, name);
    }
};

class MemoryTest : public GpuTest {
protected:
    MemoryTest() : input_(ScatterInput::plane(32, 16, Projection::perspective(32, 16, 1000), 500)) {
        for (std::size_t i = 0; i < input_.irradiance.size() / 2; ++i) {
            input_.irradiance[2 * i] = {0, 0, 0, 1};
        }
    }
    ScatterInput input_;
};

TEST_F(MemoryTest, GivenMemoryIsUsedAndGivesTheSamePicture) {
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.getInstanceProcAddr = countingGetInstanceProcAddr;
    const Material material = skin();
    Effect own(gpu, info);
    own.setMaterials({&material, 1});
    NacreMemoryRequirements requirements{};
    ASSERT_EQ(nacreGetMemoryRequirements(&info, &requirements), NACRE_SUCCESS);
    EXPECT_GT(requirements.device.size, 32u * 16 * 8);
    EXPECT_GT(requirements.host.size, 0u);
    const Piece device(gpu, requirements.device, false);
    const Piece host(gpu, requirements.host, true);
    info.deviceMemory = device.given;
    info.hostMemory = host.given;
    std::unique_ptr<Piece> larger; // outlives the context
    callCounts() = {};
    Effect placed(gpu, info);
    EXPECT_EQ(callCounts().memories, 0);
    placed.setMaterials({&material, 1});
    for (const NacreTechnique technique :
         {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK, NACRE_TECHNIQUE_THESIS}) {
        EXPECT_EQ(placed.scatter(input_, technique), own.scatter(input_, technique));
    }
    // A smaller extent has room in it, a larger one has not, and then the old one stays.
    EXPECT_EQ(nacreResize(placed.context, {512, 512}, nullptr), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_NE(placed.messages.back().find("NacreContextInfo::deviceMemory.size is"), std::string::npos);
    EXPECT_EQ(placed.scatter(input_, NACRE_TECHNIQUE_BANK), own.scatter(input_, NACRE_TECHNIQUE_BANK));
    EXPECT_EQ(nacreResize(placed.context, {16, 16}, nullptr), NACRE_SUCCESS);
    // Memory that is handed over takes the place of what was given; too little of it changes nothing.
    NacreContextInfo grown = info;
    grown.maxExtent = {512, 512};
    ASSERT_EQ(nacreGetMemoryRequirements(&grown, &requirements), NACRE_SUCCESS);
    EXPECT_EQ(nacreResize(placed.context, grown.maxExtent, &device.given), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_NE(placed.messages.back().find("deviceMemory.size is"), std::string::npos);
    larger = std::make_unique<Piece>(gpu, requirements.device, false);
    callCounts() = {};
    EXPECT_EQ(nacreResize(placed.context, grown.maxExtent, &larger->given), NACRE_SUCCESS);
    EXPECT_EQ(callCounts().memories, 0);
    EXPECT_EQ(placed.scatter(input_, NACRE_TECHNIQUE_BANK), own.scatter(input_, NACRE_TECHNIQUE_BANK));
}

TEST_F(MemoryTest, OtherMemoryWillDoWhereTheBestIsFull) {
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_BANK;
    const Material material = skin();
    Effect usual(gpu, info);
    usual.setMaterials({&material, 1});
    info.getInstanceProcAddr = FullHeap::instanceFunction;
    for (const VkDeviceSize size : {VkDeviceSize{1} << 30, VkDeviceSize{4096}}) {
        FullHeap::size = size;
        FullHeap::asked = 0;
        Effect effect(gpu, info);
        EXPECT_EQ(FullHeap::asked, size > 4096 ? 1 : 0) << "what is too small is not asked for";
        effect.setMaterials({&material, 1});
        EXPECT_EQ(effect.scatter(input_, NACRE_TECHNIQUE_BANK), usual.scatter(input_, NACRE_TECHNIQUE_BANK));
    }
}

TEST_F(MemoryTest, TheAllocatorIsCopied) {
    static int living;
    living = 0;
    VkAllocationCallbacks callbacks{};
    callbacks.pfnAllocation = [](void*, std::size_t size, std::size_t alignment, VkSystemAllocationScope) -> void* {
        ++living;
        return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    };
    callbacks.pfnReallocation = [](void*, void* old, std::size_t size, std::size_t, VkSystemAllocationScope) -> void* {
        living += old == nullptr;
        return std::realloc(old, size);
    };
    callbacks.pfnFree = [](void*, void* memory) {
        living -= memory != nullptr;
        std::free(memory);
    };
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
    info.allocator = &callbacks;
    {
        Effect effect(gpu, info);
        EXPECT_GT(living, 0);
        callbacks = {};
    }
    EXPECT_EQ(living, 0);
}

TEST_F(MemoryTest, WrongMemoryIsRefused) {
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    std::string message;
    info.userData = &message;
    info.messageCallback = [](NacreSeverity, const char* text, void* user) { *static_cast<std::string*>(user) = text; };
    NacreMemoryRequirements requirements{};
    ASSERT_EQ(nacreGetMemoryRequirements(&info, &requirements), NACRE_SUCCESS);
    const Piece device(gpu, requirements.device, false);
    const Piece host(gpu, requirements.host, true);
    const auto refuse = [&](NacreMemory deviceMemory, NacreMemory hostMemory, NacreResult expected, const char* text) {
        info.deviceMemory = deviceMemory;
        info.hostMemory = hostMemory;
        NacreContext context = nullptr;
        EXPECT_STREQ(nacreResultString(nacreCreateContext(&info, &context)), nacreResultString(expected));
        EXPECT_NE(message.find(text), std::string::npos) << message;
        EXPECT_EQ(context, nullptr);
    };
    NacreMemory wrong = device.given;
    wrong.size -= 1;
    refuse(wrong, host.given, NACRE_ERROR_LIMIT_EXCEEDED, "NacreContextInfo::deviceMemory.size is");
    wrong = device.given;
    wrong.offset += 1;
    refuse(wrong, host.given, NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::deviceMemory.offset is");
    wrong = host.given;
    wrong.mapped = nullptr;
    refuse(device.given, wrong, NACRE_ERROR_INVALID_ARGUMENT, "NacreContextInfo::hostMemory.mapped is null");
    EXPECT_EQ(nacreGetMemoryRequirements(nullptr, &requirements), NACRE_ERROR_INVALID_ARGUMENT);
}

TEST_F(MemoryTest, IdsMayLieAnywhere) {
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.maxMaterials = 2;
    Effect dense(gpu, info);
    Effect sparse(gpu, info);
    const Material both[] = {skin(), marble()};
    dense.setMaterials(both);
    std::vector<NacreLayer> storage[2];
    const NacreMaterial materials[] = {toNacre(both[0], storage[0]), toNacre(both[1], storage[1])};
    ASSERT_EQ(nacreSetMaterials(sparse.context, 65535, 1, &materials[0]), NACRE_SUCCESS);
    ASSERT_EQ(nacreSetMaterials(sparse.context, 300, 1, &materials[1]), NACRE_SUCCESS);
    EXPECT_EQ(nacreSetMaterials(sparse.context, 299, 1, &materials[1]), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_NE(sparse.messages.back().find("3 materials would be set, NacreContextInfo::maxMaterials is 2"),
              std::string::npos)
        << sparse.messages.back();
    EXPECT_EQ(nacreSetMaterials(sparse.context, 300, 1, &materials[1]), NACRE_SUCCESS) << "set anew, not one more";
    ScatterInput far = input_;
    for (std::size_t i = 0; i < far.materialId.size(); ++i) {
        input_.materialId[i] = static_cast<std::uint16_t>(1 + i / 4 % 2);
        far.materialId[i] = i / 4 % 2 == 0 ? 65535 : 300;
    }
    for (const NacreTechnique technique :
         {NACRE_TECHNIQUE_SEPARABLE, NACRE_TECHNIQUE_BRUTE, NACRE_TECHNIQUE_BANK, NACRE_TECHNIQUE_BURLEY,
          NACRE_TECHNIQUE_THESIS, NACRE_TECHNIQUE_BANK_SURFACES}) {
        EXPECT_EQ(sparse.scatter(far, technique), dense.scatter(input_, technique)) << nacreTechniqueString(technique);
    }
    // Ids that were never set are no subsurface.
    far.materialId.assign(far.materialId.size(), 299);
    EXPECT_EQ(sparse.scatter(far, NACRE_TECHNIQUE_BANK), far.irradiance);
}

TEST_F(MemoryTest, EveryIdMayBeSet) {
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.maxMaterials = 65535;
    info.framesInFlight = 1;
    info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE;
    Effect effect(gpu, info);
    Material last;
    last.layers = {{{1, 1, 1}, 2}};
    std::vector<NacreLayer> storage;
    const NacreMaterial material = toNacre(last, storage);
    std::vector<NacreMaterial> one(1, material);
    for (const std::uint32_t id : {1u, 32768u, 65534u, 65535u}) {
        ASSERT_EQ(nacreSetMaterials(effect.context, id, 1, one.data()), NACRE_SUCCESS);
    }
    input_.materialId.assign(input_.materialId.size(), 65535);
    NacreContextInfo small = info;
    small.maxMaterials = 1;
    Effect expected(gpu, small);
    ASSERT_EQ(nacreSetMaterials(expected.context, 65535, 1, &material), NACRE_SUCCESS);
    EXPECT_EQ(effect.scatter(input_, NACRE_TECHNIQUE_SEPARABLE), expected.scatter(input_, NACRE_TECHNIQUE_SEPARABLE));
}

TEST_F(MemoryTest, TablesBeyondTheDevicesLimitAreRefused) {
    if (gpu.properties.limits.maxStorageBufferRange >= 65536ull * 4624) {
        GTEST_SKIP() << "this device has room for all tables";
    }
    NacreContextInfo info = gpu.contextInfo(input_.extent);
    info.maxMaterials = 65535;
    info.techniques = 1u << NACRE_TECHNIQUE_BRUTE;
    std::string message;
    info.userData = &message;
    info.messageCallback = [](NacreSeverity, const char* text, void* user) { *static_cast<std::string*>(user) = text; };
    NacreMemoryRequirements requirements{};
    EXPECT_EQ(nacreGetMemoryRequirements(&info, &requirements), NACRE_ERROR_LIMIT_EXCEEDED);
    EXPECT_NE(message.find("maxMaterials is 65535: the table of brute would take"), std::string::npos) << message;
}

} // namespace
