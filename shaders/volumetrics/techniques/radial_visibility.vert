// One triangle over the target, and where the sun is on screen: in clip coordinates, in which it is a point at infinity
// whichever way the camera looks; w < 0 is behind.
#include "shaders/interface/lights.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(location = 0) flat out vec3 sun_clip;  // x, y, w

void main() {
    vec2 uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
    vec3 to_sun = transpose(mat3(volumetrics.inverse_view)) * -sun_direction();
    sun_clip = (inverse(volumetrics.inverse_projection) * vec4(to_sun, 0.0)).xyw;
}
