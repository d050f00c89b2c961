// A soft puff: its opacity falls from the middle to a ragged outline, and to 0 where a surface cuts it or the eye enters it.
#include "shaders/engine/frame_block.glsl"
#include "shaders/engine/transparent_blend.glsl"
#include "shaders/lib/depth.glsl"
#include "shaders/lib/noise.glsl"
#include "shaders/lib/work.glsl"

layout(location = 0) in vec2 corner;
layout(location = 1) in vec3 radiance;
layout(location = 2) flat in vec4 opacity_radius_depth_seed;

layout(location = 0) out vec4 color;

layout(binding = 0) uniform sampler2D depth_texture;

// 1 in the middle, 0 at the rim of the quad's circle: what a ball of even density hides is about as wide.
float puff(vec2 p, float seed) {
    float r2 = dot(p, p);
    float ragged = r2 * (1.0 + 1.6 * fbm_noise(vec3(2.2 * p, 97.0 * seed), 2, 7u) - 0.5);
    float fall = clamp(1.0 - max(r2, ragged), 0.0, 1.0);
    return fall * fall;
}

void main() {
    float opacity = opacity_radius_depth_seed.x;
    float radius = opacity_radius_depth_seed.y;
    float view_depth = opacity_radius_depth_seed.z;
    float behind = view_depth_from_buffer(texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r, frame.depth.x);
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float soft = clamp((behind - view_depth) / radius, 0.0, 1.0) *
                 clamp((view_depth - frame.depth.x) / radius, 0.0, 1.0);
    float alpha = clamp(opacity * puff(corner, opacity_radius_depth_seed.w) * soft, 0.0, 1.0);
    if (alpha > 0.001) {
        Blended puff = blended(alpha * radiance, vec3(alpha), gl_FragCoord.xy * frame.viewport.zw, view_depth);
        color = vec4(puff.color, puff.hidden.r);
    } else {
        color = vec4(0.0);
    }
    flush_work();
}
