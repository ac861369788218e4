// Which 4x4 texels of a shadow map are looked at around a receiver, and what they say: how far along the light it enters.
// shadow_taps.glsl, shadow_depth.glsl. Included after lights.wgsl.

// The maps of all lights are layers of one array. WebGPU has no arrays of bindings, and of 16 sampled textures by default
// the other inputs take five.
@group(0) @binding(bindingShadowMaps) var shadowMaps: texture_2d_array<f32>;

// Texels between taps from which on they move with the receiver, and their weights then: a tent's.
const leastMoving: f32 = 1.5;
const movingWeights = vec4f(0.125, 0.375, 0.375, 0.125);

// The taps on one axis of the map.
struct AxisTaps {
    texels: vec4f, // without the shear
    weights: vec4f,
}

// 4x4 texels of a shadow map, and how much each column and row of them counts.
struct Taps {
    columns: AxisTaps,
    rows: AxisTaps,
    shear: vec4f, // texels that the first to fourth row is shifted to the right, and the first to fourth column downwards
    last: vec2f,  // texel of the map
}

// Of the four taps in a row.
fn tapsX(taps: Taps, row: i32) -> vec4f {
    return clamp(taps.columns.texels + taps.shear[row], vec4f(0.0), vec4f(taps.last.x));
}

fn tapsY(taps: Taps, row: i32) -> vec4f {
    return clamp(taps.rows.texels[row] - taps.shear, vec4f(0.0), vec4f(taps.last.y));
}

// Next to each other taps stand on the map's grid under a tent, so that they come and go without weight. Farther apart they
// move with the receiver. What lies outside of the map is not known, and has no weight.
fn axisTaps(coordinate: f32, spacing: f32, last: f32) -> AxisTaps {
    const tap = vec4f(-1.0, 0.0, 1.0, 2.0);
    var taps = AxisTaps(floor(coordinate + (tap - 0.5) * spacing), movingWeights);
    if (spacing < leastMoving) {
        let base = floor(coordinate / spacing - 0.5);
        let fraction = coordinate / spacing - 0.5 - base;
        taps.texels = floor((base + tap + 0.5) * spacing);
        taps.weights = 0.5 - 0.25 * abs(tap - fraction);
    }
    let inside = taps.weights * step(vec4f(0.0), taps.texels) * step(taps.texels, vec4f(last));
    let sum = dot(inside, vec4f(1.0));
    if (sum > 0.0) {
        taps.weights = inside / sum;
    }
    return taps;
}

// Those that move are sheared, so that they cross an edge one by one.
fn tapsAround(coordinate: vec2f, spacing: f32, size: vec2f) -> Taps {
    let last = size - 1.0;
    let shear = floor(0.25 * spacing * vec4f(-1.5, -0.5, 0.5, 1.5) + 0.5);
    return Taps(axisTaps(coordinate.x, spacing, last.x), axisTaps(coordinate.y, spacing, last.y),
                select(shear, vec4f(0.0), spacing < leastMoving), last);
}

// [mm] Depth where nothing was drawn.
const nothingThere: f32 = 1e30;

// Depth of a place in a depth buffer along the light, mm. What was never drawn may be infinitely far.
fn decodedDepth(light: LightParameters, place: vec4f) -> f32 {
    let depth = select(length(place.xyz), dot(place.xyz, light.direction.xyz), light.kind == lightDirectional);
    if (place.w <= 0.0) {
        return nothingThere;
    }
    return min(depth / place.w * parameters.view.mmPerUnit, nothingThere);
}

// What 4x4 texels of a shadow map say. A matrix's column is a row of the map.
struct MapDepths {
    depth: mat4x4f,   // mm, along the light
    isEntry: mat4x4f, // 0 or 1: whether light can enter there. Not where nothing is, nor at a body's back.
}

fn depthsAlongLight(light: LightParameters, taps: Taps, layer: u32) -> MapDepths {
    let isHardware = generalCall && (light.shadowFlags & shadowHardwareDepth) != 0u;
    let origin = select(vec2i(0), light.shadowOrigin, generalCall);
    let range = light.direction.w * parameters.view.mmPerUnit;
    var map: MapDepths;
    for (var row = 0; row < 4; row++) {
        let x = tapsX(taps, row);
        let y = tapsY(taps, row);
        for (var column = 0; column < 4; column++) {
            let texel = vec2f(x[column], y[column]);
            let stored = textureLoad(shadowMaps, vec2i(texel) + origin, layer, 0).r;
            var depth = select(abs(stored) * range, nothingThere, stored >= 1.0); // below 0: a body's back; 1: nothing
            if (isHardware) {
                depth = decodedDepth(light, light.offsetFromTexel * vec4f(texel + 0.5, stored, 1.0));
            }
            map.depth[row][column] = depth;
            map.isEntry[row][column] = select(0.0, 1.0, depth < nothingThere && (isHardware || stored >= 0.0));
        }
    }
    return map;
}

// Whether a light's map has the faces that look away from the light, the receiver's own among them.
fn isFrontFaceCulled(light: LightParameters) -> bool {
    return generalCall && (light.shadowFlags & shadowFrontFacesCulled) != 0u;
}
