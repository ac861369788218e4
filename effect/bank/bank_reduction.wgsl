// How passes A and B of `bank` make a texel of four of the level below. bank_reduction.glsl. Included by them after bank.wgsl.

const noRange = vec2f(1e30, 0.0);

// Nearest and farthest depth of the texels that are not empty.
fn depthRange(texels: array<ReducedTexel, 4>) -> vec2f {
    var range = noRange;
    for (var i = 0; i < 4; i++) {
        let depth = texels[i].depth; // 0 where it is empty
        range = vec2f(select(range.x, min(range.x, depth), texels[i].coverage > 0.0), max(range.y, depth));
    }
    return range;
}

// Depths further apart than this, in mm, are two surfaces of a texel whose nearest depth this is.
fn separationAt(level: i32, nearest: f32) -> f32 {
    return bankSurfaceSeparation * texelWidth(level, nearest);
}

// Which of four texels exchange light with the heaviest of those that are kept.
fn keepExchanging(texels: array<ReducedTexel, 4>, kept: vec4<bool>) -> vec4<bool> {
    var heaviest = 0.0;
    var material = 0u;
    var result = kept;
    for (var i = 0; i < 4; i++) {
        if (kept[i] && texels[i].coverage > heaviest) {
            heaviest = texels[i].coverage;
            material = texels[i].material;
        }
    }
    for (var i = 0; i < 4; i++) {
        result[i] = kept[i] && exchanges(texels[i].material, material);
    }
    return result;
}

// Which of four texels the next level's texel keeps: those of one surface, nearest or farthest, whichever has more coverage.
fn chooseSurface(texels: array<ReducedTexel, 4>, level: i32) -> vec4<bool> {
    let range = depthRange(texels);
    let separation = separationAt(level, range.x);
    var front = 0.0;
    var back = 0.0;
    for (var i = 0; i < 4; i++) { // an empty texel has no coverage
        front += select(0.0, texels[i].coverage, texels[i].depth <= range.x + separation);
        back += select(0.0, texels[i].coverage, texels[i].depth >= range.y - separation);
    }
    let surface = select(range.y, range.x, front >= back);
    var kept: vec4<bool>;
    for (var i = 0; i < 4; i++) {
        kept[i] = texels[i].coverage > 0.0 && abs(texels[i].depth - surface) <= separation;
    }
    if (separateMaterials) {
        return keepExchanging(texels, kept);
    }
    return kept;
}

// The next level's texel from the kept of the four below it.
fn mergeTexels(texels: array<ReducedTexel, 4>, kept: vec4<bool>) -> ReducedTexel {
    var result: ReducedTexel;
    var heaviest = 0.0;
    for (var i = 0; i < 4; i++) {
        let texel = texels[i];
        if (!kept[i]) {
            result.dropped = result.dropped || texel.coverage > 0.0;
            continue;
        }
        result.light += 0.25 * texel.light;
        result.area += 0.25 * texel.area;
        result.coverage += 0.25 * texel.coverage;
        result.depth += 0.25 * texel.coverage * texel.depth;
        result.dropped = result.dropped || texel.dropped;
        if (separateMaterials && texel.coverage > heaviest) {
            heaviest = texel.coverage;
            result.material = texel.material;
        }
    }
    result.depth = select(0.0, result.depth / max(result.coverage, 1e-20), result.coverage > 0.0);
    return result;
}

fn reduceTexels(texels: array<ReducedTexel, 4>, level: i32) -> ReducedTexel {
    return mergeTexels(texels, chooseSurface(texels, level));
}
