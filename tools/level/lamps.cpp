#include <algorithm>

#include "tools/level/parts.h"
#include "tools/modeling/random.h"
#include "tools/modeling/shapes.h"

namespace tyndall::level {

namespace {

constexpr vec3 kFlame{1.0f, 0.60f, 0.30f};

// Distance at which the lamp gives less than about 0.8 lx, within what clustering likes.
float range_for(float candela) {
    return std::clamp(std::sqrt(candela / 0.8f), 4.0f, 12.0f);
}

Mesh lantern_mesh() {  // hangs from the origin, 0.62 m down
    Mesh m{"lantern", {}, mat4(1.0f)};
    const std::array<vec2, 2> ring{{{0.02f, -0.14f}, {0.008f, 0.0f}}};
    lathe(m, Mat::Iron, vec3(0), ring, 3);
    const std::array<vec2, 3> cap{{{0.10f, -0.265f}, {0.19f, -0.245f}, {0.015f, -0.12f}}};
    lathe(m, Mat::Iron, vec3(0), cap, 6);
    const std::array<vec2, 2> glass{{{0.085f, -0.56f}, {0.125f, -0.26f}}};
    lathe(m, Mat::Lantern, vec3(0), glass, 6);
    const std::array<vec2, 2> foot{{{0.0f, -0.63f}, {0.11f, -0.55f}}};
    lathe(m, Mat::Iron, vec3(0), foot, 6);
    for (int i = 0; i < 3; ++i) {
        const float a = 2.0f * kPi * static_cast<float>(i) / 3.0f;
        const vec3 d(cosine(a), 0, sine(a));
        beam(m, Mat::Iron, d * 0.095f + vec3(0, -0.56f, 0), d * 0.137f + vec3(0, -0.24f, 0), 0.016f, 0.016f,
             {0, 1, 0}, false);
    }
    return m;
}

Mesh paper_mesh(const std::string& name, Mat paper) {  // hangs from the origin, 0.56 m down
    Mesh m{name, {}, mat4(1.0f)};
    const std::array<vec2, 3> top{{{0.09f, -0.12f}, {0.07f, -0.08f}, {0.006f, 0.0f}}};
    lathe(m, Mat::Iron, vec3(0), top, 5);
    const std::array<vec2, 5> body{
        {{0.07f, -0.50f}, {0.16f, -0.43f}, {0.20f, -0.31f}, {0.16f, -0.19f}, {0.07f, -0.12f}}};
    lathe(m, paper, vec3(0), body, 7);
    const std::array<vec2, 2> foot{{{0.02f, -0.57f}, {0.075f, -0.49f}}};
    lathe(m, Mat::Iron, vec3(0), foot, 5);
    return m;
}

Mesh bracket_mesh() {  // from the wall at the origin, arm along +Z
    Mesh m{"bracket", {}, mat4(1.0f)};
    box(m, Mat::Iron, {-0.05f, -0.42f, -0.04f}, {0.05f, 0.10f, 0.03f}, kBack);
    beam(m, Mat::Iron, {0, 0, 0}, {0, 0.02f, 0.62f}, 0.035f, 0.035f);
    const std::array<vec3, 5> curl{
        {{0, -0.36f, 0.02f}, {0, -0.30f, 0.20f}, {0, -0.18f, 0.34f}, {0, -0.06f, 0.42f}, {0, 0.02f, 0.44f}}};
    sweep(m, Mat::Iron, curl, rectangle_section(0.025f, 0.025f), vec3(1, 0, 0));
    return m;
}

Mesh post_mesh() {  // stands at the origin; the crook reaches 0.55 m along +Z at 3.1 m
    Mesh m{"lamp_post", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-0.26f, -0.3f, -0.26f}, {0.26f, 0.34f, 0.26f}, 0.05f);
    const std::array<vec2, 5> pole{{{0.10f, 0.3f}, {0.10f, 0.5f}, {0.055f, 0.6f}, {0.045f, 2.9f}, {0.0f, 2.95f}}};
    lathe(m, Mat::Iron, vec3(0), pole, 8);
    const std::array<vec3, 6> crook{{{0, 2.6f, 0},
                                     {0, 3.02f, 0.03f},
                                     {0, 3.28f, 0.18f},
                                     {0, 3.34f, 0.36f},
                                     {0, 3.24f, 0.50f},
                                     {0, 3.12f, 0.55f}}};
    sweep(m, Mat::Iron, crook, rectangle_section(0.04f, 0.04f), vec3(1, 0, 0));
    return m;
}

Mesh candle_stand_mesh() {
    Mesh m{"candle_stand", {}, mat4(1.0f)};
    const std::array<vec2, 8> p{{{0.24f, 0.0f},
                                 {0.20f, 0.05f},
                                 {0.05f, 0.10f},
                                 {0.035f, 0.9f},
                                 {0.07f, 0.95f},
                                 {0.03f, 1.0f},
                                 {0.20f, 1.12f},
                                 {0.0f, 1.13f}}};
    lathe(m, Mat::Iron, vec3(0), p, 8);
    return m;
}

Mesh candles_mesh() {
    Mesh m{"candles", {}, mat4(1.0f)};
    for (int i = 0; i < 4; ++i) {
        const float a = 1.5708f * static_cast<float>(i) + 0.4f, h = 0.16f + 0.05f * static_cast<float>(i);
        const vec3 foot = vec3(cosine(a), 0, sine(a)) * (i ? 0.11f : 0.0f);
        const std::array<vec2, 3> wax{{{0.035f, 0.0f}, {0.035f, h}, {0.0f, h}}};
        lathe(m, Mat::Plaster, foot, wax, 6);
        const std::array<vec2, 3> flame{{{0.0f, h}, {0.018f, h + 0.03f}, {0.0f, h + 0.09f}}};
        lathe(m, Mat::Lantern, foot, flame, 5);
    }
    return m;
}

Mesh brazier_mesh() {
    Mesh m{"brazier", {}, mat4(1.0f)};
    const std::array<vec2, 6> bowl{
        {{0.0f, 0.62f}, {0.25f, 0.66f}, {0.45f, 0.88f}, {0.50f, 0.98f}, {0.44f, 0.98f}, {0.36f, 0.84f}}};
    lathe(m, Mat::Iron, vec3(0), bowl, 12);
    for (int i = 0; i < 3; ++i) {
        const float a = 2.0f * kPi * static_cast<float>(i) / 3.0f;
        const vec3 d(cosine(a), 0, sine(a));
        beam(m, Mat::Iron, d * 0.48f, d * 0.30f + vec3(0, 0.80f, 0), 0.05f, 0.05f);
    }
    return m;
}

Mesh embers_mesh() {
    Mesh m{"embers", {}, mat4(1.0f)};
    Random random(5);
    for (int i = 0; i < 6; ++i) {
        const float a = random.range(0, 2 * kPi), r = random.range(0.0f, 0.28f);
        m.transform =
            place(vec3(cosine(a) * r, 0.86f + random.range(0.0f, 0.07f), sine(a) * r), random.range(0, 360));
        chamfered_box(m, i % 3 ? Mat::Paper : Mat::Lantern, vec3(-0.13f, -0.05f, -0.10f), vec3(0.13f, 0.07f, 0.10f),
                      0.04f);
    }
    m.transform = mat4(1.0f);
    return m;
}

void lamp(Level& level, vec3 at, float candela, bool shadow, vec3 color = kFlame, float radius = 0.06f) {
    Light light;
    light.name = "lamp_" + std::to_string(level.lights.size());
    light.color = color;
    light.intensity = candela;
    light.range = range_for(candela);
    light.radius = radius;
    light.shadow = shadow;
    level.add_light(light, at);
}

void glowing(Level& level, const std::string& name, int mesh, vec3 at, float yaw) {
    const int node = level.add_instance(name, mesh, at, yaw);
    level.nodes[static_cast<size_t>(node)].cast_shadow = false;
}

}  // namespace

Lamps make_lamps(Level& level) {
    Lamps lamps{};
    lamps.lantern = level.add_mesh(lantern_mesh());
    lamps.paper_red = level.add_mesh(paper_mesh("paper_red", Mat::Paper));
    lamps.paper_ochre = level.add_mesh(paper_mesh("paper_ochre", Mat::Lantern));
    lamps.bracket = level.add_mesh(bracket_mesh());
    lamps.post = level.add_mesh(post_mesh());
    lamps.candles = level.add_mesh(candles_mesh());
    lamps.candle_stand = level.add_mesh(candle_stand_mesh());
    lamps.brazier = level.add_mesh(brazier_mesh());
    lamps.embers = level.add_mesh(embers_mesh());
    return lamps;
}

void hang_lantern(Level& level, const Lamps& lamps, vec3 hook, float candela, float yaw, bool shadow) {
    glowing(level, "lantern", lamps.lantern, hook, yaw);
    lamp(level, hook - vec3(0, 0.41f, 0), candela, shadow);
}

void hang_paper(Level& level, const Lamps& lamps, vec3 hook, float candela, int colour, bool shadow) {
    glowing(level, "paper_lantern", colour ? lamps.paper_red : lamps.paper_ochre, hook, 0.0f);
    lamp(level, hook - vec3(0, 0.31f, 0), candela, shadow, colour ? vec3(1.0f, 0.40f, 0.16f) : kFlame, 0.1f);
}

void wall_lantern(Level& level, const Lamps& lamps, vec3 at, float yaw, float candela, bool shadow) {
    level.add_instance("bracket", lamps.bracket, at, yaw);
    hang_lantern(level, lamps, at + vec3(place(vec3(0), yaw) * vec4(0, -0.005f, 0.58f, 0)), candela, yaw, shadow);
}

void post_lantern(Level& level, const Lamps& lamps, vec3 foot, float yaw, float candela) {
    level.add_instance("lamp_post", lamps.post, foot, yaw);
    hang_lantern(level, lamps, foot + vec3(place(vec3(0), yaw) * vec4(0, 3.12f, 0.55f, 0)), candela, yaw);
}

void floor_lantern(Level& level, const Lamps& lamps, vec3 foot, float candela, bool shadow) {
    hang_lantern(level, lamps, foot + vec3(0, 0.615f, 0), candela, foot.x * 57.0f, shadow);
}

void candle_stand(Level& level, const Lamps& lamps, vec3 foot, float candela) {
    level.add_instance("candle_stand", lamps.candle_stand, foot);
    glowing(level, "candles", lamps.candles, foot + vec3(0, 1.125f, 0), 0.0f);
    lamp(level, foot + vec3(0, 1.46f, 0), candela, true);
}

void brazier(Level& level, const Lamps& lamps, vec3 foot, float candela, bool shadow) {
    level.add_instance("brazier", lamps.brazier, foot);
    glowing(level, "embers", lamps.embers, foot, 0.0f);
    lamp(level, foot + vec3(0, 1.12f, 0), candela, shadow, vec3(1.0f, 0.45f, 0.16f), 0.1f);
}

void add_sun(Level& level) {
    Light sun;
    sun.name = "sun";
    sun.type = Light::Type::Sun;
    sun.color = {1.0f, 0.75f, 0.5f};
    sun.intensity = 450.0f;
    level.add_light(sun, vec3(0), looking_along(vec3(0), -to_sun()).rotation());
}

}  // namespace tyndall::level
