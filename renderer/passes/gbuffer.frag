#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "surface_textures.glsl"
#include "surface_look.glsl"

layout(constant_id = 0) const bool alphaMask = false;

// The order of GBuffer::Attachment.
layout(location = 0) out float outDepth;
layout(location = 1) out vec4 outShadingNormal;
layout(location = 2) out vec4 outVertexNormal;
layout(location = 3) out vec4 outAlbedo;
layout(location = 4) out vec4 outReflection;
layout(location = 5) out vec4 outEmission;
layout(location = 6) out uint outMaterialId;
layout(location = 7) out vec4 outTransmission;

// [1] As NacreScatterInfo::scale.
const float leastScale = 1e-3;
const float largestScale = 1e3;

float thicknessOf(SurfaceConstants surface) {
    float thickness = surface.lengths.x;
    if (thickness > 0.0 && hasTexture(thicknessSlot)) {
        // A small positive value keeps an authored zero apart from "none".
        thickness = max(thickness * texture(thicknessTexture, settled(inUv[thicknessSlot])).g, 1e-3);
    }
    return thickness;
}

float scaleOf(SurfaceConstants surface) {
    float scale = surface.lengths.y;
    if (hasTexture(scaleSlot)) {
        scale *= texture(scaleTexture, settled(inUv[scaleSlot])).r;
    }
    return clamp(scale, leastScale, largestScale);
}

// Factor on the share of the light that comes through.
float shareFactor() {
    return hasTexture(transmissionSlot) ? texture(transmissionTexture, settled(inUv[transmissionSlot])).a : 1.0;
}

// Of what comes through; negative: as the material has it.
vec3 transmissionColor() {
    return hasTexture(transmissionColorSlot)
        ? texture(transmissionColorTexture, settled(inUv[transmissionColorSlot])).rgb
        : vec3(-1.0);
}

void main() {
    SurfaceConstants surface = surfaces[draw.index.x];
    vec4 color = surface.baseColor * textureColor(inUv[baseColorSlot], inColor);
    if (alphaMask && color.a < surface.parameters.w) {
        discard;
    }
    Look look = lookOf(surface, color.rgb);
    float share = shareFactor();
    outDepth = inDepth;
    outShadingNormal = vec4(look.shadingNormal, 1.0);
    outVertexNormal = vec4(look.vertexNormal, scaleOf(surface));
    outAlbedo = vec4(look.albedo, share);
    outReflection = vec4(look.f0, look.roughness);
    outEmission = vec4(look.emission, surface.lengths.z != 0.0 ? share : 1.0);
    outMaterialId = surface.material.x;
    outTransmission = vec4(thicknessOf(surface), transmissionColor());
}
