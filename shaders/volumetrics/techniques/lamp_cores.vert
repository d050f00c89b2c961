// A square round the core of a lamp, that faces the eye, drawn as a strip.
#include "shaders/volumetrics/frame/ray.glsl"
#include "shaders/volumetrics/light/lamp_core.glsl"

uniform uint lamp;
uniform mat4 world_to_clip;

void main() {
    GpuLight light = light_at(lamp);
    float radius = core_radius(light);
    vec3 to_lamp = light.position_range.xyz - volumetrics.eye.xyz;
    float distance = length(to_lamp);
    // Of a ball seen from near its rim the outline is wider than its middle.
    float half_side = radius * distance / sqrt(max(distance * distance - radius * radius, 1.0e-6));
    vec3 forward = to_lamp / max(distance, 1.0e-6);
    vec3 right = normalize(cross(forward, volumetrics.inverse_view[1].xyz));
    vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    vec3 at = light.position_range.xyz + half_side * (corner.x * right + corner.y * cross(right, forward));
    gl_Position = target_clip(world_to_clip * vec4(at, 1.0));
    if (radius <= light.intensity_radius.w) gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
