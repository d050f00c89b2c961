// What glass before the first opaque surface leaves of light (rgb, to be multiplied), and where the first glass is (a, the
// greatest counts): see glass_lookup.glsl. LAYERS: the shadow map is one of an array.
#include "shaders/engine/glass_filter.glsl"

in vec3 world;
in vec2 surface_uv;
in vec4 vertex_color;

layout(location = 0) out vec4 glass;

layout(binding = 0) uniform sampler2D base_color_texture;
#if LAYERS
layout(binding = 1) uniform sampler2DArray shadow_map;
uniform int layer;
#else
layout(binding = 1) uniform sampler2D shadow_map;
#endif
uniform vec4 base_color_factor;
uniform float scale;    // px of the shadow map a px of the target
uniform vec4 nearness;  // dot(nearness, vec4(world, 1)): a, 0 .. 1, greater is nearer to the light

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy * scale);
#if LAYERS
    float opaque = texelFetch(shadow_map, ivec3(texel, layer), 0).r;
#else
    float opaque = texelFetch(shadow_map, texel, 0).r;
#endif
    if (clamp(gl_FragCoord.z, 0.0, 1.0) < opaque) discard;
    vec4 base_color = texture(base_color_texture, surface_uv) * base_color_factor * vertex_color;
    glass = vec4(glass_filter(base_color), dot(nearness, vec4(world, 1.0)));
}
