#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "shaders/shared/shadows.h"
#include "support/shadow_rig.h"

namespace tyndall {
namespace {

using Point = ShadowRig::Point;
using Lookup = ShadowRig::Lookup;

constexpr float degree = 0.0174532925f;

glm::vec3 sun_at(float elevation, float azimuth) {
    return -glm::vec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                      std::cos(elevation) * std::cos(azimuth));
}

Scene with_sun(std::span<const TestBox> boxes, glm::vec3 direction) {
    Scene scene = box_scene(boxes);
    Light sun;
    sun.type = LightType::sun;
    add_light(scene, sun, {0, 0, 0}, direction);
    return scene;
}

// Side of a texel of the map that serves a point.
float texel_at(const ShadowRig& rig, float view_depth) {
    for (int i = 0; i < SUN_CASCADES; ++i)
        if (view_depth < rig.data.sun_cascade_far[i]) return rig.data.sun_texel[i];
    return rig.data.sun_static_texel.x;
}

// Analytic visibility of the sun; nothing where the answer changes within `radius` (m) across the light. A
// neighbour in the shadow may start inside a box it stands on: for it, only casters that are farther away than that
// count.
std::optional<bool> sees_sun(std::span<const TestBox> casters, glm::vec3 p, glm::vec3 direction, float radius) {
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(direction));
    const glm::dvec3 u = glm::normalize(glm::cross(to_sun, glm::dvec3(0.3, 0.2, 0.9))), v = glm::cross(to_sun, u);
    const auto lit = [&](glm::dvec3 q, double skip) {
        return !blocked(casters, q + to_sun * skip, q + to_sun * 500.0);
    };
    const bool center = lit(p, 1e-4);
    for (int i = 0; i < 96; ++i) {
        const double a = i * 0.1963495, r = radius * (1 + i / 32) / 3.0;
        if (lit(glm::dvec3(p) + r * (std::cos(a) * u + std::sin(a) * v), center ? 1e-4 : 4 * r) != center)
            return std::nullopt;
    }
    return center;
}

bool inside(std::span<const TestBox> boxes, glm::vec3 p, float margin) {
    return std::ranges::any_of(boxes, [&](const TestBox& box) {
        return glm::all(glm::greaterThan(p, box.min - margin)) && glm::all(glm::lessThan(p, box.max + margin));
    });
}

const TestBox ground{{-40, -1, -40}, {40, 0, 40}};
const std::vector<TestBox> court{ground,
                                 {{-1, 0, -1}, {1, 2, 1}},
                                 {{3, 0, -6}, {3.3f, 4, 2}},
                                 {{-6, 3, -8}, {-2, 3.4f, -3}},
                                 {{-12, 0, -30}, {-8, 9, -26}},
                                 {{5, 5, -14}, {11, 5.3f, -8}}};

class ShadowSun : public GlTest {};

// 10,000 points in the air of the view against rays through boxes.
TEST_F(ShadowSun, VolumeLookupAgreesWithRaysThroughBoxes) {
    const glm::vec3 direction = sun_at(25 * degree, 0.7f);
    ShadowRig rig(with_sun(court, direction));
    rig.view = look_at({0, 3, 12}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    std::mt19937 random(11);
    std::uniform_real_distribution<float> u(0, 1);
    std::vector<Point> points;
    std::vector<bool> expected;
    int tried = 0;
    while (points.size() < 10000) {
        const glm::vec3 p =
            glm::mix(glm::vec3(-15, 0, -42), glm::vec3(12, 6, 6), glm::vec3(u(random), u(random), u(random)));
        const glm::vec4 clip = rig.view.view_projection * glm::vec4(p, 1);
        const float depth = rig.view_depth(p);  // to 54 m: beyond the cascades
        if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
        const float texel = texel_at(rig, depth);
        if (inside(court, p, texel)) continue;
        ++tried;
        const auto lit = sees_sun(court, p, direction, 1.5f * texel);
        if (!lit) continue;
        points.push_back({p, depth});
        expected.push_back(*lit);
    }
    EXPECT_LT(tried, 14000) << "most points are away from edges";
    EXPECT_GT(std::ranges::count(expected, false), 500);
    const std::vector<float> values = rig.look_up(Lookup::sun_volume, points);
    int right = 0;
    for (std::size_t i = 0; i < values.size(); ++i) right += (values[i] > 0.5f) == expected[i];
    RecordProperty("agreement", std::to_string(right / 10000.0));
    EXPECT_GT(right, 9950);
}

// Every face that is lit, at grazing light from several sides: no acne. In the shadow: no light.
TEST_F(ShadowSun, SurfacesAtLowSunHaveNoAcneAndFullShadow) {
    for (const float azimuth : {0.0f, 0.4f, 0.785398f, 2.2f, 4.0f}) {
        const glm::vec3 direction = sun_at(15 * degree, azimuth);
        ShadowRig rig(with_sun(court, direction));
        rig.view = look_at({0, 3, 12}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
        rig.frame();
        std::vector<Point> points;
        std::vector<bool> expected;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> u(0, 1);
        while (points.size() < 6000) {
            const std::size_t own = random() % 2 == 0 ? 0 : random() % court.size();
            const int axis = own == 0 ? 1 : static_cast<int>(random() % 3);
            glm::vec3 normal(0);
            normal[axis] = own == 0 || random() % 2 == 0 ? 1.0f : -1.0f;
            glm::vec3 world =
                glm::mix(glm::max(court[own].min, glm::vec3(-15, -1, -32)),
                         glm::min(court[own].max, glm::vec3(15, 9, 5)), glm::vec3(u(random), u(random), u(random)));
            world[axis] = normal[axis] > 0 ? court[own].max[axis] : court[own].min[axis];
            const glm::vec4 clip = rig.view.view_projection * glm::vec4(world, 1);
            if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
            if (glm::dot(normal, direction) > -0.05f || inside(court, world + 1e-3f * normal, 0)) continue;
            const float depth = rig.view_depth(world);
            const float texel = std::max(texel_at(rig, depth), texel_at(rig, depth / (1 - SUN_CASCADE_BLEND)));
            std::vector<TestBox> others = court;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(own));
            const auto lit = sees_sun(others, world, direction, 3.6f * texel);
            if (!lit) continue;
            points.push_back({world, depth, normal});
            expected.push_back(*lit);
        }
        const std::vector<float> values = rig.look_up(Lookup::sun_surface, points);
        int acne = 0, leaks = 0, lit = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            lit += expected[i];
            acne += expected[i] && values[i] < 0.99f;
            leaks += !expected[i] && values[i] > 0.01f;
        }
        EXPECT_GT(lit, 1000);
        EXPECT_LT(lit, 5850);
        EXPECT_EQ(acne, 0) << "azimuth " << azimuth;
        EXPECT_EQ(leaks, 0) << "azimuth " << azimuth;
    }
}

// Behind a box that stands on the plane, from its foot on: the shadow begins within two texels.
TEST_F(ShadowSun, ShadowTouchesItsCaster) {
    const std::vector<TestBox> boxes{ground, {{-1, 0, -1}, {1, 2, 1}}};
    ShadowRig rig(with_sun(boxes, sun_at(15 * degree, 0)));  // light travels towards -Z
    rig.view = look_at({4, 3, -8}, {0, 0, -2}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    std::vector<Point> points;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 p(-0.8f + 0.004f * float(i), 0, -1.001f - 0.0005f * float(i % 100));
        points.push_back({p, rig.view_depth(p)});
    }
    const float texel = texel_at(rig, points[0].view_depth);
    const std::vector<float> values = rig.look_up(Lookup::sun_surface, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (std::abs(points[i].world.x) < 1 - 2 * texel) {
            EXPECT_LT(values[i], 0.01f) << points[i].world.x << ' ' << points[i].world.z;
        }
}

TEST_F(ShadowSun, CastersFarTowardsTheSunReachTheNearestCascade) {
    const std::vector<TestBox> boxes{ground, {{-3, 60, -3}, {3, 61, 3}}};
    ShadowRig rig(with_sun(boxes, {0, -1, 0}));
    rig.view = look_at({0, 0.5f, 2}, {0, 0, 0}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    ASSERT_LT(2.5f, rig.data.sun_cascade_far[0]);
    const Point points[] = {{{0, 0.2f, 0}, 2.0f}, {{0, 0, 0.5f}, 1.5f}};
    for (const float v : rig.look_up(Lookup::sun_volume, points)) EXPECT_EQ(v, 0);
}

TEST_F(ShadowSun, StaticMapServesWhatLiesBeyondTheCascadesAndLeavesTheRestLit) {
    const std::vector<TestBox> boxes{ground, {{-4, 0, -34}, {4, 6, -30}}, {{10, 2, -34}, {14, 3, -30}, true}};
    ShadowRig rig(with_sun(boxes, {0, -1, 0}));
    rig.settings.cascade_distance = 20;
    rig.view = look_at({0, 2, 8}, {0, 1, -30}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    const Point points[] = {
        {{0, 1, -32}, 40},      // in the block
        {{7, 1, -32}, 40},      // beside it
        {{12, 1, -32}, 40},     // under the moving one: not in the static map
        {{0, -0.5f, 300}, 300}  // outside all maps
    };
    EXPECT_THAT(rig.look_up(Lookup::sun_volume, points), testing::ElementsAre(0, 1, 1, 1));
    EXPECT_THAT(rig.look_up(Lookup::sun_surface, points), testing::ElementsAre(0, 1, 1, 1));
    rig.settings.cascade_distance = 60;
    rig.frame();
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(points).subspan(2, 1))[0], 0) << "the cascades have it";
}

TEST_F(ShadowSun, MapsAreDrawnAgainOnlyWhenSomethingChanged) {
    std::vector<TestBox> boxes = court;
    boxes.push_back({{-3, 0.2f, 2}, {-2.5f, 0.7f, 2.5f}, true});
    ShadowRig rig(with_sun(boxes, sun_at(40 * degree, 0.5f)));
    rig.frame();
    EXPECT_EQ(rig.ran_with_prefix("shadow_sun/cascade"), SUN_CASCADES);
    EXPECT_TRUE(rig.ran("shadow_sun/static"));
    rig.frame();
    EXPECT_EQ(rig.ran_with_prefix("shadow_sun"), 0);
    EXPECT_EQ(rig.skip_reason("shadow_sun/cascade_2"), "unchanged since it was drawn");

    rig.scene.nodes[6].translation.x += 0.01f;  // the moving box
    rig.frame();
    const int seen = rig.ran_with_prefix("shadow_sun/cascade");
    EXPECT_GE(seen, 1);
    EXPECT_EQ(rig.sun.triangles_drawn(), 12u * static_cast<unsigned>(seen)) << "of the moving box alone";
    EXPECT_FALSE(rig.ran("shadow_sun/static"));

    const View first = rig.view;
    const auto redrawn_at = [&](float x) {
        rig.view = look_at({x, 2, 8}, {x, 1, 0}, 1.0f, 0.1f, 1.5f);
        rig.frame();
        return rig.ran_with_prefix("shadow_sun/cascade");
    };
    EXPECT_EQ(redrawn_at(8), SUN_CASCADES);
    EXPECT_FALSE(rig.ran("shadow_sun/static"));
    int redrawn = 0;
    for (int i = 1; i <= 100; ++i) redrawn += redrawn_at(8 + 0.01f * float(i));
    EXPECT_LT(redrawn, 40) << "of 400, on a way of 1 m";
    rig.view = first;
    rig.frame();

    rig.scene.nodes[7].rotation = glm::quatLookAt(glm::vec3(0, -1, 0), glm::vec3(0, 0, 1));  // the sun
    rig.frame();
    EXPECT_EQ(rig.ran_with_prefix("shadow_sun"), SUN_CASCADES + 1);

    // A moving caster that leaves takes its shadow along.
    const Point under{{-2.75f, 0.1f, 2.25f}, rig.view_depth({-2.75f, 0.1f, 2.25f})};
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(&under, 1))[0], 0);
    rig.scene.nodes[6].translation.y += 1000;
    rig.frame();
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(&under, 1))[0], 0) << "still above, however far";
    rig.scene.nodes[6].translation.x += 1000;
    rig.frame();
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(&under, 1))[0], 1);
}

TEST_F(ShadowSun, NothingRunsWithoutASunOrWithShadowsOff) {
    ShadowRig none(box_scene(court));
    none.frame();
    EXPECT_EQ(none.ran_with_prefix("shadow_sun"), 0);
    EXPECT_FALSE(none.sun_output.cascades);
    EXPECT_EQ(none.skip_reason("shadow_sun/static"), "no sun in the scene");

    ShadowRig off(with_sun(court, {0, -1, 0}));
    off.frame();
    EXPECT_TRUE(off.sun_output.cascades);
    off.settings.shadows = false;
    off.frame();
    EXPECT_EQ(off.ran_with_prefix("shadow_sun"), 0);
    EXPECT_FALSE(off.sun_output.cascades);
    EXPECT_EQ(off.skip_reason("shadow_sun/cascade_0"), "shadows are off");
    off.settings.shadows = true;
    off.frame();
    EXPECT_EQ(off.ran_with_prefix("shadow_sun"), SUN_CASCADES + 1);
}

TEST_F(ShadowSun, ASunThatCastsNoShadowLightsEverything) {
    ShadowRig rig(with_sun(court, {0, -1, 0}));
    const Point in_a_box{{0, 1, 0}, 8};
    rig.frame();
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(&in_a_box, 1))[0], 0);
    rig.scene.lights[0].shadow = false;
    rig.frame();
    EXPECT_EQ(rig.skip_reason("shadow_sun/static"), "the sun casts no shadow");
    EXPECT_EQ(rig.look_up(Lookup::sun_volume, std::span(&in_a_box, 1))[0], 1);
    EXPECT_EQ(rig.look_up(Lookup::sun_surface, std::span(&in_a_box, 1))[0], 1);
    EXPECT_EQ(rig.counted(Lookup::sun_surface, std::span(&in_a_box, 1)), 0u);
}

TEST_F(ShadowSun, MaskedMaterialsHaveHoles) {
    const std::vector<TestBox> boxes{ground, {{-2, 2, -2}, {2, 2.01f, 2}}};
    Scene scene = with_sun(boxes, {0, -1, 0});
    // Left half of the picture opaque, right half empty; the box's top has u along its second next axis.
    Picture picture{"mask", {2, 2}, {255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0}};
    scene.pictures.push_back(picture);
    Material masked;
    masked.alpha_mask = true;
    masked.base_color_picture = 0;
    scene.materials.push_back(masked);
    scene.meshes[1].material = 1;
    for (Vertex& v : scene.meshes[1].vertices) v.uv = {v.position.x > 0 ? 1.0f : 0.0f, 0.5f};
    ShadowRig rig(std::move(scene));
    rig.view = look_at({0, 1, 6}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    const Point points[] = {{{-0.6f, 1, 0}, 6}, {{0.6f, 1, 0}, 6}};
    EXPECT_THAT(rig.look_up(Lookup::sun_volume, points), testing::ElementsAre(0, 1));
}

TEST_F(ShadowSun, WithoutShadowsTheShaderHasNoSamplers) {
    const gl::Program program({{GL_COMPUTE_SHADER, shadow_shader("#define SHADOWS 0\n", R"(
layout(local_size_x = 1) in;
layout(std430, binding = 13) writeonly buffer Results { float results[]; };
void main() {
    results[0] = sun_shadow_surface(vec3(0.0), vec3(0.0), 1.0) + sun_shadow_volume(vec3(0.0), 1.0);
    results[1] = light_shadow_surface(light_data(0u), vec3(0.0), vec3(0.0)) + light_shadow_volume(light_data(0u), vec3(0.0));
})")}},
                              "shadows off");
    GLint uniforms = -1;
    glGetProgramInterfaceiv(program.id(), GL_UNIFORM, GL_ACTIVE_RESOURCES, &uniforms);
    for (GLint i = 0; i < uniforms; ++i) {
        const GLenum property = GL_TYPE;
        GLint type = 0;
        glGetProgramResourceiv(program.id(), GL_UNIFORM, static_cast<GLuint>(i), 1, &property, 1, nullptr, &type);
        EXPECT_NE(type, GL_SAMPLER_2D_SHADOW);
        EXPECT_NE(type, GL_SAMPLER_2D_ARRAY_SHADOW);
    }
}

TEST_F(ShadowSun, CountsEachLookup) {
    ShadowRig rig(with_sun(court, sun_at(40 * degree, 0.5f)));
    rig.view = look_at({0, 3, 12}, {0, 1, 0}, 1.0f, 0.1f, 1.5f);
    rig.frame();
    const float middle = 0.5f * rig.data.sun_cascade_far[1], end = 0.99f * rig.data.sun_cascade_far[1];
    const glm::mat4 to_world = glm::inverse(rig.view.view);
    const auto at = [&](float depth) { return Point{glm::vec3(to_world * glm::vec4(0, 0, -depth, 1)), depth}; };
    const std::vector<Point> plain(100, at(middle)), mixed(100, at(end));
    EXPECT_EQ(rig.counted(Lookup::sun_volume, plain), 0u) << "who asks counts";
    EXPECT_EQ(rig.counted(Lookup::sun_surface, plain), 400u);
    EXPECT_EQ(rig.counted(Lookup::sun_surface, mixed), 800u);
}

}  // namespace
}  // namespace tyndall
