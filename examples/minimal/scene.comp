// Stands in for a renderer: a sphere on a plane, by ray casting. Writes what the effect reads: irradiance, linear
// depth, material ids, normals and a shadow map.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform writeonly image2D irradianceImage;
layout(binding = 1) uniform writeonly image2D depthImage;
layout(binding = 2) uniform writeonly uimage2D materialIdImage;
layout(binding = 3) uniform writeonly image2D normalImage;
layout(binding = 4) uniform writeonly image2DArray shadowMapImage;
layout(push_constant) uniform Scene {
    vec4 eye;
    vec4 right;      // w: tangent of half the field of view
    vec4 up;
    vec4 lightOrigin;    // of the shadow map; w: its range
    vec4 lightRight;     // w: half the width of the shadow map
    vec4 lightUp;
    vec4 lightDirection; // the way the light travels; w: its irradiance
};

const vec3 center = vec3(0.0, 0.01, 0.0); // metres
const float radius = 0.01;
const float miss = 1e9;

float hitSphere(vec3 origin, vec3 ray) {
    vec3 offset = origin - center;
    float b = dot(offset, ray);
    float root = b * b - dot(ray, ray) * (dot(offset, offset) - radius * radius);
    float distance = (-b - sqrt(max(root, 0.0))) / dot(ray, ray);
    return root > 0.0 && distance > 0.0 ? distance : miss;
}

float hitPlane(vec3 origin, vec3 ray) {
    float distance = -origin.y / ray.y;
    return distance > 0.0 && length((origin + distance * ray).xz) < 0.05 ? distance : miss;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    vec2 size = vec2(imageSize(irradianceImage));
    vec2 clip = (vec2(pixel) + 0.5) / size * 2.0 - 1.0;

    vec3 shadowStart = lightOrigin.xyz + lightRight.w * (clip.x * lightRight.xyz + clip.y * lightUp.xyz);
    float caster = min(hitSphere(shadowStart, lightDirection.xyz), hitPlane(shadowStart, lightDirection.xyz));
    imageStore(shadowMapImage, ivec3(pixel, 0), vec4(min(caster / lightOrigin.w, 1.0)));

    // A ray whose length along the view direction is 1, so that the distance is linear depth.
    vec3 forward = cross(up.xyz, right.xyz);
    vec2 aspect = vec2(size.x / size.y, 1.0) * right.w;
    vec3 ray = forward + clip.x * aspect.x * right.xyz - clip.y * aspect.y * up.xyz;
    float sphere = hitSphere(eye.xyz, ray);
    float plane = hitPlane(eye.xyz, ray);
    float depth = min(sphere, plane);
    vec3 point = eye.xyz + depth * ray;
    vec3 normal = sphere < plane ? (point - center) / radius : vec3(0.0, 1.0, 0.0);

    float lit = hitSphere(point + normal * 1e-5, -lightDirection.xyz) < miss ? 0.0 : 1.0;
    float direct = lit * lightDirection.w * max(dot(normal, -lightDirection.xyz), 0.0);
    float ambient = 0.25 + 0.1 * normal.y;
    bool hit = depth < miss;
    imageStore(irradianceImage, pixel, vec4(vec3(hit ? direct + ambient : 0.0), 1.0));
    imageStore(depthImage, pixel, vec4(hit ? depth : 0.0));
    imageStore(materialIdImage, pixel, uvec4(!hit ? 0u : sphere < plane ? 1u : 2u));
    imageStore(normalImage, pixel, vec4(hit ? normal : vec3(0.0, 0.0, 1.0), 0.0));
}
