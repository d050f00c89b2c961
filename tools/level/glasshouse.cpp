// What is seen through: a glasshouse against the east wall of the lower yard, a basin with water, and a smoking
// brazier.
#include "tools/level/parts.h"
#include "tools/modeling/shapes.h"

namespace tyndall::level {

namespace {

using nlohmann::json;

constexpr float kFloor = -3.0f, kSill = kFloor + 0.5f, kPlate = kFloor + 2.3f;
constexpr float kFront = 9.4f, kWall = 12.2f, kNorth = 19.2f, kBay = 1.25f;
constexpr int kBays = 4;
constexpr float kSouth = kNorth + kBay * kBays, kRidge = kPlate + 0.95f;
// The yard's walls hide it all from farther away.
constexpr float kDrawDistance = 45.0f;

void seen_near(Level& level, int node) {
    level.nodes[static_cast<size_t>(node)].extras["draw_distance"] = kDrawDistance;
}

// A pane is a mesh of its own instance, so that panes are sorted one by one.
void pane(Level& level, const std::string& name, std::span<const vec3> corners) {
    Mesh m{name, {}, mat4(1.0f)};
    vec3 middle(0.0f);
    for (const vec3& c : corners) middle += c / static_cast<float>(corners.size());
    std::vector<vec3> local;
    for (const vec3& c : corners) local.push_back(c - middle);
    m.polygon(Mat::Glass, local);
    const int mesh = level.add_mesh(std::move(m));
    seen_near(level, level.add_instance(name, mesh, middle));
}

void frame(Level& level) {
    Mesh m{"glasshouse", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Rubble, {kFront - 0.14f, kFloor - 0.2f, kNorth - 0.14f},
                  {kFront + 0.14f, kSill, kSouth + 0.14f}, 0.03f);
    for (const float z : {kNorth, kSouth})
        chamfered_box(m, Mat::Rubble, {kFront + 0.1f, kFloor - 0.2f, z - 0.14f}, {kWall + 0.1f, kSill, z + 0.14f},
                      0.03f);
    for (int i = 0; i <= kBays; ++i) {
        const float z = kNorth + kBay * static_cast<float>(i);
        beam(m, Mat::Timber, {kFront, kSill - 0.02f, z}, {kFront, kPlate, z}, 0.09f, 0.09f, {0, 0, 1});
        beam(m, Mat::Timber, {kFront - 0.12f, kPlate + 0.02f, z}, {kWall, kRidge + 0.02f, z}, 0.07f, 0.09f);
    }
    beam(m, Mat::Timber, {kFront, kPlate, kNorth - 0.1f}, {kFront, kPlate, kSouth + 0.1f}, 0.11f, 0.09f);
    beam(m, Mat::Timber, {kFront, kSill + 0.02f, kNorth}, {kFront, kSill + 0.02f, kSouth}, 0.11f, 0.06f);
    beam(m, Mat::Iron, {kFront, 0.5f * (kSill + kPlate), kNorth}, {kFront, 0.5f * (kSill + kPlate), kSouth}, 0.025f,
         0.025f);
    beam(m, Mat::Timber, {kWall - 0.03f, kRidge, kNorth - 0.1f}, {kWall - 0.03f, kRidge, kSouth + 0.1f}, 0.1f,
         0.12f);
    level.add_static(std::move(m));
}

void glazing(Level& level) {
    const float mid = 0.5f * (kFront + kWall), mid_y = 0.5f * (kPlate + kRidge);
    for (int i = 0; i < kBays; ++i) {
        const float a = kNorth + kBay * static_cast<float>(i) + 0.04f, b = a + kBay - 0.08f;
        pane(level, "pane_front",
             std::array{vec3(kFront, kSill, a), vec3(kFront, kSill, b), vec3(kFront, kPlate, b),
                        vec3(kFront, kPlate, a)});
        for (const bool upper : {false, true}) {
            const vec3 low = upper ? vec3(mid, mid_y, 0) : vec3(kFront, kPlate, 0),
                       high = upper ? vec3(kWall, kRidge, 0) : vec3(mid, mid_y, 0);
            const vec3 za(0, 0.03f, a), zb(0, 0.03f, b);
            pane(level, "pane_roof", std::array{low + za, low + zb, high + zb, high + za});
        }
    }
    for (const float z : {kNorth, kSouth}) {
        std::vector<vec3> corners{{kFront, kSill, z}, {kWall, kSill, z}, {kWall, kRidge, z}, {kFront, kPlate, z}};
        if (z == kNorth) std::ranges::reverse(corners);
        pane(level, "pane_end", corners);
    }
}

void plants(Level& level, const Props& props) {
    level.add_instance("urn", props.urn, {10.15f, kFloor, 20.0f});
    level.add_instance("urn", props.urn, {10.2f, kFloor, 22.6f}, 70.0f, 0.85f);
    level.add_instance("bench", props.bench, {11.75f, kFloor, 21.4f}, 90.0f);
    for (const float z : {20.5f, 21.3f, 22.3f})
        level.add_instance("shrub", props.tuft, {11.6f, kFloor + 0.55f, z}, z * 77.0f, 0.55f);
    level.add_instance("shrub", props.tuft, {10.1f, kFloor + 0.12f, 21.3f}, 130.0f, 0.7f);
    level.add_instance("ivy", props.ivy, {12.19f, kFloor, 20.6f}, -90.0f, 0.6f);
}

void basin(Level& level, vec3 centre) {
    Mesh m{"basin", {}, mat4(1.0f)};
    const std::array<vec2, 9> stone{{{1.30f, -0.1f},
                                     {1.30f, 0.08f},
                                     {1.18f, 0.14f},
                                     {1.18f, 0.44f},
                                     {1.30f, 0.48f},
                                     {1.30f, 0.60f},
                                     {1.04f, 0.60f},
                                     {1.02f, 0.12f},
                                     {0.0f, 0.08f}}};
    lathe(m, Mat::Trim, vec3(0), stone, 24);
    const std::array<vec2, 5> pillar{{{0.16f, 0.05f}, {0.11f, 0.3f}, {0.11f, 0.85f}, {0.30f, 1.02f}, {0.0f, 1.0f}}};
    lathe(m, Mat::Trim, vec3(0), pillar, 12);
    level.add_instance("basin", level.add_mesh(std::move(m)), centre);
    Mesh water{"basin_water", {}, mat4(1.0f)};
    const std::array<vec2, 2> disc{{{1.035f, 0.48f}, {0.09f, 0.48f}}};
    lathe(water, Mat::Pond, vec3(0), disc, 24);
    seen_near(level, level.add_instance("basin_water", level.add_mesh(std::move(water)), centre));
}

void emitter(Level& level, const std::string& name, vec3 at, json particles) {
    Node node;
    node.name = name;
    node.translation = at;
    node.extras["particles"] = std::move(particles);
    seen_near(level, level.add_node(std::move(node)));
}

void smoke(Level& level, vec3 embers) {
    emitter(level, "smoke", embers,
            {{"count", 90},
             {"lifetime", 5.0},
             {"size", 0.16},
             {"growth", 0.12},
             {"extent", {0.2, 0.03, 0.2}},
             {"velocity", {0.0, 0.62, 0.0}},
             {"acceleration", {0.05, -0.02, -0.05}},
             {"spread", 0.11},
             {"color", {0.75, 0.73, 0.71}},
             {"opacity", 0.27},
             {"seed", 3}});
    emitter(level, "sparks", embers,
            {{"count", 26},
             {"lifetime", 1.3},
             {"size", 0.014},
             {"extent", {0.22, 0.02, 0.22}},
             {"velocity", {0.0, 1.1, 0.0}},
             {"acceleration", {0.1, -0.3, -0.1}},
             {"spread", 0.35},
             {"color", {0.0, 0.0, 0.0}},
             {"opacity", 1.0},
             {"emission", {900.0, 330.0, 70.0}},
             {"seed", 4}});
}

}  // namespace

void add_glasshouse(Level& level, const Lamps& lamps, const Props& props) {
    frame(level);
    glazing(level);
    plants(level, props);
    basin(level, {5.9f, kFloor, 22.6f});
    const vec3 foot{7.3f, kFloor, 25.0f};
    brazier(level, lamps, foot, 90.0f);
    smoke(level, foot + vec3(0, 0.95f, 0));
}

}  // namespace tyndall::level
