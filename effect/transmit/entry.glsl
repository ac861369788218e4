// Where a light enters a body, and what comes through to the receiver. The texels of a shadow map are points of the lit
// surface; 4x4 of them, as far apart as the material's profile is wide, say how the surface lies and where it ends
// (docs/theory.md, "Light that comes through"). Needs `parameters` and spreadOf.

// [1] Distance between points of the lit surface, over the radius outside of which a quarter of the light leaves. Wider
// tells less about small bodies, narrower less about where a body ends.
const float entrySpacing = 0.5;
// [1] How many texels and spacings of points a body may be thicker than twice its authored thickness.
const float bodyTexels = 4.0;
const float bodySpacings = 1.0;
// [mm] Thickness that nothing shines through.
const float opaque = 1e9;

// Axes in which points are measured, mm from the receiver: two across the light, the third towards it.
struct EntryFrame {
    vec2 stepX, stepY; // across the light, from one texel of the map to the next
    vec3 normal;       // the receiver's
    vec2 taper;        // how w of the map changes along the steps, a share of it
    vec2 moved;        // across the light, from the receiver to where it falls in the map
    float depth;       // linear depth of the receiver
    float curvature;   // 1/mm, of surfaces of one depth; 0 for directional lights
};

// 4x4 points of the lit surface, mm from the receiver. They live from the plane's fit to the thicknesses: x and y are kept
// as half floats, 0.05 % of themselves exact, so that fewer registers wait.
struct LitPoints {
    uvec4 xy[4]; // two half floats each
    mat4 z;      // opaque where the point is no entry
};

// The plane through them: z = height + slope · (x, y).
struct EntryPlane {
    vec2 slope;
    float height;
    float deviation; // mm, of the points from it and of it from the receiver, root mean square
    float cosine;    // between its normal and the light
    float opposite;  // [-1, 1] cosine between its normal and the receiver's, turned round
    float count;     // sum of the weights of the points that are entries
    float shadowed;  // [0, 1] share of the points that lie on another body, which throws a shadow
};

// [mm] Linear depth of the receiver.
float receiverDepth(LightParameters light, ShadowPoint point, vec3 normal) {
    vec3 offset = (point.offset + normal * point.moved) * view.mmPerUnit;
    return light.kind == lightDirectional ? dot(offset, light.direction.xyz) : length(offset);
}

EntryFrame entryFrame(LightParameters light, ShadowPoint point, vec3 normal, vec3 toLight, float depth) {
    vec3 gradientX = point.projection.x.xyz - point.texel.x * point.projection.w.xyz; // of texel · w
    vec3 gradientY = point.projection.y.xyz - point.texel.y * point.projection.w.xyz;
    vec3 alongX = cross(gradientY, toLight);
    vec3 alongY = cross(toLight, gradientX);
    float scale = point.w * view.mmPerUnit / dot(gradientX, alongX);
    vec3 axisX = normalize(alongX);
    vec3 axisY = cross(toLight, axisX);
    EntryFrame frame;
    frame.stepX = vec2(scale * length(alongX), 0.0);
    frame.stepY = scale * vec2(dot(alongY, axisX), dot(alongY, axisY));
    frame.taper =
        vec2(dot(point.projection.w.xyz, alongX), dot(point.projection.w.xyz, alongY)) / dot(gradientX, alongX);
    frame.normal = vec3(dot(normal, axisX), dot(normal, axisY), dot(normal, toLight));
    frame.moved = -point.moved * view.mmPerUnit * frame.normal.xy;
    frame.depth = depth;
    frame.curvature = light.kind == lightDirectional ? 0.0 : 1.0 / depth;
    return frame;
}

// Texels between the points on an axis of the map. Where a texel's size changes over the map it keeps to powers of two,
// so that the points of neighbours are the same.
float entrySpacingOf(LightParameters light, Receiver receiver, float texelSize) {
    float wanted = entrySpacing * spreadOf(receiver) / (texelSize * view.mmPerUnit);
    if (light.kind != lightDirectional) {
        wanted = exp2(floor(log2(max(wanted, 1e-6)) + 0.5));
    }
    float least = max(0.5 * parameters.filterRadius, 0.5);
    bool isWide = !hasFlag(flagThesisTransmittance);
    return isWide ? max(least, min(wanted, 0.25 * min(light.shadowSize.x, light.shadowSize.y))) : least;
}

// The largest of 4x4 depths at which there is something, -nothingThere where there is nothing.
float deepestEntry(MapDepths map) {
    vec4 deepest = vec4(-nothingThere);
    for (int row = 0; row < 4; ++row) {
        vec4 depth = map.depth[row];
        deepest = max(deepest, mix(depth, vec4(-nothingThere), greaterThanEqual(depth, vec4(0.5 * nothingThere))));
    }
    return max(max(deepest.x, deepest.y), max(deepest.z, deepest.w));
}

// A row of the points: x, y and z. `coordinate`: where the receiver falls in the map, texels. `deepest`: mm, of those that
// matter.
void litRow(EntryFrame frame, vec4 depth, Taps taps, int row, vec2 coordinate, float deepest, out vec4 x, out vec4 y,
            out vec4 z) {
    vec4 texelsX = tapsX(taps, row) + 0.5 - coordinate.x;
    vec4 texelsY = tapsY(taps, row) + 0.5 - coordinate.y;
    vec4 perspective = 1.0 / max(1.0 - texelsX * frame.taper.x - texelsY * frame.taper.y, 0.01);
    x = (texelsX * frame.stepX.x + texelsY * frame.stepY.x) * perspective;
    y = texelsY * frame.stepY.y * perspective;
    vec4 slant = inversesqrt(1.0 + frame.curvature * frame.curvature * (x * x + y * y));
    depth = min(depth, deepest);
    vec4 share = frame.curvature > 0.0 ? frame.curvature * depth * slant : vec4(1.0); // a lamp's rays part
    x = x * share + frame.moved.x;
    y = y * share + frame.moved.y;
    z = frame.depth - depth * slant;
}

uvec4 packedPairs(vec4 x, vec4 y) {
    return uvec4(packHalf2x16(vec2(x.x, y.x)), packHalf2x16(vec2(x.y, y.y)), packHalf2x16(vec2(x.z, y.z)),
                 packHalf2x16(vec2(x.w, y.w)));
}

void unpackPairs(uvec4 pairs, out vec4 x, out vec4 y) {
    vec2 pair[4] = vec2[4](unpackHalf2x16(pairs.x), unpackHalf2x16(pairs.y), unpackHalf2x16(pairs.z), unpackHalf2x16(pairs.w));
    x = vec4(pair[0].x, pair[1].x, pair[2].x, pair[3].x);
    y = vec4(pair[0].y, pair[1].y, pair[2].y, pair[3].y);
}

// The points, and the plane through them by least squares, in which near points count most. Where the points lie on a line
// or are few, it faces the light as far as they do not tell. `spacing`: mm between the points. `farthest`: mm, of the
// receiver from its entry. `inmost`: mm, how far beneath the receiver's plane its own body reaches.
EntryPlane entryPlane(EntryFrame frame, MapDepths map, Taps taps, vec2 coordinate, float spacing, float farthest,
                      float inmost, out LitPoints points) {
    EntryPlane plane;
    plane.count = 0.0;
    plane.shadowed = 0.0;
    float sum = 0.0;
    vec3 first = vec3(0.0);  // moments: x, y, z
    vec3 square = vec3(0.0); // xx, xy, yy
    vec3 height = vec3(0.0); // xz, yz, zz
    for (int row = 0; row < 4; ++row) {
        vec4 x, y, z;
        litRow(frame, map.depth[row], taps, row, coordinate, frame.depth + 2.0 * farthest, x, y, z);
        vec4 squared = x * x + y * y + z * z;
        vec4 beneath = -(x * frame.normal.x + y * frame.normal.y + z * frame.normal.z);
        vec4 isOther = 1.0 - step(beneath, vec4(inmost));
        vec4 weight = taps.columnWeights * taps.rowWeights[row];
        plane.shadowed += dot(weight, isOther);
        weight *= map.isEntry[row] * step(squared, vec4(farthest * farthest)) * (1.0 - isOther);
        plane.count += dot(weight, vec4(1.0));
        points.xy[row] = packedPairs(x, y);
        points.z[row] = mix(vec4(opaque), z, greaterThan(weight, vec4(0.0)));
        vec4 near = spacing * spacing / (spacing * spacing + squared);
        weight *= near * near;
        vec4 weightX = weight * x, weightY = weight * y;
        sum += dot(weight, vec4(1.0));
        first += vec3(dot(weightX, vec4(1.0)), dot(weightY, vec4(1.0)), dot(weight, z));
        square += vec3(dot(weightX, x), dot(weightX, y), dot(weightY, y));
        height += vec3(dot(weightX, z), dot(weightY, z), dot(weight * z, z));
    }
    float scale = 1.0 / max(sum, 1e-12);
    vec3 mean = scale * first;
    float rounding = 1e-5 * scale * (square.x + square.z);
    square = scale * square - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
    height = scale * height - mean.z * mean;
    float least = 1e-3 * max(square.x + square.z, 0.0) + rounding + 1e-12;
    square.xz = max(square.xz, 0.0) + least;
    float determinant = max(square.x * square.z - square.y * square.y, least * least);
    plane.slope =
        vec2(height.x * square.z - height.y * square.y, height.y * square.x - height.x * square.y) / determinant;
    plane.height = mean.z - dot(plane.slope, mean.xy);
    plane.cosine = inversesqrt(1.0 + dot(plane.slope, plane.slope));
    plane.opposite = plane.cosine * (dot(plane.slope, frame.normal.xy) - frame.normal.z);
    float off = max(height.z - dot(plane.slope, height.xy), 0.0);
    float across = plane.height * plane.cosine;
    plane.deviation = plane.count > 0.0 ? sqrt(off + across * across) : opaque;
    return plane;
}

// Arguments of the transmittance over the points: how far the receiver is from the plane, and how much nearer or
// farther than the plane each point is; but no nearer than it is across the plane. `most`: mm, authored.
mat4 entryThickness(LitPoints points, EntryPlane plane, float most) {
    float across = min(abs(plane.height) * plane.cosine, most);
    mat4 thickness;
    for (int row = 0; row < 4; ++row) {
        vec4 x, y, ownZ = points.z[row];
        unpackPairs(points.xy[row], x, y);
        vec4 lean = plane.slope.x * x + plane.slope.y * y;
        vec4 z = plane.height + lean;
        vec4 sidewards = x * x + y * y;
        vec4 excess = sqrt(sidewards + ownZ * ownZ) - sqrt(sidewards + z * z);
        vec4 own = min(abs(ownZ - lean) * plane.cosine, most);
        thickness[row] = mix(max(across + excess, own), vec4(opaque), equal(ownZ, vec4(opaque)));
    }
    return thickness;
}

// [0, 1] The share of an entry plane that is not the receiver's own side: all where they face each other, half at a
// right-angled edge, none where they are one surface.
float entryShare(float opposite) {
    float share = 0.5 + 0.5 * opposite;
    return opposite > 0.0 ? share : 2.0 * share * share;
}
