// How a surface looks at a fragment, for the shaders that follow gbuffer.vert. Included after surface_textures.glsl.
layout(location = 0) in vec3 inNormal;
layout(location = 1) in vec4 inTangent;
layout(location = 2) in float inDepth;
layout(location = 3) in vec4 inColor;
layout(location = 4) in vec2 inUv[textureSlotCount];

struct Look {
    vec3 vertexNormal;
    vec3 shadingNormal; ///< with the normal map
    vec3 albedo;        ///< diffuse
    vec3 f0;
    float roughness;
    vec3 emission;
};

vec3 mappedNormal(SurfaceConstants surface, vec3 normal) {
    vec3 tangent = inTangent.xyz - normal * dot(normal, inTangent.xyz);
    float tangentLength = length(tangent);
    if (!hasTexture(normalSlot) || tangentLength < 1e-12) {
        return normal;
    }
    tangent /= tangentLength;
    vec3 bitangent = cross(normal, tangent) * inTangent.w;
    vec3 detail = texture(normalTexture, settled(inUv[normalSlot])).xyz * 2.0 - 1.0;
    detail.xy *= surface.emission.w;
    return normalize(tangent * detail.x + bitangent * detail.y + normal * max(detail.z, 1e-3));
}

Look lookOf(SurfaceConstants surface, vec3 color) {
    bool flip = (draw.index.w & isDoubleSided) != 0u && !gl_FrontFacing;
    float metallic = surface.parameters.x;
    Look look;
    look.roughness = surface.parameters.y;
    if (hasTexture(metallicRoughnessSlot)) {
        vec4 texel = texture(metallicRoughnessTexture, settled(inUv[metallicRoughnessSlot]));
        metallic *= texel.b;
        look.roughness *= texel.g;
    }
    look.vertexNormal = normalize(inNormal) * (flip ? -1.0 : 1.0);
    look.shadingNormal = mappedNormal(surface, look.vertexNormal);
    look.albedo = color * (1.0 - metallic);
    look.f0 = mix(vec3(0.08 * surface.parameters.z), color, metallic);
    look.emission = surface.emission.rgb;
    if (hasTexture(emissionSlot)) {
        look.emission *= texture(emissionTexture, settled(inUv[emissionSlot])).rgb;
    }
    return look;
}
