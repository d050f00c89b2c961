// What the scenes are put together from. Metres, +Y up; angles in degrees.
#pragma once

#include "tools/bench_scenes/scenes.h"
#include "tools/modeling/media.h"
#include "tools/modeling/shapes.h"

namespace tyndall::bench_scenes {

// Untextured and matt: what a picture shows is light.
inline constexpr Surface kGround{0}, kStone{1}, kPlaster{2}, kWood{3}, kClay{4}, kDark{5}, kMoss{6};

// Unit direction towards a point of the sky; azimuth 0 is -Z, 90 is -X (as a camera's yaw).
vec3 sky_direction(float elevation, float azimuth);

// `exposure` in EV100.
Scene empty_scene(const char* name, float exposure);
void add_view(Scene& scene, vec3 eye, vec3 target, float yfov = 55.0f, const char* name = "view");
void add_sun(Scene& scene, vec3 to_sun, float lux, vec3 color = {1.0f, 0.9f, 0.75f});

struct Lamp {
    vec3 position{0.0f};
    float candela = 100.0f;
    vec3 color{1.0f, 0.75f, 0.45f};
    bool shadow = true;
    float range = 0.0f;    // 0: without end
    float radius = 0.03f;  // inverse squares are clamped at this distance
};
int add_point(Scene& scene, const Lamp& lamp);
// Half angles of the cone; the inner one is where the light begins to fade.
int add_spot(Scene& scene, const Lamp& lamp, vec3 target, float inner, float outer);

// A square of ground about the origin, top at y = 0.
void add_ground(Scene& scene, float half_width, Surface surface = kGround);
// Upright bars of square section between two points of the ground, the first at `a`, the last at or before `b`.
void bars(Mesh& mesh, Surface surface, vec3 a, vec3 b, float width, float pitch, float height);

}  // namespace tyndall::bench_scenes
