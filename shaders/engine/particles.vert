// A camera-facing quad around a particle. Its light is taken at the corners: what scatters in a puff of smoke is smooth.
#extension GL_ARB_shader_draw_parameters : require
#include "shaders/engine/air_light.glsl"
#include "shaders/shared/particles.h"

layout(std430, binding = BINDING_PARTICLES) readonly buffer ParticleBuffer { Particle particles[]; };

layout(location = 0) out vec2 corner;         // -1..1
layout(location = 1) out vec3 radiance;       // of an opaque particle
layout(location = 2) flat out vec4 opacity_radius_depth_seed;

void main() {
    Particle particle = particles[gl_BaseInstanceARB + gl_InstanceID];
    corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    float seed = particle.emission_seed.w;
    float angle = 6.2831853 * seed;
    mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec4 center = frame.view * vec4(particle.position_radius.xyz, 1.0);
    float radius = particle.position_radius.w;
    vec4 view = vec4(center.xy + turn * corner * radius, center.z, 1.0);
    gl_Position = frame.projection * view;
    float view_depth = -center.z;
    vec3 world = (frame.inverse_view * view).xyz;
    vec2 screen = gl_Position.xy / max(gl_Position.w, 1e-6) * 0.5 + 0.5;
    radiance = particle.color_opacity.rgb * air_light(world, screen, view_depth) + particle.emission_seed.rgb;
    opacity_radius_depth_seed = vec4(particle.color_opacity.a, radius, view_depth, seed);
    flush_work();
}
