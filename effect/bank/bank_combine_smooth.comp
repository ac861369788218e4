// Pass C of `bank` for regions without depth discontinuities: every pixel's mixture of the identity, the
// full-resolution 3x3 and the six blurred levels, with its material's weights. With HALF_FLOATS light is
// interpolated in half floats. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#ifdef HALF_FLOATS
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#endif
#include "bank_region_smooth.glsl"
#include "bank_combine.glsl"

shared uvec2 fineLights[fineCount]; // of level 1's texels: light times coverage, and coverage

// What light is interpolated in. As differences times fractions, so that a constant field stays exactly what it is. Sums of two
// differences are made of pixels alone (isBright).
#ifdef HALF_FLOATS
#define Real float16_t
#define Real2 f16vec2
#define Light f16vec4
Light storedLight(uvec2 words) {
    return Light(unpackFloat2x16(words.x), unpackFloat2x16(words.y));
}
uvec2 packLight(Light light) {
    return uvec2(packFloat2x16(light.rg), packFloat2x16(light.ba));
}
#else
#define Real float
#define Real2 vec2
#define Light vec4
Light storedLight(uvec2 words) {
    return unpackLight(words);
}
uvec2 packLight(Light light) {
    return uvec2(packHalf2x16(light.rg), packHalf2x16(light.ba));
}
#endif

// The full-resolution 3x3 of a quad on a slope: taps have its depths, which makes their weights separable, `beside` the
// middle in x and y.
void filterPixels(out Light result[4], ivec2 thread, vec2 beside) {
    vec2 side = beside / (1.0 + 2.0 * beside);
    Light rows[4][2]; // the rows of these, filtered along x for the quad's two columns
    [[unroll]] for (int y = 0; y < 4; ++y) {
        Light row[4];
        [[unroll]] for (int x = 0; x < 4; ++x) {
            row[x] = storedLight(pixelLights[ownPlace(thread, ivec2(x, y) - 1)]);
        }
        [[unroll]] for (int x = 0; x < 2; ++x) {
            Light middle = row[x + 1];
            rows[y][x] = fma(Light(side.x), row[x] - middle, fma(Light(side.x), row[x + 2] - middle, middle));
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int x = i & 1;
        int y = i >> 1;
        Light middle = rows[y + 1][x]; // added last, so that only once all of it is rounded
        result[i] = fma(Light(side.y), (rows[y][x] - middle) + (rows[y + 2][x] - middle), middle);
    }
}

// Level 1, whose texels are the quads: along an axis the 3x3 mean and the bilinear reading of it, ¼ and ¾, are one kernel
// of four texels for either pixel of a quad.
struct FineKernel {
    Real near;  // weight of the texel that a pixel is closer to,
    Real far;   // of the one on the other side,
    Real outer; // and of the one beyond the near one; the rest is the quad's own
};

// `side`: weight of a texel beside the mean's middle one, of 1 in all.
FineKernel fineKernel(float side) {
    return FineKernel(Real(0.25 + 0.25 * side), Real(0.75 * side), Real(0.25 * side));
}

// Five texels in a row, filtered for the quad's two columns.
void filterFineRow(FineKernel kernel, int first, out Light row[2]) {
    Light own = storedLight(fineLights[first + 2]);
    Light left = storedLight(fineLights[first + 1]) - own;
    Light right = storedLight(fineLights[first + 3]) - own;
    row[0] = fma(Light(kernel.outer), storedLight(fineLights[first]) - own,
                 fma(Light(kernel.near), left, fma(Light(kernel.far), right, own)));
    row[1] = fma(Light(kernel.outer), storedLight(fineLights[first + 4]) - own,
                 fma(Light(kernel.near), right, fma(Light(kernel.far), left, own)));
}

// Level 1 of a quad. On a slope the mean's taps have its depths; `beside`: of the full-resolution 3x3, whose falloff is that
// of a wider variance.
void filterFinestLevel(out Light result[4], ivec2 texel, vec2 beside) {
    vec2 falloffs = 2.0 * beside;
    falloffs *= sqrt(falloffs); // to the power bankFinestFalloffPower
    vec2 side = falloffs / (1.0 + 2.0 * falloffs);
    FineKernel kernelX = fineKernel(side.x);
    FineKernel kernelY = fineKernel(side.y);
    int first = fineIndex(texel - 2);
    Light own[2];
    filterFineRow(kernelX, first + 2 * finePitch, own);
    result = Light[](Light(0.0), Light(0.0), Light(0.0), Light(0.0));
    const int rows[4] = int[](0, 1, 3, 4);
    Light upper[4] = Light[](Light(kernelY.outer), Light(kernelY.near), Light(kernelY.far), Light(0.0));
    Light lower[4] = Light[](Light(0.0), Light(kernelY.far), Light(kernelY.near), Light(kernelY.outer));
    [[unroll]] for (int i = 0; i < 4; ++i) {
        Light row[2];
        filterFineRow(kernelX, first + rows[i] * finePitch, row);
        [[unroll]] for (int x = 0; x < 2; ++x) {
            Light difference = row[x] - own[x];
            if (i < 3) {
                result[x] = fma(upper[i], difference, result[x]);
            }
            if (i > 0) {
                result[x + 2] = fma(lower[i], difference, result[x + 2]);
            }
        }
    }
    [[unroll]] for (int i = 0; i < 4; ++i) { // last, so that only once all of it is rounded
        result[i] += own[i & 1];
    }
}

// Adds a kernel whose reach is all on the surface.
void addCovered(inout Sum sum, vec3 weight, Light lights[4]) {
    [[unroll]] for (int i = 0; i < 4; ++i) {
        sum.light[i] += weight * vec3(lights[i].rgb);
    }
    sum.weight += weight;
}

// Adds a kernel of which only a part is: each pixel has the mean of its light, the quad one coverage.
void addPartial(inout Sum sum, vec3 weight, vec4 lights[4]) {
    weight *= 0.25 * (lights[0].a + lights[1].a + lights[2].a + lights[3].a);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        sum.light[i] += weight / max(lights[i].a, bankLeastWeight) * lights[i].rgb;
    }
    sum.weight += weight;
}

void addKernel(inout Sum sum, vec3 weight, Light lights[4]) {
    if (min(min(lights[0].a, lights[1].a), min(lights[2].a, lights[3].a)) < Real(1.0)) {
        addPartial(sum, weight, vec4[](vec4(lights[0]), vec4(lights[1]), vec4(lights[2]), vec4(lights[3])));
    } else {
        addCovered(sum, weight, lights);
    }
}

// The identity: a smooth region's pixels all give light where they receive it.
void addIdentity(inout Sum sum, vec3 weight, ivec2 texel) {
    Light lights[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        lights[i] = storedLight(pixelLights[ownPlace(texel, ivec2(i & 1, i >> 1))]);
    }
    addCovered(sum, max(weight, vec3(bankLeastIdentity)), lights);
}

// A level from 2 on as a quad sees it, whose pixels lie between the same four texels: light times coverage, and coverage.
struct Seen {
    vec4 middle;  // of the quad
    Light slopeX; // from a texel to the next
    Light slopeY;
};

// With bilinear weights.
Seen bilinearLevel(Corner corner) {
    int below = corner.place + levelPitch;
    Real2 fraction = Real2(corner.fraction);
    Light upper = storedLight(levelLights[corner.place]);
    Light lower = storedLight(levelLights[below]);
    Light upperSlope = storedLight(levelLights[corner.place + 1]) - upper;
    Light lowerSlope = storedLight(levelLights[below + 1]) - lower;
    upper = fma(Light(fraction.x), upperSlope, upper);
    Light slopeY = fma(Light(fraction.x), lowerSlope, lower) - upper;
    precise Light slopeX = fma(Light(fraction.y), lowerSlope, Light(Real(1.0) - fraction.y) * upperSlope);
    return Seen(vec4(fma(Light(fraction.y), slopeY, upper)), slopeX, slopeY);
}

// With depth weights. `factor`: levelFactor, by which all of it is to be multiplied.
Seen weightedLevel(int level, Corner corner, float depth, out float factor) {
    float scale = levelScale(level, depth);
    vec2 fraction = corner.fraction;
    vec4 taps[4];
    float total = 0.0;
    float away = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = corner.place + (i & 1) + (i >> 1) * levelPitch;
        float distance = levelDepths[place] - depth;
        float tapWeight = depthWeight(distance, scale);
        taps[i] = tapWeight * levelLight(levelLights[place]);
        tapWeight *= ((i & 1) == 0 ? 1.0 - fraction.x : fraction.x) * (i < 2 ? 1.0 - fraction.y : fraction.y);
        total += tapWeight;
        away += tapWeight * distance;
    }
    factor = levelFactor(total, away, scale);
    vec4 upper = mix(taps[0], taps[1], fraction.x);
    vec4 lower = mix(taps[2], taps[3], fraction.x);
    return Seen(mix(upper, lower, fraction.y), Light(mix(taps[1] - taps[0], taps[3] - taps[2], fraction.y)),
                Light(lower - upper));
}

// How the mean light, of a level of which only a part is there, changes from a texel to the next.
vec3 meanSlope(Light slope, vec4 middle) {
    return vec3(slope.rgb) - middle.rgb * (float(slope.a) / max(middle.a, bankLeastWeight));
}

// Begins a quad's sum with the coarse levels: once for its four pixels, while they have no light of their own yet, which takes
// fewer registers. `local`: the first of them, counted from the region's. Levels without a weight are not asked for it.
Sum sumCoarseLevels(Mixture mixture, uint used, ivec2 region, ivec2 local, float depth) {
    uint stepped = steppedLevels;
    LevelGrid grid = finestGrid;
    vec3 light = vec3(0.0);
    vec3 stepX = vec3(0.0); // from a pixel to the next
    vec3 stepY = vec3(0.0);
    Sum sum = noSum();
    [[dont_unroll]] for (int level = 2; level <= bankLevels; ++level) {
        if ((used >> level & 2u) != 0u) {
            vec3 weight = kernelWeight(mixture, level + 1);
            Corner corner = cornerOf(grid, level, region, local);
            Seen seen;
            float factor = 1.0;
            if ((stepped >> level & 1u) == 0u) {
                seen = bilinearLevel(corner);
            } else {
                seen = weightedLevel(level, corner, depth, factor);
            }
            weight *= factor;
            light += weight * seen.middle.rgb;
            sum.weight += weight * seen.middle.a;
            if (level <= bankSlopeLevels) {
                weight *= corner.step;
                stepX += weight * meanSlope(seen.slopeX, seen.middle);
                stepY += weight * meanSlope(seen.slopeY, seen.middle);
            }
        }
        grid = coarser(grid);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        sum.light[i] = light + (float(i & 1) - 0.5) * stepX + (float(i >> 1) - 0.5) * stepY;
    }
    return sum;
}

// A texel of level 1, as reduced, without the surface's area: light times coverage, and coverage.
void storeFine(ivec2 texel, uvec2 words) {
    Light lightAndArea = storedLight(words);
    Real coverage = min(abs(lightAndArea.w), Real(1.0));
    fineLights[fineIndex(texel)] = packLight(Light(lightAndArea.rgb * coverage, coverage));
}

const int fineRingCount = fineCount - threads; // two texels wide

// Position of one of the texels of level 1 around the region's: the rows above and below, then the sides.
ivec2 fineRingPosition(int index) {
    int beyond = index - 4 * finePitch;
    int row = int((float(index) + 0.5) / float(finePitch));
    return beyond < 0 ? ivec2(index - row * finePitch - 2, row < 2 ? row - 2 : row + fineSize.y - 2)
                      : ivec2((beyond & 3) < 2 ? (beyond & 3) - 2 : (beyond & 3) + fineSize.x - 2, beyond >> 2);
}

// A thread's quad, not unpacked before it is needed: it takes less room so.
struct Quad {
    uint word;       // packQuad
    uvec2 materials; // materialsOf
    float depth;
};

// Threads of a part of the region follow one another, so that those of one that is skipped end together.
const int partThreads = threads / 4;

// A thread's quad, as a texel of level 1.
ivec2 texelOf(int part, int index) {
    ivec2 size = partSize / 2;
    return size * ivec2(part & 1, part >> 1) + quadOrder(index, size.x);
}

// Whether the material of one of a quad's pixels, counted row by row, is this one.
bool hasMaterial(Quad quad, int i, uint material) {
    uint difference = (i < 2 ? quad.materials.x : quad.materials.y) ^ material * 0x10001u;
    return (difference & ((i & 1) == 0 ? 0xffffu : 0xffff0000u)) == 0u;
}

// Half of a texel's light.
uvec2 dimmed(uvec2 words) {
    return packLight(storedLight(words) * Light(0.5, 0.5, 0.5, 1.0));
}

// Fetches everything before anything is used, so that the fetches overlap. Returns the thread's quad.
Quad loadRegion(Region region, int thread, ivec2 texel) {
    ivec2 last = view.areaExtent - 1;
    int fine = fineTexelIndex(region, texel);
    uvec4 fineTexel = reducedTexels[fine];
    ivec2 first = region.first + 2 * texel;
    vec3 lights[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        lights[i] = fetchLight(min(first + ivec2(i & 1, i >> 1), last));
    }
    int ringThread = threads - 1 - thread;
    ivec2 fineRing = fineRingPosition(min(ringThread, fineRingCount - 1));
    uvec2 ringLight = reducedTexels[fineTexelIndex(region, fineRing)].xy;
    Coarse coarse = findCoarse(min(thread, coarseCount - 1), region.first);
    uvec2 coarseLight = blurredLights[blurredIndex(coarse.index)];
    uvec2 coarseSurface = reducedTexels[coarse.index].zw;
    ivec2 ring = ringPosition(min(thread, ringCount - 1), regionSize);
    Fetched ringPixel = fetchPixel(region, ring);
    if (!readsOccupied(region)) {
        fineTexel = isOccupied(region, texel) ? fineTexel : uvec4(0u);
        ringLight = isOccupied(region, fineRing) ? ringLight : uvec2(0u);
        ringPixel.quadWord = isOccupied(region, ring >> 1) ? ringPixel.quadWord : 0u;
    }
    Quad quad = Quad(fineTexel.w, materialsOf(fineTexel.w, fine), uintBitsToFloat(fineTexel.z));
    if (hasFlag(flagAlbedoBefore)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            ivec2 pixel = min(first + ivec2(i & 1, i >> 1), last);
            lights[i] *= albedoBefore(pixel + view.areaOffset, pixelMaterial(quad.materials, ivec2(i & 1, i >> 1)));
        }
    }
    uint ringMaterial = decodeFetched(region, ring, ringPixel);
    if (isBright(region)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            lights[i] = 0.5 * storableLight(lights[i]);
        }
        ringPixel.light = 0.5 * storableLight(ringPixel.light);
        fineTexel.xy = dimmed(fineTexel.xy);
        ringLight = dimmed(ringLight);
        coarseLight = dimmed(coarseLight);
    }
    storeFine(texel, fineTexel.xy);
    if (ringThread < fineRingCount) {
        storeFine(fineRing, ringLight);
    }
    if (thread < coarseCount) {
        storeLevelTexel(coarse, coarseLight);
        storeSurface(coarse, coarseSurface, coarseLight);
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        storePixel(ownPlace(texel, offset), lights[i], !hasMaterial(quad, i, 0u));
    }
    if (thread < ringCount) {
        storePixel(pixelPlace(ring + 1), ringPixel.light, ringMaterial != 0u);
    }
    return quad;
}

// Writes the quad's pixels that have no material. `scattering`: bits of the others.
void storeRest(ivec2 first, uint scattering) {
    [[dont_unroll]] for (int i = 0; i < ownPixels; ++i) {
        ivec2 local = first + ivec2(i & 1, i >> 1);
        if ((scattering >> i & 1u) == 0u && all(lessThan(local, view.areaExtent))) {
            writeUnscattered(local + view.areaOffset, 0u);
        }
    }
}

// The mean scaleAt of a group's pixels, which share a mixture. `first`: of the quad.
float groupScale(ivec2 first, bvec4 members) {
    if (!hasFlag(flagScale)) {
        return 1.0;
    }
    vec2 sum = vec2(0.0); // and how many
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 local = first + ivec2(i & 1, i >> 1);
        if (members[i] && all(lessThan(local, view.areaExtent))) {
            sum += vec2(scaleAt(local + view.areaOffset), 1.0);
        }
    }
    return sum.x / sum.y;
}

void main() {
    Region region;
    if (!findRegion(0, region)) {
        return;
    }
    int thread = int(gl_LocalInvocationIndex);
    int part = thread / partThreads;
    ivec2 texel = texelOf(part, thread % partThreads);
    if (thread == 0) {
        steppedLevels = 0u;
    }
    barrier();
    Quad quad = loadRegion(region, thread, texel);
    barrier();
    if ((region.skipped >> part & 1u) != 0u) {
        return;
    }
    ivec2 first = region.first + 2 * texel;
    uint scattering = 0u; // bits of the pixels that have a material
    [[unroll]] for (int i = 0; i < 4; ++i) {
        scattering |= hasMaterial(quad, i, 0u) ? 0u : 1u << i;
    }
    // One round for every material in the quad.
    for (uint remaining = scattering; remaining != 0u;) {
        int next = findLSB(remaining);
        uint material = pixelMaterial(quad.materials, ivec2(next & 1, next >> 1));
        bvec4 members = bvec4(true);
        if (isMixed(quad.word)) {
            [[unroll]] for (int i = 0; i < 4; ++i) {
                members[i] = hasMaterial(quad, i, material);
                remaining &= members[i] ? ~(1u << i) : ~0u;
            }
        } else {
            remaining = 0u;
        }
        vec2 beside = weightsOf(quad.word);
        Mixture mixture = findMixture(material, quad.depth, first + view.areaOffset, groupScale(first, members));
        uint used = usedKernels(mixture);
        Sum sum = sumCoarseLevels(mixture, used, region.first, 2 * texel, quad.depth);
        addIdentity(sum, kernelWeight(mixture, 0), texel);
        Light lights[4];
        filterPixels(lights, texel, beside);
        addKernel(sum, kernelWeight(mixture, 1), lights);
        if ((used & finestKernel) != 0u) {
            filterFinestLevel(lights, texel, beside);
            addKernel(sum, kernelWeight(mixture, 2), lights);
        }
        sum.weight *= isBright(region) ? 0.5 : 1.0; // light is half of what it is
        storeGroup(first, members, material, strengthOf(mixture), sum);
    }
    if (scattering != 15u) {
        storeRest(first, scattering);
    }
}
