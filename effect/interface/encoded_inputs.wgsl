// What a pixel's material id and normal are, however the images hold them. encoded_inputs.glsl.

@id(constantNoMaterialIds) override noMaterialIds: bool = false;
@id(constantNormalEncoding) override normalEncoding: u32 = 0;

fn materialIdAt(pixel: vec2i) -> u32 {
    if (noMaterialIds) {
        return select(0u, 1u, !hasFlag(flagStrength) || textureLoad(strengthImage, pixel, 0).r > 0.0);
    }
    return textureLoad(materialIdImage, pixel, 0).r;
}

// The slot of a pixel's material, 0 where there is no subsurface scattering.
fn materialOfId(id: u32) -> u32 {
    return materials.slots[id & (materialIdCount - 1u)];
}

// [1] What the scale image's values are bounded to.
const leastScale: f32 = 1e-3;
const largestScale: f32 = 1e3;

// The pixel's factor on the lengths of its material's profile; 1 where it is no number.
fn scaleAt(pixel: vec2i) -> f32 {
    if (!hasFlag(flagScale)) {
        return 1.0;
    }
    let scale = textureLoad(scaleImage, pixel, 0).r;
    return select(1.0, clamp(scale, leastScale, largestScale), isFinite(scale));
}

// The normal that two numbers hold: the octahedron |x| + |y| + |z| = 1, whose lower half is folded over its upper one.
fn octahedralNormal(value: vec2f) -> vec3f {
    let z = 1.0 - abs(value.x) - abs(value.y);
    let folded = (1.0 - abs(value.yx)) * select(vec2f(-1.0), vec2f(1.0), value >= vec2f(0.0));
    return vec3f(select(value, folded, z < 0.0), z);
}

// Rotation from world to view space.
fn viewRotation() -> mat3x3f {
    let matrix = parameters.view.viewFromWorld;
    return mat3x3f(matrix[0].xyz, matrix[1].xyz, matrix[2].xyz);
}

// The normal image's value as a vector of any length, in world space.
fn worldNormalAt(pixel: vec2i) -> vec3f {
    let stored = textureLoad(normalImage, pixel, 0).xyz * parameters.view.normalScale + parameters.view.normalBias;
    let normal = select(stored, octahedralNormal(stored.xy), (normalEncoding & normalOctahedral) != 0u);
    return select(normal, transpose(viewRotation()) * normal, (normalEncoding & normalInViewSpace) != 0u);
}
