// Pass B of `bank`: blurs every level along the surface: level 1 with a 3x3 mean, 16x16 texels a workgroup, two a thread,
// the others with a 5x5 binomial, 16x8 texels, one a thread; all levels in one dispatch, coarsest first
// (the few coarse workgroups would else be a serial tail); lists the regions that hold subsurface pixels for pass C.
// docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

const int threads = 128;
const int side = 16;
const int pitch = side + 4;

// The block's texels with those that its kernels reach, in the words of packRaw.
shared uvec2 lights[pitch * pitch];
shared float depths[pitch * pitch]; // 0 = empty
shared uint massesAndMaterials[pitch * pitch];
shared uvec4 seconds[secondLevels > 0 ? pitch * pitch : 1]; // second surfaces of the texels that have one
shared uint rough; // bits of roughness

struct Block {
    int level;
    ivec2 first; // texel
    int rows;    // 16 on level 1, else 8
    int reach;   // of its kernels, texels: 1 on level 1, else 2
};

// Texels of a block and around it.
ivec2 loadedSize(Block block) {
    return ivec2(side, block.rows) + 2 * block.reach;
}

// The levels' blocks, counted from the coarsest level on.
Block findBlock(int group) {
    int level = 1;
    [[unroll]] for (int finer = 1; finer < bankLevels; ++finer) {
        level += group < parameters.bankLevels[finer].w ? 1 : 0;
    }
    ivec4 place = parameters.bankLevels[level];
    int index = group - place.w;
    int width = (place.y + side - 1) / side;
    int row = int((float(index) + 0.5) / float(width));
    int rows = level == 1 ? side : side / 2;
    return Block(level, ivec2(index - row * width, row) * ivec2(side, rows), rows, level == 1 ? 1 : 2);
}

// Whether the texel at `neighbor` is a surface further from `depth` than a smooth one's neighbour would be.
bool isStep(int neighbor, float depth, float limit) {
    float tap = depths[neighbor];
    return tap != 0.0 && abs(tap - depth) > limit;
}

// Bits of a block: texels with a step beside them or pixels left out, among the rows that the tile's upper region
// reads, and its lower; texels that are not wholly covered; any that are covered at all.
const uint roughUpper = 1u;
const uint roughLower = 2u;
const uint notFull = 4u;
const uint anything = 8u;
const uint anySecond = 16u;

uint roughRows(int row) {
    return (row < side / 2 + 2 ? roughUpper : 0u) | (row >= side / 2 ? roughLower : 0u);
}

// Of a texel by itself …
uint roughnessOf(uvec4 words, int row) {
    // The mass, a half: 1 is 0x3c00; with a sign it is dropped.
    return ((words.w & 0xffffu) == 0x3c00u ? 0u : notFull) |
           ((words.w & 0x8000u) != 0u ? roughRows(row) : 0u) | (words.z != 0u ? anything : 0u) |
           (secondLevels > 0 && (words.w & secondBit) != 0u ? anySecond : 0u);
}

bool isStepBetween(float a, float b, float limit) {
    return min(a, b) > 0.0 && abs(a - b) > limit;
}

// … and of a 2x2 block of texels, between them and beside them, right and below.
uint roughnessBetween(Block from, ivec2 first) {
    float block[3][3];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        [[unroll]] for (int x = 0; x < 3; ++x) {
            ivec2 place = min(first + ivec2(x, y), loadedSize(from) - 1);
            block[y][x] = depths[place.y * pitch + place.x];
        }
    }
    bool hasHole = min(min(block[0][0], block[0][1]), min(block[1][0], block[1][1])) == 0.0;
    float depth = max(max(block[0][0], block[0][1]), max(block[1][0], block[1][1]));
    float limit = (hasHole ? bankSmoothHoleDepth : bankSmoothDepth) * texelWidth(from.level, depth);
    uint result = 0u;
    [[unroll]] for (int y = 0; y < 2; ++y) {
        bool steps = false;
        [[unroll]] for (int x = 0; x < 2; ++x) {
            steps = steps || isStepBetween(block[y][x], block[y][x + 1], limit) ||
                    isStepBetween(block[y][x], block[y + 1][x], limit);
        }
        result |= steps ? roughRows(first.y + y) : 0u;
    }
    return result;
}

void noteRoughness(uint roughness) {
    if (roughness != 0u) {
        atomicOr(rough, roughness);
    }
}

int sharedIndex(ivec2 place) {
    return place.y * pitch + place.x;
}

void storeShared(ivec2 place, uvec4 words) {
    int index = sharedIndex(place);
    lights[index] = words.xy;
    depths[index] = uintBitsToFloat(words.z);
    massesAndMaterials[index] = words.w;
}

bool hasSecond(int index) {
    return secondLevels > 0 && (massesAndMaterials[index] & secondBit) != 0u;
}

// Of the texels that a block loads, counted row by row.
ivec2 loadedPlace(Block block, int index) {
    int width = loadedSize(block).x;
    int row = int((float(index) + 0.5) / float(width));
    return ivec2(index - row * width, row);
}

// 18x18 texels at most.
const int loadSteps = 3;

// All fetches before any of them is used, so that they overlap.
void loadBlock(Block block, int thread) {
    ivec2 size = loadedSize(block);
    uvec4 words[loadSteps];
    [[unroll]] for (int i = 0; i < loadSteps; ++i) {
        ivec2 place = loadedPlace(block, thread + i * threads);
        words[i] = rawWords(block.level, block.first - block.reach + place);
    }
    uint roughness = 0u;
    [[unroll]] for (int i = 0; i < loadSteps; ++i) {
        ivec2 place = loadedPlace(block, thread + i * threads);
        if (place.y < size.y) {
            storeShared(place, words[i]);
            roughness |= roughnessOf(words[i], place.y);
            if (hasSecond(sharedIndex(place))) {
                int second = 3 * texelIndex(block.level, block.first - block.reach + place);
                seconds[sharedIndex(place)] = uvec4(secondTexels[second], secondTexels[second + 1]);
            }
        }
    }
    noteRoughness(roughness);
}

// Of the texels around a block only those inside it are this workgroup's to store.
void storeOwn(Block block, ivec2 texel, uvec4 words) {
    ivec2 last = min(block.first + ivec2(side, block.rows), levelExtent(block.level));
    if (all(greaterThanEqual(texel, block.first)) && all(lessThan(texel, last))) {
        rawTexels[texelIndex(block.level, texel)] = words;
    }
}

// A texel of a level that pass A leaves to this one.
RawTexel reducedTexel(int level, ivec2 texel) {
    RawTexel children[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        children[i] = unpackRaw(rawWords(level - 1, 2 * texel + ivec2(i & 1, i >> 1)));
    }
    return reduceTexels(children, level);
}

RawTexel coarseTexel(int level, ivec2 texel) {
    if (level == rawLevels + 1) {
        return reducedTexel(level, texel);
    }
    RawTexel children[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        children[i] = reducedTexel(level - 1, 2 * texel + ivec2(i & 1, i >> 1));
    }
    return reduceTexels(children, level);
}

void loadCoarseBlock(Block block, int thread) {
    ivec2 extent = levelExtent(block.level);
    ivec2 size = loadedSize(block);
    for (int index = thread; index < size.x * size.y; index += threads) {
        ivec2 place = loadedPlace(block, index);
        ivec2 texel = block.first - block.reach + place;
        bool inside = texel == clamp(texel, ivec2(0), extent - 1);
        uvec4 words = inside ? packRaw(coarseTexel(block.level, texel)) : uvec4(0u);
        storeShared(place, words);
        storeOwn(block, texel, words);
        noteRoughness(roughnessOf(words, place.y));
    }
}

RawTexel texelAt(int index) {
    return unpackRaw(uvec4(lights[index], floatBitsToUint(depths[index]), massesAndMaterials[index]));
}

// Where a texel's second kernel stands.
BlurredTexel findSecond(int center) {
    RawTexel own = unpackRaw(seconds[center]);
    return BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, true, true);
}

// Where a texel's kernel stands: its own surface or, where it is empty, its neighbours', so that light reaches across
// small holes.
BlurredTexel findSurface(int level, int center) {
    RawTexel own = texelAt(center);
    BlurredTexel result = BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, own.mass > 0.0, own.dropped);
    if (!result.present) {
        float mass = 0.0;
        float heaviest = 0.0;
        for (int i = 0; i < 9; ++i) {
            RawTexel tap = texelAt(center + i % 3 - 1 + (i / 3 - 1) * pitch);
            mass += tap.mass;
            result.depth += tap.mass * tap.depth;
            if (tap.mass > heaviest) {
                heaviest = tap.mass;
                result.material = tap.material;
            }
        }
        result.present = mass > 0.0;
        result.depth /= max(mass, 1e-20);
    }
    float limit = bankSmoothDepth * texelWidth(level, result.depth);
    bool stepX = isStep(center - 1, result.depth, limit) || isStep(center + 1, result.depth, limit);
    bool stepY = isStep(center - pitch, result.depth, limit) || isStep(center + pitch, result.depth, limit);
    result.rough = result.rough || stepX || stepY;
    return result;
}

// Weighted sums of a kernel's taps.
struct Sums {
    vec3 light;
    float area;
};

void addTap(inout Sums sums, RawTexel tap, BlurredTexel surface, float kernel, float width) {
    float difference = tap.depth - surface.depth;
    float weight = kernel * falloff(difference * difference / (bankBlurDepthVariance * width * width));
    bool taken = tap.mass > 0.0 && givesLight(tap.material, surface.material);
    weight = taken ? weight : 0.0;
    sums.light += weight * tap.light;
    sums.area += weight * tap.area;
}

void divide(inout BlurredTexel texel, Sums sums) {
    texel.mass = massOf(sums.area);
    texel.light = sums.light * (texel.mass / max(sums.area, bankLeastWeight));
}

const float finestKernel = 1.0 / 9.0;
// The binomial's weights from the middle on.
const float coarseKernel[3] = float[](6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);

void addTaps(inout Sums sums, int index, BlurredTexel surface, float kernel, float width) {
    addTap(sums, texelAt(index), surface, kernel, width);
    if (secondLevels > 0 && (rough & anySecond) != 0u && hasSecond(index)) {
        addTap(sums, unpackRaw(seconds[index]), surface, kernel, width);
    }
}

// Blurs a texel on one of its surfaces, whatever is around it.
BlurredTexel blurTexel(int level, int center, BlurredTexel surface) {
    float width = texelWidth(level, surface.depth);
    Sums sums = Sums(vec3(0.0), 0.0);
    if (level == 1) {
        [[dont_unroll]] for (int y = -1; y <= 1; ++y) {
            [[unroll]] for (int x = -1; x <= 1; ++x) {
                addTaps(sums, center + x + y * pitch, surface, finestKernel, width);
            }
        }
    } else {
        [[dont_unroll]] for (int y = -2; y <= 2; ++y) {
            [[unroll]] for (int x = -2; x <= 2; ++x) {
                addTaps(sums, center + x + y * pitch, surface, coarseKernel[abs(x)] * coarseKernel[abs(y)], width);
            }
        }
    }
    divide(surface, sums);
    return surface;
}

// Where a plain texel's kernel stands, and what scales squared depth differences from there.
struct PlainCenter {
    float depth;
    float scale;
};

PlainCenter plainCenter(int level, int index) {
    float width = texelWidth(level, depths[index]);
    return PlainCenter(depths[index], 0.25 / (bankBlurDepthVariance * width * width));
}

// Fourth roots of the binomial's weights; the mean's are all the same.
const float coarseRoots[3] = float[](0.78254229, 0.70710678, 0.5);

vec4 lightAndAreaAt(int index) {
    return vec4(unpackHalf2x16(lights[index].x), unpackHalf2x16(lights[index].y));
}

// The same where every tap is full and no step is near: nothing is missing, nothing left out. `root` is the kernel's
// fourth root, taken into the fourth power of the depth weight.
void addPlainTap(inout vec4 sum, vec4 lightAndArea, float depth, PlainCenter center, float root) {
    float difference = depth - center.depth;
    float base = clamp(root - difference * difference * (root * center.scale), 0.0, 1.0);
    base *= base;
    sum += base * base * lightAndArea;
}

BlurredTexel plainTexel(vec4 sum, int index) {
    return BlurredTexel(sum.rgb / sum.w, 1.0, depths[index], massesAndMaterials[index] >> 16, true, false);
}

BlurredTexel blurPlain(int level, int center) {
    PlainCenter from = plainCenter(level, center);
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (int y = -2; y <= 2; ++y) {
        [[unroll]] for (int x = -2; x <= 2; ++x) {
            int index = center + x + y * pitch;
            addPlainTap(sum, lightAndAreaAt(index), depths[index], from, coarseRoots[abs(x)] * coarseRoots[abs(y)]);
        }
    }
    return plainTexel(sum, center);
}

// Blurs a texel of level 1 and the one below it, which have two of three rows of taps in common.
void blurFinestPair(int center, out BlurredTexel upper, out BlurredTexel lower) {
    PlainCenter upperCenter = plainCenter(1, center);
    PlainCenter lowerCenter = plainCenter(1, center + pitch);
    vec4 upperSum = vec4(0.0);
    vec4 lowerSum = vec4(0.0);
    [[unroll]] for (int y = -1; y <= 2; ++y) {
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            int index = center + x + y * pitch;
            vec4 lightAndArea = lightAndAreaAt(index);
            if (y < 2) {
                addPlainTap(upperSum, lightAndArea, depths[index], upperCenter, 1.0);
            }
            if (y > -1) {
                addPlainTap(lowerSum, lightAndArea, depths[index], lowerCenter, 1.0);
            }
        }
    }
    upper = plainTexel(upperSum, center);
    lower = plainTexel(lowerSum, center + pitch);
}

const BlurredTexel emptyBlurred = BlurredTexel(vec3(0.0), 0.0, 0.0, 0u, false, true);

void storeBlurred(Block block, ivec2 local, BlurredTexel blurred) {
    ivec2 texel = block.first + local;
    if (any(greaterThanEqual(texel, levelExtent(block.level)))) {
        return;
    }
    int index = texelIndex(block.level, texel);
    blurredLights[index] = blurred.present ? packBlurred(blurred) : uvec2(0u, signBit);
    bool isEmpty = depths[sharedIndex(local + block.reach)] == 0.0;
    if (isEmpty && blurred.present) {
        borrowedSurfaces[index] = uvec2(floatBitsToUint(blurred.depth), blurred.material);
    }
}

// A texel's surface, and its second one if it has one.
void blurRough(Block block, ivec2 local, int center) {
    storeBlurred(block, local, blurTexel(block.level, center, findSurface(block.level, center)));
    if (hasSecond(center)) {
        int second = 3 * texelIndex(block.level, block.first + local);
        secondTexels[second + 2] = packBlurred(blurTexel(block.level, center, findSecond(center)));
    }
}

// Puts a region on the list of the pipeline that combines it, and makes that pipeline's dispatch cover the list. `row`: 0
// or 1, the block's upper or lower one.
void listRegion(ivec2 block, int row) {
    ivec2 region = ivec2(block.x, 2 * block.y + row);
    int tile = tileIndex(region * ivec2(2, 1));
    if ((tileEntries[tile] | tileEntries[tile + 1]) == 0u) {
        return;
    }
    // Where materials are separate, pixels are combined tap by tap.
    bool isEdge = separateMaterials || (rough & (row == 0 ? roughUpper : roughLower)) != 0u;
    int kind = isEdge ? 1 : 0;
    ivec2 regions = regionCount();
    bool oneRow = uint(regions.x * regions.y) <= bankDispatchWidth; // its width counts: fewer atomic operations
    uint index = oneRow ? atomicAdd(dispatches[kind].x, 1u) : atomicAdd(dispatches[kind].count, 1u);
    tileEntries[regionList(kind) + int(index)] = uint(region.y * regions.x + region.x);
    if (!oneRow) {
        atomicMax(dispatches[kind].x, min(index + 1u, bankDispatchWidth));
        atomicMax(dispatches[kind].y, index / bankDispatchWidth + 1u);
    }
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    Block block = findBlock(int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x));
    if (block.first.y >= levelExtent(block.level).y) { // the grid's last row is not full
        return;
    }
    if (thread == 0) {
        rough = 0u;
    }
    barrier();
    if (block.level <= rawLevels) {
        loadBlock(block, thread);
    } else {
        loadCoarseBlock(block, thread);
    }
    barrier();
    int own = block.level == 1 ? 2 : 1; // texels, one below the other
    ivec2 local = ivec2(gl_LocalInvocationID.xy) * ivec2(1, own);
    if ((rough & anything) == 0u) { // no pixel will read these, but other texels of coarse levels lie near
        for (int i = 0; i < own && block.level > 1; ++i) {
            storeBlurred(block, local + ivec2(0, i), emptyBlurred);
        }
        return;
    }
    ivec2 size = loadedSize(block);
    if (thread < size.x * size.y / 4) {
        int row = thread / (size.x / 2);
        noteRoughness(roughnessBetween(block, 2 * ivec2(thread - row * (size.x / 2), row)));
    }
    barrier();
    int center = sharedIndex(local + block.reach);
    if (separateMaterials || rough != anything) {
        [[dont_unroll]] for (int i = 0; i < own; ++i) {
            blurRough(block, local + ivec2(0, i), center + i * pitch);
        }
    } else if (block.level > 1) {
        storeBlurred(block, local, blurPlain(block.level, center));
    } else {
        BlurredTexel upper;
        BlurredTexel lower;
        blurFinestPair(center, upper, lower);
        storeBlurred(block, local, upper);
        storeBlurred(block, local + ivec2(0, 1), lower);
    }
    if (thread < 2 && block.level == 1) {
        listRegion(block.first / side, thread);
    }
}
