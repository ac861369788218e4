// What the texels of a shadow map say: how far along the light it enters. Needs `shadowMaps`, `view` and the constants
// severalShadowMaps and generalCall.

// 4x4 texels of a shadow map. Constant indices, because not every device indexes arrays of images dynamically; found in
// groups of four; loops of one turn instead of a switch, because software devices run every side of a branch but skip
// loops.
mat4 storedDepths(uint map, Taps taps, ivec2 origin, uint layer) {
#define TEXEL(index, row, tap) texelFetch(shadowMaps[index], ivec3(x[row].tap, y[row].tap, layer), 0).r
#define ROW(index, row) vec4(TEXEL(index, row, x), TEXEL(index, row, y), TEXEL(index, row, z), TEXEL(index, row, w))
#define TEXELS(index) mat4(ROW(index, 0), ROW(index, 1), ROW(index, 2), ROW(index, 3))
#define FETCH(index)                                                                                                   \
    for (bool here = map == index; here; here = false) {                                                               \
        stored = TEXELS(index);                                                                                        \
    }
#define FETCH_GROUP(first)                                                                                             \
    for (bool near = map / 4 * 4 == first; near; near = false) {                                                       \
        FETCH(first) FETCH(first + 1) FETCH(first + 2) FETCH(first + 3)                                                \
    }
    ivec4 x[4];
    ivec4 y[4];
    [[unroll]] for (int row = 0; row < 4; ++row) {
        x[row] = ivec4(tapsX(taps, row)) + origin.x;
        y[row] = ivec4(tapsY(taps, row)) + origin.y;
    }
    if (!severalShadowMaps) {
        return TEXELS(0);
    }
    mat4 stored = mat4(0.0);
    FETCH_GROUP(0)
    FETCH_GROUP(4) FETCH_GROUP(8) FETCH_GROUP(12)
#undef FETCH_GROUP
#undef FETCH
#undef TEXELS
#undef ROW
#undef TEXEL
        return stored;
}

// [mm] Depth where nothing was drawn.
const float nothingThere = 1e30;

// Depth of a place in a depth buffer along the light, mm. What was never drawn may be infinitely far.
float decodedDepth(LightParameters light, vec4 place) {
    vec3 offset = place.xyz;
    float depth = light.kind == lightDirectional ? dot(offset, light.direction.xyz) : length(offset);
    return place.w > 0.0 ? min(depth / place.w * view.mmPerUnit, nothingThere) : nothingThere;
}

mat4 decodedDepths(LightParameters light, mat4 stored, Taps taps) {
    mat4 depths;
    for (int row = 0; row < 4; ++row) {
        vec4 columns = tapsX(taps, row) + 0.5;
        vec4 rows = tapsY(taps, row) + 0.5;
        for (int column = 0; column < 4; ++column) {
            vec4 place = light.offsetFromTexel[0] * columns[column] + light.offsetFromTexel[1] * rows[column] +
                         light.offsetFromTexel[3];
            depths[row][column] = decodedDepth(light, place + light.offsetFromTexel[2] * stored[row][column]);
        }
    }
    return depths;
}

// What 4x4 texels of a shadow map say. A matrix's column is a row of the map.
struct MapDepths {
    mat4 depth;   // mm, along the light
    mat4 isEntry; // 0 or 1: whether light can enter there. Not where nothing is, nor at a body's back.
};

MapDepths depthsAlongLight(LightParameters light, Taps taps, uint layer) {
    ivec2 origin = generalCall ? ivec2(light.shadowOrigin) : ivec2(0);
    mat4 stored = storedDepths(light.shadowMap, taps, origin, layer);
    MapDepths result;
    bool isHardware = generalCall && (light.shadowFlags & shadowHardwareDepth) != 0u;
    if (isHardware) {
        result.depth = decodedDepths(light, stored, taps);
    }
    float range = light.direction.w * view.mmPerUnit;
    for (int row = 0; row < 4; ++row) {
        if (isHardware) {
            result.isEntry[row] = 1.0 - step(nothingThere, result.depth[row]);
        } else { // below 0: a body's back; 1: nothing
            result.depth[row] =
                mix(abs(stored[row]) * range, vec4(nothingThere), greaterThanEqual(stored[row], vec4(1.0)));
            result.isEntry[row] = step(0.0, stored[row]) * (1.0 - step(1.0, stored[row]));
        }
    }
    return result;
}

// Whether a light's map has the faces that look away from the light, the receiver's own among them.
bool isFrontFaceCulled(LightParameters light) {
    return generalCall && (light.shadowFlags & shadowFrontFacesCulled) != 0u;
}
