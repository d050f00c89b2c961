// Closed rooms whose walls have no thickness, or little: inside it is dark.

#include <algorithm>
#include <random>

#include "adapter/volumetrics_adapter.h"
#include "engine/render/renderer.h"
#include "support/shadow_rig.h"

namespace tyndall {
namespace {

constexpr glm::vec3 low(-5, 0, -5), high(5, 3, 5);

/// Six walls round the room from `low` to `high`, `thickness` m outwards; 0: planes.
std::vector<TestBox> closed_room(float thickness) {
    std::vector<TestBox> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true}) {
            TestBox wall{low - thickness, high + thickness};
            (upper ? wall.min : wall.max)[axis] = (upper ? high : low)[axis];
            if (thickness == 0) wall.min[axis] = wall.max[axis] = (upper ? high : low)[axis];
            walls.push_back(wall);
        }
    return walls;
}

/// Of the visibilities that should be 0.
struct Leak {
    double mean = 0;
    float most = 0;
};

Leak leak(const std::vector<float>& values) {
    Leak found;
    for (const float v : values) {
        found.mean += double(v) / double(values.size());
        found.most = std::max(found.most, v);
    }
    return found;
}

/// Where thin walls meet, within a texel, the filter sees what is outside.
void expect_dark(const Leak& walls, const Leak& air, float thickness) {
    EXPECT_LT(walls.mean, thickness > 0 ? 1e-4 : 2e-3) << thickness;
    EXPECT_LT(air.mean, thickness > 0 ? 2e-5 : 1e-4) << thickness;
    if (thickness >= 0.1f) {
        EXPECT_EQ(std::max(walls.most, air.most), 0) << thickness;
    }
}

/// On the walls, or in the air of the room.
std::vector<ShadowRig::Point> points_in_room(const ShadowRig& rig, bool on_walls, float light) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> u(0, 1);
    std::vector<ShadowRig::Point> points;
    while (points.size() < 60000) {
        glm::vec3 p = glm::mix(low, high, glm::vec3(u(random), u(random), u(random))), normal(0, 1, 0);
        if (on_walls) {
            const int axis = static_cast<int>(random() % 3);
            const bool upper = random() % 2 == 0;
            normal = glm::vec3(0);
            normal[axis] = upper ? -1.0f : 1.0f;
            p[axis] = (upper ? high : low)[axis];
        }
        const glm::vec4 clip = rig.view.view_projection * glm::vec4(p, 1);
        if (std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) continue;
        points.push_back({p, rig.view_depth(p), normal, light});
    }
    return points;
}

class ShadowLeak : public GlTest {};

TEST_F(ShadowLeak, TheSunDoesNotShineIntoAClosedRoom) {
    for (const float thickness : {0.0f, 0.05f, 0.1f}) {
        for (const glm::vec3 direction : {glm::vec3(0, -0.866f, -0.5f), {0.3f, -1, -0.5f}, {1, -0.4f, 0.7f}}) {
            Scene scene = box_scene(closed_room(thickness));
            Light sun;
            sun.type = LightType::sun;
            add_light(scene, sun, {0, 0, 0}, direction);
            ShadowRig rig(std::move(scene));
            rig.view = look_at({0, 1.5f, 4}, {0, 1.5f, 0}, 1.0f, 0.1f, 1.5f);
            rig.frame();
            std::vector<ShadowRig::Point> walls = points_in_room(rig, true, -1);
            // The light that counts is that of surfaces which face it.
            std::erase_if(walls, [&](const ShadowRig::Point& p) { return glm::dot(p.normal, direction) >= 0; });
            const Leak surface = leak(rig.look_up(ShadowRig::Lookup::sun_surface, walls));
            const Leak air = leak(rig.look_up(ShadowRig::Lookup::sun_volume, points_in_room(rig, false, -1)));
            expect_dark(surface, air, thickness);
        }
    }
}

TEST_F(ShadowLeak, ALampDoesNotShineIntoAClosedRoom) {
    for (const float thickness : {0.0f, 0.05f, 0.1f}) {
        for (const glm::vec3 position : {glm::vec3(7, 2, 1), {2, 6, -1.5f}}) {
            Scene scene = box_scene(closed_room(thickness));
            Light lamp;
            lamp.range = 40;
            add_light(scene, lamp, position, {0, 0, -1});
            ShadowRig rig(std::move(scene));
            rig.view = look_at({0, 1.5f, 4}, {0, 1.5f, 0}, 1.0f, 0.1f, 1.5f);
            rig.frame();
            std::vector<ShadowRig::Point> walls = points_in_room(rig, true, 0);
            std::erase_if(walls,
                          [&](const ShadowRig::Point& p) { return glm::dot(p.normal, position - p.world) <= 0; });
            const Leak surface = leak(rig.look_up(ShadowRig::Lookup::light_surface, walls));
            const Leak air = leak(rig.look_up(ShadowRig::Lookup::light_volume, points_in_room(rig, false, 0)));
            expect_dark(surface, air, thickness);
        }
    }
}

// Three metres high, of planes, with a sun of 10,000 lx outside and fog: black, but for the sky's light.
TEST_F(ShadowLeak, ARoomOfPlanesIsBlackInThePicture) {
    Scene scene = box_scene(closed_room(0));
    Light sun;
    sun.type = LightType::sun;
    sun.intensity = glm::vec3(10000);
    add_light(scene, sun, {0, 0, 0}, {0, -0.866f, -0.5f});
    Medium fog;
    fog.sigma_s = glm::vec3(0.1f);
    scene.media.push_back(fog);
    VolumetricsAdapter volumetrics;
    Renderer renderer(shared_shaders(), {&volumetrics});
    renderer.prepare(scene);
    FrameOptions options;
    options.render.ambient = 0;
    options.more_layers = {"scattering"};
    // Trees tell light from shadow to a cell, and where ceiling and wall meet to a texel: of lit fog that is least
    // here.
    for (const auto& [technique, most] :
         {std::pair{"ray_march", 0.0}, {"froxel", 0.06}, {"epipolar", 0.01}, {"auto", 0.01}}) {
        volumetrics.settings.technique = technique;
        const auto brightest = [&](bool shadows, const char* layer) {
            options.render.shadows = shadows;
            renderer.render(scene, look_at({0, 1.5f, 4}, {0, 1.5f, 0}, 1.0471976f, 0.1f, 16.0f / 9), {160, 90},
                            options);
            return double(std::ranges::max(renderer.read_layer(layer).pixels));
        };
        const double lit = brightest(false, "scattering");
        EXPECT_GT(lit, 100) << technique;
        for (const char* layer : {"color", "scattering"})
            EXPECT_LE(brightest(true, layer), most * lit) << technique << ' ' << layer;
    }
}

}  // namespace
}  // namespace tyndall
