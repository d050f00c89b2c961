// Vertices of the volume that the sun does not reach: everything under a surface w = H(angle, radius), seen from the sun.
// w runs towards the sun; angle and radius are taken around the axis through the eye. A view ray keeps its angle, and so
// does the edge of a shaft on the screen: rows of the grid are epipolar lines (compare Engelhardt and Dachsbacher 2010), and
// a ray meets the cells of one of them only.
//
// H is found by bisection of the host's sun_visibility: each line towards the sun is taken to be dark below one point and
// lit above it, as with any shadow map. Cells grow with the radius: in proportion to radius + 2 m.
//
// A column of the image holds one angle: radii + 1 points of the surface, then the lower rim and the centre of the bottom,
// which close the volume. Positions are relative to the eye.
#include "shaders/interface/lights.glsl"
#include "shaders/interface/shadows.glsl"
#include "shaders/lib/work.glsl"
#include "shaders/volumetrics/frame/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D shaft_vertices;

const float TWO_PI = 6.28318531;
const float GROWTH_RADIUS = 2.0;  // m
const int BISECTIONS = 18;

// What the screen sees of space around the axis: the angles, measured from `across`, and the slopes w / radius of its rays.
struct Wedge {
    vec3 across;
    vec3 along;   // a quarter turn further
    vec3 to_sun;
    vec2 angles;  // first, last
    bool full;    // the last is the first again
    vec2 slopes;  // lowest, highest; +-UNBOUNDED where rays may run along the axis
};
const float UNBOUNDED = 1.0e9;

// cot(angle): the slope of a ray at an angle to the sun's.
float slope(float angle) { return cos(angle) / sin(angle); }

Wedge screen_wedge() {
    Wedge wedge;
    wedge.to_sun = -sun_direction();
    vec3 corners[4] = vec3[4](view_ray(vec2(0.0, 0.0)).direction, view_ray(vec2(1.0, 0.0)).direction,
                              view_ray(vec2(1.0, 1.0)).direction, view_ray(vec2(0.0, 1.0)).direction);
    vec3 middle = normalize(corners[0] + corners[1] + corners[2] + corners[3]);
    vec3 across = middle - wedge.to_sun * dot(middle, wedge.to_sun);
    if (dot(across, across) < 1.0e-4) across = cross(wedge.to_sun, abs(wedge.to_sun.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    wedge.across = normalize(across);
    wedge.along = cross(wedge.to_sun, wedge.across);

    // The axis is on the screen if it lies on the same side of all of its edges.
    bvec2 inside = bvec2(true);
    float reach = 1.0;  // cosine between the middle and the corners
    wedge.angles = vec2(TWO_PI, -TWO_PI);
    for (int i = 0; i < 4; ++i) {
        vec3 edge = normalize(cross(corners[i], corners[(i + 1) & 3]));
        float side = dot(edge, wedge.to_sun);
        inside.x = inside.x && side > -1.0e-3;
        inside.y = inside.y && side < 1.0e-3;
        reach = min(reach, dot(middle, corners[i]));
        float angle = atan(dot(corners[i], wedge.along), dot(corners[i], wedge.across));
        wedge.angles = vec2(min(wedge.angles.x, angle), max(wedge.angles.y, angle));
    }
    wedge.full = inside.x || inside.y;
    float margin = 0.02 * (wedge.angles.y - wedge.angles.x) + 1.0e-3;
    wedge.angles += vec2(-margin, margin);
    if (wedge.full) wedge.angles = vec2(-0.5, 0.5) * TWO_PI;

    float reach_angle = acos(clamp(reach, -1.0, 1.0));
    float sun_angle = acos(clamp(dot(middle, wedge.to_sun), -1.0, 1.0));
    float nearest = sun_angle - reach_angle;
    float farthest = sun_angle + reach_angle;
    wedge.slopes = vec2(farthest < 0.5 * TWO_PI - 0.02 ? slope(farthest) : -UNBOUNDED,
                        nearest > 0.02 ? slope(nearest) : UNBOUNDED);
    // Beyond the slopes of all rays, chords across the angles included.
    wedge.slopes += vec2(-1.0, 1.0) * (0.05 + 0.05 * abs(wedge.slopes));
    return wedge;
}

bool dark(vec3 relative) {
    vec3 forward = -volumetrics.inverse_view[2].xyz;
    count_work(WORK_SHADOW_LOOKUPS, 1u);
    return sun_visibility(volumetrics.eye.xyz + relative, dot(relative, forward)) < 0.5;
}

// w of the surface, or where no ray passes: below all of them where the sun reaches everywhere, above them where nowhere.
float surface_height(Wedge wedge, vec3 across, float radius, float first_radius, float bottom) {
    float farthest = volumetrics.max_distance;
    float r = max(radius, first_radius);
    vec2 range = wedge.slopes * r;
    if (radius == 0.0) range = vec2(min(range.x, -0.05 * r), max(range.y, 0.05 * r));  // the eye itself
    float lit = wedge.slopes.x > -0.5 * UNBOUNDED ? range.x : bottom;
    float low = max(range.x, -farthest);
    float high = min(range.y, farthest);
    if (low >= high || !dark(across * radius + wedge.to_sun * low)) return lit;
    if (dark(across * radius + wedge.to_sun * high)) return high;
    for (int i = 0; i < BISECTIONS; ++i) {
        float middle = 0.5 * (low + high);
        if (dark(across * radius + wedge.to_sun * middle))
            low = middle;
        else
            high = middle;
    }
    return high;
}

float grid_radius(int row, int rows) {
    float growth = log(1.0 + volumetrics.max_distance / GROWTH_RADIUS);
    return volumetrics.max_distance * (exp(growth * float(row) / float(rows)) - 1.0) / (exp(growth) - 1.0);
}

void main() {
    ivec2 size = imageSize(shaft_vertices);
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, size))) return;
    int rows = size.y - 3;
    Wedge wedge = screen_wedge();
    int column = wedge.full && cell.x + 1 == size.x ? 0 : cell.x;
    float angle = mix(wedge.angles.x, wedge.angles.y, float(column) / float(size.x - 1));
    vec3 across = cos(angle) * wedge.across + sin(angle) * wedge.along;

    float radius = cell.y > rows + 1 ? 0.0 : grid_radius(min(cell.y, rows), rows);
    float end = grid_radius(rows, rows);
    float bottom = wedge.slopes.x > -0.5 * UNBOUNDED ? min(wedge.slopes.x * end, 0.0) - 0.01 * end : -2.0 * end;
    float w = cell.y > rows ? bottom : surface_height(wedge, across, radius, grid_radius(1, rows), bottom);
    imageStore(shaft_vertices, cell, vec4(across * radius + wedge.to_sun * w, 0.0));
    flush_work();
}
