#include "tools/level/parts.h"
#include "tools/modeling/random.h"
#include "tools/modeling/shapes.h"

namespace tyndall::level {

namespace {

Mesh barrel_mesh() {
    Mesh m{"barrel", {}, mat4(1.0f)};
    const std::array<vec2, 7> staves{{{0.27f, 0.0f},
                                      {0.33f, 0.2f},
                                      {0.36f, 0.45f},
                                      {0.33f, 0.7f},
                                      {0.27f, 0.9f},
                                      {0.24f, 0.9f},
                                      {0.24f, 0.86f}}};
    lathe(m, Mat::Planks, vec3(0), staves, 10);
    const std::array<vec2, 2> lid{{{0.245f, 0.86f}, {0.0f, 0.86f}}};
    lathe(m, Mat::Planks, vec3(0), lid, 10);
    for (const float y : {0.12f, 0.68f}) {
        const std::array<vec2, 4> hoop{{{0.27f, y - 0.01f}, {0.345f, y}, {0.355f, y + 0.07f}, {0.27f, y + 0.08f}}};
        lathe(m, Mat::Iron, vec3(0), hoop, 10);
    }
    return m;
}

Mesh crate_mesh() {
    Mesh m{"crate", {}, mat4(1.0f)};
    box(m, Mat::Planks, {-0.36f, 0.0f, -0.36f}, {0.36f, 0.7f, 0.36f});
    for (const float x : {-0.36f, 0.36f}) {
        for (const float z : {-0.36f, 0.36f}) beam(m, Mat::Timber, {x, 0.005f, z}, {x, 0.72f, z}, 0.09f, 0.09f);
        for (const float y : {0.05f, 0.67f}) {
            beam(m, Mat::Timber, {x, y, -0.33f}, {x, y, 0.33f}, 0.07f, 0.08f);
            beam(m, Mat::Timber, {-0.33f, y, x}, {0.33f, y, x}, 0.07f, 0.08f);
        }
    }
    return m;
}

Mesh stall_mesh(const std::string& name, Mat cloth) {  // counter towards +Z, back to the wall
    Mesh m{name, {}, mat4(1.0f)};
    for (const float x : {-1.25f, 1.25f}) {
        beam(m, Mat::Timber, {x, -0.4f, 0.55f}, {x, 2.15f, 0.55f}, 0.10f, 0.10f);
        beam(m, Mat::Timber, {x, -0.4f, -0.55f}, {x, 2.65f, -0.55f}, 0.10f, 0.10f);
        beam(m, Mat::Timber, {x, 2.65f, -0.60f}, {x, 2.12f, 0.70f}, 0.08f, 0.08f);
    }
    beam(m, Mat::Timber, {-1.35f, 2.16f, 0.55f}, {1.35f, 2.16f, 0.55f}, 0.09f, 0.09f);
    beam(m, Mat::Timber, {-1.35f, 2.64f, -0.55f}, {1.35f, 2.64f, -0.55f}, 0.09f, 0.09f);
    chamfered_box(m, Mat::Planks, {-1.4f, 0.84f, -0.1f}, {1.4f, 0.93f, 0.8f}, 0.015f);
    box(m, Mat::Planks, {-1.2f, -0.4f, 0.45f}, {1.2f, 0.84f, 0.50f}, kTop);
    // Awning of four widths of cloth that sag between the rafters, with a hanging valance.
    const int strips = 6;
    for (int i = 0; i < strips; ++i) {
        const float x0 = -1.5f + 0.5f * static_cast<float>(i), x1 = x0 + 0.5f;
        const Mat mat = i % 2 ? cloth : Mat::ClothOchre;
        auto at = [](float x, float t) {
            const float sag = 0.07f * sine(t * kPi) * (0.6f + 0.4f * cosine(x * 5.0f));
            return vec3(x, 2.76f - 0.56f * t - sag, -0.62f + 1.5f * t);
        };
        std::vector<Vertex> v;
        for (int r = 0; r < 2; ++r) {  // upper side, then a thin lower side
            v.clear();
            for (int k = 0; k <= 3; ++k) {
                const float t = 1.0f - static_cast<float>(k) / 3.0f;
                const float drop = r ? -0.015f : 0.0f;
                for (const float x : r ? std::array{x1, x0} : std::array{x0, x1}) {
                    v.push_back({at(x, t) + vec3(0, drop, 0), vec3(0, r ? -0.93f : 0.93f, r ? -0.36f : 0.36f),
                                 vec2(x, t * 1.6f) / mat.tile_metres});
                }
            }
            m.grid(mat, 4, 2, v);
        }
        const vec3 a = at(x0, 1), b = at(x1, 1), c = (a + b) * 0.5f - vec3(0, 0.30f, 0);
        m.polygon(mat, std::array{a + vec3(0, 0.01f, 0.01f), a + vec3(0, -0.17f, 0.01f), c,
                                  b + vec3(0, -0.17f, 0.01f), b + vec3(0, 0.01f, 0.01f)});
    }
    return m;
}

Mesh banner_mesh(const std::string& name, Mat cloth) {  // hangs from a pole that leaves the wall (z = 0) along +Z
    Mesh m{name, {}, mat4(1.0f)};
    beam(m, Mat::Timber, {0, 0, -0.1f}, {0, 0.12f, 1.35f}, 0.06f, 0.06f);
    std::vector<Vertex> v;
    const int rows = 8;
    for (int r = 0; r <= rows; ++r) {
        const float t = static_cast<float>(rows - r) / static_cast<float>(rows);
        for (const float z : {0.2f, 0.72f, 1.24f}) {
            const float x = 0.10f * sine(t * 5.0f + z * 2.0f) * t;
            const float tail = r == 0 && z == 0.72f ? 0.35f : 0.0f;
            v.push_back({{x, z * 0.08f - 0.02f - 2.5f * t + tail, z},
                         glm::normalize(vec3(-1, 0, 0.3f * sine(t * 5.0f))),
                         vec2(z, 2.5f * t) / cloth.tile_metres});
        }
    }
    m.grid(cloth, rows + 1, 3, v);
    return m;
}

// Upright crossed cards of leaves, `size` metres.
void cards(Mesh& m, vec3 at, float size, int count, Random& random, float lean) {
    for (int i = 0; i < count; ++i) {
        const float a = random.range(0, 2 * kPi), tilt = random.range(-lean, lean);
        const vec3 right = vec3(cosine(a), 0, sine(a)) * (size * 0.5f);
        const vec3 up = glm::normalize(vec3(-sine(a) * tilt, 1.0f, cosine(a) * tilt)) * size;
        const std::array<vec3, 4> p{at - right, at + right, at + right + up, at - right + up};
        const vec3 n = glm::normalize(vec3(random.range(-0.4f, 0.4f), 1.0f, random.range(-0.4f, 0.4f)));
        const std::array<Vertex, 4> v{{{p[0], n, {0, 1}}, {p[1], n, {1, 1}}, {p[3], n, {0, 0}}, {p[2], n, {1, 0}}}};
        m.grid(Mat::Leaves, 2, 2, v);
    }
}

Mesh tuft_mesh() {
    Mesh m{"shrub", {}, mat4(1.0f)};
    Random random(71);
    for (int i = 0; i < 5; ++i) {
        cards(m, {random.range(-0.5f, 0.5f), -0.18f, random.range(-0.5f, 0.5f)}, random.range(0.5f, 0.95f), 3,
              random, 0.5f);
    }
    return m;
}

Mesh ivy_mesh() {  // climbs a wall in the plane z = 0, facing +Z, 2.6 x 5 m
    Mesh m{"ivy", {}, mat4(1.0f)};
    Random random(72);
    for (int i = 0; i < 56; ++i) {
        const float y = random.range(0.0f, 1.0f);
        const float x = random.range(-1.3f, 1.3f) * (1.0f - 0.55f * y) + 0.5f * sine(y * 6.0f),
                    s = random.range(0.35f, 0.62f);
        const float a = random.range(0, 2 * kPi), z = random.range(0.05f, 0.20f);
        const vec3 n = glm::normalize(vec3(random.range(-0.5f, 0.5f), random.range(-0.2f, 0.6f), 1.0f));
        vec3 u, v;
        planar_axes(n, u, v);
        const vec3 c(x, y * 5.0f, z), r = (u * cosine(a) + v * sine(a)) * s, t = (v * cosine(a) - u * sine(a)) * s;
        const std::array<Vertex, 4> q{
            {{c - r - t, n, {0, 1}}, {c + r - t, n, {1, 1}}, {c - r + t, n, {0, 0}}, {c + r + t, n, {1, 0}}}};
        m.grid(Mat::Leaves, 2, 2, q);
    }
    return m;
}

Mesh block_mesh() {
    Mesh m{"fallen_block", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-0.42f, 0.0f, -0.26f}, {0.42f, 0.44f, 0.26f}, 0.045f);
    return m;
}

Mesh bench_mesh() {
    Mesh m{"bench", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Planks, {-1.3f, 0.43f, -0.2f}, {1.3f, 0.50f, 0.2f}, 0.015f);
    for (const float x : {-1.05f, 1.05f})
        chamfered_box(m, Mat::Timber, {x - 0.06f, 0.0f, -0.16f}, {x + 0.06f, 0.435f, 0.16f}, 0.015f);
    beam(m, Mat::Timber, {-1.0f, 0.2f, 0}, {1.0f, 0.2f, 0}, 0.06f, 0.09f);
    return m;
}

Mesh baluster_mesh() {  // 0.78 m
    Mesh m{"baluster", {}, mat4(1.0f)};
    const std::array<vec2, 8> p{{{0.09f, 0.0f},
                                 {0.09f, 0.08f},
                                 {0.05f, 0.12f},
                                 {0.095f, 0.30f},
                                 {0.055f, 0.56f},
                                 {0.05f, 0.66f},
                                 {0.09f, 0.70f},
                                 {0.09f, 0.78f}}};
    lathe(m, Mat::Trim, vec3(0), p, 6);
    return m;
}

Mesh urn_mesh() {
    Mesh m{"urn", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-0.28f, -0.05f, -0.28f}, {0.28f, 0.16f, 0.28f}, 0.03f);
    const std::array<vec2, 8> p{{{0.22f, 0.15f},
                                 {0.10f, 0.26f},
                                 {0.10f, 0.32f},
                                 {0.34f, 0.55f},
                                 {0.40f, 0.80f},
                                 {0.46f, 0.86f},
                                 {0.42f, 0.88f},
                                 {0.0f, 0.80f}}};
    lathe(m, Mat::Trim, vec3(0), p, 12);
    Random random(73);
    for (int i = 0; i < 3; ++i)
        cards(m, {random.range(-0.15f, 0.15f), 0.74f, random.range(-0.15f, 0.15f)}, 0.75f, 2, random, 0.5f);
    return m;
}

}  // namespace

Props make_props(Level& level) {
    Props p{};
    p.barrel = level.add_mesh(barrel_mesh());
    p.crate = level.add_mesh(crate_mesh());
    p.stall_red = level.add_mesh(stall_mesh("stall_red", Mat::ClothRed));
    p.stall_blue = level.add_mesh(stall_mesh("stall_blue", Mat::ClothBlue));
    p.stall_ochre = level.add_mesh(stall_mesh("stall_ochre", Mat::Plaster));
    p.banner_red = level.add_mesh(banner_mesh("banner_red", Mat::ClothRed));
    p.banner_blue = level.add_mesh(banner_mesh("banner_blue", Mat::ClothBlue));
    p.tuft = level.add_mesh(tuft_mesh());
    p.ivy = level.add_mesh(ivy_mesh());
    p.block = level.add_mesh(block_mesh());
    p.bench = level.add_mesh(bench_mesh());
    p.baluster = level.add_mesh(baluster_mesh());
    p.urn = level.add_mesh(urn_mesh());
    return p;
}

}  // namespace tyndall::level
