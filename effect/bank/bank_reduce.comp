// Pass A of `bank`: levels 1 to 4 of the pyramid, a tile of 16x16 px a workgroup, 2x2 px a thread; notes which tiles hold
// subsurface pixels, and copies the tiles that hold none. docs/scatter.md.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "bank.glsl"
#include "bank_reduction.glsl"
#include "bank_surfaces.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const int side = tileSize / 2; // texels of level 1

// Level 1 as ReducedTexel has it; where the tile is not one surface, each coarser level then stands at its first child's place.
shared vec4 lightsAndAreas[side * side];
shared vec2 depthsAndCoverages[side * side]; // coverage: negative where pixels were dropped
shared uint texelMaterials[separateMaterials ? side * side : 1];
shared vec4 surfaceLights[4]; // SurfaceSum of the level 3 of a tile of one surface
shared vec2 surfaceDepths[4];
// Of the tile's pixels and one around, mm; 0 where none receives light. As bits, since once level 1 is made its second surfaces
// stand there, in the words of packReduced: with more shared memory fewer workgroups run at a time.
const int pitch = tileSize + 2;
shared uint depths[pitch * pitch];
shared uint occupied; // whether some pixel has an id
shared uint tileBits; // tileStepBit of the tile's quads, tileBright, and notFull
// Of a tile that is not unbroken, nearest and farthest depth of level 1, as bits, whose order is the depths'.
shared uint nearest;
shared uint farthest;
// A pixel of some quad is on no surface, or on another than the quad's, or makes a long step. With second surfaces: some quad
// is not continuous.
const uint notFull = 1u;

#include "bank_quad.glsl"

void storeSharedSecond(int place, uvec4 words) {
    [[unroll]] for (int i = 0; i < 4; ++i) {
        depths[i * side * side + place] = words[i];
    }
}

uvec4 sharedSecond(int place) {
    uvec4 words;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        words[i] = depths[i * side * side + place];
    }
    return words;
}

// In shared memory, at its place there, and in the pyramid. `quadBits`: on level 1 areasBit, spreadBit and packQuad. Returns
// the second surface, which is in the pyramid alone.
uvec4 storeSurfaces(Surfaces surfaces, int place, int level, ivec2 texel, uvec3 quadBits) {
    ReducedTexel first = surfaces.first;
    lightsAndAreas[place] = vec4(first.light, first.area);
    depthsAndCoverages[place] = vec2(first.depth, first.dropped ? -first.coverage : first.coverage);
    if (separateMaterials) {
        texelMaterials[place] = first.material;
    }
    int index = texelIndex(level, texel);
    uvec4 words = packReduced(first);
    words.yzw = level == 1 ? uvec3(words.yz | quadBits.xy, quadBits.z) : words.yzw;
    uvec4 second = uvec4(0u);
    if (secondLevels > 0 && surfaces.second.coverage > 0.0) {
        second = packReduced(surfaces.second);
        words.w |= secondBit;
        secondTexels[index] = second;
    }
    reducedTexels[index] = words;
    return second;
}

ReducedTexel texelAt(int place) {
    vec4 lightAndArea = lightsAndAreas[place];
    vec2 depthAndCoverage = depthsAndCoverages[place];
    return ReducedTexel(lightAndArea.rgb, lightAndArea.a, abs(depthAndCoverage.y), depthAndCoverage.x,
                    separateMaterials ? texelMaterials[place] : 0u, depthAndCoverage.y < 0.0);
}

// The four texels of the level below in shared memory: the first, and how far it is to the next.
struct Children {
    int first;
    int spacing;
};

int childPlace(Children children, int i) {
    return children.first + ((i & 1) + (i >> 1) * side) * children.spacing;
}

Surfaces reduceOne(Children children, int level) {
    ReducedTexel texels[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        texels[i] = texelAt(childPlace(children, i));
    }
    return Surfaces(reduceTexels(texels, level), emptyTexel());
}

// With their second surfaces.
Surfaces reduceBoth(Children children, int level) {
    vec2 range = noRange;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = childPlace(children, i);
        range = includeDepth(range, depthsAndCoverages[place].x);
        range = includeDepth(range, depthOf(sharedSecond(place)));
    }
    range = rangeOfSurfaces(range, level);
    Surfaces surfaces = Surfaces(emptyTexel(), emptyTexel());
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int place = childPlace(children, i);
        addToNearer(surfaces, texelAt(place), range);
        addToNearer(surfaces, unpackReduced(sharedSecond(place)), range);
    }
    return orderSurfaces(surfaces);
}

void reduceLevel(int level, ivec2 tile, int thread) {
    int shift = tileLevels - level; // of the level's texels a side in a tile
    if (thread >> 2 * shift != 0) {
        return;
    }
    ivec2 texel = ivec2(thread & (1 << shift) - 1, thread >> shift);
    int spacing = 1 << (level - 2);
    Children children = Children((texel.y * side + texel.x) * 2 * spacing, spacing);
    Surfaces surfaces = secondLevels > 0 ? reduceBoth(children, level) : reduceOne(children, level);
    uvec4 second = storeSurfaces(surfaces, children.first, level, (tile << shift) + texel, uvec3(0u));
    if (secondLevels > 0) {
        storeSharedSecond(children.first, second);
    }
}

// Whether one surface is all that a tile holds, with or without holes: no texel of level 1 has left a pixel out or is two, and
// all lie so close to each other that none of the coarser levels takes them for two. A barrier, for all threads. `place`: a
// texel a thread.
bool isOneSurface(int place, bool hasSecond) {
    vec2 depthAndCoverage = depthsAndCoverages[place];
    if (depthAndCoverage.y != 0.0) {
        bool isTwo = hasSecond || depthAndCoverage.y < 0.0;
        atomicMin(nearest, floatBitsToUint(depthAndCoverage.x));
        atomicMax(farthest, floatBitsToUint(isTwo ? 1e30 : depthAndCoverage.x));
    }
    barrier();
    float near = uintBitsToFloat(nearest);
    return uintBitsToFloat(farthest) - near <= separationAt(2, near);
}

// Sums of texels of level 1 that all are one surface.
struct SurfaceSum {
    vec4 lightAndArea;
    vec2 depthAndCoverage; // depth times coverage
};

SurfaceSum noSurface() {
    return SurfaceSum(vec4(0.0), vec2(0.0));
}

SurfaceSum sumTexels(ivec2 first, int span) {
    SurfaceSum sum = noSurface();
    for (int i = 0; i < span * span; ++i) {
        int place = (first.y + i / span) * side + first.x + i % span;
        vec2 depthAndCoverage = depthsAndCoverages[place];
        sum.lightAndArea += lightsAndAreas[place];
        sum.depthAndCoverage += vec2(depthAndCoverage.x, 1.0) * depthAndCoverage.y;
    }
    return sum;
}

// `each`: what one of the texels of level 1 that were summed counts.
void storeMean(int level, ivec2 texel, SurfaceSum sum, float each) {
    vec4 mean = each * sum.lightAndArea;
    float coverage = sum.depthAndCoverage.y;
    float depth = sum.depthAndCoverage.x / max(coverage, 1e-20);
    reducedTexels[texelIndex(level, texel)] = packReduced(ReducedTexel(mean.rgb, mean.a, each * coverage, depth, 0u, false));
}

// The coarser levels of a tile of one surface: levels 2 and 3 at once, by different subgroups, both from level 1.
void reduceOneSurface(ivec2 tile, int thread) {
    if (thread < 16) {
        ivec2 texel = ivec2(thread & 3, thread >> 2);
        storeMean(2, 4 * tile + texel, sumTexels(2 * texel, 2), 1.0 / 4.0);
    } else if (thread >= 32 && thread < 36) {
        ivec2 texel = ivec2(thread & 1, thread >> 1 & 1);
        SurfaceSum sum = sumTexels(4 * texel, 4);
        surfaceLights[thread - 32] = sum.lightAndArea;
        surfaceDepths[thread - 32] = sum.depthAndCoverage;
        storeMean(3, 2 * tile + texel, sum, 1.0 / 16.0);
    }
    barrier();
    if (thread == 0) {
        SurfaceSum sum = noSurface();
        for (int i = 0; i < 4; ++i) {
            sum.lightAndArea += surfaceLights[i];
            sum.depthAndCoverage += surfaceDepths[i];
        }
        storeMean(4, tile, sum, 1.0 / 64.0);
    }
}

// Returns the second surface.
uvec4 storeQuad(ReducedQuad reduced, uvec2 materials, ivec2 tile, ivec2 texel) {
    int index = texelIndex(1, tile * side + texel);
    uint word = packQuad(reduced.weights & ~spreadBit, materials, separateMaterials ? reduced.texel.material : 0u);
    if (isMixed(word)) {
        quadMaterials[index] = materials;
    }
    if (!reduced.shareArea) {
        quadAreas[index] = packAreas(reduced.areas);
    }
    return storeSurfaces(Surfaces(reduced.texel, reduced.second), texel.y * side + texel.x, 1, tile * side + texel,
                         uvec3(reduced.shareArea ? 0u : areasBit, reduced.weights & spreadBit, word));
}

// The light of a tile without subsurface pixels leaves where it enters, row by row.
void copyTile(ivec2 tile, int thread) {
    bool hasAlbedo = hasFlag(flagAlbedo);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 local = tile * tileSize + ivec2(thread % tileSize, thread / tileSize + 4 * i);
        vec3 light = texelFetch(irradianceImage, ownPixel(local), 0).rgb;
        vec3 albedo = hasAlbedo ? texelFetch(albedoImage, ownPixel(local), 0).rgb : vec3(1.0);
        if (isBeforeEnd(local)) {
            imageStore(scatteredImage, local + view.areaOffset, vec4(light * albedo, 1.0));
        }
    }
}

// The pyramid is empty there: 16 texels of level 2, four of level 3, one of level 4, a texel a thread. Of level 1 nothing is
// written: pass C knows which tiles are empty.
void clearTile(ivec2 tile, int thread) {
    int level = thread < 16 ? 2 : thread < 20 ? 3 : 4;
    int texel = thread < 16 ? thread : thread & 3;
    int width = tileSize >> level;
    if (thread <= 20) {
        reducedTexels[texelIndex(level, tile * width + ivec2(texel % width, texel / width))] = uvec4(0u);
    }
}

void clearDispatches() {
    dispatches[0] = BankDispatch(0u, 1u, 1u, 0u);
    dispatches[1] = BankDispatch(0u, 1u, 1u, 0u);
}

void main() {
    int thread = int(gl_LocalInvocationIndex);
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 texel = quadOrder(thread, side);
    ivec2 first = tile * tileSize + 2 * texel;
    uvec4 ids = fetchIds(first);
    if (thread == 0) {
        occupied = 0u;
        tileBits = 0u;
        nearest = ~0u;
        farthest = 0u;
        if (tile == ivec2(0)) {
            clearDispatches();
        }
    }
    barrier();
    if (ids != uvec4(0u)) {
        atomicOr(occupied, 1u);
    }
    barrier();
    if (occupied == 0u) {
        if (thread == 0) {
            tileEntries[tileIndex(tile)] = 0u;
        }
        if (!hasFlag(flagSkipUnscattered)) {
            copyTile(tile, thread);
        }
        clearTile(tile, thread);
        return;
    }
    // Its ids were fetched first, so that an empty tile ends sooner; all the rest before anything is asked, so that fetches
    // overlap.
    RingPixel ring = fetchRing(tile * tileSize, ringPlace(thread));
    QuadPixels quad = fetchQuad(first, ids);
    decodeQuad(quad, first);
    int place = depthPlace(2 * texel);
    [[unroll]] for (int i = 0; i < 4; ++i) {
        depths[place + (i & 1) + (i >> 1) * pitch] = floatBitsToUint(quad.depth[i]);
    }
    depths[ring.place] = floatBitsToUint(receivingDepth(ring.material, ring.pixel, ring.depth));
    barrier();
    uvec2 materials = uvec2(quad.material[0] | quad.material[1] << 16, quad.material[2] | quad.material[3] << 16);
    uvec4 second = storeQuad(reduceQuad(quad, place, texel), materials, tile, texel);
    barrier();
    if (thread == 0) {
        tileEntries[tileIndex(tile)] = tileOccupied | (tileBits & ~notFull);
    }
    // A tile is unbroken where no pixel is missing and no step from pixel to pixel is longer than bankSmoothDepth pixel widths
    // (with second surfaces: bankContinuedStep), so that the four that a texel is made of are no further apart than
    // bankSurfaceSeparation (bankSecondSeparation) times its width: one surface on every level.
    bool isUnbroken = (tileBits & ~tileBright) == 0u;
    if (!separateMaterials && (isUnbroken || isOneSurface(texel.y * side + texel.x, second != uvec4(0u)))) {
        reduceOneSurface(tile, thread);
        return;
    }
    if (secondLevels > 0) {
        storeSharedSecond(texel.y * side + texel.x, second);
        barrier();
    }
    [[unroll]] for (int level = 2; level <= tileLevels; ++level) {
        reduceLevel(level, tile, thread);
        barrier();
    }
}
