// Local media through the froxel volume against quadrature of their shapes.

#include <algorithm>
#include <cmath>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

class VolumetricsLocalMedia : public GlTest, public testing::WithParamInterface<std::string> {
  protected:
    VolumetricsLocalMedia() {
        host.size = {16, 16};
        host.vertical_fov = 0.8F;
        host.view_depth = [](int, int) { return 20.0F; };
    }
    StubHost host;

    static Settings fine_settings() {
        Settings settings = plain_settings(256);
        settings.technique = GetParam();
        settings.froxels.x = settings.froxels.y = 96;
        settings.froxels.z = 192;
        settings.froxels.far = 40;
        return settings;
    }
    /// Length of the ray through a pixel inside the sphere of radius 2 at (0, 0, -10), by density.
    [[nodiscard]] double sphere_length(int x, int y, double softness) const {
        const glm::dvec3 d = host.ray(x, y);
        const auto density = [&](double t) {
            const double depth = 2 - glm::distance(d * t, glm::dvec3(0, 0, -10));
            return softness > 0 ? std::clamp(depth / softness, 0.0, 1.0) : depth > 0 ? 1.0 : 0.0;
        };
        return integrate(density, 7.5, 13, 1e-6);
    }
};

INSTANTIATE_TEST_SUITE_P(Techniques, VolumetricsLocalMedia, testing::Values("ray_march", "froxel"),
                         [](const auto& info) { return info.param; });

// A hard rim is as fine as a froxel, 0.2 m deep: a pixel's transmittance, 0.2 in the middle, is up to 0.027 off.
TEST_P(VolumetricsLocalMedia, SphereHasTheOpticalDepthOfItsShape) {
    for (const auto distribution :
         {volumetrics::DepthDistribution::linear, volumetrics::DepthDistribution::exponential}) {
        for (const float softness : {0.0F, 1.0F}) {
            host.local = {{.center = {0, 0, -10},
                           .half_extent = glm::vec3(2),
                           .softness = softness,
                           .sigma_s = glm::vec3(0.2F),
                           .sigma_a = glm::vec3(0, 0.1F, 0.2F)}};
            Settings settings = fine_settings();
            settings.froxels.distribution = distribution;
            const Frame frame = host.render(settings);
            double mean_error = 0;
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 16; ++x) {
                    const double length = sphere_length(x, 15 - y, softness);
                    for (int c = 0; c < 3; ++c) {
                        const double expected = std::exp(-(0.2 + 0.1 * c) * length);
                        EXPECT_NEAR(frame.transmittance.at(x, y)[c], expected, softness > 0 ? 0.005 : 0.03);
                        mean_error += (frame.transmittance.at(x, y)[c] - expected) / (16 * 16 * 3);
                    }
                }
            EXPECT_NEAR(mean_error, 0, softness > 0 ? 3e-4 : 2e-3);
        }
    }
}

TEST_P(VolumetricsLocalMedia, MediaAddAndAnisotropyIsAveragedByScattering) {
    host.has_sun = true;
    host.sun_direction = {0, 0, 1};  // straight into the eye
    host.sun_illuminance = glm::vec3(1000);
    host.size = {1, 1};
    const LocalMedium box{.shape = Shape::box, .center = {0, 0, -10}, .half_extent = glm::vec3(3)};
    LocalMedium forward = box, backward = box;
    forward.sigma_s = glm::vec3(0.003F);
    forward.anisotropy = 0.6F;
    backward.sigma_s = glm::vec3(0.001F);
    backward.anisotropy = -0.2F;
    host.local = {forward, backward};
    const Frame frame = host.render(fine_settings());
    // Straight ahead light passes all 6 m, wherever it is scattered.
    const double expected = 1000 * phase_hg(0.4, 1) * 0.004 * 6 * std::exp(-0.004 * 6);
    EXPECT_NEAR(frame.scattering.at(0, 0)[0], expected, 0.02 * expected);
}

TEST_P(VolumetricsLocalMedia, LocalAndGlobalMediaAdd) {
    host.ambient = glm::vec3(1);
    host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.5F}};
    host.local = {{.shape = Shape::box,
                   .half_extent = glm::vec3(100),
                   .sigma_s = glm::vec3(0.03F),
                   .sigma_a = glm::vec3(0.01F)}};
    host.size = {1, 1};
    const Frame frame = host.render(fine_settings());
    EXPECT_NEAR(frame.transmittance.at(0, 0)[0], std::exp(-0.06 * 20), 2e-3);
    EXPECT_NEAR(frame.scattering.at(0, 0)[0], 5.0 / 6 * -std::expm1(-0.06 * 20), 2e-3);
}

TEST_P(VolumetricsLocalMedia, EmissionIsSummed) {
    host.size = {1, 1};
    host.local = {{.shape = Shape::box, .half_extent = glm::vec3(100), .emission = {0.1F, 0.2F, 0.3F}},
                  {.shape = Shape::box, .half_extent = glm::vec3(100), .emission = {0.3F, 0.2F, 0.1F}}};
    const Frame frame = host.render(fine_settings());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(frame.scattering.at(0, 0)[c], 0.4 * 20, 0.02);
    EXPECT_EQ(frame.transmittance.at(0, 0)[0], 1);
}

TEST_P(VolumetricsLocalMedia, MediaBehindTheFroxelVolumeDimToo) {
    host.size = {1, 1};
    host.view_depth = [](int, int) { return 100.0F; };
    host.local = {{.shape = Shape::box, .half_extent = glm::vec3(1000), .sigma_a = glm::vec3(0.05F)}};
    Settings settings = fine_settings();
    EXPECT_NEAR(host.render(settings).transmittance.at(0, 0)[0], std::exp(-0.05 * 100), 2e-4);
}

// Which media a tile holds must not show: every medium of many gives what it gives alone.
TEST_P(VolumetricsLocalMedia, TilesLoseNoMedium) {
    host.view_depth = [](int, int) { return 60.0F; };
    Settings settings = fine_settings();
    settings.march.steps = 64;
    settings.froxels.x = 64;
    settings.froxels.y = 36;
    settings.froxels.z = 48;
    std::vector<LocalMedium> all;
    for (int i = 0; i < 70; ++i) {
        const float angle = 2.4F * static_cast<float>(i), distance = 0.6F * static_cast<float>(i);
        all.push_back({.shape = i % 2 == 0 ? Shape::box : Shape::ellipsoid,
                       .center = {0.3F * distance * std::cos(angle), 0.3F * distance * std::sin(angle), -distance},
                       .half_extent = {0.3F + 0.05F * static_cast<float>(i), 0.5F, 0.8F},
                       .rotation = glm::angleAxis(angle, glm::normalize(glm::vec3(1, 2, 3))),
                       .softness = 0.2F,
                       .sigma_a = glm::vec3(0.1F)});
    }
    std::vector<double> depth(256);
    for (const LocalMedium& medium : all) {
        host.local = {medium};
        const Frame frame = host.render(settings);
        if (frame.transmittance.pixels.empty()) continue;  // out of view
        for (int i = 0; i < 256; ++i) depth[i] -= std::log(double(frame.transmittance.pixels[3 * i]));
    }
    host.local = all;
    const Frame frame = host.render(settings);
    double thickest = 0;
    for (int i = 0; i < 256; ++i) {
        EXPECT_NEAR(-std::log(double(frame.transmittance.pixels[3 * i])), depth[i], 0.03 + 0.02 * depth[i]) << i;
        thickest = std::max(thickest, depth[i]);
    }
    EXPECT_GT(thickest, 0.5);
}

TEST_P(VolumetricsLocalMedia, MediaOutOfViewCostNothing) {
    host.local = {{.center = {0, 0, 30}, .sigma_a = glm::vec3(1)},
                  {.center = {100, 0, -20}, .sigma_a = glm::vec3(1)}};
    const Frame frame = host.render(fine_settings());
    EXPECT_TRUE(frame.live_passes.empty());
    EXPECT_EQ(frame.persistent_bytes, 0U);
}

// The volume of noise keeps its columns.
TEST_P(VolumetricsLocalMedia, NoiseIsAsFineInPicturesThatHaveFewerColumnsOfFroxels) {
    host.view_depth = [](int x, int) { return x < 5 ? 8.0F : 20.0F; };
    host.local = {{.center = {0, 0, -10},
                   .half_extent = glm::vec3(4),
                   .softness = 1,
                   .sigma_s = glm::vec3(0.2F),
                   .noise_scale = 0.7F,
                   .noise_amount = 1}};
    Settings settings = fine_settings();
    const Image all = host.render(settings).transmittance;
    settings.froxels.pixels = 2;
    const Image few = host.render(settings).transmittance;
    const auto [least, most] = std::ranges::minmax(all.pixels);
    EXPECT_LT(least, 0.7F * most);
    for (std::size_t i = 0; i < all.pixels.size(); ++i) EXPECT_NEAR(few.pixels[i], all.pixels[i], 0.005F) << i;
}

}  // namespace
}  // namespace tyndall::test
