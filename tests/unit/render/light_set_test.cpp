#include "engine/render/light_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/render/passes/cluster.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/light_reach.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

class Random {
  public:
    float between(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }
    glm::vec3 in_box(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
    glm::vec3 unit() {
        std::normal_distribution<float> normal;
        return glm::normalize(glm::vec3(normal(engine_), normal(engine_), normal(engine_)));
    }
    /// Of a ball around the origin, evenly.
    glm::vec3 in_ball(float radius) { return unit() * radius * std::cbrt(between(0, 1)); }

  private:
    std::mt19937 engine_{11};
};

/// The law of KHR_lights_punctual in its own words: angles, not scale and offset.
double spot_law(const shared::GpuLight& light, double angle) {
    const double x = std::cos(angle) * light.cone_shadow.x + light.cone_shadow.y;
    return std::pow(std::clamp(x, 0.0, 1.0), 2);
}

TEST(GpuLight, HoldsTheSpotLawOfTheFormat) {
    Light light;
    light.type = LightType::spot;
    light.range = 7;
    light.inner_cone = 0.3f;
    light.outer_cone = 0.6f;
    light.intensity = {1, 2, 3};
    const glm::mat4 world = glm::rotate(glm::translate(glm::mat4(1), {1, 2, 3}), glm::radians(90.0f), {0, 1, 0});
    const shared::GpuLight gpu = gpu_light(light, world, 5);
    EXPECT_EQ(gpu.position_range, glm::vec4(1, 2, 3, 7));
    EXPECT_EQ(gpu.intensity_radius, glm::vec4(1, 2, 3, 0.01f));
    // -Z turned by 90 degrees about Y is -X.
    EXPECT_NEAR(glm::distance(glm::vec3(gpu.direction_type), glm::vec3(-1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(gpu.cone_shadow.z, 5);
    EXPECT_NEAR(spot_law(gpu, 0.3), 1, 1e-5);
    EXPECT_NEAR(spot_law(gpu, 0.6), 0, 1e-5);
    const double middle = (std::cos(0.45) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    EXPECT_NEAR(spot_law(gpu, 0.45), middle * middle, 1e-5);
}

TEST(GpuLight, APointLampShinesAllAround) {
    Light light;
    light.range = 3;
    const shared::GpuLight gpu = gpu_light(light, glm::mat4(1), -1);
    for (const double angle : {0.0, 1.6, 3.14}) EXPECT_EQ(spot_law(gpu, angle), 1);
    EXPECT_EQ(gpu.cone_shadow.z, -1);
}

TEST(Lamps, AreListedInOrderAndKnowWhetherTheyAreInView) {
    Scene scene;
    const auto add = [&](LightType type, glm::vec3 position, float range, float intensity) {
        Node node;
        node.world = glm::translate(glm::mat4(1), position);
        scene.nodes.push_back(node);
        Light light;
        light.type = type;
        light.range = range;
        light.intensity = glm::vec3(intensity);
        light.node = static_cast<int>(scene.nodes.size()) - 1;
        scene.lights.push_back(light);
    };
    add(LightType::sun, {0, 0, 0}, 1, 1);
    add(LightType::point, {0, 0, -5}, 1, 1);   // ahead
    add(LightType::point, {0, 0, 5}, 1, 1);    // behind
    add(LightType::spot, {0, 0, 5}, 10, 1);    // behind, but it reaches into view
    add(LightType::point, {0, 0, -5}, 10, 0);  // dark
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 1.0f, 0.1f, 1.0f);
    const std::vector<Lamp> lamps = find_lamps(scene, Frustum::from(view.view_projection));
    const std::vector<std::pair<std::size_t, bool>> expected{{1, true}, {2, false}, {3, true}};
    ASSERT_EQ(lamps.size(), expected.size());
    for (std::size_t i = 0; i < lamps.size(); ++i)
        EXPECT_EQ(std::pair(lamps[i].light, lamps[i].in_view), expected[i]) << i;
    LightSet lights;
    lights.update(scene, lamps);
    EXPECT_EQ(lights.lights().size(), 3u);
    lights.set_shadow_tiles([](std::size_t light) { return static_cast<int>(10 * light); });
    EXPECT_EQ(lights.lights()[2].cone_shadow.z, 30);
}

shared::GpuLight random_spot(Random& random) {
    Light light;
    light.type = LightType::spot;
    light.range = random.between(0.5f, 8);
    light.outer_cone = random.between(0.05f, 1.57f);
    shared::GpuLight gpu = gpu_light(light, glm::translate(glm::mat4(1), random.in_box(5)), -1);
    gpu.direction_type = glm::vec4(random.unit(), LIGHT_SPOT);
    return gpu;
}

bool lit(const shared::GpuLight& light, glm::vec3 point) {
    const glm::vec3 to = point - glm::vec3(light.position_range);
    const float d = glm::length(to);
    if (d >= light.position_range.w) return false;
    const float cosine = glm::dot(to, glm::vec3(light.direction_type)) / d;
    return light.direction_type.w == LIGHT_POINT || cosine * light.cone_shadow.x + light.cone_shadow.y > 0;
}

TEST(LightReach, ASphereAroundASpotHoldsAllItLights) {
    Random random;
    for (int i = 0; i < 200; ++i) {
        const shared::GpuLight light = random_spot(random);
        const glm::vec4 sphere = reach(light);
        EXPECT_LE(sphere.w, light.position_range.w * 1.0001f);
        for (int k = 0; k < 200; ++k) {
            const glm::vec3 p = glm::vec3(light.position_range) + random.in_ball(light.position_range.w);
            EXPECT_TRUE(!lit(light, p) || glm::distance(p, glm::vec3(sphere)) <= sphere.w * 1.0001f);
        }
    }
}

TEST(LightReach, ASphereThatHoldsALitPointMeetsTheCone) {
    Random random;
    int met = 0, missed = 0;
    for (int i = 0; i < 20000; ++i) {
        const shared::GpuLight light = random_spot(random);
        const glm::vec3 apex(light.position_range), axis(light.direction_type);
        const glm::vec3 center = apex + random.in_box(12);
        const float radius = random.between(0.1f, 3);
        const bool meets = glsl::cone_meets_sphere(apex, axis, light.position_range.w,
                                                   glsl::cone_cosine(glm::vec2(light.cone_shadow)), center, radius);
        ++(meets ? met : missed);
        for (int k = 0; k < 20 && !meets; ++k) EXPECT_FALSE(lit(light, center + random.in_ball(radius)));
    }
    EXPECT_GT(met, 1000);
    EXPECT_GT(missed, 1000);
}

TEST(LightReach, ScreenBoundsHoldAllPointsOfASphereAndTouchIt) {
    Random random;
    const glm::vec2 tangents(1.1f, 0.6f);
    int bounded = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 center = random.in_box(6);
        const float radius = random.between(0.1f, 4);
        const glsl::ScreenBounds bounds = glsl::screen_bounds(center, radius, tangents);
        glm::vec2 lo(1e9f), hi(-1e9f);
        for (int k = 0; k < 4000; ++k) {
            const glm::vec3 p = center + random.unit() * radius;
            if (-p.z < 1e-3f) continue;
            const glm::vec2 ndc = glm::vec2(p) / (-p.z * tangents);
            lo = glm::min(lo, ndc);
            hi = glm::max(hi, ndc);
            EXPECT_LE(-p.z, bounds.far * 1.0001f);
            EXPECT_GE(-p.z, bounds.near - 1e-4f);
        }
        if (lo.x > hi.x) continue;
        const glm::vec2 slack = 1e-3f * (1.0f + glm::max(glm::abs(lo), glm::abs(hi)));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.lo, lo + slack)));
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.hi, hi - slack)));
        if (-center.z > 1.5f * radius) {  // wholly ahead: the bounds are tight
            ++bounded;
            const glm::vec2 loose = 0.05f * (hi - lo);
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(bounds.lo, lo - loose)));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.hi, hi + loose)));
        }
    }
    EXPECT_GT(bounded, 50);
}

TEST(ClusterGrid, ALampAroundTheEyeMayBeInEveryCluster) {
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 1.0f, 0.1f, 1.5f);
    RenderSettings settings;
    shared::FrameData frame{};
    frame.view = view.view;
    frame.projection = view.projection;
    set_cluster_grid(frame, settings, view.znear, 1);
    Light light;
    light.range = 10000;
    const shared::GpuLight all = gpu_light(light, glm::mat4(1), -1);
    EXPECT_EQ(cluster_list_bound(frame, std::span(&all, 1)), 16u * 9 * 24);
    light.range = 1;
    const shared::GpuLight behind = gpu_light(light, glm::translate(glm::mat4(1), {0, 0, 3}), -1);
    EXPECT_EQ(cluster_list_bound(frame, std::span(&behind, 1)), 0u);
}

}  // namespace
}  // namespace tyndall
