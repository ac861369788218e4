// A level's blur at a texel, whatever is around it: taps weigh by depth. docs/scatter.md. Where it is included, texels are
// in shared memory in rows of `pitch`, and texelAt, depthAt, hasSecondAt and secondAt read them.

// Whether the texel at `neighbor` is a surface further from `depth` than a smooth one's neighbour would be.
bool isStep(int neighbor, float depth, float limit) {
    float tap = depthAt(neighbor);
    return tap != 0.0 && abs(tap - depth) > limit;
}

// Where a texel's second kernel stands.
BlurredTexel findSecond(int center) {
    RawTexel own = secondAt(center);
    return BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, true, true);
}

// Where a texel's kernel stands: its own surface or, where it is empty, its neighbours', so that light reaches across
// small holes.
BlurredTexel findSurface(int level, int center) {
    RawTexel own = texelAt(center);
    BlurredTexel result = BlurredTexel(vec3(0.0), 0.0, own.depth, own.material, own.mass > 0.0, own.dropped);
    if (!result.present) {
        float mass = 0.0;
        float heaviest = 0.0;
        for (int i = 0; i < 9; ++i) {
            RawTexel tap = texelAt(center + i % 3 - 1 + (i / 3 - 1) * pitch);
            mass += tap.mass;
            result.depth += tap.mass * tap.depth;
            if (tap.mass > heaviest) {
                heaviest = tap.mass;
                result.material = tap.material;
            }
        }
        result.present = mass > 0.0;
        result.depth /= max(mass, 1e-20);
    }
    float limit = bankSmoothDepth * texelWidth(level, result.depth);
    bool stepX = isStep(center - 1, result.depth, limit) || isStep(center + 1, result.depth, limit);
    bool stepY = isStep(center - pitch, result.depth, limit) || isStep(center + pitch, result.depth, limit);
    result.rough = result.rough || stepX || stepY;
    return result;
}

// Weighted sums of a kernel's taps.
struct Sums {
    vec3 light;
    float area;
};

void addTap(inout Sums sums, RawTexel tap, BlurredTexel surface, float kernel, float width) {
    float difference = tap.depth - surface.depth;
    float weight = kernel * falloff(difference * difference / (bankBlurDepthVariance * width * width));
    bool taken = tap.mass > 0.0 && givesLight(tap.material, surface.material);
    weight = taken ? weight : 0.0;
    sums.light += weight * tap.light;
    sums.area += weight * tap.area;
}

void divide(inout BlurredTexel texel, Sums sums) {
    texel.mass = massOf(sums.area);
    texel.light = sums.light * (texel.mass / max(sums.area, bankLeastWeight));
}

void addTaps(inout Sums sums, int index, BlurredTexel surface, float kernel, float width) {
    addTap(sums, texelAt(index), surface, kernel, width);
    if (hasSecondAt(index)) {
        addTap(sums, secondAt(index), surface, kernel, width);
    }
}
