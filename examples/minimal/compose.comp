// Puts the picture together from the effect's two outputs, and encodes it as sRGB.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 2, r16ui) uniform readonly uimage2D materialIdImage;
layout(binding = 5, rgba16f) uniform readonly image2D scatteredImage;
layout(binding = 6, rgba16f) uniform readonly image2D transmittedImage;
layout(binding = 7) writeonly buffer Picture {
    uint picture[];
};

const vec3 albedo[] = vec3[](vec3(0.0), vec3(0.85, 0.8, 0.7), vec3(0.75, 0.6, 0.52));

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    uint id = imageLoad(materialIdImage, pixel).r;
    vec3 scattered = imageLoad(scatteredImage, pixel).rgb;
    vec3 transmitted = imageLoad(transmittedImage, pixel).rgb;
    // [snippet: compose]
    vec3 diffuse = albedo[id] / 3.14159265 * (scattered + transmitted);
    // [end]
    vec3 linear = min(diffuse, vec3(1.0));
    vec3 encoded = mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThan(linear, vec3(0.0031308)));
    picture[pixel.y * imageSize(materialIdImage).x + pixel.x] = packUnorm4x8(vec4(encoded, 1.0));
}
