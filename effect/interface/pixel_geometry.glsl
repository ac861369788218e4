// View-space geometry of a pixel: position in mm, pixel size in mm. Needs `view`, a ViewParameters, and `depthImage`.

bool isFinite(float value) {
    return (floatBitsToUint(value) & 0x7fffffffu) < 0x7f800000u;
}

// Not where the sum is beyond a float, either.
bool isFinite(vec3 value) {
    return isFinite(value.x + value.y + value.z);
}

bool isInArea(ivec2 pixel) {
    return all(greaterThanEqual(pixel, view.areaOffset)) && all(lessThan(pixel, view.areaOffset + view.areaExtent));
}

#ifndef POSSIBLE_FLAGS
#define POSSIBLE_FLAGS ~0u // those that calls of this pipeline may have
#endif

bool hasFlag(uint flag) {
    return (view.flags & POSSIBLE_FLAGS & flag) != 0u;
}

// x and y of a pixel's ray: position = (ray·z + origin, z).
vec2 rayAt(ivec2 pixel) {
    return view.rayX * float(pixel.x) + view.rayY * float(pixel.y) + view.rayBias;
}

vec2 originAt(ivec2 pixel) {
    return view.originX * float(pixel.x) + view.originY * float(pixel.y) + view.originBias;
}

// View z in mm (negative in front of a perspective camera). Hardware depth: clip z = depth · clip w, both linear in z
// along the pixel's ray.
float viewZ(ivec2 pixel, float depth) {
    if (!hasFlag(flagHardwareDepth)) {
        return -depth * view.mmPerUnit;
    }
    vec3 place = vec3(pixel, 1.0);
    return (dot(view.depthBias.xyz, place) - depth * view.clipW.y) / (depth * view.clipW.x - dot(view.depthSlope.xyz, place));
}

float viewZ(ivec2 pixel) {
    return viewZ(pixel, texelFetch(depthImage, pixel, 0).r);
}

float clipW(float z) {
    return view.clipW.x * z + view.clipW.y;
}

// Whether something was drawn there, in front of the camera.
bool isValidZ(float z) {
    return clipW(z) > 0.0 && isFinite(z);
}

// Length of a pixel's ray where z changes by 1.
float stretchAt(ivec2 pixel) {
    return length(vec3(rayAt(pixel), 1.0));
}

// How far a pixel's surface is along its ray, mm, from view z distanceOrigin on; 0 where nothing was drawn.
float distanceAlongRay(ivec2 pixel, float z) {
    float along = (view.distanceOrigin - z) * stretchAt(pixel);
    return isValidZ(z) && isFinite(along) ? along : 0.0;
}

// The same from the depths of 2x2 px, row by row: what is linear over the image, or so nearly, is asked once. `first`: the
// first pixel.
vec4 distancesAlongRays(ivec2 first, vec4 depth) {
    const vec4 x = vec4(0.0, 1.0, 0.0, 1.0);
    const vec4 y = vec4(0.0, 0.0, 1.0, 1.0);
    vec2 ray = rayAt(first) + 0.5 * (view.rayX + view.rayY);
    float middle = sqrt(1.0 + dot(ray, ray)); // stretchAt between the four
    vec2 change = vec2(dot(ray, view.rayX), dot(ray, view.rayY)) / middle;
    vec4 stretch = middle + (x - 0.5) * change.x + (y - 0.5) * change.y;
    vec4 z = -depth * view.mmPerUnit;
    if (hasFlag(flagHardwareDepth)) {
        vec3 place = vec3(first, 1.0);
        vec4 slope = dot(view.depthSlope.xyz, place) + x * view.depthSlope.x + y * view.depthSlope.y;
        vec4 bias = dot(view.depthBias.xyz, place) + x * view.depthBias.x + y * view.depthBias.y;
        z = (bias - depth * view.clipW.y) / (depth * view.clipW.x - slope);
    }
    vec4 along = (view.distanceOrigin - z) * stretch;
    bvec4 drawn = greaterThan(view.clipW.x * z + view.clipW.y, vec4(0.0));
    bvec4 finite = lessThan(floatBitsToUint(along) & 0x7fffffffu, uvec4(0x7f800000u));
    return mix(vec4(0.0), along, bvec4(uvec4(drawn) & uvec4(finite)));
}

vec3 viewPosition(ivec2 pixel, float z) {
    return vec3(rayAt(pixel) * z + originAt(pixel), z);
}

// How far a view-space position moves, in mm, from one pixel to the next at constant z.
vec2 stepX(float z) {
    return view.rayX * z + view.originX;
}

vec2 stepY(float z) {
    return view.rayY * z + view.originY;
}
