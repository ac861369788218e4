// As lighting.frag, of four samples a pixel: one surface is made of those of one material, for the effect; the light of the
// others is done. What the effect adds goes into the picture in their share, since the albedo has it.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SAMPLER sampler2DMS
#define USAMPLER usampler2DMS
#include "ellipsoid.glsl"
#include "light.glsl"
layout(location = 0) out vec4 irradianceOut;
layout(location = 1) out vec4 pictureOut;
layout(location = 2) out vec4 albedoOut;
layout(location = 3) out vec2 normalOut;
layout(location = 4) out float depthOut;
layout(location = 5) out uint idOut;

// [snippet: raster-resolve]
void main() {
    const int count = 4;
    Surface samples[count];
    int nearest = 0;
    for (int i = 0; i < count; ++i) {
        samples[i] = surfaceAt(ivec2(gl_FragCoord.xy), textureSize(depthImage), i);
        nearest = samples[i].depth > samples[nearest].depth ? i : nearest; // reversed
    }
    uint stencil = samples[nearest].stencil;
    vec3 irradiance = vec3(0.0), albedo = vec3(0.0), others = vec3(0.0);
    float alike = 0.0;
    for (int i = 0; i < count; ++i) {
        bool isAlike = samples[i].stencil == stencil && scatters(stencil);
        alike += isAlike ? 1.0 : 0.0;
        irradiance += isAlike ? samples[i].irradiance : vec3(0.0);
        albedo += isAlike ? samples[i].albedo : vec3(0.0);
        others += isAlike ? vec3(0.0) : samples[i].radiance;
    }
    irradianceOut = vec4(irradiance / max(alike, 1.0), 1.0);
    albedoOut = vec4(albedo / float(count), 1.0); // times the share of the samples
    pictureOut = vec4(others / float(count), 1.0);
    normalOut = samples[nearest].normal;
    depthOut = samples[nearest].depth;
    idOut = stencil;
}
// [end]
