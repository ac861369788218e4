// Share of a light that reaches a point, from its linear-depth shadow map.
//
// The receiver is taken for its tangent plane: every texel of the filter is compared with the depth at which its own ray
// meets that plane, so a flat receiver never shadows itself whatever the slope. A shift along the normal and a bias, both
// of the order of a texel, stand for curvature.

const float normalOffsetTexels = 1.5;
const float biasTexels = 0.5;
const float largestSlope = 8.0; ///< of the tangent plane against the light, beyond which it is no longer followed

/// How the map that holds a direction is read: clip x, y and w as rows, and the array layer.
struct ShadowProjection {
    vec4 x;
    vec4 y;
    vec4 w;
    uint layer;
};

vec4 rowThrough(vec3 axis, vec3 origin) {
    return vec4(axis, -dot(axis, origin));
}

/// The face of a point light's six that sees `fromLight` (Vulkan 1.3, 16.5.4, "Cube Map Face Selection").
ShadowProjection cubeFace(LightConstants light, vec3 fromLight) {
    vec3 size = abs(fromLight);
    vec3 right, down, forward;
    uint face;
    if (size.x >= size.y && size.x >= size.z) {
        float s = fromLight.x < 0.0 ? -1.0 : 1.0;
        face = s < 0.0 ? 1u : 0u;
        right = vec3(0.0, 0.0, -s);
        down = vec3(0.0, -1.0, 0.0);
        forward = vec3(s, 0.0, 0.0);
    } else if (size.y >= size.z) {
        float s = fromLight.y < 0.0 ? -1.0 : 1.0;
        face = s < 0.0 ? 3u : 2u;
        right = vec3(1.0, 0.0, 0.0);
        down = vec3(0.0, 0.0, s);
        forward = vec3(0.0, s, 0.0);
    } else {
        float s = fromLight.z < 0.0 ? -1.0 : 1.0;
        face = s < 0.0 ? 5u : 4u;
        right = vec3(s, 0.0, 0.0);
        down = vec3(0.0, -1.0, 0.0);
        forward = vec3(0.0, 0.0, s);
    }
    vec3 origin = light.position.xyz;
    return ShadowProjection(rowThrough(right, origin), rowThrough(down, origin), rowThrough(forward, origin),
                            light.kind.y + face);
}

ShadowProjection shadowProjection(LightConstants light, vec3 position) {
    if (light.kind.x == lightPoint) {
        return cubeFace(light, position - light.position.xyz);
    }
    mat4 rows = transpose(light.shadowClipFromWorld);
    return ShadowProjection(rows[0], rows[1], rows[3], light.kind.y);
}

/// World-space step of one texel along a row's axis, at w = 1.
vec3 texelStep(vec4 row, float size) {
    return row.xyz * (2.0 / (size * dot(row.xyz, row.xyz)));
}

/// `stored` are the four texels at `offset` + {0, 1}² (in textureGather's order) from the receiver, in texels.
vec4 litTexels(vec4 stored, vec2 low, vec2 high, float depth, vec2 slope) {
    vec4 x = vec4(low.x, high.x, high.x, low.x) * slope.x;
    vec4 y = vec4(high.y, high.y, low.y, low.y) * slope.y;
    return vec4(greaterThanEqual(stored, depth + x + y));
}

/// `normal` is the surface's, without a normal map; `toLight` is normalised.
float shadowVisibility(sampler2DArray maps, LightConstants light, vec3 position, vec3 normal, vec3 toLight) {
    if (light.kind.y == noShadow) {
        return 1.0;
    }
    bool directional = light.kind.x == lightDirectional;
    float size = float(textureSize(maps, 0).x);
    ShadowProjection projection = shadowProjection(light, position);
    float w = dot(projection.w, vec4(position, 1.0));
    if (w <= 0.0) {
        return 1.0;
    }
    float texel = w * length(texelStep(projection.x, size));
    float cosine = dot(normal, toLight);
    float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    position += normal * (normalOffsetTexels * texel * sine);

    vec4 world = vec4(position, 1.0);
    w = dot(projection.w, world);
    vec2 uv = vec2(dot(projection.x, world), dot(projection.y, world)) / w * 0.5 + 0.5;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) {
        return 1.0;
    }

    // How the tangent plane's depth changes from texel to texel.
    vec3 fromLight = position - light.position.xyz;
    vec3 ray = directional ? light.direction.xyz : normalize(fromLight);
    float depth = directional ? dot(ray, fromLight) : length(fromLight);
    float perTexel = directional ? 1.0 : w; // a step at w = 1 turns the ray by step · w / depth, which moves it by step · w
    vec3 stepX = texelStep(projection.x, size) * perTexel;
    vec3 stepY = texelStep(projection.y, size) * perTexel;
    stepX -= ray * dot(ray, stepX);
    stepY -= ray * dot(ray, stepY);
    vec2 slope = vec2(dot(normal, stepX), dot(normal, stepY)) / max(cosine, 1e-3);
    slope *= min(1.0, largestSlope * texel / max(length(slope), 1e-20));

    // A box of three texels with linear edges: four by four texels, in four gathers.
    float scale = 1.0 / light.direction.w;
    float biased = (depth - biasTexels * texel) * scale;
    slope *= scale;
    vec2 center = uv * size - 0.5;
    vec2 base = floor(center);
    vec2 f = center - base;
    vec2 last = vec2(size - 1.0);
    vec4 weightX = vec4(1.0 - f.x, 1.0, 1.0, f.x);
    vec4 weightY = vec4(1.0 - f.y, 1.0, 1.0, f.y);
    float sum = 0.0;
    for (int j = 0; j < 4; j += 2) {
        for (int i = 0; i < 4; i += 2) {
            vec2 corner = base + vec2(i, j);
            vec2 low = clamp(corner - 1.0, vec2(0.0), last) - center;
            vec2 high = clamp(corner, vec2(0.0), last) - center;
            vec4 stored = abs(textureGather(maps, vec3(corner / size, float(projection.layer)))); // less than 0: a back
            vec4 lit = litTexels(stored, low, high, biased, slope);
            sum += dot(lit, vec4(weightX[i], weightX[i + 1], weightX[i + 1], weightX[i]) *
                                vec4(weightY[j + 1], weightY[j + 1], weightY[j], weightY[j]));
        }
    }
    return sum / 9.0;
}
