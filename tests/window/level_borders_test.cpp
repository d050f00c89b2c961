// Nobody who walks leaves the level: somebody walks along all its borders, with a hand on the wall.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "sample_game/player.h"
#include "support/command.h"

namespace tyndall {
namespace {

constexpr double tick = 0.1;                             // s
constexpr float pixel = 0.0022f;                         // rad, of the pointer
constexpr float towards_the_wall = glm::radians(20.0f);  // turned each tick
constexpr float away_from_it = glm::radians(25.0f);      // turned until there is a way
constexpr float cell = 0.5f;                             // m
constexpr int ticks_of_known_ground = 40;                // after which the border is known
constexpr float stature = 1.65f;                         // m

/// The ground round the level, near it.
class Surroundings {
  public:
    explicit Surroundings(const Scene& level) {
        for (const Node& node : level.nodes)
            if (node.name == "terrain")
                for (const int mesh : node.meshes) add(level.meshes[static_cast<std::size_t>(mesh)], node.world);
    }
    [[nodiscard]] bool empty() const { return triangles_.empty(); }
    /// Of its ground under or over a point; far below where there is none.
    [[nodiscard]] float height(glm::vec2 p) const {
        float highest = -1e9f;
        for (const auto& [a, b, c] : triangles_) {
            const glm::vec2 u(b.x - a.x, b.z - a.z), v(c.x - a.x, c.z - a.z), w(p.x - a.x, p.y - a.z);
            const float area = u.x * v.y - u.y * v.x;
            const float s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
            if (s >= 0 && t >= 0 && s + t <= 1)
                highest = std::max(highest, a.y + s * (b.y - a.y) + t * (c.y - a.y));
        }
        return highest;
    }

  private:
    struct Triangle {
        glm::vec3 a, b, c;
    };
    void add(const Mesh& mesh, const glm::mat4& world) {
        const auto corner = [&](std::size_t i) {
            return glm::vec3(world * glm::vec4(mesh.vertices[mesh.indices[i]].position, 1));
        };
        const auto near = [](glm::vec3 p) { return p.x > -90 && p.x < 140 && p.z > -60 && p.z < 120; };
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            if (near(corner(i))) triangles_.push_back({corner(i), corner(i + 1), corner(i + 2)});
    }
    std::vector<Triangle> triangles_;
};

enum class Hand { right, left };

class BorderWalk {
  public:
    explicit BorderWalk(const Scene& level) : player_(level), surroundings_(level) {}

    /// From a place straight on to a border, and along it until nothing is new.
    void follow(glm::vec3 eye, float yaw, Hand hand, bool run) {
        const float turn = hand == Hand::right ? 1.0f : -1.0f;  // to the right yaw falls
        player_.set_flying(false);
        player_.place(eye, {-std::sin(yaw), 0, -std::cos(yaw)});
        for (int i = 0; i < 20; ++i) player_.update({}, tick, false);
        for (int i = 0; i < 200 && step(0, run); ++i) {
        }
        for (int known = 0; known < ticks_of_known_ground;) {
            bool moved = step(-turn * towards_the_wall, run);
            for (int i = 0; i < 15 && !moved; ++i) moved = step(turn * away_from_it, run);
            const glm::ivec3 c = glm::round(player_.eye() / cell);
            known = seen_.insert({c.x, c.y, c.z, hand}).second ? 0 : known + 1;
        }
    }
    std::vector<glm::vec3> outside;  ///< where the walker stood on the surroundings
    std::vector<glm::vec3> cuts;     ///< where he was when he was put back
    [[nodiscard]] bool came_near(glm::vec3 eye) const {
        for (const auto& [x, y, z, hand] : seen_)
            if (glm::distance(glm::vec3(x, y, z) * cell, eye) < 10) return true;
        return false;
    }
    [[nodiscard]] std::size_t cells() const { return seen_.size(); }
    [[nodiscard]] bool has_surroundings() const { return !surroundings_.empty(); }

  private:
    /// Turned by `angle` to the left. False where something is in the way.
    bool step(float angle, bool run) {
        Input input;
        input.keys_down[static_cast<std::size_t>(Key::w)] = true;
        input.keys_down[static_cast<std::size_t>(Key::shift)] = run;
        input.pointer_delta.x = -angle / pixel;
        const glm::vec3 before = player_.eye();
        if (player_.update(input, tick, true)) cuts.push_back(before);
        const glm::vec3 eye = player_.eye();
        if (player_.on_ground() && eye.y - stature < surroundings_.height({eye.x, eye.z}) + 0.05f)
            outside.push_back(eye);
        return glm::distance(eye, before) > 0.35f * (run ? 5.0f : 2.4f) * static_cast<float>(tick);
    }

    Player player_;
    Surroundings surroundings_;
    std::set<std::tuple<int, int, int, Hand>> seen_;
};

TEST(Level, NobodyWalksOutOfIt) {
    Scene level = load_gltf(test::level());
    animate(level, 0);
    std::vector<glm::vec3> starts{glm::vec3(level.find_node("player_start")->world[3]) + glm::vec3(0, stature, 0)};
    for (const char* place : {"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance", "Glass"})
        starts.emplace_back(level.nodes[static_cast<std::size_t>(level.find_camera(place)->node)].world[3]);
    BorderWalk walk(level);
    ASSERT_TRUE(walk.has_surroundings());
    for (const glm::vec3& start : starts) {
        walk.follow(start, 0, Hand::right, false);
        walk.follow(start, 0, Hand::left, true);
    }
    for (const glm::vec3& eye : walk.outside)
        ADD_FAILURE() << "outside, at " << eye.x << ", " << eye.y << ", " << eye.z;
    for (const glm::vec3& eye : walk.cuts)
        EXPECT_LT(eye.x, 95) << "the end of the street is open at " << eye.x << ", " << eye.y << ", " << eye.z;
    EXPECT_GT(walk.cells(), 1500u) << "the borders are longer";
    for (const glm::vec3& start : starts)
        EXPECT_TRUE(walk.came_near(start)) << start.x << ", " << start.y << ", " << start.z;
}

}  // namespace
}  // namespace tyndall
