// Diffuse light of every pixel. Of those with subsurface scattering it goes to the irradiance image, and their picture gets
// the effect's light later; the others are done.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ellipsoid.glsl"
layout(binding = 1) uniform sampler2D depthImage;
layout(binding = 2) uniform usampler2D stencilImage;
layout(binding = 3) uniform sampler2D normalImage;
layout(binding = 4) uniform sampler2D albedoImage;
layout(binding = 5) uniform sampler2DArray shadowMap;
layout(location = 0) out vec4 irradianceOut;
layout(location = 1) out vec4 pictureOut;

vec3 normalAt(ivec2 pixel) {
    vec2 value = texelFetch(normalImage, pixel, 0).xy;
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
    vec4 clip = shadowClipFromWorld[cascade] * vec4(position + 0.001 * float(1 + 2 * cascade) * normal, 1.0);
    ivec2 size = textureSize(shadowMap, 0).xy;
    ivec2 texel = ivec2((0.5 * clip.xy + 0.5) * vec2(size));
    float lit = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(texel + ivec2(i % 3, i / 3) - 1, ivec2(0), size - 1);
        lit += texelFetch(shadowMap, ivec3(at, cascade), 0).r > clip.z - 0.0005 ? 1.0 / 9.0 : 0.0;
    }
    return lit;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    irradianceOut = vec4(0.0);
    pictureOut = vec4(0.02, 0.025, 0.03, 1.0);
    float depth = texelFetch(depthImage, pixel, 0).r;
    if (depth == 0.0) { // reversed: nothing was drawn
        return;
    }
    float viewDepth = clipFromView[3][2] / depth;
    vec2 clip = gl_FragCoord.xy / vec2(textureSize(depthImage, 0)) * 2.0 - 1.0;
    vec4 inView = vec4(clip.x / clipFromView[0][0] * viewDepth, clip.y / clipFromView[1][1] * viewDepth, -viewDepth, 1.0);
    vec3 position = (worldFromView * inView).xyz;
    vec3 normal = mat3(worldFromView) * normalAt(pixel);
    float direct = max(dot(normal, -lightDirection.xyz), 0.0);
    vec3 irradiance = vec3(lightDirection.w * direct * litShare(position, normal, viewDepth) + 0.15 + 0.1 * normal.y);
    bool scatters = (texelFetch(stencilImage, pixel, 0).r >> 4) != 0u;
    irradianceOut = vec4(irradiance, 1.0);
    pictureOut.rgb = scatters ? vec3(0.0) : texelFetch(albedoImage, pixel, 0).rgb / 3.14159265 * irradiance;
}
