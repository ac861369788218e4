// What the two pipelines of pass C of `bank` have in common: the material's mixture of a region's kernels, storing the result.
// docs/scatter.md. Included by them after bank_region_smooth.glsl or bank_region_edge.glsl, of which it uses ownSide,
// packedPlaces, levelPitch and levelAwayVariance.

layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    uvec4 bankTables[]; // bankTableWords a material
};

// Numerator of every pixel's result, and their denominator.
struct Sum {
    vec3 light[ownPixels];
    vec3 weight;
};

Sum noSum() {
    Sum sum;
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        sum.light[i] = vec3(0.0);
    }
    sum.weight = vec3(0.0);
    return sum;
}

// A material's weights of the kernels at a scale.
struct Mixture {
    uint first;     // of the bin, in bankTables
    float fraction; // [0, 1] towards the next
    uint word;      // the material's strength, and bits of the kernels that have a weight
};

// `pixel`: near where. A surface across the view direction is seen at the same scale everywhere. `scale`: scaleAt there; a
// profile that is twice as wide is the same profile seen from half as far away.
Mixture findMixture(uint material, float depth, ivec2 pixel, float scale) {
    float width = texelWidth(0, depth / stretchAt(pixel));
    float octave = -log2(hasFlag(flagScale) ? width / scale : width);
    float position = clamp(float(bankBinsPerOctave) * (octave - float(bankFirstOctave)), 0.0, float(bankTableBins - 1u));
    uint bin = min(uint(position), bankTableBins - 1u); // whatever a position that is not a number becomes
    uint first = material * bankTableWords + bin * bankBinWords;
    // The same word three times, to wait once for what most pixels need of the bin.
    uint word = bankTables[first].w & bankTables[first + 2u].w & bankTables[first + 4u].w;
    return Mixture(first, position - float(bin), word);
}

const uint finestKernel = 1u << 2; // level 1's bit of usedKernels

// Bits of the kernels that have a weight.
uint usedKernels(Mixture mixture) {
    return mixture.word & 0xffu;
}

float strengthOf(Mixture mixture) {
    return uintBitsToFloat(mixture.word & ~0xffu);
}

// Red, green and blue.
vec3 kernelWeight(Mixture mixture, int kernel) {
    uvec4 words = bankTables[mixture.first + uint(kernel)];
    vec2 blue = unpackHalf2x16(words.z);
    return mix(vec3(unpackHalf2x16(words.x), blue.x), vec3(unpackHalf2x16(words.y), blue.y), mixture.fraction);
}

vec4 unpackLight(uvec2 words) {
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

// A level's texels, from 2 on.
struct LevelGrid {
    int width;   // px
    float step;  // 1 / width
    uint places; // packedPlaces of this level and the coarser ones
};

const LevelGrid finestGrid = LevelGrid(4, 0.25, packedPlaces);

LevelGrid gridOf(int level) {
    int width = 1 << level;
    return LevelGrid(width, 1.0 / float(width), packedPlaces >> 6 * (level - 2));
}

LevelGrid coarser(LevelGrid grid) {
    return LevelGrid(2 * grid.width, 0.5 * grid.step, grid.places >> 6);
}

// Where a thread's pixels lie between four texels of a level.
struct Corner {
    int place;     // in shared memory, of the texel up and left of them
    vec2 fraction; // of their middle, towards the next texels
    float step;    // from a pixel to the next
};

// `local`: counted from the region's first pixel.
Corner cornerOf(LevelGrid grid, int level, ivec2 region, ivec2 local) {
    int last = grid.width - 1;
    // In px from the middle of levelFirst on.
    ivec2 beyond = local + (region + (grid.width >> 1) & last);
    ivec2 texel = beyond >> level;
    vec2 fraction = fma(vec2(beyond & last), vec2(grid.step), vec2(0.5 * float(ownSide) * grid.step));
    return Corner(placeOf(grid.places) + texel.y * levelPitch + texel.x, fraction, grid.step);
}

// What scales squared distances of a level for depthWeight.
float levelScale(int level, float depth) {
    return depthScale(texelWidth(level, depth), bankLevelDepthVariance);
}

// Of a level's texel, without the sign.
vec4 levelLight(uvec2 words) {
    vec4 light = unpackLight(words);
    return vec4(light.rgb, abs(light.a));
}

// What a level's weighted taps are multiplied by: one over their total weight, times how much of the level is where the pixel
// is, [0, 1]. On a slope the taps' weighted mean depth is the pixel's; where it is away from there, they stand on another
// surface. `away`: weighted sum of how far the taps are behind the pixel, mm. `scale`: levelScale.
float levelFactor(float total, float away, float scale) {
    float normalization = 1.0 / max(total, bankLeastWeight);
    return normalization * depthWeight(away * normalization, scale * (bankLevelDepthVariance / levelAwayVariance));
}

// Writes those of the thread's pixels that are members of a group, which share a material. `local`: the first. The light
// that is not scattered is fetched again: kept, it would take registers from everybody.
void storeGroup(ivec2 local, bvec4 members, uint material, float strength, Sum sum) {
    ivec2 first = local + view.areaOffset;
    vec3 leaving[ownPixels];
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        leaving[i] = sum.light[i] / max(sum.weight, vec3(1e-20));
    }
    if (albedoOrFactors && (strength < 1.0 || hasFlag(flagStrength))) {
        [[unroll]] for (int i = 0; i < ownPixels; ++i) {
            if (members[i]) {
                ivec2 pixel = first + ivec2(i & 1, i >> 1);
                leaving[i] = mixEntering(pixel, material, leaving[i], strength * strengthAt(pixel));
            }
        }
    }
    if (hasFlag(flagAlbedo)) {
        [[unroll]] for (int i = 0; i < ownPixels; ++i) {
            leaving[i] *= members[i] ? albedoAfter(first + ivec2(i & 1, i >> 1), material) : vec3(1.0);
        }
    }
    [[unroll]] for (int i = 0; i < ownPixels; ++i) {
        if (members[i]) {
            imageStore(scatteredImage, first + ivec2(i & 1, i >> 1), vec4(leaving[i], 1.0));
        }
    }
}
