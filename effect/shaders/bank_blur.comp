// Pass B of `bank`: blurs every level with a 5x5 binomial along the surface, 16x16 texels a workgroup, all levels in
// one dispatch, coarsest first (the few coarse workgroups would else be a serial tail); lists the tiles that hold
// subsurface pixels for pass C. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

const int side = 16;
const int halo = 2;
const int pitch = side + 2 * halo;
const float binomial[5] = float[](1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0);

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
        return packRaw(rawTexel(level, texel));
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

// Whether two neighbouring texels of level 1 are further apart in depth than a smooth surface's.
bool isStep(RawTexel a, int neighbor) {
    RawTexel b = unpackRaw(texels[neighbor]);
    return b.mass > 0.0 && abs(b.depth - a.depth) > bankSmoothDepth * texelWidth(1, a.depth);
}

bool isRough(int index) {
    RawTexel texel = unpackRaw(texels[index]);
    if (texel.mass <= 0.0) {
        return false;
    }
    bool stepRight = index % pitch + 1 < pitch && isStep(texel, index + 1);
    bool stepBelow = index / pitch + 1 < pitch && isStep(texel, index + pitch);
    return texel.dropped || stepRight || stepBelow;
}

// Depth and material an empty texel takes from the texels around it, so that light reaches across small holes.
BlurredTexel borrow(int center) {
    BlurredTexel result = BlurredTexel(vec3(0.0), 0.0, 0.0, 0u, false);
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
    return result;
}

BlurredTexel blurTexel(int level, int center) {
    RawTexel own = unpackRaw(texels[center]);
    BlurredTexel result = borrow(center);
    if (own.mass > 0.0) {
        result.depth = own.depth;
        result.material = own.material;
    }
    if (!result.present) {
        return result;
    }
    float width = texelWidth(level, result.depth);
    float scale = 1.0 / (bankBlurDepthVariance * width * width);
    vec3 light = vec3(0.0);
    float area = 0.0;
    float mass = 0.0;
    float counted = 0.0;
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
            float kernel = binomial[x] * binomial[y];
            RawTexel tap = unpackRaw(texels[center + x - halo + (y - halo) * pitch]);
            float difference = tap.depth - result.depth;
            float weight = kernel * falloff(difference * difference * scale);
            bool taken = tap.mass > 0.0 && givesLight(tap.material, result.material);
            counted += taken ? countedWeight(kernel, weight, difference, width) : kernel;
            weight = taken ? weight : 0.0;
            light += weight * tap.area * tap.light;
            area += weight * tap.area;
            mass += weight * tap.mass;
        }
    }
    result.mass = mass / max(counted, bankLeastWeight);
    result.light = light * (result.mass / max(area, bankLeastWeight));
    return result;
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
    for (int i = thread; i < pitch * pitch; i += side * side) {
        texels[i] = loadTexel(block.level, block.first + ivec2(i % pitch, i / pitch) - halo);
    }
    barrier();
    if (block.level == 1) {
        for (int i = thread; i < pitch * pitch; i += side * side) {
            if (isRough(i)) {
                atomicOr(rough, 1u);
            }
        }
    }
    ivec2 local = ivec2(gl_LocalInvocationID.xy);
    ivec2 texel = block.first + local;
    if (all(lessThan(texel, levelExtent(block.level)))) {
        int center = (local.y + halo) * pitch + local.x + halo;
        blurredTexels[texelIndex(block.level, texel)] = packBlurred(blurTexel(block.level, center));
    }
    barrier();
    if (thread == 0 && block.level == 1 && isOccupied(tile)) {
        listTile(tile, rough);
    }
}
