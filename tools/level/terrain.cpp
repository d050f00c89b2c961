// Promontory, cliffs, valley and the hills round it, as one height field whose cells grow with distance; and what
// stands far off: a watch tower on its rock and the ruined viaduct that led there.
#include <algorithm>

#include "tools/level/parts.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr vec2 kTower(-212.0f, -18.0f);

float smooth(float a, float b, float x) {
    const float t = glm::clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

float noise(float x, float z, float metres, int octaves, uint32_t seed) {
    return fractal_noise(vec2(x, z) / metres + 500.0f, {0, 0}, octaves, seed);
}

// Distance to the outline of the promontory, negative inside.
float outline(float x, float z) {
    const vec2 d = glm::abs(vec2(x - 320.0f, z - 20.0f)) - vec2(372.0f, 52.0f);
    return glm::length(glm::max(d, vec2(0.0f))) + std::min(std::max(d.x, d.y), 0.0f);
}

float height(float x, float z) {
    // On the promontory the ground stays below every floor; north of the church it rises to the windows' sills.
    float ground = x < 14.0f ? -4.8f : street_height(x) - 1.3f;
    if (z < -12.0f && x < 10.0f) ground = glm::mix(ground, -0.9f, smooth(-12.0f, -18.0f, z));
    ground += smooth(112.0f, 200.0f, x) * 22.0f;
    const float d =
        outline(x, z) + (noise(x, z, 26.0f, 3, 201) - 0.5f) * 16.0f * smooth(-12.0f, 6.0f, outline(x, z));
    const float r = glm::length(vec2(x, z));
    const float valley = -62.0f + 16.0f * noise(x, z, 90.0f, 4, 202);
    const float ridge = 1.0f - std::abs(2.0f * noise(x, z, 520.0f, 5, 203) - 1.0f);
    const float hills = smooth(260.0f, 1500.0f, r) * (60.0f + 330.0f * ridge * ridge) +
                        smooth(200.0f, 500.0f, r) * 26.0f * noise(x, z, 120.0f, 4, 204);
    // Wooded knolls stand out of the fog like islands.
    const float knoll = smooth(0.55f, 0.80f, noise(x, z, 150.0f, 3, 206)) * smooth(110.0f, 190.0f, r) * 66.0f;
    const float low = valley + hills + knoll;
    const float ledges = smooth(0.0f, 9.0f, d) * 0.55f + smooth(12.0f, 34.0f, d) * 0.45f;
    float y = glm::mix(ground, std::min(low, ground), ledges);
    if (low > ground) y = glm::mix(ground, low, smooth(0.0f, 60.0f, d));
    const float t = glm::length(vec2(x, z) - kTower) + (noise(x, z, 14.0f, 3, 205) - 0.5f) * 10.0f;
    return std::max(y, glm::mix(-3.5f, -66.0f, smooth(9.0f, 30.0f, t)));
}

std::vector<float> spacing(float low, float high, float step, float reach) {
    std::vector<float> inner, left, right;
    for (float x = low; x <= high; x += step) inner.push_back(x);
    float grow = step;
    for (float x = low; x > -reach;) left.push_back(x -= grow *= 1.3f);
    grow = step;
    for (float x = inner.back(); x < reach;) right.push_back(x += grow *= 1.3f);
    std::vector<float> all(left.rbegin(), left.rend());
    all.insert(all.end(), inner.begin(), inner.end());
    all.insert(all.end(), right.begin(), right.end());
    return all;
}

void height_field(Mesh& m) {
    const auto xs = spacing(-240.0f, 130.0f, 8.0f, 2600.0f), zs = spacing(-72.0f, 116.0f, 8.0f, 2600.0f);
    auto at = [&](size_t i, size_t j) { return vec3(xs[i], height(xs[i], zs[j]), zs[j]); };
    std::map<Mat, std::map<std::pair<size_t, size_t>, uint32_t>> used;
    auto vertex = [&](Mat mat, size_t i, size_t j) {
        auto [it, fresh] = used[mat].try_emplace({i, j}, 0);
        if (fresh) {
            const size_t a = std::max<size_t>(i, 1), b = std::min(i + 1, xs.size() - 1), c = std::max<size_t>(j, 1),
                         d = std::min(j + 1, zs.size() - 1);
            const vec3 dx = at(b, j) - at(a - 1, j), dz = at(i, d) - at(i, c - 1), p = at(i, j);
            it->second = static_cast<uint32_t>(m.parts[mat].vertices.size());
            m.parts[mat].vertices.push_back(
                {p, glm::normalize(glm::cross(dz, dx)), vec2(p.x, p.z) / mat.tile_metres});
        }
        return it->second;
    };
    for (size_t i = 0; i + 1 < xs.size(); ++i) {
        for (size_t j = 0; j + 1 < zs.size(); ++j) {
            const bool far = glm::length(vec2(xs[i] + 40.0f, zs[j])) > 330.0f;
            auto face = [&](size_t a, size_t b, size_t c, size_t d, size_t e, size_t f) {
                const vec3 p = at(a, b), q = at(c, d), r = at(e, f);
                const vec3 n = glm::normalize(glm::cross(q - p, r - p));
                if (!far && n.y < 0.80f) {
                    m.triangle(Mat::Rock, p, q, r);  // cliffs keep their facets
                } else {
                    const Mat mat = far ? Mat::Hills : Mat::Grass;
                    const uint32_t x = vertex(mat, a, b), y = vertex(mat, c, d), z = vertex(mat, e, f);
                    m.parts[mat].indices.insert(m.parts[mat].indices.end(), {x, y, z});
                }
            };
            face(i, j, i, j + 1, i + 1, j + 1);
            face(i, j, i + 1, j + 1, i + 1, j);
        }
    }
}

Mesh viaduct_span() {  // 14 m along x, deck at y = 0
    Mesh m{"viaduct_span", {}, mat4(1.0f)};
    Wall w{{-7.0f, -60.0f, 0}, {1, 0, 0}, 14.0f, 60.0f, 4.2f, {}};
    w.openings = {round_opening(7.0f, 10.6f, 0.0f, 52.0f, 8)};
    wall(m, Mat::Rubble, w);
    Opening arch = w.openings[0];
    std::ranges::fill(arch.lower, 52.0f);
    archivolt(m, Mat::Trim, w, arch, 0.7f, 0.2f, 1);
    for (const float side : {1.0f, -1.0f}) {
        box(m, Mat::Rubble, {-7.0f, -0.5f, side * 2.1f - 0.25f}, {7.0f, 1.0f, side * 2.1f + 0.25f},
            kBottom | kLeft | kRight);
        chamfered_box(m, Mat::Trim, {-8.3f, -9.2f, side * 1.9f - 0.5f}, {-5.7f, -8.6f, side * 1.9f + 0.5f}, 0.1f);
    }
    return m;
}

Mesh watch_tower() {
    Mesh m{"watch_tower", {}, mat4(1.0f)};
    const std::array<vec2, 9> body{{{6.4f, -14.0f},
                                    {5.2f, 0.0f},
                                    {4.8f, 22.0f},
                                    {5.9f, 24.0f},
                                    {5.9f, 29.0f},
                                    {5.5f, 29.0f},
                                    {5.5f, 27.0f},
                                    {3.6f, 27.0f},
                                    {3.4f, 34.0f}}};
    lathe(m, Mat::Rubble, vec3(0), body, 18);
    spire(m, Mat::Slate, {0, 33.9f, 0}, 4.6f, 11.0f, 10);
    for (int i = 0; i < 9; ++i) {
        const float a = 2.0f * kPi * static_cast<float>(i) / 9.0f;
        m.transform = place(vec3(sine(a) * 5.68f, 28.9f, cosine(a) * 5.68f), a * 180.0f / kPi);
        box(m, Mat::Rubble, {-0.9f, 0, -0.35f}, {0.9f, 1.3f, 0.35f}, kBottom);
    }
    for (int i = 0; i < 10; ++i) {
        const float a = 1.1f + 0.9f * static_cast<float>(i), y = 6.0f + 2.3f * static_cast<float>(i % 8);
        m.transform = place(vec3(sine(a) * 5.0f, y, cosine(a) * 5.0f), a * 180.0f / kPi);
        m.quad(Mat::Window, {-0.45f, 0, 0.10f}, {0.45f, 0, 0.10f}, {0.45f, 1.7f, 0.06f}, {-0.45f, 1.7f, 0.06f});
    }
    m.transform = mat4(1.0f);
    chamfered_box(m, Mat::Rubble, {4.0f, -14.0f, -5.0f}, {16.0f, 5.0f, 5.0f}, 0.2f);
    gable_roof(m, Mat::Slate, Mat::Planks, {4.0f, 10.0f, 0}, {16.5f, 10.0f, 0}, 5.8f, 4.4f, 0.4f);
    extrude(m, Mat::Rubble, std::array{vec3(15.9f, 4.9f, 5.0f), vec3(15.9f, 4.9f, -5.0f), vec3(15.9f, 9.6f, 0)},
            {-0.5f, 0, 0});
    return m;
}

}  // namespace

void add_terrain(Level& level) {
    Mesh m{"terrain", {}, mat4(1.0f)};
    height_field(m);
    level.add_static(std::move(m));
    const int span = level.add_mesh(viaduct_span());
    const vec3 from(-68.0f, -5.5f, 4.0f), to(kTower.x + 24.0f, -3.0f, kTower.y + 2.0f);
    const vec3 d = to - from;
    const int count = static_cast<int>(glm::length(d) / 14.0f);
    const float yaw = arctangent(-d.z, d.x) * 180.0f / kPi;
    for (int i = 0; i < count; ++i) {
        if (i == 5) continue;  // the fallen arch
        level.add_instance("viaduct", span, from + d * (14.0f * (static_cast<float>(i) + 0.5f) / glm::length(d)),
                           yaw);
    }
    const int tower = level.add_mesh(watch_tower());
    level.add_instance("watch_tower", tower, {kTower.x, -3.0f, kTower.y});
}

}  // namespace tyndall::level
