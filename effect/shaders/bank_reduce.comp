// Pass A of `bank`: levels 1 to 5 of the pyramid, 32x32 px a workgroup, 2x2 px a thread; notes which tiles hold
// subsurface pixels, and copies the tiles that hold none. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

const int threads = 256;
const int side = 16; // texels of level 1

// Level 1; each coarser level then stands at its first child's place.
shared uvec4 texels[side * side];
shared uint occupied;
// Of the tile's pixels and one around, mm; 0 where none receives light.
const int pitch = tileSize + 2;
shared float depths[pitch * pitch];

// What is fetched of a 2x2 block: everything before anything is asked, so that the fetches overlap.
struct Fetched {
    uint id[4];
    float depth[4];
    vec3 light[4];
};

ivec2 pixelOf(ivec2 first, int i) {
    return min(first + ivec2(i & 1, i >> 1), view.areaExtent - 1) + view.areaOffset;
}

Fetched fetchPixels(ivec2 first) {
    Fetched fetched;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 pixel = pixelOf(first, i);
        fetched.id[i] = texelFetch(materialIdImage, pixel, 0).r;
        fetched.depth[i] = texelFetch(depthImage, pixel, 0).r;
        fetched.light[i] = texelFetch(irradianceImage, pixel, 0).rgb;
    }
    return fetched;
}

// The tile's ring of pixels around: one a thread.
void loadRing(ivec2 tileFirst, int thread) {
    ivec2 place = ringPosition(min(thread, 4 * tileSize + 3), ivec2(tileSize));
    ivec2 local = tileFirst + place;
    ivec2 inside = clamp(local, ivec2(0), view.areaExtent - 1);
    float z = viewZ(inside + view.areaOffset);
    bool receives = local == inside && materialAt(inside + view.areaOffset) != 0u && isValidZ(z);
    depths[(place.y + 1) * pitch + place.x + 1] = receives ? -z : 0.0;
}

// What a pixel is before its neighbours are known.
struct Pixel {
    vec3 light;
    uint material;
    bool gives;
};

// Not finite light is no light; not finite depth is no surface. Either drops the pixel, so that nothing near is taken for
// smooth. `place`: in `depths`, which is filled.
Pixel decodePixel(Fetched fetched, int i, ivec2 first, int place, inout bool receives, inout bool dropped) {
    ivec2 pixel = pixelOf(first, i);
    uint material = materialOfId(fetched.id[i]);
    material = all(lessThan(first + ivec2(i & 1, i >> 1), view.areaExtent)) ? material : 0u;
    float z = viewZ(pixel, fetched.depth[i]);
    vec3 light = fetched.light[i] * albedoBefore(pixel, material);
    bool isOnSurface = material != 0u && isValidZ(z);
    depths[place] = isOnSurface ? -z : 0.0;
    receives = receives || isOnSurface;
    bool gives = isOnSurface && isFinite(light);
    dropped = dropped || (material != 0u && !gives);
    return Pixel(min(light, vec3(maxHalf)), material, gives);
}

RawTexel toTexel(Pixel pixel, int place) {
    if (!pixel.gives) {
        RawTexel empty = emptyTexel();
        empty.material = pixel.material;
        return empty;
    }
    float depth = depths[place];
    float area = areaOf(depth, vec4(depths[place - 1], depths[place + 1], depths[place - pitch], depths[place + pitch]));
    return RawTexel(min(area * pixel.light, vec3(maxHalf)), area, 1.0, depth, pixel.material, false);
}

// Depth steps from pixel to pixel inside a 2x2 block, in pixel widths.
vec2 blockSlope(RawTexel pixels[4], bvec4 kept, float depth) {
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    [[unroll]] for (int i = 0; i < 2; ++i) {
        bool pairX = kept[2 * i] && kept[2 * i + 1];
        bool pairY = kept[i] && kept[i + 2];
        steps += vec2(pairX ? pixels[2 * i + 1].depth - pixels[2 * i].depth : 0.0,
                      pairY ? pixels[i + 2].depth - pixels[i].depth : 0.0);
        pairs += vec2(pairX, pairY);
    }
    return steps / (max(pairs, vec2(1.0)) * texelWidth(0, depth));
}

// A texel of level 1, and its entry of `quads`.
RawTexel reducePixels(RawTexel pixels[4], out Quad quad) {
    bvec4 kept = isOneSurface(pixels, 1) ? bvec4(true) : chooseSurface(pixels, 1);
    RawTexel texel = mergeTexels(pixels, kept);
    quad = Quad(texel.depth, weightsBeside(blockSlope(pixels, kept, texel.depth)),
                uvec2(pixels[0].material | pixels[1].material << 16, pixels[2].material | pixels[3].material << 16));
    return texel;
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
    for (int i = 0; i < 4; ++i) {
        children[i] = unpackRaw(texels[first + ((i & 1) + (i >> 1) * side) * spacing]);
    }
    uvec4 packed = packRaw(reduceTexels(children, level));
    texels[first] = packed;
    rawTexels[texelIndex(level, tile * width + texel)] = packed;
}

// The levels above the first of a tile without subsurface pixels.
void emptyLevels(ivec2 tile, int thread) {
    for (int level = 2; level <= rawLevels; ++level) {
        int width = tileSize >> level;
        if (thread < width * width) {
            rawTexels[texelIndex(level, tile * width + ivec2(thread % width, thread / width))] = uvec4(0u);
        }
    }
}

void copyTile(ivec2 tile, int thread) {
    for (int i = thread; i < tileSize * tileSize; i += threads) {
        ivec2 local = tile * tileSize + ivec2(i % tileSize, i / tileSize);
        if (all(lessThan(local, view.areaExtent))) {
            writeUnscattered(local + view.areaOffset);
        }
    }
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    ivec2 firstPixel = tile * tileSize + 2 * texel;
    if (thread == 0) {
        occupied = 0u;
    }
    if (thread < 4 * tileSize + 4) {
        loadRing(tile * tileSize, thread);
    }
    Fetched fetched = fetchPixels(firstPixel);
    bool receives = false;
    bool dropped = false;
    int place = (2 * texel.y + 1) * pitch + 2 * texel.x + 1;
    Pixel decoded[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        decoded[i] = decodePixel(fetched, i, firstPixel, place + (i & 1) + (i >> 1) * pitch, receives, dropped);
    }
    barrier();
    RawTexel pixels[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        pixels[i] = toTexel(decoded[i], place + (i & 1) + (i >> 1) * pitch);
    }
    Quad quad;
    RawTexel reduced = reducePixels(pixels, quad);
    reduced.dropped = reduced.dropped || dropped;
    uvec4 packed = packRaw(reduced);
    if (receives) {
        atomicOr(occupied, 1u);
    }
    texels[thread] = packed;
    int index = texelIndex(1, tile * side + texel);
    rawTexels[index] = packed;
    storeQuad(index, quad);
    quadAreas[index] = packAreas(max(vec4(pixels[0].area, pixels[1].area, pixels[2].area, pixels[3].area), 1.0));
    barrier();
    if (occupied != 0u) {
        for (int level = 2; level <= rawLevels; ++level) {
            reduceLevel(level, tile, thread);
            barrier();
        }
    } else {
        emptyLevels(tile, thread);
        copyTile(tile, thread);
    }
    if (thread == 0) {
        tileEntries[tile.y * tileCount().x + tile.x] = occupied;
        if (tile == ivec2(0)) {
            dispatches[0] = BankDispatch(0u, 1u, 1u, 0u);
            dispatches[1] = BankDispatch(0u, 1u, 1u, 0u);
        }
    }
}
