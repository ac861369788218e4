// Second pass of `brute`: sum over every pixel within the radius of R(distance)·area·light, divided by that of
// R(distance)·area. Each of its dispatches adds one band of rows (bruteBandRows). A pixel's surface is a flat patch, lit
// evenly. Within cellRadius px the profile varies on a patch: there its integral over the patch is taken; further out its
// value at the pixel's centre, from the radial table.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface/scatter.glsl"
#include "interface/tangent_plane.glsl"
#include "brute_blocks.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    BruteTable tables[];
};
layout(set = 0, binding = bindingIntermediates + intermediatePixels, std430) readonly buffer Pixels {
    BrutePixel pixels[];
};
layout(set = 0, binding = bindingIntermediates + intermediateSums, std430) buffer Sums {
    BruteSum sums[];
};
layout(push_constant) uniform Dispatch {
    uint band;
};

// [px] Half width of the square whose patches are integrated. A Gaussian of 2 px, the narrowest whose values at pixel
// centres may stand for its integrals (edge response within 0.25 %), has fallen to 8 % there.
const int cellRadius = 4;
// [standard deviations] of a Gaussian, beyond which it is left out of the integrals.
const float gaussianReach = 4.5;
const float pi = 3.14159265;

struct Sum {
    vec3 light;
    vec3 weight;
};

struct Receiver {
    ivec2 local;
    uint material;
    vec3 position;
    float scale; // of the profile's lengths
};

// Abramowitz and Stegun 7.1.26, |error| < 1.5e-7.
float errorFunction(float x) {
    float t = 1.0 / (1.0 + 0.3275911 * abs(x));
    float tail = ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t;
    return sign(x) * (1.0 - tail * exp(-x * x));
}

// The pixel at an offset; its light's w is 0 when it gives the receiver nothing.
BrutePixel pixelAt(Receiver receiver, ivec2 offset) {
    ivec2 local = receiver.local + offset;
    if (any(lessThan(local, ivec2(0))) || any(greaterThanEqual(local, view.areaExtent))) {
        return BrutePixel(vec4(0.0), vec4(0.0), vec2(0.0), vec2(0.0));
    }
    BrutePixel pixel = pixels[local.y * view.areaExtent.x + local.x];
    if (pixel.light.w > 0.0 && !exchanges(uint(pixel.position.w), receiver.material)) {
        pixel.light.w = 0.0;
    }
    return pixel;
}

// The patch of a pixel at an offset.
TangentPlane patchAt(Receiver receiver, ivec2 offset, BrutePixel pixel) {
    return tangentPlane(receiver.local + offset + view.areaOffset, pixel.position.z, pixel.slope);
}

// Gauss-Legendre quadrature with ten points on [−1, 1], which is symmetric.
const float nodes[5] = float[](0.1488743390, 0.4333953941, 0.6794095683, 0.8650633667, 0.9739065285);
const float nodeWeights[5] = float[](0.2955242247, 0.2692667193, 0.2190863625, 0.1494513492, 0.0666713443);

// Integral of a Gaussian over the points offset + u·x + v·y, u and v in [−½, ½]: error functions along u, quadrature
// along v, over the part of it where the Gaussian is.
float patchMass(vec3 offset, TangentPlane surface, float variance) {
    float xx = dot(surface.x, surface.x);
    vec3 across = surface.y - surface.x * (dot(surface.y, surface.x) / xx); // parts across x
    vec3 offsetAcross = offset - surface.x * (dot(offset, surface.x) / xx);
    float acrossSquared = dot(across, across);
    float middle = -dot(offsetAcross, across) / acrossSquared;
    float reach = gaussianReach * sqrt(variance / acrossSquared);
    float low = max(-0.5, middle - reach);
    float high = min(0.5, middle + reach);
    if (low >= high) {
        return 0.0;
    }
    float scale = sqrt(xx / (2.0 * variance));
    float sum = 0.0;
    for (int i = 0; i < 10; ++i) {
        float node = i < 5 ? nodes[i] : -nodes[i - 5];
        float v = 0.5 * (low + high) + 0.5 * (high - low) * node;
        vec3 distanceAcross = offsetAcross + v * across;
        float nearest = -dot(offset + v * surface.y, surface.x) / xx; // u
        float alongMass = errorFunction((0.5 - nearest) * scale) + errorFunction((0.5 + nearest) * scale);
        sum += nodeWeights[i % 5] * exp(-dot(distanceAcross, distanceAcross) / (2.0 * variance)) * alongMass;
    }
    return 0.25 * sum * (high - low) * sqrt(acrossSquared / (2.0 * pi * variance));
}

// One Gaussian layer over the square's patches.
void addLayer(Receiver receiver, vec4 layer, inout Sum sum) {
    float variance = max(layer.w, 1e-8);
    float deviation = sqrt(variance);
    for (int y = -cellRadius; y <= cellRadius; ++y) {
        for (int x = -cellRadius; x <= cellRadius; ++x) {
            BrutePixel pixel = pixelAt(receiver, ivec2(x, y));
            if (pixel.light.w <= 0.0) {
                continue;
            }
            vec3 offset = pixel.position.xyz - receiver.position;
            TangentPlane surface = patchAt(receiver, ivec2(x, y), pixel);
            float halfSize = 0.5 * (length(surface.x) + length(surface.y));
            if (length(offset) < halfSize + gaussianReach * deviation) {
                vec3 weight = layer.rgb * patchMass(offset, surface, variance);
                sum.light += weight * pixel.light.rgb;
                sum.weight += weight;
            }
        }
    }
}

// Burley's profile (Christensen and Burley 2015) per channel, 1/mm².
vec3 burley(float distance, vec3 meanFreePath) {
    vec3 decay = exp(-distance / (3.0 * meanFreePath));
    return (decay * decay * decay + decay) / (8.0 * pi * meanFreePath * distance);
}

// The share of Burley's profile within a distance.
vec3 burleyWithin(float distance, vec3 meanFreePath) {
    vec3 decay = exp(-distance / (3.0 * meanFreePath));
    return 1.0 - 0.25 * decay * decay * decay - 0.75 * decay;
}

// Directions in which the receiver's own patch is measured, over half a turn.
const int outlineDirections = 64;

// Integral of Burley's profile over the receiver's own patch, around whose middle R has a pole: the mean, over directions on
// the surface, of the share within the distance to the patch's outline.
vec3 burleyOwnMass(TangentPlane surface, vec3 meanFreePath) {
    float alongLength = length(surface.x);
    vec3 along = surface.x / alongLength;
    float lean = dot(surface.y, along);
    float acrossLength = length(surface.y - along * lean);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < outlineDirections; ++i) {
        float angle = (float(i) + 0.5) * pi / float(outlineDirections);
        float v = sin(angle) / acrossLength; // in steps of y and of x
        float u = (cos(angle) - v * lean) / alongLength;
        sum += burleyWithin(0.5 / max(abs(u), abs(v)), meanFreePath);
    }
    return sum / float(outlineDirections);
}

// How finely a patch is sampled: `samples` a pixel's size, and no more than maxFineness times as many where the patch is
// longer than that.
const float maxFineness = 6.0;

int samplesAlong(vec3 side, float size, int samples) {
    return int(ceil(float(samples) * clamp(length(side) / size, 1.0, maxFineness)));
}

// The mean of Burley's profile over another pixel's patch.
vec3 burleyMean(Receiver receiver, vec3 middle, TangentPlane surface, int samples, vec3 meanFreePath) {
    float size = length(stepX(middle.z));
    ivec2 count = ivec2(samplesAlong(surface.x, size, samples), samplesAlong(surface.y, size, samples));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < count.x * count.y; ++i) {
        vec2 inside = (vec2(i % count.x, i / count.x) + 0.5) / vec2(count) - 0.5;
        vec3 point = middle + inside.x * surface.x + inside.y * surface.y;
        sum += burley(max(distance(point, receiver.position), 1e-6), meanFreePath);
    }
    return sum / float(count.x * count.y);
}

// Burley's profile over the square's patches, the nearest of which are sampled most finely.
void addBurley(Receiver receiver, vec3 meanFreePath, inout Sum sum) {
    for (int y = -cellRadius; y <= cellRadius; ++y) {
        for (int x = -cellRadius; x <= cellRadius; ++x) {
            BrutePixel pixel = pixelAt(receiver, ivec2(x, y));
            if (pixel.light.w <= 0.0) {
                continue;
            }
            TangentPlane surface = patchAt(receiver, ivec2(x, y), pixel);
            int ring = max(abs(x), abs(y));
            int samples = ring == 1 ? 6 : 2;
            vec3 weight =
                ring == 0 ? burleyOwnMass(surface, meanFreePath)
                          : pixel.light.w * burleyMean(receiver, pixel.position.xyz, surface, samples, meanFreePath);
            sum.light += weight * pixel.light.rgb;
            sum.weight += weight;
        }
    }
}

vec3 radialAt(uint material, float share) {
    float position = sqrt(share) * float(radialEntries - 1u);
    uint index = min(uint(position), radialEntries - 2u);
    return mix(tables[material].radial[index].rgb, tables[material].radial[index + 1u].rgb, position - float(index));
}

// The rows and columns of the area that lie within the radius, relative to the receiver, and its reach in px.
struct Window {
    ivec2 low, high;
    vec2 reach;
};

Window windowOf(Receiver receiver, float radius) {
    // Pixels per radius where the surface is nearest to the camera within it.
    float nearest = min(receiver.position.z + radius, 0.5 * receiver.position.z);
    Window window;
    window.reach = ceil(radius / vec2(length(stepX(nearest)), length(stepY(nearest))));
    ivec2 reach = ivec2(min(window.reach, vec2(32768.0)));
    // Not max(-reach, -receiver.local): with the maximum that main takes next, NVIDIA's driver 580.159.04 loses a sign.
    window.low = -min(reach, receiver.local);
    window.high = min(reach, view.areaExtent - 1 - receiver.local);
    return window;
}

// The pixels of the window that are outside the square.
void addFar(Receiver receiver, Window window, float radius, inout Sum sum) {
    for (int y = window.low.y; y <= window.high.y; ++y) {
        float height = float(y) / window.reach.y;
        int halfWidth = int(ceil(window.reach.x * sqrt(max(1.0 - height * height, 0.0))));
        for (int x = max(window.low.x, -halfWidth); x <= min(window.high.x, halfWidth); ++x) {
            if (max(abs(x), abs(y)) <= cellRadius) {
                continue;
            }
            BrutePixel pixel = pixelAt(receiver, ivec2(x, y));
            float share = distance(pixel.position.xyz, receiver.position) / radius;
            if (pixel.light.w > 0.0 && share < 1.0) {
                vec3 weight = radialAt(receiver.material, share) * (pixel.light.w / (receiver.scale * receiver.scale));
                sum.light += weight * pixel.light.rgb;
                sum.weight += weight;
            }
        }
    }
}

// The patches around the receiver.
Sum nearSum(Receiver receiver) {
    Sum sum = Sum(vec3(0.0), vec3(0.0));
    uint layerCount = uint(tables[receiver.material].meanFreePath.w);
    for (uint layer = 0u; layer < layerCount; ++layer) {
        addLayer(receiver, tables[receiver.material].layers[layer] * vec4(1.0, 1.0, 1.0, receiver.scale * receiver.scale), sum);
    }
    if (layerCount == 0u) {
        addBurley(receiver, receiver.scale * tables[receiver.material].meanFreePath.rgb, sum);
    }
    return sum;
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint material = materialAt(pixel);
    float z = viewZ(pixel);
    if (material == 0u || !isValidZ(z) || strengthAt(pixel, material) == 0.0) {
        if (band == 0u) {
            writeUnscattered(pixel, material);
        }
        return;
    }
    Receiver receiver = Receiver(local, material, viewPosition(pixel, z), scaleAt(pixel));
    int rows = int(bruteBandRows(uint(view.areaExtent.x)));
    int firstRow = int(band) * rows;
    bool isLast = firstRow + rows >= view.areaExtent.y;
    float radius = receiver.scale * materials[material].radius;
    Window window = windowOf(receiver, radius);
    window.low.y = max(window.low.y, firstRow - local.y);
    window.high.y = min(window.high.y, firstRow + rows - 1 - local.y);
    bool adds = radius > 0.0 && window.low.y <= window.high.y;
    if (band != 0u && !isLast && !adds) {
        return;
    }
    int index = local.y * view.areaExtent.x + local.x;
    Sum sum = band == 0u ? nearSum(receiver) : Sum(sums[index].light.rgb, sums[index].weight.rgb);
    if (adds) {
        addFar(receiver, window, radius, sum);
    }
    if (isLast) {
        writeScattered(pixel, material, sum.light / max(sum.weight, vec3(1e-30)));
    } else {
        sums[index] = BruteSum(vec4(sum.light, 0.0), vec4(sum.weight, 0.0));
    }
}
