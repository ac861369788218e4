// Light that comes through: per light, the thickness between the pixel and where the light enters (shadow map), the
// slab transmittance of the material's profile at that thickness, times the light's irradiance on the far side. Light
// that enters where the camera sees it is scatter's, and is left out here.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "interface/blocks.h"
#include "transmit_blocks.h"

layout(constant_id = 0) const bool severalShadowMaps = false; // else all lights have the first
// Some light has a map with hardware depth, of culled front faces, in an atlas or in cascades, or falls off in its own way; or
// there is an image of scales.
layout(constant_id = 1) const bool generalCall = false;

layout(local_size_x = 8, local_size_y = 16) in;
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
layout(set = 0, binding = bindingScale) uniform texture2D scaleImage;
layout(set = 0, binding = bindingThickness) uniform texture2D thicknessImage;
layout(set = 0, binding = bindingShadowMaps) uniform texture2DArray shadowMaps[maxShadowMaps];
layout(set = 0, binding = bindingTransmitted) uniform writeonly image2D transmittedImage;
layout(set = 0, binding = bindingThicknessOut) uniform writeonly image2D thicknessOutImage;

#define view parameters.view
#include "interface/pixel_geometry.glsl"
#include "interface/encoded_inputs.glsl"
#include "transmittance.glsl"

const uint lightDirectional = 0u; // NacreLightKind
const uint lightPoint = 2u;
const uint noShadowMap = 0xffffffffu;

#include "shadow_taps.glsl"
#include "shadow_depth.glsl"

// [1] How far an entry point may lie from the surface that is seen at its pixel and still be the same: this many texels of
// the shadow map plus pixels plus this share of the thickness. From there to twice that, the answer fades.
const float sameSurfaceTexels = 1.5;
const float sameSurfaceShare = 0.02;
const float sameSurfaceSpread = 0.25;
// [1] Cosine between the normal and the way to the camera below which a surface's depth is no longer told more exactly.
const float leastFacing = 0.3;
// [1] The same cosine from which on all light around an entry point is taken to enter where the camera sees it.
const float fullyFacing = 0.5;
// [1] The cosine between the normal there and the light from which on the light is taken to enter there.
const float fullyLit = 0.25;
// [1] Transmittance below which nobody asks whether scatter has the light already: twice as much of it is not seen.
const float leastTwice = 1.0 / 256.0;

struct Receiver {
    vec3 viewPosition; // view space, mm
    vec3 position;     // world space, scene units
    vec3 normal;       // world space, unit length
    uint material;
    float authored; // mm, 0 = not authored
    float scale;    // of the profile's lengths; 1 without generalCall
};

// What lets the light through: a profile whose lengths are multiplied is the profile in a body that many times thinner.
mat4 thicknessInProfile(Receiver receiver, mat4 thickness) {
    return generalCall ? thickness * (1.0 / receiver.scale) : thickness;
}

vec3 transmittance(Receiver receiver, mat4 thickness, vec4 columnWeights, vec4 rowWeights) {
    return transmittance(receiver.material, thicknessInProfile(receiver, thickness), columnWeights, rowWeights);
}

vec3 transmittance(Receiver receiver, float thickness) {
    return transmittance(receiver.material, generalCall ? thickness / receiver.scale : thickness);
}

float reachOf(Receiver receiver) {
    return receiver.scale * reachOf(receiver.material);
}

// [mm] Radius outside of which a quarter of the light leaves.
float spreadOf(Receiver receiver) {
    return receiver.scale * tables[receiver.material].spread;
}

// A light as the receiver sees it.
struct Incidence {
    vec3 toLight;
    vec3 irradiance; // on a surface that faces the light
};

// Projects offsets from the light to a layer of its shadow map: rows for texel coordinates times w, and for w.
struct ShadowProjection {
    vec4 x, y, w;
    uint layer;
};

// Where the receiver falls in a shadow map, moved inwards by the normal offset, so that at silhouettes it finds its own
// body.
struct ShadowPoint {
    ShadowProjection projection;
    vec3 offset; // from the light, scene units
    vec2 texel;
    float w;
    float texelSize; // scene units
    float moved;     // scene units
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
    if (generalCall) {
        float distance = sqrt(squared) * meters;
        attenuation = 1.0 / dot(light.attenuation.xyz, vec3(1.0, distance, distance * distance));
    }
    if (light.position.w > 0.0) {
        float share = squared / (light.position.w * light.position.w);
        attenuation *= clamp(1.0 - share * share, 0.0, 1.0);
    }
    if (light.coneScale > 0.0) {
        float cone = clamp(dot(light.direction.xyz, -toLight) * light.coneScale + light.coneOffset, 0.0, 1.0);
        attenuation *= cone * cone;
    }
    return Incidence(toLight, light.irradiance.rgb * attenuation);
}

// The face that an offset points at, as in Vulkan's cube maps ("Cube Map Face Selection").
ShadowProjection cubeFace(LightParameters light, vec3 offset) {
    vec3 size = abs(offset);
    bool x = size.x >= size.y && size.x >= size.z;
    bool y = !x && size.y >= size.z;
    float side = (x ? offset.x : y ? offset.y : offset.z) > 0.0 ? 1.0 : -1.0;
    vec3 major = side * vec3(x, y, !x && !y);
    vec3 s = x ? vec3(0.0, 0.0, -side) : vec3(y ? 1.0 : side, 0.0, 0.0);
    vec3 t = y ? vec3(0.0, 0.0, side) : vec3(0.0, -1.0, 0.0);
    uint face = (x ? 0u : y ? 2u : 4u) + (side > 0.0 ? 0u : 1u);
    vec2 middle = 0.5 * light.shadowSize;
    return ShadowProjection(vec4(middle.x * (s + major), 0.0), vec4(middle.y * (t + major), 0.0), vec4(major, 0.0),
                            light.shadowLayer + face);
}

ShadowProjection projectionAt(LightParameters light, vec3 offset) {
    if (light.kind == lightPoint) {
        return cubeFace(light, offset);
    }
    return ShadowProjection(light.shadowX, light.shadowY, light.shadowW, light.shadowLayer);
}

ShadowPoint project(LightParameters light, Receiver receiver) {
    vec3 offset = receiver.position - light.position.xyz;
    vec3 size = abs(offset);
    float w = light.kind == lightPoint ? max(size.x, max(size.y, size.z)) : dot(light.shadowW, vec4(offset, 1.0));
    ShadowPoint point;
    point.texelSize = light.shadowTexel * max(w, 0.0);
    point.moved = parameters.normalOffset * point.texelSize;
    point.offset = offset - receiver.normal * point.moved;
    point.projection = projectionAt(light, point.offset);
    vec4 inner = vec4(point.offset, 1.0);
    point.w = dot(point.projection.w, inner);
    point.texel = vec2(dot(point.projection.x, inner), dot(point.projection.y, inner)) / point.w;
    point.inside = point.w > 0.0 && all(greaterThanEqual(point.texel, vec2(0.0))) &&
                   all(lessThanEqual(point.texel, light.shadowSize));
    return point;
}

#include "entry.glsl"

// Whether the light that comes through has to be looked for in the picture. The thesis does not ask.
bool mayCountTwice(vec3 transmittance) {
    return any(greaterThan(transmittance, vec3(leastTwice))) && !hasFlag(flagThesisTransmittance);
}

// [0, 1] Whether the map can tell how thick a body is: its texels are smaller than the profile is wide, or what they say
// lies no farther from the receiver.
float certaintyOf(Receiver receiver, float texelSize, float deviation) {
    float least = min(texelSize * view.mmPerUnit, deviation);
    return clamp(2.0 - 2.0 * least / reachOf(receiver), 0.0, 1.0);
}

// The thesis's own: along the light, under the receiver's cosine.
vec4 thesisThrough(Receiver receiver, EntryFrame frame, MapDepths map, Taps taps, vec2 coordinate, float deepest, float cosine) {
    float most = receiver.authored > 0.0 ? receiver.authored : opaque;
    mat4 thickness;
    for (int row = 0; row < 4; ++row) {
        vec4 x, y, z;
        litRow(frame, map.depth[row], taps, row, coordinate, deepest, x, y, z);
        thickness[row] = clamp(z, 0.0, most);
    }
    vec3 through = transmittance(receiver, thickness, taps.columnWeights, taps.rowWeights);
    return vec4(through * cosine, dot(thickness * taps.rowWeights, taps.columnWeights));
}

// What comes through of a light that shines on a surface that faces it with 1 (rgb), and thickness along the light in mm
// (w). What is filtered is the transmittance: light adds up, thickness does not.
vec4 lightThrough(LightParameters light, Receiver receiver, ShadowPoint point, vec3 toLight, float cosine) {
    float spacing = entrySpacingOf(light, receiver, point.texelSize);
    Taps taps = tapsAround(point.texel, spacing, light.shadowSize);
    MapDepths map = depthsAlongLight(light, taps, point.projection.layer);
    bool isBounded = receiver.authored > 0.0;
    if (isFrontFaceCulled(light)) { // the entry is the authored thickness in front of the body's own far side
        map.depth -= receiver.authored;
        isBounded = false;
    }
    float depth = receiverDepth(light, point, receiver.normal);
    float texel = point.texelSize * view.mmPerUnit;
    float farthest = reachOf(receiver) + 3.0 * spacing * texel;
    float most = isBounded ? receiver.authored : opaque;
    float inmost = 2.0 * most + (bodyTexels + bodySpacings * spacing) * texel;
    float deepest = deepestEntry(map);
    bool isCovered = deepest > -nothingThere;
    float nearest = depth - deepest;
    vec4 result = vec4(0.0, 0.0, 0.0, isCovered ? clamp(nearest, 0.0, most) : isBounded ? most : -1.0);
    float deviation = opaque;
    float shadowed = isCovered ? 1.0 : 0.0;
    bool isThesis = hasFlag(flagThesisTransmittance);
    for (bool shines = nearest <= farthest || isThesis; shines; shines = false) { // else the body is thick, as most are
        EntryFrame frame = entryFrame(light, point, receiver.normal, toLight, depth);
        if (isThesis) {
            return thesisThrough(receiver, frame, map, taps, point.texel, depth + 2.0 * farthest, cosine);
        }
        LitPoints points;
        EntryPlane plane = entryPlane(frame, map, taps, point.texel, spacing * texel, farthest, inmost, points);
        mat4 thickness = entryThickness(points, plane, most);
        result.rgb = transmittance(receiver, thickness, taps.columnWeights, taps.rowWeights);
        result.rgb *= plane.cosine * entryShare(plane.opposite);
        result.w = plane.count > 0.0 ? clamp(plane.height, 0.0, most) : result.w;
        deviation = plane.deviation;
        shadowed = plane.shadowed;
    }
    float certainty = certaintyOf(receiver, point.texelSize, deviation);
    float authored = receiver.authored > 0.0 ? cosine * (1.0 - certainty) * (1.0 - shadowed) : 0.0;
    result.rgb *= certainty;
    for (bool tells = authored <= 0.0; !tells; tells = true) { // the map does not
        result.rgb += authored * transmittance(receiver, receiver.authored);
    }
    return result;
}

#include "shadow_cascades.glsl"

// The pixel that shows a view-space position, mm.
vec2 pixelOf(vec3 position) {
    mat2 steps = mat2(stepX(position.z), stepY(position.z));
    return inverse(steps) * (position.xy - view.rayBias * position.z - view.originBias);
}

// [0, 1] How much of the light around the entry point the camera does not see: 0 where the pixel there shows that point, on a
// side that the light reaches and that faces the camera. That light is in the irradiance that scatter gathers. Towards a
// silhouette more and more of it enters beyond, and the answer fades to 1. `tolerance`: mm.
float hiddenShare(Receiver receiver, vec3 toLight, float thickness, float tolerance) {
    vec3 entry = receiver.viewPosition + mat3(view.viewFromWorld) * (thickness * toLight);
    ivec2 pixel = ivec2(floor(pixelOf(entry) + 0.5));
    if (clipW(entry.z) <= 0.0 || !isInArea(pixel)) {
        return 1.0;
    }
    float z = viewZ(pixel);
    vec3 normal = worldNormal(texelFetch(normalImage, pixel, 0).xyz);
    if (!isValidZ(z) || !isFinite(normal)) {
        return 1.0;
    }
    vec3 ray = vec3(rayAt(pixel), 1.0); // to the camera
    float stretch = length(ray);
    float facing = dot(mat3(view.viewFromWorld) * normal, ray) / stretch;
    float distance = abs(entry.z - z) * stretch * max(facing, leastFacing);
    float same = clamp(2.0 - distance / (tolerance + length(stepX(z)) * sameSurfaceTexels), 0.0, 1.0);
    return 1.0 - same * smoothstep(0.0, fullyFacing, facing) * smoothstep(0.0, fullyLit, dot(normal, toLight));
}

// Light of one light through the receiver's body (rgb), and the thickness in mm (w), -1 where none shines through.
vec4 transmitLight(LightParameters light, Receiver receiver) {
    Incidence incidence = incidenceAt(light, receiver.position);
    float cosine = -dot(receiver.normal, incidence.toLight);
    if (cosine <= 0.0 || !any(greaterThan(incidence.irradiance, vec3(0.0)))) {
        return vec4(0.0, 0.0, 0.0, -1.0);
    }
    if (isFrontFaceCulled(light) && receiver.authored <= 0.0) {
        return vec4(0.0, 0.0, 0.0, -1.0);
    }
    MapsAnswer answer = throughMaps(light, receiver, incidence.toLight, cosine);
    vec4 through = answer.through;
    if (!answer.isTold && receiver.authored > 0.0) {
        through = vec4(transmittance(receiver, receiver.authored) * cosine, receiver.authored);
    }
    for (bool asks = mayCountTwice(through.rgb); asks; asks = false) {
        float tolerance = sameSurfaceTexels * answer.texelSize * view.mmPerUnit + sameSurfaceShare * through.w +
                          sameSurfaceSpread * spreadOf(receiver);
        through.rgb *= hiddenShare(receiver, incidence.toLight, through.w, tolerance);
    }
    return vec4(through.rgb * incidence.irradiance, through.w);
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
    uint id = materialIdAt(pixel) & (materialIdCount - 1u);
    uint slot = id != 0u ? slots[id] : 0u; // most pixels then wait for their id alone
    if (slot == 0u) {
        writeResult(pixel, vec3(0.0), 0.0);
        return;
    }
    float z = viewZ(pixel);
    vec3 normal = normalize(worldNormal(texelFetch(normalImage, pixel, 0).xyz));
    if (!isValidZ(z) || !isFinite(normal)) {
        writeResult(pixel, vec3(0.0), 0.0);
        return;
    }
    MaterialParameters material = materials[slot];
    Receiver receiver;
    receiver.viewPosition = viewPosition(pixel, z);
    receiver.position = (view.worldFromView * vec4(receiver.viewPosition, 1.0)).xyz;
    receiver.normal = normal;
    receiver.material = slot;
    receiver.authored = material.thickness;
    if (hasFlag(flagThickness)) {
        float authored = texelFetch(thicknessImage, pixel, 0).r;
        receiver.authored = authored > 0.0 && isFinite(authored) ? authored : receiver.authored;
    }
    receiver.scale = generalCall ? scaleAt(pixel) : 1.0;
    float translucency = material.translucency;
    if (hasFlag(flagStrength)) {
        translucency *= clamp(texelFetch(strengthImage, pixel, 0).r, 0.0, 1.0);
    }
    vec3 light = vec3(0.0);
    float thickness = 1e30;
    uint lightCount = translucency > 0.0 || hasFlag(flagThicknessOut) ? view.lightCount : 0u;
    for (uint i = 0u; i < lightCount; ++i) {
        vec4 part = transmitLight(lights[i], receiver);
        light += part.rgb;
        thickness = part.w >= 0.0 ? min(thickness, part.w) : thickness;
    }
    writeResult(pixel, translucency * light, thickness < 1e30 ? thickness : 0.0);
}
