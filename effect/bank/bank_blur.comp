// Pass B of `bank`: blurs the levels from 2 on along the surface with a 5x5 binomial, 16x8 texels a workgroup, of the
// coarsest level 6x2, at most one a thread; all levels in one dispatch, coarsest first (the few coarse workgroups would
// else be a serial tail); lists the regions that hold subsurface pixels for pass C. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"
#include "bank_reduction.glsl"
#include "bank_surfaces.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

const int threads = 128;
const ivec2 blockSize = ivec2(16, 8);
// Of the coarsest level, whose texels are reduced twice: as many as have their children in the room of a block of the level
// before.
const ivec2 coarsestSize = ivec2(6, 2);
const int reach = 2; // of the kernels, texels
const int pitch = blockSize.x + 2 * reach;
const int loadedCount = pitch * (blockSize.y + 2 * reach);

// The block's texels with those that its kernels reach, in the words of packReduced.
shared uvec2 lights[loadedCount];
shared float depths[loadedCount]; // 0 = empty
shared uint coveragesAndMaterials[loadedCount];
// Of their second surfaces light, area and depth, 0 = none.
shared uvec2 secondLights[secondLevels > 0 ? loadedCount : 1];
shared float secondDepths[secondLevels > 0 ? loadedCount : 1];
shared uint blockBits; // bits of the block, as below

struct Block {
    int level;
    ivec2 first; // texel
    ivec2 size;
};

// The levels' blocks, counted from the coarsest level on.
Block findBlock(int group) {
    int level = 2;
    [[unroll]] for (int finer = 2; finer < bankLevels; ++finer) {
        level += group < parameters.bankLevels[finer].w ? 1 : 0;
    }
    ivec4 place = parameters.bankLevels[level];
    int index = group - place.w;
    bool isCoarsest = level == bankLevels; // asked twice, so that divisors are constants
    int width = isCoarsest ? (place.y + coarsestSize.x - 1) / coarsestSize.x : (place.y + blockSize.x - 1) / blockSize.x;
    int row = int((float(index) + 0.5) / float(width));
    ivec2 size = isCoarsest ? coarsestSize : blockSize;
    return Block(level, ivec2(index - row * width, row) * size, size);
}

// Texels of a block and around it.
ivec2 loadedSize(Block block) {
    return block.size + 2 * reach;
}

// Bits of a block: texels with a step beside them or pixels left out; texels that are not fully covered; any that are
// covered at all. A block with the last one alone is unbroken.
const uint anyStep = 1u;
const uint notFull = 2u;
const uint anything = 4u;
const uint anySecond = 8u; // and any that have a second surface

// Of a texel by itself …
uint texelBits(uvec4 words) {
    return (isFullyCovered(words.w) ? 0u : notFull) | (isDropped(words.w) ? anyStep : 0u) |
           (words.z != 0u ? anything : 0u) | (secondLevels > 0 && hasSecond(words.w) ? anySecond : 0u);
}

int sharedIndex(ivec2 place) {
    return place.y * pitch + place.x;
}

bool isStepBetween(float a, float b, float limit) {
    return min(a, b) > 0.0 && abs(a - b) > limit;
}

// … and of 2x2 texels, between them and beside them, right and below.
uint stepBits(Block from, ivec2 first) {
    ivec2 last = loadedSize(from) - 1;
    float around[3][3];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        [[unroll]] for (int x = 0; x < 3; ++x) {
            around[y][x] = depths[sharedIndex(min(first + ivec2(x, y), last))];
        }
    }
    float depth = max(max(around[0][0], around[0][1]), max(around[1][0], around[1][1]));
    float limit = bankSmoothDepth * texelWidth(from.level, depth);
    bool steps = false;
    [[unroll]] for (int y = 0; y < 2; ++y) {
        [[unroll]] for (int x = 0; x < 2; ++x) {
            steps = steps || isStepBetween(around[y][x], around[y][x + 1], limit) ||
                    isStepBetween(around[y][x], around[y + 1][x], limit);
        }
    }
    return steps ? anyStep : 0u;
}

void noteBits(uint bits) {
    if (bits != 0u) {
        atomicOr(blockBits, bits);
    }
}

ReducedTexel texelAt(int index) {
    return unpackReduced(uvec4(lights[index], floatBitsToUint(depths[index]), coveragesAndMaterials[index]));
}

#include "bank_blur_load.glsl"

// Whether the texel at `neighbor` is a surface further from `depth` than a smooth one's neighbour would be.
bool isStep(int neighbor, float depth, float limit) {
    float tap = depths[neighbor];
    return tap != 0.0 && abs(tap - depth) > limit;
}

// Where a texel's kernel stands: its own surface or, where it is empty, its neighbours', so that light reaches across
// small holes.
BlurredTexel findSurface(int level, int center) {
    ReducedTexel own = texelAt(center);
    BlurredTexel result = BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, own.coverage > 0.0, own.dropped);
    if (!result.present) {
        float coverage = 0.0;
        float heaviest = 0.0;
        for (int i = 0; i < 9; ++i) {
            ReducedTexel tap = texelAt(center + i % 3 - 1 + (i / 3 - 1) * pitch);
            coverage += tap.coverage;
            result.depth += tap.coverage * tap.depth;
            if (tap.coverage > heaviest) {
                heaviest = tap.coverage;
                result.material = tap.material;
            }
        }
        result.present = coverage > 0.0;
        result.depth /= max(coverage, 1e-20);
    }
    float limit = bankSmoothDepth * texelWidth(level, result.depth);
    bool stepX = isStep(center - 1, result.depth, limit) || isStep(center + 1, result.depth, limit);
    bool stepY = isStep(center - pitch, result.depth, limit) || isStep(center + pitch, result.depth, limit);
    result.stepped = result.stepped || stepX || stepY;
    return result;
}

// Light and area of a texel.
vec4 unpackTap(uvec2 words) {
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

// Adds a tap to light and area. An empty texel has no area. `distance`: how far it is behind the surface. `scale`: depthScale.
void addTap(inout vec4 sum, vec4 tap, float distance, float kernel, float scale) {
    float weight = depthWeight(distance, scale) * (kernel * tap.w);
    sum += weight * vec4(tap.rgb, 1.0);
}

// The binomial's weights from the middle on.
const float kernelTaps[3] = float[](6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);

const float blurDepthVariance = secondLevels > 0 ? bankSecondBlurDepthVariance : bankBlurDepthVariance;

// Blurs along a surface, whatever is around the texel.
BlurredTexel blurAlong(BlurredTexel surface, int level, int center) {
    float scale = depthScale(texelWidth(level, surface.depth), blurDepthVariance);
    bool seconds = secondLevels > 0 && (blockBits & anySecond) != 0u;
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (int y = -2; y <= 2; ++y) {
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            int index = center + x + y * pitch;
            float kernel = kernelTaps[abs(x)] * kernelTaps[abs(y)];
            if (separateMaterials) {
                kernel = exchanges(materialOf(coveragesAndMaterials[index]), surface.material) ? kernel : 0.0;
            }
            addTap(sum, unpackTap(lights[index]), depths[index] - surface.depth, kernel, scale);
        }
        [[unroll]] for (int x = -2; seconds && x <= 2; ++x) {
            int index = center + x + y * pitch;
            float kernel = kernelTaps[abs(x)] * kernelTaps[abs(y)];
            addTap(sum, unpackTap(secondLights[index]), secondDepths[index] - surface.depth, kernel, scale);
        }
    }
    surface.coverage = unpackHalf2x16(packHalf2x16(vec2(coverageOf(sum.w), 0.0))).x; // as it is stored
    surface.light = sum.rgb * (surface.coverage / max(sum.w, bankLeastWeight));
    return surface;
}

// Where the kernel of a texel of an unbroken block stands, and what scales squared depth differences from there.
struct UnbrokenCenter {
    float depth;
    float scale;
};

UnbrokenCenter unbrokenCenter(int level, int index) {
    return UnbrokenCenter(depths[index], depthScale(texelWidth(level, depths[index]), blurDepthVariance));
}

// Fourth roots of the binomial's weights.
const float kernelRoots[3] = float[](0.78254229, 0.70710678, 0.5);

// The same in an unbroken block, where every tap is full and no step is near: nothing is missing, nothing left out. `root` is
// the kernel's fourth root, taken into the fourth power of the depth weight.
void addUnbrokenTap(inout vec4 sum, vec4 lightAndArea, float depth, UnbrokenCenter center, float root) {
    float difference = depth - center.depth;
    float base = clamp(root - difference * difference * (root * center.scale), 0.0, 1.0);
    base *= base;
    float weight = base * base * lightAndArea.w;
    sum += weight * vec4(lightAndArea.rgb, 1.0);
}

BlurredTexel unbrokenTexel(vec4 sum, int index) {
    return BlurredTexel(sum.rgb / sum.w, 1.0, depths[index], materialOf(coveragesAndMaterials[index]), true, false);
}

BlurredTexel blurUnbroken(int level, int center) {
    UnbrokenCenter from = unbrokenCenter(level, center);
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (int y = -2; y <= 2; ++y) {
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            int index = center + x + y * pitch;
            addUnbrokenTap(sum, unpackTap(lights[index]), depths[index], from, kernelRoots[abs(x)] * kernelRoots[abs(y)]);
        }
    }
    return unbrokenTexel(sum, center);
}

const BlurredTexel emptyBlurred = BlurredTexel(vec3(0.0), 0.0, 0.0, 0u, false, true);

void storeBlurred(Block block, ivec2 local, BlurredTexel blurred) {
    ivec2 texel = block.first + local;
    if (any(greaterThanEqual(local, block.size)) || any(greaterThanEqual(texel, levelExtent(block.level)))) {
        return;
    }
    int index = blurredIndex(texelIndex(block.level, texel));
    blurredLights[index] = blurred.present ? packBlurred(blurred) : uvec2(0u, steppedBit);
    bool isEmpty = depths[sharedIndex(local + reach)] == 0.0;
    if (isEmpty && blurred.present) {
        borrowedSurfaces[index] = uvec2(floatBitsToUint(blurred.depth), blurred.material);
    }
}

// A texel's second surface. With its depth, so that the combination finds all of it in one place.
void storeSecond(Block block, ivec2 local, BlurredTexel blurred) {
    ivec2 texel = block.first + local;
    if (all(lessThan(texel, levelExtent(block.level)))) {
        uvec2 light = packBlurred(blurred);
        secondTexels[blurredSecondIndex(texelIndex(block.level, texel))] =
            uvec4(light, floatBitsToUint(blurred.depth), 0u);
    }
}

// Both surfaces of a texel in whose block something is missing or away.
void blurSurfaces(Block block, ivec2 local, int center) {
    BlurredTexel surface = findSurface(block.level, center);
    int count = (blockBits & anySecond) != 0u && secondDepths[center] > 0.0 ? 2 : 1;
    [[dont_unroll]] for (int i = 0; i < count; ++i) {
        BlurredTexel blurred = blurAlong(surface, block.level, center);
        if (i == 0) {
            storeBlurred(block, local, blurred);
        } else {
            storeSecond(block, local, blurred);
        }
        surface = BlurredTexel(vec3(0.0), 0.0, secondDepths[center], 0u, true, true);
    }
}

#include "bank_lists.glsl"

void main() {
    int thread = int(gl_LocalInvocationIndex);
    int group = int(gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x);
    if (group < parameters.bankLevels[bankLevels].w) {
        listRegions(group, thread);
        return;
    }
    Block block = findBlock(group);
    if (thread == 0) {
        blockBits = 0u;
    }
    barrier();
    if (block.level <= tileLevels) {
        loadBlock(block, thread);
    } else if (secondLevels > 0 && block.level <= secondLevels) {
        loadSecondsBlock(block, thread);
    } else {
        loadCoarseBlock(block, thread);
    }
    barrier();
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    if ((blockBits & anything) == 0u) { // no pixel will read these, but other texels lie near
        storeBlurred(block, local, emptyBlurred);
        return;
    }
    if (secondLevels > 0 && block.level <= tileLevels && (blockBits & anySecond) != 0u) {
        loadSeconds(block, thread);
    }
    int row = thread / (pitch / 2);
    ivec2 pair = 2 * ivec2(thread - row * (pitch / 2), row);
    if (all(lessThan(pair, loadedSize(block)))) {
        noteBits(stepBits(block, pair));
    }
    barrier();
    if (any(greaterThanEqual(local, block.size))) {
        return;
    }
    int center = sharedIndex(local + reach);
    bool isUnbroken = !separateMaterials && blockBits == anything;
    if (secondLevels > 0 && !isUnbroken) {
        blurSurfaces(block, local, center);
        return;
    }
    storeBlurred(block, local, isUnbroken || secondLevels > 0
                                   ? blurUnbroken(block.level, center)
                                   : blurAlong(findSurface(block.level, center), block.level, center));
}
