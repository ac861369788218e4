// How passes A and B of `bank` make a texel of four of the level below. docs/scatter.md. Included by them
// after bank.glsl.

bool keepsSeconds(int level) {
    return secondLevels > 0 && level <= secondLevels;
}

// Depths further apart than this, in mm, are two surfaces of a texel whose nearest depth this is.
float separationAt(int level, float nearest) {
    return (keepsSeconds(level) ? bankSecondSeparation : bankSurfaceSeparation) * texelWidth(level, nearest);
}

const vec2 noRange = vec2(1e30, 0.0);

// Nearest and farthest depth of the texels that are not empty.
vec2 depthRange(ReducedTexel texels[4]) {
    vec2 range = noRange;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        float depth = texels[i].depth;
        range = vec2(texels[i].coverage > 0.0 ? min(range.x, depth) : range.x, max(range.y, depth)); // 0 where it is empty
    }
    return range;
}

// Which of four texels the next level's texel keeps: those of one surface, nearest or farthest, whichever has more
// coverage; and of those, where materials are separate, the ones that exchange light with the heaviest.
bvec4 chooseSurface(ReducedTexel texels[4], int level) {
    vec2 range = depthRange(texels);
    float separation = separationAt(level, range.x);
    float front = 0.0; // coverage within reach of the nearest depth,
    float back = 0.0;  // and of the farthest; both are all of it where all is one surface
    [[unroll]] for (int i = 0; i < 4; ++i) { // an empty texel has no coverage
        front += texels[i].depth <= range.x + separation ? texels[i].coverage : 0.0;
        back += texels[i].depth >= range.y - separation ? texels[i].coverage : 0.0;
    }
    float surface = front >= back ? range.x : range.y;
    bvec4 kept;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        kept[i] = texels[i].coverage > 0.0 && abs(texels[i].depth - surface) <= separation;
    }
    if (separateMaterials) {
        float heaviest = 0.0;
        uint material = 0u;
        for (int i = 0; i < 4; ++i) {
            if (kept[i] && texels[i].coverage > heaviest) {
                heaviest = texels[i].coverage;
                material = texels[i].material;
            }
        }
        for (int i = 0; i < 4; ++i) {
            kept[i] = kept[i] && exchanges(texels[i].material, material);
        }
    }
    return kept;
}

// The next level's texel from the kept of the four below it.
ReducedTexel mergeTexels(ReducedTexel texels[4], bvec4 kept) {
    ReducedTexel result = emptyTexel();
    float heaviest = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        if (kept[i]) {
            result.light += 0.25 * texels[i].light;
            result.area += 0.25 * texels[i].area;
            result.coverage += 0.25 * texels[i].coverage;
            result.depth += 0.25 * texels[i].coverage * texels[i].depth;
            if (separateMaterials && texels[i].coverage > heaviest) {
                heaviest = texels[i].coverage;
                result.material = texels[i].material;
            }
        }
        result.dropped = result.dropped || (kept[i] ? texels[i].dropped : texels[i].coverage > 0.0);
    }
    result.depth = result.coverage > 0.0 ? result.depth / result.coverage : 0.0;
    return result;
}

ReducedTexel reduceTexels(ReducedTexel texels[4], int level) {
    return mergeTexels(texels, chooseSurface(texels, level));
}
