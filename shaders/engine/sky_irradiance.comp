// Diffuse light of the sky per surface normal: irradiance / pi = 1/pi int L max(n.l, 0) dl, summed over all texels of a
// small level of the sky cube. A texel at distance r from the cube's centre covers (2/size)^2 / r^3.
#include "shaders/engine/cube_direction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform samplerCube sky;
layout(binding = 0, rgba16f) writeonly uniform imageCube destination;

uniform int level;

void main() {
    ivec3 p = ivec3(gl_GlobalInvocationID);
    int size = imageSize(destination).x;
    if (any(greaterThanEqual(p.xy, ivec2(size)))) return;
    vec3 normal = cube_direction(p, size);
    int source_size = textureSize(sky, level).x;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < source_size; ++y)
            for (int x = 0; x < source_size; ++x) {
                vec3 d = cube_axis_direction(ivec3(x, y, face), source_size);
                float r2 = dot(d, d);
                float weight = max(dot(normal, d), 0.0) / (r2 * r2);  // the cosine's 1/r and the solid angle's 1/r^3
                sum += weight * textureLod(sky, d, float(level)).rgb;
                weights += weight;
            }
    // The weights sum to pi in the limit: dividing by their own sum makes a uniform sky exact.
    imageStore(destination, p, vec4(sum / weights, 1.0));
}
