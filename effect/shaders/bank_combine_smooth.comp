// Pass C of `bank` for regions without depth discontinuities: every pixel's mixture of the identity, the
// full-resolution 3x3 and the six blurred levels, with its material's weights. With HALF_FLOATS light is
// interpolated in half floats. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifdef HALF_FLOATS
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#endif
const bool isEdge = false;
#include "bank_combine.glsl"

// The full-resolution 3x3 of a quad on a slope: taps have its depths, which makes their weights separable, `beside` the
// middle in x and y. Rows are mixed in floats: fewer roundings.
void addSlopePixels(inout Sum sums[4], vec3 weight, ivec2 first, vec2 beside) {
    vec2 side = beside / (1.0 + 2.0 * beside);
    Light rows[4][2]; // the block's rows, filtered along x for the quad's two columns
    [[unroll]] for (int y = 0; y < 4; ++y) {
        Light row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = storedLight(pixelLights[pixelPlace(first + ivec2(x, y) - 1)]);
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            Light middle = row[x + 1];
            rows[y][x] = middle + Real(side.x) * (row[x] - middle) + Real(side.x) * (row[x + 2] - middle);
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        vec4 middle = vec4(rows[y + 1][x]);
        add(sums[i], weight,
            middle + side.y * (vec4(rows[y][x]) - middle) + side.y * (vec4(rows[y + 2][x]) - middle));
    }
}

// Level 1, whose texels are the quads: bilinear weights ¼ and ¾ of the 3x3 texels around.
void addFinestLevel(inout Sum sums[4], vec3 weight, ivec2 texel) {
    const Real quarter = Real(0.25);
    Light rows[3][2];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        int index = fineIndex(texel + ivec2(0, y - 1));
        Light middle = storedLight(levelLights[index]);
        rows[y][0] = middle + quarter * (storedLight(levelLights[index - 1]) - middle);
        rows[y][1] = middle + quarter * (storedLight(levelLights[index + 1]) - middle);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        vec4 middle = vec4(rows[1][i & 1]);
        add(sums[i], weight, mix(middle, vec4(rows[i >> 1 == 0 ? 0 : 2][i & 1]), 0.25));
    }
}

void main() {
    ivec2 region;
    if (!findRegion(0, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    if (thread == 0) {
        roughLevels = 0u;
    }
    barrier();
    Quad quad = loadRegion(region, thread, texel);
    barrier();
    uint ownMaterials[4] =
        uint[](quad.materials.x & 0xffffu, quad.materials.x >> 16, quad.materials.y & 0xffffu, quad.materials.y >> 16);
    ivec2 first = region + 2 * texel;
    uint left = 0u; // bits of the pixels that are still to be combined
    [[unroll]] for (int i = 0; i < 4; ++i) {
        left |= ownMaterials[i] != 0u ? 1u << i : 0u;
    }
    // One round for every material in the quad.
    while (left != 0u) {
        uint material = (left & 1u) != 0u   ? ownMaterials[0]
                        : (left & 2u) != 0u ? ownMaterials[1]
                        : (left & 4u) != 0u ? ownMaterials[2]
                                            : ownMaterials[3];
        bvec4 members;
        [[unroll]] for (int i = 0; i < 4; ++i) {
            members[i] = ownMaterials[i] == material;
            left &= members[i] ? ~(1u << i) : ~0u;
        }
        Mixture mixture = findMixture(material, quad.depth);
        Sum sums[4] = Sum[](noSum, noSum, noSum, noSum);
        addIdentity(sums, mixture, 2 * texel + 1);
        addSlopePixels(sums, kernelWeight(mixture, 1), 2 * texel + 1, quad.beside);
        addFinestLevel(sums, kernelWeight(mixture, 2), texel);
        addCoarseLevels(sums, mixture, region, first, quad.depth, vec4(0.0), material);
        storeGroup(first, 2 * texel + 1, members, material, mixture.strength, sums);
    }
    storeRest(first, ownMaterials);
}
