// The blended billboards in the format of the result: half floats hold too little of a sum of many layers.
#include "shaders/lib/pack.glsl"
#include "shaders/lib/work.glsl"

layout(binding = 0) uniform sampler2D red_texture;  // all of it without CHROMATIC: rgb radiance, a transmittance
#if CHROMATIC
layout(binding = 1) uniform sampler2D green_texture;
layout(binding = 2) uniform sampler2D blue_texture;
layout(location = 1) out vec4 out_transmittance;
#endif
layout(location = 0) out vec4 out_scattering;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 red = texelFetch(red_texture, pixel, 0);
    count_work(WORK_TEXTURE_FETCHES, uint(1 + 2 * CHROMATIC));
#if CHROMATIC
    vec4 green = texelFetch(green_texture, pixel, 0);
    vec4 blue = texelFetch(blue_texture, pixel, 0);
    vec3 transmittance = vec3(red.a, green.a, blue.a);
    float mean = dot(transmittance, vec3(1.0 / 3.0));
    out_scattering = round_to_half(vec4(red.r, green.r, blue.r, mean));
    out_transmittance = round_to_half(vec4(transmittance, mean));
#else
    out_scattering = round_to_half(red);
#endif
    flush_work();
}
