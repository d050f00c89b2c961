// The court south of the church: garth, loggia over the cliff, dormitory, lower yard, and the belvedere.
#include <algorithm>

#include "tools/level/parts.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr float kCourt = -3.0f, kLoggia = -2.85f, kLoggiaBay = 3.95f, kLoggiaStart = 12.6f;
constexpr int kLoggiaBays = 12;

void flat(Mesh& m, Mat mat, float x0, float x1, float z0, float z1, float y) {
    m.quad(mat, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0});
}

void ground(Level& level) {
    Mesh m{"court_ground", {}, mat4(1.0f)};
    flat(m, Mat::Flags, -36.5f, 0, 10.3f, 14.5f, kCourt);
    flat(m, Mat::Flags, -40.4f, -36.5f, 10.3f, 60.0f, kCourt);
    flat(m, Mat::Flags, -4.0f, 0, 14.5f, 58.0f, kCourt);
    flat(m, Mat::Flags, -36.5f, 0, 58.0f, 62.0f, kCourt);
    flat(m, Mat::Flags, -45.4f, -36.5f, 60.0f, 62.0f, kCourt);
    flat(m, Mat::Flags, 0, 12.6f, 15.6f, 27.0f, kCourt);
    flat(m, Mat::Flags, -56.0f, -12.0f, 62.0f, 76.0f, kCourt);
    const int columns = 14, rows = 18;
    std::vector<Vertex> v;
    auto height = [&](float x, float z) {  // flush with the paving at the rim, a gentle mound within
        const float edge = std::min({x + 36.5f, -4.0f - x, z - 14.5f, 58.0f - z});
        return kCourt +
               std::min(1.0f, edge * 0.25f) * (0.10f + 0.30f * fractal_noise(vec2(x, z) * 0.12f, {0, 0}, 3, 81));
    };
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const float x = -36.5f + 32.5f * static_cast<float>(c) / (columns - 1),
                        z = 58.0f - 43.5f * static_cast<float>(r) / (rows - 1);
            const float e = 0.5f, y = r == 0 || c == 0 || r == rows - 1 || c == columns - 1 ? kCourt : height(x, z);
            const vec3 n = glm::normalize(
                vec3(height(x - e, z) - height(x + e, z), 2 * e, height(x, z - e) - height(x, z + e)));
            v.push_back({{x, y, z}, n, vec2(x, z) / Mat::Grass.tile_metres});
        }
    }
    m.grid(Mat::Grass, rows, columns, v);
    // Retaining walls down the cliff.
    box(m, Mat::Rubble, {-45.3f, -24.0f, 10.0f}, {-39.0f, kLoggia - 0.2f, 62.2f}, kBottom);
    box(m, Mat::Rubble, {-56.5f, -34.0f, 61.5f}, {-11.5f, kCourt - 0.05f, 76.5f}, kBottom);
    for (const float x : {-56.3f, -46.0f, -35.0f, -24.0f, -13.5f}) {
        chamfered_box(m, Mat::Rubble, {x - 0.8f, -34.0f, 75.0f}, {x + 0.8f, -6.0f, 78.0f}, 0.3f);
    }
    for (float z = 14.0f; z < 62.0f; z += 7.9f)
        chamfered_box(m, Mat::Rubble, {-47.0f, -24.0f, z - 0.8f}, {-44.0f, -5.0f, z + 0.8f}, 0.3f);
    for (const float z : {62.5f, 69.0f, 75.5f})
        chamfered_box(m, Mat::Rubble, {-58.0f, -34.0f, z - 0.8f}, {-55.0f, -6.0f, z + 0.8f}, 0.3f);
    level.add_static(std::move(m));
}

// One bay of the loggia, floor at y = 0, from z = 0 to the next pier; x = 0 is the west wall, 4 m wide.
Mesh loggia_bay() {
    Mesh m{"loggia_bay", {}, mat4(1.0f)};
    const float length = kLoggiaBay;
    for (const float x : {0.0f, 4.0f}) {
        const bool west = x == 0.0f;
        Wall w{{x, west ? -1.0f : -0.4f, 0}, {0, 0, 1}, length, west ? 5.4f : 4.8f, 0.5f, {}, {}, 0.8f, true};
        const float floor = west ? 1.0f : 0.4f;
        w.openings = {
            round_opening(length / 2, length - 0.9f, west ? floor + 0.95f : floor - 0.05f, floor + 2.35f, 5)};
        wall(m, Mat::Ashlar, w);
        Opening arch = w.openings[0];
        std::ranges::fill(arch.lower, floor + 2.35f);
        archivolt(m, Mat::Trim, w, arch, 0.26f, 0.07f, -1.0f);
        // Pier dressing: plinth, capital, engaged shafts.
        chamfered_box(m, Mat::Trim, {x - 0.36f, -0.4f, -0.54f}, {x + 0.36f, 0.30f, 0.54f}, 0.04f);
        chamfered_box(m, Mat::Trim, {x - 0.34f, 2.22f, -0.53f}, {x + 0.34f, 2.40f, 0.53f}, 0.04f);
        const std::array<vec2, 4> shaft{{{0.15f, 0.3f}, {0.10f, 0.38f}, {0.10f, 2.05f}, {0.19f, 2.23f}}};
        for (const float s : {-0.28f, 0.28f}) lathe(m, Mat::Trim, {x + s, 0, 0}, shaft, 7);
        if (west)
            sweep(m, Mat::Trim, std::array{vec3(x, 0.98f, 0.45f), vec3(x, 0.98f, length - 0.45f)},
                  chamfered_section(0.62f, 0.12f, 0.03f), {0, 1, 0});
        beam(m, Mat::Timber, {x, 4.42f, 0}, {x, 4.42f, length}, 0.34f, 0.18f, {0, 1, 0}, false);
    }
    gable_roof(m, Mat::Clay, Mat::Planks, {2.0f, 6.35f, 0}, {2.0f, 6.35f, length}, 2.95f, 4.15f, 0.2f);
    beam(m, Mat::Clay, {2.0f, 6.36f, 0}, {2.0f, 6.36f, length}, 0.22f, 0.12f);
    beam(m, Mat::Timber, {-0.2f, 4.3f, 0.02f}, {4.2f, 4.3f, 0.02f}, 0.22f, 0.26f);
    beam(m, Mat::Timber, {2.0f, 4.4f, 0.02f}, {2.0f, 6.1f, 0.02f}, 0.18f, 0.18f, {0, 1, 0}, false);
    for (const float z : {0.02f, length / 2}) {
        for (const float s : {-1.0f, 1.0f})
            beam(m, Mat::Timber, {2.0f + s * 2.75f, 4.20f, z}, {2.0f + s * 0.05f, 6.05f, z}, 0.14f, 0.16f,
                 {0, 1, 0}, false);
    }
    return m;
}

void loggia(Level& level, const Lamps& lamps) {
    const int bay = level.add_mesh(loggia_bay());
    const float x = -44.7f;
    for (int i = 0; i < kLoggiaBays; ++i) {
        const float z = kLoggiaStart + kLoggiaBay * static_cast<float>(i);
        level.add_instance("loggia", bay, {x, kLoggia, z});
        if (i > 0) hang_lantern(level, lamps, {x + 2.0f, kLoggia + 4.18f, z + 0.02f}, 110.0f, 30.0f);
    }
    Mesh m{"loggia_ends", {}, mat4(1.0f)};
    const float end = kLoggiaStart + kLoggiaBay * kLoggiaBays;
    flat(m, Mat::Flags, x - 0.25f, x + 4.3f, kLoggiaStart - 0.6f, end + 0.3f, kLoggia);
    box(m, Mat::Trim, {x - 0.3f, kCourt - 0.4f, kLoggiaStart - 0.62f}, {x + 4.32f, kLoggia - 0.02f, end + 0.32f},
        kBottom);
    for (const float z : {kLoggiaStart, end}) {  // gables over the ends
        extrude(m, Mat::Plaster,
                std::array{vec3(x - 0.2f, kLoggia + 4.35f, z + 0.15f), vec3(x + 4.2f, kLoggia + 4.35f, z + 0.15f),
                           vec3(x + 2.0f, kLoggia + 6.1f, z + 0.15f)},
                {0, 0, -0.3f});
    }
    for (const float dx : {0.0f, 4.0f})
        chamfered_box(m, Mat::Ashlar, {x + dx - 0.3f, kCourt - 1.0f, end - 0.46f},
                      {x + dx + 0.3f, kLoggia + 4.35f, end + 0.40f}, 0.05f);
    beam(m, Mat::Timber, {x - 0.3f, kLoggia + 4.3f, end}, {x + 4.3f, kLoggia + 4.3f, end}, 0.26f, 0.26f);
    // The corner between church and loggia.
    chamfered_box(m, Mat::Rubble, {-45.4f, -9.0f, 10.0f}, {-44.6f, -1.6f, kLoggiaStart + 0.1f}, 0.08f);
    level.add_static(std::move(m));
}

void dormitory(Level& level, const Lamps& lamps, const Props& props) {
    Mesh m{"dormitory", {}, mat4(1.0f)};
    Wall front{{0.6f, -6.0f, 26.6f}, {0, 0, 1}, 36.0f, 11.6f, 1.0f, {}};
    for (int i = 0; i < 8; ++i) {
        const float u = 3.0f + 4.25f * static_cast<float>(i);
        front.openings.push_back(i == 4 ? pointed_opening(u, 1.7f, 3.0f, 5.2f, 5)
                                        : pointed_opening(u, 1.3f, 4.4f, 6.6f, 5));
    }
    wall(m, Mat::Ashlar, front);
    for (size_t i = 0; i < front.openings.size(); ++i) {
        archivolt(m, Mat::Trim, front, front.openings[i], 0.24f, 0.10f, 1);
        const float z = 26.6f + 3.0f + 4.25f * static_cast<float>(i);
        const Mat pane = i == 4 ? Mat::Planks : Mat::Window;
        m.quad(pane, {0.72f, -3.2f, z - 0.95f}, {0.72f, -3.2f, z + 0.95f}, {0.72f, 2.6f, z + 0.95f},
               {0.72f, 2.6f, z - 0.95f});
        chamfered_box(m, Mat::Ashlar, {-0.75f, -5.0f, z + 1.72f}, {0.25f, 2.4f, z + 2.52f}, 0.06f);
        spire(m, Mat::Trim, {-0.1f, 2.36f, z + 2.12f}, 0.72f, 1.1f, 4);
    }
    sweep(m, Mat::Trim, std::array{vec3(0.08f, 2.9f, 26.6f), vec3(0.08f, 2.9f, 62.6f)},
          chamfered_section(0.26f, 0.24f, 0.08f), {0, 1, 0});
    box(m, Mat::Rubble, {0.9f, -6.0f, 26.65f}, {9.6f, 5.6f, 62.55f}, kBottom | kTop);
    gable_roof(m, Mat::Slate, Mat::Planks, {4.9f, 11.0f, 26.2f}, {4.9f, 11.0f, 63.0f}, 5.6f, 5.35f, 0.24f);
    beam(m, Mat::Slate, {4.9f, 11.0f, 26.1f}, {4.9f, 11.0f, 63.1f}, 0.3f, 0.16f);
    for (const float z : {26.95f, 62.55f})
        extrude(m, Mat::Rubble, std::array{vec3(0.12f, 5.5f, z), vec3(9.6f, 5.5f, z), vec3(4.9f, 10.7f, z)},
                {0, 0, -0.35f});
    level.add_static(std::move(m));
    for (const float z : {31.7f, 40.2f, 52.95f}) wall_lantern(level, lamps, {0.09f, -0.2f, z}, -90.0f, 140.0f);
    level.add_instance("ivy", props.ivy, {0.08f, -3.0f, 57.2f}, -90.0f, 1.25f);
    level.add_instance("ivy", props.ivy, {0.08f, -3.0f, 36.0f}, -90.0f, 1.1f);
}

void lower_yard(Level& level, const Lamps& lamps, const Props& props) {
    Mesh m{"lower_yard", {}, mat4(1.0f)};
    steps(m, Mat::Flags, {5.0f, kCourt, 19.87f}, {0, 0, -1}, 3.2f, 12, 0.2f, 0.34f, kCourt - 1.0f);
    Wall west{{0.55f, -6.0f, 17.5f}, {0, 0, 1}, 9.3f, 6.6f, 0.8f, {}};
    west.openings = {round_opening(4.6f, 2.8f, 2.95f, 4.7f, 6)};
    wall(m, Mat::Rubble, west);
    for (const float side : {1.0f, -1.0f}) archivolt(m, Mat::Trim, west, west.openings[0], 0.3f, 0.1f, side);
    chamfered_box(m, Mat::Trim, {0.0f, 0.58f, 17.4f}, {1.1f, 0.82f, 26.75f}, 0.06f);
    Wall east{{12.6f, -6.0f, 27.0f}, {0, 0, -1}, 11.4f, 7.6f, 0.8f, {}};
    wall(m, Mat::Rubble, east);
    Wall south{{13.0f, -6.0f, 27.2f}, {-1, 0, 0}, 3.6f, 7.6f, 0.8f, {}};
    wall(m, Mat::Rubble, south);
    for (const float x : {3.15f, 6.85f}) {  // strings of the stair
        extrude(
            m, Mat::Rubble,
            std::array{vec3(x, -3.4f, 20.2f), vec3(x, -3.4f, 15.7f), vec3(x, 0.45f, 15.7f), vec3(x, -1.95f, 20.2f)},
            {-0.32f, 0, 0});
    }
    level.add_static(std::move(m));
    wall_lantern(level, lamps, {12.18f, -0.4f, 22.5f}, -90.0f, 120.0f);
    wall_lantern(level, lamps, {0.13f, -0.1f, 19.4f}, -90.0f, 120.0f);
    level.add_instance("barrel", props.barrel, {11.6f, kCourt, 26.2f}, 0.0f);
    level.add_instance("barrel", props.barrel, {10.8f, kCourt, 26.3f}, 40.0f);
    level.add_instance("crate", props.crate, {11.7f, kCourt, 24.9f}, 10.0f);
}

// The pedestal at `a` is left to a balustrade that ends there when `joined`.
void balustrade(Level& level, Mesh& m, const Props& props, vec3 a, vec3 b, bool joined) {
    const vec3 along = glm::normalize(b - a);
    const float length = glm::length(b - a);
    const int bays = std::max(1, static_cast<int>(std::round(length / 3.6f)));
    const float bay = length / static_cast<float>(bays);
    sweep(m, Mat::Trim, std::array{a + vec3(0, 0.06f, 0), b + vec3(0, 0.06f, 0)},
          chamfered_section(0.40f, 0.20f, 0.03f), {0, 1, 0});
    sweep(m, Mat::Trim, std::array{a + vec3(0, 0.98f, 0), b + vec3(0, 0.98f, 0)},
          chamfered_section(0.38f, 0.16f, 0.04f), {0, 1, 0});
    for (int i = joined ? 1 : 0; i <= bays; ++i) {
        const vec3 p = a + along * bay * static_cast<float>(i);
        chamfered_box(m, Mat::Trim, p + vec3(-0.27f, -0.1f, -0.27f), p + vec3(0.27f, 1.16f, 0.27f), 0.03f);
        chamfered_box(m, Mat::Trim, p + vec3(-0.33f, 1.14f, -0.33f), p + vec3(0.33f, 1.26f, 0.33f), 0.03f);
    }
    for (float t = 0.48f; t < length - 0.3f; t += 0.42f) {
        const float in_bay = t - bay * std::floor(t / bay);
        if (std::min(in_bay, bay - in_bay) > 0.36f)
            level.add_instance("baluster", props.baluster, a + along * t + vec3(0, 0.13f, 0));
    }
}

Mesh column_mesh(const std::string& name, float height) {
    Mesh m{name, {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-0.48f, -0.1f, -0.48f}, {0.48f, 0.22f, 0.48f}, 0.03f);
    const std::array<vec2, 12> p{{{0.44f, 0.2f},
                                  {0.46f, 0.30f},
                                  {0.38f, 0.38f},
                                  {0.40f, 0.46f},
                                  {0.34f, 0.52f},
                                  {0.335f, 2.0f},
                                  {0.28f, height - 0.62f},
                                  {0.32f, height - 0.58f},
                                  {0.29f, height - 0.52f},
                                  {0.30f, height - 0.42f},
                                  {0.44f, height - 0.16f},
                                  {0.0f, height - 0.15f}}};
    lathe(m, Mat::Trim, vec3(0), p, 16);
    chamfered_box(m, Mat::Trim, {-0.46f, height - 0.17f, -0.46f}, {0.46f, height, 0.46f}, 0.03f);
    return m;
}

void belvedere(Level& level, const Lamps& lamps, const Props& props) {
    Mesh m{"belvedere", {}, mat4(1.0f)};
    balustrade(level, m, props, {-55.7f, kCourt, 62.3f}, {-45.7f, kCourt, 62.3f}, true);
    balustrade(level, m, props, {-55.7f, kCourt, 75.7f}, {-55.7f, kCourt, 62.3f}, false);
    Wall south{{-55.7f, kCourt - 0.5f, 75.8f}, {1, 0, 0}, 43.7f, 1.45f, 0.5f, {}};
    wall(m, Mat::Rubble, south);
    chamfered_box(m, Mat::Trim, {-55.3f, kCourt + 0.92f, 75.45f}, {-12.0f, kCourt + 1.08f, 76.15f}, 0.04f);
    Wall east{{-12.0f, kCourt - 1.0f, 62.3f}, {0, 0, 1}, 13.9f, 5.4f, 0.7f, {}};
    wall(m, Mat::Rubble, east);
    Wall north{{-18.0f, kCourt - 1.0f, 62.2f}, {1, 0, 0}, 18.4f, 5.4f, 0.7f, {}};
    north.top = [](float u) {
        return 5.4f -
               2.2f * fractal_noise(vec2(u * 0.4f, 1.0f), {0, 0}, 3, 91) * std::min(1.0f, (18.4f - u) * 0.2f);
    };
    wall(m, Mat::Rubble, north);
    for (const float x : {-36.0f, -18.6f}) {  // gate piers between court and terrace
        chamfered_box(m, Mat::Trim, {x - 0.55f, kCourt - 0.1f, 61.6f}, {x + 0.55f, kCourt + 2.5f, 62.7f}, 0.06f);
        chamfered_box(m, Mat::Trim, {x - 0.68f, kCourt + 2.48f, 61.47f}, {x + 0.68f, kCourt + 2.75f, 62.83f},
                      0.06f);
        floor_lantern(level, lamps, {x, kCourt + 2.75f, 62.15f}, 180.0f);
    }
    const int column = level.add_mesh(column_mesh("column", 4.6f)),
              broken = level.add_mesh(column_mesh("column_short", 2.5f));
    for (const float z : {64.2f, 68.0f, 71.8f}) level.add_instance("column", column, {-54.3f, kCourt, z});
    for (const float x : {-50.4f, -46.6f}) level.add_instance("column", column, {x, kCourt, 64.2f});
    level.add_instance("column", broken, {-54.3f, kCourt, 74.6f});
    chamfered_box(m, Mat::Trim, {-54.72f, kCourt + 4.58f, 63.7f}, {-53.88f, kCourt + 5.15f, 72.3f}, 0.06f);
    chamfered_box(m, Mat::Trim, {-53.90f, kCourt + 4.585f, 63.78f}, {-46.1f, kCourt + 5.14f, 64.62f}, 0.06f);
    chamfered_box(m, Mat::Trim, {-54.9f, kCourt + 5.13f, 63.6f}, {-53.7f, kCourt + 5.32f, 72.5f}, 0.05f);
    chamfered_box(m, Mat::Trim, {-53.72f, kCourt + 5.12f, 63.6f}, {-45.9f, kCourt + 5.31f, 64.8f}, 0.05f);
    level.add_static(std::move(m));
    for (const float z : {66.1f, 69.9f}) hang_lantern(level, lamps, {-54.3f, kCourt + 4.60f, z}, 140.0f);
    hang_lantern(level, lamps, {-48.5f, kCourt + 4.60f, 64.2f}, 140.0f);
    for (const float x : {-42.0f, -32.0f, -22.0f}) post_lantern(level, lamps, {x, kCourt, 74.9f}, 180.0f, 160.0f);
    for (const float x : {-48.0f, -28.0f}) level.add_instance("bench", props.bench, {x, kCourt, 74.6f});
    level.add_instance("urn", props.urn, {-46.9f, kCourt, 61.0f});
    level.add_instance("urn", props.urn, {-13.4f, kCourt, 63.6f});
    level.add_instance("ivy", props.ivy, {-12.36f, kCourt, 70.0f}, -90.0f);
}

void garth(Level& level, const Lamps& lamps, const Props& props) {
    for (const float z : {20.0f, 50.0f}) post_lantern(level, lamps, {-35.6f, kCourt, z}, 90.0f, 170.0f);
    for (const float z : {24.0f, 48.0f}) post_lantern(level, lamps, {-4.6f, kCourt, z}, -90.0f, 170.0f);
    post_lantern(level, lamps, {-18.0f, kCourt, 57.4f}, 180.0f, 170.0f);
    Mesh m{"tree_bench", {}, mat4(1.0f)};  // low round wall about the tree
    const std::array<vec2, 7> wall_profile{{{2.75f, -0.3f},
                                            {2.75f, 0.36f},
                                            {2.85f, 0.38f},
                                            {2.85f, 0.50f},
                                            {2.35f, 0.50f},
                                            {2.35f, 0.38f},
                                            {2.35f, 0.1f}}};
    lathe(m, Mat::Trim, {-24.0f, kCourt, 36.0f}, wall_profile, 28);
    const std::array<vec2, 2> soil{{{2.4f, 0.28f}, {0.0f, 0.42f}}};
    lathe(m, Mat::Grass, {-24.0f, kCourt, 36.0f}, soil, 20);
    level.add_static(std::move(m));
    Random random(82);
    for (int i = 0; i < 46; ++i) {
        const float x = random.range(-35.5f, -5.0f), z = random.range(16.0f, 57.0f);
        if (glm::length(vec2(x + 24.0f, z - 36.0f)) < 4.0f || glm::length(vec2(x + 8.4f, z - 27.0f)) < 4.0f)
            continue;
        level.add_instance("shrub", props.tuft, {x, kCourt + 0.1f, z}, random.range(0, 360),
                           random.range(0.25f, 0.75f));
    }
    for (const float x : {-33.0f, -29.0f}) level.add_instance("ivy", props.ivy, {x, kCourt, 10.36f}, 0.0f, 1.15f);
    level.add_instance("bench", props.bench, {-28.0f, kCourt, 12.2f});
}

}  // namespace

void add_cloister(Level& level, const Lamps& lamps, const Props& props) {
    ground(level);
    loggia(level, lamps);
    dormitory(level, lamps, props);
    lower_yard(level, lamps, props);
    belvedere(level, lamps, props);
    garth(level, lamps, props);
}

}  // namespace tyndall::level
