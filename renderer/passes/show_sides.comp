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
layout(set = 0, binding = 2, std430) readonly buffer Marks {
    Mark marks[];
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

/// Distance of a point from the line between two others.
float fromLine(vec2 point, vec2 begin, vec2 end) {
    vec2 along = end - begin;
    float share = clamp(dot(point - begin, along) / max(dot(along, along), 1e-6), 0.0, 1.0);
    return distance(point, begin + share * along);
}

/// The mark with its dark rim, over `color`. `distance` is to where it is drawn, px.
vec3 over(vec3 color, vec3 mark, float fromMark) {
    vec3 rim = mix(vec3(0.0), color, 0.35 + 0.65 * smoothstep(1.0, 2.5, fromMark));
    return mix(mark, rim, smoothstep(-0.5, 0.5, fromMark));
}

/// Everything that marks[] draw over this pixel; `corner` and `size` are the picture's in the window, px.
vec3 marked(vec3 color, vec2 pixel, vec2 corner, vec2 size) {
    for (int i = 0; i < int(constants.divider.z); ++i) {
        vec2 disc = corner + marks[i].place.xy * size;
        float radius = abs(marks[i].color.w);
        color = over(color, marks[i].color.rgb, fromLine(pixel, disc, corner + marks[i].place.zw * size) - 1.0);
        float fromDisc = distance(pixel, disc) - radius;
        color = over(color, marks[i].color.rgb, marks[i].color.w < 0.0 ? abs(fromDisc + 1.5) - 1.5 : fromDisc);
    }
    return color;
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
    color = marked(color, vec2(pixel) + 0.5, 0.5 * (window - shape * zoom), shape * zoom);
    pixels[uint(pixel.y) * constants.place.x + uint(pixel.x)] = pack(color);
}
