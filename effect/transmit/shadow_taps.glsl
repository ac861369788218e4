// Which 4x4 texels of a shadow map are looked at around a receiver.

// Texels between taps from which on they move with the receiver, and their weights then: a tent's.
const float leastMoving = 1.5;
const vec4 movingWeights = vec4(0.125, 0.375, 0.375, 0.125);

// 4x4 texels of a shadow map, and how much each column and row of them counts. A column's texels lie one below the
// other but for `shear`, and a row's beside each other.
struct Taps {
    vec4 columns, rows; // texels, without the shear
    vec4 columnWeights, rowWeights;
    vec4 shear; // texels that the first to fourth row is shifted to the right, and the first to fourth column downwards
    vec2 last;  // texel of the map
};

// Of the four taps in a row.
vec4 tapsX(Taps taps, int row) {
    return clamp(taps.columns + taps.shear[row], 0.0, taps.last.x);
}

vec4 tapsY(Taps taps, int row) {
    return clamp(taps.rows[row] - taps.shear, 0.0, taps.last.y);
}

// On an axis. Next to each other they stand on the map's grid under a tent, so that they come and go without weight.
// Farther apart they move with the receiver: a grid as wide would beat with what is as narrow as it, and turn a rib
// into beads. What lies outside of the map is not known, and has none.
void axisTaps(float coordinate, float spacing, float last, out vec4 texels, out vec4 weights) {
    const vec4 tap = vec4(-1.0, 0.0, 1.0, 2.0);
    if (spacing < leastMoving) {
        float base = floor(coordinate / spacing - 0.5);
        float fraction = coordinate / spacing - 0.5 - base;
        texels = floor((base + tap + 0.5) * spacing);
        weights = 0.5 - 0.25 * abs(tap - fraction);
    } else {
        texels = floor(coordinate + (tap - 0.5) * spacing);
        weights = movingWeights;
    }
    vec4 inside = weights * step(0.0, texels) * step(texels, vec4(last));
    float sum = dot(inside, vec4(1.0));
    weights = sum > 0.0 ? inside / sum : weights;
}

// Those that move are sheared, so that they cross an edge one by one.
Taps tapsAround(vec2 coordinate, float spacing, vec2 size) {
    Taps taps;
    taps.last = size - 1.0;
    axisTaps(coordinate.x, spacing, taps.last.x, taps.columns, taps.columnWeights);
    axisTaps(coordinate.y, spacing, taps.last.y, taps.rows, taps.rowWeights);
    taps.shear = spacing < leastMoving ? vec4(0.0) : floor(0.25 * spacing * vec4(-1.5, -0.5, 0.5, 1.5) + 0.5);
    return taps;
}
