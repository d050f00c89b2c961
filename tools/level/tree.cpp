// The old lime tree of the court. Limbs and their foliage are nodes that sway in the animation "wind".
#include "tools/level/parts.h"
#include "tools/modeling/random.h"
#include "tools/modeling/shapes.h"

namespace tyndall::level {

namespace {

constexpr vec3 kFoot(-24.0f, -3.0f, 36.0f);
constexpr float kWindPeriod = 8.0f;  // s; every sway has a whole number of cycles in it
constexpr int kWindKeys = 41;

// Cards on the shell and in the body of an ellipsoid; normals point away from the crown, which reads as a soft
// volume.
void cluster(Mesh& m, vec3 centre, vec3 radii, int count, vec3 crown_centre, Random& random) {
    for (int i = 0; i < count; ++i) {
        const float y = random.range(-1.0f, 1.0f), a = random.range(0, 2 * kPi), r = std::sqrt(1.0f - y * y),
                    k = 0.45f + 0.55f * std::sqrt(random.unit());
        const vec3 dir(r * cosine(a), y, r * sine(a)), p = centre + dir * radii * k;
        const vec3 face = glm::normalize(
            dir + vec3(random.range(-0.8f, 0.8f), random.range(-0.3f, 0.9f), random.range(-0.8f, 0.8f)));
        vec3 u, v;
        planar_axes(face, u, v);
        const float turn = random.range(0, 2 * kPi), size = random.range(0.42f, 0.66f);
        const vec3 right = (u * cosine(turn) + v * sine(turn)) * size,
                   up = (v * cosine(turn) - u * sine(turn)) * size;
        const vec3 n = glm::normalize(glm::normalize(p - crown_centre) + 0.4f * face);
        const std::array<Vertex, 4> q{{{p - right - up, n, {0, 1}},
                                       {p + right - up, n, {1, 1}},
                                       {p - right + up, n, {0, 0}},
                                       {p + right + up, n, {1, 0}}}};
        m.grid(Mat::Leaves, 2, 2, q);
    }
}

std::vector<vec3> bent(vec3 from, vec3 direction, float length, float rise, int points, Random& random) {
    std::vector<vec3> path{from};
    vec3 d = glm::normalize(direction);
    for (int i = 1; i < points; ++i) {
        d = glm::normalize(d + vec3(random.range(-0.22f, 0.22f), rise, random.range(-0.22f, 0.22f)));
        path.push_back(path.back() + d * (length / static_cast<float>(points - 1)));
    }
    return path;
}

std::vector<float> taper(float from, float to, size_t count) {
    std::vector<float> radii;
    for (size_t i = 0; i < count; ++i)
        radii.push_back(from + (to - from) * static_cast<float>(i) / static_cast<float>(count - 1));
    return radii;
}

void sway(Level& level, Animation& wind, int node, float degrees, int cycles, float phase, float heading) {
    Channel channel{node, true, {}, {}};
    for (int i = 0; i < kWindKeys; ++i) {
        const float t = kWindPeriod * static_cast<float>(i) / (kWindKeys - 1);
        // The last key repeats the first, exactly.
        const float w = 2.0f * kPi * static_cast<float>(i % (kWindKeys - 1)) / (kWindKeys - 1);
        const float angle = degrees *
                            (sine(w * static_cast<float>(cycles) + phase) +
                             0.35f * sine(w * static_cast<float>(2 * cycles + 1) + 2.0f * phase)) *
                            kPi / 180.0f;
        const float s = sine(angle / 2);
        channel.times.push_back(t);
        channel.values.emplace_back(s * cosine(heading), 0.0f, s * sine(heading), cosine(angle / 2));
    }
    const vec4 q = channel.values[0];
    level.nodes[static_cast<size_t>(node)].rotation = quat(q.w, q.x, q.y, q.z);
    wind.channels.push_back(channel);
}

}  // namespace

void add_tree(Level& level) {
    Random random(301);
    Animation wind{"wind", {}, {}};
    Mesh trunk{"tree_trunk", {}, mat4(1.0f)};
    const std::array<vec3, 8> line{{{0, -0.3f, 0},
                                    {0, 0.3f, 0},
                                    {0.02f, 0.9f, 0.03f},
                                    {0.1f, 2.0f, 0.0f},
                                    {0.05f, 3.2f, 0.12f},
                                    {-0.1f, 4.4f, 0.1f},
                                    {-0.05f, 6.2f, 0.0f},
                                    {0.1f, 9.2f, 0.05f}}};
    const std::array<float, 8> radii{1.15f, 0.92f, 0.74f, 0.64f, 0.60f, 0.54f, 0.38f, 0.15f};
    tube(trunk, Mat::Bark, line, radii, 14);
    for (int i = 0; i < 6; ++i) {  // roots
        const float a = static_cast<float>(i) * kPi / 3.0f + random.range(-0.3f, 0.3f);
        const vec3 d(cosine(a), 0, sine(a));
        tube(trunk, Mat::Bark,
             std::array{d * 0.35f + vec3(0, 0.85f, 0), d * 0.9f + vec3(0, 0.42f, 0), d * 1.5f + vec3(0, 0.22f, 0)},
             std::array{0.30f, 0.24f, 0.06f}, 7);
    }
    const int root = level.add_instance("tree", level.add_mesh(std::move(trunk)), kFoot);
    const int limbs = 11;
    for (int i = 0; i < limbs; ++i) {
        const bool leader = i == limbs - 1;
        const float a =
            leader ? 0.0f : 2.0f * kPi * (static_cast<float>(i) + random.range(-0.2f, 0.2f)) / (limbs - 1);
        const vec3 pivot =
            leader ? vec3(0.1f, 9.0f, 0.05f) : vec3(-0.05f, 3.9f + 0.46f * static_cast<float>((i * 3) % 10), 0.1f);
        const float pitch = leader ? 1.45f : random.range(0.22f, 0.80f),
                    length = leader ? 4.2f : random.range(5.6f, 7.6f);
        const vec3 d(cosine(a) * cosine(pitch), sine(pitch), sine(a) * cosine(pitch));
        Mesh wood{"tree_limb_" + std::to_string(i), {}, mat4(1.0f)},
            leaves{"tree_leaves_" + std::to_string(i), {}, mat4(1.0f)};
        const auto path = bent(vec3(0), d, length, 0.10f, 6, random);
        tube(wood, Mat::Bark, path, taper(leader ? 0.16f : 0.28f, 0.05f, path.size()), 8);
        const vec3 crown = vec3(0, 8.6f, 0) - pivot;
        const vec3 hub = path[3];  // the foliage node turns about this point
        auto add_cluster = [&](vec3 at, float scale, int count) {
            cluster(leaves, at - hub, vec3(1.5f, 0.85f, 1.5f) * scale, count, crown - hub, random);
        };
        add_cluster(path.back() + d * 0.4f, 1.0f, 30);
        for (int k = 0; k < 4; ++k) {
            const size_t from = 2 + static_cast<size_t>(k % 3);
            const float turn = a + (k % 2 ? 1.0f : -1.0f) * random.range(0.6f, 1.3f);
            const vec3 e(cosine(turn), random.range(0.2f, 0.9f), sine(turn));
            const auto twig = bent(path[from], e, random.range(2.0f, 3.4f), 0.10f, 4, random);
            tube(wood, Mat::Bark, twig, taper(0.09f, 0.02f, twig.size()), 5);
            add_cluster(twig.back(), random.range(0.7f, 1.05f), 26);
        }
        const int limb = level.add_instance(wood.name, level.add_mesh(wood), pivot);
        const int foliage = level.add_instance(leaves.name, level.add_mesh(leaves), hub);
        level.nodes[static_cast<size_t>(limb)].parent = root;
        level.nodes[static_cast<size_t>(foliage)].parent = limb;
        const float phase = random.range(0, 2 * kPi), heading = a + 1.57f;
        sway(level, wind, limb, random.range(0.5f, 0.9f), 1 + i % 2, phase, heading);
        sway(level, wind, foliage, random.range(1.4f, 2.4f), 2 + i % 2, phase + 0.8f, heading + 0.5f);
    }
    level.animations.push_back(std::move(wind));
}

}  // namespace tyndall::level
