// The texels of the bank's pyramid, and how they are packed. Included by bank.glsl, for all passes. Uses bankLeastWeight
// (bank_constants.h), separateMaterials and quadMaterials (bank.glsl).
//
// reducedTexels and secondTexels, four words a texel. A word of 0 in z, and from level 2 on in w, is an empty texel's.
//
//   word  bits      levels 2 to 6                              level 1, whose texels are quads of 2x2 px
//   ----  --------  -----------------------------------------  ---------------------------------------------------
//   x      0 … 15   red, mean irradiance of the surface        the same
//         16 … 31   green                                      the same
//   y      0 … 15   blue                                       the same
//         16 … 30   area of the surface                        the same
//         31        0                                          areasBit: the pixels' areas are in quadAreas; else all
//                                                              four have this one
//   z      0 … 30   depth, mm along the ray                    the same
//         31        0                                          spreadBit: w has a DepthSpread in place of weights
//   w      0 …  6   coverage, of whose half float the sign     weight beside the middle of the 3x3 in x, or closeness
//          7 … 13   and the next bit are 0: it is below 2      the same in y, or lightSlope
//         14        secondBit: the texel has a second surface  the same
//         15        droppedBit: pixels were left out           mixedBit: the pixels' materials are in quadMaterials
//         16 … 31   where materials are separate: material     material of all four or, where they differ, the texel's
//
// Red, green, blue, area and coverage are half floats. Depth is a float. The other numbers of seven bits are in packWeights
// and packSpread.
//
// blurredLights, two words a texel of the levels from 2 on: light times coverage, and coverage, four half floats. The last
// one's sign, steppedBit, is set where the surface does not go on around the texel, or is not there: bilinear weights will not
// do.
//
// borrowedSurfaces, beside them: depth, a float, and material of the surface that an empty texel's kernel stands on.

const uint signBit = 0x80000000u;
const uint areasBit = signBit;   // of word y
const uint spreadBit = signBit;  // of word z
const uint coverageBits = 0x3fffu; // of word w, as what follows
const uint fullCoverage = 0x3c00u; // the half float 1
const uint secondBit = 0x4000u;
const uint droppedBit = 0x8000u; // levels 2 to 6
const uint mixedBit = 0x8000u;   // level 1
const uint steppedBit = signBit; // of a blurred texel's word y

// A texel of the reduced pyramid.
struct ReducedTexel {
    vec3 light;     // irradiance · area, mean over the texel's pixels
    float area;     // surface per pixel, relative to one that faces the camera, mean over the texel's pixels
    float coverage; // [0, 1] share of the texel's pixels that are on the surface; 0 = empty
    float depth;    // mm along the ray
    uint material;  // one of the surface's
    bool dropped;   // pixels of another surface were left out, here or further down
};

// A texel of the blurred pyramid.
struct BlurredTexel {
    vec3 light;     // mean irradiance · coverage
    float coverage; // [0, 1] share of the kernel that is on the surface
    float depth;
    uint material;
    bool present; // whether there is a surface near
    bool stepped; // whether a neighbour is on another surface, or on this one's steep side
};

// Where pixels make a step, the texel of level 1 stands for depths that vary, as a Gaussian. With a depth weight's variance v,
// both in texel widths squared:
struct DepthSpread {
    float closeness;  // (0, 1] v / (v + the depths' variance); squared distances to the texel count by so much
    float lightSlope; // covariance of light and depth / (v + the depths' variance) / light: its change per width of depth
};

const DepthSpread noSpread = DepthSpread(1.0, 0.0);
// The slope is less than √3 / 2 where pixels are no further apart than bankSurfaceSeparation.
const float mostLightSlope = 0.875;

ReducedTexel emptyTexel() {
    return ReducedTexel(vec3(0.0), 0.0, 0.0, 0.0, 0u, false);
}

// Of a reduced texel's words.
float depthOf(uvec4 words) {
    return uintBitsToFloat(words.z);
}

// Of its last one.
bool hasSecond(uint word) {
    return (word & secondBit) != 0u;
}

bool isMixed(uint quad) {
    return (quad & mixedBit) != 0u;
}

uint materialOf(uint word) {
    return word >> 16;
}

// Of a level from 2 on: whether pixels were left out, whether there is a surface, and whether it is all that there is.
bool isDropped(uint word) {
    return (word & droppedBit) != 0u;
}

bool isCovered(uint word) {
    return (word & coverageBits) != 0u;
}

bool isFullyCovered(uint word) {
    return (word & 0xffffu) == fullCoverage; // with nothing left out, and no second surface
}

// A texel of any level, as one of the levels from 2 on.
uvec4 packReduced(ReducedTexel texel) {
    uint coverage = packHalf2x16(vec2(texel.dropped ? -texel.coverage : texel.coverage, 0.0));
    vec3 light = texel.light / max(texel.area, bankLeastWeight);
    return uvec4(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, texel.area)),
                 floatBitsToUint(texel.depth), coverage | (separateMaterials ? texel.material << 16 : 0u));
}

ReducedTexel unpackReduced(uvec4 words) {
    vec2 redGreen = unpackHalf2x16(words.x);
    vec2 blueArea = unpackHalf2x16(words.y);
    float coverage = unpackHalf2x16(words.w & ~secondBit).x;
    return ReducedTexel(vec3(redGreen, blueArea.x) * blueArea.y, blueArea.y, abs(coverage), depthOf(words), materialOf(words.w),
                        coverage < 0.0);
}

uvec2 packBlurred(BlurredTexel texel) {
    uint sign = texel.present && !texel.stepped ? 0u : steppedBit;
    return uvec2(packHalf2x16(texel.light.rg), packHalf2x16(vec2(texel.light.b, texel.coverage)) | sign);
}

// The last word of a texel of level 1, from its bits 0 … 13.
uint packQuad(uint weights, uvec2 materials, uint texelMaterial) {
    bool mixed = materials != uvec2((materials.x & 0xffffu) * 0x10001u);
    return weights | (mixed ? mixedBit | texelMaterial << 16 : materials.x << 16);
}

// Of the four pixels of level 1's texel at `index`, whose last word is `quad`; 16 bits each.
uvec2 materialsOf(uint quad, int index) {
    return isMixed(quad) ? quadMaterials[index] : uvec2(materialOf(quad) * 0x10001u);
}

// The material of one of a quad's pixels, which is at an even or odd place in x and y.
uint pixelMaterial(uvec2 materials, ivec2 local) {
    uint words = (local.y & 1) == 0 ? materials.x : materials.y;
    return (local.x & 1) == 0 ? words & 0xffffu : words >> 16;
}

// The weights beside the middle of the full-resolution 3x3, in [0, 1/2].
uint packWeights(vec2 beside) {
    uvec2 weights = uvec2(254.0 * beside + 0.5);
    return weights.x | weights.y << 7;
}

// From the last word of a texel of level 1.
vec2 weightsOf(uint quad) {
    return vec2(quad & 127u, quad >> 7 & 127u) / 254.0;
}

uint packSpread(DepthSpread spread) {
    uint slope = uint(clamp(64.5 + (63.0 / mostLightSlope) * spread.lightSlope, 1.0, 127.0));
    return uint(127.0 * spread.closeness + 0.5) | slope << 7;
}

// From the last two words of a texel of level 1.
DepthSpread spreadOf(uvec2 words) {
    if ((words.x & spreadBit) == 0u) {
        return noSpread;
    }
    return DepthSpread(float(words.y & 127u) / 127.0, (float(words.y >> 7 & 127u) - 64.0) * (mostLightSlope / 63.0));
}

// Areas in [1, bankLargestArea), each to within one percent: two bits of a float's exponent and six of its mantissa.
//
//   float   0 | 0111 1111 | 000000 00000000000000000    1, from which the code counts
//   code            2 bits   6 bits                     bits 17 … 24 of the float, less those of 1
uint packAreas(vec4 areas) {
    const uint one = 0x3f800000u;
    const uint rounding = 1u << 16; // of the code's last bit, to round
    uvec4 codes = min((floatBitsToUint(areas) - (one - rounding)) >> 17, uvec4(255u));
    return codes.x | codes.y << 8 | codes.z << 16 | codes.w << 24;
}

float unpackArea(uint areas, int i) {
    const uint one = 0x3f800000u;
    return uintBitsToFloat(one + ((areas >> 8 * i & 255u) << 17));
}
