// What all passes of the example know: the frame, and the bodies, which are ellipsoids on a table.
struct Body {
    vec4 center; // metres; w: material, 0 = without subsurface scattering
    vec4 radius;
};

layout(binding = 0, std140) uniform Frame {
    mat4 viewFromWorld;
    mat4 clipFromView;
    mat4 worldFromView;
    mat4 shadowClipFromWorld[4];
    vec4 cascadeEnds;    // metres from the camera along its direction
    vec4 lightDirection; // the way the light travels; w: its irradiance
    Body bodies[8];
};

const float surroundings = 0.15; // irradiance from all around

const int rings = 48;
const int segments = 64;

// A point of the unit sphere, by the number of a vertex of its triangles.
vec3 spherePoint(int vertex) {
    int quad = vertex / 6;
    int corner = vertex % 6;
    ivec2 step = ivec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);
    vec2 place = vec2(ivec2(quad % segments, quad / segments) + step) / vec2(segments, rings);
    float around = place.x * 6.28318530718;
    float down = place.y * 3.14159265359;
    return vec3(sin(down) * cos(around), cos(down), sin(down) * sin(around));
}
