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

// Two neighbouring pixels of a row, light times area and area.
struct Pair {
    vec4 left;
    vec4 right;
};

// Fourth roots of ½ and ¼, the weights along an axis of the middle of the full-resolution 3x3 and of what is beside it.
const float middleRoot = 0.84089642;
const float besideRoot = 0.70710678;

void addTap(inout vec4 sum, vec4 lightAndArea, float depth, float ownDepth, float root, float scale) {
    float difference = depth - ownDepth;
    float base = max(0.0, root - difference * difference * (root * scale));
    base *= base;
    sum += base * base * lightAndArea;
}

// The full-resolution 3x3 of two neighbouring pixels, not yet divided: of `row` of the quad.
Pair blurPair(Group group, int row, vec2 ownDepths, float scale) {
    Pair sums = Pair(vec4(0.0), vec4(0.0));
    [[dont_unroll]] for (int y = -1; y <= 1; ++y) {
        float rootY = y == 0 ? middleRoot : besideRoot;
        [[unroll]] for (int x = -1; x <= 2; ++x) {
            int place = pixelPlace(group.first + ivec2(x, row + y));
            vec4 light = unpackLight(pixelLights[place]);
            bool taken = light.w > 0.0;
            if (separateMaterials) {
                taken = taken && exchanges(pixelMaterials[place], group.material);
            }
            float depth = taken ? pixelDepths[place] : 1e30;
            float area = pixelAreas[place];
            vec4 lightAndArea = vec4(light.rgb * area, area);
            if (x <= 1) {
                addTap(sums.left, lightAndArea, depth, ownDepths.x, rootY * (x == 0 ? middleRoot : besideRoot), scale);
            }
            if (x >= 0) {
                addTap(sums.right, lightAndArea, depth, ownDepths.y, rootY * (x == 1 ? middleRoot : besideRoot), scale);
            }
        }
    }
    return sums;
}

void addBlurred(inout Sum sum, vec3 weight, vec4 lightAndArea) {
    float mass = massOf(lightAndArea.w);
    add(sum, weight, vec4(lightAndArea.rgb * (mass / max(lightAndArea.w, bankLeastWeight)), mass));
}

// The full-resolution 3x3.
void addPixels(inout Sum sums[4], vec3 weight, Group group) {
    float width = texelWidth(0, group.depth);
    float scale = 0.25 / (bankPixelDepthVariance * width * width);
    const Pair none = Pair(vec4(0.0), vec4(0.0));
    Pair upper = none;
    Pair lower = none;
    [[dont_unroll]] for (int row = 0; row < 2; ++row) {
        upper = lower;
        lower = blurPair(group, row, row == 0 ? group.depths.xy : group.depths.zw, scale);
    }
    addBlurred(sums[0], weight, upper.left);
    addBlurred(sums[1], weight, upper.right);
    addBlurred(sums[2], weight, lower.left);
    addBlurred(sums[3], weight, lower.right);
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
    addIdentity(sums, mixture, group.first);
    addPixels(sums, kernelWeight(mixture, 1), group);
    addFineLevels(sums, mixture, group);
    addCoarseLevels(sums, mixture, group.region, group.quad, group.depth, group.depths - group.depth, group.material);
    storeGroup(group.quad, group.first, group.members, group.material, mixture.strength, sums);
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
