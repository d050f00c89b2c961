// The share of earlier frames in each pixel's light, from red (none) to green (all of it).
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;
layout(binding = 0) uniform sampler2D acceptance;

void main() {
    float share = texelFetch(acceptance, ivec2(uv * vec2(textureSize(acceptance, 0))), 0).r;
    display = vec4(1.0 - share, share, 0.0, 1.0);
}
