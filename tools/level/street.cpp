// The village street that climbs from the gate (east) to the abbey, with its lamps; the square before the portal.
#include <algorithm>

#include "tools/level/parts.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr float kSquare = 14.0f, kGate = 106.0f, kSquareY = -0.6f, kHalfStreet = 4.8f;

float kerb(float x) {
    return street_height(x) + 0.12f;
}

void paving(Level& level) {
    Mesh m{"street_paving", {}, mat4(1.0f)};
    // Carriageway with a central gutter; pavements on both sides, whose kerbs close the gap.
    const std::array<float, 5> z{-3.3f, -1.5f, 0.0f, 1.5f, 3.3f};
    const std::array<float, 5> camber{0.0f, -0.02f, -0.07f, -0.02f, 0.0f};
    const int rows = 24;
    for (int i = 0; i < rows; ++i) {
        const float x0 = kSquare + (kGate + 3.0f - kSquare) * static_cast<float>(i) / rows;
        const float x1 = kSquare + (kGate + 3.0f - kSquare) * static_cast<float>(i + 1) / rows;
        for (size_t k = 0; k + 1 < z.size(); ++k) {
            m.quad(Mat::Cobbles, {x0, street_height(x0) + camber[k + 1], z[k + 1]},
                   {x1, street_height(x1) + camber[k + 1], z[k + 1]}, {x1, street_height(x1) + camber[k], z[k]},
                   {x0, street_height(x0) + camber[k], z[k]});
        }
    }
    for (const float side : {-1.0f, 1.0f}) {
        const float in = side * 3.3f, out = side * 6.4f, x0 = kSquare, x1 = kGate + 3.0f;
        const vec3 a(x0, kerb(x0), in), b(x1, kerb(x1), in), c(x1, kerb(x1), out), d(x0, kerb(x0), out),
            down(0, -0.5f, 0);
        if (side > 0) {
            m.quad(Mat::Flags, d, c, b, a);
            m.quad(Mat::Trim, b + down, a + down, a, b);
        } else {
            m.quad(Mat::Flags, a, b, c, d);
            m.quad(Mat::Trim, a + down, b + down, b, a);
        }
        m.quad(Mat::Trim, side > 0 ? a + down : d + down, side > 0 ? d + down : a + down, side > 0 ? d : a,
               side > 0 ? a : d);
    }
    // The square, flagged, and a gutter step of its own height to the carriageway.
    m.quad(Mat::Flags, {0.62f, kSquareY, 15.0f}, {kSquare, kSquareY, 15.0f}, {kSquare, kSquareY, -15.0f},
           {0.62f, kSquareY, -15.0f});
    m.quad(Mat::Trim, {kSquare, kSquareY - 1.0f, 15.0f}, {kSquare, kSquareY - 1.0f, -15.0f},
           {kSquare, kSquareY, -15.0f}, {kSquare, kSquareY, 15.0f});
    level.add_static(std::move(m));
}

void gate(Level& level, const Lamps& lamps) {
    Mesh m{"town_gate", {}, mat4(1.0f)};
    const float y = street_height(kGate) - 2.0f;
    Wall w{{kGate, y, 9.0f}, {0, 0, -1}, 18.0f, 12.0f, 1.4f, {}};
    w.openings = {round_opening(9.0f, 3.6f, 2.0f, 4.6f, 6)};
    wall(m, Mat::Rubble, w);
    archivolt(m, Mat::Trim, w, w.openings[0], 0.4f, 0.12f, -1);
    // Closed doors: the world ends here.
    m.quad(Mat::Planks, {kGate, y + 1.5f, 2.0f}, {kGate, y + 1.5f, -2.0f}, {kGate, y + 7.0f, -2.0f},
           {kGate, y + 7.0f, 2.0f});
    m.quad(Mat::Planks, {kGate - 0.1f, y + 1.5f, -2.0f}, {kGate - 0.1f, y + 1.5f, 2.0f},
           {kGate - 0.1f, y + 7.0f, 2.0f}, {kGate - 0.1f, y + 7.0f, -2.0f});
    for (float z = -8.75f; z < 9.0f; z += 1.5f) {
        chamfered_box(m, Mat::Rubble, {kGate - 0.68f, y + 11.9f, z - 0.1f}, {kGate + 0.68f, y + 12.9f, z + 0.75f},
                      0.04f);
    }
    gable_roof(m, Mat::Slate, Mat::Planks, {kGate, y + 16.0f, -3.5f}, {kGate, y + 16.0f, 3.5f}, 2.2f, y + 13.6f,
               0.2f);
    for (const float z : {-3.0f, 3.0f})
        beam(m, Mat::Timber, {kGate, y + 11.8f, z}, {kGate, y + 15.9f, z}, 0.3f, 0.3f);
    // Yard walls, from inside the last houses into the gate's wall: nobody slips out between them.
    for (const float z : {-5.6f, 5.6f}) {
        const float from = 98.0f, to = kGate - 0.3f, high = 6.6f;
        wall(m, Mat::Rubble, {{from, y, z}, {1, 0, 0}, to - from, high, 0.6f, {}});
        chamfered_box(m, Mat::Trim, {from, y + high - 0.04f, z - 0.4f}, {to - 0.2f, y + high + 0.2f, z + 0.4f},
                      0.05f);
    }
    level.add_static(std::move(m));
    for (const float z : {-2.6f, 2.6f}) wall_lantern(level, lamps, {kGate - 0.70f, y + 5.4f, z}, -90.0f, 120.0f);
}

void houses(Level& level, const Lamps& lamps, const Props& props) {
    const std::array<HouseStyle, 7> styles{{
        {6.4f, 8.0f, 2, true, Mat::Clay, Mat::Rubble, 11},
        {7.6f, 8.5f, 1, false, Mat::Slate, Mat::Ashlar, 12},
        {6.9f, 8.0f, 2, true, Mat::Slate, Mat::Rubble, 13},
        {8.2f, 8.0f, 2, false, Mat::Clay, Mat::Rubble, 14},
        {6.2f, 9.0f, 1, true, Mat::Clay, Mat::Ashlar, 15},
        {7.2f, 8.0f, 1, true, Mat::Slate, Mat::Rubble, 16},
        {7.4f, 8.0f, 2, false, Mat::Slate, Mat::Rubble, 17},
    }};
    std::array<int, 7> mesh{};
    for (size_t i = 0; i < styles.size(); ++i) mesh[i] = level.add_mesh(make_house(styles[i]));
    const std::array<size_t, 13> north{0, 3, 5, 2, 1, 4, 6, 0, 5, 3, 2, 4, 1},
        south{1, 2, 4, 6, 0, 5, 3, 2, 4, 1, 5, 0, 6};
    Random random(21);
    for (const float side : {-1.0f, 1.0f}) {
        float x = kSquare + 0.4f;
        for (const size_t i : side < 0 ? north : south) {
            const HouseStyle& s = styles[i];
            if (x + s.width > kGate - 0.6f) break;
            const float c = x + s.width / 2, z = side * (kHalfStreet + random.range(0.0f, 0.45f)),
                        y = kerb(x + s.width) + 0.06f;
            level.add_instance("house", mesh[i], {c, y, z}, side < 0 ? 0.0f : 180.0f);
            const float in = side < 0 ? 0.0f : 180.0f;
            // A lantern between door and window, high enough to walk under.
            wall_lantern(level, lamps,
                         {c + random.range(-0.25f, 0.25f), y + 2.72f, z + (side < 0 ? 0.01f : -0.01f)}, in, 110.0f);
            if (random.unit() < 0.6f) {
                const float jetty = 0.32f * static_cast<float>(s.upper_floors);
                level.add_instance("banner", random.unit() < 0.5f ? props.banner_red : props.banner_blue,
                                   {c + random.range(-2.0f, 2.0f),
                                    y + 2.7f + 2.6f * static_cast<float>(s.upper_floors), z - side * jetty},
                                   in);
            }
            for (int k = random.index(3); k > 0; --k) {
                const float px =
                    c + (random.unit() < 0.5f ? -1.0f : 1.0f) * (s.width / 2 - random.range(0.5f, 0.9f));
                level.add_instance("clutter", random.unit() < 0.6f ? props.barrel : props.crate,
                                   {px, kerb(px) - 0.02f, z - side * random.range(0.5f, 0.62f)},
                                   random.range(0, 360), random.range(0.85f, 1.0f));
            }
            x += s.width + 0.02f;
        }
    }
}

void stalls(Level& level, const Lamps& lamps, const Props& props) {
    Random random(22);
    const std::array<int, 3> kinds{props.stall_red, props.stall_blue, props.stall_ochre};
    for (int i = 0; i < 14; ++i) {
        const float side = i % 2 ? 1.0f : -1.0f,
                    x = 22.0f + 5.6f * static_cast<float>(i) + random.range(-0.8f, 0.8f);
        const float y = kerb(x), z = side * 3.45f;
        level.add_instance("stall", kinds[static_cast<size_t>(random.index(3))], {x, y, z},
                           side < 0 ? 0.0f : 180.0f);
        const float in = -side;
        hang_lantern(level, lamps, {x - 0.6f, y + 2.12f, z + in * 0.55f}, 60.0f);
        hang_lantern(level, lamps, {x + 0.7f, y + 2.12f, z + in * 0.55f}, 60.0f);
    }
}

// Ropes across the street; lanterns hang where the rope is.
void strings(Level& level, const Lamps& lamps) {
    Mesh m{"lantern_ropes", {}, mat4(1.0f)};
    Random random(23);
    for (int i = 0; i < 30; ++i) {
        const float x = 17.5f + 2.9f * static_cast<float>(i),
                    base = street_height(x) + 5.3f + random.range(-0.15f, 0.35f);
        const float skew = random.range(-0.9f, 0.9f), sag = random.range(0.8f, 1.2f);
        const float half = kHalfStreet + 0.6f;
        auto at = [&](float t) {  // t in [-1,1]
            return vec3(x + skew * t, base - sag * (1.0f - t * t) + 0.5f * skew * t * 0.2f, half * t);
        };
        std::vector<vec3> path;
        for (int k = 0; k <= 8; ++k) path.push_back(at(-1.0f + 0.25f * static_cast<float>(k)));
        sweep(m, Mat::Timber, path, rectangle_section(0.03f, 0.03f), vec3(0, 1, 0));
        const int count = 5;
        for (int k = 0; k < count; ++k) {
            const float t = (static_cast<float>(k) - 2.0f) / 3.0f + random.range(-0.04f, 0.04f);
            const bool shadow = k % 2 == 0 || i % 3 != 0;
            if (random.unit() < 0.55f) {
                hang_paper(level, lamps, at(t), random.range(40.0f, 60.0f), random.index(2), shadow);
            } else {
                hang_lantern(level, lamps, at(t), random.range(45.0f, 75.0f), random.range(0, 360), shadow);
            }
        }
    }
    level.add_static(std::move(m));
}

void square(Level& level, const Lamps& lamps, const Props& props) {
    Mesh m{"square_walls", {}, mat4(1.0f)};
    // North side closed, south side with the arch to the lower court; the corners of the first houses close the
    // east.
    Wall north{{0.6f, kSquareY - 3.0f, -15.4f}, {1, 0, 0}, 14.2f, 8.2f, 0.8f, {}};
    wall(m, Mat::Rubble, north);
    Wall south{{14.8f, kSquareY - 3.0f, 15.4f}, {-1, 0, 0}, 14.2f, 8.2f, 0.8f, {}};
    south.openings = {pointed_opening(9.8f, 2.4f, 3.0f, 5.1f, 5)};
    wall(m, Mat::Rubble, south);
    for (const float side : {1.0f, -1.0f}) archivolt(m, Mat::Trim, south, south.openings[0], 0.3f, 0.1f, side);
    for (const float side : {-1.0f, 1.0f}) {
        chamfered_box(m, Mat::Trim, {0.4f, 4.55f, side * 15.4f - 0.55f}, {15.0f, 4.85f, side * 15.4f + 0.55f},
                      0.06f);
        Wall east{{14.38f, kSquareY - 3.0f, side > 0 ? 15.8f : -5.0f}, {0, 0, -1}, 10.8f, 8.2f, 0.8f, {}};
        wall(m, Mat::Rubble, east);
        chamfered_box(m, Mat::Trim, {13.85f, 4.58f, side > 0 ? 5.0f : -15.7f},
                      {14.95f, 4.88f, side > 0 ? 15.7f : -5.0f}, 0.06f);
    }
    // Steps to the portal.
    for (int i = 0; i < 4; ++i) {
        const float out = 2.4f - 0.45f * static_cast<float>(i), y = kSquareY + 0.15f * static_cast<float>(i + 1);
        chamfered_box(m, Mat::Trim, {0.2f, kSquareY - 0.3f, -3.4f - out}, {0.65f + out, y, 3.4f + out}, 0.025f);
    }
    level.add_static(std::move(m));
    for (const float z : {-11.0f, -7.2f, 7.2f, 11.0f})
        post_lantern(level, lamps, {10.5f, kSquareY, z}, z < 0 ? 0.0f : 180.0f, 150.0f);
    for (const float z : {-3.2f, 3.2f}) brazier(level, lamps, {4.3f, kSquareY, z * 1.5f}, 260.0f);
    for (int i = 0; i < 4; ++i) {
        for (const float side : {-1.0f, 1.0f}) {
            const float z = side * (2.9f + 0.4f * static_cast<float>(4 - i));
            floor_lantern(
                level, lamps,
                {0.85f + 0.45f * static_cast<float>(3 - i), kSquareY + 0.15f * static_cast<float>(i + 1), z}, 40.0f,
                i % 2 == 0);
        }
    }
    for (const float z : {-12.5f, 12.5f})
        level.add_instance("bench", props.bench, {6.5f, kSquareY, z * 1.12f}, 0.0f);
    for (const float z : {-6.4f, 6.4f}) level.add_instance("urn", props.urn, {13.2f, kSquareY, z}, 0.0f);
}

}  // namespace

float street_height(float x) {
    return -0.72f - 0.058f * (std::max(x, kSquare) - kSquare);
}

void add_street(Level& level, const Lamps& lamps, const Props& props) {
    paving(level);
    gate(level, lamps);
    houses(level, lamps, props);
    stalls(level, lamps, props);
    strings(level, lamps);
    square(level, lamps, props);
}

}  // namespace tyndall::level
