// The clear sky without the sun's disc, one invocation a texel of a cube map; mips follow.
#include "shaders/engine/cube_direction.glsl"
#include "shaders/engine/sky_model.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) writeonly uniform imageCube destination;

uniform vec3 to_sun;
uniform float illuminance;  // lux
uniform float light_unit;   // cd/m² that are stored as 1

void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    int size = imageSize(destination).x;
    if (any(greaterThanEqual(p.xy, ivec2(size)))) return;
    vec3 radiance = sky_radiance(cube_direction(p, size), to_sun, illuminance) / light_unit;
    imageStore(destination, p, vec4(min(radiance, vec3(65000.0)), 1.0));
}
