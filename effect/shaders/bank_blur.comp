// Pass B of `bank`: blurs every level with a 5x5 binomial along the surface, 16x16 texels a workgroup, two a thread, all
// levels in one dispatch, coarsest first (the few coarse workgroups would else be a serial tail); lists the tiles that hold
// subsurface pixels for pass C. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

const int threads = 128;
const int side = 16;
const int halo = 2;
const int pitch = side + 2 * halo;
// The five weights, and a 0 on either side for the rows that only one of a pair of texels reads.
const float binomial[7] = float[](0.0, 1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0, 0.0);

shared uvec4 texels[pitch * pitch];
shared uint occupiedNear;
shared uint rough;

struct Block {
    int level; // 0 = none
    ivec2 first; // texel
};

// The levels' blocks of 16x16 texels, counted from the coarsest level on.
Block findBlock(uint group) {
    int index = int(group);
    for (int level = bankLevels; level >= 1; --level) {
        ivec2 blocks = (levelExtent(level) + side - 1) / side;
        if (index < blocks.x * blocks.y) {
            return Block(level, ivec2(index % blocks.x, index / blocks.x) * side);
        }
        index -= blocks.x * blocks.y;
    }
    return Block(0, ivec2(0));
}

// Level 6 is reduced here, from the level pass A ends with.
uvec4 loadTexel(int level, ivec2 texel) {
    if (level <= rawLevels) {
        bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, levelExtent(level)));
        return inside ? rawTexels[texelIndex(level, texel)] : uvec4(0u);
    }
    RawTexel children[4];
    for (int i = 0; i < 4; ++i) {
        children[i] = rawTexel(rawLevels, 2 * texel + ivec2(i & 1, i >> 1));
    }
    return packRaw(reduceTexels(children, chooseSurface(children, level)));
}

bool isOccupied(ivec2 tile) {
    bool inside = all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(tile, tileCount()));
    return inside && tileEntries[tile.y * tileCount().x + tile.x] != 0u;
}

// Whether the texel at `neighbor` is a surface further from `depth` than a smooth one's neighbour would be.
bool isStep(int neighbor, float depth, float limit) {
    RawTexel tap = unpackRaw(texels[neighbor]);
    return tap.mass > 0.0 && abs(tap.depth - depth) > limit;
}

// Whether level 1 is rough at a texel, with which a tile's pixels cannot be combined as smooth ones.
bool isRough(int index) {
    RawTexel texel = unpackRaw(texels[index]);
    if (texel.mass <= 0.0) {
        return false;
    }
    float limit = bankSmoothDepth * texelWidth(1, texel.depth);
    bool stepRight = index % pitch + 1 < pitch && isStep(index + 1, texel.depth, limit);
    bool stepBelow = index / pitch + 1 < pitch && isStep(index + pitch, texel.depth, limit);
    return texel.dropped || stepRight || stepBelow;
}

// Where a texel's kernel stands: its own surface or, where it is empty, its neighbours', so that light reaches across
// small holes.
BlurredTexel findSurface(int level, int center) {
    RawTexel own = unpackRaw(texels[center]);
    BlurredTexel result = BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, own.mass > 0.0, own.dropped);
    if (!result.present) {
        float mass = 0.0;
        float heaviest = 0.0;
        for (int i = 0; i < 9; ++i) {
            RawTexel tap = unpackRaw(texels[center + i % 3 - 1 + (i / 3 - 1) * pitch]);
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
    float mass;
    float counted; // what the weights would sum to if nothing were missing
};

void addTap(inout Sums sums, RawTexel tap, BlurredTexel surface, float kernel, float width) {
    float difference = tap.depth - surface.depth;
    float weight = kernel * falloff(difference * difference / (bankBlurDepthVariance * width * width));
    bool taken = tap.mass > 0.0 && givesLight(tap.material, surface.material);
    sums.counted += taken ? countedWeight(kernel, weight, difference, width) : kernel;
    weight = taken ? weight : 0.0;
    sums.light += weight * tap.area * tap.light;
    sums.area += weight * tap.area;
    sums.mass += weight * tap.mass;
}

// Blurs a texel and the one below it, which have four of five rows of taps in common.
void blurPair(int level, int center, out BlurredTexel upper, out BlurredTexel lower) {
    upper = findSurface(level, center);
    lower = findSurface(level, center + pitch);
    float upperWidth = texelWidth(level, upper.depth);
    float lowerWidth = texelWidth(level, lower.depth);
    Sums upperSums = Sums(vec3(0.0), 0.0, 0.0, 0.0);
    Sums lowerSums = upperSums;
    [[dont_unroll]] for (int y = 0; y < 6; ++y) {
        float upperRow = binomial[y + 1];
        float lowerRow = binomial[y];
        [[unroll]] for (int x = 0; x < 5; ++x) {
            RawTexel tap = unpackRaw(texels[center + x - halo + (y - halo) * pitch]);
            addTap(upperSums, tap, upper, binomial[x + 1] * upperRow, upperWidth);
            addTap(lowerSums, tap, lower, binomial[x + 1] * lowerRow, lowerWidth);
        }
    }
    upper.mass = upperSums.mass / max(upperSums.counted, bankLeastWeight);
    upper.light = upperSums.light * (upper.mass / max(upperSums.area, bankLeastWeight));
    lower.mass = lowerSums.mass / max(lowerSums.counted, bankLeastWeight);
    lower.light = lowerSums.light * (lower.mass / max(lowerSums.area, bankLeastWeight));
}

void storeBlurred(int level, ivec2 texel, BlurredTexel blurred) {
    if (all(lessThan(texel, levelExtent(level)))) {
        blurredTexels[texelIndex(level, texel)] = blurred.present ? packBlurred(blurred) : uvec4(0u);
    }
}

// Puts a tile on the list of the pipeline that combines it, and makes that pipeline's dispatch cover the list.
void listTile(ivec2 tile, uint kind) {
    ivec2 tiles = tileCount();
    uint index = atomicAdd(dispatches[kind].count, 1u);
    tileEntries[tiles.x * tiles.y * (1 + int(kind)) + int(index)] = uint(tile.y * tiles.x + tile.x);
    atomicMax(dispatches[kind].x, min(index + 1u, bankDispatchWidth));
    atomicMax(dispatches[kind].y, index / bankDispatchWidth + 1u);
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    Block block = findBlock(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    ivec2 tile = block.first / side; // of level 1
    if (thread == 0) {
        occupiedNear = 0u;
        rough = 0u;
    }
    barrier();
    if (block.level == 1 && thread < 9 && isOccupied(tile + ivec2(thread % 3 - 1, thread / 3 - 1))) {
        atomicOr(occupiedNear, 1u);
    }
    barrier();
    // No pixel will read the texels of a block that has only empty tiles around it.
    if (block.level == 0 || (block.level == 1 && occupiedNear == 0u)) {
        return;
    }
    for (int i = thread; i < pitch * pitch; i += threads) {
        texels[i] = loadTexel(block.level, block.first + ivec2(i % pitch, i / pitch) - halo);
    }
    barrier();
    if (block.level == 1) {
        for (int i = thread; i < pitch * pitch; i += threads) {
            if (isRough(i)) {
                atomicOr(rough, 1u);
            }
        }
    }
    ivec2 local = ivec2(gl_LocalInvocationID.xy) * ivec2(1, 2);
    BlurredTexel upper;
    BlurredTexel lower;
    blurPair(block.level, (local.y + halo) * pitch + local.x + halo, upper, lower);
    storeBlurred(block.level, block.first + local, upper);
    storeBlurred(block.level, block.first + local + ivec2(0, 1), lower);
    barrier();
    if (thread == 0 && block.level == 1 && isOccupied(tile)) {
        // Pixels that ask for materials are combined tap by tap.
        listTile(tile, hasFlag(flagSeparateMaterials) ? 1u : rough);
    }
}
