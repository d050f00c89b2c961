
#include <algorithm>
#include <random>
#include <set>

#include "support/shadow_rig.h"

namespace tyndall {
namespace {

using Point = ShadowRig::Point;
using Lookup = ShadowRig::Lookup;

Light lamp(LightType type, float range) {
    Light light;
    light.type = type;
    light.range = range;
    light.radius = 0.05f;
    light.outer_cone = 0.7f;
    return light;
}

// The room's inner side is the box from -4 to 4 by 0 to 6; walls are 0.3 m thick.
std::vector<TestBox> room() {
    return {{{-4.3f, -0.3f, -4.3f}, {4.3f, 0, 4.3f}},
            {{-4.3f, 6, -4.3f}, {4.3f, 6.3f, 4.3f}},
            {{-4.3f, 0, -4.3f}, {-4, 6, 4.3f}},
            {{4, 0, -4.3f}, {4.3f, 6, 4.3f}},
            {{-4, 0, -4.3f}, {4, 6, -4}},
            {{-4, 0, 4}, {4, 6, 4.3f}}};
}

// The same with a window of 1 m by 1 m in the wall at x = 4.
std::vector<TestBox> room_with_window() {
    auto boxes = room();
    boxes[3] = {{4, 0, -4.3f}, {4.3f, 2.5f, 4.3f}};
    boxes.push_back({{4, 3.5f, -4.3f}, {4.3f, 6, 4.3f}});
    boxes.push_back({{4, 2.5f, -4.3f}, {4.3f, 3.5f, -0.5f}});
    boxes.push_back({{4, 2.5f, 0.5f}, {4.3f, 3.5f, 4.3f}});
    return boxes;
}

// Analytic visibility of a lamp; nothing where the answer changes within `radius` (m).
std::optional<bool> sees(std::span<const TestBox> boxes, glm::dvec3 p, glm::dvec3 lamp_position, double radius) {
    const glm::dvec3 to_lamp = glm::normalize(lamp_position - p);
    const glm::dvec3 u = glm::normalize(glm::cross(to_lamp, glm::dvec3(0.3, 0.2, 0.9))), v = glm::cross(to_lamp, u);
    const bool center = !blocked(boxes, p, lamp_position);
    for (int i = 0; i < 64; ++i) {
        const double a = i * 0.1963495, r = radius * (1 + i / 32) / 2;
        if (!blocked(boxes, p + r * (std::cos(a) * u + std::sin(a) * v), lamp_position) != center)
            return std::nullopt;
    }
    return center;
}

bool inside(std::span<const TestBox> boxes, glm::vec3 p, float margin) {
    return std::ranges::any_of(boxes, [&](const TestBox& box) {
        return glm::all(glm::greaterThan(p, box.min - margin)) && glm::all(glm::lessThan(p, box.max + margin));
    });
}

class ShadowAtlas : public GlTest {};

struct Agreement {
    int right = 0, dark = 0, leaks = 0;
};

// 10,000 points in the air of a box round the origin, within the lamp's reach.
Agreement volume_agreement(ShadowRig& rig, std::span<const TestBox> boxes, std::size_t light_index, int tile_size) {
    const Light& light = rig.scene.lights[light_index];
    const glm::mat4 pose = rig.scene.nodes[static_cast<std::size_t>(light.node)].world;
    const glm::vec3 position(pose[3]);
    const bool spot = light.type == LightType::spot;
    const float texel_at_1m = 2.1f * (spot ? std::tan(light.outer_cone) : 1.0f) / static_cast<float>(tile_size);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<Point> points;
    std::vector<bool> expected;
    while (points.size() < 10000) {
        const glm::vec3 p = glm::vec3(9 * u(random), 3 + 5 * u(random), 9 * u(random));
        const float distance = glm::distance(p, position);
        const float texel = texel_at_1m * distance * 1.5f;  // a texel's diagonal, towards the corner of a face
        if (distance > light.range || distance < 0.2f || inside(boxes, p, texel)) continue;
        if (spot && glm::dot(glm::normalize(p - position), -glm::vec3(pose[2])) < std::cos(light.outer_cone))
            continue;
        const auto lit = sees(boxes, p, position, 1.5f * texel);
        if (!lit) continue;
        points.push_back({p, 0, {0, 1, 0}, static_cast<float>(light_index)});
        expected.push_back(*lit);
    }
    const std::vector<float> values = rig.look_up(Lookup::light_volume, points);
    Agreement result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        result.right += (values[i] > 0.5f) == expected[i];
        result.dark += !expected[i];
        result.leaks += !expected[i] && values[i] > 0.01f;
    }
    return result;
}

// The only light outside is what the window lets through; thin walls and the room's edges do not leak.
TEST_F(ShadowAtlas, PointLightInARoomWithAWindowAgreesWithRays) {
    const auto boxes = room_with_window();
    Scene scene = box_scene(boxes);
    add_light(scene, lamp(LightType::point, 20), {0.3f, 3.1f, -0.2f}, {0, 0, -1});
    ShadowRig rig(std::move(scene));
    rig.frame();
    const Agreement found = volume_agreement(rig, boxes, 0, 256);
    EXPECT_GT(found.dark, 3000);
    EXPECT_LT(found.dark, 9000);
    RecordProperty("agreement", std::to_string(found.right / 10000.0));
    EXPECT_GT(found.right, 9950);
    EXPECT_LT(found.leaks, 20);
}

TEST_F(ShadowAtlas, SpotAgreesWithRays) {
    const std::vector<TestBox> boxes{
        {{-9, -1, -9}, {9, 0, 9}}, {{-2, 2, -1}, {1, 2.2f, 2}}, {{2, 0, -3}, {2.4f, 3, 3}}};
    Scene scene = box_scene(boxes);
    add_light(scene, lamp(LightType::spot, 20), {-1, 7, 0.5f}, {0.3f, -1, 0.1f});
    ShadowRig rig(std::move(scene));
    rig.frame();
    const Agreement found = volume_agreement(rig, boxes, 0, 256);
    EXPECT_GT(found.dark, 1000);
    RecordProperty("agreement", std::to_string(found.right / 10000.0));
    EXPECT_GT(found.right, 9950);
}

// All inner walls see the lamp, over the seams of the cube's faces and into the corners.
TEST_F(ShadowAtlas, LitWallsHaveNeitherAcneNorSeams) {
    for (const int size : {32, 64, 256}) {
        Scene scene = box_scene(room());
        add_light(scene, lamp(LightType::point, 30), {1.3f, 2.1f, -0.7f}, {0, 0, -1});
        ShadowRig rig(std::move(scene));
        rig.settings.tile_size_max = size;
        rig.view = look_at({0, 3, 0}, {1, 3, 0}, 1.0f, 0.1f, 1.5f);
        rig.frame();
        std::mt19937 random(9);
        std::uniform_real_distribution<float> u(0, 1);
        std::vector<Point> points;
        const glm::vec3 low(-4, 0, -4), high(4, 6, 4);
        for (int i = 0; i < 20000; ++i) {
            const int axis = i % 3;
            glm::vec3 p = glm::mix(low, high, glm::vec3(u(random), u(random), u(random))), normal(0);
            normal[axis] = i % 2 == 0 ? 1.0f : -1.0f;
            p[axis] = i % 2 == 0 ? low[axis] : high[axis];
            points.push_back({p, 0, normal, 0});
        }
        const std::vector<float> values = rig.look_up(Lookup::light_surface, points);
        // Within a texel of a room's edge the filter meets the other wall, which is a little nearer to the lamp.
        const float texel = 2.0f * 5.3f / static_cast<float>(size - 4);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 room_for =
                glm::min(points[i].world - low, high - points[i].world) + glm::abs(points[i].normal) * 9.0f;
            const bool at_edge = std::min({room_for.x, room_for.y, room_for.z}) < texel;
            ASSERT_GT(values[i], at_edge ? 0.45f : 0.99f) << "tile size " << size << ", " << points[i].world.x
                                                          << ' ' << points[i].world.y << ' ' << points[i].world.z;
        }
    }
}

// On the ground outside and on the outer walls there is no light at all, up to the walls' feet.
TEST_F(ShadowAtlas, ThinWallsDoNotLeak) {
    auto boxes = room();
    boxes.push_back({{-12, -0.6f, -12}, {12, -0.3f, 12}});
    Scene scene = box_scene(boxes);
    add_light(scene, lamp(LightType::point, 30), {3, 1, -3}, {0, 0, -1});
    ShadowRig rig(std::move(scene));
    rig.frame();
    std::vector<Point> points;
    std::mt19937 random(4);
    std::uniform_real_distribution<float> u(-12, 12);
    while (points.size() < 10000) {
        const glm::vec3 p(u(random), -0.3f, u(random));
        if (std::max(std::abs(p.x), std::abs(p.z)) > 4.3f) points.push_back({p, 0, {0, 1, 0}, 0});
    }
    for (int i = 0; i < 5000; ++i)  // just outside the walls
        points.push_back({{4.301f, 3 + 0.24f * u(random), 0.35f * u(random)}, 0, {1, 0, 0}, 0});
    const std::vector<float> values = rig.look_up(Lookup::light_surface, points);
    EXPECT_EQ(std::ranges::count_if(values, [](float v) { return v > 0.01f; }), 0);
}

TEST_F(ShadowAtlas, StaticSceneDrawsNothingInTheSecondFrame) {
    Scene scene = box_scene(room());
    for (int i = 0; i < 5; ++i) add_light(scene, lamp(LightType::point, 8), {i - 2, 3, 0}, {0, 0, -1});
    add_light(scene, lamp(LightType::spot, 8), {0, 5, 0}, {0, -1, 0.1f});
    ShadowRig rig(std::move(scene));
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 31);
    EXPECT_TRUE(rig.ran("shadow_atlas"));
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 0);
    EXPECT_FALSE(rig.ran("shadow_atlas"));
    EXPECT_EQ(rig.skip_reason("shadow_atlas"), "unchanged since it was drawn");
    for (int step = 1; step <= 20; ++step) {  // a tiny camera move
        rig.view = look_at({0.002f * float(step), 2, 8}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
        rig.frame();
        EXPECT_EQ(rig.atlas.tiles_drawn(), 0);
    }
}

TEST_F(ShadowAtlas, OnlyTilesThatSeeTheChangeAreDrawn) {
    auto boxes = room();
    boxes.push_back({{2, 2.9f, -0.1f}, {2.2f, 3.1f, 0.1f}, true});
    Scene scene = box_scene(boxes);
    add_light(scene, lamp(LightType::point, 6), {0, 3, 0}, {0, 0, -1});
    add_light(scene, lamp(LightType::spot, 6), {-3, 5, 0}, {0, -1, 0});
    ShadowRig rig(std::move(scene));
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 7);
    const Point behind{{3, 3, 0}, 0, {0, 1, 0}, 0};
    EXPECT_EQ(rig.look_up(Lookup::light_volume, std::span(&behind, 1))[0], 0);

    rig.scene.nodes[6].translation.y = 0.2f;  // still before the +X face only
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 1);
    EXPECT_EQ(rig.atlas.triangles_drawn(), 12u) << "of the moving box alone";
    rig.scene.nodes[6].translation.y = 100;  // gone: its last shadow must go, too
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 1);
    EXPECT_EQ(rig.atlas.triangles_drawn(), 0u);
    EXPECT_EQ(rig.look_up(Lookup::light_volume, std::span(&behind, 1))[0], 1);

    rig.scene.nodes[7].translation.x = 0.1f;  // the point light
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 6);
    rig.scene.lights[1].outer_cone = 0.5f;  // the spot
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 1);
}

TEST_F(ShadowAtlas, LightsOutOfViewKeepTheirTilesWhileThereIsRoom) {
    Scene scene = box_scene(room());
    add_light(scene, lamp(LightType::point, 8), {-1, 3, 0}, {0, 0, -1});
    add_light(scene, lamp(LightType::spot, 8), {1, 3, 0}, {0, -1, 0.1f});
    ShadowRig rig(std::move(scene));
    rig.frame();
    const std::size_t first[] = {0};
    rig.frame(first);
    EXPECT_EQ(rig.atlas.tiles_drawn(), 0);
    rig.frame({});
    EXPECT_EQ(rig.skip_reason("shadow_atlas"), "no shadow-casting lamp in view");
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 0) << "both came back to tiles that are still theirs";
}

// 64 point lights in an atlas of 512² (341 places of 16² for one face each of them would take 384): all shrink, all
// fit, and no two tiles overlap: each light sees its own surroundings, whose shadow differs from light to light.
TEST_F(ShadowAtlas, FullAtlasShrinksTilesUntilAllLightsFit) {
    std::vector<TestBox> boxes;
    Scene scene;
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 center(3 * (i % 8), 1, -3 * (i / 8));
        glm::vec3 offset(0);  // an occluder on another side of each
        offset[(i % 6) / 2] = i % 2 == 0 ? 0.8f : -0.8f;
        boxes.push_back({center + offset - 0.25f, center + offset + 0.25f});
    }
    scene = box_scene(boxes);
    for (int i = 0; i < 64; ++i)
        add_light(scene, lamp(LightType::point, 1.5f), {3 * (i % 8), 1, -3 * (i / 8)}, {0, 0, -1});
    ShadowRig rig(std::move(scene));
    rig.settings.atlas_size = 512;
    rig.view = look_at({10, 4, 6}, {10, 0, -10}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    EXPECT_EQ(rig.atlas.tiles_drawn(), 384);
    std::vector<Point> points;
    std::set<int> firsts;
    for (int i = 0; i < 64; ++i) {
        ASSERT_GE(rig.atlas.first_tile(static_cast<std::size_t>(i)), 0);
        firsts.insert(rig.atlas.first_tile(static_cast<std::size_t>(i)));
        for (int side = 0; side < 6; ++side) {
            glm::vec3 offset(0);
            offset[side / 2] = side % 2 == 0 ? 1.3f : -1.3f;
            points.push_back({glm::vec3(3 * (i % 8), 1, -3 * (i / 8)) + offset, 0, {0, 1, 0}, float(i)});
        }
    }
    EXPECT_EQ(firsts.size(), 64u);
    const std::vector<float> values = rig.look_up(Lookup::light_volume, points);
    for (int i = 0; i < 64; ++i)
        for (int side = 0; side < 6; ++side)
            EXPECT_EQ(values[static_cast<std::size_t>(6 * i + side)], side == i % 6 ? 0 : 1) << i << ' ' << side;
}

// Fly past many lights in a small atlas: whatever is shrunk, moved and packed anew, every light in view has a
// shadow.
TEST_F(ShadowAtlas, EveryLightInViewHasTilesAlongAFlight) {
    std::vector<TestBox> boxes{{{-10, -1, -200}, {10, 0, 10}}};
    for (int i = 0; i < 60; ++i) {
        const float side = i % 2 == 0 ? 2.0f : -2.0f;
        boxes.push_back(
            {{side - 0.2f, 1.2f, -3.0f * float(i) - 0.2f}, {side + 0.2f, 1.4f, -3.0f * float(i) + 0.2f}});
    }
    Scene scene = box_scene(boxes);
    for (int i = 0; i < 60; ++i)
        add_light(scene, lamp(i % 3 == 0 ? LightType::spot : LightType::point, 5),
                  {i % 2 == 0 ? 2 : -2, 2, -3.0f * float(i)}, {0, -1, 0.01f});
    ShadowRig rig(std::move(scene));
    rig.settings.atlas_size = 512;
    int drawn = 0;
    for (int step = 0; step < 60; ++step) {
        const float z = 6 - 3.0f * float(step);
        rig.view = look_at({0, 2, z}, {0, 2, z - 10}, 1.0f, 0.1f, 1.5f);
        std::vector<std::size_t> in_view;
        std::vector<Point> points;
        for (std::size_t i = 0; i < 60; ++i)
            if (std::abs(-3.0f * float(i) - z + 25) < 25) {
                in_view.push_back(i);
                const glm::vec3 lamp_position(i % 2 == 0 ? 2 : -2, 2, -3.0f * float(i));
                points.push_back(
                    {lamp_position - glm::vec3(0, 1.5f, 0), 0, {0, 1, 0}, float(i)});  // behind its box
                points.push_back({lamp_position - glm::vec3(0, 0.4f, 0), 0, {0, 1, 0}, float(i)});  // before it
            }
        rig.frame(in_view);
        drawn += rig.atlas.tiles_drawn();
        const std::vector<float> values = rig.look_up(Lookup::light_volume, points);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(values[i], i % 2 == 0 ? 0 : 1) << "step " << step << ", light " << in_view[i / 2];
    }
    RecordProperty("tiles_per_frame", std::to_string(drawn / 60.0));
}

TEST_F(ShadowAtlas, NothingRunsWithoutALampThatCasts) {
    Scene scene = box_scene(room());
    Light light = lamp(LightType::point, 8);
    light.shadow = false;
    add_light(scene, light, {0, 3, 0}, {0, 0, -1});
    ShadowRig rig(std::move(scene));
    rig.frame();
    EXPECT_FALSE(rig.atlas_output.atlas);
    EXPECT_EQ(rig.atlas.first_tile(0), -1);
    EXPECT_EQ(rig.skip_reason("shadow_atlas"), "no lamp of the scene casts shadows");
    const Point outside{{6, 3, 0}, 0, {0, 1, 0}, 0};
    EXPECT_EQ(rig.look_up(Lookup::light_volume, std::span(&outside, 1))[0], 1);
    EXPECT_EQ(rig.counted(Lookup::light_surface, std::span(&outside, 1)), 0u);

    rig.scene.lights[0].shadow = true;
    rig.frame();
    EXPECT_EQ(rig.look_up(Lookup::light_volume, std::span(&outside, 1))[0], 0);
    EXPECT_EQ(rig.counted(Lookup::light_volume, std::span(&outside, 1)), 0u) << "who asks counts";
    EXPECT_EQ(rig.counted(Lookup::light_surface, std::span(&outside, 1)), 4u);
    rig.settings.shadows = false;
    rig.frame();
    EXPECT_FALSE(rig.atlas_output.atlas);
    EXPECT_EQ(rig.atlas.first_tile(0), -1);
}

}  // namespace
}  // namespace tyndall
