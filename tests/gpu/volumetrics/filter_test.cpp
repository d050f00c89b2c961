#include <cmath>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::Filter;
using volumetrics::FilterDepth;

class VolumetricsFilter : public GlTest {
  protected:
    VolumetricsFilter() {
        host.size = {48, 32};
        host.vertical_fov = 1e-4F;  // all rays alike
        host.ambient = glm::vec3(1);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.05F)}};
    }
    StubHost host;

    Frame render(Filter filter, FilterDepth depth = FilterDepth::none, float sigma = 1.5F) {
        Settings settings = plain_settings(1);
        settings.filter = filter;
        settings.filter_depth = depth;
        settings.filter_sigma = sigma;
        return host.render(settings);
    }
};

TEST_F(VolumetricsFilter, KeepsAConstantImage) {
    for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame sharp = render(Filter::none);
        for (const FilterDepth depth : {FilterDepth::none, FilterDepth::relative})
            for (const float sigma : {0.3F, 1.5F, 7.0F}) {
                const Frame frame = render(Filter::gaussian15, depth, sigma);
                for (std::size_t i = 0; i < sharp.scattering.pixels.size(); ++i)
                    ASSERT_NEAR(frame.scattering.pixels[i], sharp.scattering.pixels[i],
                                sharp.scattering.pixels[i] / 2048);
                for (std::size_t i = 0; i < sharp.transmittance.pixels.size(); ++i)
                    ASSERT_NEAR(frame.transmittance.pixels[i], sharp.transmittance.pixels[i],
                                sharp.transmittance.pixels[i] / 2048 + 6e-8F);
            }
    }
}

TEST_F(VolumetricsFilter, GaussianSpreadsAStepByItsErrorFunction) {
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    const Frame sharp = render(Filter::none), frame = render(Filter::gaussian15, FilterDepth::none, 2);
    const double left = sharp.scattering.at(0, 16)[0], right = sharp.scattering.at(47, 16)[0];
    for (int x = 14; x < 34; ++x) {
        const double part = 0.5 * (1 + std::erf((x + 0.5 - 24) / (2 * std::sqrt(2.0))));
        EXPECT_NEAR(frame.scattering.at(x, 16)[0], left + part * (right - left), 0.005 * (right - left)) << x;
    }
}

TEST_F(VolumetricsFilter, BilateralKeepsADepthStepAndTheSky) {
    host.size = {48, 48};
    host.view_depth = [](int x, int y) { return y < 24 ? (x < 24 ? 5.0F : 20.0F) : (x < 24 ? 20.0F : sky); };
    const Frame sharp = render(Filter::none), frame = render(Filter::gaussian15, FilterDepth::relative, 3);
    for (std::size_t i = 0; i < sharp.scattering.pixels.size(); ++i)
        ASSERT_NEAR(frame.scattering.pixels[i], sharp.scattering.pixels[i], sharp.scattering.pixels[i] / 2048);
}

TEST_F(VolumetricsFilter, BilateralFiltersAlongASlopedSurfaceAndNoiseAway) {
    // Steps of 4% in depth from pixel to pixel are one surface; dithered shadows on it are smoothed.
    host.view_depth = [](int x, int) { return 10.0F * std::pow(1.04F, static_cast<float>(x)); };
    host.ambient = glm::vec3(0);
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1000);
    host.shadows = 1;
    const auto roughness = [&](Filter filter) {
        Settings settings = plain_settings(2);
        settings.noise = volumetrics::Noise::bayer;
        settings.filter = filter;
        const Frame frame = host.render(settings);
        double sum = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 1; x < 48; ++x)
                sum += std::pow(frame.scattering.at(x, y)[0] - frame.scattering.at(x - 1, y)[0], 2);
        return std::sqrt(sum);
    };
    EXPECT_LT(roughness(Filter::gaussian15), 0.3 * roughness(Filter::none));
}

TEST_F(VolumetricsFilter, TransmittanceStaysInRange) {
    host.view_depth = [](int x, int y) { return (x + y) % 3 == 0 ? 0.2F : 200.0F; };
    const Frame frame = render(Filter::gaussian15, FilterDepth::none, 4);
    for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
}

}  // namespace
}  // namespace tyndall::test
