// One layer of blended surfaces, lit: radiance times the share of it that is seen, and that share. The texture's and the
// vertices' alpha say how much of the pixel is covered, for reflection too; the surface's own alpha says how much of what
// is behind the covered part is hidden, and reflects as if it were opaque.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "ggx.glsl"
#include "environment.glsl"
#include "surface_textures.glsl"
#include "surface_look.glsl"

layout(set = 0, binding = 0, std140) uniform View {
    ViewConstants view;
};
layout(set = 0, binding = 2, std140) uniform EnvironmentBlock {
    EnvironmentConstants environment;
};
layout(set = 0, binding = 3, std430) readonly buffer Lights {
    LightConstants lights[];
};
layout(set = 0, binding = 4) uniform sampler2DArray shadowMaps;
layout(set = 0, binding = 5) uniform samplerCube specularEnvironment;
layout(set = 0, binding = 6) uniform sampler2D reflectanceImage;

#include "camera_rays.glsl"
#include "shadow_filter.glsl"
#include "shading.glsl"

layout(location = 0) out vec4 outBlended;

void main() {
    SurfaceConstants constants = surfaces[draw.index.x];
    vec4 own = textureColor(inUv[baseColorSlot], inColor);
    Look look = lookOf(constants, constants.baseColor.rgb * own.rgb);
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface;
    surface.position = worldPosition(pixel, inDepth);
    surface.normal = look.shadingNormal;
    surface.vertexNormal = look.vertexNormal;
    surface.toView = -viewDirection(pixel);
    surface.f0 = look.f0;
    surface.alpha = alphaOf(look.roughness);
    surface.secondLobe = 0.0;
    surface.secondAlpha = 1.0;
    Light light = lightOn(surface, draw.index.y, 1.0);
    float opacity = constants.baseColor.a;
    vec3 radiance = opacity * (look.albedo / pi * light.diffuse + look.emission) + light.specular;
    outBlended = own.a * vec4(min(radiance, 65504.0), opacity);
}
