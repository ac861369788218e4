// The structures of blocks.h, field by field: WGSL lays them out alike.
#include "blocks.h"

struct ViewParameters {
    viewFromWorld: mat4x4f,
    worldFromView: mat4x4f,
    depthSlope: vec4f,
    depthBias: vec4f,
    rayX: vec2f,
    rayY: vec2f,
    rayBias: vec2f,
    originBias: vec2f,
    originX: vec2f,
    originY: vec2f,
    clipW: vec2f,
    areaOffset: vec2i,
    areaExtent: vec2i,
    mmPerUnit: f32,
    normalScale: f32,
    normalBias: f32,
    flags: u32,
    lightCount: u32,
    distanceOrigin: f32,
}

struct ScatterParameters {
    view: ViewParameters,
    pixelWidth: f32,
    burleySampleBudget: u32,
    burleyRotation: u32,
    thesisRadius: u32,
    thesisStrength: f32,
    unused0: f32,
    unused1: f32,
    unused2: f32,
    bankLevels: array<vec4i, 7>,
}

struct MaterialParameters {
    radius: f32,
    strength: f32,
    translucency: f32,
    thickness: f32,
    exchangeGroups: u32,
    preAndPost: u32,
    secondSurfaces: u32,
    thinWall: u32,
}

struct Materials {
    slots: array<u32, materialIdCount>,
    elements: array<MaterialParameters>,
}

@group(0) @binding(bindingMaterials) var<storage, read> materials: Materials;
@group(0) @binding(bindingDepth) var depthImage: texture_2d<f32>;
@group(0) @binding(bindingMaterialId) var materialIdImage: texture_2d<u32>;
@group(0) @binding(bindingNormal) var normalImage: texture_2d<f32>;
@group(0) @binding(bindingStrength) var strengthImage: texture_2d<f32>;
@group(0) @binding(bindingScale) var scaleImage: texture_2d<f32>;
