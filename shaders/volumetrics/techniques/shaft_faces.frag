// Translucent geometry with closed forms (Hoobler, "Fast, Flexible, Physically-Based Volumetric Light Scattering", GDC 2016;
// the surfaces of a volume bound the lit parts of a ray, Max 1986). With F(t) the sunlight gathered between the eye and t,
// unshadowed, a ray that is lit but for the parts [a, b] in the shadow volume gathers
//     F(surface) + sum over shadows of F(min(a, surface)) - F(min(b, surface)),
// so each front face adds F and each back face takes it away. Blended additively; no depth test: what lies behind the
// surface cancels, and what lies behind the eye has no fragment and F = 0. Nothing is sampled: there is no noise.
#include "shaders/volumetrics/techniques/shaft_sun.glsl"

layout(binding = 1) uniform sampler2D depth_texture;
layout(location = 0) out vec4 out_light;

void main() {
    Ray ray = view_ray(screen_place(gl_FragCoord.xy));
    float depth = texelFetch(depth_texture, ivec2(gl_FragCoord.xy), 0).r;
    count_work(WORK_TEXTURE_FETCHES, 1u);
    float face = 1.0 / max(gl_FragCoord.w, 1.0 / MAX_VIEW_DEPTH);
    float view_depth = min(face, view_depth_from_buffer(depth, volumetrics.eye.w));
    vec3 light = sun_light_to(ray, ray_distance_from_view_depth(view_depth, ray.forward_cosine));
    out_light = vec4(gl_FrontFacing ? light : -light, 0.0);
    flush_work();
}
