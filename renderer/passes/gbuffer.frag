#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "surface_textures.glsl"

layout(constant_id = 0) const bool alphaMask = false;

layout(location = 0) in vec3 inNormal;
layout(location = 1) in vec4 inTangent;
layout(location = 2) in vec2 inUv;
layout(location = 3) in float inDepth;
layout(location = 4) in vec4 inColor;

// The order of GBuffer::Attachment.
layout(location = 0) out float outDepth;
layout(location = 1) out vec4 outShadingNormal;
layout(location = 2) out vec4 outVertexNormal;
layout(location = 3) out vec4 outAlbedo;
layout(location = 4) out vec4 outReflection;
layout(location = 5) out vec4 outEmission;
layout(location = 6) out uint outMaterialId;
layout(location = 7) out float outThickness;

vec3 shadingNormal(SurfaceConstants surface, vec3 normal) {
    vec3 tangent = inTangent.xyz - normal * dot(normal, inTangent.xyz);
    float tangentLength = length(tangent);
    if (!has(hasNormalTexture) || tangentLength < 1e-12) {
        return normal;
    }
    tangent /= tangentLength;
    vec3 bitangent = cross(normal, tangent) * inTangent.w;
    vec3 detail = texture(normalTexture, inUv).xyz * 2.0 - 1.0;
    detail.xy *= surface.emission.w;
    return normalize(tangent * detail.x + bitangent * detail.y + normal * max(detail.z, 1e-3));
}

void main() {
    SurfaceConstants surface = surfaces[draw.index.x];
    vec4 color = baseColor(surface, inUv, inColor);
    if (alphaMask && color.a < surface.parameters.w) {
        discard;
    }
    bool flip = has(isDoubleSided) && !gl_FrontFacing;
    vec3 normal = normalize(inNormal) * (flip ? -1.0 : 1.0);

    float metallic = surface.parameters.x;
    float roughness = surface.parameters.y;
    if (has(hasMetallicRoughnessTexture)) {
        vec4 texel = texture(metallicRoughnessTexture, inUv);
        metallic *= texel.b;
        roughness *= texel.g;
    }
    float thickness = surface.uvTransformU.w;
    if (thickness > 0.0 && has(hasThicknessTexture)) {
        // A small positive value keeps an authored zero apart from "none".
        thickness = max(thickness * texture(thicknessTexture, inUv).g, 1e-3);
    }

    outDepth = inDepth;
    outShadingNormal = vec4(shadingNormal(surface, normal), 1.0);
    outVertexNormal = vec4(normal, 1.0);
    outAlbedo = vec4(color.rgb * (1.0 - metallic), 1.0);
    outReflection = vec4(mix(vec3(0.08 * surface.parameters.z), color.rgb, metallic), roughness);
    vec3 emission = surface.emission.rgb;
    if (has(hasEmissionTexture)) {
        emission *= texture(emissionTexture, inUv).rgb;
    }
    outEmission = vec4(emission, 1.0);
    outMaterialId = surface.material.x;
    outThickness = thickness;
}
