// The setting filter_depth: where the filter stops, and where it must not.

#include "tests/gpu/support/filter_fixture.h"

namespace tyndall::test {
namespace {

const std::vector<FilterDepth> by_depth{FilterDepth::relative, FilterDepth::plane};

TEST_F(VolumetricsFilter, DepthStepsAndTheSkyAreKept) {
    host.size = {48, 48};
    host.view_depth = [](int x, int y) { return y < 24 ? (x < 24 ? 5.0F : 20.0F) : (x < 24 ? 20.0F : sky); };
    settings.filter.sigma = 3;
    for (const glm::vec3 sigma_a : {glm::vec3(0.05F), glm::vec3(0.01F, 0.2F, 0.8F)}) {
        host.global[0].sigma_a = sigma_a;
        const Frame sharp = render(Filter::none);
        for (const Published& kernel : kernels)
            for (const FilterDepth depth : by_depth) {
                expect_to_rounding(render(kernel.filter, depth), sharp);
            }
    }
}

TEST_F(VolumetricsFilter, ASlopedSurfaceIsFilteredAndItsNoiseAway) {
    // Steps of 4% in depth from pixel to pixel are one surface; dithered shadows on it are smoothed.
    host.view_depth = [](int x, int) { return 10.0F * std::pow(1.04F, static_cast<float>(x)); };
    dither_shadows();
    settings.filter.sigma = 2;
    const auto roughness = [&](Filter filter, FilterDepth depth) {
        const Frame frame = render(filter, depth);
        double sum = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 1; x < 48; ++x)
                sum += std::pow(frame.scattering.at(x, y)[0] - frame.scattering.at(x - 1, y)[0], 2);
        return std::sqrt(sum);
    };
    const double sharp = roughness(Filter::none, FilterDepth::none);
    for (const FilterDepth depth : by_depth) EXPECT_LT(roughness(Filter::gaussian15, depth), 0.3 * sharp);
}

// A floor to the horizon, a plane that slopes in both directions, and both seen from far below and beside.
const std::vector<std::function<float(int, int)>> planes{
    [](int, int y) { return 200 / (static_cast<float>(y) + 0.5F); },
    [](int x, int) { return 200 / (static_cast<float>(x) + 0.5F); },
    [](int x, int y) { return 200 / (80 - 0.6F * static_cast<float>(x) + 2 * static_cast<float>(y)); }};

TEST_F(VolumetricsFilter, PlanesAreFilteredAsIfThereWereNoDepth) {
    dither_shadows();
    for (const auto& plane : planes)
        for (const Published& kernel : kernels) {
            host.view_depth = plane;
            const Frame none = render(kernel.filter);
            EXPECT_LT(difference(render(kernel.filter, FilterDepth::plane).scattering, none.scattering), 1e-3)
                << static_cast<int>(kernel.filter);
        }
}

TEST_F(VolumetricsFilter, RelativeUnderFiltersAGrazingFloorAndPlaneDoesNot) {
    dither_shadows();
    // All of it lies behind max_distance, so all pixels march the same segments: what varies is noise.
    host.view_depth = [](int, int y) { return 20000 / (static_cast<float>(y) + 0.5F); };
    const auto roughness = [&](FilterDepth depth) {
        const Frame frame = render(Filter::box5, depth);
        double sum = 0;
        for (int y = 24; y < 31; ++y)  // near the horizon; the picture's row 0 is at the top
            for (int x = 1; x < 48; ++x) {
                const double here = frame.scattering.at(x, y)[0];
                sum += std::pow(here - frame.scattering.at(x - 1, y)[0], 2) +
                       std::pow(here - frame.scattering.at(x, y + 1)[0], 2);
            }
        return std::sqrt(sum);
    };
    const double none = roughness(FilterDepth::none);
    EXPECT_GT(roughness(FilterDepth::relative), 1.5 * none);
    EXPECT_LT(roughness(FilterDepth::plane), 1.01 * none);
}

// Each side of a silhouette is filtered as a picture of it alone would be, where what is outside is left out.
TEST_F(VolumetricsFilter, SilhouettesCutTheKernelOff) {
    dither_shadows();
    const auto wall = [](int x, int) { return 1 / (1.5F + 0.002F * static_cast<float>(x)); };
    for (const Published& kernel : kernels) {
        host.size = {48, 32};
        host.view_depth = [&](int x, int y) { return x >= 24 ? wall(x, y) : y < 24 ? planes[2](x, y) : sky; };
        const Frame both = render(kernel.filter, FilterDepth::plane);
        host.size = {24, 24};
        host.view_depth = planes[2];
        const Frame floor = render(kernel.filter);
        host.size = {24, 32};
        host.view_depth = [&](int x, int y) { return wall(x + 24, y); };
        const Frame right = render(kernel.filter);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 24; ++x) {
                const double expected = right.scattering.at(x, y)[0];
                ASSERT_NEAR(both.scattering.at(x + 24, y)[0], expected, 2e-3 * expected) << x << ", " << y;
                if (y < 8) continue;
                const double below = floor.scattering.at(x, y - 8)[0];
                ASSERT_NEAR(both.scattering.at(x, y)[0], below, 2e-3 * below) << x << ", " << y;
            }
    }
}

TEST_F(VolumetricsFilter, AThinPoleIsNotSmearedAndTheWallBehindItIsOne) {
    for (const int width : {1, 2})
        for (const bool upright : {true, false}) {
            const auto is_pole = [&](int i) { return i >= 12 && i < 12 + width; };
            host.view_depth = [&](int x, int y) {
                const int i = upright ? x : 31 - y;
                return is_pole(i) ? 3.0F : 1 / (0.02F + 0.004F * static_cast<float>(i));
            };
            const Frame sharp = render(Filter::none);
            const auto at = [&](const Frame& frame, int i) {
                return double(upright ? frame.scattering.at(i, 16)[0] : frame.scattering.at(16, i)[0]);
            };
            std::vector<double> line;
            for (int i = 0; i < 32; ++i) line.push_back(at(sharp, i));
            for (const Published& kernel : kernels) {
                const Frame frame = render(kernel.filter, FilterDepth::plane);
                for (int i = 0; i < 24; ++i) {
                    const double expected =
                        filtered(line, i, kernel.taps, [&](int j) { return is_pole(i) == is_pole(j); });
                    EXPECT_NEAR(at(frame, i), expected, 2e-3 * expected) << i << ", width " << width;
                }
            }
        }
}

TEST_F(VolumetricsFilter, PlanesOfAlternatingDepthAreFilteredAndTheirEdgesKept) {
    dither_shadows();
    settings.resolution.upsample = volumetrics::Upsample::nearest;
    settings.resolution.depth = volumetrics::DepthChoice::checkerboard;
    for (const auto resolution : {volumetrics::Resolution::half, volumetrics::Resolution::quarter}) {
        settings.resolution.size = resolution;
        host.size = {96, 64};
        for (const auto& plane : planes) {
            host.view_depth = plane;
            const Frame none = render(Filter::box5);
            EXPECT_LT(difference(render(Filter::box5, FilterDepth::plane).scattering, none.scattering), 1e-3);
        }
        host.view_depth = [](int x, int y) { return (x + 2 * y) % 31 < 13 ? 4.0F : 20.0F; };  // faces the eye
        const Frame relative = render(Filter::uniform9, FilterDepth::relative);
        EXPECT_LT(difference(render(Filter::uniform9, FilterDepth::plane).scattering, relative.scattering), 1e-3);
    }
}

TEST_F(VolumetricsFilter, AnyDepthGivesFiniteValuesInRange) {
    std::uint32_t seed = 1;
    host.size = {47, 33};
    host.global[0].sigma_a = glm::vec3(0.01F, 0.2F, 0.8F);
    for (const float falloff : {0.0F, 3.0F, 100.0F})
        for (const Published& kernel : kernels)
            for (const FilterDepth depth : depth_modes) {
                host.view_depth = [&](int, int) {
                    seed = seed * 1664525U + 1013904223U;
                    const float r = static_cast<float>(seed >> 8) / 16777216.0F;
                    return r < 0.2F ? sky : 0.1F * std::pow(1e9F, r);
                };
                settings.filter.depth_falloff = falloff;
                const Frame frame = render(kernel.filter, depth);
                for (const float v : frame.scattering.pixels) ASSERT_TRUE(v >= 0 && v < 65504) << v;
                for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1) << v;
            }
}

}  // namespace
}  // namespace tyndall::test
