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
layout(location = 7) out float outThickness;

void main() {
    SurfaceConstants surface = surfaces[draw.index.x];
    vec4 color = surface.baseColor * textureColor(inUv[baseColorSlot], inColor);
    if (alphaMask && color.a < surface.parameters.w) {
        discard;
    }
    Look look = lookOf(surface, color.rgb);
    float thickness = surface.thickness.x;
    if (thickness > 0.0 && has(hasThicknessTexture)) {
        // A small positive value keeps an authored zero apart from "none".
        thickness = max(thickness * texture(thicknessTexture, settled(inUv[thicknessSlot])).g, 1e-3);
    }

    outDepth = inDepth;
    outShadingNormal = vec4(look.shadingNormal, 1.0);
    outVertexNormal = vec4(look.vertexNormal, 1.0);
    outAlbedo = vec4(look.albedo, 1.0);
    outReflection = vec4(look.f0, look.roughness);
    outEmission = vec4(look.emission, 1.0);
    outMaterialId = surface.material.x;
    outThickness = thickness;
}
