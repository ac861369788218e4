// Which pipeline of technique `bank` combines a pixel: its smooth one or its edge one, as pass A of `bank` decides it from
// depths and material ids (docs/scatter.md, "Two pipelines"). For looking at, in accumulate.comp, with `constants`, `depthImage`
// and `materialIdImage`. A workgroup is a tile of 16x16 px, half of a region of two by two parts of 16x8.

// As bank_constants.h has them; a test holds what is seen here against the technique's twin on the processor.
const float smoothStep = 3.0;    // px widths between pixels of a smooth part
const float holeStep = 0.5;      // the same beside a pixel without a material
const float continuedStep = 2.0; // how much longer the longest of three steps of one surface is than the shortest
const int mostEdgeParts = 2;     // of a region that is still combined as a smooth one

const int regionQuads = 18 * 10; // of 2x2 px: those of the region, and one around

shared uint edgeParts;     // a bit a part
shared uint occupiedTiles; // a bit a tile: some pixel has a material

/// Along the pixel's ray, scene units; 0 where no light scatters.
float distanceAt(ivec2 pixel) {
    ivec2 size = ivec2(constants.size.xy);
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size)) ||
        texelFetch(materialIdImage, pixel, 0).r == 0u) {
        return 0.0;
    }
    vec2 beside = constants.range.w > 0.0 ? (vec2(pixel) + 0.5 - 0.5 * vec2(size)) * constants.range.w : vec2(0.0);
    return texelFetch(depthImage, pixel, 0).r * length(vec3(beside, 1.0));
}

/// Width of a pixel at that distance.
float pixelWidthAt(float distance) {
    return constants.range.w > 0.0 ? distance * constants.range.w : -constants.range.w;
}

/// Whether a quad of 2x2 px holds a step to another surface, or has one beside it.
bool isStepped(ivec2 quad) {
    float around[16]; // without its corners, which are not asked for
    for (int i = 0; i < 16; ++i) {
        ivec2 place = ivec2(i & 3, i >> 2);
        bool isCorner = (place.x == 0 || place.x == 3) && (place.y == 0 || place.y == 3);
        around[i] = isCorner ? 0.0 : distanceAt(2 * quad + place - 1);
    }
    float farthest = max(max(around[5], around[6]), max(around[9], around[10]));
    if (farthest == 0.0) {
        return false;
    }
    float nearest = farthest;
    for (int i = 0; i < 4; ++i) {
        float own = around[5 + (i & 1) + 4 * (i >> 1)];
        nearest = own > 0.0 ? min(nearest, own) : nearest;
    }
    const int firsts[] = {4, 8, 1, 2}; // rows, then columns
    float longest = 0.0;
    bool hasHole = false;
    bool goesOn = true;
    float width = pixelWidthAt(farthest);
    float separation = constants.range.y * 2.0 * pixelWidthAt(nearest);
    for (int line = 0; line < 4; ++line) {
        int stride = line < 2 ? 1 : 4;
        float depths[4];
        for (int i = 0; i < 4; ++i) {
            depths[i] = around[firsts[line] + i * stride];
            hasHole = hasHole || depths[i] == 0.0;
        }
        vec3 steps = vec3(depths[1] - depths[0], depths[2] - depths[1], depths[3] - depths[2]);
        vec3 lengths = vec3(min(depths[0], depths[1]) > 0.0 ? abs(steps.x) : 0.0,
                            min(depths[1], depths[2]) > 0.0 ? abs(steps.y) : 0.0,
                            min(depths[2], depths[3]) > 0.0 ? abs(steps.z) : 0.0);
        float most = max(max(lengths.x, lengths.y), lengths.z);
        longest = max(longest, most);
        float least = min(min(steps.x, steps.y), steps.z);
        float greatest = max(max(steps.x, steps.y), steps.z);
        float allowed = max(smoothStep * width, continuedStep * max(least, -greatest));
        goesOn = goesOn && most <= allowed;
    }
    bool isLong = longest > (hasHole ? holeStep : smoothStep) * width;
    bool mayGoOn = !hasHole && longest <= constants.range.y * 2.0 * width;
    return farthest - nearest > separation || (isLong && !(mayGoOn && goesOn));
}

/// Notes what the region of this workgroup is. All of its threads must come here.
void classifyRegion() {
    if (gl_LocalInvocationIndex == 0u) {
        edgeParts = occupiedTiles = 0u;
    }
    barrier();
    ivec2 first = ivec2(gl_WorkGroupID.x >> 1, gl_WorkGroupID.y) * ivec2(32, 16);
    int thread = int(gl_LocalInvocationIndex);
    if (thread < regionQuads) {
        ivec2 quad = ivec2(thread % 18, thread / 18) - 1; // of the region
        if (isStepped(first / 2 + quad)) {
            uint columns = (quad.x <= 8 ? 1u : 0u) | (quad.x >= 7 ? 2u : 0u);
            atomicOr(edgeParts, (quad.y <= 4 ? columns : 0u) | (quad.y >= 3 ? columns << 2 : 0u));
        }
    }
    for (int tile = 0; tile < 2; ++tile) {
        if (distanceAt(first + ivec2(gl_LocalInvocationID.xy) + ivec2(16 * tile, 0)) > 0.0) {
            atomicOr(occupiedTiles, 1u << tile);
        }
    }
    barrier();
}

/// Blue where the smooth pipeline combines the pixel, orange where the edge pipeline does, parts by their borders; grey where
/// nothing scatters.
vec3 regionColor(ivec2 pixel, float grey) {
    uint tile = gl_WorkGroupID.x & 1u;
    uint part = tile + 2u * (gl_LocalInvocationID.y / 8u);
    uint empty = ((occupiedTiles & 1u) == 0u ? 5u : 0u) | ((occupiedTiles & 2u) == 0u ? 10u : 0u);
    uint edges = edgeParts & ~empty;
    if ((empty & 1u << part) != 0u) {
        return vec3(grey);
    }
    bool isEdge = bitCount(edges) > mostEdgeParts || (edges & 1u << part) != 0u;
    bool isBorder = pixel.x % 16 == 0 || pixel.y % 8 == 0;
    return mix(vec3(grey), isEdge ? vec3(1.0, 0.35, 0.0) : vec3(0.1, 0.4, 1.0), isBorder ? 0.6 : 0.3);
}
