// Light through a body by several shadow maps of one light. Needs lightThrough, `lights` and what it needs.

// How far a point is inside a map: 0 at its border, 1 in the middle, along the axis on which it is nearer to the border.
float depthInMap(LightParameters cascade, ShadowPoint point) {
    vec2 fromMiddle = abs(2.0 * point.texel / cascade.shadowSize - 1.0);
    return 1.0 - max(fromMiddle.x, fromMiddle.y);
}

// [0, 1] How much a cascade tells of a point that those before it leave: all, or less and less where it goes over into the
// next.
float cascadeShare(LightParameters light, LightParameters cascade, Receiver receiver, ShadowPoint point) {
    float blend = max(light.cascadeBlend, 1e-6);
    float remaining = depthInMap(cascade, point);
    if ((light.shadowFlags & shadowCascadeByViewDepth) != 0u) {
        vec2 span = cascade.cascadeSpan;
        remaining = (span.y + receiver.viewPosition.z) / (span.y - span.x);
    }
    return point.inside ? clamp(remaining / blend, 0.0, 1.0) : 0.0;
}

// As lightThrough. The last cascade that has the point tells what those before it leave. `point` becomes that of
// the coarsest map that was asked; it is inside where one was.
vec4 throughCascades(LightParameters light, Receiver receiver, vec3 toLight, float cosine, inout ShadowPoint point) {
    vec4 sum = vec4(0.0);
    float left = 1.0;
    for (uint i = 0u; i < light.cascadeCount && left > 0.0; ++i) {
        LightParameters cascade = lights[light.firstCascade + i];
        ShadowPoint there = project(cascade, receiver);
        float share = left * cascadeShare(light, cascade, receiver, there);
        for (bool asked = share > 0.0; asked; asked = false) {
            sum += share * lightThrough(cascade, receiver, there, toLight, cosine);
            there.texelSize = max(there.texelSize, point.texelSize);
            point = there;
        }
        left -= share;
    }
    return left < 1.0 ? sum / (1.0 - left) : vec4(0.0, 0.0, 0.0, -1.0);
}
