// How much light local media leave on its way to points, surfaces and other media, against closed forms.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "engine/core/files.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/light_probe.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* sun_pass = "volumetrics/sun_volume";
constexpr const char* lamp_pass = "volumetrics/lamp_volumes";

/// Metres of the path from a to b in a medium of sharp edges.
double chord(const LocalMedium& medium, glm::dvec3 a, glm::dvec3 b) {
    const glm::dquat inverse = glm::conjugate(glm::dquat(medium.rotation));
    const glm::dvec3 from = inverse * (a - glm::dvec3(medium.center)), path = inverse * (b - a);
    const glm::dvec3 half(medium.half_extent);
    double enter = 0, leave = 1;
    if (medium.shape == Shape::box) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(path[axis]) < 1e-12) {
                if (std::abs(from[axis]) > half[axis]) return 0;
                continue;
            }
            const double p = (-half[axis] - from[axis]) / path[axis], q = (half[axis] - from[axis]) / path[axis];
            enter = std::max(enter, std::min(p, q));
            leave = std::min(leave, std::max(p, q));
        }
    } else {
        const glm::dvec3 o = from / half, d = path / half;
        const double nearest = -glm::dot(o, d) / glm::dot(d, d);
        const double depth = 1 - glm::dot(o + d * nearest, o + d * nearest);
        if (depth <= 0) return 0;
        enter = std::max(enter, nearest - std::sqrt(depth / glm::dot(d, d)));
        leave = std::min(leave, nearest + std::sqrt(depth / glm::dot(d, d)));
    }
    return std::max(leave - enter, 0.0) * glm::length(path);
}

class VolumetricsLightVolume : public GlTest {
  protected:
    VolumetricsLightVolume() {
        host.view_depth = [](int, int) { return 20.0F; };
    }
    /// As plain_settings, with volumes that are soon made.
    static Settings small_settings(int steps) {
        Settings s = plain_settings(steps);
        s.light_volumes.sun_size = 32;
        s.froxels.x = s.froxels.y = 16;
        return s;
    }
    StubHost host;
    LightProbe probe;
    Settings settings;
    const LocalMedium ball{.center = {1, 2, -6}, .half_extent = glm::vec3(2), .sigma_a = glm::vec3(0.4F)};
    const LocalMedium box{.shape = Shape::box,
                          .center = {1, 2, -6},
                          .half_extent = {1.5F, 1, 2},
                          .rotation = glm::angleAxis(0.7F, glm::normalize(glm::vec3(1, 2, 3))),
                          .sigma_a = glm::vec3(0.4F)};

    std::vector<glm::vec3> transmittance(const std::vector<glm::vec3>& points, int lamp = -1) {
        return probe.transmittance(host, settings, points, lamp);
    }
    /// Points in a medium's box and beyond: before it, in it, behind it, beside it.
    static std::vector<glm::vec3> points_round(const LocalMedium& medium, glm::vec3 direction) {
        std::vector<glm::vec3> points;
        const glm::vec3 side = glm::normalize(glm::cross(direction, glm::vec3(0.3F, 0.5F, 0.8F)));
        for (const float along : {-6.0F, -0.7F, 0.0F, 0.4F, 3.0F, 30.0F})
            for (const float beside : {0.0F, 0.6F, 9.0F})
                points.push_back(medium.center + direction * along + side * beside);
        return points;
    }
    void expect_chords(const LocalMedium& medium, double tolerance) {
        host.local = {medium};
        const std::vector<glm::vec3> points = points_round(medium, host.sun_direction);
        const std::vector<glm::vec3> found = transmittance(points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double length = chord(medium, points[i] - 100.0F * host.sun_direction, points[i]);
            for (int c = 0; c < 3; ++c) {
                const double expected = std::exp(-double(medium.sigma_s[c] + medium.sigma_a[c]) * length);
                EXPECT_NEAR(found[i][c], expected, tolerance) << "point " << i << " channel " << c;
            }
        }
    }
};

TEST_F(VolumetricsLightVolume, SunBehindSphereAndBoxOfConstantDensity) {
    host.has_sun = true;
    for (const glm::vec3 direction :
         {glm::vec3(0, -1, 0), glm::vec3(0.3F, -0.5F, 0.6F), glm::vec3(-1, 0, 0), glm::vec3(0.7F, 0.7F, -0.1F)}) {
        host.sun_direction = glm::normalize(direction);
        expect_chords(ball, 4e-3);
        expect_chords(box, 8e-3);
    }
}

TEST_F(VolumetricsLightVolume, SunInColouredExtinction) {
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -0.5F, 0.6F));
    LocalMedium coloured = ball;
    coloured.sigma_s = {0.1F, 0.3F, 0};
    coloured.sigma_a = {0, 0.2F, 0.9F};
    expect_chords(coloured, 8e-3);
}

TEST_F(VolumetricsLightVolume, OpticalDepthsOfOverlappingMediaAddUp) {
    host.has_sun = true;
    host.local = {ball, box};
    const std::vector<glm::vec3> points = points_round(ball, host.sun_direction);
    const std::vector<glm::vec3> both = transmittance(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 above = points[i] + glm::vec3(0, 100, 0);
        EXPECT_NEAR(both[i].r, std::exp(-0.4 * (chord(ball, above, points[i]) + chord(box, above, points[i]))),
                    8e-3);
    }
}

TEST_F(VolumetricsLightVolume, LampBesideSphereAndInBox) {
    settings.light_volumes.lamp_size = 48;
    LocalMedium coloured = ball;
    coloured.sigma_a = {0.4F, 0.1F, 0};
    for (const LocalMedium& medium : {coloured, box}) {
        host.local = {medium};
        for (const glm::vec3 lamp : {glm::vec3(1, 6, -6), glm::vec3(-3, 1, -4), glm::vec3(1.2F, 2.1F, -6.3F)}) {
            host.lights = {point_light({50, 0, 0}, 1, 3), point_light(lamp, 1, 12)};
            std::vector<glm::vec3> points;
            for (const glm::vec3 offset : {glm::vec3(0), glm::vec3(0.5F, -0.3F, 0.2F), glm::vec3(-4, -1, 0),
                                           glm::vec3(0, -5, 1), glm::vec3(0, 5, 5)})
                points.push_back(medium.center + offset);
            const std::vector<glm::vec3> found = transmittance(points, 1);
            for (std::size_t i = 0; i < points.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(found[i][c], std::exp(-medium.sigma_a[c] * chord(medium, lamp, points[i])), 0.02)
                        << "point " << i << " channel " << c;
        }
    }
}

TEST_F(VolumetricsLightVolume, DenseSoftNoisyMediumGetsDarkerDownwards) {
    host.has_sun = true;
    host.local = {{.center = {0, 0, -8},
                   .half_extent = {3, 2, 2},
                   .softness = 1,
                   .sigma_s = glm::vec3(2),
                   .noise_scale = 0.7F,
                   .noise_amount = 1}};
    std::vector<glm::vec3> points;
    for (int i = 0; i <= 100; ++i) points.emplace_back(0.3F, 3 - 0.06F * static_cast<float>(i), -8.2F);
    const std::vector<glm::vec3> found = transmittance(points);
    for (std::size_t i = 1; i < found.size(); ++i) EXPECT_LE(found[i].r, found[i - 1].r);
    EXPECT_EQ(found.front().r, 1);
    EXPECT_LT(found.back().r, 0.2F);
    EXPECT_GT(found.back().r, 0);
}

TEST_F(VolumetricsLightVolume, MediumOutOfViewDimsWhatIsInView) {
    host.has_sun = true;
    host.global = {{.sigma_s = glm::vec3(0.01F)}};
    host.sun_direction = {0, 0, -1};
    const LocalMedium wall{
        .shape = Shape::box, .center = {0, 0, 60}, .half_extent = {40, 40, 1}, .sigma_a = glm::vec3(0.5F)};
    for (const char* technique : {"ray_march", "froxel"}) {
        Settings s = small_settings(16);
        s.technique = technique;
        host.local.clear();
        const double open = host.render(s).scattering.at(0, 0)[0];
        host.local = {wall};
        const Frame frame = host.render(s);
        EXPECT_THAT(frame.live_passes, Contains(sun_pass));
        EXPECT_THAT(frame.live_passes, Not(Contains("volumetrics/inject_media")));
        EXPECT_THAT(frame.live_passes, Not(Contains("volumetrics/noise_volume")));
        EXPECT_NEAR(frame.scattering.at(0, 0)[0] / open, std::exp(-1), 5e-3);
        s.light.transmittance = false;
        EXPECT_NEAR(host.render(s).scattering.at(0, 0)[0] / open, 1, 1e-3);
    }
}

TEST_F(VolumetricsLightVolume, MadeAnewOnlyWhenMediaOrLightChange) {
    host.count_work = true;
    host.has_sun = true;
    host.lights = {point_light({0, 3, -6}, 1, 8)};
    LocalMedium soft = ball;
    soft.softness = 1;
    host.local = {soft};
    const Settings s = small_settings(4);
    const auto samples = [&](const char* pass) {
        const Frame frame = host.render(s);
        return frame.work.contains(pass) ? frame.work.at(pass)[int(gl::Work::medium_samples)] : 0;
    };
    EXPECT_GT(samples(sun_pass), 0U);
    EXPECT_EQ(samples(sun_pass), 0U);
    host.eye = {0, 0, 0.5F};  // the view is no reason
    host.local[0].emission = glm::vec3(1);
    EXPECT_EQ(samples(sun_pass), 0U);
    EXPECT_EQ(samples(lamp_pass), 0U);
    host.local[0].center.x += 0.1F;
    EXPECT_GT(samples(sun_pass), 0U);
    EXPECT_EQ(samples(lamp_pass), 0U);  // in the same frame
    host.sun_direction = glm::normalize(glm::vec3(0.1F, -1, 0));
    EXPECT_EQ(samples(lamp_pass), 0U);
    host.sun_direction = glm::normalize(glm::vec3(0.2F, -1, 0));
    EXPECT_GT(samples(sun_pass), 0U);
    host.lights[0].position_range.x += 0.1F;
    EXPECT_GT(samples(lamp_pass), 0U);
    EXPECT_EQ(samples(lamp_pass), 0U);
}

TEST_F(VolumetricsLightVolume, NothingOfItWithoutNeed) {
    host.has_sun = true;
    host.lights = {point_light({0, 3, -6}, 1, 8)};
    host.local = {ball};
    const auto bytes_without = [&](const Settings& s, const char* pass) {
        PassList passes;
        const Inputs inputs = host.inputs(passes);
        host.volumetrics().prepare(inputs, s);
        host.volumetrics().add_light_passes(passes, inputs, s);
        for (const PassList::PassInfo& info : passes.passes())
            EXPECT_TRUE(info.name != pass || !info.reason.empty());
        return host.volumetrics().persistent_bytes();
    };
    constexpr std::size_t buffers = 20000;
    Settings s = small_settings(4);
    const std::size_t both = bytes_without(s, "none");
    host.lights[0] = point_light({0, 30, -6}, 1, 8);  // reaches no local medium
    const std::size_t sun_only = bytes_without(s, lamp_pass);
    EXPECT_GT(sun_only, 32U * 32U * 16U * 2U);
    EXPECT_LT(sun_only, both);
    s.light.transmittance = false;
    EXPECT_LT(bytes_without(s, sun_pass), buffers);
    s.light.transmittance = true;
    host.has_sun = false;
    EXPECT_LT(bytes_without(s, sun_pass), buffers);
    host.has_sun = true;
    host.local.clear();
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    EXPECT_LT(bytes_without(s, sun_pass), buffers);
}

TEST_F(VolumetricsLightVolume, WithoutVolumesTheyAreNotInTheShaderText) {
    const std::string text = resolve_includes(probe.roots(), "shaders/volumetrics/light/light_transmittance.glsl");
    EXPECT_THAT(text, HasSubstr("#if LIGHT_VOLUMES"));
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    host.has_sun = true;
    (void)transmittance({glm::vec3(0)});
    const gl::Program& without = probe.program(0);
    const gl::Program& with = probe.program(1);
    EXPECT_EQ(glGetUniformLocation(without.id(), "sun_volume"), -1);
    EXPECT_EQ(glGetUniformLocation(without.id(), "lamp_volumes"), -1);
    EXPECT_GE(glGetUniformLocation(with.id(), "sun_volume"), 0);
    EXPECT_GE(glGetUniformLocation(with.id(), "lamp_volumes"), 0);
}

TEST_F(VolumetricsLightVolume, OverTheLimitTheFartherLampIsLeftOutAndSaid) {
    settings.light_volumes.lamp_count = 1;
    host.local = {ball};
    host.lights = {point_light({1, 6, -30}, 1, 40), point_light({1, 6, -6}, 1, 40)};
    const glm::vec3 below{1, -2, -6};
    EXPECT_NEAR(transmittance({below}, 1)[0].r, std::exp(-0.4 * 4), 0.01);
    EXPECT_EQ(transmittance({below}, 0)[0].r, 1);
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    host.volumetrics().prepare(inputs, settings);
    host.volumetrics().add_light_passes(passes, inputs, settings);
    EXPECT_TRUE(std::ranges::any_of(passes.passes(), [](const PassList::PassInfo& pass) {
        return !pass.live && pass.reason.starts_with("1 lamp");
    }));
    settings.light_volumes.lamp_count = 2;
    EXPECT_LT(transmittance({glm::vec3(1, 2, -5)}, 0)[0].r, 0.9F);
}

/// Both march and froxels gather what the brute force does.
TEST_F(VolumetricsLightVolume, DenseMediumUnderSunAndLampAsInTheReference) {
    host.size = {24, 24};
    host.vertical_fov = 0.8F;
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.5F, -1, 0.2F));
    host.lights = {point_light({-1.5F, 2, -7}, 8, 9)};
    host.local = {
        {.center = {0, 0, -8}, .half_extent = glm::vec3(2), .softness = 0.5F, .sigma_s = glm::vec3(1.2F)}};
    Settings reference = plain_settings(1);
    reference.technique = "reference";
    reference.reference.steps = 512;
    const Image expected = host.render(reference).scattering;
    for (const char* technique : {"ray_march", "froxel"}) {
        Settings s = plain_settings(128);
        s.technique = technique;
        s.froxels.x = s.froxels.y = 96;
        s.froxels.z = 128;
        s.froxels.far = 12;
        s.light_volumes.lamp_size = 32;
        s.froxels.distribution = volumetrics::DepthDistribution::linear;
        const Image image = host.render(s).scattering;
        double error = 0, sum = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x) {
                error += std::pow(double(image.at(x, y)[0]) - expected.at(x, y)[0], 2);
                sum += expected.at(x, y)[0];
            }
        EXPECT_LT(std::sqrt(error / 576) / (sum / 576), 0.04) << technique;
    }
}

}  // namespace
}  // namespace tyndall::test
