// What a thread of pass A of `bank` makes of its 2x2 px: a texel of level 1. docs/scatter.md. Included by pass A, with the
// tile's `depths`, of `pitch`, and `tileBits` in shared memory, after
// bank_reduction.glsl.

// 2x2 px, row by row.
struct QuadPixels {
    uint material[4];
    float depth[4]; // as in the image; from decodeQuad on mm, 0 where none receives light
    vec3 light[4];  // irradiance; from decodeQuad on as it enters
};

// One of the pixels around the tile.
struct RingPixel {
    ivec2 pixel;
    int place; // in `depths`
    uint material;
    float depth; // as in the image
};

// A pixel of the image, as near as there is one.
ivec2 imagePixel(ivec2 local) {
    return clamp(local, ivec2(0), view.areaExtent - 1) + view.areaOffset;
}

bool isInExtent(ivec2 local) {
    return all(greaterThanEqual(local, ivec2(0))) && all(lessThan(local, view.areaExtent));
}

// The same two for a tile's own pixels, which are not left of the area or above it.
ivec2 ownPixel(ivec2 local) {
    return min(local, view.areaExtent - 1) + view.areaOffset;
}

bool isBeforeEnd(ivec2 local) {
    return all(lessThan(local, view.areaExtent));
}

ivec2 offsetOf(int i) {
    return ivec2(i & 1, i >> 1);
}

// In `depths`; counted from the tile's first pixel.
int depthPlace(ivec2 pixel) {
    return (pixel.y + 1) * pitch + pixel.x + 1;
}

// Material ids of a quad, 0 beyond the area.
uvec4 fetchIds(ivec2 first) {
    uvec4 ids;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ids[i] = materialIdAt(ownPixel(first + offsetOf(i)));
    }
    bvec2 begins = lessThan(first, view.areaExtent);
    bvec2 ends = lessThan(first + 1, view.areaExtent);
    return mix(uvec4(0u), ids, bvec4(all(begins), ends.x && begins.y, begins.x && ends.y, all(ends)));
}

QuadPixels fetchQuad(ivec2 first, uvec4 ids) {
    QuadPixels quad;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 pixel = ownPixel(first + offsetOf(i));
        quad.depth[i] = texelFetch(depthImage, pixel, 0).r;
        quad.light[i] = texelFetch(irradianceImage, pixel, 0).rgb;
        quad.material[i] = materialOfId(ids[i]);
    }
    return quad;
}

// The pixels around the tile, without its corners: one a thread, counted from the tile's first.
ivec2 ringPlace(int thread) {
    int along = thread & tileSize - 1;
    int beyond = (thread & tileSize) == 0 ? -1 : tileSize;
    return thread < 2 * tileSize ? ivec2(along, beyond) : ivec2(beyond, along);
}

RingPixel fetchRing(ivec2 tileFirst, ivec2 place) {
    ivec2 pixel = imagePixel(tileFirst + place);
    uint id = materialIdAt(pixel);
    float depth = texelFetch(depthImage, pixel, 0).r;
    return RingPixel(pixel, depthPlace(place), isInExtent(tileFirst + place) ? materialOfId(id) : 0u, depth);
}

float receivingDepth(uint material, ivec2 pixel, float depth) {
    return material != 0u ? distanceAlongRay(pixel, viewZ(pixel, depth)) : 0.0;
}

void decodeQuad(inout QuadPixels quad, ivec2 first) {
    vec4 depth = vec4(quad.depth[0], quad.depth[1], quad.depth[2], quad.depth[3]);
    vec4 along = distancesAlongRays(first + view.areaOffset, depth);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        quad.depth[i] = quad.material[i] != 0u ? along[i] : 0.0;
    }
    if (hasFlag(flagAlbedoBefore)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            quad.light[i] *= albedoBefore(ownPixel(first + offsetOf(i)), quad.material[i]);
        }
    }
}

// Depth step from a pixel to the next along one axis, in pixel widths, from the depths on either side (0 = none): their
// mean or, where one side is a step to another surface, the smaller.
float pixelStep(float before, float depth, float after) {
    float width = texelWidth(0, depth);
    float onlyAfter = after > 0.0 ? after - depth : 0.0;
    float stepBefore = before > 0.0 ? depth - before : onlyAfter;
    float stepAfter = after > 0.0 ? onlyAfter : stepBefore;
    float smaller = min(abs(stepBefore), abs(stepAfter));
    float larger = max(abs(stepBefore), abs(stepAfter));
    bool goesOn = larger <= bankContinuedStep * max(smaller, width);
    return (goesOn ? 0.5 * (stepBefore + stepAfter) : smaller) / width;
}

// Area of a pixel's surface relative to one that faces the camera, from its own depth and those left, right, above, below.
float areaOf(float depth, vec4 around) {
    vec2 slope = vec2(pixelStep(around.x, depth, around.y), pixelStep(around.z, depth, around.w));
    return min(sqrt(1.0 + dot(slope, slope)), bankLargestArea);
}

// How much the taps beside the middle of the full-resolution 3x3 weigh, in x and y, on a slope of so many pixel widths a
// pixel.
vec2 weightsBeside(vec2 slope) {
    return 0.5 * vec2(falloff(slope.x * slope.x / bankPixelDepthVariance),
                      falloff(slope.y * slope.y / bankPixelDepthVariance));
}

// Depths beside a 2x2 quad: left and right of its rows, above and below its columns.
struct Sides {
    vec2 left, right, above, below;
};

vec2 depthsAt(int place, int next) {
    return uintBitsToFloat(uvec2(depths[place], depths[next]));
}

Sides sidesOf(int place) {
    return Sides(depthsAt(place - 1, place + pitch - 1), depthsAt(place + 2, place + pitch + 2),
                 depthsAt(place - pitch, place - pitch + 1), depthsAt(place + 2 * pitch, place + 2 * pitch + 1));
}

// A pair of pixels in a row or column, and the pixels before and after it.
float longestStep(float before, float first, float second, float after) {
    return max(max(abs(first - before), abs(second - first)), abs(after - second));
}

// Of a quad and the pixels beside it.
struct Depths {
    float least;   // 0 where one is on no surface
    float longest; // step from pixel to pixel, those to a pixel on no surface, too
};

Depths depthsOf(QuadPixels quad, Sides sides) {
    vec2 leastSides = min(min(sides.left, sides.right), min(sides.above, sides.below));
    float leastOwn = min(min(quad.depth[0], quad.depth[1]), min(quad.depth[2], quad.depth[3]));
    float longest = max(max(longestStep(sides.left.x, quad.depth[0], quad.depth[1], sides.right.x),
                            longestStep(sides.left.y, quad.depth[2], quad.depth[3], sides.right.y)),
                        max(longestStep(sides.above.x, quad.depth[0], quad.depth[2], sides.below.x),
                            longestStep(sides.above.y, quad.depth[1], quad.depth[3], sides.below.y)));
    return Depths(min(min(leastSides.x, leastSides.y), leastOwn), longest);
}

// Whether a quad and the pixels beside it are one surface, without silhouettes, holes or separate materials.
bool isContinuous(Depths around, float width) {
    return around.least > 0.0 && around.longest <= bankContinuedStep * width && !separateMaterials;
}

// Areas of a continuous quad's pixels: as areaOf, where every depth goes on to both sides.
vec4 continuousAreas(QuadPixels quad, Sides sides, float width) {
    vec4 stepX = vec4(quad.depth[1] - sides.left.x, sides.right.x - quad.depth[0], quad.depth[3] - sides.left.y,
                      sides.right.y - quad.depth[2]);
    vec4 stepY = vec4(quad.depth[2] - sides.above.x, quad.depth[3] - sides.above.y, sides.below.x - quad.depth[0],
                      sides.below.y - quad.depth[1]);
    return sqrt(1.0 + (stepX * stepX + stepY * stepY) * (0.25 / (width * width)));
}

vec4 anyAreas(QuadPixels quad, Sides sides) {
    return vec4(areaOf(quad.depth[0], vec4(sides.left.x, quad.depth[1], sides.above.x, quad.depth[2])),
                areaOf(quad.depth[1], vec4(quad.depth[0], sides.right.x, sides.above.y, quad.depth[3])),
                areaOf(quad.depth[2], vec4(sides.left.y, quad.depth[3], quad.depth[0], sides.below.x)),
                areaOf(quad.depth[3], vec4(quad.depth[2], sides.right.y, quad.depth[1], sides.below.y)));
}

// A texel of level 1 with what the combination wants to know of its pixels.
struct ReducedQuad {
    ReducedTexel texel;
    ReducedTexel second; // its second surface
    uint weights;    // packWeights or, where the quad is stepped, packSpread with spreadBit
    bool shareArea;  // of all pixels the texel's area, not `areas`
    vec4 areas;
};

ReducedQuad reduceContinuous(QuadPixels quad, Sides sides, float width) {
    vec4 areas = continuousAreas(quad, sides, width);
    vec3 light = areas.x * quad.light[0] + areas.y * quad.light[1] + areas.z * quad.light[2] + areas.w * quad.light[3];
    vec4 depth = vec4(quad.depth[0], quad.depth[1], quad.depth[2], quad.depth[3]);
    vec2 steps = vec2(depth.y - depth.x + depth.w - depth.z, depth.z - depth.x + depth.w - depth.y);
    float area = dot(areas, vec4(0.25));
    bool shareArea = dot(areas, areas) <= (4.0 + 4.0 * bankSharedAreaVariance) * (area * area);
    ReducedTexel texel = ReducedTexel(0.25 * light, area, 1.0, dot(depth, vec4(0.25)), quad.material[0], false);
    return ReducedQuad(texel, emptyTexel(), packWeights(weightsBeside(steps * (0.5 / width))), shareArea, areas);
}

// Which of four texels are on the nearer of two surfaces: closer to the nearest depth than to the farthest.
bvec4 nearerHalf(ReducedTexel texels[4], vec2 range) {
    bvec4 result;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        result[i] = texels[i].coverage > 0.0 && texels[i].depth - range.x <= range.y - texels[i].depth;
    }
    return result;
}

// Which pixels are on the surface that has more of them.
bvec4 heavierHalf(ReducedTexel pixels[4]) {
    vec2 range = depthRange(pixels);
    bool isOne = range.y - range.x <= separationAt(1, range.x);
    bvec4 near = nearerHalf(pixels, range);
    bvec4 valid;
    float balance = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        valid[i] = pixels[i].coverage > 0.0;
        balance += near[i] ? pixels[i].coverage : -pixels[i].coverage;
    }
    bvec4 far = bvec4(uvec4(valid) & uvec4(not(near)));
    return isOne ? valid : balance >= 0.0 ? near : far;
}

float surfaceStep(float a, float b) {
    return min(a, b) > 0.0 ? abs(a - b) : 0.0;
}

float longestSurfaceStep(float before, float first, float second, float after) {
    return max(max(surfaceStep(before, first), surfaceStep(first, second)), surfaceStep(second, after));
}

// The same where some pixel is on no surface: between those that are.
float longestBesideHole(QuadPixels quad, Sides sides) {
    return max(max(longestSurfaceStep(sides.left.x, quad.depth[0], quad.depth[1], sides.right.x),
                   longestSurfaceStep(sides.left.y, quad.depth[2], quad.depth[3], sides.right.y)),
               max(longestSurfaceStep(sides.above.x, quad.depth[0], quad.depth[2], sides.below.x),
                   longestSurfaceStep(sides.above.y, quad.depth[1], quad.depth[3], sides.below.y)));
}

// Whether a quad and the pixels beside it, of which none is missing, are one surface with longer steps than `limit`: in each
// row and column with such a step depth rises or falls, however steeply.
bool isSteep(QuadPixels quad, Sides sides, float limit) {
    vec4 first = vec4(quad.depth[0], quad.depth[2], quad.depth[0], quad.depth[1]);
    vec4 second = vec4(quad.depth[1], quad.depth[3], quad.depth[2], quad.depth[3]);
    vec4 before = first - vec4(sides.left, sides.above);
    vec4 between = second - first;
    vec4 after = vec4(sides.right, sides.below) - second;
    vec4 least = min(min(before, between), after);
    vec4 most = max(max(before, between), after);
    vec4 longest = max(most, -least);
    vec4 beyond = max(bankContinuedStep * max(least, -most), vec4(limit)); // how long it may be
    return all(lessThanEqual(longest, beyond));
}

// Of the pixels that a texel has kept.
DepthSpread spreadOfPixels(ReducedTexel pixels[4], bvec4 kept, ReducedTexel texel) {
    float perWidth = 1.0 / texelWidth(1, texel.depth);
    float variance = 0.0;
    vec2 lights = vec2(0.0); // sum of the channels; times distance
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (kept[i]) {
            float away = (pixels[i].depth - texel.depth) * perWidth;
            variance += 0.25 * away * away;
            lights += dot(clamp(pixels[i].light, vec3(0.0), vec3(1e30)), vec3(1.0 / pixels[i].area)) * vec2(1.0, away);
        }
    }
    const float ownVariance = 0.5 * bankPixelDepthVariance; // of depth weights, as Gaussians
    const float leastCloseness = ownVariance / (ownVariance + 0.25 * bankSurfaceSeparation * bankSurfaceSeparation);
    float closeness = texel.coverage / max(texel.coverage + variance / ownVariance, 0.25);
    return DepthSpread(max(closeness, leastCloseness), closeness / ownVariance * lights.y / max(lights.x, 1e-20));
}

// Depth steps from pixel to pixel, in pixel widths.
vec2 slopeOfPixels(ReducedTexel pixels[4], bvec4 kept, ReducedTexel texel) {
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    [[unroll]] for (int i = 0; i < 2; ++i) {
        bool pairX = kept[2 * i] && kept[2 * i + 1];
        bool pairY = kept[i] && kept[i + 2];
        steps += vec2(pairX ? pixels[2 * i + 1].depth - pixels[2 * i].depth : 0.0,
                      pairY ? pixels[i + 2].depth - pixels[i].depth : 0.0);
        pairs += vec2(pairX, pairY);
    }
    return steps / (max(pairs, vec2(1.0)) * texelWidth(0, texel.depth));
}

// Not finite light is no light and drops the pixel, as not finite depth does, so that nothing near is taken for smooth.
// `hasStep`: a step to another surface.
ReducedQuad reduceAny(QuadPixels quad, Sides sides, bool hasStep) {
    ReducedQuad result;
    result.shareArea = false;
    result.areas = anyAreas(quad, sides);
    ReducedTexel pixels[4];
    bool dropped = false;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        bool gives = quad.depth[i] > 0.0 && isFinite(quad.light[i]);
        dropped = dropped || (quad.material[i] != 0u && !gives);
        pixels[i] = emptyTexel();
        result.areas[i] = gives ? result.areas[i] : 1.0;
        if (gives) {
            vec3 light = result.areas[i] * quad.light[i];
            pixels[i] = ReducedTexel(light, result.areas[i], 1.0, quad.depth[i], quad.material[i], false);
        }
    }
    bvec4 kept = secondLevels > 0 ? heavierHalf(pixels) : chooseSurface(pixels, 1);
    result.second = secondLevels > 0 ? mergeTexels(pixels, not(kept)) : emptyTexel();
    result.texel = mergeTexels(pixels, kept);
    result.texel.dropped = result.texel.dropped || dropped;
    bool stepped = result.texel.dropped || hasStep;
    result.weights = stepped ? spreadBit | packSpread(spreadOfPixels(pixels, kept, result.texel))
                           : packWeights(weightsBeside(slopeOfPixels(pixels, kept, result.texel)));
    return result;
}

// Of the four pixels, as bits: those of light that is negative or not finite are larger than any other's.
uint largestLight(QuadPixels quad) {
    uvec3 largest = uvec3(0u);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        largest = max(largest, floatBitsToUint(quad.light[i]));
    }
    return max(max(largest.r, largest.g), largest.b);
}

ReducedQuad reduceQuad(QuadPixels quad, int place, ivec2 texel) {
    Sides sides = sidesOf(place);
    float width = texelWidth(0, quad.depth[0]);
    ReducedQuad reduced;
    Depths around = depthsOf(quad, sides);
    bool continuous = isContinuous(around, width);
    if (largestLight(quad) > floatBitsToUint(mostDimLight)) {
        atomicOr(tileBits, tileBright);
        [[unroll]] for (int i = 0; i < 4; ++i) {
            bool finite = isFinite(quad.light[i]);
            quad.light[i] = finite ? storableLight(quad.light[i]) : quad.light[i];
            continuous = continuous && finite;
        }
    }
    if (continuous) {
        reduced = reduceContinuous(quad, sides, width);
    } else {
        float farthest = max(max(quad.depth[0], quad.depth[1]), max(quad.depth[2], quad.depth[3]));
        bool hasHole = around.least == 0.0;
        float limit = (hasHole ? bankSmoothHoleDepth : bankSmoothDepth) * texelWidth(0, farthest);
        bool isLong = (hasHole ? longestBesideHole(quad, sides) : around.longest) > limit;
        bool mayGoOn = !hasHole && around.longest <= separationAt(1, farthest);
        reduced = reduceAny(quad, sides, isLong && !(mayGoOn && isSteep(quad, sides, limit)));
        bool isPart = secondLevels > 0 || isLong || reduced.texel.coverage < 1.0;
        uint bits = ((reduced.weights & spreadBit) != 0u ? tileStepBit(texel) : 0u) | (isPart ? notFull : 0u);
        if (bits != 0u) {
            atomicOr(tileBits, bits);
        }
    }
    return reduced;
}
