// Light through a body by the shadow maps of one light. Needs lightThrough, `lights` and what it needs.

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

// What a light's maps say of a receiver.
struct MapsAnswer {
    vec4 through;    // as lightThrough's
    float texelSize; // scene units, of the coarsest map that was asked
    bool isTold;     // whether a map has the receiver
};

// The light's own map or its cascades, whose last that has the receiver tells what those before it leave. One call of
// lightThrough for all keeps the code small.
MapsAnswer throughMaps(LightParameters light, Receiver receiver, vec3 toLight, float cosine) {
    bool inCascades = generalCall && light.cascadeCount > 0u;
    uint count = inCascades ? light.cascadeCount : light.shadowMap == noShadowMap ? 0u : 1u;
    vec4 sum = vec4(0.0);
    float texelSize = 0.0;
    float left = 1.0;
    for (uint i = 0u; i < count && left > 0.0; ++i) {
        LightParameters map = light;
        if (inCascades) {
            map = lights[light.firstCascade + i];
        }
        ShadowPoint point = project(map, receiver);
        float share = point.inside ? left : 0.0;
        if (inCascades) {
            share = left * cascadeShare(light, map, receiver, point);
        }
        if (share > 0.0) {
            sum += share * lightThrough(map, receiver, point, toLight, cosine);
            texelSize = max(texelSize, point.texelSize);
        }
        left -= share;
    }
    bool isTold = left < 1.0;
    return MapsAnswer(isTold ? sum / (1.0 - left) : vec4(0.0, 0.0, 0.0, -1.0), texelSize, isTold);
}
