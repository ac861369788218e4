// The effect's light, which the blend adds to the picture.
#version 460
layout(binding = 6) uniform sampler2D composedImage;
layout(location = 0) out vec4 light;

void main() {
    light = texelFetch(composedImage, ivec2(gl_FragCoord.xy), 0);
}
