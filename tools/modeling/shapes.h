// Solids that the buildings are put together from. Everything is closed unless a comment says otherwise.
#pragma once

#include <functional>

#include "tools/modeling/mesh.h"

namespace tyndall::modeling {

// Faces to leave out of a box where another solid hides them.
enum Face : unsigned { kNoFace = 0, kLeft = 1, kRight = 2, kBottom = 4, kTop = 8, kBack = 16, kFront = 32 };

void box(Mesh& mesh, Surface surface, vec3 low, vec3 high, unsigned skip = kNoFace);
// Box with all edges cut at 45 degrees, `cut` metres back from each edge.
void chamfered_box(Mesh& mesh, Surface surface, vec3 low, vec3 high, float cut);
// Rectangular beam from a to b; the texture's grain (v) runs along it. `up` fixes the roll.
// Without `ends` the two end faces are left out.
void beam(Mesh& mesh, Surface surface, vec3 a, vec3 b, float width, float height, vec3 up = vec3(0, 1, 0),
          bool ends = true);
// Convex polygon, counter-clockwise seen from the side that `depth` points away to; the solid reaches `depth`
// behind.
void extrude(Mesh& mesh, Surface surface, std::span<const vec3> front, vec3 depth);

// Surface of revolution about the local +Y axis at `base`; profile points are (radius, height), from bottom to top.
// Neighbouring segments are smoothed where they meet at less than 40 degrees. Ends are left open where radius > 0.
void lathe(Mesh& mesh, Surface surface, vec3 base, std::span<const vec2> profile, int segments, float turn = 0.0f);

// Convex or star-shaped section (x right, y up; counter-clockwise seen against the travel) swept along `path`.
// Flat-shaded. Closed ends unless `loop`.
void sweep(Mesh& mesh, Surface surface, std::span<const vec3> path, std::span<const vec2> section, vec3 up,
           bool loop = false);
std::vector<vec2> rectangle_section(float width, float height);
std::vector<vec2> chamfered_section(float width, float height, float cut);

// Round tube with a radius per point, smooth, tapering; both ends closed only by taper or by what they run into.
void tube(Mesh& mesh, Surface surface, std::span<const vec3> path, std::span<const float> radii, int segments);

// Ridge roof over a rectangle: the ridge runs from a to b (both at ridge height), eaves lie `half_width` to either
// side at eave height, `thickness` is measured upright. The slab is closed.
void gable_roof(Mesh& mesh, Surface surface, Surface under, vec3 a, vec3 b, float half_width, float eave_y,
                float thickness);
// Pyramid or spire with `sides` flat sides on the axis through `centre`; open below.
void spire(Mesh& mesh, Surface surface, vec3 centre, float radius, float height, int sides);
// Sloping slab on four corners of its top (counter-clockwise from above).
void slab(Mesh& mesh, Surface surface, vec3 a, vec3 b, vec3 c, vec3 d, float thickness, Surface under);
// `count` steps climbing from `foot` in horizontal direction `along`, solid down to `floor_y`.
void steps(Mesh& mesh, Surface surface, vec3 foot, vec3 along, float width, int count, float rise, float run,
           float floor_y);

mat4 place(vec3 position, float yaw_degrees = 0.0f, float scale = 1.0f);

}  // namespace tyndall::modeling
