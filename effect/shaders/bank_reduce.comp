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

#include "bank_block.glsl"

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

void storeQuad(int index, Quad quad) {
    bool mixed = quad.materials != uvec2((quad.materials.x & 0xffffu) * 0x10001u);
    uvec2 beside = uvec2(254.0 * quad.beside + 0.5);
    quads[index] = uvec2(floatBitsToUint(quad.depth),
                         beside.x | beside.y << 7 | (mixed ? mixedBit : quad.materials.x << 16));
    if (mixed) {
        quadMaterials[index] = quad.materials;
    }
}

// A tile without subsurface pixels: the pyramid is empty there, and the light leaves where it enters. It is fetched once
// more, row by row, so that it is stored so, too.
void emptyTile(ivec2 tile, ivec2 texel, int thread) {
    bool hasAlbedo = hasFlag(flagAlbedo);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 local = tile * tileSize + ivec2(thread % tileSize, thread / tileSize + 4 * i);
        vec3 light = texelFetch(irradianceImage, ownPixel(local), 0).rgb;
        vec3 albedo = hasAlbedo ? texelFetch(albedoImage, ownPixel(local), 0).rgb : vec3(1.0);
        if (isBeforeEnd(local)) {
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
