// A body, seen by the camera or, with push constant cascade >= 0, by the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ellipsoid.glsl"
layout(push_constant) uniform Draw {
    int cascade;
    int body;
};
layout(location = 0) out vec3 normal; // view space

void main() {
    vec3 point = spherePoint(gl_VertexIndex);
    vec3 position = bodies[body].center.xyz + bodies[body].radius.xyz * point;
    normal = mat3(viewFromWorld) * (point / bodies[body].radius.xyz);
    gl_Position = (cascade >= 0 ? shadowClipFromWorld[cascade] : clipFromView * viewFromWorld) * vec4(position, 1.0);
}
