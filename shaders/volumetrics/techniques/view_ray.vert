// One triangle over the target. The mean ambient radiance is the same for all pixels: it is taken here.
#include "shaders/interface/lights.glsl"
#include "shaders/volumetrics/frame/data.glsl"

layout(location = 0) flat out vec3 ambient;

void main() {
    vec2 uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
    ambient = volumetrics.has_ambient != 0u ? ambient_radiance() : vec3(0.0);
}
