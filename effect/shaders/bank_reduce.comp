// Pass A of `bank`: levels 1 to 4 of the pyramid, a tile of 16x16 px a workgroup, 2x2 px a thread; notes which tiles hold
// subsurface pixels, and copies the tiles that hold none. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const int side = tileSize / 2; // texels of level 1

// Level 1; where the tile is not plain, each coarser level then stands at its first child's place.
shared uvec4 texels[side * side];
shared uvec4 seconds[secondLevels > 0 ? side * side : 1]; // their second surfaces, where they have one
shared uvec4 plainTexels[4]; // level 3 of a plain tile
// Of the tile's pixels and one around, mm; 0 where none receives light.
const int pitch = tileSize + 2;
shared float depths[pitch * pitch];
shared uint occupied; // whether some pixel has a material
shared uint roughness; // notPlain, and tileRough of the tile's blocks
const uint notPlain = 1u; // some block is not plain

// 2x2 px, row by row.
struct Block {
    uint material[4];
    float depth[4]; // as in the image; from decodeBlock on mm, 0 where none receives light
    vec3 light[4];  // irradiance; from decodeBlock on as it enters
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

ivec2 offsetOf(int i) {
    return ivec2(i & 1, i >> 1);
}

// In `depths`; counted from the tile's first pixel.
int depthPlace(ivec2 pixel) {
    return (pixel.y + 1) * pitch + pixel.x + 1;
}

Block fetchBlock(ivec2 first) {
    Block block;
    uint id[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 pixel = imagePixel(first + offsetOf(i));
        id[i] = texelFetch(materialIdImage, pixel, 0).r;
        block.depth[i] = texelFetch(depthImage, pixel, 0).r;
        block.light[i] = texelFetch(irradianceImage, pixel, 0).rgb;
    }
    [[unroll]] for (int i = 0; i < 4; ++i) {
        block.material[i] = isInExtent(first + offsetOf(i)) ? materialOfId(id[i]) : 0u;
    }
    return block;
}

// The pixels around the tile, without its corners: one a thread.
RingPixel fetchRing(ivec2 tileFirst, int thread) {
    int along = thread % tileSize;
    int beyond = (thread / tileSize & 1) == 0 ? -1 : tileSize;
    ivec2 place = thread < 2 * tileSize ? ivec2(along, beyond) : ivec2(beyond, along);
    ivec2 pixel = imagePixel(tileFirst + place);
    float depth = texelFetch(depthImage, pixel, 0).r;
    uint material = isInExtent(tileFirst + place) ? materialAt(pixel) : 0u;
    return RingPixel(pixel, depthPlace(place), material, depth);
}

float receivingDepth(uint material, ivec2 pixel, float depth) {
    return material != 0u ? distanceAlongRay(pixel, viewZ(pixel, depth)) : 0.0;
}

void decodeBlock(inout Block block, ivec2 first) {
    vec4 depth = vec4(block.depth[0], block.depth[1], block.depth[2], block.depth[3]);
    vec4 along = distancesAlongRays(first + view.areaOffset, depth);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        block.depth[i] = block.material[i] != 0u ? along[i] : 0.0;
    }
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < 4; ++i) {
            block.light[i] *= albedoBefore(imagePixel(first + offsetOf(i)), block.material[i]);
        }
    }
}

// Depths beside a 2x2 block: left and right of its rows, above and below its columns.
struct Sides {
    vec2 left, right, above, below;
};

Sides sidesOf(int place) {
    return Sides(vec2(depths[place - 1], depths[place + pitch - 1]), vec2(depths[place + 2], depths[place + pitch + 2]),
                 vec2(depths[place - pitch], depths[place - pitch + 1]),
                 vec2(depths[place + 2 * pitch], depths[place + 2 * pitch + 1]));
}

// A pair of pixels in a row or column, and the pixels before and after it.
float longestStep(float before, float first, float second, float after) {
    return max(max(abs(first - before), abs(second - first)), abs(after - second));
}

// Whether a block and the pixels beside it are one surface, without silhouettes, holes or separate materials.
bool isPlain(Block block, Sides sides, float width) {
    vec2 leastSides = min(min(sides.left, sides.right), min(sides.above, sides.below));
    float leastOwn = min(min(block.depth[0], block.depth[1]), min(block.depth[2], block.depth[3]));
    float longest = max(max(longestStep(sides.left.x, block.depth[0], block.depth[1], sides.right.x),
                            longestStep(sides.left.y, block.depth[2], block.depth[3], sides.right.y)),
                        max(longestStep(sides.above.x, block.depth[0], block.depth[2], sides.below.x),
                            longestStep(sides.above.y, block.depth[1], block.depth[3], sides.below.y)));
    return min(min(leastSides.x, leastSides.y), leastOwn) > 0.0 && longest <= bankPlainStep * width && !separateMaterials;
}

// Areas of a plain block's pixels: as areaOf, where every depth goes on to both sides.
vec4 plainAreas(Block block, Sides sides, float width) {
    vec4 stepX = vec4(block.depth[1] - sides.left.x, sides.right.x - block.depth[0], block.depth[3] - sides.left.y,
                      sides.right.y - block.depth[2]);
    vec4 stepY = vec4(block.depth[2] - sides.above.x, block.depth[3] - sides.above.y, sides.below.x - block.depth[0],
                      sides.below.y - block.depth[1]);
    return sqrt(1.0 + (stepX * stepX + stepY * stepY) * (0.25 / (width * width)));
}

vec4 anyAreas(Block block, Sides sides) {
    return vec4(areaOf(block.depth[0], vec4(sides.left.x, block.depth[1], sides.above.x, block.depth[2])),
                areaOf(block.depth[1], vec4(block.depth[0], sides.right.x, sides.above.y, block.depth[3])),
                areaOf(block.depth[2], vec4(sides.left.y, block.depth[3], block.depth[0], sides.below.x)),
                areaOf(block.depth[3], vec4(block.depth[2], sides.right.y, block.depth[1], sides.below.y)));
}

// A texel of level 1 with what the combination wants to know of its pixels.
struct Reduced {
    RawTexel texel;
    RawTexel second; // its second surface
    vec2 slope; // depth steps from pixel to pixel, in pixel widths
    vec4 areas;
};

Reduced reducePlain(Block block, Sides sides, float width) {
    vec4 areas = plainAreas(block, sides, width);
    vec3 light = areas.x * block.light[0] + areas.y * block.light[1] + areas.z * block.light[2] + areas.w * block.light[3];
    vec4 depth = vec4(block.depth[0], block.depth[1], block.depth[2], block.depth[3]);
    vec2 steps = vec2(depth.y - depth.x + depth.w - depth.z, depth.z - depth.x + depth.w - depth.y);
    RawTexel texel = RawTexel(0.25 * light, dot(areas, vec4(0.25)), 1.0, dot(depth, vec4(0.25)), block.material[0], false);
    return Reduced(texel, emptyTexel(), steps * (0.5 / width), areas);
}

// Which pixels are on the surface that has more of them.
bvec4 heavierHalf(RawTexel pixels[4]) {
    vec2 range = depthRange(pixels, noRange);
    bool isOne = range.y - range.x <= separationAt(1, range.x);
    bvec4 near = nearerHalf(pixels, range);
    bvec4 valid;
    float balance = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        valid[i] = pixels[i].mass > 0.0;
        balance += near[i] ? pixels[i].mass : -pixels[i].mass;
    }
    bvec4 far = bvec4(uvec4(valid) & uvec4(not(near)));
    return isOne ? valid : balance >= 0.0 ? near : far;
}

// Not finite light is no light and drops the pixel, as not finite depth does, so that nothing near is taken for smooth.
Reduced reduceAny(Block block, Sides sides) {
    Reduced result;
    result.areas = anyAreas(block, sides);
    RawTexel pixels[4];
    bool dropped = false;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        bool gives = block.depth[i] > 0.0 && isFinite(block.light[i]);
        dropped = dropped || (block.material[i] != 0u && !gives);
        pixels[i] = emptyTexel();
        result.areas[i] = gives ? result.areas[i] : 1.0;
        if (gives) {
            vec3 light = result.areas[i] * block.light[i];
            pixels[i] = RawTexel(light, result.areas[i], 1.0, block.depth[i], block.material[i], false);
        }
    }
    bvec4 kept = bvec4(true);
    result.second = emptyTexel();
    if (secondLevels > 0) {
        kept = heavierHalf(pixels);
        result.second = mergeTexels(pixels, not(kept));
    } else if (!isOneSurface(pixels, 1)) {
        kept = chooseSurface(pixels, 1);
    }
    result.texel = mergeTexels(pixels, kept);
    result.texel.dropped = result.texel.dropped || dropped;
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    [[unroll]] for (int i = 0; i < 2; ++i) {
        bool pairX = kept[2 * i] && kept[2 * i + 1];
        bool pairY = kept[i] && kept[i + 2];
        steps += vec2(pairX ? pixels[2 * i + 1].depth - pixels[2 * i].depth : 0.0,
                      pairY ? pixels[i + 2].depth - pixels[i].depth : 0.0);
        pairs += vec2(pairX, pairY);
    }
    result.slope = steps / (max(pairs, vec2(1.0)) * texelWidth(0, result.texel.depth));
    return result;
}

float surfaceStep(float a, float b) {
    return min(a, b) > 0.0 ? abs(a - b) : 0.0;
}

float longestSurfaceStep(float before, float first, float second, float after) {
    return max(max(surfaceStep(before, first), surfaceStep(first, second)), surfaceStep(second, after));
}

// Whether a block that is not plain, or a pixel beside it, is no place for plain weights.
bool isRough(Block block, Sides sides) {
    vec4 depth = vec4(block.depth[0], block.depth[1], block.depth[2], block.depth[3]);
    float longest = max(max(longestSurfaceStep(sides.left.x, depth.x, depth.y, sides.right.x),
                            longestSurfaceStep(sides.left.y, depth.z, depth.w, sides.right.y)),
                        max(longestSurfaceStep(sides.above.x, depth.x, depth.z, sides.below.x),
                            longestSurfaceStep(sides.above.y, depth.y, depth.w, sides.below.y)));
    vec4 leastBeside = min(min(vec4(sides.left, sides.right), vec4(sides.above, sides.below)), depth);
    bool hasHole = min(min(leastBeside.x, leastBeside.y), min(leastBeside.z, leastBeside.w)) == 0.0;
    float width = texelWidth(0, max(max(depth.x, depth.y), max(depth.z, depth.w)));
    return longest > (hasHole ? bankSmoothHoleDepth : bankSmoothDepth) * width;
}

Reduced reduceBlock(Block block, int place, ivec2 texel) {
    Sides sides = sidesOf(place);
    float width = texelWidth(0, block.depth[0]);
    Reduced reduced;
    bool plain = isPlain(block, sides, width);
    if (plain) {
        reduced = reducePlain(block, sides, width);
        plain = isFinite(reduced.texel.light);
    }
    if (!plain) {
        reduced = reduceAny(block, sides);
        bool rough = reduced.texel.dropped || isRough(block, sides);
        atomicOr(roughness, notPlain | (rough ? tileRough(texel, side) : 0u));
    }
    return reduced;
}

// In shared memory, at its place there, and in the pyramid.
void storeSurfaces(Surfaces surfaces, int place, int level, ivec2 texel) {
    int index = texelIndex(level, texel);
    uvec4 packed = packRaw(surfaces.first);
    if (keepsSeconds(level) && surfaces.second.mass > 0.0) {
        packed.w |= secondBit;
        uvec4 second = packRaw(surfaces.second);
        seconds[place] = second;
        secondTexels[3 * index] = second.xy;
        secondTexels[3 * index + 1] = second.zw;
    }
    texels[place] = packed;
    rawTexels[index] = packed;
}

RawTexel secondOf(int place) {
    return (texels[place].w & secondBit) != 0u ? unpackRaw(seconds[place]) : emptyTexel();
}

void reduceLevel(int level, ivec2 tile, int thread) {
    int width = tileSize >> level;
    if (thread >= width * width) {
        return;
    }
    ivec2 texel = ivec2(thread % width, thread / width);
    int spacing = 1 << (level - 2); // between the children, in texels of level 1
    int first = (texel.y * side + texel.x) * 2 * spacing;
    RawTexel children[4];
    RawTexel others[4];
    for (int i = 0; i < 4; ++i) {
        int place = first + ((i & 1) + (i >> 1) * side) * spacing;
        children[i] = unpackRaw(texels[place]);
        others[i] = keepsSeconds(level) ? secondOf(place) : emptyTexel();
    }
    Surfaces surfaces = keepsSeconds(level) ? reduceSurfaces(children, others, level)
                                                  : Surfaces(reduceTexels(children, level), emptyTexel());
    storeSurfaces(surfaces, first, level, tile * width + texel);
}

// Sums of a plain tile's texels, which all are full.
struct PlainSum {
    vec4 lightAndArea;
    float depth;
};

void addTexel(inout PlainSum sum, uvec4 words) {
    vec2 blueArea = unpackHalf2x16(words.y);
    sum.lightAndArea += blueArea.y * vec4(unpackHalf2x16(words.x), blueArea.x, 1.0);
    sum.depth += uintBitsToFloat(words.z);
}

uvec4 storeMean(int level, ivec2 texel, PlainSum sum, float count, uint lastWord) {
    vec3 light = sum.lightAndArea.rgb / sum.lightAndArea.a;
    uvec4 words = uvec4(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, sum.lightAndArea.a / count)),
                        floatBitsToUint(sum.depth / count), lastWord);
    rawTexels[texelIndex(level, texel)] = words;
    return words;
}

PlainSum sumTexels(ivec2 first, int span) {
    PlainSum sum = PlainSum(vec4(0.0), 0.0);
    for (int i = 0; i < span * span; ++i) {
        addTexel(sum, texels[(first.y + i / span) * side + first.x + i % span]);
    }
    return sum;
}

// The coarser levels of a plain tile: levels 2 and 3 at once, by different subgroups, both from level 1.
void reducePlainTile(ivec2 tile, int thread) {
    uint lastWord = texels[0].w; // full, and a material of the surface's
    if (thread < 16) {
        ivec2 texel = ivec2(thread & 3, thread >> 2);
        storeMean(2, 4 * tile + texel, sumTexels(2 * texel, 2), 4.0, lastWord);
    } else if (thread >= 32 && thread < 36) {
        ivec2 texel = ivec2(thread & 1, thread >> 1 & 1);
        plainTexels[thread - 32] = storeMean(3, 2 * tile + texel, sumTexels(4 * texel, 4), 16.0, lastWord);
    }
    barrier();
    if (thread == 0) {
        PlainSum sum = PlainSum(vec4(0.0), 0.0);
        for (int i = 0; i < 4; ++i) {
            addTexel(sum, plainTexels[i]);
        }
        storeMean(4, tile, sum, 4.0, lastWord);
    }
}

// A tile without subsurface pixels: the pyramid is empty there, and the light leaves where it enters. It is fetched once
// more, row by row, so that it is stored so, too.
void emptyTile(ivec2 tile, ivec2 texel, int thread) {
    bool hasAlbedo = hasFlag(flagAlbedo);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 local = tile * tileSize + ivec2(thread % tileSize, thread / tileSize + 4 * i);
        vec3 light = texelFetch(irradianceImage, imagePixel(local), 0).rgb;
        vec3 albedo = hasAlbedo ? texelFetch(albedoImage, imagePixel(local), 0).rgb : vec3(1.0);
        if (isInExtent(local)) {
            imageStore(scatteredImage, local + view.areaOffset, vec4(light * albedo, 1.0));
        }
    }
    int index = texelIndex(1, tile * side + texel);
    rawTexels[index] = uvec4(0u);
    quads[index] = uvec2(0u);
    for (int level = 2; level <= rawLevels; ++level) {
        int width = tileSize >> level;
        if (thread < width * width) {
            rawTexels[texelIndex(level, tile * width + ivec2(thread % width, thread / width))] = uvec4(0u);
        }
    }
}

void clearDispatches() {
    dispatches[0] = BankDispatch(0u, 1u, 1u, 0u);
    dispatches[1] = BankDispatch(0u, 1u, edgeParts, 0u);
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    ivec2 first = tile * tileSize + 2 * texel;
    if (thread == 0) {
        occupied = 0u;
        roughness = 0u;
    }
    barrier();
    // Everything is fetched before anything is asked, so that the fetches overlap.
    Block block = fetchBlock(first);
    RingPixel ring = fetchRing(tile * tileSize, thread);
    if ((block.material[0] | block.material[1] | block.material[2] | block.material[3]) != 0u) {
        atomicOr(occupied, 1u);
    }
    barrier();
    if (thread == 0 && tile == ivec2(0)) {
        clearDispatches();
    }
    if (occupied == 0u) {
        if (thread == 0) {
            tileEntries[tileIndex(tile)] = 0u;
        }
        emptyTile(tile, texel, thread);
        return;
    }
    decodeBlock(block, first);
    int place = depthPlace(2 * texel);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        depths[place + (i & 1) + (i >> 1) * pitch] = block.depth[i];
    }
    depths[ring.place] = receivingDepth(ring.material, ring.pixel, ring.depth);
    barrier();
    Reduced reduced = reduceBlock(block, place, texel);
    storeSurfaces(Surfaces(reduced.texel, reduced.second), thread, 1, tile * side + texel);
    int index = texelIndex(1, tile * side + texel);
    storeQuad(index, Quad(reduced.texel.depth, weightsBeside(reduced.slope),
                          uvec2(block.material[0] | block.material[1] << 16, block.material[2] | block.material[3] << 16)));
    quadAreas[index] = packAreas(reduced.areas);
    barrier();
    if (thread == 0) {
        tileEntries[tileIndex(tile)] = tileOccupied | (roughness & ~notPlain);
    }
    if (roughness == 0u) {
        reducePlainTile(tile, thread);
        return;
    }
    for (int level = 2; level <= rawLevels; ++level) {
        reduceLevel(level, tile, thread);
        barrier();
    }
}
