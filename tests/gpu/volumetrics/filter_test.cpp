// The setting filter: its kernels, and how they narrow.

#include "tests/gpu/support/filter_fixture.h"

namespace tyndall::test {
namespace {

TEST_F(VolumetricsFilter, KeepsAConstantImageOfAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(48, 32), glm::ivec2(1, 1), glm::ivec2(3, 5), glm::ivec2(2, 19)})
        for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
            host.size = size;
            host.global[0].sigma_a = sigma_a;
            const Frame sharp = render(Filter::none);
            for (const Published& kernel : kernels)
                for (const FilterDepth depth : depth_modes) {
                    expect_to_rounding(render(kernel.filter, depth), sharp);
                }
        }
}

TEST_F(VolumetricsFilter, AnImpulseShowsThePublishedTaps) {
    for (const Published& kernel : kernels) {
        host.view_depth = [](int x, int y) { return x == 24 && y == 15 ? 300.0F : 0.2F; };
        const Frame sharp = render(Filter::none), frame = render(kernel.filter);
        const double low = sharp.scattering.at(0, 0)[0];
        // The picture's row 0 is at the top.
        const double height = sharp.scattering.at(24, 16)[0] - low;
        ASSERT_GT(height, 0.4);
        for (int y = -8; y <= 8; ++y)
            for (int x = -8; x <= 8; ++x) {
                const auto tap = [&](int i) {
                    return std::abs(i) > kernel.radius() ? 0 : kernel.taps[static_cast<std::size_t>(std::abs(i))];
                };
                EXPECT_NEAR((frame.scattering.at(24 + x, 16 + y)[0] - low) / height, tap(x) * tap(y),
                            1e-3 * tap(x) * tap(y) + 3e-5)
                    << static_cast<int>(kernel.filter) << ": " << x << ", " << y;
            }
    }
}

TEST_F(VolumetricsFilter, AStepIsSpreadByTheSumOfTaps) {
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    const Frame sharp = render(Filter::none);
    const double left = sharp.scattering.at(0, 16)[0], right = sharp.scattering.at(47, 16)[0];
    std::vector<double> step(48, 0.0);
    std::fill(step.begin() + 24, step.end(), 1.0);
    for (const Published& kernel : kernels) {
        const Frame frame = render(kernel.filter);
        for (int x = 0; x < 48; ++x) {
            const double part = filtered(step, x, kernel.taps, [](int) { return true; });
            EXPECT_NEAR(frame.scattering.at(x, 16)[0], left + part * (right - left), 0.002 * (right - left)) << x;
        }
    }
}

TEST_F(VolumetricsFilter, WideGaussianIsAnErrorFunction) {
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    settings.filter.sigma = 2;
    const Frame sharp = render(Filter::none), frame = render(Filter::gaussian15);
    const double left = sharp.scattering.at(0, 16)[0], right = sharp.scattering.at(47, 16)[0];
    for (int x = 14; x < 34; ++x) {
        const double part = 0.5 * (1 + std::erf((x + 0.5 - 24) / (2 * std::sqrt(2.0))));
        EXPECT_NEAR(frame.scattering.at(x, 16)[0], left + part * (right - left), 0.005 * (right - left)) << x;
    }
}

TEST_F(VolumetricsFilter, TapsOutsideOfThePictureAreLeftOut) {
    host.size = {3, 5};
    host.view_depth = [](int x, int) { return x == 0 ? 20.0F : x == 1 ? 5.0F : 1.0F; };
    const Frame sharp = render(Filter::none);
    std::vector<double> line;
    for (int x = 0; x < 3; ++x) line.push_back(sharp.scattering.at(x, 2)[0]);
    for (const Published& kernel : kernels) {
        const Frame frame = render(kernel.filter);
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 3; ++x)
                EXPECT_NEAR(frame.scattering.at(x, y)[0], filtered(line, x, kernel.taps, [](int) { return true; }),
                            0.001 * line[0]);
    }
}

TEST_F(VolumetricsFilter, OnlyTheTapsOfTheKernelAreFetched) {
    host.count_work = true;
    for (const Published& kernel : kernels)
        for (const FilterDepth depth : depth_modes) {
            const Frame frame = render(kernel.filter, depth);
            const int textures = depth == FilterDepth::none ? 1 : 2;
            const int for_slope = depth == FilterDepth::plane ? 4 : 0;
            const int fetches = (2 * kernel.radius() + 1) * textures + for_slope;
            for (const char* pass : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
                EXPECT_EQ(frame.work.at(pass)[int(gl::Work::texture_fetches)], 48U * 32U * unsigned(fetches));
        }
}

/// The kernel after a mean of n frames: a Gaussian one of variance v becomes one of max(v, 6 px²) / n^(2/3), or of
/// 0.25 px², by a second Gaussian that multiplies all kernels; none becomes wider.
Taps narrowed(Taps taps, int n) {
    double variance = 0;
    for (std::size_t x = 1; x < taps.size(); ++x) variance += 2 * taps[x] * double(x * x);
    const double target = std::max(std::max(variance, 6.0) / std::cbrt(double(n) * n), 0.25);
    const double added = std::max(1 / target - 1 / variance, 0.0);
    for (std::size_t x = 0; x < taps.size(); ++x) taps[x] *= std::exp(-0.5 * double(x * x) * added);
    return normalised(taps);
}

TEST_F(VolumetricsFilter, NarrowsByTheFramesOfThePixelsMean) {
    host.view_depth = [](int x, int y) { return x == 24 && y == 15 ? 300.0F : 0.2F; };
    for (const Published& kernel : kernels) {
        settings.temporal.mode = volumetrics::Temporal::off;
        const Frame sharp = render(Filter::none), plain = render(kernel.filter);
        const double low = sharp.scattering.at(0, 0)[0], height = sharp.scattering.at(24, 16)[0] - low;
        settings.temporal.mode = volumetrics::Temporal::accumulate;
        settings.temporal.place = volumetrics::TemporalPlace::before;
        for (int n = 1; n <= 32; ++n) {
            const Frame frame = render(kernel.filter);
            if (n == 1) {
                EXPECT_EQ(frame.scattering.pixels, plain.scattering.pixels);
            }
            if (n != 1 && n != 2 && n != 8 && n != 32) continue;
            const Taps taps = narrowed(kernel.taps, n);
            for (int x = -8; x <= 8; ++x) {
                const auto i = static_cast<std::size_t>(std::abs(x));
                const double expected = i < taps.size() ? taps[i] * taps[0] : 0;
                // Taps of less than 1 / 512 of what they were may be left out.
                EXPECT_NEAR((frame.scattering.at(24 + x, 16)[0] - low) / height, expected, 2e-3 * expected + 5e-4)
                    << static_cast<int>(kernel.filter) << ", " << n << " frames: " << x;
            }
        }
    }
}

TEST_F(VolumetricsFilter, KeepsItsWidthWhereNothingCountsFramesOrItMayNot) {
    settings.filter.sigma = 3;
    host.view_depth = [](int x, int) { return x < 24 ? 5.0F : 20.0F; };
    using volumetrics::Temporal;
    using volumetrics::TemporalPlace;
    const auto still = [&](Temporal temporal, TemporalPlace place, bool narrows) {
        settings.temporal.mode = Temporal::off;
        (void)render(Filter::none);
        settings.temporal.mode = temporal;
        settings.temporal.place = place;
        settings.filter.narrows = narrows;
        (void)render(Filter::gaussian15);
        (void)render(Filter::gaussian15);
        return render(Filter::gaussian15).scattering;
    };
    const Image plain = still(Temporal::off, TemporalPlace::before, true);
    EXPECT_GT(difference(still(Temporal::accumulate, TemporalPlace::before, true), plain), 0.01);
    EXPECT_LT(difference(still(Temporal::accumulate, TemporalPlace::before, false), plain), 1e-3);
    EXPECT_LT(difference(still(Temporal::accumulate, TemporalPlace::after, true), plain), 1e-3);
    EXPECT_LT(difference(still(Temporal::acceptance, TemporalPlace::before, true), plain), 1e-3);
}

TEST_F(VolumetricsFilter, NarrowKernelsKeepConstantsAndFetchLess) {
    host.count_work = true;
    settings.temporal.mode = volumetrics::Temporal::accumulate;
    settings.temporal.place = volumetrics::TemporalPlace::before;
    for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame first = render(Filter::gaussian15);
        Frame frame;
        for (int n = 2; n <= 32; ++n) frame = render(Filter::gaussian15);
        EXPECT_LT(difference(frame.scattering, first.scattering), 1e-3);
        EXPECT_LT(difference(frame.transmittance, first.transmittance), 1e-3);
        for (const char* pass : {"volumetrics/filter_horizontal", "volumetrics/filter_vertical"})
            EXPECT_LT(frame.work.at(pass)[int(gl::Work::texture_fetches)],
                      first.work.at(pass)[int(gl::Work::texture_fetches)]);
        settings.temporal.mode = volumetrics::Temporal::off;  // ends the history
        (void)render(Filter::none);
        settings.temporal.mode = volumetrics::Temporal::accumulate;
    }
}

}  // namespace
}  // namespace tyndall::test
