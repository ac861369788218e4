// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: as the smooth pipeline, with
// depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank_combine.glsl"

const ivec2 pixelPitch = regionSize + 2; // with one pixel around
const int pixelCount = pixelPitch.x * pixelPitch.y;

// Per pixel: red and green; blue and the material (0 = receives nothing). Red is infinite where the pixel gives none.
shared uvec2 pixelLights[pixelCount];
shared float pixelDepths[pixelCount];
shared uvec2 levelSurfaces[levelTexelCount]; // as blurredSurfaces
const uint infiniteHalf = 0x7c00u;

// A pixel as a source and receiver of light.
struct Pixel {
    vec4 light; // w: 1 where it gives light, else all is 0
    float depth;
    uint material;
};

Pixel pixelAt(int index) {
    uvec2 words = pixelLights[index];
    bool gives = (words.x & 0xffffu) != infiniteHalf;
    vec4 light = vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x, 1.0);
    return Pixel(gives ? light : vec4(0.0), pixelDepths[index], words.y >> 16);
}

void loadPixel(int index, ivec2 region) {
    ivec2 local = region + ivec2(index % pixelPitch.x, index / pixelPitch.x) - 1;
    ivec2 inside = clamp(local, ivec2(0), view.areaExtent - 1);
    ivec2 pixel = inside + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    vec3 light = enteringLight(pixel, material);
    bool receives = local == inside && material != 0u && isValidZ(z);
    bool gives = receives && isFinite(light);
    light = min(light, vec3(maxHalf));
    uint blue = gives ? packHalf2x16(vec2(light.b, 0.0)) : 0u;
    pixelLights[index] =
        uvec2(gives ? packHalf2x16(light.rg) : infiniteHalf, receives ? blue | material << 16 : 0u);
    pixelDepths[index] = receives ? -z : 0.0;
}

void loadLevelTexel(int index, ivec2 region) {
    int level = 1;
    int place;
    if (index < fineCount) {
        place = globalIndex(1, levelFirst(1, region) + ivec2(index % finePitch, index / finePitch));
    } else {
        place = coarseIndex(index - fineCount, region, level);
    }
    uvec2 light = blurredLights[place];
    levelLights[index] = light;
    levelSurfaces[index] = blurredSurfaces[place];
    if ((light.y & signBit) != 0u) {
        atomicOr(roughLevels, 1u << level);
    }
}

void loadRegion(ivec2 region, int thread) {
    for (int i = thread; i < levelTexelCount; i += threads) {
        loadLevelTexel(i, region);
    }
    for (int i = thread; i < pixelCount; i += threads) {
        loadPixel(i, region);
    }
}

// The quad's pixels that share a material and a surface, with the mixture taken at the first of them.
struct Group {
    ivec2 region;
    ivec2 quad;   // px
    int first;    // in shared memory: the pixel up and left of the quad
    vec4 depths;
    bvec4 members;
    uint material;
    float depth;
};

// The block around the quad is one slope, on which all its pixels are to within this many pixel widths.
const float slopeTolerance = 0.3;

// Depth steps on the slope that the quad's four pixels make.
vec2 quadSlope(vec4 depths) {
    return 0.5 * vec2(depths.y - depths.x + depths.w - depths.z, depths.z - depths.x + depths.w - depths.y);
}

bool isSlope(Group group, vec2 slope, float width) {
    bool result = all(group.members);
    [[unroll]] for (int i = 0; i < 16; ++i) {
        int index = group.first + (i & 3) + (i >> 2) * pixelPitch.x;
        float expected = group.depths.x + dot(slope, vec2((i & 3) - 1, (i >> 2) - 1));
        result = result && (pixelLights[index].x & 0xffffu) != infiniteHalf &&
                 abs(pixelDepths[index] - expected) <= slopeTolerance * width;
    }
    return result;
}

// The full-resolution 3x3 on a slope: weights are separable, `beside` the middle.
void addSlopePixels(inout Sum sums[4], vec3 weight, Group group, vec2 slope, float width) {
    vec2 relative = slope / width;
    vec2 beside = 0.5 * vec2(falloff(relative.x * relative.x / bankPixelDepthVariance),
                             falloff(relative.y * relative.y / bankPixelDepthVariance));
    vec4 rows[4][2];
    [[unroll]] for (int y = 0; y < 4; ++y) {
        vec4 row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = pixelAt(group.first + x + y * pixelPitch.x).light;
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            rows[y][x] = row[x + 1] + beside.x * (row[x] + row[x + 2]);
        }
    }
    vec2 total = 1.0 + 2.0 * beside;
    weight /= total.x * total.y;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        add(sums[i], weight, rows[y + 1][x] + beside.y * (rows[y][x] + rows[y + 2][x]));
    }
}

// The full-resolution 3x3 of a pixel, tap by tap.
vec4 blurPixel(int center, const bool separate) {
    Pixel own = pixelAt(center);
    float width = texelWidth(0, own.depth);
    float scale = 1.0 / (bankPixelDepthVariance * width * width);
    vec4 light = vec4(0.0);
    float counted = 0.0;
    [[unroll]] for (int j = 0; j < 9; ++j) {
        ivec2 offset = ivec2(j % 3, j / 3) - 1;
        float kernel = (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
        Pixel tap = pixelAt(center + offset.x + offset.y * pixelPitch.x);
        float difference = tap.depth - own.depth;
        float weight = kernel * falloff(difference * difference * scale);
        bool taken = tap.light.w > 0.0 && (!separate || exchanges(tap.material, own.material));
        counted += taken ? countedWeight(kernel, weight, difference, width) : kernel;
        light += taken ? weight * tap.light : vec4(0.0);
    }
    return light / counted;
}

void addPixels(inout Sum sums[4], Mixture mixture, Group group, const bool separate) {
    vec3 identityWeight = kernelWeight(mixture, 0);
    vec3 pixelsWeight = kernelWeight(mixture, 1);
    float width = texelWidth(0, group.depth);
    vec2 slope = quadSlope(group.depths);
    if (!separate && isSlope(group, slope, width)) {
        addSlopePixels(sums, pixelsWeight, group, slope, width);
    } else {
        [[dont_unroll]] for (int i = 0; i < 4; ++i) {
            if (group.members[i]) {
                add(sums[i], pixelsWeight,
                    blurPixel(group.first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x, separate));
            }
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        add(sums[i], identityWeight, pixelAt(group.first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x).light);
    }
}

Tap loadTap(int index, float depth, float scale, uint material, const bool separate) {
    uvec2 surface = levelSurfaces[index];
    return weightedTap(levelLights[index], surface, depth, scale,
                       !separate || exchanges(surface.y & 0xffffu, material));
}

// Level 1, whose texels are the quads: bilinear weights ¼ and ¾ of the 3x3 texels around.
void addFinestLevel(inout Sum sums[4], vec3 weight, Group group, const bool separate) {
    float scale = levelScale(1, group.depth);
    ivec2 texel = (group.quad - group.region) / 2;
    Tap rows[3][2];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        int index = fineIndex(texel + ivec2(0, y - 1));
        Tap left = loadTap(index - 1, group.depth, scale, group.material, separate);
        Tap middle = loadTap(index, group.depth, scale, group.material, separate);
        Tap right = loadTap(index + 1, group.depth, scale, group.material, separate);
        rows[y][0] = mixTaps(middle, left, 0.25);
        rows[y][1] = mixTaps(middle, right, 0.25);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        Tap tap = mixTaps(rows[1][i & 1], rows[i >> 1 == 0 ? 0 : 2][i & 1], 0.25);
        addTap(sums[i], weight, tap, scale);
    }
}

// A coarser level: the quad's pixels lie between the same four texels, whose depth weights they share.
void addLevel(inout Sum sums[4], vec3 weight, int level, Group group, const bool separate) {
    Corner corner = levelCorner(level, group.region, group.quad);
    if ((roughLevels >> level & 1u) == 0u && !separate) {
        addPlainLevel(sums, weight, level, corner);
        return;
    }
    float scale = levelScale(level, group.depth);
    float step = 1.0 / float(1 << level);
    int below = corner.index + levelPitch[level].x;
    Tap upperLeft = loadTap(corner.index, group.depth, scale, group.material, separate);
    Tap upperRight = loadTap(corner.index + 1, group.depth, scale, group.material, separate);
    Tap lowerLeft = loadTap(below, group.depth, scale, group.material, separate);
    Tap lowerRight = loadTap(below + 1, group.depth, scale, group.material, separate);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        addTaps(sums[i], weight, upperLeft, upperRight, lowerLeft, lowerRight,
                corner.fraction + vec2(i & 1, i >> 1) * step, scale);
    }
}

void combineGroup(Group group, const bool separate, inout vec3 results[4]) {
    Mixture mixture = findMixture(group.material, group.depth);
    Sum sums[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        sums[i] = Sum(vec3(0.0), vec3(0.0));
    }
    addPixels(sums, mixture, group, separate);
    addFinestLevel(sums, kernelWeight(mixture, 2), group, separate);
    [[unroll]] for (int level = 2; level <= bankLevels; ++level) {
        vec3 weight = kernelWeight(mixture, level + 1);
        if (weight != vec3(0.0)) {
            addLevel(sums, weight, level, group, separate);
        }
    }
    float strength = materials[group.material].strength;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (group.members[i]) {
            vec4 own = pixelAt(group.first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x).light;
            ivec2 pixel = group.quad + ivec2(i & 1, i >> 1) + view.areaOffset;
            float pixelStrength = own.w > 0.0 ? strength * strengthAt(pixel) : 1.0;
            results[i] = mix(own.rgb, sums[i].light / max(sums[i].mass, vec3(1e-20)), pixelStrength);
        }
    }
}

void combineQuad(ivec2 region, ivec2 quad, int first, const bool separate) {
    Group group;
    group.region = region;
    group.quad = quad;
    group.first = first;
    uint quadMaterials[4];
    vec3 results[4] = vec3[](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    uint left = 0u; // bits of the pixels that are still to be combined
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int index = first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x;
        quadMaterials[i] = pixelLights[index].y >> 16;
        group.depths[i] = pixelDepths[index];
        left |= quadMaterials[i] != 0u ? 1u << i : 0u;
    }
    // One round for every material and surface in the quad.
    while (left != 0u) {
        int leader = findLSB(left);
        group.material = leader == 0 ? quadMaterials[0]
                         : leader == 1 ? quadMaterials[1]
                         : leader == 2 ? quadMaterials[2]
                                       : quadMaterials[3];
        group.depth = leader == 0 ? group.depths.x
                      : leader == 1 ? group.depths.y
                      : leader == 2 ? group.depths.z
                                    : group.depths.w;
        float separation = bankSurfaceSeparation * texelWidth(1, group.depth);
        [[unroll]] for (int i = 0; i < 4; ++i) {
            group.members[i] = (left >> i & 1u) != 0u && quadMaterials[i] == group.material &&
                               abs(group.depths[i] - group.depth) <= separation;
            left &= group.members[i] ? ~(1u << i) : ~0u;
        }
        combineGroup(group, separate, results);
    }
    storeQuad(quad, quadMaterials, results);
}

void main() {
    ivec2 region;
    if (!findRegion(1, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    if (thread == 0) {
        roughLevels = 0u;
    }
    barrier();
    loadRegion(region, thread);
    barrier();
    ivec2 inRegion = 2 * ivec2(gl_LocalInvocationID.xy);
    int first = inRegion.y * pixelPitch.x + inRegion.x;
    if (hasFlag(flagSeparateMaterials)) {
        combineQuad(region, region + inRegion, first, true);
    } else {
        combineQuad(region, region + inRegion, first, false);
    }
}
