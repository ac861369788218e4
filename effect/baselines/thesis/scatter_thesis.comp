// Technique `thesis`: one pass of one material (Andersen, appendix B). HORIZONTAL reads the irradiance and writes
// `rows`, else reads `rows` and writes the output. BAKED has its kernel as constants. A thread group keeps its row, with
// the kernel's radius on either side, in shared memory. What differs from the listings:
// - A tap's index is bounded by the radius, which the cache holds for every thread. Theirs leaves the cache when
//   offset · step reaches a texel.
// - The centre is the thread's own pixel. Theirs is the next one, which loses a material's last column and row.
// - Every edge of the image goes on beyond it. Their unsigned subtraction wraps at the left and the upper one.
// - A light that is not finite is black.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "thesis_blocks.h"
#include "interface/scatter.glsl"

#ifdef HORIZONTAL
layout(local_size_x = thesisGroupSize, local_size_y = 1) in;
const ivec2 direction = ivec2(1, 0);
#else
layout(local_size_x = 1, local_size_y = thesisGroupSize) in;
const ivec2 direction = ivec2(0, 1);
#endif
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    vec4 kernels[]; // thesisTaps a material
};
layout(set = 0, binding = bindingIntermediates + intermediateRows, rgba16f) uniform image2D rows;
layout(push_constant) uniform MaterialPass {
    uint passMaterial;
};

#ifdef BAKED
layout(constant_id = 0) const int kernelRadius = 1;
#define NACRE_DECLARE_TAP(i)                                                                                           \
    layout(constant_id = 4 * i + 1) const float red##i = 0.0;                                                          \
    layout(constant_id = 4 * i + 2) const float green##i = 0.0;                                                        \
    layout(constant_id = 4 * i + 3) const float blue##i = 0.0;                                                         \
    layout(constant_id = 4 * i + 4) const float offset##i = 0.0;
NACRE_DECLARE_TAP(0)
NACRE_DECLARE_TAP(1)
NACRE_DECLARE_TAP(2)
NACRE_DECLARE_TAP(3)
NACRE_DECLARE_TAP(4)
NACRE_DECLARE_TAP(5)
NACRE_DECLARE_TAP(6)
NACRE_DECLARE_TAP(7)
NACRE_DECLARE_TAP(8)
NACRE_DECLARE_TAP(9)
NACRE_DECLARE_TAP(10)
NACRE_DECLARE_TAP(11)
NACRE_DECLARE_TAP(12)
NACRE_DECLARE_TAP(13)
NACRE_DECLARE_TAP(14)
NACRE_DECLARE_TAP(15)
NACRE_DECLARE_TAP(16)
#else
#define kernelRadius int(parameters.thesisRadius)
#endif

// 1 / tan of half the listing's field of view, 55 degrees.
const float projectionDistance = 1.92098213;

struct CachedPixel {
    vec4 color; // alpha: strength, 0 = not of this material
    float depth;
};
shared CachedPixel blurCache[thesisGroupSize + 2u * thesisMaxRadius];

// The thread's own pixel and how far it blurs.
struct Center {
    vec4 color;
    float depth;
    int index; // in blurCache
    float stepLength;
};

// The pixel that the cache holds for a place in the row: the image's edge goes on beyond it. Pixels of other materials
// are black, as in a target that only this material's objects are drawn to.
CachedPixel fetch(ivec2 local) {
    ivec2 pixel = clamp(local, ivec2(0), view.areaExtent - 1) + view.areaOffset;
    float z = viewZ(pixel);
    if (materialAt(pixel) != passMaterial || !isValidZ(z)) {
        return CachedPixel(vec4(0.0), isFinite(z) ? -z / view.mmPerUnit : 0.0);
    }
#ifdef HORIZONTAL
    vec3 light = enteringLight(pixel, passMaterial);
    vec4 color = vec4(isFinite(light) ? light : vec3(0.0), strengthAt(pixel, passMaterial));
#else
    vec4 color = imageLoad(rows, pixel - view.areaOffset);
#endif
    return CachedPixel(color, -z / view.mmPerUnit);
}

// Adds tap i of the kernel. The listing's index, bounded by what every thread of the group has in the cache.
void addTap(Center center, int i, vec4 tap, inout vec3 sum) {
    int offset = int(clamp(floor(float(i) + tap.w * center.stepLength), float(-kernelRadius), float(kernelRadius)));
    CachedPixel source = blurCache[center.index + offset];
    float fallback = clamp(300.0 * projectionDistance * parameters.thesisStrength * abs(center.depth - source.depth),
                           0.0, 1.0);
    sum += tap.rgb * mix(source.color.rgb, center.color.rgb, fallback);
}

vec3 blur(Center center) {
    vec3 sum = vec3(0.0);
#ifdef BAKED
#define NACRE_TAP(i) vec4(red##i, green##i, blue##i, offset##i)
#define NACRE_ADD_TAPS(i)                                                                                              \
    if (i <= kernelRadius) {                                                                                                 \
        addTap(center, -i, NACRE_TAP(i) * vec4(1.0, 1.0, 1.0, -1.0), sum);                                             \
        addTap(center, i, NACRE_TAP(i), sum);                                                                          \
    }
    addTap(center, 0, NACRE_TAP(0), sum);
    NACRE_ADD_TAPS(1)
    NACRE_ADD_TAPS(2)
    NACRE_ADD_TAPS(3)
    NACRE_ADD_TAPS(4)
    NACRE_ADD_TAPS(5)
    NACRE_ADD_TAPS(6)
    NACRE_ADD_TAPS(7)
    NACRE_ADD_TAPS(8)
    NACRE_ADD_TAPS(9)
    NACRE_ADD_TAPS(10)
    NACRE_ADD_TAPS(11)
    NACRE_ADD_TAPS(12)
    NACRE_ADD_TAPS(13)
    NACRE_ADD_TAPS(14)
    NACRE_ADD_TAPS(15)
    NACRE_ADD_TAPS(16)
#else
    uint middle = passMaterial * thesisTaps + thesisKernelStart(uint(kernelRadius));
    for (int i = -kernelRadius; i <= kernelRadius; ++i) {
        vec4 tap = kernels[middle + uint(abs(i))];
        addTap(center, i, vec4(tap.rgb, i < 0 ? -tap.w : tap.w), sum);
    }
#endif
    return sum;
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    int thread = int(gl_LocalInvocationIndex);
    blurCache[thread + kernelRadius] = fetch(local);
    if (thread < kernelRadius) {
        blurCache[thread] = fetch(local - kernelRadius * direction);
        blurCache[thread + kernelRadius + int(thesisGroupSize)] = fetch(local + int(thesisGroupSize) * direction);
    }
    barrier();
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    CachedPixel own = blurCache[thread + kernelRadius];
    vec3 light = vec3(0.0);
    if (own.color.a > 0.0) {
        float scale = projectionDistance / own.depth;
        float stepLength = parameters.thesisStrength * 2.0 * scale * own.color.a / float(kernelRadius);
        stepLength = min(stepLength, 1e9); // finite, however near the surface is
        light = blur(Center(own.color, own.depth, thread + kernelRadius, stepLength));
    }
    ivec2 pixel = local + view.areaOffset;
    bool written = materialAt(pixel) == passMaterial;
#ifdef HORIZONTAL
    if (written) {
        imageStore(rows, local, own.color.a > 0.0 ? vec4(clamp(light, vec3(-maxHalf), vec3(maxHalf)), 1.0) : vec4(0.0));
    }
#else
    if (written && own.color.a > 0.0) {
        writeLight(pixel, passMaterial, light);
    }
#endif
}
