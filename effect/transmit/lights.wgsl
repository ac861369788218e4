// The structures of transmit_blocks.h, field by field: WGSL lays them out alike. And how much of a light falls on a surface.
#include "interface/blocks.wgsl"
#include "transmit_blocks.h"

struct TransmitParameters {
    view: ViewParameters,
    normalOffset: f32,
    filterRadius: f32,
    unused0: f32,
    unused1: f32,
}

struct TransmitTable {
    scale: f32,
    layerCount: u32,
    spread: f32,
    unused: u32,
    transmittance: array<vec2u, transmittanceLast + 2>,
    layers: array<vec4f, maxLayers>,
}

struct LightParameters {
    shadowX: vec4f,
    shadowY: vec4f,
    shadowW: vec4f,
    position: vec4f,
    direction: vec4f,
    irradiance: vec4f,
    coneScale: f32,
    coneOffset: f32,
    kind: u32,
    shadowMap: u32,
    shadowLayer: u32,
    shadowTexel: f32,
    shadowSize: vec2f,
    offsetFromTexel: mat4x4f,
    attenuation: vec4f,
    shadowOrigin: vec2i,
    cascadeSpan: vec2f,
    shadowFlags: u32,
    firstCascade: u32,
    cascadeCount: u32,
    cascadeBlend: f32,
}

@group(0) @binding(bindingParameters) var<uniform> parameters: TransmitParameters;
@group(0) @binding(bindingTables) var<storage, read> tables: array<TransmitTable>;
@group(0) @binding(bindingLights) var<storage, read> lights: array<LightParameters>;

// Some light has a map with hardware depth, of culled front faces, in an atlas or in cascades, or falls off in its own way.
@id(1) override generalCall: bool = false;

const lightDirectional: u32 = 0u; // NacreLightKind
const lightPoint: u32 = 2u;
const noShadowMap: u32 = 0xffffffffu;

// A light as the receiver sees it.
struct Incidence {
    toLight: vec3f,
    irradiance: vec3f, // on a surface that faces the light
}

// Punctual lights as in glTF's KHR_lights_punctual: 1/d² · saturate(1 - (d/range)⁴), squared linear cone.
fn incidenceAt(light: LightParameters, position: vec3f) -> Incidence {
    if (light.kind == lightDirectional) {
        return Incidence(-light.direction.xyz, light.irradiance.rgb);
    }
    let offset = light.position.xyz - position;
    let squared = max(dot(offset, offset), 1e-12);
    let toLight = offset * inverseSqrt(squared);
    let meters = light.irradiance.w;
    var attenuation = 1.0 / (squared * meters * meters);
    if (generalCall) {
        let distance = sqrt(squared) * meters;
        attenuation = 1.0 / dot(light.attenuation.xyz, vec3f(1.0, distance, distance * distance));
    }
    if (light.position.w > 0.0) {
        let share = squared / (light.position.w * light.position.w);
        attenuation *= clamp(1.0 - share * share, 0.0, 1.0);
    }
    if (light.coneScale > 0.0) {
        let cone = clamp(dot(light.direction.xyz, -toLight) * light.coneScale + light.coneOffset, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return Incidence(toLight, light.irradiance.rgb * attenuation);
}
