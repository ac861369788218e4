// Pass C of `bank`: every pixel's mixture of the identity, the full-resolution 3x3 and the six blurred levels, with its
// material's weights. 32x16 px a workgroup, two workgroups a tile, a 2x2 quad a thread. Compiled twice: SMOOTH for
// tiles without depth discontinuities, else for the others. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    uint bankTables[]; // bankTableWords a material: the bin offset, unused, then 24 halves a bin
};

const int threads = 128;
const ivec2 regionSize = ivec2(32, 16); // px
const ivec2 pixelPitch = regionSize + 2; // with one pixel around
const int pixelCount = pixelPitch.x * pixelPitch.y;
// The texels of level l that the region's pixels read: from one before its first on, at most this many.
const ivec2 levelPitch[bankLevels + 1] = ivec2[](ivec2(0), ivec2(18, 10), ivec2(10, 6), ivec2(6, 4), ivec2(4, 3),
                                                 ivec2(3, 3), ivec2(3, 3));
const int levelStart[bankLevels + 2] = int[](0, 0, 180, 240, 264, 276, 285, 294);
const int levelTexelCount = levelStart[bankLevels + 1];
const uint infiniteHalf = 0x7c00u;

// Per pixel: red and green; blue and the material (0 = receives nothing). Red is infinite where the pixel gives none.
shared uvec2 pixelLight[pixelCount];
shared float pixelDepth[pixelCount];
shared uvec4 levelTexels[levelTexelCount];
// Bit l: some texel of level l is rough or empty, and taps have depth weights of their own; else bilinear ones will do.
shared uint roughLevels;

// A pixel as a source and receiver of light.
struct Pixel {
    vec3 light;
    float depth;
    uint material;
    bool gives;
};

// Numerator and denominator of a pixel's result, per channel.
struct Sum {
    vec3 light;
    vec3 mass;
};

// Where a material's weights at a depth are in the table: between two bins.
struct Mixture {
    uint bin;
    float fraction; // [0, 1] towards the next bin
};

Pixel pixelAt(int index) {
    uvec2 words = pixelLight[index];
    Pixel pixel;
    pixel.depth = pixelDepth[index];
    pixel.material = words.y >> 16;
    pixel.gives = (words.x & 0xffffu) != infiniteHalf;
    pixel.light = pixel.gives ? vec3(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x) : vec3(0.0);
    return pixel;
}

// What is fetched of a pixel. All of a thread's fetches are made before any of them is used.
struct Fetched {
    vec3 light;
    float z;
    uint material;
};

Fetched fetchPixel(ivec2 local) {
    ivec2 inside = clamp(local, ivec2(0), view.areaExtent - 1);
    ivec2 pixel = inside + view.areaOffset;
    uint material = materialAt(pixel);
    return Fetched(enteringLight(pixel, material), viewZ(pixel), local == inside ? material : 0u);
}

void storePixel(int index, Fetched pixel) {
    bool receives = pixel.material != 0u && isValidZ(pixel.z);
    bool gives = receives && isFinite(pixel.light);
    vec3 light = min(pixel.light, vec3(maxHalf));
    uint blue = gives ? packHalf2x16(vec2(light.b, 0.0)) : 0u;
    pixelLight[index] = uvec2(gives ? packHalf2x16(light.rg) : infiniteHalf, receives ? blue | pixel.material << 16 : 0u);
    pixelDepth[index] = receives ? -pixel.z : 0.0;
}

// The first texel of a level in shared memory.
ivec2 levelFirst(int level, ivec2 region) {
    return (region >> level) - 1;
}

int levelOf(int index) {
    int level = 1;
    [[unroll]] for (int next = 2; next <= bankLevels; ++next) {
        level += index >= levelStart[next] ? 1 : 0;
    }
    return level;
}

uvec4 fetchLevelTexel(int index, ivec2 region) {
    int level = levelOf(index);
    int inLevel = index - levelStart[level];
    ivec2 texel = levelFirst(level, region) + ivec2(inLevel % levelPitch[level].x, inLevel / levelPitch[level].x);
    return blurredTexels[texelIndex(level, clamp(texel, ivec2(0), levelExtent(level) - 1))];
}

void loadRegion(ivec2 region, int thread) {
    const int pixelSteps = (pixelCount + threads - 1) / threads;
    const int levelSteps = (levelTexelCount + threads - 1) / threads;
    Fetched pixels[pixelSteps];
    uvec4 texels[levelSteps];
    [[unroll]] for (int i = 0; i < levelSteps; ++i) {
        texels[i] = fetchLevelTexel(min(thread + i * threads, levelTexelCount - 1), region);
    }
    [[unroll]] for (int i = 0; i < pixelSteps; ++i) {
        int index = min(thread + i * threads, pixelCount - 1);
        pixels[i] = fetchPixel(region + ivec2(index % pixelPitch.x, index / pixelPitch.x) - 1);
    }
    [[unroll]] for (int i = 0; i < levelSteps; ++i) {
        int index = thread + i * threads;
        if (index < levelTexelCount) {
            levelTexels[index] = texels[i];
            if ((texels[i].w & (presentBit | roughBit)) != presentBit) {
                atomicOr(roughLevels, 1u << levelOf(index));
            }
        }
    }
    [[unroll]] for (int i = 0; i < pixelSteps; ++i) {
        int index = thread + i * threads;
        if (index < pixelCount) {
            storePixel(index, pixels[i]);
        }
    }
}

Mixture findMixture(uint material, float depth) {
    uint first = material * bankTableWords;
    float position = uintBitsToFloat(bankTables[first]) - float(bankBinsPerOctave) * log2(texelWidth(0, depth));
    position = clamp(position, 0.0, float(bankBinCount - 1));
    uint bin = min(uint(position), uint(bankBinCount - 2));
    return Mixture(first + bankTableHead + bin * bankBinWords, position - float(bin));
}

// Red, green and blue of a kernel: halves 3·kernel … of the bin.
vec3 binWeight(uint bin, int kernel) {
    uint word = bin + uint(3 * kernel / 2);
    vec2 first = unpackHalf2x16(bankTables[word]);
    vec2 second = unpackHalf2x16(bankTables[word + 1u]);
    return (kernel & 1) == 0 ? vec3(first, second.x) : vec3(first.y, second);
}

vec3 kernelWeight(Mixture mixture, int kernel) {
    return mix(binWeight(mixture.bin, kernel), binWeight(mixture.bin + bankBinWords, kernel), mixture.fraction);
}

void add(inout Sum sum, vec3 weight, vec4 lightAndMass) {
    sum.light += weight * lightAndMass.rgb;
    sum.mass += weight * lightAndMass.a;
}

// The identity and the full-resolution 3x3 of the quad's four pixels. `first` is the pixel up and left of the quad.
#ifdef SMOOTH
#define UNROLL_LEVELS [[unroll]]
#else // its levels are long; unrolled they would take drivers seconds to compile
#define UNROLL_LEVELS [[dont_unroll]]
#endif

#ifdef SMOOTH
// Red, green and blue of a pixel, and 1, or 0 where it gives no light.
vec4 lightAt(int index) {
    uvec2 words = pixelLight[index];
    bool gives = (words.x & 0xffffu) != infiniteHalf;
    return gives ? vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y).x, 1.0) : vec4(0.0);
}

// How much a tap beside the centre weighs on the slope the quad stands on, in x and y.
vec2 weightBeside(int first, bvec4 members, vec4 depths, float depth) {
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    [[unroll]] for (int i = 0; i < 2; ++i) {
        bool pairX = members[2 * i] && members[2 * i + 1];
        bool pairY = members[i] && members[i + 2];
        steps += vec2(pairX ? depths[2 * i + 1] - depths[2 * i] : 0.0, pairY ? depths[i + 2] - depths[i] : 0.0);
        pairs += vec2(pairX, pairY);
    }
    vec2 slope = steps / (max(pairs, vec2(1.0)) * texelWidth(0, depth));
    return 0.5 * vec2(falloff(slope.x * slope.x / bankPixelDepthVariance),
                      falloff(slope.y * slope.y / bankPixelDepthVariance));
}

// Taps have the depths of that slope, which makes their weights separable.
void addPixels(inout Sum sums[4], Mixture mixture, int first, bvec4 members, vec4 depths, float depth) {
    vec2 beside = weightBeside(first, members, depths, depth);
    vec2 total = 1.0 + 2.0 * beside;
    vec4 rows[4][2]; // the block's rows, filtered along x for the quad's two columns
    vec4 own[4];
    [[unroll]] for (int y = 0; y < 4; ++y) {
        vec4 row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = lightAt(first + x + y * pixelPitch.x);
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            rows[y][x] = row[x + 1] + beside.x * (row[x] + row[x + 2]);
            if (y == 1 || y == 2) {
                own[x + 2 * (y - 1)] = row[x + 1];
            }
        }
    }
    float scale = 1.0 / (total.x * total.y);
    vec3 identityWeight = kernelWeight(mixture, 0);
    vec3 pixelsWeight = kernelWeight(mixture, 1);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        vec4 blurred = scale * (rows[y + 1][x] + beside.y * (rows[y][x] + rows[y + 2][x]));
        add(sums[i], identityWeight, own[i]);
        add(sums[i], pixelsWeight, blurred);
    }
}
#else
void addPixels(inout Sum sums[4], Mixture mixture, int first, bvec4 members, vec4 depths, float depth) {
    vec3 identityWeight = kernelWeight(mixture, 0);
    vec3 pixelsWeight = kernelWeight(mixture, 1);
    for (int i = 0; i < 4; ++i) {
        if (!members[i]) {
            continue;
        }
        int center = first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x;
        Pixel own = pixelAt(center);
        float width = texelWidth(0, own.depth);
        float scale = 1.0 / (bankPixelDepthVariance * width * width);
        vec4 light = vec4(0.0);
        float counted = 0.0;
        for (int j = 0; j < 9; ++j) {
            ivec2 offset = ivec2(j % 3, j / 3) - 1;
            float kernel = (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
            Pixel tap = pixelAt(center + offset.x + offset.y * pixelPitch.x);
            float difference = tap.depth - own.depth;
            float weight = kernel * falloff(difference * difference * scale);
            bool taken = tap.gives && givesLight(tap.material, own.material);
            counted += taken ? countedWeight(kernel, weight, difference, width) : kernel;
            light += taken ? weight * vec4(tap.light, 1.0) : vec4(0.0);
        }
        add(sums[i], identityWeight, own.gives ? vec4(own.light, 1.0) : vec4(0.0));
        add(sums[i], pixelsWeight, light / counted);
    }
}
#endif

// A level's texel: light and mass.
vec4 texelLight(int index) {
    uvec2 words = levelTexels[index].xy;
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

// A level's texel as a tap for a surface at `depth`: premultiplied by its depth weight, which is `total`.
struct Tap {
    vec4 light; // w: mass
    float total;
};

Tap loadTap(int index, int level, float depth, uint material) {
    BlurredTexel texel = unpackBlurred(levelTexels[index]);
    float width = texelWidth(level, depth);
    float difference = texel.depth - depth;
    float weight = falloff(difference * difference / (bankLevelDepthVariance * width * width));
    weight = texel.present && givesLight(texel.material, material) ? weight : 0.0;
    return Tap(weight * vec4(texel.light, texel.mass), weight);
}

void addTaps(inout Sum sum, vec3 weight, Tap taps[4], vec2 fraction) {
    vec4 bilinear = vec4((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y),
                         (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    float total = 0.0;
    vec4 light = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        total += bilinear[i] * taps[i].total;
        light += bilinear[i] * taps[i].light;
    }
    add(sum, weight, light / max(total, bankLeastWeight));
}

// Index in shared memory of the texel up and left of a pixel, and where the pixel lies between it and the next.
int levelCorner(int level, ivec2 region, ivec2 local, out vec2 fraction) {
    ivec2 corner = (local - (1 << (level - 1))) >> level;
    fraction = (vec2(local) + 0.5) / float(1 << level) - 0.5 - vec2(corner);
    ivec2 inRegion = corner - levelFirst(level, region);
    return levelStart[level] + inRegion.y * levelPitch[level].x + inRegion.x;
}

#ifdef SMOOTH
// Level 1, whose texels are the quads: bilinear weights ¼ and ¾ of the 3x3 texels around.
void addFinestLevel(inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 quad, uint material, vec4 depths) {
    ivec2 inRegion = (quad >> 1) - levelFirst(1, region) - 1;
    int corner = levelStart[1] + inRegion.y * levelPitch[1].x + inRegion.x;
    vec4 rows[3][2];
    [[unroll]] for (int y = 0; y < 3; ++y) {
        int index = corner + y * levelPitch[1].x;
        vec4 middle = texelLight(index + 1);
        rows[y][0] = mix(middle, texelLight(index), 0.25);
        rows[y][1] = mix(middle, texelLight(index + 2), 0.25);
    }
    vec3 weight = kernelWeight(mixture, 2);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        add(sums[i], weight, mix(rows[1][i & 1], rows[i >> 1 == 0 ? 0 : 2][i & 1], 0.25));
    }
}
#else
// Level 1, whose texels are the quads: each pixel has texels and depth weights of its own.
void addFinestLevel(inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 quad, uint material, vec4 depths) {
    vec3 weight = kernelWeight(mixture, 2);
    for (int i = 0; i < 4; ++i) {
        vec2 fraction;
        int corner = levelCorner(1, region, quad + ivec2(i & 1, i >> 1), fraction);
        Tap taps[4];
        for (int j = 0; j < 4; ++j) {
            taps[j] = loadTap(corner + (j & 1) + (j >> 1) * levelPitch[1].x, 1, depths[i], material);
        }
        addTaps(sums[i], weight, taps, fraction);
    }
}
#endif

// A coarser level: the quad's pixels lie between the same four texels.
void addLevel(int level, inout Sum sums[4], Mixture mixture, ivec2 region, ivec2 quad, uint material, float depth) {
    vec3 weight = kernelWeight(mixture, level + 1);
    if (weight == vec3(0.0)) {
        return;
    }
    vec2 fraction;
    int corner = levelCorner(level, region, quad, fraction);
    int below = corner + levelPitch[level].x;
    vec2 step = vec2(1.0 / float(1 << level));
    if ((roughLevels >> level & 1u) == 0u) {
        vec4 upperLeft = texelLight(corner);
        vec4 lowerLeft = texelLight(below);
        vec4 upperSlope = texelLight(corner + 1) - upperLeft;
        vec4 lowerSlope = texelLight(below + 1) - lowerLeft;
        [[unroll]] for (int x = 0; x < 2; ++x) {
            vec4 upper = upperLeft + (fraction.x + float(x) * step.x) * upperSlope;
            vec4 lower = lowerLeft + (fraction.x + float(x) * step.x) * lowerSlope;
            add(sums[x], weight, mix(upper, lower, fraction.y));
            add(sums[x + 2], weight, mix(upper, lower, fraction.y + step.y));
        }
    } else { // depth weights, shared by the quad
        Tap taps[4] = Tap[](loadTap(corner, level, depth, material), loadTap(corner + 1, level, depth, material),
                            loadTap(below, level, depth, material), loadTap(below + 1, level, depth, material));
        for (int i = 0; i < 4; ++i) {
            addTaps(sums[i], weight, taps, fraction + vec2(i & 1, i >> 1) * step);
        }
    }
}

// The quad's pixels that share a material and a surface, with the mixture taken at the first of them.
void combineGroup(ivec2 region, ivec2 quad, int first, uint material, float depth, vec4 depths, bvec4 members,
                  inout vec3 results[4]) {
    Mixture mixture = findMixture(material, depth);
    Sum sums[4];
    for (int i = 0; i < 4; ++i) {
        sums[i] = Sum(vec3(0.0), vec3(0.0));
    }
    addPixels(sums, mixture, first, members, depths, depth);
    addFinestLevel(sums, mixture, region, quad, material, depths);
    UNROLL_LEVELS for (int level = 2; level <= bankLevels; ++level) {
        addLevel(level, sums, mixture, region, quad, material, depth);
    }
    for (int i = 0; i < 4; ++i) {
        results[i] = members[i] ? sums[i].light / max(sums[i].mass, vec3(1e-20)) : results[i];
    }
}

// Two pixels of a quad make a group when they have one material and, where the tile is not smooth, one surface.
bool isOneGroup(uint material, float depth, uint leadersMaterial, float leadersDepth) {
#ifdef SMOOTH
    return material == leadersMaterial;
#else
    return material == leadersMaterial &&
           abs(depth - leadersDepth) <= bankSurfaceSeparation * texelWidth(1, leadersDepth);
#endif
}

void combineQuad(ivec2 region, ivec2 quad, int first) {
    uvec4 materialOf;
    vec4 depths;
    bvec4 done;
    vec3 results[4];
    for (int i = 0; i < 4; ++i) {
        Pixel pixel = pixelAt(first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x);
        materialOf[i] = pixel.material;
        depths[i] = pixel.depth;
        done[i] = pixel.material == 0u;
        results[i] = vec3(0.0);
    }
    [[dont_unroll]] for (int leader = 0; leader < 4; ++leader) {
        if (!done[leader]) {
            uint material = materialOf[leader];
            float depth = depths[leader];
            bvec4 members;
            for (int i = 0; i < 4; ++i) {
                members[i] = !done[i] && isOneGroup(materialOf[i], depths[i], material, depth);
                done[i] = done[i] || members[i];
            }
            combineGroup(region, quad, first, material, depth, depths, members, results);
        }
    }
    [[dont_unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 local = quad + ivec2(i & 1, i >> 1);
        if (all(lessThan(local, view.areaExtent))) {
            if (materialOf[i] == 0u) {
                writeUnscattered(local + view.areaOffset);
            } else {
                vec3 upper = (i & 1) == 0 ? results[0] : results[1];
                vec3 lower = (i & 1) == 0 ? results[2] : results[3];
                writeScattered(local + view.areaOffset, materialOf[i], i < 2 ? upper : lower);
            }
        }
    }
}

void main() {
#ifdef SMOOTH
    const int kind = 0;
#else
    const int kind = 1;
#endif
    ivec2 tiles = tileCount();
    uint entry = gl_WorkGroupID.y * bankDispatchWidth + gl_WorkGroupID.x;
    if (entry >= dispatches[kind].count) {
        return;
    }
    int tile = int(tileEntries[tiles.x * tiles.y * (1 + kind) + int(entry)]);
    ivec2 region = ivec2(tile % tiles.x, tile / tiles.x) * tileSize + ivec2(0, int(gl_WorkGroupID.z) * regionSize.y);
    int thread = int(gl_LocalInvocationIndex);
    if (thread == 0) {
        roughLevels = hasFlag(flagSeparateMaterials) ? ~0u : 0u;
    }
    barrier();
    loadRegion(region, thread);
    barrier();
    ivec2 inRegion = 2 * ivec2(gl_LocalInvocationID.xy);
    combineQuad(region, region + inRegion, inRegion.y * pixelPitch.x + inRegion.x);
}
