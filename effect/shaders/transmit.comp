// Light that comes through: per light, the thickness between the pixel and where the light enters (shadow map), the
// slab transmittance of the material's profile at that thickness, times the light's irradiance on the far side.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = bindingParameters, std140) uniform Parameters {
    TransmitParameters parameters;
};
layout(set = 0, binding = bindingMaterials, std430) readonly buffer Materials {
    uint slots[materialIdCount];
    MaterialParameters materials[];
};
layout(set = 0, binding = bindingTables, std430) readonly buffer Tables {
    TransmitTable tables[];
};
layout(set = 0, binding = bindingLights, std430) readonly buffer Lights {
    LightParameters lights[];
};
layout(set = 0, binding = bindingDepth) uniform texture2D depthImage;
layout(set = 0, binding = bindingMaterialId) uniform utexture2D materialIdImage;
layout(set = 0, binding = bindingNormal) uniform texture2D normalImage;
layout(set = 0, binding = bindingStrength) uniform texture2D strengthImage;
layout(set = 0, binding = bindingThickness) uniform texture2D thicknessImage;
layout(set = 0, binding = bindingShadowMaps) uniform texture2DArray shadowMaps[maxShadowMaps];
layout(set = 0, binding = bindingTransmitted) uniform writeonly image2D transmittedImage;
layout(set = 0, binding = bindingThicknessOut) uniform writeonly image2D thicknessOutImage;

#define view parameters.view
#include "view.glsl"

const uint lightDirectional = 0u; // NacreLightKind
const uint lightSpot = 1u;
const uint lightPoint = 2u;
const uint noShadowMap = 0xffffffffu;

// [1] Least cosine between -normal and the light by which the receiver's offset is turned into thickness.
const float leastCosine = 0.2;
// [1] Longest step along the receiver's plane, over texel size, that taps follow.
const float steepestPlane = 4.0;

struct Receiver {
    vec3 position; // world space, scene units
    vec3 normal;   // world space, unit length
    uint material;
    float authored; // mm, 0 = not authored
};

// A light as the receiver sees it.
struct Incidence {
    vec3 toLight;
    vec3 irradiance; // on a surface that faces the light
};

// Where a point falls in a shadow map: texel coordinates, layer, and a texel's size there.
struct ShadowPoint {
    vec2 texel;
    uint layer;
    float texelSize; // scene units
    bool inside;
};

// Punctual lights as in glTF's KHR_lights_punctual: 1/d² · saturate(1 - (d/range)⁴), squared linear cone.
Incidence incidenceAt(LightParameters light, vec3 position) {
    if (light.kind == lightDirectional) {
        return Incidence(-light.direction.xyz, light.irradiance.rgb);
    }
    vec3 offset = light.position.xyz - position;
    float squared = max(dot(offset, offset), 1e-12);
    vec3 toLight = offset * inversesqrt(squared);
    float meters = light.irradiance.w;
    float attenuation = 1.0 / (squared * meters * meters);
    if (light.position.w > 0.0) {
        float share = squared / (light.position.w * light.position.w);
        attenuation *= clamp(1.0 - share * share, 0.0, 1.0);
    }
    if (light.kind == lightSpot) {
        float cone = clamp(dot(light.direction.xyz, -toLight) * light.coneScale + light.coneOffset, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return Incidence(toLight, light.irradiance.rgb * attenuation);
}

// Face and coordinates of a direction as in Vulkan's cube maps ("Cube Map Face Selection"): xy in [-1, 1] over z.
vec3 cubeFace(vec3 direction, out uint face) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) {
        face = direction.x > 0.0 ? 0u : 1u;
        return vec3(direction.x > 0.0 ? -direction.z : direction.z, -direction.y, size.x);
    }
    if (size.y >= size.z) {
        face = direction.y > 0.0 ? 2u : 3u;
        return vec3(direction.x, direction.y > 0.0 ? direction.z : -direction.z, size.y);
    }
    face = direction.z > 0.0 ? 4u : 5u;
    return vec3(direction.z > 0.0 ? direction.x : -direction.x, -direction.y, size.z);
}

ShadowPoint project(LightParameters light, vec3 position) {
    vec2 size = light.shadowSize;
    vec3 offset = position - light.position.xyz;
    ShadowPoint point;
    point.layer = light.shadowLayer;
    vec2 coordinates;
    float w;
    vec2 scale; // clip units per scene unit where w is 1
    if (light.kind == lightPoint) {
        uint face;
        vec3 cube = cubeFace(offset, face);
        point.layer += face;
        coordinates = cube.xy / cube.z;
        w = cube.z;
        scale = vec2(1.0);
    } else {
        mat4 clip = light.shadowClipFromWorld;
        vec4 projected = clip * vec4(position, 1.0);
        w = projected.w;
        coordinates = projected.xy / w;
        scale = vec2(length(vec3(clip[0].x, clip[1].x, clip[2].x)), length(vec3(clip[0].y, clip[1].y, clip[2].y)));
    }
    point.texel = (coordinates * 0.5 + 0.5) * size;
    point.texelSize = max(2.0 * w / (scale.x * size.x), 2.0 * w / (scale.y * size.y));
    point.inside = w > 0.0 && all(lessThan(abs(coordinates), vec2(1.0)));
    return point;
}

// A shadow map's texel. Constant indices, because not every device indexes arrays of images dynamically; loops of one
// turn instead of a switch, because software devices run every side of a branch but skip loops.
float storedDepth(uint map, ivec3 texel) {
    float value = 0.0;
#define FETCH(index)                                                                                                   \
    for (bool here = map == index; here; here = false) {                                                               \
        value = texelFetch(shadowMaps[index], texel, 0).r;                                                             \
    }
    FETCH(0) FETCH(1) FETCH(2) FETCH(3) FETCH(4) FETCH(5) FETCH(6) FETCH(7)
    FETCH(8) FETCH(9) FETCH(10) FETCH(11) FETCH(12) FETCH(13) FETCH(14) FETCH(15)
#undef FETCH
    return value;
}

// Σ w·exp(−d²/v), the thesis's own form, added up layer by layer as in its shader.
vec3 layerTransmittance(uint material, float thickness, uint layerCount) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < layerCount; ++i) {
        vec4 layer = tables[material].layers[i];
        sum += layer.rgb * exp(-thickness * thickness * layer.w);
    }
    return sum;
}

// Transmittance of a slab of a thickness in mm.
vec3 transmittance(uint material, float thickness) {
    uint layerCount = uint(tables[material].end.y);
    if (hasFlag(flagThesisTransmittance) && layerCount != 0u) {
        return layerTransmittance(material, thickness, layerCount);
    }
    float end = tables[material].end.x;
    if (end <= 0.0) {
        return vec3(thickness > 0.0 ? 0.0 : 1.0);
    }
    float position = sqrt(min(thickness / end, 1.0)) * float(transmittanceEntries - 1u);
    uint index = min(uint(position), transmittanceEntries - 2u);
    return mix(tables[material].transmittance[index].rgb, tables[material].transmittance[index + 1u].rgb,
               position - float(index));
}

// How a point moves along the receiver's tangent plane from one texel of the shadow map to the next, in x and y. Taps
// are compared with the plane, not with the point, so that a slab is as thick under every tap.
mat2x3 planeSteps(LightParameters light, Receiver receiver, ShadowPoint point) {
    vec3 other = abs(receiver.normal.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 u = normalize(cross(receiver.normal, other)) * point.texelSize;
    vec3 v = cross(receiver.normal, u);
    ShadowPoint atU = project(light, receiver.position + u);
    ShadowPoint atV = project(light, receiver.position + v);
    mat2 texels = mat2(atU.texel - point.texel, atV.texel - point.texel);
    if (atU.layer != point.layer || atV.layer != point.layer || abs(determinant(texels)) < 1e-6) {
        return mat2x3(0.0);
    }
    mat2x3 steps = mat2x3(u, v) * inverse(texels);
    float longest = max(length(steps[0]), length(steps[1]));
    return steps * min(1.0, steepestPlane * point.texelSize / max(longest, 1e-20));
}

// A point's linear depth in the light's map, in scene units.
float linearDepth(LightParameters light, vec3 position) {
    vec3 offset = position - light.position.xyz;
    return light.kind == lightDirectional ? dot(offset, light.direction.xyz) : length(offset);
}

float bounded(Receiver receiver, float thickness) {
    return receiver.authored > 0.0 ? min(thickness, receiver.authored) : thickness;
}

// Transmittance (rgb) and thickness in mm (w), filtered over 4x4 texels under a tent of filterRadius. The receiver is
// moved inwards by the normal offset, so that at silhouettes it finds its own body; the light's way through what was
// cut off is added again. What is filtered is the transmittance: light adds up, thickness does not.
vec4 filteredTransmittance(LightParameters light, Receiver receiver, ShadowPoint point, float cosine) {
    float offset = parameters.normalOffset * point.texelSize;
    ShadowPoint inner = project(light, receiver.position - receiver.normal * offset);
    if (!inner.inside) {
        inner = point;
        offset = 0.0;
    }
    float removed = offset / max(cosine, leastCosine);
    ivec2 last = ivec2(light.shadowSize) - 1;
    float spacing = max(0.5 * parameters.filterRadius, 0.5);
    vec2 coordinates = inner.texel / spacing - 0.5;
    vec2 base = floor(coordinates);
    mat2x3 steps = planeSteps(light, receiver, point);
    vec3 position = receiver.position - receiver.normal * offset;
    vec2 fraction = coordinates - base;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 16; ++i) {
        ivec2 tap = ivec2(i & 3, i >> 2) - 1;
        vec2 weights = 2.0 - abs(vec2(tap) - fraction);
        ivec2 texel = clamp(ivec2((base + vec2(tap) + 0.5) * spacing), ivec2(0), last);
        float stored = storedDepth(light.shadowMap, ivec3(texel, inner.layer)) * light.direction.w;
        float plane = linearDepth(light, position + steps * (vec2(texel) + 0.5 - inner.texel));
        float thickness = bounded(receiver, max(plane - stored + removed, 0.0) * view.mmPerUnit);
        sum += weights.x * weights.y / 16.0 * vec4(transmittance(receiver.material, thickness), thickness);
    }
    return sum;
}

// Light of one light through the receiver's body (rgb), and the thickness in mm (w), -1 where it does not shine through.
vec4 transmitLight(LightParameters light, Receiver receiver) {
    Incidence incidence = incidenceAt(light, receiver.position);
    float cosine = -dot(receiver.normal, incidence.toLight);
    if (cosine <= 0.0 || !any(greaterThan(incidence.irradiance, vec3(0.0)))) {
        return vec4(0.0, 0.0, 0.0, -1.0);
    }
    vec4 through = vec4(0.0, 0.0, 0.0, -1.0);
    ShadowPoint point;
    point.inside = false;
    if (light.shadowMap != noShadowMap) {
        point = project(light, receiver.position);
    }
    if (point.inside) {
        through = filteredTransmittance(light, receiver, point, cosine);
    } else if (receiver.authored > 0.0) {
        through = vec4(transmittance(receiver.material, receiver.authored), receiver.authored);
    }
    return vec4(through.rgb * incidence.irradiance * cosine, through.w);
}

void writeResult(ivec2 pixel, vec3 light, float thickness) {
    imageStore(transmittedImage, pixel, vec4(light, 1.0));
    if (hasFlag(flagThicknessOut)) {
        imageStore(thicknessOutImage, pixel, vec4(thickness, 0.0, 0.0, 1.0));
    }
}

void main() {
    ivec2 local = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(local, view.areaExtent))) {
        return;
    }
    ivec2 pixel = local + view.areaOffset;
    uint slot = slots[texelFetch(materialIdImage, pixel, 0).r & (materialIdCount - 1u)];
    float z = viewZ(pixel);
    vec3 normal = viewNormal(texelFetch(normalImage, pixel, 0).xyz) * mat3(view.viewFromWorld);
    if (slot == 0u || !isValidZ(z) || !isFinite(normal)) {
        writeResult(pixel, vec3(0.0), 0.0);
        return;
    }
    MaterialParameters material = materials[slot];
    Receiver receiver;
    receiver.position = (view.worldFromView * vec4(viewPosition(pixel, z), 1.0)).xyz;
    receiver.normal = normal;
    receiver.material = slot;
    receiver.authored = material.thickness;
    if (hasFlag(flagThickness)) {
        float authored = texelFetch(thicknessImage, pixel, 0).r;
        receiver.authored = authored > 0.0 && isFinite(authored) ? authored : receiver.authored;
    }
    float translucency = material.translucency;
    if (hasFlag(flagStrength)) {
        translucency *= clamp(texelFetch(strengthImage, pixel, 0).r, 0.0, 1.0);
    }
    vec3 light = vec3(0.0);
    float thickness = 1e30;
    for (uint i = 0u; i < view.lightCount; ++i) {
        vec4 part = transmitLight(lights[i], receiver);
        light += part.rgb;
        thickness = part.w >= 0.0 ? min(thickness, part.w) : thickness;
    }
    writeResult(pixel, translucency * light, thickness < 1e30 ? thickness : 0.0);
}
