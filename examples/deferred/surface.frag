// The G-buffer: colour, and the normal in view space as two numbers (octahedral).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ellipsoid.glsl"
layout(push_constant) uniform Draw {
    int cascade;
    int body;
};
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 albedoOut;
layout(location = 1) out vec2 normalOut;

const vec3 colours[] = vec3[](vec3(0.35), vec3(0.83, 0.79, 0.75), vec3(0.77, 0.55, 0.45), vec3(0.92, 0.82, 0.62));

void main() {
    vec3 n = normal / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    vec2 folded = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
    normalOut = n.z >= 0.0 ? n.xy : folded;
    albedoOut = vec4(colours[int(bodies[body].center.w)], 1.0);
}
