#include "tools/level/check.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tools/level/ray_scene.h"
#include "tools/modeling/check.h"

namespace tyndall::level {

namespace {

constexpr size_t kTriangleBudget = 180'000, kByteBudget = 12'000'000;
constexpr int kLampsInView = 200;

std::string number(float x) {
    const std::string s = std::to_string(std::round(x * 100.0f) / 100.0f);
    return s.substr(0, s.find('.') + 3);
}

struct Checker {
    const Level& level;
    const MaterialSet& materials;
    std::vector<std::string> failures{};
    std::string report{};

    void expect(bool good, const std::string& what) {
        if (!good) failures.push_back(what);
    }
    const Node* node(const std::string& name) const {
        const auto it = std::ranges::find(level.nodes, name, &Node::name);
        return it == level.nodes.end() ? nullptr : &*it;
    }
    bool is_lamp(const Node& n) const {
        return n.light >= 0 && level.lights[static_cast<size_t>(n.light)].type != Light::Type::Sun;
    }

    void budget(size_t bytes) {
        const size_t triangles = level.triangles();
        report += "triangles " + std::to_string(triangles) + ", bytes " + std::to_string(bytes) + ", lamps " +
                  std::to_string(level.lights.size() - 1) + ", materials " +
                  std::to_string(materials.materials.size()) + "\n";
        expect(triangles <= kTriangleBudget,
               "triangles: " + std::to_string(triangles) + ", allowed " + std::to_string(kTriangleBudget));
        expect(bytes <= kByteBudget,
               "file size: " + std::to_string(bytes) + " bytes, allowed " + std::to_string(kByteBudget));
        expect(materials.materials.size() <= 26,
               "materials: " + std::to_string(materials.materials.size()) + ", allowed 26");
        const size_t lamps = level.lights.size() - 1;
        expect(lamps >= 250 && lamps <= 400, "lamps: " + std::to_string(lamps) + ", expected 250 to 400");
    }

    void names() {
        for (const char* name :
             {"LocalPM", "Close", "LocalLights", "Sun", "Depth", "Balance", "Glass", "flythrough"}) {
            const Node* n = node(name);
            expect(n && n->camera >= 0 && level.cameras[static_cast<size_t>(n->camera)].name == name,
                   std::string("camera missing: ") + name);
        }
        expect(node("player_start") != nullptr, "node missing: player_start");
        for (const char* name : {"wind", "flythrough"}) {
            expect(std::ranges::count(level.animations, name, &Animation::name) == 1,
                   std::string("animation missing: ") + name);
        }
    }

    void sun() {
        int suns = 0;
        for (const Node& n : level.nodes) {
            if (n.light < 0 || is_lamp(n)) continue;
            ++suns;
            const float elevation = std::asin((n.rotation * vec3(0, 0, 1)).y) * 57.29578f;
            expect(elevation >= 12.0f && elevation <= 18.0f,
                   "sun: elevation " + number(elevation) + " degrees, expected 12 to 18");
            expect(glm::distance(n.rotation * vec3(0, 0, 1), to_sun()) < 1e-4f,
                   "sun: its node does not point along to_sun()");
        }
        expect(suns == 1, "suns: " + std::to_string(suns) + ", expected 1");
    }

    void wind() {
        for (const Animation& a : level.animations) {
            for (const Channel& c : a.channels) {
                if (a.name == "wind")
                    expect(c.values.front() == c.values.back(), "animation wind: last key differs from the first");
            }
        }
    }

    void lamps(const RayScene& solid) {
        const Node* camera = node("LocalLights");
        const float tan_half = std::tan(level.cameras[static_cast<size_t>(camera->camera)].yfov / 2);
        int in_view = 0, seen = 0, shadowed = 0;
        float farthest = 0.0f;
        for (const Node& n : level.nodes) {
            if (!is_lamp(n)) continue;
            const float gap = solid.distance(n.translation, 5.0f);
            expect(gap <= 0.6f, "lamp " + n.name + ": floats " + number(gap) + " m from anything");
            expect(gap >= 0.02f, "lamp " + n.name + ": sits in a solid");
            const vec3 p = glm::conjugate(camera->rotation) * (n.translation - camera->translation);
            if (p.z > -0.1f || std::abs(p.y) > -p.z * tan_half || std::abs(p.x) > -p.z * tan_half * 16.0f / 9.0f)
                continue;
            ++in_view;
            farthest = std::max(farthest, -p.z);
            shadowed += level.lights[static_cast<size_t>(n.light)].shadow ? 1 : 0;
            seen += solid.blocked(camera->translation, n.translation) ? 0 : 1;
        }
        report += "LocalLights: " + std::to_string(in_view) + " lamps in the frustum, " + std::to_string(shadowed) +
                  " with shadows, " + std::to_string(seen) + " in line of sight, farthest " + number(farthest) +
                  " m\n";
        expect(in_view >= kLampsInView, "LocalLights: " + std::to_string(in_view) + " lamps in view, expected " +
                                            std::to_string(kLampsInView));
        expect(shadowed * 2 > in_view, "LocalLights: only " + std::to_string(shadowed) + " lamps with shadows");
    }

    void path(const RayScene& all) {
        const auto it = std::ranges::find(level.animations, "flythrough", &Animation::name);
        const Channel *move = nullptr, *turn = nullptr;
        for (const Channel& c : it->channels) (c.rotation ? turn : move) = &c;
        for (size_t i = 0; i < move->times.size(); ++i) {
            const vec3 p(move->values[i]);
            const float room = all.distance(p, 0.35f);
            const std::string when = "flythrough at " + number(move->times[i]) + " s: ";
            expect(room >= 0.25f, when + "only " + number(room) + " m from a surface");
            if (i > 0) expect(!all.blocked(vec3(move->values[i - 1]), p), when + "passes through a surface");
        }
        for (const auto& place : it->extras["places"]) {
            const auto name = place["name"].get<std::string>();
            const Node* camera = node(name);
            const auto key = static_cast<size_t>(std::lround(place["time"].get<float>() * 10.0f));
            const vec4 q = turn->values[key];
            const bool same = glm::distance(vec3(move->values[key]), camera->translation) < 1e-3f &&
                              std::abs(glm::dot(quat(q.w, q.x, q.y, q.z), camera->rotation)) > 0.99999f;
            expect(same, "flythrough: not at camera " + name + " at " + number(move->times[key]) + " s");
        }
        expect(it->extras["places"].size() == 6, "flythrough: does not list six places");
        const Node* start = node("player_start");
        expect(all.distance(start->translation, 1.0f) < 0.2f, "player_start: not on a floor");
        expect(!all.blocked(start->translation + vec3(0, 0.3f, 0), start->translation + vec3(0, 2.0f, 0)),
               "player_start: no room to stand");
    }
};

}  // namespace

std::vector<std::string> check_level(const Level& level, const MaterialSet& materials, size_t file_bytes,
                                     std::string& report) {
    Checker c{level, materials};
    c.failures = modeling::check_scene(level);
    c.budget(file_bytes);
    c.names();
    if (c.failures.empty()) {
        c.sun();
        c.wind();
        c.lamps(RayScene(level, materials, false));
        c.path(RayScene(level, materials, true));
    }
    report = c.report;
    return c.failures;
}

}  // namespace tyndall::level
