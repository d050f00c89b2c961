// Every depth distribution: the far end of the froxels, the near plane, and the slices a picture comes from.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::DepthDistribution;

constexpr DepthDistribution distributions[] = {DepthDistribution::linear, DepthDistribution::exponential,
                                               DepthDistribution::logarithmic, DepthDistribution::curve,
                                               DepthDistribution::automatic};

/// A row of pixels in one direction, each with a surface at another depth.
class VolumetricsFroxelRange : public GlTest {
  protected:
    VolumetricsFroxelRange() {
        host.size = {256, 1};
        host.vertical_fov = 1e-4F;
        host.view_depth = [this](int x, int) { return depth(x); };
        settings = plain_settings(1);
        settings.technique = "froxel";
        settings.froxels.x = 256;
        settings.froxels.y = 8;
    }
    StubHost host;
    volumetrics::Settings settings;
    float first = 0.12F, growth = 1.04F;
    [[nodiscard]] float depth(int x) const { return first * std::pow(growth, static_cast<float>(x)); }
};

// Light of the sun and sky in closed form, from 0.12 m to behind the far end, and so at every slice's begin and
// middle.
TEST_F(VolumetricsFroxelRange, EveryDepthHasTheLightOfItsLength) {
    host.has_sun = true;
    host.sun_direction = {0, 0, 1};
    host.sun_illuminance = glm::vec3(1000);
    host.ambient = glm::vec3(5);
    host.global = {{.sigma_s = glm::vec3(0.02F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.3F}};
    for (const auto distribution : distributions)
        for (const int slices : {8, 40}) {
            settings.froxels.z = slices;
            settings.froxels.distribution = distribution;
            const Frame frame = host.render(settings);
            for (int x = 0; x < 256; ++x) {
                const double expected = (1000 * phase_hg(0.3, 1) + 5) * 2 / 3 * -std::expm1(-0.03 * depth(x));
                ASSERT_NEAR(frame.scattering.at(x, 0)[0], expected, 3e-3 * expected)
                    << depth(x) << " m, distribution " << int(distribution) << ", " << slices << " slices";
            }
        }
}

TEST_F(VolumetricsFroxelRange, TheFarEndIsNoSeam) {
    first = 4;
    growth = 1.016F;  // to 230 m
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.2F, -1, 0));
    host.sun_illuminance = glm::vec3(1000);
    for (const bool height : {false, true}) {
        host.global = {{.sigma_s = glm::vec3(0.01F), .sigma_a = glm::vec3(0.01F), .height = height, .falloff = 8}};
        const double to_sun = height ? 0.02 * 8 / -host.sun_direction.y : 0;
        const double source = 1000 / (4 * std::numbers::pi) * std::exp(-to_sun) * 0.5;
        for (const auto distribution : distributions)
            for (const float far : {20.0F, 60.0F}) {
                settings.froxels.distribution = distribution;
                settings.froxels.far = far;
                const Frame frame = host.render(settings);
                for (int x = 0; x < 256; ++x) {
                    const double expected = source * -std::expm1(-0.02 * depth(x));
                    ASSERT_NEAR(frame.scattering.at(x, 0)[0], expected, 5e-3 * expected)
                        << depth(x) << " m of " << far << ", distribution " << int(distribution);
                }
            }
    }
}

TEST_F(VolumetricsFroxelRange, TheNearPlaneChangesNothing) {
    first = 1.2F;  // in front of the farther near plane nothing is seen
    growth = 1.02F;
    host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.2F}};
    host.ambient = glm::vec3(1);
    host.lights = {point_light({0.5F, 0, -3}, 100), point_light({3, 0, -20}, 1000)};
    for (const auto distribution : distributions) {
        settings.froxels.distribution = distribution;
        host.znear = 0.01F;
        const Frame close = host.render(settings);
        host.znear = 1;
        const Frame far = host.render(settings);
        for (int x = 0; x < 256; ++x)
            ASSERT_NEAR(close.scattering.at(x, 0)[0], far.scattering.at(x, 0)[0],
                        0.01 * close.scattering.at(x, 0)[0])
                << depth(x) << " m, distribution " << int(distribution);
    }
}

// A box of fog from 20 to 30 m alone, in ambient light: nothing before it, and then Beer-Lambert. What a slice too
// long does at its ends is the distribution's error; `auto` has slices there and nowhere else.
TEST_F(VolumetricsFroxelRange, AutoSlicesABoxOfFog) {
    host.ambient = glm::vec3(1);
    host.local = {
        {.shape = Shape::box, .center = {0, 0, -25}, .half_extent = {5, 5, 5}, .sigma_s = glm::vec3(0.1F)}};
    first = 10;
    growth = 1.01F;  // to 126 m
    settings.froxels.distribution = DepthDistribution::automatic;
    for (const int slices : {16, 64, 128}) {
        settings.froxels.z = slices;
        const Frame frame = host.render(settings);
        const double slice = 12.0 / slices;  // m, or less
        for (int x = 0; x < 256; ++x) {
            const double length = std::clamp(double(depth(x)) - 20, 0.0, 10.0);
            EXPECT_NEAR(frame.scattering.at(x, 0)[0], -std::expm1(-0.1 * length), 0.1 * slice)
                << depth(x) << " m, " << slices << " slices";
        }
        // The first slice begins at the eye, and may reach a little into the box.
        EXPECT_LT(frame.scattering.at(60, 0)[0], 0.02 * slice) << "18.2 m";
    }
}

}  // namespace
}  // namespace tyndall::test
