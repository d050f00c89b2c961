// What is particular to the technique froxel: slices, columns, the last slice, the end of the volume.

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::DepthDistribution;
using volumetrics::LampIntegration;

constexpr DepthDistribution distributions[] = {DepthDistribution::linear, DepthDistribution::exponential,
                                               DepthDistribution::logarithmic};

class VolumetricsFroxel : public GlTest {
  protected:
    StubHost host;

    /// A coarse grid for what does not vary over the screen.
    static Settings settings(int columns_x, int columns_y) {
        Settings settings = plain_settings(1);
        settings.technique = "froxel";
        settings.froxels.x = columns_x;
        settings.froxels.y = columns_y;
        settings.froxels.distribution = volumetrics::DepthDistribution::exponential;
        return settings;
    }

    /// Radiance of point lamps in a homogeneous medium along a ray: the midpoint rule in the angle as seen from the
    /// lamp, in which 1/d² dt = d(angle) / h.
    [[nodiscard]] double lamps(glm::dvec3 direction, double view_depth) const {
        const GlobalMedium& m = host.global[0];
        const double sigma_s = m.sigma_s.r, sigma_t = m.sigma_s.r + m.sigma_a.r, end = view_depth / -direction.z;
        double sum = 0;
        for (const shared::GpuLight& light : host.lights) {
            const glm::dvec3 to_lamp = glm::dvec3(light.position_range) - glm::dvec3(host.eye);
            const double nearest = glm::dot(to_lamp, direction), h = glm::length(to_lamp - nearest * direction);
            const double first = std::atan2(-nearest, h), last = std::atan2(end - nearest, h);
            constexpr int samples = 200;
            for (int i = 0; i < samples; ++i) {
                const double angle = first + (last - first) * (i + 0.5) / samples;
                const double d = h / std::cos(angle), t = nearest + h * std::tan(angle);
                sum += light.intensity_radius.r * sigma_s * phase_hg(m.anisotropy, -std::sin(angle)) *
                       std::exp(-sigma_t * (t + d)) * (last - first) / samples / h;
            }
        }
        return sum;
    }

    /// Root mean square of the difference, relative to that of what is expected, over the picture.
    [[nodiscard]] double lamp_error(const Settings& s, double view_depth) {
        const Frame frame = host.render(s);
        double error = 0, total = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double expected = lamps(host.ray(x, host.size.y - 1 - y), view_depth);
                error += std::pow(frame.scattering.at(x, y)[0] - expected, 2);
                total += expected * expected;
            }
        return std::sqrt(error / total);
    }
};

// All depths at once: a row of pixels in one direction.
class VolumetricsFroxelDepths : public VolumetricsFroxel {
  protected:
    VolumetricsFroxelDepths() {
        host.size = {256, 1};
        host.vertical_fov = 1e-4F;
        host.view_depth = [this](int x, int) { return depth(x); };
    }
    float growth = 1.04F;
    [[nodiscard]] float depth(int x) const { return 0.12F * std::pow(growth, static_cast<float>(x)); }
};

TEST_F(VolumetricsFroxelDepths, EverySurfaceDepthHasTheLightOfItsLength) {
    host.has_sun = true;
    host.sun_direction = {0, 0, 1};
    host.sun_illuminance = glm::vec3(1000);
    host.ambient = glm::vec3(5);
    for (const glm::vec3 sigma_a : {glm::vec3(0), glm::vec3(0, 0.02F, 0.1F)}) {
        host.global = {{.sigma_s = glm::vec3(0.02F), .sigma_a = sigma_a, .anisotropy = 0.3F}};
        for (const auto distribution : distributions) {
            Settings s = settings(256, 8);
            s.froxels.z = 32;
            s.froxels.distribution = distribution;
            const Frame frame = host.render(s);
            for (int x = 0; x < 256; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double sigma_t = 0.02 + sigma_a[c];
                    const double expected =
                        (1000 * phase_hg(0.3, 1) + 5) * 0.02 / sigma_t * -std::expm1(-sigma_t * depth(x));
                    ASSERT_NEAR(frame.scattering.at(x, 0)[c], expected, 2e-3 * expected)
                        << depth(x) << " m, distribution " << int(distribution);
                }
        }
    }
}

TEST_F(VolumetricsFroxelDepths, TheEndOfTheVolumeIsNoSeam) {
    growth = 1.03F;  // to 216 m
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.2F, -1, 0));
    host.sun_illuminance = glm::vec3(1000);
    for (const bool height : {false, true}) {
        host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.01F), .height = height, .falloff = 8}};
        const double thickness_to_sun = height ? 0.02 * 8 / -host.sun_direction.y : 0;
        for (const float far : {20.0F, 60.0F}) {
            Settings s = settings(256, 8);
            s.froxels.far = far;
            const Frame frame = host.render(s);
            for (int x = 0; x < 256; ++x) {
                const double expected = 1000 / (4 * std::numbers::pi) * std::exp(-thickness_to_sun) * 0.5 *
                                        -std::expm1(-0.02 * depth(x));
                ASSERT_NEAR(frame.scattering.at(x, 0)[0], expected, 3e-3 * expected) << depth(x) << " m of " << far;
            }
        }
    }
}

TEST_F(VolumetricsFroxelDepths, TheNearPlaneChangesNothing) {
    host.view_depth = [this](int x, int) { return 10 * depth(x); };
    host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.2F}};
    host.ambient = glm::vec3(1);
    host.lights = {point_light({0.5F, 0, -3}, 100), point_light({3, 0, -20}, 1000)};
    for (const auto distribution : distributions) {
        Settings s = settings(256, 8);
        s.froxels.distribution = distribution;
        host.znear = 0.01F;
        const Frame close = host.render(s);
        host.znear = 1;
        const Frame far = host.render(s);
        for (int x = 0; x < 256; ++x)
            ASSERT_NEAR(close.scattering.at(x, 0)[0], far.scattering.at(x, 0)[0],
                        0.01 * close.scattering.at(x, 0)[0])
                << 10 * depth(x) << " m, distribution " << int(distribution);
    }
}

TEST_F(VolumetricsFroxel, LampsAgreeWithQuadratureOverThePicture) {
    host.size = {25, 14};  // between the columns as well as on them
    host.vertical_fov = 0.9F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.005F), .anisotropy = 0.4F}};
    Settings s = settings(160, 90);
    double worst_center = 0;
    for (const float distance : {0.1F, 0.3F, 1.0F, 3.0F, 10.0F, 20.0F})
        for (const float z : {-2.0F, -9.4F, -24.0F}) {
            host.lights = {point_light({distance, 0.03F, z}, 10000)};
            s.light.lamp_integration = LampIntegration::segment;
            EXPECT_LE(lamp_error(s, 40), 0.02) << distance << " m from the axis at " << z;
            if (distance < 10) continue;
            s.light.lamp_integration = LampIntegration::center;
            worst_center = std::max(worst_center, lamp_error(s, 40));
        }
    EXPECT_GE(worst_center, 0.1);  // one sample in the middle of each slice
}

// A wall before the lamp fills the left half of the picture; before it there is no light at all.
TEST_F(VolumetricsFroxel, NothingLeaksThroughAWall) {
    host.size = {128, 72};
    host.global = {{.sigma_s = glm::vec3(0.02F)}};
    host.shadows = 2;
    for (const float eye_x : {-0.02F, -0.4F, -1.0F})
        for (const glm::vec3 lamp : {glm::vec3(-0.3F, 0.1F, -6.2F), {-1.5F, 0, -6.5F}, {-0.1F, 0, -8}}) {
            host.eye = {eye_x, 0, 0};
            host.lights = {point_light(lamp, 1000)};
            host.lights[0].cone_shadow.z = 1;  // asks for its shadow
            const auto on_wall = [&](int x, int y) {
                const glm::vec3 d = host.ray(x, y);
                return eye_x + d.x / -d.z * 6 < 0;
            };
            host.view_depth = [&](int x, int y) { return on_wall(x, y) ? 6.0F : 40.0F; };
            const Frame frame = host.render(settings(48, 27));
            double lit = 0, leaked = 0, worst = 0;
            int lit_pixels = 0, wall_pixels = 0;
            for (int y = 0; y < 72; ++y)
                for (int x = 0; x < 128; ++x) {
                    const double value = frame.scattering.at(x, 71 - y)[0];
                    if (on_wall(x, y)) {
                        leaked += value;
                        worst = std::max(worst, value);
                        ++wall_pixels;
                    } else {
                        lit += value;
                        ++lit_pixels;
                    }
                }
            lit /= lit_pixels;
            leaked /= wall_pixels;
            EXPECT_GT(lit, 0.01);
            EXPECT_LE(leaked, 0.002 * lit);
            EXPECT_LE(worst, 0.1 * lit) << "eye " << eye_x << ", lamp " << lamp.x << ' ' << lamp.z;
        }
}

TEST_F(VolumetricsFroxel, StepsAreThereWhenTheyAreNeeded) {
    using ::testing::ElementsAre;
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    const Frame frame = host.render(settings(8, 8));
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/froxel_columns", "volumetrics/froxel_light",
                                               "volumetrics/froxel_accumulate", "volumetrics/froxel_apply"));
    EXPECT_EQ(frame.skipped.at("volumetrics/inject_media"), "no local medium in view");
    EXPECT_EQ(frame.skipped.at("volumetrics/march"), "technique is froxel");
    host.local = {{.center = {0, 0, -5}, .sigma_s = glm::vec3(0.1F)}};
    EXPECT_EQ(host.render(settings(8, 8)).live_passes.at(1), "volumetrics/inject_media");
    host.global.clear();
    host.local.clear();
    EXPECT_TRUE(host.render(settings(8, 8)).live_passes.empty());
}

// One pixel shows one depth in all columns: only the slices before it are lit, and lamps only where they are
// listed.
TEST_F(VolumetricsFroxel, OnlyWhatIsSeenIsLit) {
    host.count_work = true;
    host.global = {{.sigma_s = glm::vec3(0.01F)}};
    host.has_sun = true;
    host.slices = 20;
    host.slice_depth = 5;
    Settings s = settings(16, 8);
    s.froxels.z = 40;
    s.froxels.far = 80;
    s.froxels.distribution = DepthDistribution::linear;
    const auto work = [&](float view_depth) {
        host.view_depth = [=](int, int) { return view_depth; };
        return host.render(s).work.at("volumetrics/froxel_light");
    };
    constexpr std::uint64_t columns = 16 * 8;
    for (const auto& [view_depth, slices] : {std::pair{9.0F, 5}, {41.0F, 21}, {79.5F, 40}, {sky, 40}}) {
        const gl::WorkCounts counts = work(view_depth);
        EXPECT_EQ(counts[int(gl::Work::medium_samples)], columns * slices) << view_depth;
        EXPECT_EQ(counts[int(gl::Work::shadow_lookups)], columns * slices);
        EXPECT_EQ(counts[int(gl::Work::light_evaluations)], 0U);
    }
    host.lights.assign(1000, point_light({0, 0, -500}, 10, 5));
    host.lights[0] = point_light({0, 0, -30}, 10, 4.9F);  // 25.1 to 34.9 m: 5 or 6 slices of 2 m
    host.listed = [](int light, int slice) { return light == 0 && slice >= 5 && slice < 7; };
    for (const auto integration : {LampIntegration::center, LampIntegration::segment}) {
        s.light.lamp_integration = integration;
        const auto evaluations = work(60)[int(gl::Work::light_evaluations)];
        EXPECT_GT(evaluations, 0U);
        EXPECT_LE(evaluations, columns * 7);
        EXPECT_EQ(work(20)[int(gl::Work::light_evaluations)], 0U);
    }
}

}  // namespace
}  // namespace tyndall::test
