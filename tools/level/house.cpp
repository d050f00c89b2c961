#include "tools/level/parts.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr float kGroundFloor = 3.0f, kUpperFloor = 2.6f, kJetty = 0.32f, kSunk = 2.0f;

// Timber casement on a wall in the plane z: centre x, sill y.
void casement(Mesh& m, float x, float y, float width, float height, float z) {
    const float l = x - width / 2, r = x + width / 2;
    m.quad(Mat::Window, {l, y, z + 0.019f}, {r, y, z + 0.019f}, {r, y + height, z + 0.019f},
           {l, y + height, z + 0.019f});
    beam(m, Mat::Timber, {l - 0.06f, y - 0.05f, z + 0.03f}, {r + 0.06f, y - 0.05f, z + 0.03f}, 0.22f, 0.10f);
    beam(m, Mat::Timber, {l - 0.06f, y + height + 0.05f, z + 0.02f}, {r + 0.06f, y + height + 0.05f, z + 0.02f},
         0.14f, 0.10f, {0, 1, 0}, false);
    for (const float s : {l, r})
        beam(m, Mat::Timber, {s, y, z + 0.02f}, {s, y + height, z + 0.02f}, 0.10f, 0.10f, {0, 0, 1}, false);
    beam(m, Mat::Timber, {x, y, z + 0.02f}, {x, y + height, z + 0.02f}, 0.045f, 0.05f, {0, 0, 1}, false);
    beam(m, Mat::Timber, {l, y + height * 0.6f, z + 0.018f}, {r, y + height * 0.6f, z + 0.018f}, 0.04f, 0.04f,
         {0, 1, 0}, false);
}

void ground_floor(Mesh& m, const HouseStyle& s, Random& random) {
    const float half = s.width / 2;
    const bool door_left = random.unit() < 0.5f;
    const float door_u = door_left ? 1.15f : s.width - 1.15f,
                window_u = door_left ? 0.5f * s.width + 0.95f : 0.5f * s.width - 0.95f;
    Wall front{{-half, -kSunk, -0.2f}, {1, 0, 0}, s.width, kGroundFloor + kSunk, 0.4f, {}};
    const Opening door = round_opening(door_u, 1.15f, kSunk, kSunk + 1.85f, 5);
    const Opening window = rectangle_opening(window_u, 1.9f, kSunk + 0.95f, kSunk + 2.25f);
    front.openings = door_left ? std::vector{door, window} : std::vector{window, door};
    wall(m, s.ground, front);
    archivolt(m, Mat::Trim, front, door, 0.22f, 0.05f, 1);
    // Leaf of the door and glazing, set back in the openings.
    const float dx = door_u - half, wx = window_u - half;
    m.quad(Mat::Planks, {dx - 0.6f, 0, -0.28f}, {dx + 0.6f, 0, -0.28f}, {dx + 0.6f, 2.6f, -0.28f},
           {dx - 0.6f, 2.6f, -0.28f});
    beam(m, Mat::Iron, {dx - 0.5f, 0.5f, -0.265f}, {dx + 0.45f, 0.5f, -0.265f}, 0.02f, 0.06f);
    beam(m, Mat::Iron, {dx - 0.5f, 1.6f, -0.265f}, {dx + 0.45f, 1.6f, -0.265f}, 0.02f, 0.06f);
    chamfered_box(m, Mat::Trim, {dx - 0.75f, -0.5f, -0.1f}, {dx + 0.75f, 0.06f, 0.32f}, 0.03f);
    m.quad(Mat::Window, {wx - 1.0f, 0.9f, -0.25f}, {wx + 1.0f, 0.9f, -0.25f}, {wx + 1.0f, 2.3f, -0.25f},
           {wx - 1.0f, 2.3f, -0.25f});
    for (const float x : {-0.48f, 0.0f, 0.48f})
        beam(m, Mat::Timber, {wx + x, 0.95f, -0.2f}, {wx + x, 2.25f, -0.2f}, 0.07f, 0.08f);
    chamfered_box(m, Mat::Trim, {wx - 1.15f, 0.80f, -0.3f}, {wx + 1.15f, 0.97f, 0.08f}, 0.025f);
    beam(m, Mat::Timber, {wx - 1.2f, 2.33f, -0.02f}, {wx + 1.2f, 2.33f, -0.02f}, 0.14f, 0.22f);
    for (const float side : {-1.0f, 1.0f}) {  // open shutters
        const float x = wx + side * 1.28f;
        box(m, Mat::Planks, {x - 0.26f, 0.98f, 0.0f}, {x + 0.26f, 2.22f, 0.05f}, kBack);
    }
    box(m, s.ground, {-half + 0.03f, -kSunk, -s.depth}, {half - 0.03f, kGroundFloor, -0.36f},
        kBottom | kTop | kFront);
}

// Timber framing on the front of one upper floor: posts, rails, braces, casements.
void upper_floor(Mesh& m, const HouseStyle& s, float y, float z, Random& random) {
    const float half = s.width / 2 - 0.02f, top = y + kUpperFloor;
    box(m, Mat::Plaster, {-half, y, -s.depth + 0.04f}, {half, top, z}, kBottom | kTop);
    const float proud = z + 0.01f;
    const int bays = s.width > 7.0f ? 4 : 3;
    const float bay = 2 * half / static_cast<float>(bays);
    beam(m, Mat::Timber, {-half - 0.03f, y + 0.10f, proud - 0.02f}, {half + 0.03f, y + 0.10f, proud - 0.02f}, 0.20f,
         0.24f);
    beam(m, Mat::Timber, {-half - 0.03f, top - 0.09f, proud - 0.01f}, {half + 0.03f, top - 0.09f, proud - 0.01f},
         0.15f, 0.18f);
    for (int i = 0; i <= bays; ++i) {
        const float x = -half + bay * static_cast<float>(i) + (i == 0 ? 0.08f : i == bays ? -0.08f : 0.0f);
        beam(m, Mat::Timber, {x, y + 0.22f, proud}, {x, top - 0.18f, proud}, 0.18f, 0.09f, {0, 0, 1}, false);
    }
    for (int i = 0; i < bays; ++i) {
        const float c = -half + bay * (static_cast<float>(i) + 0.5f), w = bay * 0.5f - 0.1f;
        if ((i == 0 || i == bays - 1) && bays > 2) {
            const float dir = i == 0 ? 1.0f : -1.0f;
            beam(m, Mat::Timber, {c - dir * w, y + 0.25f, proud - 0.012f},
                 {c + dir * w, top - 0.3f, proud - 0.012f}, 0.15f, 0.07f, {0, 0, 1}, false);
            if (random.unit() < 0.5f) {
                beam(m, Mat::Timber, {c + dir * w, y + 0.25f, proud - 0.02f},
                     {c - dir * w, top - 0.3f, proud - 0.02f}, 0.15f, 0.06f, {0, 0, 1}, false);
            }
        } else {
            casement(m, c, y + 0.85f, std::min(1.1f, bay - 0.45f), 1.15f, z);
        }
    }
    for (float x = -half + 0.25f; x < half; x += 0.62f) {  // joist ends carry the jetty
        beam(m, Mat::Timber, {x, y - 0.09f, z - kJetty - 0.15f}, {x, y - 0.09f, z + 0.06f}, 0.13f, 0.17f);
    }
    m.quad(Mat::Planks, {-half, y, z - kJetty - 0.1f}, {half, y, z - kJetty - 0.1f}, {half, y, z}, {-half, y, z});
}

void gable_end(Mesh& m, const HouseStyle& s, float y, float z, float ridge, float depth) {
    const float half = s.width / 2 - 0.02f;
    extrude(m, Mat::Plaster, std::array{vec3(-half, y, z), vec3(half, y, z), vec3(0, ridge - 0.1f, z)},
            {0, 0, -depth});
    const float proud = z + 0.01f, mid = y + (ridge - y) * 0.42f, w = half * 0.58f;
    beam(m, Mat::Timber, {-w, mid, proud}, {w, mid, proud}, 0.08f, 0.16f);
    beam(m, Mat::Timber, {0, y + 0.02f, proud - 0.012f}, {0, ridge - 0.5f, proud - 0.012f}, 0.16f, 0.08f, {0, 0, 1},
         false);
    for (const float side : {-1.0f, 1.0f}) {
        beam(m, Mat::Timber, {side * half * 0.75f, y + 0.05f, proud - 0.02f},
             {0.12f * side, mid + 0.5f, proud - 0.02f}, 0.14f, 0.07f, {0, 0, 1}, false);
    }
    casement(m, 0.0f, mid + 0.25f, 0.7f, 0.8f, z + 0.03f);
}

}  // namespace

Mesh make_house(const HouseStyle& s) {
    Mesh m{"house_" + std::to_string(s.seed), {}, mat4(1.0f)};
    Random random(s.seed);
    ground_floor(m, s, random);
    float y = kGroundFloor, z = 0.0f;
    for (int i = 0; i < s.upper_floors; ++i) {
        z += kJetty;
        upper_floor(m, s, y, z, random);
        y += kUpperFloor;
    }
    const float half = s.width / 2;
    if (s.gable_front) {
        const float ridge = y + half * 1.25f, over = 0.35f, eave = y - over * 1.25f;
        gable_end(m, s, y, z, ridge, 0.3f);
        extrude(m, Mat::Plaster,
                std::array{vec3(half - 0.02f, y, -s.depth + 0.04f), vec3(-half + 0.02f, y, -s.depth + 0.04f),
                           vec3(0, ridge - 0.1f, -s.depth + 0.04f)},
                {0, 0, 0.3f});
        gable_roof(m, s.roof, Mat::Planks, {0, ridge + 0.12f, -s.depth - 0.35f}, {0, ridge + 0.12f, z + 0.5f},
                   half + over, eave + 0.12f, 0.2f);
        beam(m, s.roof, {0, ridge + 0.12f, -s.depth - 0.37f}, {0, ridge + 0.12f, z + 0.52f}, 0.24f, 0.14f);
        for (const float side : {-1.0f, 1.0f}) {  // barge boards
            beam(m, Mat::Timber, {side * (half + over), eave - 0.02f, z + 0.52f}, {0, ridge, z + 0.52f}, 0.06f,
                 0.26f);
        }
    } else {
        const float middle = (z - s.depth) / 2, run = (z + s.depth) / 2, ridge = y + run * 0.95f, over = 0.4f;
        for (const float side : {-1.0f, 1.0f}) {
            const float x = side * (half - 0.02f);
            const std::array<vec3, 3> p{vec3(x, y, z * 1.0f), vec3(x, y, -s.depth + 0.04f),
                                        vec3(x, ridge - 0.12f, middle)};
            const std::array<vec3, 3> q{p[1], p[0], p[2]};
            extrude(m, Mat::Plaster, side > 0 ? p : q, {-side * 0.3f, 0, 0});
        }
        gable_roof(m, s.roof, Mat::Planks, {-half - 0.02f, ridge + 0.1f, middle},
                   {half + 0.02f, ridge + 0.1f, middle}, run + over, y - over * 0.95f + 0.1f, 0.2f);
        beam(m, s.roof, {-half - 0.03f, ridge + 0.1f, middle}, {half + 0.03f, ridge + 0.1f, middle}, 0.24f, 0.14f);
        // Dormer.
        const float dy = y + 0.35f, dz = z - 0.45f;
        box(m, Mat::Plaster, {-0.75f, y - 0.1f, dz - 2.2f}, {0.75f, dy + 1.25f, dz}, kBottom | kTop | kBack);
        casement(m, 0, dy + 0.15f, 0.85f, 0.9f, dz);
        extrude(m, Mat::Plaster,
                std::array{vec3(-0.75f, dy + 1.25f, dz), vec3(0.75f, dy + 1.25f, dz), vec3(0, dy + 1.95f, dz)},
                {0, 0, -0.2f});
        gable_roof(m, s.roof, Mat::Planks, {0, dy + 2.08f, dz - 2.9f}, {0, dy + 2.08f, dz + 0.3f}, 1.0f, dy + 1.15f,
                   0.14f);
    }
    const float cx = half * (random.unit() < 0.5f ? -0.55f : 0.55f), top = y + half * 1.25f + 1.0f;
    box(m, Mat::Rubble, {cx - 0.42f, y - 0.5f, -s.depth * 0.6f - 0.42f},
        {cx + 0.42f, top - 0.1f, -s.depth * 0.6f + 0.42f}, kBottom | kTop);
    chamfered_box(m, Mat::Trim, {cx - 0.52f, top - 0.25f, -s.depth * 0.6f - 0.52f},
                  {cx + 0.52f, top + 0.02f, -s.depth * 0.6f + 0.52f}, 0.04f);
    return m;
}

}  // namespace tyndall::level
