// How passes A and B of `bank-surfaces` make a texel of two surfaces from those of the level below. docs/scatter.md. Included
// by them after bank_reduction.glsl.

// A texel's two surfaces, the one with more coverage first; the second is empty where all is one surface.
struct Surfaces {
    ReducedTexel first;
    ReducedTexel second;
};

// Nearest and farthest depth of what they are already, and of one more, 0 = none.
vec2 includeDepth(vec2 range, float depth) {
    return vec2(depth > 0.0 ? min(range.x, depth) : range.x, max(range.y, depth));
}

// Adds a texel of the level below, or its second surface, to the surface it belongs to. `first` is the nearer one, for now.
void addToNearer(inout Surfaces surfaces, ReducedTexel texel, vec2 range) {
    bool isNearer = texel.depth - range.x <= range.y - texel.depth;
    float nearer = isNearer ? 0.25 : 0.0; // of the new texel
    float farther = 0.25 - nearer;
    surfaces.first.light += nearer * texel.light;
    surfaces.first.area += nearer * texel.area;
    surfaces.first.coverage += nearer * texel.coverage;
    surfaces.first.depth += nearer * texel.coverage * texel.depth;
    surfaces.first.dropped = surfaces.first.dropped || (isNearer && texel.dropped);
    surfaces.second.light += farther * texel.light;
    surfaces.second.area += farther * texel.area;
    surfaces.second.coverage += farther * texel.coverage;
    surfaces.second.depth += farther * texel.coverage * texel.depth;
    surfaces.second.dropped = surfaces.second.dropped || (!isNearer && texel.dropped);
}

// What `range` is where a level takes all of it for one surface: everything is nearer then.
vec2 rangeOfSurfaces(vec2 range, int level) {
    return range.y - range.x <= separationAt(level, range.x) ? vec2(range.x, 2.0 * range.y) : range;
}

// Of sums of depth times coverage their mean; the surface with more coverage first.
Surfaces orderSurfaces(Surfaces sums) {
    ReducedTexel near = sums.first;
    ReducedTexel far = sums.second;
    bool areTwo = min(near.coverage, far.coverage) > 0.0;
    near.dropped = near.dropped || areTwo;
    far.dropped = far.dropped || areTwo;
    near.depth /= max(near.coverage, 1e-20);
    far.depth /= max(far.coverage, 1e-20);
    return near.coverage >= far.coverage ? Surfaces(near, far) : Surfaces(far, near);
}

// A texel's own words, with a note of whether there is a second surface.
uvec4 packFirst(Surfaces surfaces) {
    uvec4 words = packReduced(surfaces.first);
    words.w |= surfaces.second.coverage > 0.0 ? secondBit : 0u;
    return words;
}
