// Pass A of `bank`: levels 1 to 5 of the pyramid, 32x32 px a workgroup, 2x2 px a thread; notes which tiles hold
// subsurface pixels, and copies the tiles that hold none. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bank.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

const int side = 16; // texels of level 1

// Level 1; each coarser level then stands at its first child's place.
shared uvec4 texels[side * side];
shared uint occupied;

// A pixel as a texel. Not finite light is no light; not finite depth is no surface. Everything is fetched before
// anything is asked, so that the four pixels' fetches overlap.
RawTexel loadPixel(ivec2 local, out bool receives) {
    ivec2 pixel = min(local, view.areaExtent - 1) + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    vec3 light = enteringLight(pixel, material);
    receives = local == pixel - view.areaOffset && material != 0u && isValidZ(z);
    bool gives = receives && isFinite(light);
    return RawTexel(gives ? min(light, vec3(maxHalf)) : vec3(0.0), 1.0, gives ? 1.0 : 0.0, gives ? -z : 0.0, material,
                    false);
}

// Area of the surface relative to one that faces the camera, from the depth steps inside a 2x2 block.
float blockArea(RawTexel pixels[4], bvec4 kept, float depth) {
    vec2 steps = vec2(0.0);
    vec2 pairs = vec2(0.0);
    for (int i = 0; i < 2; ++i) {
        if (kept[2 * i] && kept[2 * i + 1]) {
            steps.x += pixels[2 * i + 1].depth - pixels[2 * i].depth;
            pairs.x += 1.0;
        }
        if (kept[i] && kept[i + 2]) {
            steps.y += pixels[i + 2].depth - pixels[i].depth;
            pairs.y += 1.0;
        }
    }
    vec2 slope = steps / (max(pairs, vec2(1.0)) * texelWidth(0, depth));
    return min(sqrt(1.0 + dot(slope, slope)), bankLargestArea);
}

RawTexel reducePixels(ivec2 first, out bool receives) {
    RawTexel pixels[4];
    receives = false;
    for (int i = 0; i < 4; ++i) {
        bool pixelReceives;
        pixels[i] = loadPixel(first + ivec2(i & 1, i >> 1), pixelReceives);
        receives = receives || pixelReceives;
    }
    bvec4 kept = chooseSurface(pixels, 1);
    RawTexel texel = reduceTexels(pixels, kept);
    if (texel.mass > 0.0) {
        texel.area *= blockArea(pixels, kept, texel.depth);
    }
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
    uvec4 packed = packRaw(reduceTexels(children, chooseSurface(children, level)));
    texels[first] = packed;
    rawTexels[texelIndex(level, tile * width + texel)] = packed;
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 texel = ivec2(gl_LocalInvocationID.xy);
    ivec2 firstPixel = tile * tileSize + 2 * texel;
    if (thread == 0) {
        occupied = 0u;
    }
    barrier();
    bool receives;
    uvec4 packed = packRaw(reducePixels(firstPixel, receives));
    texels[thread] = packed;
    rawTexels[texelIndex(1, tile * side + texel)] = packed;
    if (receives) {
        atomicOr(occupied, 1u);
    }
    barrier();
    for (int level = 2; level <= rawLevels; ++level) {
        reduceLevel(level, tile, thread);
        barrier();
    }
    if (thread == 0) {
        tileEntries[tile.y * tileCount().x + tile.x] = occupied;
        if (tile == ivec2(0)) {
            dispatches[0] = BankDispatch(0u, 1u, 2u, 0u);
            dispatches[1] = BankDispatch(0u, 1u, 2u, 0u);
        }
    }
    if (occupied == 0u) {
        for (int i = 0; i < 4; ++i) {
            ivec2 local = firstPixel + ivec2(i & 1, i >> 1);
            if (all(lessThan(local, view.areaExtent))) {
                writeUnscattered(local + view.areaOffset);
            }
        }
    }
}
