// Diffuse light of a sample, from the G-buffer. SAMPLER, USAMPLER: the types of its images, with one sample a pixel or more.
layout(binding = 1) uniform SAMPLER depthImage;
layout(binding = 2) uniform USAMPLER stencilImage;
layout(binding = 3) uniform SAMPLER normalImage;
layout(binding = 4) uniform SAMPLER albedoImage;
layout(binding = 5) uniform sampler2DArray shadowMap;

struct Surface {
    float depth; // as stored: reversed, 0 = nothing was drawn
    uint stencil;
    vec2 normal; // as stored
    vec3 albedo;
    vec3 irradiance;
    vec3 radiance; // without subsurface scattering
};

vec3 decodedNormal(vec2 value) {
    vec3 n = vec3(value, 1.0 - abs(value.x) - abs(value.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(value.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(value, vec2(0.0)));
    }
    return normalize(n);
}

// [0, 1] How much of the light arrives: the cascade that reaches as far, 3x3 texels of it.
float litShare(vec3 position, vec3 normal, float viewDepth) {
    int cascade = int(dot(vec4(greaterThan(vec4(viewDepth), cascadeEnds)), vec4(1.0)));
    if (cascade > 3) {
        return 1.0;
    }
    vec4 clip = shadowClipFromWorld[cascade] * vec4(position + 0.0006 * float(1 + cascade) * normal, 1.0);
    ivec2 size = textureSize(shadowMap, 0).xy;
    ivec2 texel = ivec2((0.5 * clip.xy + 0.5) * vec2(size));
    float lit = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1);
        lit += texelFetch(shadowMap, ivec3(at, cascade), 0).r > clip.z - 0.0005 ? 1.0 / 9.0 : 0.0;
    }
    return lit;
}

bool scatters(uint stencil) {
    return (stencil >> 4) != 0u;
}

// index: of the sample, or 0.
Surface surfaceAt(ivec2 pixel, ivec2 size, int index) {
    Surface surface;
    surface.depth = texelFetch(depthImage, pixel, index).r;
    surface.stencil = texelFetch(stencilImage, pixel, index).r;
    surface.normal = texelFetch(normalImage, pixel, index).xy;
    surface.albedo = texelFetch(albedoImage, pixel, index).rgb;
    surface.irradiance = vec3(0.0);
    surface.radiance = vec3(surroundings / 3.14159265);
    if (surface.depth > 0.0) {
        float viewDepth = clipFromView[3][2] / surface.depth;
        vec2 clip = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
        vec4 inView = vec4(clip.x / clipFromView[0][0] * viewDepth, clip.y / clipFromView[1][1] * viewDepth, -viewDepth, 1.0);
        vec3 position = (worldFromView * inView).xyz;
        vec3 normal = mat3(worldFromView) * decodedNormal(surface.normal);
        float direct = max(dot(normal, -lightDirection.xyz), 0.0);
        float lit = direct > 0.0 ? litShare(position, normal, viewDepth) : 0.0;
        surface.irradiance = vec3(lightDirection.w * direct * lit + surroundings);
        surface.radiance = surface.albedo / 3.14159265 * surface.irradiance;
    }
    return surface;
}
