// Where a light enters a body, and what comes through to the receiver: entry.glsl. Included after shadow_maps.wgsl and
// transmittance.wgsl.

// [1] Distance between points of the lit surface, over the radius outside of which a quarter of the light leaves.
const entrySpacing: f32 = 0.5;
// [1] How many texels and spacings of points a body may be thicker than twice its authored thickness.
const bodyTexels: f32 = 4.0;
const bodySpacings: f32 = 1.0;
// [mm] Thickness that nothing shines through.
const opaque: f32 = 1e9;

struct Receiver {
    viewPosition: vec3f, // view space, mm
    position: vec3f,     // world space, scene units
    normal: vec3f,       // world space, unit length
    material: u32,
    authored: f32, // mm, 0 = not authored
    scale: f32,    // of the profile's lengths
}

// [mm] Thickness that lets nothing through.
fn reachOf(receiver: Receiver) -> f32 {
    return receiver.scale * f32(transmittanceEnd) / tables[receiver.material].scale;
}

// [mm] Radius outside of which a quarter of the light leaves.
fn spreadOf(receiver: Receiver) -> f32 {
    return receiver.scale * tables[receiver.material].spread;
}

// Projects offsets from the light to a layer of its shadow map: rows for texel coordinates times w, and for w.
struct ShadowProjection {
    x: vec4f,
    y: vec4f,
    w: vec4f,
    layer: u32,
}

// Where the receiver falls in a shadow map, moved inwards by the normal offset, so that at silhouettes it finds its own body.
struct ShadowPoint {
    projection: ShadowProjection,
    offset: vec3f, // from the light, scene units
    texel: vec2f,
    w: f32,
    texelSize: f32, // scene units
    moved: f32,     // scene units
    inside: bool,
}

// The face that an offset points at, as in Vulkan's cube maps ("Cube Map Face Selection").
fn cubeFace(light: LightParameters, offset: vec3f) -> ShadowProjection {
    let size = abs(offset);
    let isX = size.x >= size.y && size.x >= size.z;
    let isY = !isX && size.y >= size.z;
    let largest = select(select(offset.z, offset.y, isY), offset.x, isX);
    let side = select(-1.0, 1.0, largest > 0.0);
    let major = side * select(vec3f(0.0), vec3f(1.0), vec3<bool>(isX, isY, !isX && !isY));
    let s = select(vec3f(select(side, 1.0, isY), 0.0, 0.0), vec3f(0.0, 0.0, -side), isX);
    let t = select(vec3f(0.0, -1.0, 0.0), vec3f(0.0, 0.0, side), isY);
    let face = select(select(4u, 2u, isY), 0u, isX) + select(1u, 0u, side > 0.0);
    let middle = 0.5 * light.shadowSize;
    return ShadowProjection(vec4f(middle.x * (s + major), 0.0), vec4f(middle.y * (t + major), 0.0), vec4f(major, 0.0),
                            light.shadowLayer + face);
}

fn project(light: LightParameters, receiver: Receiver) -> ShadowPoint {
    let offset = receiver.position - light.position.xyz;
    let size = abs(offset);
    let isPoint = light.kind == lightPoint;
    let w = select(dot(light.shadowW, vec4f(offset, 1.0)), max(size.x, max(size.y, size.z)), isPoint);
    var point: ShadowPoint;
    point.texelSize = light.shadowTexel * max(w, 0.0);
    point.moved = parameters.normalOffset * point.texelSize;
    point.offset = offset - receiver.normal * point.moved;
    point.projection = ShadowProjection(light.shadowX, light.shadowY, light.shadowW, light.shadowLayer);
    if (isPoint) {
        point.projection = cubeFace(light, point.offset);
    }
    let inner = vec4f(point.offset, 1.0);
    point.w = dot(point.projection.w, inner);
    point.texel = vec2f(dot(point.projection.x, inner), dot(point.projection.y, inner)) / point.w;
    point.inside = point.w > 0.0 && all(point.texel >= vec2f(0.0)) && all(point.texel <= light.shadowSize);
    return point;
}

// Axes in which points are measured, mm from the receiver: two across the light, the third towards it.
struct EntryFrame {
    stepX: vec2f, // across the light, from one texel of the map to the next
    stepY: vec2f,
    normal: vec3f,  // the receiver's
    taper: vec2f,   // how w of the map changes along the steps, a share of it
    moved: vec2f,   // across the light, from the receiver to where it falls in the map
    depth: f32,     // linear depth of the receiver
    curvature: f32, // 1/mm, of surfaces of one depth; 0 for directional lights
}

// 4x4 points of the lit surface, their distance from the receiver, and how much they count: 0 where they are no entry.
struct LitPoints {
    x: mat4x4f,
    y: mat4x4f,
    z: mat4x4f,
    distance: mat4x4f,
    weight: mat4x4f,
    count: f32,    // sum of the weights
    shadowed: f32, // [0, 1] share of them that lie on another body, which throws a shadow
}

// The plane through them: z = height + slope · (x, y).
struct EntryPlane {
    slope: vec2f,
    height: f32,
    deviation: f32, // mm, of the points from it and of it from the receiver, root mean square
    cosine: f32,    // between its normal and the light
    opposite: f32,  // [-1, 1] cosine between its normal and the receiver's, turned round
}

// [mm] Linear depth of the receiver.
fn receiverDepth(light: LightParameters, point: ShadowPoint, normal: vec3f) -> f32 {
    let offset = (point.offset + normal * point.moved) * parameters.view.mmPerUnit;
    return select(length(offset), dot(offset, light.direction.xyz), light.kind == lightDirectional);
}

fn entryFrame(light: LightParameters, point: ShadowPoint, normal: vec3f, toLight: vec3f, depth: f32) -> EntryFrame {
    let rows = point.projection;
    let gradientX = rows.x.xyz - point.texel.x * rows.w.xyz; // of texel · w
    let gradientY = rows.y.xyz - point.texel.y * rows.w.xyz;
    let alongX = cross(gradientY, toLight);
    let alongY = cross(toLight, gradientX);
    let scale = point.w * parameters.view.mmPerUnit / dot(gradientX, alongX);
    let axisX = normalize(alongX);
    let axisY = cross(toLight, axisX);
    var frame: EntryFrame;
    frame.stepX = vec2f(scale * length(alongX), 0.0);
    frame.stepY = scale * vec2f(dot(alongY, axisX), dot(alongY, axisY));
    frame.taper = vec2f(dot(rows.w.xyz, alongX), dot(rows.w.xyz, alongY)) / dot(gradientX, alongX);
    frame.normal = vec3f(dot(normal, axisX), dot(normal, axisY), dot(normal, toLight));
    frame.moved = -point.moved * parameters.view.mmPerUnit * frame.normal.xy;
    frame.depth = depth;
    frame.curvature = select(1.0 / depth, 0.0, light.kind == lightDirectional);
    return frame;
}

// Texels between the points on an axis of the map. Where a texel's size changes over the map it keeps to powers of two, so
// that the points of neighbours are the same.
fn entrySpacingOf(light: LightParameters, receiver: Receiver, texelSize: f32) -> f32 {
    var wanted = entrySpacing * spreadOf(receiver) / (texelSize * parameters.view.mmPerUnit);
    if (light.kind != lightDirectional) {
        wanted = exp2(floor(log2(max(wanted, 1e-6)) + 0.5));
    }
    let least = max(0.5 * parameters.filterRadius, 0.5);
    return max(least, min(wanted, 0.25 * min(light.shadowSize.x, light.shadowSize.y)));
}

// The largest of 4x4 depths at which there is something, -nothingThere where there is nothing.
fn deepestEntry(map: MapDepths) -> f32 {
    var deepest = vec4f(-nothingThere);
    for (var row = 0; row < 4; row++) {
        deepest = max(deepest, select(map.depth[row], vec4f(-nothingThere), map.depth[row] >= vec4f(0.5 * nothingThere)));
    }
    return max(max(deepest.x, deepest.y), max(deepest.z, deepest.w));
}

// `coordinate`: where the receiver falls in the map, texels. `farthest`: mm, of the receiver from its entry. `inmost`: mm, how
// far beneath the receiver's plane its own body reaches.
fn litPoints(frame: EntryFrame, map: MapDepths, taps: Taps, coordinate: vec2f, farthest: f32, inmost: f32) -> LitPoints {
    var points: LitPoints;
    for (var row = 0; row < 4; row++) {
        let texelsX = tapsX(taps, row) + 0.5 - coordinate.x;
        let texelsY = tapsY(taps, row) + 0.5 - coordinate.y;
        let perspective = 1.0 / max(1.0 - texelsX * frame.taper.x - texelsY * frame.taper.y, vec4f(0.01));
        let flatX = (texelsX * frame.stepX.x + texelsY * frame.stepY.x) * perspective;
        let flatY = texelsY * frame.stepY.y * perspective;
        let slant = inverseSqrt(1.0 + frame.curvature * frame.curvature * (flatX * flatX + flatY * flatY));
        let depth = min(map.depth[row], vec4f(frame.depth + 2.0 * farthest));
        let share = select(vec4f(1.0), frame.curvature * depth * slant, frame.curvature > 0.0); // a lamp's rays part
        let x = flatX * share + frame.moved.x;
        let y = flatY * share + frame.moved.y;
        let z = frame.depth - depth * slant;
        let distance = sqrt(x * x + y * y + z * z);
        let beneath = -(x * frame.normal.x + y * frame.normal.y + z * frame.normal.z);
        let isOther = 1.0 - step(beneath, vec4f(inmost));
        let weight = taps.columns.weights * taps.rows.weights[row];
        let counted = weight * map.isEntry[row] * step(distance, vec4f(farthest)) * (1.0 - isOther);
        points.x[row] = x;
        points.y[row] = y;
        points.z[row] = z;
        points.distance[row] = distance;
        points.weight[row] = counted;
        points.count += dot(counted, vec4f(1.0));
        points.shadowed += dot(weight, isOther);
    }
    return points;
}

// By least squares, in which near points count most. Where the points lie on a line or are few, it faces the light as far as
// they do not tell. `spacing`: mm between the points.
fn entryPlane(points: LitPoints, normal: vec3f, spacing: f32) -> EntryPlane {
    var sum = 0.0;
    var first = vec3f(0.0);  // moments: x, y, z
    var square = vec3f(0.0); // xx, xy, yy
    var height = vec3f(0.0); // xz, yz, zz
    for (var row = 0; row < 4; row++) {
        let x = points.x[row];
        let y = points.y[row];
        let z = points.z[row];
        let near = spacing * spacing / (spacing * spacing + points.distance[row] * points.distance[row]);
        let weight = points.weight[row] * near * near;
        let weightX = weight * x;
        let weightY = weight * y;
        sum += dot(weight, vec4f(1.0));
        first += vec3f(dot(weightX, vec4f(1.0)), dot(weightY, vec4f(1.0)), dot(weight, z));
        square += vec3f(dot(weightX, x), dot(weightX, y), dot(weightY, y));
        height += vec3f(dot(weightX, z), dot(weightY, z), dot(weight * z, z));
    }
    let scale = 1.0 / max(sum, 1e-12);
    let mean = scale * first;
    let rounding = 1e-5 * scale * (square.x + square.z);
    square = scale * square - vec3f(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
    height = scale * height - mean.z * mean;
    let least = 1e-3 * max(square.x + square.z, 0.0) + rounding + 1e-12;
    square.x = max(square.x, 0.0) + least;
    square.z = max(square.z, 0.0) + least;
    let determinant = max(square.x * square.z - square.y * square.y, least * least);
    var plane: EntryPlane;
    plane.slope =
        vec2f(height.x * square.z - height.y * square.y, height.y * square.x - height.x * square.y) / determinant;
    plane.height = mean.z - dot(plane.slope, mean.xy);
    plane.cosine = inverseSqrt(1.0 + dot(plane.slope, plane.slope));
    plane.opposite = plane.cosine * (dot(plane.slope, normal.xy) - normal.z);
    let off = max(height.z - dot(plane.slope, height.xy), 0.0);
    let across = plane.height * plane.cosine;
    plane.deviation = select(opaque, sqrt(off + across * across), points.count > 0.0);
    return plane;
}

// Arguments of the transmittance over the points: how far the receiver is from the plane, and how much nearer or farther than
// the plane each point is; but no nearer than it is across the plane. `most`: mm, authored.
fn entryThickness(points: LitPoints, plane: EntryPlane, most: f32) -> mat4x4f {
    let across = min(abs(plane.height) * plane.cosine, most);
    var thickness: mat4x4f;
    for (var row = 0; row < 4; row++) {
        let x = points.x[row];
        let y = points.y[row];
        let lean = plane.slope.x * x + plane.slope.y * y;
        let z = plane.height + lean;
        let excess = points.distance[row] - sqrt(x * x + y * y + z * z);
        let own = min(abs(points.z[row] - lean) * plane.cosine, vec4f(most));
        thickness[row] = select(vec4f(opaque), max(across + excess, own), points.weight[row] > vec4f(0.0));
    }
    return thickness;
}

// [0, 1] The share of an entry plane that is not the receiver's own side: all where they face each other, half at a
// right-angled edge, none where they are one surface.
fn entryShare(opposite: f32) -> f32 {
    let share = 0.5 + 0.5 * opposite;
    return select(2.0 * share * share, share, opposite > 0.0);
}
