// Diffuse light of every pixel. Of those with subsurface scattering it goes to the irradiance image, and their picture gets
// the effect's light later; the others are done.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SAMPLER sampler2D
#define USAMPLER usampler2D
#include "ellipsoid.glsl"
#include "light.glsl"
layout(location = 0) out vec4 irradianceOut;
layout(location = 1) out vec4 pictureOut;

void main() {
    Surface surface = surfaceAt(ivec2(gl_FragCoord.xy), textureSize(depthImage, 0), 0);
    irradianceOut = vec4(surface.irradiance, 1.0);
    pictureOut = vec4(scatters(surface.stencil) ? vec3(0.0) : surface.radiance, 1.0);
}
