// The texels of the bank's pyramid, packed as bank_texel.glsl says.

const signBit: u32 = 0x80000000u;
const areasBit: u32 = signBit;      // of word y
const spreadBit: u32 = signBit;     // of word z
const coverageBits: u32 = 0x3fffu;  // of word w, as what follows
const fullCoverage: u32 = 0x3c00u;  // the half float 1
const droppedBit: u32 = 0x8000u;    // levels 2 to 6
const mixedBit: u32 = 0x8000u;      // level 1
const steppedBit: u32 = signBit;    // of a blurred texel's word y

// A texel of the reduced pyramid.
struct ReducedTexel {
    light: vec3f,  // irradiance · area, mean over the texel's pixels
    area: f32,     // surface per pixel, relative to one that faces the camera, mean over the texel's pixels
    coverage: f32, // [0, 1] share of the texel's pixels that are on the surface; 0 = empty
    depth: f32,    // mm along the ray
    material: u32, // one of the surface's
    dropped: bool, // pixels of another surface were left out, here or further down
}

// A texel of the blurred pyramid.
struct BlurredTexel {
    light: vec3f,  // mean irradiance · coverage
    coverage: f32, // [0, 1] share of the kernel that is on the surface
    depth: f32,
    material: u32,
    present: bool, // whether there is a surface near
    stepped: bool, // whether a neighbour is on another surface, or on this one's steep side
}

// Where pixels make a step, the texel of level 1 stands for depths that vary, as a Gaussian.
struct DepthSpread {
    closeness: f32,  // (0, 1] v / (v + the depths' variance), with a depth weight's variance v
    lightSlope: f32, // covariance of light and depth / (v + the depths' variance) / light
}

const mostLightSlope: f32 = 0.875;

fn unpackFour(words: vec2u) -> vec4f {
    return vec4f(unpack2x16float(words.x), unpack2x16float(words.y));
}

fn packFour(value: vec4f) -> vec2u {
    return vec2u(pack2x16float(value.xy), pack2x16float(value.zw));
}

fn materialOf(word: u32) -> u32 {
    return word >> 16u;
}

// Of a level from 2 on: whether pixels were left out, whether there is a surface, and whether it is all that there is.
fn isDropped(word: u32) -> bool {
    return (word & droppedBit) != 0u;
}

fn isCovered(word: u32) -> bool {
    return (word & coverageBits) != 0u;
}

fn isFullyCovered(word: u32) -> bool {
    return (word & 0xffffu) == fullCoverage;
}

// A texel of any level, as one of the levels from 2 on.
fn packReduced(texel: ReducedTexel) -> vec4u {
    let coverage = pack2x16float(vec2f(select(texel.coverage, -texel.coverage, texel.dropped), 0.0));
    let light = texel.light / max(texel.area, bankLeastWeight);
    return vec4u(packFour(vec4f(light, texel.area)), bitcast<u32>(texel.depth),
                 coverage | select(0u, texel.material << 16u, separateMaterials));
}

fn unpackReduced(words: vec4u) -> ReducedTexel {
    let lightAndArea = unpackFour(words.xy);
    let coverage = unpack2x16float(words.w).x;
    return ReducedTexel(lightAndArea.rgb * lightAndArea.a, lightAndArea.a, abs(coverage), bitcast<f32>(words.z),
                        materialOf(words.w), coverage < 0.0);
}

fn packBlurred(texel: BlurredTexel) -> vec2u {
    if (!texel.present) {
        return vec2u(0u, steppedBit);
    }
    return packFour(vec4f(texel.light, texel.coverage)) | vec2u(0u, select(0u, steppedBit, texel.stepped));
}

// Material ids of a quad's four pixels, 16 bits each.
fn isMixed(quad: u32) -> bool {
    return (quad & mixedBit) != 0u;
}

// The material of one of a quad's pixels, which is at an even or odd place in x and y.
fn pixelMaterial(quadsMaterials: vec2u, local: vec2i) -> u32 {
    let words = select(quadsMaterials.y, quadsMaterials.x, (local.y & 1) == 0);
    return select(words >> 16u, words & 0xffffu, (local.x & 1) == 0);
}

// The weights beside the middle of the full-resolution 3x3, in [0, 1/2].
fn packWeights(beside: vec2f) -> u32 {
    let weights = vec2u(254.0 * beside + 0.5);
    return weights.x | (weights.y << 7u);
}

// From the last word of a texel of level 1.
fn weightsOf(quad: u32) -> vec2f {
    return vec2f(vec2u(quad, quad >> 7u) & vec2u(127u)) / 254.0;
}

fn packSpread(spread: DepthSpread) -> u32 {
    let slope = u32(clamp(64.5 + (63.0 / mostLightSlope) * spread.lightSlope, 1.0, 127.0));
    return u32(127.0 * spread.closeness + 0.5) | (slope << 7u);
}

// From the last two words of a texel of level 1.
fn spreadOf(words: vec2u) -> DepthSpread {
    if ((words.x & spreadBit) == 0u) {
        return DepthSpread(1.0, 0.0);
    }
    return DepthSpread(f32(words.y & 127u) / 127.0,
                       (f32((words.y >> 7u) & 127u) - 64.0) * (mostLightSlope / 63.0));
}

// Areas in [1, bankLargestArea), each to within one percent: two bits of a float's exponent and six of its mantissa.
fn packAreas(areas: vec4f) -> u32 {
    const one = 0x3f800000u;
    const rounding = 1u << 16u;
    let codes = min((bitcast<vec4u>(areas) - vec4u(one - rounding)) >> vec4u(17u), vec4u(255u));
    return codes.x | (codes.y << 8u) | (codes.z << 16u) | (codes.w << 24u);
}

fn unpackArea(areas: u32, i: u32) -> f32 {
    const one = 0x3f800000u;
    return bitcast<f32>(one + (((areas >> (8u * i)) & 255u) << 17u));
}
