// Technique `burley`: a disc of samples, one pass. The samples' distances follow the profile of the material's widest
// channel (inverse CDF), their directions a golden-angle spiral turned per pixel; each weighs what the profile says of
// its true distance over what it was drawn with (Golubev, SIGGRAPH 2018, "Efficient screen-space subsurface scattering
// using Burley's normalized diffusion in real time"). The pixel's own light weighs the profile's mass over its area, so
// that samples are spent on its neighbours alone. What rejected samples would have given is renormalised.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"
#include "interface/tangent_plane.glsl"
#include "burley_blocks.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    BurleyTable tables[];
};

const float pi = 3.14159265;
const float goldenAngle = 2.39996323;
// [px²] Projected area of the disc that one sample stands for, until the budget binds (as in Unity's HDRP).
const float areaPerSample = 4.0;

struct Sum {
    vec3 light;
    vec3 weight;
};

// What the samples of one pixel have in common.
struct Disc {
    ivec2 pixel;
    uint material;
    float scale;     // of the profile's lengths
    float radius;    // mm
    vec3 position;   // view space, mm
    float pixelArea; // mm², facing the camera
    vec3 meanFreePath;
    bool analytic; // Burley's profile in closed form, else the tables
};

// [0, 1) Interleaved gradient noise (Jimenez 2014, "Next generation post processing in Call of Duty: Advanced Warfare").
float gradientNoise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Where a distance lies in the tables: index and fraction.
vec2 tablePosition(Disc disc, float distance) {
    float position = sqrt(min(distance / disc.radius, 1.0)) * float(burleyEntries - 1u);
    float index = min(floor(position), float(burleyEntries - 2u));
    return vec2(index, position - index);
}

// R at a distance, up to a factor that is the same everywhere.
vec3 profile(Disc disc, float distance) {
    if (disc.analytic) {
        vec3 decay = exp(-distance / (3.0 * disc.meanFreePath));
        return (decay * decay * decay + decay) / (disc.meanFreePath * distance);
    }
    vec2 at = tablePosition(disc, distance);
    uint index = uint(at.x);
    return mix(tables[disc.material].radial[index].rgb, tables[disc.material].radial[index + 1u].rgb, at.y);
}

// Share of the light within a distance.
vec3 cumulative(Disc disc, float distance) {
    if (disc.analytic) {
        vec3 decay = exp(-distance / (3.0 * disc.meanFreePath));
        return 1.0 - 0.25 * decay * decay * decay - 0.75 * decay;
    }
    vec2 at = tablePosition(disc, distance);
    uint index = uint(at.x);
    return mix(tables[disc.material].cumulative[index].rgb, tables[disc.material].cumulative[index + 1u].rgb, at.y);
}

// The distance within which a share [0, tables[].share] of the widest channel's light leaves.
float inverseCumulative(Disc disc, float share) {
    if (disc.analytic) {
        float rest = 1.0 - share;
        float g = 1.0 + 4.0 * rest * (2.0 * rest + sqrt(1.0 + 4.0 * rest * rest));
        float root = pow(g, 1.0 / 3.0);
        return 3.0 * disc.meanFreePath[tables[disc.material].widest] * log((1.0 + 1.0 / root + root) / (4.0 * rest));
    }
    float within = share / tables[disc.material].share;
    float position = (1.0 - sqrt(max(1.0 - within, 0.0))) * float(burleyEntries - 1u);
    uint index = min(uint(position), burleyEntries - 2u);
    float squared = mix(tables[disc.material].radial[index].w, tables[disc.material].radial[index + 1u].w, position - float(index));
    return disc.scale * sqrt(squared);
}

// Adds one sample at an offset in px; `density` is the widest channel's profile at the distance it was drawn with.
void addSample(Disc disc, vec2 offset, float density, inout Sum sum) {
    vec2 nearest = round(offset);
    ivec2 source = disc.pixel + ivec2(nearest);
    if (!isInArea(source)) {
        return;
    }
    uint material = materialAt(source);
    float z = viewZ(source);
    if (!exchanges(material, disc.material) || !isValidZ(z)) {
        return;
    }
    vec3 light = enteringLight(source, material);
    if (!isFinite(light)) {
        return;
    }
    // The surface runs on within the source pixel to where the sample fell.
    vec2 inside = offset - nearest;
    vec3 point = viewPosition(source, z);
    float area = 1.0;
    if (hasFlag(flagNormal)) {
        TangentPlane plane = normalPlane(source, z);
        point += inside.x * plane.x + inside.y * plane.y;
        area = plane.area / disc.pixelArea;
    } else {
        point.xy += inside.x * stepX(z) + inside.y * stepY(z);
    }
    float distance = max(length(point - disc.position), 1e-6);
    if (distance < disc.radius) {
        vec3 weight = profile(disc, distance) * (area / density);
        sum.light += weight * light;
        sum.weight += weight;
    }
}

// The disc's samples. They lie outside the disc `inner` that is as large as the pixel.
Sum gatherSamples(Disc disc, float inner, mat2 pixelsPerMm, int sampleCount) {
    uint widest = tables[disc.material].widest;
    float first = cumulative(disc, inner)[widest];
    float last = max(tables[disc.material].share, first);
    // The rotation's 64 steps move the noise as Jimenez does per frame.
    vec2 noisePixel = vec2(disc.pixel - view.areaOffset) + 5.588238 * float(parameters.burleyRotation % 64u);
    float turn = 2.0 * pi * gradientNoise(noisePixel);
    Sum sum = Sum(vec3(0.0), vec3(0.0));
    for (int i = 0; i < sampleCount; ++i) {
        float share = mix(first, last, (float(i) + 0.5) / float(sampleCount));
        float distance = max(inverseCumulative(disc, share), inner);
        float density = profile(disc, distance)[widest];
        float angle = turn + goldenAngle * float(i);
        if (density > 0.0) {
            addSample(disc, pixelsPerMm * (distance * vec2(cos(angle), sin(angle))), density, sum);
        }
    }
    float share = (last - first) / float(sampleCount);
    return Sum(share * sum.light, share * sum.weight);
}

vec3 gather(Disc disc, float z, int sampleCount) {
    mat2 mmPerPixel = mat2(stepX(z), stepY(z));
    disc.pixelArea = abs(determinant(mmPerPixel));
    Sum sum = gatherSamples(disc, sqrt(disc.pixelArea / pi), inverse(mmPerPixel), sampleCount);
    vec3 own = enteringLight(disc.pixel, disc.material);
    if (isFinite(own)) {
        float area = hasFlag(flagNormal) ? normalPlane(disc.pixel, z).area : disc.pixelArea;
        vec3 weight = cumulative(disc, sqrt(area / pi));
        sum.light += weight * own;
        sum.weight += weight;
    }
    return sum.light / max(sum.weight, vec3(1e-20));
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    float scale = scaleAt(pixel);
    float radius = scale * materials[material].radius;
    float radiusPixels = radius / (parameters.pixelWidth * clipW(z));
    if (material == 0u || !isValidZ(z) || strengthAt(pixel, material) == 0.0 || radiusPixels < 1.0) {
        writeUnscattered(pixel, material);
        return;
    }
    float wanted = ceil(pi * radiusPixels * radiusPixels / areaPerSample);
    int sampleCount = int(min(wanted, float(parameters.burleySampleBudget)));
    vec3 meanFreePath = scale * tables[material].meanFreePath.rgb;
    Disc disc = Disc(pixel, material, scale, radius, viewPosition(pixel, z), 0.0, meanFreePath, meanFreePath.r > 0.0);
    writeScattered(pixel, material, gather(disc, z, sampleCount));
}
