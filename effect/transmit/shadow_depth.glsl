// What the texels of a shadow map say: how far along the light it enters. Needs `shadowMaps`, `view` and the constant
// severalShadowMaps.

// 4x4 texels of a shadow map. Constant indices, because not every device indexes arrays of images dynamically; found in
// groups of four; loops of one turn instead of a switch, because software devices run every side of a branch but skip loops.
mat4 storedDepths(uint map, ivec4 columns, ivec4 rows, uint layer) {
#define TEXEL(index, column, row) texelFetch(shadowMaps[index], ivec3(column, row, layer), 0).r
#define ROW(index, row)                                                                                                \
    vec4(TEXEL(index, columns.x, row), TEXEL(index, columns.y, row), TEXEL(index, columns.z, row),                     \
         TEXEL(index, columns.w, row))
#define TEXELS(index) mat4(ROW(index, rows.x), ROW(index, rows.y), ROW(index, rows.z), ROW(index, rows.w))
#define FETCH(index)                                                                                                   \
    for (bool here = map == index; here; here = false) {                                                               \
        stored = TEXELS(index);                                                                                        \
    }
#define FETCH_GROUP(first)                                                                                             \
    for (bool near = map / 4 * 4 == first; near; near = false) {                                                       \
        FETCH(first) FETCH(first + 1) FETCH(first + 2) FETCH(first + 3)                                                \
    }
    if (!severalShadowMaps) {
        return TEXELS(0);
    }
    mat4 stored = mat4(0.0);
    FETCH_GROUP(0) FETCH_GROUP(4) FETCH_GROUP(8) FETCH_GROUP(12)
#undef FETCH_GROUP
#undef FETCH
#undef TEXELS
#undef ROW
#undef TEXEL
    return stored;
}

// Depth along the light of 4x4 texels of its shadow map, mm. A matrix's column is a row of the map.
mat4 depthsAlongLight(LightParameters light, vec4 columns, vec4 rows, uint layer) {
    mat4 stored = storedDepths(light.shadowMap, ivec4(columns), ivec4(rows), layer);
    return stored * (light.direction.w * view.mmPerUnit);
}
