// What a thread of pass A of `bank` makes of its 2x2 px: a texel of level 1. bank_quad.glsl. Included by pass A, with the
// tile's `depths`, of `pitch`, after bank_reduction.wgsl.

// 2x2 px, row by row.
struct QuadPixels {
    material: vec4u,
    depth: vec4f, // mm, 0 where none receives light
    light: array<vec3f, 4>, // as it enters
}

// A texel of level 1 with what the combination wants to know of its pixels.
struct ReducedQuad {
    texel: ReducedTexel,
    weights: u32,    // packWeights or, where the quad is stepped, packSpread with spreadBit
    shareArea: bool, // of all pixels the texel's area, not `areas`
    areas: vec4f,
}

fn isInExtent(local: vec2i) -> bool {
    return all(local >= vec2i(0)) && all(local < parameters.view.areaExtent);
}

// A pixel of the image, as near as there is one.
fn imagePixel(local: vec2i) -> vec2i {
    return clamp(local, vec2i(0), parameters.view.areaExtent - 1) + parameters.view.areaOffset;
}

// In `depths`; counted from the tile's first pixel.
fn depthPlace(pixel: vec2i) -> i32 {
    return (pixel.y + 1) * pitch + pixel.x + 1;
}

// Ids and slots of pixels beyond the area are 0.
fn idAt(local: vec2i) -> u32 {
    return select(0u, materialIdAt(imagePixel(local)), isInExtent(local));
}

fn receivingDepth(local: vec2i, id: u32) -> f32 {
    return select(0.0, distanceAlongRay(imagePixel(local)), isInExtent(local) && materialOfId(id) != 0u);
}

fn fetchQuad(first: vec2i, ids: vec4u) -> QuadPixels {
    var quad: QuadPixels;
    for (var i = 0; i < 4; i++) {
        let local = first + offsetOf(i);
        quad.material[i] = select(0u, materialOfId(ids[i]), isInExtent(local));
        quad.depth[i] = receivingDepth(local, ids[i]);
        quad.light[i] = enteringLight(imagePixel(local), quad.material[i]);
    }
    return quad;
}

// Depth step from a pixel to the next along one axis, in pixel widths, from the depths on either side (0 = none): their
// mean or, where one side is a step to another surface, the smaller.
fn pixelStep(before: f32, depth: f32, after: f32) -> f32 {
    let width = texelWidth(0, depth);
    let onlyAfter = select(0.0, after - depth, after > 0.0);
    let stepBefore = select(onlyAfter, depth - before, before > 0.0);
    let stepAfter = select(stepBefore, onlyAfter, after > 0.0);
    let smaller = min(abs(stepBefore), abs(stepAfter));
    let larger = max(abs(stepBefore), abs(stepAfter));
    let goesOn = larger <= bankContinuedStep * max(smaller, width);
    return select(smaller, 0.5 * (stepBefore + stepAfter), goesOn) / width;
}

// Area of a pixel's surface relative to one that faces the camera, from its own depth and those around.
fn areaOf(depth: f32, left: f32, right: f32, above: f32, below: f32) -> f32 {
    let slope = vec2f(pixelStep(left, depth, right), pixelStep(above, depth, below));
    return min(sqrt(1.0 + dot(slope, slope)), bankLargestArea);
}

// How much the taps beside the middle of the full-resolution 3x3 weigh, on a slope of so many pixel widths a pixel.
fn weightsBeside(slope: vec2f) -> vec2f {
    return 0.5 * vec2f(falloff(slope.x * slope.x / bankPixelDepthVariance),
                       falloff(slope.y * slope.y / bankPixelDepthVariance));
}

// A quad's rows and columns, each with the pixel before and after it, as lines of four depths.
struct Lines {
    before: vec4f, // left of the two rows, above the two columns
    first: vec4f,
    second: vec4f,
    after: vec4f,
}

fn linesOf(depth: vec4f, place: i32) -> Lines {
    let before = vec4f(depths[place - 1], depths[place + pitch - 1], depths[place - pitch], depths[place - pitch + 1]);
    let after = vec4f(depths[place + 2], depths[place + pitch + 2], depths[place + 2 * pitch], depths[place + 2 * pitch + 1]);
    return Lines(before, depth.xzxy, depth.ywzw, after);
}

fn largest(value: vec4f) -> f32 {
    return max(max(value.x, value.y), max(value.z, value.w));
}

fn smallest(value: vec4f) -> f32 {
    return -largest(-value);
}

// Steps from pixel to pixel; only between pixels that are on a surface.
fn surfaceStep(a: vec4f, b: vec4f) -> vec4f {
    return select(vec4f(0.0), abs(a - b), min(a, b) > vec4f(0.0));
}

fn longestStep(lines: Lines, hasHole: bool) -> f32 {
    if (hasHole) {
        return largest(max(max(surfaceStep(lines.before, lines.first), surfaceStep(lines.first, lines.second)),
                           surfaceStep(lines.second, lines.after)));
    }
    return largest(max(max(abs(lines.first - lines.before), abs(lines.second - lines.first)),
                       abs(lines.after - lines.second)));
}

// Whether in each row and column with a step longer than `limit` depth rises or falls, however steeply.
fn isSteep(lines: Lines, limit: f32) -> bool {
    let before = lines.first - lines.before;
    let between = lines.second - lines.first;
    let after = lines.after - lines.second;
    let least = min(min(before, between), after);
    let most = max(max(before, between), after);
    return all(max(most, -least) <= max(bankContinuedStep * max(least, -most), vec4f(limit)));
}

// Areas of a continuous quad's pixels: as areaOf, where every depth goes on to both sides.
fn continuousAreas(lines: Lines, width: f32) -> vec4f {
    let lower = lines.second - lines.before; // of the first pixel of each line, over two pixels
    let upper = lines.after - lines.first;   // of the second
    let stepX = vec4f(lower.x, upper.x, lower.y, upper.y);
    let stepY = vec4f(lower.z, lower.w, upper.z, upper.w);
    return sqrt(1.0 + (stepX * stepX + stepY * stepY) * (0.25 / (width * width)));
}

fn anyAreas(depth: vec4f, lines: Lines) -> vec4f {
    return vec4f(areaOf(depth.x, lines.before.x, depth.y, lines.before.z, depth.z),
                 areaOf(depth.y, depth.x, lines.after.x, lines.before.w, depth.w),
                 areaOf(depth.z, lines.before.y, depth.w, depth.x, lines.after.z),
                 areaOf(depth.w, depth.z, lines.after.y, depth.y, lines.after.w));
}

fn reduceContinuous(quad: QuadPixels, lines: Lines, width: f32) -> ReducedQuad {
    let areas = continuousAreas(lines, width);
    var light = vec3f(0.0);
    for (var i = 0; i < 4; i++) {
        light += 0.25 * areas[i] * quad.light[i];
    }
    let depth = quad.depth;
    let steps = vec2f(depth.y - depth.x + depth.w - depth.z, depth.z - depth.x + depth.w - depth.y);
    let area = dot(areas, vec4f(0.25));
    let shareArea = dot(areas, areas) <= (4.0 + 4.0 * bankSharedAreaVariance) * (area * area);
    let texel = ReducedTexel(light, area, 1.0, dot(depth, vec4f(0.25)), quad.material.x, false);
    return ReducedQuad(texel, packWeights(weightsBeside(steps * (0.5 / width))), shareArea, areas);
}

// Of the pixels that a texel has kept.
fn spreadOfPixels(pixels: array<ReducedTexel, 4>, kept: vec4<bool>, texel: ReducedTexel) -> DepthSpread {
    let perWidth = 1.0 / texelWidth(1, texel.depth);
    var variance = 0.0;
    var lights = vec2f(0.0); // sum of the channels; times distance
    for (var i = 0; i < 4; i++) {
        if (kept[i]) {
            let away = (pixels[i].depth - texel.depth) * perWidth;
            variance += 0.25 * away * away;
            let light = clamp(pixels[i].light, vec3f(0.0), vec3f(1e30)) / pixels[i].area;
            lights += (light.r + light.g + light.b) * vec2f(1.0, away);
        }
    }
    const ownVariance = 0.5 * bankPixelDepthVariance; // of depth weights, as Gaussians
    const leastCloseness = ownVariance / (ownVariance + 0.25 * bankSurfaceSeparation * bankSurfaceSeparation);
    let closeness = texel.coverage / max(texel.coverage + variance / ownVariance, 0.25);
    return DepthSpread(max(closeness, leastCloseness), closeness / ownVariance * lights.y / max(lights.x, 1e-20));
}

// Depth steps from pixel to pixel, in pixel widths.
fn slopeOfPixels(pixels: array<ReducedTexel, 4>, kept: vec4<bool>, texel: ReducedTexel) -> vec2f {
    var steps = vec2f(0.0);
    var pairs = vec2f(0.0);
    for (var i = 0; i < 2; i++) {
        if (kept[2 * i] && kept[2 * i + 1]) {
            steps.x += pixels[2 * i + 1].depth - pixels[2 * i].depth;
            pairs.x += 1.0;
        }
        if (kept[i] && kept[i + 2]) {
            steps.y += pixels[i + 2].depth - pixels[i].depth;
            pairs.y += 1.0;
        }
    }
    return steps / (max(pairs, vec2f(1.0)) * texelWidth(0, texel.depth));
}

// Not finite light is no light and drops the pixel, as not finite depth does, so that nothing near is taken for smooth.
// `hasStep`: a step to another surface.
fn reduceAny(quad: QuadPixels, lines: Lines, hasStep: bool) -> ReducedQuad {
    var areas = anyAreas(quad.depth, lines);
    var pixels: array<ReducedTexel, 4>;
    var dropped = false;
    for (var i = 0; i < 4; i++) {
        let light = quad.light[i];
        if (quad.depth[i] > 0.0 && isFiniteVector(light)) {
            pixels[i] = ReducedTexel(areas[i] * light, areas[i], 1.0, quad.depth[i], quad.material[i], false);
        } else {
            dropped = dropped || quad.material[i] != 0u;
            areas[i] = 1.0;
        }
    }
    let kept = chooseSurface(pixels, 1);
    var texel = mergeTexels(pixels, kept);
    texel.dropped = texel.dropped || dropped;
    var weights = packWeights(weightsBeside(slopeOfPixels(pixels, kept, texel)));
    if (texel.dropped || hasStep) {
        weights = spreadBit | packSpread(spreadOfPixels(pixels, kept, texel));
    }
    return ReducedQuad(texel, weights, false, areas);
}

// Whether light is negative, not finite or too large for sums of two differences in half floats.
fn isBright(light: vec3f) -> bool {
    return any(bitcast<vec3u>(light) > vec3u(bitcast<u32>(mostDimLight)));
}

// `place`: in `depths`.
fn reduceQuad(given: QuadPixels, place: i32) -> ReducedQuad {
    var quad = given;
    let lines = linesOf(quad.depth, place);
    let width = texelWidth(0, quad.depth.x);
    let hasHole = smallest(min(min(lines.before, lines.after), min(lines.first, lines.second))) == 0.0;
    var continuous = !hasHole && longestStep(lines, false) <= bankContinuedStep * width && !separateMaterials;
    for (var i = 0; i < 4; i++) {
        if (isBright(quad.light[i])) {
            atomicOr(&tileBits, tileBright);
            let finite = isFiniteVector(quad.light[i]);
            continuous = continuous && finite;
            quad.light[i] = select(quad.light[i], storableLight(quad.light[i]), finite);
        }
    }
    if (continuous) {
        return reduceContinuous(quad, lines, width);
    }
    let farthest = largest(quad.depth);
    let longest = longestStep(lines, hasHole);
    let limit = select(bankSmoothDepth, bankSmoothHoleDepth, hasHole) * texelWidth(0, farthest);
    let mayGoOn = !hasHole && longest <= separationAt(1, farthest);
    return reduceAny(quad, lines, longest > limit && !(mayGoOn && isSteep(lines, limit)));
}
