/* A C99 program that needs the installed headers, the library and Vulkan's loader alone: asks for the requirements,
 * opens a device with them, makes a context and gives it a material. Prints the cost of a scatter call. */
#include <nacre/nacre.h>
#include <stdio.h>
#include <vulkan/vulkan.h>

#ifdef CONSUMER_HAS_CXX
int useWrapper(const NacreContextInfo* info);
#else
static int useWrapper(const NacreContextInfo* info) {
    return info == NULL;
}
#endif

static void onMessage(NacreSeverity severity, const char* message, void* userData) {
    (void)userData;
    fprintf(stderr, "nacre %s: %s\n", severity == NACRE_SEVERITY_ERROR ? "error" : "info", message);
}

static int useContext(const NacreContextInfo* info) {
    const NacreLayer layers[] = {{{0.5f, 0.7f, 0.9f}, 0.02f}, {{0.5f, 0.3f, 0.1f}, 1.2f}};
    NacreMaterial material = nacreDefaultMaterial();
    NacreContext context = NULL;
    NacreCost cost;
    NacreResult result = nacreCreateContext(info, &context);
    if (result != NACRE_SUCCESS) {
        printf("%s\n", nacreResultString(result));
        return 1;
    }
    material.layers = layers;
    material.layerCount = 2;
    result = nacreSetMaterials(context, 1, 1, &material);
    if (result == NACRE_SUCCESS) {
        result = nacreGetScatterCost(context, NACRE_TECHNIQUE_DEFAULT, &cost);
    }
    if (result == NACRE_SUCCESS) {
        printf("%u dispatches, %llu bytes\n", cost.dispatchCount, (unsigned long long)cost.intermediateBytes);
    }
    nacreDestroyContext(context);
    return result == NACRE_SUCCESS ? 0 : 1;
}

int main(void) {
    NacreRequirements requirements;
    VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO};
    VkInstanceCreateInfo instanceInfo = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    VkDeviceQueueCreateInfo queueInfo = {VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkDeviceCreateInfo deviceInfo = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    const float priority = 1;
    uint32_t count = 1;
    NacreContextInfo info = {NACRE_HEADER_VERSION};
    int failed = 0;

    if (nacreGetVersion() != NACRE_HEADER_VERSION || nacreGetRequirements(&requirements) != NACRE_SUCCESS) {
        return 1;
    }
    application.apiVersion = requirements.apiVersion;
    instanceInfo.pApplicationInfo = &application;
    if (vkCreateInstance(&instanceInfo, NULL, &info.instance) != VK_SUCCESS) {
        return 1;
    }
    vkEnumeratePhysicalDevices(info.instance, &count, &info.physicalDevice);
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    deviceInfo.pNext = &requirements.features12;
    deviceInfo.queueCreateInfoCount = 1;
    deviceInfo.pQueueCreateInfos = &queueInfo;
    deviceInfo.pEnabledFeatures = &requirements.features;
    if (count == 0 || vkCreateDevice(info.physicalDevice, &deviceInfo, NULL, &info.device) != VK_SUCCESS) {
        return 1;
    }
    info.getInstanceProcAddr = vkGetInstanceProcAddr;
    info.maxExtent.width = info.maxExtent.height = 64;
    info.techniques = 1u << NACRE_TECHNIQUE_SEPARABLE | 1u << NACRE_TECHNIQUE_DEFAULT;
    info.messageCallback = onMessage;
    failed = useContext(&info) != 0 || useWrapper(&info) != 0;
    vkDestroyDevice(info.device, NULL);
    vkDestroyInstance(info.instance, NULL);
    return failed;
}
