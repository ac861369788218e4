// Draws the window's pixels from the sums of its two sides: the one beside the other, or how they differ.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shader_types.h"
#include "tone_curve.glsl"

layout(local_size_x = groupSize, local_size_y = groupSize) in;
layout(set = 0, binding = 0, std430) readonly buffer Sums {
    vec4 sums[];
};
layout(set = 0, binding = 1, std430) writeonly buffer Pixels {
    uint pixels[];
};
layout(push_constant) uniform Push {
    ShowConstants constants;
};

vec3 texel(uvec4 side, ivec2 place) {
    ivec2 last = ivec2(side.xy) - 1;
    ivec2 inside = clamp(place, ivec2(0), last);
    vec4 sum = sums[2u * (side.z + uint(inside.y) * side.x + uint(inside.x))];
    return sum.rgb / max(sum.w, 1.0);
}

/// The side's picture at a place in [0, 1]²: its own pixels where it is as large as it is shown, else between them.
vec3 colorAt(uvec4 side, vec2 place) {
    vec2 at = place * vec2(side.xy) - 0.5;
    vec2 share = at - floor(at);
    ivec2 corner = ivec2(floor(at));
    if (all(lessThan(abs(share - round(share)), vec2(1e-3)))) {
        return texel(side, ivec2(round(at)));
    }
    return mix(mix(texel(side, corner), texel(side, corner + ivec2(1, 0)), share.x),
               mix(texel(side, corner + ivec2(0, 1)), texel(side, corner + ivec2(1, 1)), share.x), share.y);
}

/// Black over red and yellow to white.
vec3 heat(float share) {
    return clamp(vec3(3.0 * share, 3.0 * share - 1.0, 3.0 * share - 2.0), 0.0, 1.0);
}

uint pack(vec3 color) {
    uvec3 bytes = uvec3(clamp(color, 0.0, 1.0) * 255.0 + 0.5);
    return (constants.place.w != 0u ? bytes.z | bytes.y << 8 | bytes.x << 16 : bytes.x | bytes.y << 8 | bytes.z << 16) |
           0xff000000u;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), constants.place.xy))) {
        return;
    }
    // The picture keeps its shape, with bars where the window has another.
    vec2 window = vec2(constants.place.xy);
    vec2 shape = vec2(constants.sides[0].xy);
    float zoom = min(window.x / shape.x, window.y / shape.y);
    vec2 place = ((vec2(pixel) + 0.5) - 0.5 * (window - shape * zoom)) / (shape * zoom);
    vec3 color = vec3(0.06);
    if (all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(1.0)))) {
        vec3 first = encodeSrgb(colorAt(constants.sides[0], place));
        color = first;
        if (constants.place.z == showDifference) {
            vec3 difference = abs(first - encodeSrgb(colorAt(constants.sides[1], place)));
            color = heat(constants.divider.y * max(difference.r, max(difference.g, difference.b)));
        } else if (constants.place.z == showBoth) {
            float fromDivider = (place.x - constants.divider.x) * shape.x * zoom;
            color = fromDivider > 0.0 ? encodeSrgb(colorAt(constants.sides[1], place)) : first;
            color = abs(fromDivider) < 1.0 ? vec3(1.0) : abs(fromDivider) < 2.0 ? vec3(0.0) : color;
        }
        color += (noise(pixel) - 0.5) / 255.0;
    }
    pixels[uint(pixel.y) * constants.place.x + uint(pixel.x)] = pack(color);
}
