// The cone of spots from half a degree to a quarter turn, on surfaces and in the air, drawn and traced, against
// KHR_lights_punctual's law as it is written, without its floor.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "adapter/volumetrics_adapter.h"
#include "engine/render/renderer.h"
#include "reference/reference.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

struct Cone {
    double inner, outer;  // half angles, rad
    [[nodiscard]] double operator()(double angle) const {
        const double share = (std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
        return std::pow(std::clamp(share, 0.0, 1.0), 2);
    }
};

std::vector<Cone> cones() {
    std::vector<Cone> all;
    for (const double degrees : {0.5, 1.0, 2.0, 5.0, 20.0, 45.0, 80.0})
        for (const double share : {0.0, 0.5, 0.9}) {
            const double outer = degrees * std::numbers::pi / 180;
            all.push_back({share * outer, outer});
        }
    return all;
}

class SpotSweep : public GlTest {
  protected:
    SpotSweep() {
        options_.render.ambient = 0;
        options_.render.atlas_size = 1024;
    }
    Image draw(const Scene& scene) {
        renderer_.prepare(scene);
        renderer_.render(scene, view_, size_, options_);
        return renderer_.read_layer();
    }
    [[nodiscard]] reference::Picture trace(const Scene& scene) const {
        return reference::render(reference::Reference(scene, {.ambient = 0}), view_, size_, 1, 2);
    }
    static Light& add_spot(test::SceneBuilder& builder, const Cone& cone, glm::vec3 at) {
        Light& light = builder.spot(at, {0, -1, 0}, glm::vec3(100), 1000, static_cast<float>(cone.outer));
        light.inner_cone = static_cast<float>(cone.inner);
        return light;
    }
    glm::ivec2 size_{21, 21};
    View view_;
    FrameOptions options_;
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shared_shaders(), {&volumetrics_}};
};

TEST_F(SpotSweep, OnSurfacesTheLawDividesItFromAPointLamp) {
    double worst_drawn = 0, worst_traced = 0;
    for (const Cone& cone : cones()) {
        // Lamp and eye 2 m above the floor, where the picture is a little wider than the cone.
        const float half_width = 1.2f * std::tan(std::min<float>(static_cast<float>(cone.outer), 1.1f));
        view_ = look_at({0, 2, 0}, {0, 0, 0}, 2 * std::atan(half_width), 0.1f, 1);
        test::SceneBuilder spot, point;
        for (test::SceneBuilder* b : {&spot, &point}) b->ground({0, 0, 0}, 30, b->material(glm::vec3(0.8f)));
        add_spot(spot, cone, {0, 2, 0});
        point.point({0, 2, 0}, glm::vec3(100), 1000);
        const Image drawn = draw(spot.finish()), drawn_all = draw(point.finish());
        const Image traced = trace(spot.finish()).color, traced_all = trace(point.finish()).color;
        double of_drawn = 0, of_traced = 0;
        for (int y = 0; y < size_.y; ++y)
            for (int x = 0; x < size_.x; ++x) {
                const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size_) * 2.0 - 1.0;
                const double wanted = cone(std::atan(glm::length(p) * half_width));
                const auto error = [&](const Image& some, const Image& all) {
                    return std::abs(some.at(x, y)[0] / all.at(x, y)[0] - wanted);
                };
                of_drawn = std::max(of_drawn, error(drawn, drawn_all));
                of_traced = std::max(of_traced, error(traced, traced_all));
            }
        EXPECT_LT(std::max(of_drawn, of_traced), 0.02)
            << "cone " << cone.inner << " " << cone.outer << " drawn " << of_drawn << " traced " << of_traced;
        worst_drawn = std::max(worst_drawn, of_drawn);
        worst_traced = std::max(worst_traced, of_traced);
    }
    std::printf("worst error of cones on surfaces: drawn %.4f, traced %.4f\n", worst_drawn, worst_traced);
}

TEST_F(SpotSweep, InTheAirARayThroughTheBeamGathersIt) {
    options_.layer = "scattering";
    constexpr double sigma = 1e-4, candela = 100, height = 2;
    double worst_drawn = 0, worst_traced = 0;
    for (const Cone& cone : cones()) {
        if (cone.outer > 1) continue;  // the eye would be in its beam
        test::SceneBuilder builder;
        builder.ground({0, -40, 0}, 30);
        add_spot(builder, cone, {0, height, 0});
        Medium medium;
        medium.sigma_s = glm::vec3(static_cast<float>(sigma));
        builder.scene.media = {medium};
        view_ = look_at({0, 0, 6}, {0, 0, 0}, 0.002f, 0.1f, 1);
        // Light that goes through the angle phi from the axis comes from height / cos(phi): 1 / d² dz is dphi /
        // height.
        double expected = 0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i)
            expected += cone(cone.outer * ((i + 0.5) / steps * 2 - 1)) * (2 * cone.outer / steps);
        expected *= sigma * candela / (4 * std::numbers::pi) / height;
        const double traced = trace(builder.finish()).scattering.at(10, 10)[0] / expected - 1;
        double drawn = 0;
        for (const char* technique : {"ray_march", "epipolar", "auto"}) {
            volumetrics_.settings.technique = technique;
            const double error = std::abs(draw(builder.finish()).at(10, 10)[0] / expected - 1);
            EXPECT_LT(error, 0.02) << technique << ", cone " << cone.inner << " " << cone.outer;
            drawn = std::max(drawn, error);
        }
        EXPECT_LT(std::abs(traced), 0.02) << "cone " << cone.inner << " " << cone.outer;
        worst_drawn = std::max(worst_drawn, drawn);
        worst_traced = std::max(worst_traced, std::abs(traced));
    }
    std::printf("worst error of cones in the air: drawn %.4f, traced %.4f\n", worst_drawn, worst_traced);
}

}  // namespace
}  // namespace tyndall
