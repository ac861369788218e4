// How passes A and B of `bank-surfaces` make a texel of two surfaces from those of the level below. docs/scatter.md. Included
// after bank.glsl.

// A texel's two surfaces, the one with more mass first; the second is empty where all is one surface.
struct Surfaces {
    RawTexel first;
    RawTexel second;
};

// Nearest and farthest depth of what they are already, and of one more, 0 = none.
vec2 includeDepth(vec2 range, float depth) {
    return vec2(depth > 0.0 ? min(range.x, depth) : range.x, max(range.y, depth));
}

// Adds a texel of the level below, or its second surface, to the surface it belongs to. `first` is the nearer one, for now.
void addToNearer(inout Surfaces surfaces, RawTexel texel, vec2 range) {
    bool isNearer = texel.depth - range.x <= range.y - texel.depth;
    float share = isNearer ? 0.25 : 0.0;
    float otherShare = 0.25 - share;
    surfaces.first.light += share * texel.light;
    surfaces.first.area += share * texel.area;
    surfaces.first.mass += share * texel.mass;
    surfaces.first.depth += share * texel.mass * texel.depth;
    surfaces.first.dropped = surfaces.first.dropped || (isNearer && texel.dropped);
    surfaces.second.light += otherShare * texel.light;
    surfaces.second.area += otherShare * texel.area;
    surfaces.second.mass += otherShare * texel.mass;
    surfaces.second.depth += otherShare * texel.mass * texel.depth;
    surfaces.second.dropped = surfaces.second.dropped || (!isNearer && texel.dropped);
}

// What `range` is where a level takes all of it for one surface: everything is nearer then.
vec2 rangeOfSurfaces(vec2 range, int level) {
    return range.y - range.x <= separationAt(level, range.x) ? vec2(range.x, 2.0 * range.y) : range;
}

// Of sums of depth times mass their mean; the surface with more mass first.
Surfaces orderSurfaces(Surfaces sums) {
    RawTexel near = sums.first;
    RawTexel far = sums.second;
    bool areTwo = min(near.mass, far.mass) > 0.0;
    near.dropped = near.dropped || areTwo;
    far.dropped = far.dropped || areTwo;
    near.depth /= max(near.mass, 1e-20);
    far.depth /= max(far.mass, 1e-20);
    return near.mass >= far.mass ? Surfaces(near, far) : Surfaces(far, near);
}

// A texel's own words, with a note of whether there is a second surface.
uvec4 packFirst(Surfaces surfaces) {
    uvec4 words = packRaw(surfaces.first);
    words.w |= surfaces.second.mass > 0.0 ? secondBit : 0u;
    return words;
}
