// A particle's disc as a strip of four corners that enclose its sphere as the eye sees it, one instance each; over the whole
// screen where the eye is in the sphere or close to it. Its depth is that of its front.
#include "shaders/shared/bindings.h"
#include "shaders/shared/sprites.h"
#include "shaders/volumetrics/frame/ray.glsl"

layout(std430, binding = BINDING_SPRITES) readonly buffer ParticleBuffer { ParticleSprite particles[]; };

uniform mat4 view_projection;  // of points relative to the eye
uniform float near;            // m

layout(location = 0) flat out vec4 center_radius;
layout(location = 1) flat out vec4 light;
layout(location = 2) flat out vec4 certain;

void main() {
    ParticleSprite particle = particles[gl_InstanceID];
    center_radius = particle.center_radius;
    light = particle.light;
    certain = particle.certain;
    vec3 center = center_radius.xyz;
    float radius = center_radius.w;
    float distance = length(center);
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    if (radius <= 0.0) {
        gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
        return;
    }
    if (distance < 1.2 * radius) {
        gl_Position = vec4(corner, 1.0, 1.0);
        return;
    }
    vec3 forward = center / distance;
    vec3 right = normalize(cross(forward, abs(forward.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 up = cross(right, forward);
    float tangent = radius / sqrt((distance - radius) * (distance + radius));
    vec3 place = center + (right * corner.x + up * corner.y) * (distance * tangent);
    vec4 clip = target_clip(view_projection * vec4(place, 1.0));
    float front = (view_projection * vec4(center, 1.0)).w - radius;
    gl_Position = vec4(clip.xy, clip.w * (near / max(front, near)), clip.w);
}
