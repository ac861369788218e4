// Light that comes through: per light, the thickness between the pixel and where the light enters (shadow map), the slab
// transmittance of the material's profile at that thickness, times the light's irradiance on the far side. transmit.comp,
// but for the thesis's own form.
#include "lights.wgsl"
#include "interface/pixel_geometry.wgsl"
#include "interface/encoded_inputs.wgsl"
#include "transmittance.wgsl"
#include "shadow_maps.wgsl"
#include "entry.wgsl"

@group(0) @binding(bindingThickness) var thicknessImage: texture_2d<f32>;
@group(0) @binding(bindingTransmitted) var transmittedImage: texture_storage_2d<rgba16float, write>;
@group(0) @binding(bindingThicknessOut) var thicknessOutImage: texture_storage_2d<r32float, write>;

// [1] How far an entry point may lie from the surface that is seen at its pixel and still be the same: this many texels of
// the shadow map plus pixels plus this share of the thickness. From there to twice that, the answer fades.
const sameSurfaceTexels: f32 = 1.5;
const sameSurfaceShare: f32 = 0.02;
const sameSurfaceSpread: f32 = 0.25;
// [1] Cosine between the normal and the way to the camera below which a surface's depth is no longer told more exactly.
const leastFacing: f32 = 0.3;
// [1] The same cosine from which on all light around an entry point is taken to enter where the camera sees it.
const fullyFacing: f32 = 0.5;
// [1] The cosine between the normal there and the light from which on the light is taken to enter there.
const fullyLit: f32 = 0.25;
// [1] Transmittance below which nobody asks whether scatter has the light already.
const leastTwice: f32 = 1.0 / 256.0;

// [0, 1] Whether the map can tell how thick a body is: its texels are smaller than the profile is wide, or what they say lies
// no farther from the receiver.
fn certaintyOf(receiver: Receiver, texelSize: f32, deviation: f32) -> f32 {
    let least = min(texelSize * parameters.view.mmPerUnit, deviation);
    return clamp(2.0 - 2.0 * least / reachOf(receiver), 0.0, 1.0);
}

// The map's depths of the entry: where the map has far sides, the authored thickness in front of the body's own.
fn entryDepths(light: LightParameters, taps: Taps, layer: u32, authored: f32) -> MapDepths {
    var map = depthsAlongLight(light, taps, layer);
    if (isFrontFaceCulled(light)) {
        for (var row = 0; row < 4; row++) {
            map.depth[row] -= authored;
        }
    }
    return map;
}

// What comes through of a light that shines on a surface that faces it with 1 (rgb), and thickness along the light in mm (w).
// What is filtered is the transmittance: light adds up, thickness does not.
fn lightThrough(light: LightParameters, receiver: Receiver, point: ShadowPoint, toLight: vec3f, cosine: f32) -> vec4f {
    let spacing = entrySpacingOf(light, receiver, point.texelSize);
    let taps = tapsAround(point.texel, spacing, light.shadowSize);
    let map = entryDepths(light, taps, point.projection.layer, receiver.authored);
    let isBounded = receiver.authored > 0.0 && !isFrontFaceCulled(light);
    let depth = receiverDepth(light, point, receiver.normal);
    let texel = point.texelSize * parameters.view.mmPerUnit;
    let farthest = reachOf(receiver) + 3.0 * spacing * texel;
    let most = select(opaque, receiver.authored, isBounded);
    let inmost = 2.0 * most + (bodyTexels + bodySpacings * spacing) * texel;
    let deepest = deepestEntry(map);
    let isCovered = deepest > -nothingThere;
    let nearest = depth - deepest;
    var through = vec3f(0.0);
    var thickness = select(select(-1.0, most, isBounded), clamp(nearest, 0.0, most), isCovered);
    var deviation = opaque;
    var shadowed = select(0.0, 1.0, isCovered);
    if (nearest <= farthest) { // else the body is thick, as most are
        let frame = entryFrame(light, point, receiver.normal, toLight, depth);
        let points = litPoints(frame, map, taps, point.texel, farthest, inmost);
        let plane = entryPlane(points, frame.normal, spacing * texel);
        through = transmittance(receiver.material, entryThickness(points, plane, most) * (1.0 / receiver.scale),
                                taps.columns.weights, taps.rows.weights);
        through *= plane.cosine * entryShare(plane.opposite);
        thickness = select(thickness, clamp(plane.height, 0.0, most), points.count > 0.0);
        deviation = plane.deviation;
        shadowed = points.shadowed;
    }
    let certainty = certaintyOf(receiver, point.texelSize, deviation);
    through *= certainty;
    if (receiver.authored > 0.0) { // where the map does not tell
        through += cosine * (1.0 - certainty) * (1.0 - shadowed) *
                   slabTransmittance(receiver.material, receiver.authored / receiver.scale);
    }
    return vec4f(through, thickness);
}

// [0, 1] How much a cascade tells of a point that those before it leave: all, or less and less where it goes over into the
// next.
fn cascadeShare(light: LightParameters, cascade: LightParameters, receiver: Receiver, point: ShadowPoint) -> f32 {
    let fromMiddle = abs(2.0 * point.texel / cascade.shadowSize - 1.0);
    var remaining = 1.0 - max(fromMiddle.x, fromMiddle.y);
    if ((light.shadowFlags & shadowCascadeByViewDepth) != 0u) {
        let span = cascade.cascadeSpan;
        remaining = (span.y + receiver.viewPosition.z) / (span.y - span.x);
    }
    return select(0.0, clamp(remaining / max(light.cascadeBlend, 1e-6), 0.0, 1.0), point.inside);
}

// What a light's maps say of a receiver.
struct MapsAnswer {
    through: vec4f, // as lightThrough's
    texelSize: f32, // scene units, of the coarsest map that was asked
    isTold: bool,   // whether a map has the receiver
}

// The light's own map or its cascades, whose last that has the receiver tells what those before it leave.
fn throughMaps(light: LightParameters, receiver: Receiver, toLight: vec3f, cosine: f32) -> MapsAnswer {
    let inCascades = generalCall && light.cascadeCount > 0u;
    let count = select(select(1u, 0u, light.shadowMap == noShadowMap), light.cascadeCount, inCascades);
    var sum = vec4f(0.0);
    var texelSize = 0.0;
    var left = 1.0;
    for (var i = 0u; i < count && left > 0.0; i++) {
        var map = light;
        if (inCascades) {
            map = lights[light.firstCascade + i];
        }
        let point = project(map, receiver);
        var share = select(0.0, left, point.inside);
        if (inCascades) {
            share = left * cascadeShare(light, map, receiver, point);
        }
        if (share > 0.0) {
            sum += share * lightThrough(map, receiver, point, toLight, cosine);
            texelSize = max(texelSize, point.texelSize);
        }
        left -= share;
    }
    if (left >= 1.0) {
        return MapsAnswer(vec4f(0.0, 0.0, 0.0, -1.0), texelSize, false);
    }
    return MapsAnswer(sum / (1.0 - left), texelSize, true);
}

// The pixel that shows a view-space position, mm.
fn pixelOf(position: vec3f) -> vec2i {
    let x = stepX(position.z);
    let y = stepY(position.z);
    let offset = position.xy - parameters.view.rayBias * position.z - parameters.view.originBias;
    let pixel = vec2f(offset.x * y.y - offset.y * y.x, offset.y * x.x - offset.x * x.y) / (x.x * y.y - x.y * y.x);
    return vec2i(floor(pixel + 0.5));
}

// [0, 1] How much of the light around the entry point the camera does not see: 0 where the pixel there shows that point, on a
// side that the light reaches and that faces the camera. That light is in the irradiance that scatter gathers. Towards a
// silhouette more and more of it enters beyond, and the answer fades to 1. `tolerance`: mm.
fn hiddenShare(receiver: Receiver, toLight: vec3f, thickness: f32, tolerance: f32) -> f32 {
    let entry = receiver.viewPosition + viewRotation() * (thickness * toLight);
    let pixel = pixelOf(entry);
    if (clipW(entry.z) <= 0.0 || !isInArea(pixel)) {
        return 1.0;
    }
    let z = viewZ(pixel);
    let normal = worldNormalAt(pixel);
    if (!isValidZ(z) || !isFiniteVector(normal)) {
        return 1.0;
    }
    let ray = vec3f(rayAt(pixel), 1.0); // to the camera
    let stretch = length(ray);
    let facing = dot(viewRotation() * normal, ray) / stretch;
    let distance = abs(entry.z - z) * stretch * max(facing, leastFacing);
    let same = clamp(2.0 - distance / (tolerance + length(stepX(z)) * sameSurfaceTexels), 0.0, 1.0);
    return 1.0 - same * smoothstep(0.0, fullyFacing, facing) * smoothstep(0.0, fullyLit, dot(normal, toLight));
}

// Light of one light through the receiver's body (rgb), and the thickness in mm (w), -1 where none shines through.
fn transmitLight(light: LightParameters, receiver: Receiver) -> vec4f {
    let incidence = incidenceAt(light, receiver.position);
    let cosine = -dot(receiver.normal, incidence.toLight);
    if (cosine <= 0.0 || !any(incidence.irradiance > vec3f(0.0)) ||
        (isFrontFaceCulled(light) && receiver.authored <= 0.0)) {
        return vec4f(0.0, 0.0, 0.0, -1.0);
    }
    let answer = throughMaps(light, receiver, incidence.toLight, cosine);
    var through = answer.through.rgb;
    var thickness = answer.through.w;
    if (!answer.isTold && receiver.authored > 0.0) {
        through = slabTransmittance(receiver.material, receiver.authored / receiver.scale) * cosine;
        thickness = receiver.authored;
    }
    if (any(through > vec3f(leastTwice))) {
        let tolerance = sameSurfaceTexels * answer.texelSize * parameters.view.mmPerUnit + sameSurfaceShare * thickness +
                        sameSurfaceSpread * spreadOf(receiver);
        through *= hiddenShare(receiver, incidence.toLight, thickness, tolerance);
    }
    return vec4f(through * incidence.irradiance, thickness);
}

fn writeResult(pixel: vec2i, light: vec3f, thickness: f32) {
    textureStore(transmittedImage, pixel, vec4f(light, 1.0));
    if (hasFlag(flagThicknessOut)) {
        textureStore(thicknessOutImage, pixel, vec4f(thickness, 0.0, 0.0, 1.0));
    }
}

// The authored thickness at a pixel, mm, 0 = not authored.
fn authoredAt(pixel: vec2i, material: u32) -> f32 {
    if (hasFlag(flagThickness)) {
        let authored = textureLoad(thicknessImage, pixel, 0).r;
        if (authored > 0.0 && isFinite(authored)) {
            return authored;
        }
    }
    return materials.elements[material].thickness;
}

fn translucencyAt(pixel: vec2i, material: u32) -> f32 {
    let translucency = materials.elements[material].translucency;
    if (hasFlag(flagStrength)) {
        return translucency * clamp(textureLoad(strengthImage, pixel, 0).r, 0.0, 1.0);
    }
    return translucency;
}

@compute @workgroup_size(8, 16)
fn main(@builtin(global_invocation_id) invocation: vec3u) {
    let local = vec2i(invocation.xy);
    if (any(local >= parameters.view.areaExtent)) {
        return;
    }
    let pixel = local + parameters.view.areaOffset;
    let slot = materialOfId(materialIdAt(pixel));
    let z = viewZ(pixel);
    let normal = normalize(worldNormalAt(pixel));
    if (slot == 0u || !isValidZ(z) || !isFiniteVector(normal)) {
        writeResult(pixel, vec3f(0.0), 0.0);
        return;
    }
    let position = viewPosition(pixel, z);
    let receiver = Receiver(position, (parameters.view.worldFromView * vec4f(position, 1.0)).xyz, normal, slot,
                            authoredAt(pixel, slot), scaleAt(pixel));
    let translucency = translucencyAt(pixel, slot);
    var light = vec3f(0.0);
    var thickness = 1e30;
    let count = select(0u, parameters.view.lightCount, translucency > 0.0 || hasFlag(flagThicknessOut));
    for (var i = 0u; i < count; i++) {
        let part = transmitLight(lights[i], receiver);
        light += part.rgb;
        thickness = select(thickness, min(thickness, part.w), part.w >= 0.0);
    }
    writeResult(pixel, translucency * light, select(0.0, thickness, thickness < 1e30));
}
