// Walls with real thickness and openings of any outline.
#pragma once

#include "tools/level/materials.h"
#include "tools/modeling/shapes.h"

namespace tyndall::level {

// Outline of an opening over u, the distance along the wall: at us[i] it is open between lower[i] and upper[i].
struct Opening {
    std::vector<float> us, lower, upper;
};
Opening rectangle_opening(float centre, float width, float sill, float head);
// Pointed arch of two arcs, each struck from the far springing (an equilateral arch has sharpness 1).
Opening pointed_opening(float centre, float width, float sill, float spring, int segments = 6,
                        float sharpness = 1.0f);
Opening round_opening(float centre, float width, float sill, float spring, int segments = 6);
Opening circle_opening(float centre, float centre_y, float radius, int segments = 14);

// u = 0 at `origin` and grows along `along` (unit, horizontal); the front faces cross(along, up). `origin` is the
// bottom of the wall's middle plane. `top(u)`, where given, replaces `height` and is sampled every `top_step`
// metres.
struct Wall {
    vec3 origin;
    vec3 along;
    float length, height, thickness;
    std::vector<Opening> openings;  // apart from each other and in growing u
    std::function<float(float)> top{};
    float top_step = 0.8f;
    bool skip_ends = false;
};
void wall(Mesh& mesh, Mat mat, const Wall& wall);

// Moulding round the outline of `opening` on the wall's front (side = 1) or back (side = -1): `width` wide,
// standing `proud` metres out of the wall, set back `inset` from the edge so that no two faces coincide. It is open
// where it meets the wall. Sills are left bare where the outline has jambs; an outline whose lower edge dips is a
// full ring.
void archivolt(Mesh& mesh, Mat mat, const Wall& wall, const Opening& opening, float width, float proud, float side,
               float inset = 0.02f);

// Point of the wall's middle plane.
inline vec3 wall_point(const Wall& w, float u, float y) {
    return w.origin + w.along * u + vec3(0, y, 0);
}

}  // namespace tyndall::level
