// Pass C of `bank`: every pixel's mixture of the identity, the full-resolution 3x3 and the six blurred levels, with its
// material's weights. 32x16 px a workgroup, two workgroups a tile, a 2x2 quad a thread. Compiled twice: SMOOTH for
// tiles without depth discontinuities, else for the others. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    uvec4 bankTables[]; // bankTableWords a material: the bin offset, then three words of 8 halves a bin
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

// The weights of the 8 kernels, 3 halves each, in order.
struct Weights {
    uint words[12];
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

void loadPixel(int index, ivec2 local) {
    uvec2 words = uvec2(infiniteHalf, 0u);
    float depth = 0.0;
    if (all(greaterThanEqual(local, ivec2(0))) && all(lessThan(local, view.areaExtent))) {
        ivec2 pixel = local + view.areaOffset;
        uint material = materialAt(pixel);
        float z = viewZ(pixel);
        if (material != 0u && isValidZ(z)) {
            vec3 light = enteringLight(pixel, material);
            bool gives = isFinite(light);
            light = gives ? min(light, vec3(maxHalf)) : vec3(0.0);
            words.x = gives ? packHalf2x16(light.rg) : infiniteHalf;
            words.y = packHalf2x16(vec2(light.b, 0.0)) | material << 16;
            depth = -z;
        }
    }
    pixelLight[index] = words;
    pixelDepth[index] = depth;
}

// The first texel of a level in shared memory.
ivec2 levelFirst(int level, ivec2 region) {
    return (region >> level) - 1;
}

void loadLevel(int level, ivec2 region, int thread) {
    int count = levelStart[level + 1] - levelStart[level];
    for (int i = thread; i < count; i += threads) {
        ivec2 texel = levelFirst(level, region) + ivec2(i % levelPitch[level].x, i / levelPitch[level].x);
        texel = clamp(texel, ivec2(0), levelExtent(level) - 1);
        levelTexels[levelStart[level] + i] = blurredTexels[texelIndex(level, texel)];
    }
}

Weights loadWeights(uint material, float depth) {
    uint first = material * bankTableWords;
    float offset = uintBitsToFloat(bankTables[first].x);
    float position = offset - float(bankBinsPerOctave) * log2(texelWidth(0, depth));
    position = clamp(position, 0.0, float(bankBinCount - 1));
    uint bin = min(uint(position), uint(bankBinCount - 2));
    float fraction = position - float(bin);
    Weights weights;
    for (uint i = 0u; i < 3u; ++i) {
        uvec4 low = bankTables[first + 1u + 3u * bin + i];
        uvec4 high = bankTables[first + 4u + 3u * bin + i];
        for (uint j = 0u; j < 4u; ++j) {
            weights.words[4u * i + j] =
                packHalf2x16(mix(unpackHalf2x16(low[j]), unpackHalf2x16(high[j]), fraction));
        }
    }
    return weights;
}

vec3 kernelWeight(Weights weights, int kernel) {
    int word = 3 * kernel / 2;
    vec2 first = unpackHalf2x16(weights.words[word]);
    vec2 second = unpackHalf2x16(weights.words[word + 1]);
    return kernel % 2 == 0 ? vec3(first, second.x) : vec3(first.y, second);
}

void add(inout Sum sum, vec3 weight, vec3 light, float mass) {
    sum.light += weight * light;
    sum.mass += weight * mass;
}

// The identity and the full-resolution 3x3 of the quad's four pixels. `first` is the pixel up and left of the quad.
#ifdef SMOOTH
// Taps have the depths of the slope the quad stands on, which makes their weights separable.
void addPixels(inout Sum sums[4], Weights weights, int first) {
    Pixel quad[4];
    for (int i = 0; i < 4; ++i) {
        quad[i] = pixelAt(first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x);
    }
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    for (int i = 0; i < 2; ++i) {
        if (quad[2 * i].gives && quad[2 * i + 1].gives) {
            steps.x += quad[2 * i + 1].depth - quad[2 * i].depth;
            pairs.x += 1.0;
        }
        if (quad[i].gives && quad[i + 2].gives) {
            steps.y += quad[i + 2].depth - quad[i].depth;
            pairs.y += 1.0;
        }
    }
    float depth = quad[0].material != 0u   ? quad[0].depth
                  : quad[1].material != 0u ? quad[1].depth
                  : quad[2].material != 0u ? quad[2].depth
                                           : quad[3].depth;
    float width = texelWidth(0, depth);
    vec2 slope = steps / (max(pairs, vec2(1.0)) * width);
    vec2 beside = 0.5 * vec2(falloff(slope.x * slope.x / bankPixelDepthVariance),
                             falloff(slope.y * slope.y / bankPixelDepthVariance));
    vec2 total = 1.0 + 2.0 * beside;
    float scale = 1.0 / (total.x * total.y);
    vec3 light[4] = vec3[](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    float mass[4] = float[](0.0, 0.0, 0.0, 0.0);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            Pixel tap = pixelAt(first + x + y * pixelPitch.x);
            for (int i = 0; i < 4; ++i) {
                ivec2 offset = ivec2(x, y) - 1 - ivec2(i & 1, i >> 1);
                if (abs(offset.x) <= 1 && abs(offset.y) <= 1) {
                    float kernel = (offset.x == 0 ? 1.0 : beside.x) * (offset.y == 0 ? 1.0 : beside.y);
                    bool taken = tap.gives && givesLight(tap.material, quad[i].material);
                    kernel = taken ? kernel * scale : 0.0;
                    light[i] += kernel * tap.light;
                    mass[i] += kernel;
                }
            }
        }
    }
    for (int i = 0; i < 4; ++i) {
        add(sums[i], kernelWeight(weights, 1), light[i], mass[i]);
        if (quad[i].gives) {
            add(sums[i], kernelWeight(weights, 0), quad[i].light, 1.0);
        }
    }
}
#else
void addPixels(inout Sum sums[4], Weights weights, int first) {
    for (int i = 0; i < 4; ++i) {
        int center = first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x;
        Pixel own = pixelAt(center);
        float width = texelWidth(0, own.depth);
        float scale = 1.0 / (bankPixelDepthVariance * width * width);
        vec3 light = vec3(0.0);
        float mass = 0.0;
        float counted = 0.0;
        for (int j = 0; j < 9; ++j) {
            ivec2 offset = ivec2(j % 3, j / 3) - 1;
            float kernel = (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
            Pixel tap = pixelAt(center + offset.x + offset.y * pixelPitch.x);
            float difference = tap.depth - own.depth;
            float weight = kernel * falloff(difference * difference * scale);
            bool taken = tap.gives && givesLight(tap.material, own.material);
            counted += taken ? countedWeight(kernel, weight, difference, width) : kernel;
            weight = taken ? weight : 0.0;
            light += weight * tap.light;
            mass += weight;
        }
        add(sums[i], kernelWeight(weights, 1), light / counted, mass / counted);
        if (own.gives) {
            add(sums[i], kernelWeight(weights, 0), own.light, 1.0);
        }
    }
}
#endif

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
    light /= max(total, bankLeastWeight);
    add(sum, weight, light.rgb, light.a);
}

// Index in shared memory of the texel up and left of a pixel, and where the pixel lies between it and the next.
int levelCorner(int level, ivec2 region, ivec2 local, out vec2 fraction) {
    ivec2 corner = (local - (1 << (level - 1))) >> level;
    fraction = (vec2(local) + 0.5) / float(1 << level) - 0.5 - vec2(corner);
    ivec2 inRegion = corner - levelFirst(level, region);
    return levelStart[level] + inRegion.y * levelPitch[level].x + inRegion.x;
}

// Level 1, whose texels are the quads: each pixel has texels and depth weights of its own.
void addFinestLevel(inout Sum sums[4], Weights weights, ivec2 region, ivec2 quad, uint material, float depths[4]) {
    for (int i = 0; i < 4; ++i) {
        vec2 fraction;
        int corner = levelCorner(1, region, quad + ivec2(i & 1, i >> 1), fraction);
        Tap taps[4];
        for (int j = 0; j < 4; ++j) {
            taps[j] = loadTap(corner + (j & 1) + (j >> 1) * levelPitch[1].x, 1, depths[i], material);
        }
        addTaps(sums[i], kernelWeight(weights, 2), taps, fraction);
    }
}

// A coarser level: the quad's pixels lie between the same four texels and share their depth weights.
void addLevel(int level, inout Sum sums[4], Weights weights, ivec2 region, ivec2 quad, uint material, float depth) {
    vec3 weight = kernelWeight(weights, level + 1);
    if (weight == vec3(0.0)) {
        return;
    }
    vec2 fraction;
    int corner = levelCorner(level, region, quad, fraction);
    Tap taps[4];
    for (int j = 0; j < 4; ++j) {
        taps[j] = loadTap(corner + (j & 1) + (j >> 1) * levelPitch[level].x, level, depth, material);
    }
    for (int i = 0; i < 4; ++i) {
        addTaps(sums[i], weight, taps, fraction + vec2(i & 1, i >> 1) / float(1 << level));
    }
}

// The quad's pixels that share a material and a surface, with the weights taken at the first of them.
void combineGroup(ivec2 region, ivec2 quad, int first, uint material, float depth, float depths[4], bvec4 members) {
    Weights weights = loadWeights(material, depth);
    Sum sums[4];
    for (int i = 0; i < 4; ++i) {
        sums[i] = Sum(vec3(0.0), vec3(0.0));
    }
    addPixels(sums, weights, first);
    addFinestLevel(sums, weights, region, quad, material, depths);
    for (int level = 2; level <= bankLevels; ++level) {
        addLevel(level, sums, weights, region, quad, material, depth);
    }
    for (int i = 0; i < 4; ++i) {
        if (members[i]) {
            ivec2 pixel = quad + ivec2(i & 1, i >> 1) + view.areaOffset;
            writeScattered(pixel, material, sums[i].light / max(sums[i].mass, vec3(1e-20)));
        }
    }
}

void combineQuad(ivec2 region, ivec2 quad, int first) {
    uint materialOf[4];
    float depths[4];
    bvec4 done;
    for (int i = 0; i < 4; ++i) {
        Pixel pixel = pixelAt(first + 1 + (i & 1) + (1 + (i >> 1)) * pixelPitch.x);
        materialOf[i] = pixel.material;
        depths[i] = pixel.depth;
        ivec2 local = quad + ivec2(i & 1, i >> 1);
        bool inside = all(lessThan(local, view.areaExtent));
        if (inside && pixel.material == 0u) {
            writeUnscattered(local + view.areaOffset);
        }
        done[i] = !inside || pixel.material == 0u;
    }
    for (int leader = 0; leader < 4; ++leader) {
        if (done[leader]) {
            continue;
        }
        bvec4 members = bvec4(false);
        for (int i = leader; i < 4; ++i) {
            bool member = !done[i] && materialOf[i] == materialOf[leader];
#ifndef SMOOTH
            float separation = bankSurfaceSeparation * texelWidth(1, depths[leader]);
            member = member && abs(depths[i] - depths[leader]) <= separation;
#endif
            members[i] = member;
            done[i] = done[i] || member;
        }
        combineGroup(region, quad, first, materialOf[leader], depths[leader], depths, members);
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
    for (int i = thread; i < pixelCount; i += threads) {
        loadPixel(i, region + ivec2(i % pixelPitch.x, i / pixelPitch.x) - 1);
    }
    for (int level = 1; level <= bankLevels; ++level) {
        loadLevel(level, region, thread);
    }
    barrier();
    ivec2 inRegion = 2 * ivec2(gl_LocalInvocationID.xy);
    combineQuad(region, region + inRegion, inRegion.y * pixelPitch.x + inRegion.x);
}
