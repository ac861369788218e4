// The physical floor: reads what scattering must read of every pixel, and writes what it must write.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0) uniform texture2D irradianceImage;
layout(set = 0, binding = 1) uniform texture2D depthImage;
layout(set = 0, binding = 2) uniform utexture2D materialIdImage;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D scatteredImage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(scatteredImage)))) {
        return;
    }
    vec4 light = texelFetch(irradianceImage, pixel, 0);
    float depth = texelFetch(depthImage, pixel, 0).r;
    uint material = texelFetch(materialIdImage, pixel, 0).r;
    imageStore(scatteredImage, pixel, vec4(light.rgb, depth + float(material)));
}
