// Several suns: of all light that falls on surfaces and in the air, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <random>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/image_metrics.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

constexpr glm::ivec2 size(9, 9);

struct SunLight {
    glm::vec3 direction;
    float lux;
};
/// Neither the first nor the last is the brightest; one is dark.
const SunLight suns[] = {
    {{0.3f, -1, 0.2f}, 0}, {{-1, -0.8f, 0.3f}, 400}, {{0.6f, -1, -0.5f}, 1000}, {{0.2f, -0.5f, 1}, 700}};

class Suns : public GlTest {
  protected:
    Suns() { options_.render.ambient = 0; }
    void add_suns(bool shadow) {
        for (const SunLight& sun : suns) builder_.sun(sun.direction, glm::vec3(sun.lux), shadow);
    }
    float middle(const std::string& layer) {
        options_.layer = layer;
        if (!prepared_) renderer_.prepare(builder_.finish());
        prepared_ = true;
        renderer_.render(builder_.scene, view_, size, options_);
        return renderer_.read_layer().at(size.x / 2, size.y / 2)[0];
    }

    test::SceneBuilder builder_;
    View view_ = look_at({0, 1.7f, 0}, {0, 1.7f, -1}, 1.0f, 0.1f, 1.0f);
    FrameOptions options_;
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shared_shaders(), {&volumetrics_}};
    bool prepared_ = false;
};

double sum_on_plane(std::initializer_list<int> those) {
    double sum = 0;
    for (const int i : those)
        sum += double(suns[i].lux) * -double(glm::normalize(suns[i].direction).y) * 0.5 / std::numbers::pi;
    return sum;
}

TEST_F(Suns, AllLightSurfacesAndEachHasItsShadow) {
    const int lambert = builder_.material(glm::vec3(0.5f));
    builder_.scene.materials[std::size_t(lambert)].dielectric_f0 = 0;
    builder_.ground({0, 0, 0}, 20, lambert);
    add_suns(true);
    // A plate of 1 m, 4 m above the ground and out of view.
    builder_.box({0, 4, 0}, {0.5f, 0.01f, 0.5f}, lambert);
    const auto at = [&](glm::vec3 p) {
        view_ = look_at(p + glm::vec3(0.3f, 1, 0.2f), p, 0.2f, 0.1f, 1.0f);
        return middle("color");
    };
    const auto under = [](int sun) {  // the plate's middle along the sunlight
        return 4 / -suns[sun].direction.y * glm::vec3(suns[sun].direction.x, 0, suns[sun].direction.z);
    };
    EXPECT_NEAR(at({-9, 0, 9}), sum_on_plane({1, 2, 3}), 0.01 * sum_on_plane({1, 2, 3}));
    EXPECT_NEAR(at(under(1)), sum_on_plane({2, 3}), 0.01 * sum_on_plane({2, 3}));
    EXPECT_NEAR(at(under(2)), sum_on_plane({1, 3}), 0.01 * sum_on_plane({1, 3}));
    EXPECT_NEAR(at(under(3)), sum_on_plane({1, 2}), 0.01 * sum_on_plane({1, 2}));
}

// L = sum over the suns of E p sigma_s / sigma_t (1 - exp(-sigma_t d)), to a wall and to the end of the fog.
TEST_F(Suns, AllLightTheAirInEveryTechnique) {
    add_suns(false);
    Medium fog;
    fog.sigma_s = glm::vec3(0.03f);
    fog.sigma_a = glm::vec3(0.01f);
    fog.anisotropy = 0.3f;
    builder_.scene.media.push_back(fog);
    builder_.box({0, 0, 26}, {30, 30, 1});  // 25 m behind the eye
    volumetrics_.settings.march.max_distance = 40;
    volumetrics_.settings.froxels.far = 40;
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::off;
    for (const auto& [technique, tolerance] : {std::pair{"ray_march", 0.01},
                                               {"froxel", 0.01},
                                               {"billboards", 0.06},
                                               {"particles", 0.1},
                                               {"analytic_fog", 0.01},
                                               {"radial_shafts", 0.01},
                                               {"epipolar", 0.01},
                                               {"reference", 0.01}}) {
        volumetrics_.settings.technique = technique;
        for (const bool wall : {true, false}) {
            const double toward = wall ? 1 : -1;
            view_ = look_at({0, 1.7f, 0}, {0, 1.7f, wall ? 1 : -1}, 1.0f, 0.1f, 1.0f);
            double expected = 0;
            for (const SunLight& sun : suns) {
                const double cosine = -toward * double(glm::normalize(sun.direction).z), g = 0.3f;
                expected += double(sun.lux) * (1 - g * g) /
                            (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5)) * 0.75;
            }
            if (wall) expected *= 1 - std::exp(-0.04 * 25);
            EXPECT_NEAR(middle("scattering") / expected, 1, tolerance) << technique << (wall ? ", wall" : ", sky");
        }
    }
}

TEST_F(Suns, EachHasItsShadowsInTheAirOfEpipolar) {
    add_suns(true);
    builder_.ground({0, 0, 0}, 20);
    for (int i = -2; i <= 2; ++i) builder_.box({3 * i, 4, 0}, {1, 0.1f, 4});  // slats
    builder_.scene.media.push_back({.sigma_s = glm::vec3(0.03f)});
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::off;
    view_ = look_at({-7, 2, 8}, {0, 2.5f, 0}, 1.0f, 0.1f, 16.0f / 9);
    options_.layer = "scattering";
    renderer_.prepare(builder_.finish());
    const auto draw = [&](const char* technique, bool shadows) {
        volumetrics_.settings.technique = technique;
        options_.render.shadows = shadows;
        renderer_.render(builder_.scene, view_, {48, 27}, options_);
        return renderer_.read_layer();
    };
    const Image truth = draw("reference", true);
    const double error = relative_rmse(draw("epipolar", true), truth);
    const double unshadowed = relative_rmse(draw("epipolar", false), truth);
    EXPECT_LT(error, 0.04);
    EXPECT_GT(unshadowed, 5 * error);
}

// Many more lamps than a software rasteriser's loops have rounds for, all in one place and lighting all of the air
// and the ground: each gives what one gives.
TEST_F(Suns, TwentyThousandLampsAddUp) {
    constexpr std::size_t count = 20'000;
    builder_.ground({0, 0, 0}, 20);
    builder_.scene.media.push_back({.sigma_s = glm::vec3(0.02f)});
    view_ = look_at({0, 1.7f, 0}, {0, 0, -30}, 1.0f, 0.1f, 1.0f);
    options_.render.cluster_x = options_.render.cluster_y = 2;  // lists of more would not fit into a buffer
    volumetrics_.settings.froxels = {.x = 8, .y = 8, .z = 16};
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::off;
    const auto in_air = [&] {
        std::map<std::string, float> air;
        for (const char* technique : {"ray_march", "froxel", "billboards", "shaft_geometry"}) {
            volumetrics_.settings.technique = technique;
            air[technique] = middle("scattering");
        }
        return air;
    };
    builder_.point({1, 3, -6}, glm::vec3(1), 1000);
    const std::map<std::string, float> one = in_air();
    const float ground = middle("color");
    while (builder_.scene.lights.size() < count) builder_.point({1, 3, -6}, glm::vec3(1), 1000);
    for (const auto& [technique, air] : in_air())
        EXPECT_NEAR(air / float(count) / one.at(technique), 1, 0.005) << technique;
    EXPECT_NEAR(middle("color") / float(count) / ground, 1, 0.005);
}

// Lamps of all places and strengths, more than the loops have rounds for, against three thirds of them, which fit:
// a march loses nothing of the mean over the picture, and each pixel has some noise.
TEST_F(Suns, ManyLampsAreTheSumOfFewer) {
    volumetrics_.settings.technique = "ray_march";
    builder_.scene.media.push_back({.sigma_s = glm::vec3(0.02f)});
    volumetrics_.settings.temporal.mode = volumetrics::Temporal::off;
    volumetrics_.settings.filter.kernel = volumetrics::Filter::none;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-20, 20);
    for (int i = 0; i < 3000; ++i)
        builder_.point({uniform(random), uniform(random), uniform(random) - 20},
                       glm::vec3(std::exp2(0.1f * uniform(random))), 1000);
    const std::vector<Light> all = builder_.scene.lights;
    const auto picture = [&](std::ptrdiff_t first, std::ptrdiff_t count) {
        builder_.scene.lights.assign(all.begin() + first, all.begin() + first + count);
        middle("scattering");
        return renderer_.read_layer();
    };
    for (const volumetrics::Noise noise : {volumetrics::Noise::bayer, volumetrics::Noise::none}) {
        volumetrics_.settings.noise.kind = noise;
        const Image together = picture(0, 3000);
        Image thirds = picture(0, 1000);
        for (const std::ptrdiff_t first : {1000, 2000}) {
            const Image third = picture(first, 1000);
            for (std::size_t i = 0; i < third.pixels.size(); ++i) thirds.pixels[i] += third.pixels[i];
        }
        double sum = 0, expected = 0;
        for (int i = 0; i < size.x * size.y; ++i) {
            sum += together.at(i % size.x, i / size.x)[0];
            expected += thirds.at(i % size.x, i / size.x)[0];
        }
        std::cout << "mean " << sum / expected << ", noise " << relative_rmse(together, thirds) << '\n';
        EXPECT_NEAR(sum / expected, 1, 0.02);
        EXPECT_LE(relative_rmse(together, thirds), 0.2);
    }
}

}  // namespace
}  // namespace tyndall
