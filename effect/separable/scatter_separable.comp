// One direction of separable scattering: HORIZONTAL reads the irradiance and writes `rows`, else reads `rows` and
// writes the output. Tap weights are masses of the profile's line-spread over pixel cells; a tap's cell is measured
// along the surface, by the 3-D distance, which is the bilateral weight the profile itself implies: for a Gaussian it
// multiplies with exp(-Δz²/2v). Light beyond the accepted taps is renormalised.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"
#include "separable_blocks.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    vec4 lineSpread[];
};
layout(set = 0, binding = bindingIntermediates + intermediateRows, rgba16f) uniform image2D rows;

// Taps on either side. Up to this footprint every pixel is a tap; beyond, taps move apart quadratically. 32 keeps the
// step that one tap makes in a shadow edge's response under 1 % at 60 px.
const int maxTaps = 32;

// Half the line-spread's mass within ±x mm, given what is outermost of it.
vec3 massWithin(uint material, float radius, float x) {
    float position = sqrt(min(x / radius, 1.0)) * float(lineSpreadEntries - 1u);
    uint index = min(uint(position), lineSpreadEntries - 2u);
    uint base = material * lineSpreadEntries + index;
    return mix(lineSpread[base].rgb, lineSpread[base + 1u].rgb, position - float(index));
}

// Offset of tap k in px for a radius in px.
float tapOffset(int k, float radius) {
    float share = float(k) / float(maxTaps);
    return round(float(k) + max(radius - float(maxTaps), 0.0) * share * share);
}

struct Tap {
    vec3 light;
    bool accepted;
    float stretch; // distance along the surface over distance on screen
};

Tap fetchTap(ivec2 pixel, uint receiver, vec3 position, float screenDistance) {
    Tap tap = Tap(vec3(0.0), false, 1.0);
    if (!isInArea(pixel)) {
        return tap;
    }
    uint material = materialAt(pixel);
    if (!exchanges(material, receiver)) {
        return tap;
    }
    float z = viewZ(pixel);
    if (!isValidZ(z)) {
        return tap;
    }
#ifdef HORIZONTAL
    tap.light = enteringLight(pixel, material);
#else
    tap.light = imageLoad(rows, pixel - view.areaOffset).rgb;
#endif
    tap.accepted = isFinite(tap.light);
    tap.stretch = distance(viewPosition(pixel, z), position) / screenDistance;
    return tap;
}

vec3 gather(ivec2 pixel, uint material, float z) {
#ifdef HORIZONTAL
    const ivec2 direction = ivec2(1, 0);
    float pixelSize = length(stepX(z));
    vec3 center = enteringLight(pixel, material);
#else
    const ivec2 direction = ivec2(0, 1);
    float pixelSize = length(stepY(z));
    vec3 center = imageLoad(rows, pixel - view.areaOffset).rgb;
#endif
    vec3 position = viewPosition(pixel, z);
    float reach = scaleAt(pixel) * materials[material].radius;
    float radius = reach / pixelSize;
    int taps = int(min(ceil(radius - 0.5), float(maxTaps)));

    vec3 light = vec3(0.0);
    vec3 weight = vec3(0.0);
    float centerStretch = 1e30;
    for (int k = 1; k <= taps; ++k) {
        float offset = tapOffset(k, radius);
        float near = 0.5 * (tapOffset(k - 1, radius) + offset) * pixelSize;
        float far = 0.5 * (tapOffset(k + 1, radius) + offset) * pixelSize;
        for (int side = -1; side <= 1; side += 2) {
            Tap tap = fetchTap(pixel + side * int(offset) * direction, material, position, offset * pixelSize);
            if (tap.accepted) {
                vec3 mass = massWithin(material, reach, far * tap.stretch) - massWithin(material, reach, near * tap.stretch);
                light += mass * tap.light;
                weight += mass;
                centerStretch = k == 1 ? min(centerStretch, tap.stretch) : centerStretch;
            }
        }
    }
    if (isFinite(center)) {
        vec3 mass = 2.0 * massWithin(material, reach, 0.5 * pixelSize * (centerStretch < 1e30 ? centerStretch : 1.0));
        light += mass * center;
        weight += mass;
    }
    return light / max(weight, vec3(1e-20));
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    bool scatters = material != 0u && isValidZ(z) && materials[material].radius > 0.0;
#ifdef HORIZONTAL
    // An infinite or absurdly bright source saturates instead of becoming an infinity that the other pass spreads.
    imageStore(rows, local, vec4(scatters ? clamp(gather(pixel, material, z), vec3(-maxHalf), vec3(maxHalf)) : vec3(0.0), 1.0));
#else
    if (scatters && strengthAt(pixel, material) > 0.0) {
        writeScattered(pixel, material, gather(pixel, material, z));
    } else {
        writeUnscattered(pixel, material);
    }
#endif
}
