// How pass B of `bank` loads a block's texels into shared memory: those of pass A as they are, the coarser levels' reduced.
// docs/scatter.md. Included by pass B. Uses its `threads`, Block, texelBits and noteBits, and what it has in shared memory:
// lights, depths, coveragesAndMaterials and those of second surfaces.

// A texel's words; those of an empty one outside the level.
uvec4 reducedWords(int level, ivec2 texel) {
    ivec2 inside = clamp(texel, ivec2(0), levelExtent(level) - 1);
    uvec4 words = reducedTexels[texelIndex(level, inside)];
    return texel == inside ? words : uvec4(0u);
}

void storeShared(ivec2 place, uvec4 words) {
    int index = sharedIndex(place);
    lights[index] = words.xy;
    depths[index] = depthOf(words);
    coveragesAndMaterials[index] = words.w;
}

void storeSharedSecond(ivec2 place, uvec4 words) {
    int index = sharedIndex(place);
    secondLights[index] = words.xy;
    secondDepths[index] = depthOf(words);
}

// Of the second surface of a texel of a level that pass A has reduced. `word`: the last of its own.
uvec4 secondWords(int level, ivec2 texel, uint word) {
    return hasSecond(word) ? secondTexels[texelIndex(level, texel)] : uvec4(0u);
}

// Of the texels that a block loads, counted row by row.
ivec2 loadedPlace(int index) {
    int row = int((float(index) + 0.5) / float(pitch));
    return ivec2(index - row * pitch, row);
}

const int loadSteps = (loadedCount + threads - 1) / threads;

// All fetches before any of them is used, so that they overlap.
void loadBlock(Block block, int thread) {
    uvec4 words[loadSteps];
    [[unroll]] for (int i = 0; i < loadSteps; ++i) {
        words[i] = reducedWords(block.level, block.first - reach + loadedPlace(thread + i * threads));
    }
    uint bits = 0u;
    [[unroll]] for (int i = 0; i < loadSteps; ++i) {
        ivec2 place = loadedPlace(thread + i * threads);
        if (place.y < loadedSize(block).y) {
            storeShared(place, words[i]);
            bits |= texelBits(words[i]);
        }
    }
    noteBits(bits);
}

// The second surfaces of what loadBlock has loaded, only where there are any.
void loadSeconds(Block block, int thread) {
    [[unroll]] for (int i = 0; i < loadSteps; ++i) {
        ivec2 place = loadedPlace(thread + i * threads);
        if (place.y < loadedSize(block).y) {
            uint word = coveragesAndMaterials[sharedIndex(place)];
            storeSharedSecond(place, secondWords(block.level, block.first - reach + place, word));
        }
    }
}

// Of the texels around a block only those inside it are this workgroup's to store.
bool isOwn(Block block, ivec2 texel) {
    ivec2 last = min(block.first + block.size, levelExtent(block.level));
    return all(greaterThanEqual(texel, block.first)) && all(lessThan(texel, last));
}

// What this workgroup has reduced: for its own kernels, and of its own texels for pass C.
void storeReduced(Block block, ivec2 place, ivec2 texel, uvec4 words) {
    storeShared(place, words);
    if (isOwn(block, texel)) {
        reducedTexels[texelIndex(block.level, texel)] = words;
    }
    noteBits(texelBits(words));
}

// A texel of a level that pass A leaves to this one.
ReducedTexel reducedTexel(int level, ivec2 texel) {
    ReducedTexel children[4];
    [[unroll]] for (int i = 0; i < 4; ++i) {
        children[i] = unpackReduced(reducedWords(level - 1, 2 * texel + ivec2(i & 1, i >> 1)));
    }
    return reduceTexels(children, level);
}

// The coarsest level's texels from their children, which are loaded.
void reduceToCoarsest(Block block, int thread) {
    const ivec2 size = coarsestSize + 2 * reach;
    ivec2 place = ivec2(thread % size.x, thread / size.x);
    ivec2 texel = block.first - reach + place;
    bool isLoaded = place.y < size.y;
    uvec4 words = uvec4(0u);
    if (isLoaded && isInLevel(bankLevels, texel)) {
        ReducedTexel children[4];
        [[unroll]] for (int i = 0; i < 4; ++i) {
            children[i] = texelAt(sharedIndex(2 * place + ivec2(i & 1, i >> 1)));
        }
        words = packReduced(reduceTexels(children, bankLevels));
    }
    barrier();
    if (isLoaded) {
        storeReduced(block, place, texel, words);
    }
}

// Of the level after pass A's, and of the coarsest one, for which the former is reduced first.
void loadCoarseBlock(Block block, int thread) {
    const int level = tileLevels + 1;
    bool isCoarsest = block.level == bankLevels;
    ivec2 first = (block.first - reach) * (isCoarsest ? 2 : 1);
    for (int index = thread; index < loadedCount; index += threads) {
        ivec2 place = loadedPlace(index);
        ivec2 texel = first + place;
        uvec4 words = isInLevel(level, texel) ? packReduced(reducedTexel(level, texel)) : uvec4(0u);
        if (isCoarsest) {
            storeShared(place, words);
        } else {
            storeReduced(block, place, texel, words);
        }
    }
    if (isCoarsest) {
        barrier();
        reduceToCoarsest(block, thread);
    }
}

// A texel of the level after pass A's with both surfaces. The coarsest level is made of first ones alone.
Surfaces reducedSurfaces(int level, ivec2 texel) {
    uvec4 firsts[4];
    uvec4 seconds[4];
    vec2 range = noRange;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 child = 2 * texel + ivec2(i & 1, i >> 1);
        firsts[i] = reducedWords(level - 1, child);
        seconds[i] = secondWords(level - 1, child, firsts[i].w);
        range = includeDepth(includeDepth(range, depthOf(firsts[i])), depthOf(seconds[i]));
    }
    range = rangeOfSurfaces(range, level);
    Surfaces surfaces = Surfaces(emptyTexel(), emptyTexel());
    [[unroll]] for (int i = 0; i < 4; ++i) {
        addToNearer(surfaces, unpackReduced(firsts[i]), range);
        addToNearer(surfaces, unpackReduced(seconds[i]), range);
    }
    return orderSurfaces(surfaces);
}

void loadSecondsBlock(Block block, int thread) {
    for (int index = thread; index < loadedCount; index += threads) {
        ivec2 place = loadedPlace(index);
        ivec2 texel = block.first - reach + place;
        uvec4 words = uvec4(0u);
        uvec4 second = uvec4(0u);
        if (isInLevel(block.level, texel)) {
            Surfaces surfaces = reducedSurfaces(block.level, texel);
            words = packFirst(surfaces);
            second = packReduced(surfaces.second);
        }
        storeReduced(block, place, texel, words);
        storeSharedSecond(place, second);
        if (hasSecond(words.w) && isOwn(block, texel)) {
            secondTexels[texelIndex(block.level, texel)] = second;
        }
    }
}
