// Pass C of `bank` for regions with depth discontinuities, or where materials are separate: as the smooth pipeline, with
// depth weights tap by tap where surfaces meet. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
const bool isEdge = true;
#include "bank_combine.glsl"

// The quad's pixels that share a material and a surface, with the mixture taken at the first of them.
struct Group {
    ivec2 region; // px
    ivec2 quad;   // px
    ivec2 first;  // the quad, counted from the pixel up and left of the region's first
    vec4 depths;
    bvec4 members;
    uint material;
    float depth;
};

// Depth steps on the slope that the quad's four pixels make.
vec2 quadSlope(vec4 depths) {
    return 0.5 * vec2(depths.y - depths.x + depths.w - depths.z, depths.z - depths.x + depths.w - depths.y);
}

// Whether the block of 4x4 px around the quad is one slope.
bool isSlope(Group group, vec2 slope, float width) {
    bool result = all(group.members);
    [[unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 offset = ivec2(i & 3, i >> 2) - 1;
        int place = pixelPlace(group.first + offset);
        float expected = group.depths.x + dot(slope, vec2(offset));
        result = result && pixelLights[place].y > 0xffffu &&
                 abs(pixelDepths[place] - expected) <= bankSlopeTolerance * width;
    }
    return result;
}

// The full-resolution 3x3 of a pixel, tap by tap.
vec4 blurPixel(ivec2 center, uint material) {
    float depth = pixelDepths[pixelPlace(center)];
    float width = texelWidth(0, depth);
    float scale = 1.0 / (bankPixelDepthVariance * width * width);
    vec3 light = vec3(0.0);
    float area = 0.0;
    [[unroll]] for (int j = 0; j < 9; ++j) {
        ivec2 offset = ivec2(j % 3, j / 3) - 1;
        float kernel = (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
        int place = pixelPlace(center + offset);
        vec4 tap = unpackLight(pixelLights[place]);
        float difference = pixelDepths[place] - depth;
        float weight = kernel * falloff(difference * difference * scale);
        bool taken = tap.w > 0.0;
        if (separateMaterials) {
            taken = taken && exchanges(pixelMaterials[place], material);
        }
        weight = taken ? weight : 0.0;
        area += weight * pixelAreas[place];
        light += weight * pixelAreas[place] * tap.rgb;
    }
    float mass = massOf(area);
    return vec4(light * (mass / max(area, bankLeastWeight)), mass);
}

// The full-resolution 3x3.
void addPixels(inout Sum sums[4], vec3 weight, Group group) {
    float width = texelWidth(0, group.depth);
    vec2 slope = quadSlope(group.depths);
    if (!separateMaterials && isSlope(group, slope, width)) {
        addSlopePixels(sums, weight, group.first, weightsBeside(slope / width));
        return;
    }
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        if (group.members[i]) {
            add(sums[i], weight, blurPixel(group.first + ivec2(i & 1, i >> 1), group.material));
        }
    }
}

// The levels whose texels are hardly larger than a pixel: every pixel looks from its own depth.
void addFineLevels(inout Sum sums[4], Mixture mixture, Group group) {
    [[dont_unroll]] for (int level = 1; level <= ownDepthLevels; ++level) {
        vec3 weight = kernelWeight(mixture, level + 1);
        [[unroll]] for (int i = 0; i < 4; ++i) {
            Corner corner = levelCorner(level, group.region, group.quad + ivec2(i & 1, i >> 1));
            Tap taps[4] = cornerTaps(level, corner, group.depths[i], group.material);
            Tap upper = mixTaps(taps[0], taps[1], corner.fraction.x);
            Tap lower = mixTaps(taps[2], taps[3], corner.fraction.x);
            addTap(sums[i], weight, mixTaps(upper, lower, corner.fraction.y), 0.0, levelScale(level, group.depths[i]));
        }
    }
}

void combineGroup(Group group) {
    Mixture mixture = findMixture(group.material, group.depth);
    Sum sums[4] = Sum[](noSum, noSum, noSum, noSum);
    vec4 own[4] = addIdentity(sums, kernelWeight(mixture, 0), group.first);
    addPixels(sums, kernelWeight(mixture, 1), group);
    addFineLevels(sums, mixture, group);
    addCoarseLevels(sums, mixture, group.region, group.quad, group.depth, group.depths - group.depth, group.material);
    storeGroup(group.quad, group.members, group.material, mixture.strength, own, sums);
}

void main() {
    Group group;
    if (!findRegion(1, group.region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    if (thread == 0) {
        roughLevels = 0u;
    }
    barrier();
    Quad quad = loadRegion(group.region, thread, texel);
    barrier();
    group.quad = group.region + 2 * texel;
    group.first = 2 * texel + 1;
    uint ownMaterials[4];
    uint left = 0u; // bits of the pixels that are still to be combined
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        group.depths[i] = pixelDepths[pixelPlace(group.first + offset)];
        ownMaterials[i] = group.depths[i] > 0.0 ? pixelMaterial(quad.materials, offset) : 0u;
        left |= ownMaterials[i] != 0u ? 1u << i : 0u;
    }
    // One round for every material and surface in the quad.
    while (left != 0u) {
        int leader = findLSB(left);
        group.material = leader < 2 ? (leader == 0 ? ownMaterials[0] : ownMaterials[1])
                                    : (leader == 2 ? ownMaterials[2] : ownMaterials[3]);
        group.depth = leader < 2 ? (leader == 0 ? group.depths.x : group.depths.y)
                                 : (leader == 2 ? group.depths.z : group.depths.w);
        float separation = bankSurfaceSeparation * texelWidth(1, group.depth);
        [[unroll]] for (int i = 0; i < 4; ++i) {
            group.members[i] = (left >> i & 1u) != 0u && ownMaterials[i] == group.material &&
                               abs(group.depths[i] - group.depth) <= separation;
            left &= group.members[i] ? ~(1u << i) : ~0u;
        }
        combineGroup(group);
    }
    storeRest(group.quad, ownMaterials);
}
