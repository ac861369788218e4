// How much of the surroundings each surface sees in the depth image: horizons along slices through the view direction,
// their cosine-weighted visibility in closed form (Jimenez, Wu, Pesce and Jarabo 2016, "Practical Realtime Strategies for
// Accurate Indirect Occlusion", eqs. 6 and 7). The slices turn in a pattern of 4 by 4 pixels, which
// ambient_occlusion_filter.comp averages.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0, std140) uniform View {
    ViewConstants view;
};
layout(set = 0, binding = 1) uniform sampler2D depthImage;
layout(set = 0, binding = 2) uniform sampler2D vertexNormalImage;
layout(set = 0, binding = 3, r32f) uniform writeonly image2D outVisibility;
layout(push_constant) uniform Push {
    float radius; // scene units
};

#include "camera_rays.glsl"

const float pi = 3.14159265358979;
const uint sliceCount = 2u;
const uint stepCount = 6u;
/// Share of the picture's height that the search covers at most: beyond, steps would skip whole bodies.
const float largestRadius = 0.15;
/// Cosine by which something must rise above the horizon to count: steps end on pixels beside their slice, where a flat
/// surface would otherwise seem to rise.
const float tolerance = 0.03;

/// Cosine-weighted light between the normal and the horizon at angle h, for a normal at angle n in the slice.
float arc(float h, float n) {
    return 0.25 * (-cos(2.0 * h - n) + cos(n) + 2.0 * h * sin(n));
}

/// Cosine of the horizon against `toView`, looking from `position` along `step` (pixels) with `jitter` in [0, 1).
float horizon(ivec2 pixel, vec3 position, vec3 toView, vec2 direction, float radiusPixels, float jitter, float start) {
    float highest = start;
    for (uint i = 0u; i < stepCount; ++i) {
        float t = (float(i) + jitter) / float(stepCount);
        ivec2 at = pixel + ivec2(round(direction * max(t * t * radiusPixels, float(i) + 1.0)));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(view.size.xy)))) {
            break;
        }
        vec3 offset = worldPosition(at, texelFetch(depthImage, at, 0).r) - position;
        float distance = length(offset);
        float fade = clamp(2.0 - 2.0 * distance / radius, 0.0, 1.0);
        highest = max(highest, mix(start, dot(offset, toView) / max(distance, 1e-20) - tolerance, fade));
    }
    return highest;
}

float visibility(ivec2 pixel, float depth, vec3 normal) {
    vec3 position = worldPosition(pixel, depth);
    vec3 toView = -viewDirection(pixel);
    float unitsPerPixel = 2.0 * view.unproject.x / float(view.size.x) * (view.size.z != 0u ? depth : 1.0);
    float radiusPixels = min(radius / unitsPerPixel, largestRadius * float(view.size.y));
    uint turn = uint(pixel.x & 3) * 4u + uint(pixel.y & 3);
    // Steps of 5 spread neighbouring turns; 5 and 16 have no common divisor.
    float rotation = float((turn * 5u) & 15u) / 16.0;
    float jitter = float((turn * 11u) & 15u) / 16.0;
    float sum = 0.0;
    for (uint i = 0u; i < sliceCount; ++i) {
        float phi = (float(i) + rotation) * pi / float(sliceCount);
        vec2 direction = vec2(cos(phi), sin(phi));
        vec3 along = mat3(view.worldFromView) * vec3(direction.x, -direction.y, 0.0);
        along = normalize(along - toView * dot(along, toView));
        vec3 axis = cross(along, toView);
        vec3 inSlice = normal - axis * dot(normal, axis);
        float inSliceLength = max(length(inSlice), 1e-6);
        float n = (dot(along, inSlice) < 0.0 ? -1.0 : 1.0) * acos(clamp(dot(inSlice, toView) / inSliceLength, -1.0, 1.0));
        float ahead = acos(horizon(pixel, position, toView, direction, radiusPixels, jitter, cos(min(n + pi / 2.0, pi))));
        float behind =
            -acos(horizon(pixel, position, toView, -direction, radiusPixels, jitter, cos(max(n - pi / 2.0, -pi))));
        sum += inSliceLength *
               (arc(min(ahead, n + pi / 2.0), n) + arc(max(behind, n - pi / 2.0), n));
    }
    return clamp(sum / float(sliceCount), 0.0, 1.0);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(view.size.xy)))) {
        return;
    }
    vec4 normal = texelFetch(vertexNormalImage, pixel, 0);
    float result = 1.0;
    if (normal.w > 0.0) {
        result = visibility(pixel, texelFetch(depthImage, pixel, 0).r, normalize(normal.xyz));
    }
    imageStore(outVisibility, pixel, vec4(result));
}
