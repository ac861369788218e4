// View-space geometry of a pixel: position in mm, pixel size in mm. pixel_geometry.glsl. Needs `parameters`, which has a
// `view`.

fn isFinite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7fffffffu) < 0x7f800000u;
}

// Not where the sum is beyond a float, either.
fn isFiniteVector(value: vec3f) -> bool {
    return isFinite(value.x + value.y + value.z);
}

fn isInArea(pixel: vec2i) -> bool {
    let first = parameters.view.areaOffset;
    return all(pixel >= first) && all(pixel < first + parameters.view.areaExtent);
}

fn hasFlag(flag: u32) -> bool {
    return (parameters.view.flags & flag) != 0u;
}

// x and y of a pixel's ray: position = (ray·z + origin, z).
fn rayAt(pixel: vec2i) -> vec2f {
    return parameters.view.rayX * f32(pixel.x) + parameters.view.rayY * f32(pixel.y) + parameters.view.rayBias;
}

fn originAt(pixel: vec2i) -> vec2f {
    return parameters.view.originX * f32(pixel.x) + parameters.view.originY * f32(pixel.y) + parameters.view.originBias;
}

// View z in mm, negative in front of a perspective camera.
fn viewZ(pixel: vec2i) -> f32 {
    let depth = textureLoad(depthImage, pixel, 0).r;
    if (!hasFlag(flagHardwareDepth)) {
        return -depth * parameters.view.mmPerUnit;
    }
    let place = vec3f(vec2f(pixel), 1.0);
    let clipW = parameters.view.clipW;
    return (dot(parameters.view.depthBias.xyz, place) - depth * clipW.y) /
           (depth * clipW.x - dot(parameters.view.depthSlope.xyz, place));
}

fn clipW(z: f32) -> f32 {
    return parameters.view.clipW.x * z + parameters.view.clipW.y;
}

// Whether something was drawn there, in front of the camera.
fn isValidZ(z: f32) -> bool {
    return clipW(z) > 0.0 && isFinite(z);
}

// Length of a pixel's ray where z changes by 1.
fn stretchAt(pixel: vec2i) -> f32 {
    return length(vec3f(rayAt(pixel), 1.0));
}

// How far a pixel's surface is along its ray, mm, from view z distanceOrigin on; 0 where nothing was drawn.
fn distanceAlongRay(pixel: vec2i) -> f32 {
    let z = viewZ(pixel);
    let along = (parameters.view.distanceOrigin - z) * stretchAt(pixel);
    return select(0.0, along, isValidZ(z) && isFinite(along));
}

fn viewPosition(pixel: vec2i, z: f32) -> vec3f {
    return vec3f(rayAt(pixel) * z + originAt(pixel), z);
}

// How far a view-space position moves, in mm, from one pixel to the next at constant z.
fn stepX(z: f32) -> vec2f {
    return parameters.view.rayX * z + parameters.view.originX;
}

fn stepY(z: f32) -> vec2f {
    return parameters.view.rayY * z + parameters.view.originY;
}
