// What every scatter pass includes: inputs, materials, and who gives light to whom. scatter.glsl.
#include "blocks.wgsl"

@group(0) @binding(bindingParameters) var<uniform> parameters: ScatterParameters;
@group(0) @binding(bindingIrradiance) var irradianceImage: texture_2d<f32>;
@group(0) @binding(bindingAlbedo) var albedoImage: texture_2d<f32>;
@group(0) @binding(bindingScattered) var scatteredImage: texture_storage_2d<rgba16float, write>;

#include "pixel_geometry.wgsl"
#include "encoded_inputs.wgsl"

// The largest light of an intermediate of half floats.
const maxHalf: f32 = 65504.0;

// Whether light that enters material `first` may leave material `second`: one material, or a common exchange group.
fn exchanges(first: u32, second: u32) -> bool {
    return first == second ||
           (first != 0u && (materials.elements[first].exchangeGroups & materials.elements[second].exchangeGroups) != 0u);
}

fn isAlbedoBefore(material: u32) -> bool {
    return hasFlag(flagAlbedoBefore) && materials.elements[material].preAndPost != 0u;
}

fn albedoAt(pixel: vec2i) -> vec3f {
    return textureLoad(albedoImage, pixel, 0).rgb;
}

// The albedo's share that is applied before scattering.
fn albedoBefore(pixel: vec2i, material: u32) -> vec3f {
    if (isAlbedoBefore(material)) {
        return sqrt(albedoAt(pixel));
    }
    return vec3f(1.0);
}

// The albedo's share that is applied after scattering.
fn albedoAfter(pixel: vec2i, material: u32) -> vec3f {
    if (!hasFlag(flagAlbedo)) {
        return vec3f(1.0);
    }
    let albedo = albedoAt(pixel);
    return select(albedo, sqrt(albedo), isAlbedoBefore(material));
}

// The light that enters at a pixel of a material. Not finite where the irradiance is not.
fn enteringLight(pixel: vec2i, material: u32) -> vec3f {
    return textureLoad(irradianceImage, pixel, 0).rgb * albedoBefore(pixel, material);
}

// Writes a pixel without subsurface scattering, unless it has no material and is to be left as it is.
fn writeUnscattered(pixel: vec2i, material: u32) {
    if (material == 0u && hasFlag(flagSkipUnscattered)) {
        return;
    }
    var light = textureLoad(irradianceImage, pixel, 0).rgb;
    if (hasFlag(flagAlbedo)) {
        light *= albedoAt(pixel);
    }
    textureStore(scatteredImage, pixel, vec4f(light, 1.0));
}

// The pixel's factor on how much of its light scatters, [0, 1].
fn strengthAt(pixel: vec2i) -> f32 {
    if (!hasFlag(flagStrength)) {
        return 1.0;
    }
    return clamp(textureLoad(strengthImage, pixel, 0).r, 0.0, 1.0);
}

// Writes a pixel of a material, given the light that leaves there before strength and albedo. `strength`: the material's.
fn writeScattered(pixel: vec2i, material: u32, scattered: vec3f, strength: f32) {
    var leaving = scattered;
    let share = strength * strengthAt(pixel);
    if (share < 1.0) {
        let entering = enteringLight(pixel, material);
        if (isFiniteVector(entering)) {
            leaving = mix(entering, scattered, share);
        }
    }
    textureStore(scatteredImage, pixel, vec4f(leaving * albedoAfter(pixel, material), 1.0));
}
