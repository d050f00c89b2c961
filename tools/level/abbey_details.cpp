// Facade, great west window, towers, furnishing and the stair passage of the abbey church.
#include <algorithm>

#include "tools/level/parts.h"
#include "tools/level/stained_glass.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

// Points of an arc in the plane x = const; angles in degrees from +Z, counter-clockwise seen from +X... to +Y.
std::vector<vec3> arc(float x, float cy, float cz, float radius, float from, float to, int segments) {
    std::vector<vec3> path;
    for (int i = 0; i <= segments; ++i) {
        const float a = (from + (to - from) * static_cast<float>(i) / static_cast<float>(segments)) * kPi / 180.0f;
        path.emplace_back(x, cy + radius * sine(a), cz + radius * cosine(a));
    }
    return path;
}

void ring(Mesh& m, float x, float cy, float cz, float radius, int segments, const std::vector<vec2>& section) {
    auto path = arc(x, cy, cz, radius, 0.0f, 360.0f, segments);
    path.pop_back();
    sweep(m, Mat::Trim, path, section, {1, 0, 0}, true);
}

constexpr float kWest = -44.7f;
Wall west_wall() {
    return {{kWest, 0, 5.05f}, {0, 0, -1}, 10.1f, 15.0f, 1.1f, {}};
}
Opening west_opening() {
    return pointed_opening(5.05f, 6.2f, 3.0f, 8.4f, 9, 0.9f);
}

Wall aisle_end(float s) {
    return {{kWest + 0.05f, 0, s > 0 ? 9.95f : -4.9f}, {0, 0, -1}, 5.05f, 7.0f, 0.9f, {}};
}
Opening aisle_end_window() {
    return pointed_opening(2.5f, 1.7f, 1.9f, 4.4f, 5);
}

void west_window(Mesh& m) {
    const float x = kWest;
    Wall w = west_wall();
    w.top = [](float u) { return 14.9f + std::max(0.0f, 5.05f - std::abs(u - 5.05f)) * 1.28f; };
    w.openings = {west_opening()};
    wall(m, Mat::Ashlar, w);
    for (const float side : {1.0f, -1.0f}) {
        archivolt(m, Mat::Trim, w, w.openings[0], 0.5f, 0.10f, side);
        archivolt(m, Mat::Trim, w, w.openings[0], 0.28f, 0.20f, side, 0.03f);
    }
    chamfered_box(m, Mat::Trim, {x - 0.75f, 2.75f, -3.4f}, {x + 0.8f, 3.04f, 3.4f}, 0.08f);
    // Tracery: three mullions, four lights, two sub-arches and a wheel.
    const auto thick = chamfered_section(0.24f, 0.34f, 0.08f), thin = chamfered_section(0.15f, 0.24f, 0.05f);
    sweep(m, Mat::Trim, std::array{vec3(x, 2.9f, 0), vec3(x, 9.3f, 0)}, thick, {1, 0, 0});
    for (const float z : {-1.55f, 1.55f})
        sweep(m, Mat::Trim, std::array{vec3(x, 2.9f, z), vec3(x, 8.6f, z)}, thin, {1, 0, 0});
    for (const float c : {-1.55f, 1.55f}) {
        sweep(m, Mat::Trim, arc(x, 8.0f, c - 1.35f, 2.85f, 0, 60, 6), thick, {1, 0, 0});
        sweep(m, Mat::Trim, arc(x, 8.0f, c + 1.35f, 2.85f, 180, 120, 6), thick, {1, 0, 0});
        for (const float d : {-0.76f, 0.76f}) {
            sweep(m, Mat::Trim, arc(x, 7.3f, c + d - 0.64f, 1.38f, 0, 60, 4), thin, {1, 0, 0});
            sweep(m, Mat::Trim, arc(x, 7.3f, c + d + 0.64f, 1.38f, 180, 120, 4), thin, {1, 0, 0});
        }
        ring(m, x, 9.15f, c, 0.55f, 10, thin);
    }
    ring(m, x, 11.55f, 0, 1.35f, 18, thick);
    ring(m, x, 11.55f, 0, 0.38f, 10, thin);
    for (int i = 0; i < 6; ++i) {
        const float a = static_cast<float>(i) * kPi / 3.0f + 0.5f;
        sweep(m, Mat::Trim,
              std::array{vec3(x, 11.55f + 0.36f * sine(a), 0.36f * cosine(a)),
                         vec3(x, 11.55f + 1.3f * sine(a), 1.3f * cosine(a))},
              thin, {1, 0, 0});
    }
    // Ends of the aisles.
    for (const float s : {-1.0f, 1.0f}) {
        Wall end = aisle_end(s);
        end.openings = {aisle_end_window()};
        end.top = [=](float u) { return s > 0 ? 6.75f + u * 0.5f : 9.25f - u * 0.5f; };
        wall(m, Mat::Ashlar, end);
        for (const float side : {1.0f, -1.0f}) archivolt(m, Mat::Trim, end, end.openings[0], 0.24f, 0.08f, side);
        chamfered_box(m, Mat::Ashlar, {x - 1.5f, -8.0f, s * 5.2f - 0.75f}, {x + 0.3f, 12.5f, s * 5.2f + 0.75f},
                      0.12f);
        spire(m, Mat::Trim, {x - 0.6f, 12.45f, s * 5.2f}, 0.95f, 3.4f, 4);
    }
}

void facade(Mesh& m) {
    Wall low{{0, 0, 5.3f}, {0, 0, -1}, 10.6f, 7.0f, 1.2f, {}};
    low.openings = {pointed_opening(5.3f, 3.2f, 0.0f, 3.1f, 7)};
    wall(m, Mat::Ashlar, low);
    archivolt(m, Mat::Trim, low, low.openings[0], 1.25f, 0.14f, 1, 0.02f);
    archivolt(m, Mat::Trim, low, low.openings[0], 0.95f, 0.28f, 1, 0.03f);
    archivolt(m, Mat::Trim, low, low.openings[0], 0.62f, 0.42f, 1, 0.04f);
    archivolt(m, Mat::Trim, low, low.openings[0], 0.30f, 0.56f, 1, 0.05f);
    archivolt(m, Mat::Trim, low, low.openings[0], 0.40f, 0.10f, -1);
    for (const float s : {-1.0f, 1.0f}) {
        for (int i = 0; i < 3; ++i) {
            const float t = static_cast<float>(i);
            const std::array<vec2, 10> p{{{0.20f, 0.0f},
                                          {0.20f, 0.16f},
                                          {0.13f, 0.22f},
                                          {0.15f, 0.30f},
                                          {0.10f, 0.36f},
                                          {0.10f, 2.66f},
                                          {0.14f, 2.70f},
                                          {0.11f, 2.74f},
                                          {0.21f, 3.06f},
                                          {0.0f, 3.07f}}};
            lathe(m, Mat::Trim, {1.28f - 0.14f * t, 0.0f, s * (1.78f + 0.33f * t)}, p, 10);
        }
    }
    Wall high{{0, 7.0f, 5.3f}, {0, 0, -1}, 10.6f, 8.0f, 1.1f, {}};
    high.top = [](float u) { return 8.0f + std::max(0.0f, 5.3f - std::abs(u - 5.3f)) * 1.32f; };
    high.openings = {circle_opening(5.3f, 4.0f, 2.75f, 16)};
    wall(m, Mat::Ashlar, high);
    archivolt(m, Mat::Trim, high, high.openings[0], 0.55f, 0.14f, 1, 0.02f);
    archivolt(m, Mat::Trim, high, high.openings[0], 0.30f, 0.26f, 1, 0.03f);
    archivolt(m, Mat::Trim, high, high.openings[0], 0.30f, 0.10f, -1);
    const auto thick = chamfered_section(0.24f, 0.34f, 0.08f), thin = chamfered_section(0.15f, 0.24f, 0.05f);
    ring(m, 0, 11.0f, 0, 0.62f, 16, thick);
    ring(m, 0, 11.0f, 0, 1.75f, 24, thin);
    for (int i = 0; i < 12; ++i) {
        const float a = static_cast<float>(i) * kPi / 6.0f, c = a + kPi / 12.0f;
        sweep(m, Mat::Trim,
              std::array{vec3(0, 11.0f + 0.6f * sine(a), 0.6f * cosine(a)),
                         vec3(0, 11.0f + 2.75f * sine(a), 2.75f * cosine(a))},
              thin, {1, 0, 0});
        ring(m, 0, 11.0f + 2.24f * sine(c), 2.24f * cosine(c), 0.40f, 8, thin);
    }
    sweep(m, Mat::Trim, std::array{vec3(0.58f, 7.05f, 5.3f), vec3(0.58f, 7.05f, -5.3f)},
          chamfered_section(0.36f, 0.30f, 0.10f), {0, 1, 0});
    for (const float s : {-1.0f, 1.0f}) {  // coping of the gable
        beam(m, Mat::Trim, {0, 15.0f, s * 5.5f}, {0, 22.1f, 0}, s > 0 ? 1.3f : 1.27f, 0.26f);
        Wall end{{-0.05f, 0, s > 0 ? 10.2f : -5.2f}, {0, 0, -1}, 5.0f, 9.4f, 1.0f, {}};
        wall(m, Mat::Ashlar, end);
    }
    chamfered_box(m, Mat::Trim, {-0.2f, 21.9f, -0.2f}, {0.2f, 22.6f, 0.2f}, 0.05f);
    beam(m, Mat::Trim, {0, 22.5f, 0}, {0, 24.0f, 0}, 0.16f, 0.16f);
    beam(m, Mat::Trim, {0, 23.3f, -0.55f}, {0, 23.3f, 0.55f}, 0.15f, 0.15f);
}

// Four walls round a square shaft with its north-east corner region; openings high up.
void tower_walls(Mesh& m, vec3 c, float half, float low, float high, const std::vector<Opening>& openings,
                 std::function<float(float)> top = {}) {
    for (int i = 0; i < 4; ++i) {
        const vec3 along[4]{{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, 1}};
        const vec3 out = glm::cross(along[i], vec3(0, 1, 0));
        // Opposite walls run the full side, the others fit between them.
        const float length = i % 2 ? 2 * half - 1.8f : 2 * half;
        Wall w{c + out * (half - 0.45f) - along[i] * (length / 2) + vec3(0, low, 0),
               along[i],
               length,
               high - low,
               0.9f,
               openings,
               top,
               0.7f};
        for (Opening& o : w.openings) {
            for (float& u : o.us) u += length / 2;
        }
        wall(m, Mat::Ashlar, w);
        for (const Opening& o : w.openings) archivolt(m, Mat::Trim, w, o, 0.24f, 0.10f, 1);
    }
}

void bell_tower(Mesh& m) {
    const vec3 c(-3.4f, 0, -13.9f);
    const float half = 3.8f;
    tower_walls(m, c, half, -6.0f, 13.0f, {pointed_opening(0, 0.7f, 13.0f, 15.0f, 3)});
    tower_walls(m, c, half - 0.25f, 13.0f, 22.0f, {pointed_opening(0, 0.7f, 3.0f, 5.0f, 3)});
    tower_walls(m, c, half - 0.4f, 22.0f, 31.0f,
                {pointed_opening(-1.15f, 1.4f, 1.6f, 4.8f, 5), pointed_opening(1.15f, 1.4f, 1.6f, 4.8f, 5)});
    auto band = [&](float y, float r, float h) {
        chamfered_box(m, Mat::Trim, {c.x - r, y, c.z - r}, {c.x + r, y + h, c.z + r}, 0.1f);
    };
    band(12.8f, half + 0.14f, 0.4f);
    band(21.8f, half - 0.10f, 0.4f);
    band(30.9f, half - 0.2f, 0.5f);
    for (const float x : {-1.0f, 1.0f}) {
        for (const float z : {-1.0f, 1.0f}) {
            const vec3 corner = c + vec3(x * (half - 0.1f), 0, z * (half - 0.1f));
            chamfered_box(m, Mat::Ashlar, corner + vec3(-0.75f, -6.0f, -0.75f), corner + vec3(0.75f, 20.0f, 0.75f),
                          0.12f);
            spire(m, Mat::Trim, corner + vec3(0, 19.95f, 0), 1.05f, 1.7f, 4);
            const vec3 top = c + vec3(x * (half - 0.75f), 31.2f, z * (half - 0.75f));
            chamfered_box(m, Mat::Trim, top + vec3(-0.38f, 0, -0.38f), top + vec3(0.38f, 1.4f, 0.38f), 0.06f);
            spire(m, Mat::Trim, top + vec3(0, 1.38f, 0), 0.58f, 2.2f, 4);
        }
    }
    spire(m, Mat::Slate, c + vec3(0, 31.35f, 0), 4.1f, 15.0f, 8);
    beam(m, Mat::Iron, c + vec3(0, 46.0f, 0), c + vec3(0, 48.4f, 0), 0.10f, 0.10f);
    beam(m, Mat::Iron, c + vec3(0, 47.4f, -0.5f), c + vec3(0, 47.4f, 0.5f), 0.09f, 0.09f);
    const std::array<vec2, 7> bell{{{0.78f, 0.0f},
                                    {0.70f, 0.12f},
                                    {0.52f, 0.45f},
                                    {0.44f, 0.85f},
                                    {0.30f, 1.05f},
                                    {0.10f, 1.12f},
                                    {0.0f, 1.12f}}};
    lathe(m, Mat::Iron, c + vec3(0, 25.0f, 0), bell, 14);
    beam(m, Mat::Timber, c + vec3(-3.0f, 26.25f, 0), c + vec3(3.0f, 26.25f, 0), 0.3f, 0.35f);
}

void broken_tower(Mesh& m) {
    tower_walls(m, {-3.4f, 0, 14.0f}, 3.8f, -6.0f, 10.0f, {pointed_opening(0, 0.8f, 9.0f, 11.0f, 3)}, [](float u) {
        const float ends = std::min(u, 6.6f - u) < 1.0f ? 0.25f : 1.0f;
        return 16.2f - ends * 3.4f * fractal_noise(vec2(u * 0.7f, 2.0f), {0, 0}, 3, 51);
    });
}

// From the door in the south aisle down fifteen steps and out into the court.
void passage(Mesh& m) {
    steps(m, Mat::Flags, {-19.6f, -3.0f, 11.2f}, {1, 0, 0}, 2.6f, 15, 0.2f, 0.32f, -5.0f);

    m.quad(Mat::Flags, {-14.8f, 0, 12.5f}, {-12.3f, 0, 12.5f}, {-12.3f, 0, 9.7f}, {-14.8f, 0, 9.7f});
    Wall south{{-24.6f, -6.0f, 12.7f}, {1, 0, 0}, 12.8f, 9.88f, 0.6f, {}};
    south.openings = {pointed_opening(2.2f, 1.4f, 2.95f, 4.9f, 5), pointed_opening(7.2f, 0.5f, 4.6f, 5.6f, 3),
                      pointed_opening(10.9f, 0.55f, 6.9f, 8.0f, 3)};
    wall(m, Mat::Rubble, south);
    for (const float side : {1.0f, -1.0f}) archivolt(m, Mat::Trim, south, south.openings[0], 0.26f, 0.08f, side);
    for (size_t i = 1; i < 3; ++i) archivolt(m, Mat::Trim, south, south.openings[i], 0.16f, 0.05f, 1);
    for (const float x : {-24.0f, -11.8f}) {
        extrude(m, Mat::Rubble,
                std::array{vec3(x, -6.0f, 12.45f), vec3(x, -6.0f, 9.95f), vec3(x, 4.70f, 9.95f),
                           vec3(x, 3.92f, 12.45f)},
                {-0.55f, 0, 0});
    }
    slab(m, Mat::Slate, {-24.9f, 3.95f, 13.4f}, {-11.5f, 3.95f, 13.4f}, {-11.5f, 5.1f, 9.88f},
         {-24.9f, 5.1f, 9.88f}, 0.24f, Mat::Planks);
    // Barrel vault that follows the stair, seen from below only.
    const std::array<vec2, 4> springing{{{-12.3f, 2.4f}, {-14.9f, 2.4f}, {-19.5f, -0.6f}, {-24.05f, -0.6f}}};
    std::vector<Vertex> v;
    const int segments = 10;
    for (int s = 0; s <= segments; ++s) {
        const float a = kPi * static_cast<float>(s) / segments;
        for (const vec2 p : springing) {
            const vec3 n(0, -sine(a), -cosine(a));
            v.push_back({{p.x, p.y + 1.27f * sine(a), 11.15f + 1.27f * cosine(a)},
                         n,
                         vec2(p.x, -1.27f * a) / Mat::Rubble.tile_metres});
        }
    }
    m.grid(Mat::Rubble, segments + 1, 4, v);
    for (const vec2 p : {vec2(-19.9f, -0.6f), vec2(-14.75f, 2.4f)}) {  // stone ribs under the vault
        std::vector<vec3> rib{{p.x, p.y - 2.4f, 11.15f + 1.20f}};
        for (int s = 0; s <= segments; ++s) {
            const float a = kPi * static_cast<float>(s) / segments;
            rib.emplace_back(p.x, p.y + 1.20f * sine(a), 11.15f + 1.20f * cosine(a));
        }
        rib.emplace_back(p.x, p.y - 2.4f, 11.15f - 1.20f);
        sweep(m, Mat::Trim, rib, chamfered_section(0.30f, 0.22f, 0.06f), {1, 0, 0});
    }
    // Niche on the end wall with a shelf.
    chamfered_box(m, Mat::Trim, {-24.1f, -2.25f, 10.75f}, {-23.68f, -2.12f, 11.75f}, 0.03f);
    beam(m, Mat::Timber, {-24.1f, -2.4f, 11.0f}, {-23.75f, -2.4f, 11.0f}, 0.1f, 0.25f);
    beam(m, Mat::Timber, {-24.1f, -2.4f, 11.5f}, {-23.75f, -2.4f, 11.5f}, 0.1f, 0.25f);
}

void furnish(Level& level, const Lamps& lamps, const Props& props) {
    Mesh m{"abbey_furniture", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-41.6f, 0.5f, -1.5f}, {-40.4f, 1.5f, 1.5f}, 0.05f);  // altar
    chamfered_box(m, Mat::Trim, {-41.75f, 1.48f, -1.75f}, {-40.25f, 1.66f, 1.75f}, 0.05f);
    // Font in the crossing: octagonal basin with water.
    chamfered_box(m, Mat::Trim, {-24.1f, -0.1f, -1.35f}, {-21.4f, 0.16f, 1.35f}, 0.05f);
    const std::array<vec2, 10> font{{{0.95f, 0.15f},
                                     {0.95f, 0.30f},
                                     {0.45f, 0.46f},
                                     {0.42f, 0.66f},
                                     {0.80f, 0.92f},
                                     {1.02f, 1.00f},
                                     {1.02f, 1.16f},
                                     {0.88f, 1.16f},
                                     {0.82f, 1.02f},
                                     {0.82f, 1.0f}}};
    lathe(m, Mat::Trim, {-22.75f, 0, 0}, font, 16);
    const std::array<vec2, 2> pool{{{0.84f, 1.06f}, {0.0f, 1.06f}}};
    lathe(m, Mat::Water, {-22.75f, 0, 0}, pool, 16);
    Random random(61);
    for (int i = 0; i < 34; ++i) {  // what fell from the open bays
        const float x = random.range(-26.5f, -17.0f), z = (i % 3 ? 1.0f : -1.0f) * random.range(2.9f, 8.3f);
        level.add_instance("fallen_block", props.block, {x, random.range(-0.12f, 0.0f), z}, random.range(0, 360),
                           random.range(0.45f, 1.15f));
        if (i % 3 == 0)
            level.add_instance("shrub", props.tuft, {x + 0.6f, 0, z}, random.range(0, 360),
                               random.range(0.5f, 1.1f));
    }
    level.add_static(std::move(m));
    for (const float s : {-1.0f, 1.0f}) {
        for (int i = 0; i < 4; ++i)
            candle_stand(level, lamps,
                         {-38.2f + 0.9f * static_cast<float>(i), i < 2 ? 0.54f : (i == 2 ? 0.18f : 0.0f),
                          s * (2.2f + 0.5f * static_cast<float>(i))},
                         45.0f);
        brazier(level, lamps, {-29.6f, 0, s * 2.6f}, 320.0f);
        for (const int bay : {1, 2, 5, 6, 7}) {  // lanterns on the piers, towards the nave
            wall_lantern(level, lamps, {-5.5f * static_cast<float>(bay), 3.2f, s * (4.6f - 0.74f)},
                         s < 0 ? 0.0f : 180.0f, 200.0f);
        }
        for (const int bay : {1, 3, 5, 7}) {  // and in the aisles
            wall_lantern(level, lamps, {-5.5f * static_cast<float>(bay), 3.0f, s * 9.1f}, s < 0 ? 0.0f : 180.0f,
                         150.0f);
        }
        level.add_instance("ivy", props.ivy, {-17.6f, 0, s * 4.12f}, s < 0 ? 0.0f : 180.0f, 1.1f);
        level.add_instance("ivy", props.ivy, {-24.0f, 8.2f, s * 4.1f}, s < 0 ? 0.0f : 180.0f, 0.9f);
        level.add_instance("bench", props.bench, {-9.0f, 0, s * 2.5f}, 90.0f);
        level.add_instance("bench", props.bench, {-11.6f, 0, s * 2.5f}, 90.0f);
    }
    // Chandelier lanterns under the two roofed bays.
    Mesh chains{"chains", {}, mat4(1.0f)};
    for (const float x : {-8.25f, -35.75f}) {
        for (const float z : {-1.6f, 1.6f}) {
            beam(chains, Mat::Iron, {x, 5.4f, z}, {x, 17.4f, z}, 0.03f, 0.03f);
            hang_lantern(level, lamps, {x, 5.42f, z}, 160.0f);
        }
    }
    level.add_static(std::move(chains));
    // Passage.
    wall_lantern(level, lamps, {-23.98f, -0.95f, 11.2f}, 90.0f, 110.0f);
    wall_lantern(level, lamps, {-17.3f, 0.55f, 12.38f}, 180.0f, 45.0f);
    wall_lantern(level, lamps, {-12.38f, 2.0f, 11.2f}, -90.0f, 60.0f);
    level.add_instance("barrel", props.barrel, {-23.5f, -3.0f, 10.72f}, 20.0f);
    level.add_instance("barrel", props.barrel, {-22.75f, -3.0f, 10.70f}, 75.0f, 0.95f);
    level.add_instance("crate", props.crate, {-20.9f, -3.0f, 10.75f}, 12.0f, 0.9f);
    candle_stand(level, lamps, {-23.55f, -3.0f, 12.05f}, 70.0f);
}

}  // namespace

void add_abbey_details(Level& level, const Lamps& lamps, const Props& props) {
    auto built = [&](const std::string& name, auto&& build) {
        Mesh m{name, {}, mat4(1.0f)};
        build(m);
        level.add_static(std::move(m));
    };
    built("west_window", west_window);
    using enum StainedGlass;
    const auto glaze = [&](const Wall& w, const Opening& opening, std::span<const StainedGlass> lights) {
        add_stained_window(level, level.add_mesh(stained_window("stained_west_window", w, opening, lights)),
                           vec3(0), 0);
    };
    glaze(west_wall(), west_opening(), std::array{Cobalt, Ruby, Amber, Cobalt});
    glaze(aisle_end(1), aisle_end_window(), std::array{Ruby});
    glaze(aisle_end(-1), aisle_end_window(), std::array{Cobalt});
    built("facade", facade);
    built("bell_tower", bell_tower);
    built("broken_tower", broken_tower);
    built("passage", passage);
    furnish(level, lamps, props);
    hang_lantern(level, lamps, {-1.4f, 26.1f, -13.9f}, 300.0f);
    for (const float z : {-2.75f, 2.75f}) wall_lantern(level, lamps, {0.72f, 3.9f, z * 1.15f}, 90.0f, 160.0f);
}

}  // namespace tyndall::level
