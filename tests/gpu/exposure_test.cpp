// Pictures are exposed before they are stored: half floats hold what is bright on the scene's exposure, however
// bright that is.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "adapter/volumetrics_adapter.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

const std::vector<std::string> lit_techniques{"ray_march",      "froxel",       "billboards",    "particles",
                                              "shaft_geometry", "analytic_fog", "radial_shafts", "epipolar",
                                              "auto",           "reference"};

class Exposure : public GlTest {
  protected:
    Exposure() {
        options_.more_layers = {"color", "emissive"};
        volumetrics_.settings.froxels.pixels = 0;
    }

    /// All that shines is `factor` times as bright; the exposure by as much less.
    Scene lit(float factor) const {
        Scene scene = builder_.scene;
        for (Light& light : scene.lights) light.intensity *= factor;
        for (Medium& medium : scene.media) medium.emission *= factor;
        for (Material& material : scene.materials) material.emissive *= factor;
        for (ParticleEmitter& emitter : scene.emitters) emitter.emission *= factor;
        scene.exposure_ev100 += std::log2(factor);
        return scene;
    }
    void draw(const Scene& scene) {
        renderer_.prepare(scene);
        renderer_.render(scene, view_, {24, 17}, options_);
    }
    std::vector<Image> layers(const Scene& scene, const std::string& technique) {
        options_.layer = "scattering";
        volumetrics_.settings.technique = technique;
        renderer_.invalidate_history();
        draw(scene);
        return {renderer_.read_layer("scattering"), renderer_.read_layer("emissive"),
                renderer_.read_layer("color")};
    }

    test::SceneBuilder builder_;
    View view_ = look_at({0, 2, 6}, {0, 1.5f, 0}, 1.0f, 0.1f, 1.5f);
    FrameOptions options_;
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shared_shaders(), {&volumetrics_}};
};

TEST_F(Exposure, AsMuchMoreLightAsLessExposureIsTheSamePicture) {
    builder_.ground({0, 0, 0}, 20, builder_.material(glm::vec3(0.5f), 1, 0, {3, 2, 1}));
    const int glass = builder_.material(glm::vec3(0.2f), 0.5f, 0, {1, 2, 3});
    builder_.scene.materials.back().base_color.a = 0.5f;
    builder_.scene.materials.back().alpha_blend = true;
    builder_.box({2, 1, 0}, {1, 1, 0.1f}, glass);
    builder_.sun({-1, -2, -1}, glm::vec3(80));
    builder_.sun({1, -2, -1}, glm::vec3(20));
    builder_.point({1, 2, 1}, {200, 100, 50}, 20);
    for (const auto shape : {Medium::Shape::global, Medium::Shape::sphere}) {
        Medium medium;
        medium.shape = shape;
        medium.sigma_s = glm::vec3(0.02f);
        medium.emission = {0.1f, 0.2f, 0.3f};
        medium.center = {0, 1, 0};
        medium.half_extent = glm::vec3(3);
        builder_.scene.media.push_back(medium);
    }
    ParticleEmitter emitter;
    emitter.node = 0;
    emitter.count = 3;
    emitter.emission = {5, 6, 7};
    builder_.scene.emitters.push_back(emitter);
    builder_.finish();
    options_.render.ambient = 0;
    const float factor = std::exp2(30.0f);
    for (const std::string& technique : lit_techniques) {
        const std::vector<Image> dim = layers(lit(1), technique), bright = layers(lit(factor), technique);
        for (std::size_t layer = 0; layer < dim.size(); ++layer) {
            double sum = 0, off = 0;
            for (std::size_t i = 0; i < dim[layer].pixels.size(); ++i) {
                sum += double(dim[layer].pixels[i]);
                off = std::max(off, std::abs(double(bright[layer].pixels[i] / factor - dim[layer].pixels[i])));
            }
            EXPECT_GT(sum, 0) << technique;
            // Of the sky behind the scene only the night's is not the sun's.
            EXPECT_LE(off, layer == 2 ? 1e-2 : 0) << technique << ", layer " << layer;
        }
    }
}

// Before a wall, with the sun behind it: E p(g, cos) sigma_s / sigma_t (1 - exp(-sigma_t d)), to 3 times what a
// half float holds. Billboards and particles take single samples of it, and radial_shafts sees no sun behind a
// wall: the test above holds for them.
TEST_F(Exposure, HazeBeforeTheSunIsNotCutOff) {
    constexpr float lux = 120'000, g = 0.85f;
    builder_.sun({0, -0.05f, 1}, glm::vec3(lux), false);
    builder_.box({0, 0, -41}, {60, 60, 1});
    Medium haze;
    haze.sigma_s = glm::vec3(0.05f);
    haze.anisotropy = g;
    builder_.scene.media.push_back(haze);
    builder_.finish();
    builder_.scene.exposure_ev100 = 15;
    view_ = look_at({0, 0, 0}, {0, 0.05f, -1}, 1.0f, 0.1f, 0.2f);
    volumetrics_.settings.march.max_distance = 60;
    volumetrics_.settings.froxels.far = 60;
    for (const char* technique : {"ray_march", "froxel", "shaft_geometry", "analytic_fog", "reference"}) {
        const Image image = layers(builder_.scene, technique).front();
        for (const int y : {4, 8, 12}) {
            // The ray through the pixel's middle.
            const glm::dvec2 size(24, 17), at = (glm::dvec2(12.5, y + 0.5) * 2.0 / size - 1.0) * glm::dvec2(1, -1);
            const glm::dvec4 far = glm::inverse(glm::dmat4(view_.view_projection)) * glm::dvec4(at, 0.01, 1);
            const glm::dvec3 d = glm::normalize(glm::dvec3(far) / far.w - glm::dvec3(view_.eye));
            const double cosine = glm::dot(d, glm::normalize(glm::dvec3(0, 0.05, -1)));
            const double phase = (1 - double(g) * g) /
                                 (4 * std::numbers::pi * std::pow(1 + double(g) * g - 2 * double(g) * cosine, 1.5));
            const double right = double(lux) * phase * (1 - std::exp(-0.05 * 40 / -d.z));
            EXPECT_GT(right, 65504);
            EXPECT_NEAR(double(image.at(12, y)[1]) / right, 1, 0.02) << technique << ", row " << y;
        }
    }
}

}  // namespace
}  // namespace tyndall
