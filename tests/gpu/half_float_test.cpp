// The largest light there is overflows no half-float target: radiance ends at 65504 cd/m², and shows as white.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/files.h"
#include "engine/gl/readback.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

constexpr float half_max = 65504;

/// A sun, lamps around the eye, surfaces and media that shine, each with 1e8 of its unit.
class HalfFloat : public GlTest {
  protected:
    HalfFloat() {
        constexpr float most = 1e8f;
        builder_.ground({0, 0, 0}, 20, builder_.material(glm::vec3(1), 1, 0, glm::vec3(most)));
        builder_.box({0, 1, -2}, {1, 1, 1}, builder_.material(glm::vec3(1), 0.05f, 1));
        builder_.sun({-1, -2, -1}, glm::vec3(most));
        for (const float x : {-1.0f, 0.0f, 1.0f}) builder_.point({x, 2, 4}, glm::vec3(most), 100);
        for (const auto shape : {Medium::Shape::global, Medium::Shape::height, Medium::Shape::sphere}) {
            Medium medium;
            medium.shape = shape;
            medium.sigma_s = glm::vec3(0.01f);
            medium.emission = glm::vec3(most);
            medium.center = {0, 1, 0};
            medium.half_extent = glm::vec3(3);
            builder_.scene.media.push_back(medium);
        }
        renderer_.prepare(builder_.finish());
    }
    void draw(const FrameOptions& options) { renderer_.render(builder_.scene, view_, {48, 33}, options); }
    static void expect_finite(const Image& image, const std::string& name) {
        for (const float v : image.pixels)
            ASSERT_TRUE(std::isfinite(v) && std::abs(v) <= half_max) << name << " " << v;
    }
    static float brightest(const Image& image) { return *std::ranges::max_element(image.pixels); }

    test::SceneBuilder builder_;
    View view_ = look_at({0, 2, 6}, {0, 1.5f, 0}, 1.0f, 0.1f, 1.5f);
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
};

TEST_F(HalfFloat, NoTargetOverflowsAndTheLimitIsReached) {
    FrameOptions options;
    options.more_layers = {"scattering", "transmittance", "emissive"};
    for (const auto filter : {volumetrics::Filter::none, volumetrics::Filter::gaussian15}) {
        volumetrics_.settings.filter.kernel = filter;
        draw(options);
        for (const std::string& layer : options.more_layers) expect_finite(renderer_.read_layer(layer), layer);
        expect_finite(gl::read_texture(renderer_.color()), "color");
        EXPECT_EQ(brightest(renderer_.read_layer("scattering")), half_max);
        EXPECT_EQ(brightest(gl::read_texture(renderer_.color())), half_max);
    }
    // The transient targets too: froxel volumes, shadow maps, the sky.
    for (const PassList::TextureInfo& texture : renderer_.passes().textures()) {
        const bool plain = texture.desc.kind == gl::TextureKind::d2 || texture.desc.kind == gl::TextureKind::d3;
        const GLenum format = texture.desc.format;
        const bool other =
            format == GL_R32F || format == GL_RG32F || format == GL_RG32UI;  // depths, slopes, runs of slices
        if (!texture.live || texture.id == 0 || !plain || other) continue;
        for (int slice = 0; slice < texture.desc.size.z; ++slice)
            expect_finite(gl::read_texture({texture.id, texture.desc}, slice), texture.name);
    }
}

TEST_F(HalfFloat, WithoutAMediumSurfacesAndSkyStayFiniteToo) {
    FrameOptions options;
    volumetrics_.settings.technique = "off";
    draw(options);
    expect_finite(gl::read_texture(renderer_.color()), "color");
}

// Exposure multiplies in single precision: whatever it is, the brightest stays white and never turns black.
TEST_F(HalfFloat, ExposureKeepsWhiteWhite) {
    FrameOptions options;
    for (const float ev100 : {-100.0f, -30.0f, 0.0f}) {
        builder_.scene.exposure_ev100 = ev100;
        draw(options);
        for (const float v : renderer_.read_display().pixels) ASSERT_GE(v, 250.0f / 255) << ev100;
    }
    builder_.scene.exposure_ev100 = 100;
    draw(options);
    const Image black = renderer_.read_display();
    for (std::size_t i = 0; i < black.pixels.size(); i += 4) ASSERT_LE(black.pixels[i], 2.0f / 255);
}

}  // namespace
}  // namespace tyndall
