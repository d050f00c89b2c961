#include "engine/render/frame_facts.h"

#include <gtest/gtest.h>

namespace tyndall {
namespace {

// The camera stands at the origin, looks along -Z and sees 45 degrees to each side.
View camera() {
    return look_at(glm::vec3(0), glm::vec3(0, 0, -1), 1.5707963f, 0.1f, 1);
}

void add_light(Scene& scene, LightType type, glm::vec3 position, float range = 2, float intensity = 1) {
    Light light;
    light.type = type;
    light.range = range;
    light.intensity = glm::vec3(intensity);
    light.node = static_cast<int>(scene.nodes.size());
    Node node;
    node.world[3] = glm::vec4(position, 1);
    scene.nodes.push_back(node);
    scene.lights.push_back(light);
}

Medium fog(Medium::Shape shape, float sigma_s) {
    Medium medium;
    medium.shape = shape;
    medium.sigma_s = glm::vec3(sigma_s, 0, 0);
    return medium;
}

TEST(FrameFacts, AnEmptySceneHasAmbientLightOnly) {
    const FrameFacts facts = compute_facts({}, camera());
    EXPECT_TRUE(facts.has_ambient);
    EXPECT_FALSE(facts.has_sun || facts.has_medium());
    EXPECT_EQ(facts.local_lights_in_view, 0);
}

TEST(FrameFacts, SunsCountIfTheyShine) {
    Scene dark, bright;
    add_light(dark, LightType::sun, {}, 0, 0);
    add_light(bright, LightType::sun, {0, 0, 99}, 0, 1);
    EXPECT_FALSE(compute_facts(dark, camera()).has_sun);
    EXPECT_TRUE(compute_facts(bright, camera()).has_sun);
    EXPECT_EQ(compute_facts(bright, camera()).local_lights_in_view, 0);
}

// The brightest by luminance is the sun; what shines beside it are lamps, wherever one looks.
TEST(FrameFacts, FurtherSunsAreTheFirstLamps) {
    Scene scene;
    add_light(scene, LightType::point, {0, 0, -5});
    add_light(scene, LightType::sun, {}, 0, 0);
    add_light(scene, LightType::sun, {}, 0, 2);
    add_light(scene, LightType::sun, {}, 0, 3);
    scene.lights.back().intensity = {0, 0, 3};
    add_light(scene, LightType::sun, {}, 0, 5);
    EXPECT_EQ(scene.suns(), (std::vector<std::size_t>{4, 2, 3}));
    EXPECT_EQ(scene.sun(), 4);
    const FrameFacts facts = compute_facts(scene, camera());
    EXPECT_TRUE(facts.has_sun);
    EXPECT_EQ(facts.local_lights_in_view, 3);
    ASSERT_EQ(facts.lamps.size(), 3u);
    EXPECT_EQ(facts.lamps[0].light, 2u);
    EXPECT_EQ(facts.lamps[1].light, 3u);
    EXPECT_EQ(facts.lamps[2].light, 0u);
    EXPECT_EQ(facts.lamps[0].position, glm::vec3(0, 0, sun_distance));
}

TEST(FrameFacts, LampsCountWhereTheirReachMeetsTheView) {
    struct Case {
        glm::vec3 position;
        float range, intensity;
        bool counts;
    };
    for (const Case& c :
         {Case{{0, 0, -5}, 2, 1, true}, Case{{0, 0, -1000}, 2, 1, true}, Case{{0, 0, 1.5f}, 2, 1, true},
          Case{{0, 0, 2.5f}, 2, 1, false}, Case{{0, 0, -5}, 2, 0, false},
          // 45 degree side planes: (10, 0, -5) is 5 / sqrt(2) = 3.54 m outside.
          Case{{10, 0, -5}, 3.6f, 1, true}, Case{{10, 0, -5}, 3.5f, 1, false}}) {
        Scene scene;
        add_light(scene, LightType::spot, c.position, c.range, c.intensity);
        const FrameFacts facts = compute_facts(scene, camera());
        EXPECT_EQ(facts.local_lights_in_view, c.counts ? 1 : 0) << c.position.z << ' ' << c.range;
    }
}

TEST(FrameFacts, GlobalMediaAreEverywhereUnlessTheyDoNothing) {
    for (const auto shape : {Medium::Shape::global, Medium::Shape::height}) {
        Scene scene;
        scene.media = {fog(shape, 0)};
        EXPECT_FALSE(compute_facts(scene, camera()).has_medium());
        scene.media.push_back(fog(shape, 0.25f));
        const FrameFacts facts = compute_facts(scene, camera());
        EXPECT_TRUE(facts.has_global_medium);
        EXPECT_FALSE(facts.has_local_media);
    }
    Scene glow;
    glow.media = {fog(Medium::Shape::global, 0)};
    glow.media[0].emission = {0, 0, 1};
    EXPECT_TRUE(compute_facts(glow, camera()).has_global_medium);
}

TEST(FrameFacts, BoundedMediaCountInView) {
    struct Case {
        Medium::Shape shape;
        glm::vec3 center, half_extent;
        float turn;  // about y, rad
        bool in_view;
    };
    constexpr float eighth = 0.7853982f;
    for (const Case& c : {Case{Medium::Shape::sphere, {0, 0, -5}, {1, 1, 1}, 0, true},
                          Case{Medium::Shape::sphere, {0, 0, 5}, {1, 1, 1}, 0, false},
                          Case{Medium::Shape::sphere, {0, 0, 0.8f}, {1, 1, 1}, 0, true},
                          Case{Medium::Shape::ellipsoid, {0, 0, 3}, {1, 1, 4}, 0, true},
                          Case{Medium::Shape::ellipsoid, {0, 0, 3}, {4, 4, 1}, 0, false},
                          Case{Medium::Shape::box, {0.8f, 0.8f, 0.8f}, {1, 1, 1}, 0, true},
                          Case{Medium::Shape::box, {0, 0, 1.1f}, {1, 1, 1}, 0, false},
                          // Turned by 45 degrees, the box reaches sqrt(2) along z.
                          Case{Medium::Shape::box, {0, 0, 1.1f}, {1, 1, 1}, eighth, true},
                          Case{Medium::Shape::box, {0, 0, 50}, {1, 1, 1}, eighth, false}}) {
        Scene scene;
        scene.media = {fog(c.shape, 0.5f)};
        Medium& medium = scene.media[0];
        medium.center = c.center;
        medium.half_extent = c.half_extent;
        medium.rotation = glm::angleAxis(c.turn, glm::vec3(0, 1, 0));
        const FrameFacts facts = compute_facts(scene, camera());
        EXPECT_EQ(facts.has_local_media, c.in_view) << c.center.x << ' ' << c.center.z;
        EXPECT_FALSE(facts.has_global_medium);
    }
}

}  // namespace
}  // namespace tyndall
