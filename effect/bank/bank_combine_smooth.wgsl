// Pass C of `bank` for regions without depth discontinuities, 32x16 px, 2x2 a thread: every pixel's mixture of the identity,
// the full-resolution 3x3 and the six blurred levels, with its material's weights. docs/scatter.md.
#include "bank_region.wgsl"

const ownSide: i32 = 2;
const levelSizes = array<vec2i, 7>(vec2i(0, 0), vec2i(0, 0), vec2i(10, 6), vec2i(6, 4), vec2i(4, 3), vec2i(3, 2), vec2i(2, 2));
const levelStart = array<i32, 8>(0, 0, 0, 60, 84, 96, 102, 106);

// Of level 1's texels: light times coverage, and coverage.
var<workgroup> fineLights: array<vec4f, fineCount>;

// Light or a level's, as a quad's four pixels see it: light times coverage, and coverage.
alias Lights = array<vec4f, 4>;

// Numerator of the four pixels' result, and their denominator.
struct Sum {
    light: array<vec3f, 4>,
    weight: vec3f,
}

fn loadPixel(region: Region, place: i32) {
    let pixel = pixelAt(place);
    let material = materialInRegion(region, pixel);
    let local = clamp(region.first + pixel, vec2i(0), parameters.view.areaExtent - 1);
    let light = storableLight(enteringLight(local + parameters.view.areaOffset, material));
    pixelLights[place] = select(vec4f(0.0), vec4f(light, 1.0), material != 0u);
}

fn loadRegion(region: Region, thread: i32) {
    for (var place = thread; place < pixelCount; place += threads) {
        loadPixel(region, place);
    }
    for (var index = thread; index < fineCount; index += threads) {
        let lightAndArea = unpackFour(fineWords(region, fineTexel(index)).xy);
        let coverage = coverageOf(abs(lightAndArea.a));
        fineLights[index] = vec4f(lightAndArea.rgb * coverage, coverage);
    }
    loadLevels(region.first, thread);
}

// The full-resolution 3x3 of a quad on a slope: taps have its depths, which makes their weights separable, `beside` the
// middle in x and y.
fn filterPixels(quad: vec2i, beside: vec2f) -> Lights {
    let side = beside / (1.0 + 2.0 * beside);
    var result: Lights;
    for (var i = 0; i < 4; i++) {
        for (var y = -1; y <= 1; y++) {
            let place = pixelPlace(quad + offsetOf(i) + vec2i(0, y));
            let middle = pixelLights[place];
            let row = middle + side.x * (pixelLights[place - 1] - middle + (pixelLights[place + 1] - middle));
            result[i] += row * select(side.y, 1.0 - 2.0 * side.y, y == 0);
        }
    }
    return result;
}

// Weights of five of level 1's texels along an axis: there the 3x3 mean and the bilinear reading of it, ¼ and ¾, are one
// kernel. `side`: of a texel beside the mean's middle one, of 1 in all. `odd`: which of the quad's pixels.
fn fineKernel(side: f32, odd: bool) -> array<f32, 5> {
    let near = 0.25 + 0.25 * side; // of the texel that the pixel is closer to,
    let far = 0.75 * side;         // of the one on the other side,
    let outer = 0.25 * side;       // and of the one beyond the near one; the rest is the quad's own
    let own = 1.0 - near - far - outer;
    if (odd) {
        return array<f32, 5>(0.0, far, own, near, outer);
    }
    return array<f32, 5>(outer, near, own, far, 0.0);
}

// Level 1 of a quad. On a slope the mean's taps have its depths; `beside`: of the full-resolution 3x3, whose falloff is that
// of a wider variance.
fn filterFinestLevel(texel: vec2i, beside: vec2f) -> Lights {
    let falloffs = pow(2.0 * beside, vec2f(bankFinestFalloffPower));
    let side = falloffs / (1.0 + 2.0 * falloffs);
    var result: Lights;
    for (var i = 0; i < 4; i++) {
        var columns = fineKernel(side.x, (i & 1) != 0);
        var rows = fineKernel(side.y, (i >> 1u) != 0);
        for (var tap = 0; tap < 25; tap++) {
            let offset = vec2i(tap % 5, tap / 5);
            result[i] += columns[offset.x] * rows[offset.y] * fineLights[fineIndex(texel + offset - 2)];
        }
    }
    return result;
}

// Each pixel has the mean of a kernel's light, the quad one coverage.
fn addKernel(given: Sum, weight: vec3f, lights: Lights) -> Sum {
    var sum = given;
    let coverage = 0.25 * (lights[0].a + lights[1].a + lights[2].a + lights[3].a);
    for (var i = 0; i < 4; i++) {
        sum.light[i] += weight * coverage / max(lights[i].a, bankLeastWeight) * lights[i].rgb;
    }
    sum.weight += weight * coverage;
    return sum;
}

// A level from 2 on as a quad sees it, whose pixels lie between the same four texels: light times coverage, and coverage.
struct Seen {
    middle: vec4f, // of the quad
    slopeX: vec4f, // from a texel to the next
    slopeY: vec4f,
    factor: f32,   // by which all of it is to be multiplied
}

// With depth weights only where `stepped`; else with bilinear ones.
fn seeLevel(level: i32, corner: Corner, depth: f32, stepped: bool) -> Seen {
    let scale = levelScale(level, depth);
    let fraction = corner.fraction;
    var taps: Lights;
    var total = 0.0;
    var away = 0.0;
    for (var i = 0; i < 4; i++) {
        let place = corner.place + (i & 1) + (i >> 1u) * corner.pitch;
        let distance = levelDepths[place] - depth;
        let weight = select(1.0, depthWeight(distance, scale), stepped);
        let share = select(1.0 - fraction, fraction, vec2<bool>((i & 1) != 0, i > 1));
        taps[i] = weight * levelLights[place];
        total += weight * share.x * share.y;
        away += weight * share.x * share.y * distance;
    }
    let upper = mix(taps[0], taps[1], fraction.x);
    let lower = mix(taps[2], taps[3], fraction.x);
    return Seen(mix(upper, lower, fraction.y), mix(taps[1] - taps[0], taps[3] - taps[2], fraction.y), lower - upper,
                select(1.0, levelFactor(total, away, scale), stepped));
}

// How the mean light, of a level of which only a part is there, changes from a texel to the next.
fn meanSlope(slope: vec4f, middle: vec4f) -> vec3f {
    return slope.rgb - middle.rgb * (slope.a / max(middle.a, bankLeastWeight));
}

// The coarse levels: once for a quad's four pixels. `local`: the first of them, counted from the region's.
fn sumCoarseLevels(mixture: Mixture, region: vec2i, local: vec2i, depth: f32) -> Sum {
    let stepped = atomicLoad(&steppedLevels);
    var light = vec3f(0.0);
    var stepX = vec3f(0.0); // from a pixel to the next
    var stepY = vec3f(0.0);
    var sum: Sum;
    for (var level = 2; level <= bankLevels; level++) {
        if (!isUsed(mixture, level + 1)) {
            continue;
        }
        let corner = cornerOf(level, region, local);
        let seen = seeLevel(level, corner, depth, ((stepped >> u32(level)) & 1u) != 0u);
        let weight = kernelWeight(mixture, level + 1) * seen.factor;
        light += weight * seen.middle.rgb;
        sum.weight += weight * seen.middle.a;
        if (level <= bankSlopeLevels) {
            let step = weight / f32(1 << u32(level));
            stepX += step * meanSlope(seen.slopeX, seen.middle);
            stepY += step * meanSlope(seen.slopeY, seen.middle);
        }
    }
    for (var i = 0; i < 4; i++) {
        sum.light[i] = light + (f32(i & 1) - 0.5) * stepX + (f32(i >> 1u) - 0.5) * stepY;
    }
    return sum;
}

// All kernels of a quad's pixels of one material. `texel`: the quad, counted from the region's first.
fn sumKernels(mixture: Mixture, region: vec2i, texel: vec2i, words: vec4u) -> Sum {
    let beside = weightsOf(words.w);
    var sum = sumCoarseLevels(mixture, region, 2 * texel, bitcast<f32>(words.z));
    let identity = max(kernelWeight(mixture, 0), vec3f(bankLeastIdentity));
    for (var i = 0; i < 4; i++) { // a smooth region's pixels all give light where they receive it
        sum.light[i] += identity * pixelLights[pixelPlace(2 * texel + offsetOf(i))].rgb;
    }
    sum.weight += identity;
    sum = addKernel(sum, kernelWeight(mixture, 1), filterPixels(2 * texel, beside));
    if (isUsed(mixture, 2)) {
        sum = addKernel(sum, kernelWeight(mixture, 2), filterFinestLevel(texel, beside));
    }
    return sum;
}

// The mean scaleAt of a quad's pixels of a material, which share a mixture.
fn groupScale(first: vec2i, quadsMaterials: vec2u, material: u32) -> f32 {
    if (!hasFlag(flagScale)) {
        return 1.0;
    }
    var sum = vec2f(0.0); // and how many
    for (var i = 0; i < 4; i++) {
        let local = first + offsetOf(i);
        if (pixelMaterial(quadsMaterials, offsetOf(i)) == material && all(local < parameters.view.areaExtent)) {
            sum += vec2f(scaleAt(local + parameters.view.areaOffset), 1.0);
        }
    }
    return sum.x / sum.y;
}

@compute @workgroup_size(16, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) invocation: vec3u,
        @builtin(local_invocation_index) index: u32) {
    let region = findRegion(0, group);
    if (region.exists) {
        loadRegion(region, i32(index));
    }
    workgroupBarrier();
    let texel = vec2i(invocation.xy);
    let part = texel / (partSize / 2);
    if (!region.exists || ((region.skipped >> u32(part.x + 2 * part.y)) & 1u) != 0u) {
        return;
    }
    let first = region.first + 2 * texel;
    let words = fineWords(region, texel);
    let quadsMaterials = materialsOf(words.w, fineTexelIndex(region, texel));
    var summed = 0u; // the material of `sum`
    var sum: Sum;
    var mixture: Mixture;
    for (var i = 0; i < 4; i++) {
        let local = first + offsetOf(i);
        let pixel = local + parameters.view.areaOffset;
        if (any(local >= parameters.view.areaExtent)) {
            continue;
        }
        let material = pixelMaterial(quadsMaterials, offsetOf(i));
        if (material == 0u) {
            writeUnscattered(pixel, 0u);
            continue;
        }
        if (material != summed) {
            summed = material;
            mixture = findMixture(material, bitcast<f32>(words.z), first + parameters.view.areaOffset,
                                  groupScale(first, quadsMaterials, material));
            sum = sumKernels(mixture, region.first, texel, words);
        }
        writeScattered(pixel, material, sum.light[i] / max(sum.weight, vec3f(1e-20)), strengthOf(mixture));
    }
}
