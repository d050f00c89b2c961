// Sunlight from samples along the sun's lines, against trees that every pixel asks; and trees against every cell.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

class VolumetricsEpipolarSunlight : public GlTest {
  protected:
    StubHost host;
    Settings settings = plain_settings(2);

    void SetUp() override {
        settings.technique = "epipolar";
        settings.march.max_distance = 60;
        host.size = {160, 90};
        host.eye = {0.3F, 0, 0};
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.2F));
        host.sun_illuminance = glm::vec3(10);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.01F), .anisotropy = 0.4F}};
        host.shadows = 1;
        floor_and_sky();
    }
    /// A floor 2 m below the eye, with the camera level.
    void floor_and_sky() {
        host.view_depth = [this](int x, int y) {
            const glm::vec3 ray = host.ray(x, y);
            return ray.y < -0.01F ? 2 * ray.z / ray.y : sky;
        };
    }
    [[nodiscard]] Frame render(int step) {
        settings.epipolar.step = step;
        return host.render(settings);
    }
    struct Difference {
        double relative_rms, largest;  ///< over the mean
    };
    [[nodiscard]] Difference difference(int step) {
        const Frame exact = render(1), found = render(step);
        double squares = 0, sum = 0, largest = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double value = found.scattering.at(x, y)[c], truth = exact.scattering.at(x, y)[c];
                    EXPECT_TRUE(std::isfinite(value) && value >= 0) << x << ' ' << y;
                    squares += (value - truth) * (value - truth);
                    sum += truth;
                    largest = std::max(largest, std::abs(value - truth));
                    EXPECT_NEAR(found.transmittance.at(x, y)[c], exact.transmittance.at(x, y)[c], 2e-3);
                }
        const double values = 3.0 * host.size.x * host.size.y;
        return {std::sqrt(squares / values) / (sum / values), largest / (sum / values)};
    }
    [[nodiscard]] std::uint64_t work(const Frame& frame, const std::string& pass, gl::Work kind) const {
        const auto found = frame.work.find("volumetrics/" + pass);
        return found == frame.work.end() ? 0 : found->second[static_cast<std::size_t>(kind)];
    }
};

TEST_F(VolumetricsEpipolarSunlight, TreesFindWhatEveryCellSays) {
    host.shadows = 4;
    host.count_work = true;
    for (const glm::vec3 to_sun :
         {glm::vec3(0.1F, 0.3F, -1), glm::vec3(-0.8F, 1, 0.1F), glm::vec3(0.3F, 0.4F, 1)}) {
        host.sun_direction = -glm::normalize(to_sun);
        settings.epipolar.tree = true;
        const Frame tree = render(1);
        settings.epipolar.tree = false;
        const Frame cells = render(1);
        double largest = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x)
                largest = std::max(
                    largest, std::abs(double{tree.scattering.at(x, y)[0]} / cells.scattering.at(x, y)[0] - 1));
        EXPECT_LE(largest, 1e-3) << "half a unit of the last place of half floats";
        EXPECT_LT(work(tree, "epipolar", gl::Work::tree_nodes), work(cells, "epipolar", gl::Work::tree_nodes));
    }
}

TEST_F(VolumetricsEpipolarSunlight, OfAnOpenViewTreesReadFarLessThanEveryCell) {
    host.shadows = 3;
    host.count_work = true;
    const Frame tree = render(1);
    settings.epipolar.tree = false;
    const Frame cells = render(1);
    EXPECT_LT(10 * work(tree, "epipolar", gl::Work::tree_nodes), work(cells, "epipolar", gl::Work::tree_nodes));
}

TEST_F(VolumetricsEpipolarSunlight, SamplesAgreeWithPixelsWhereverTheSunIs) {
    settings.epipolar.spacing = 0.5F;
    for (const int shadows : {1, 3}) {
        host.shadows = shadows;
        for (const glm::vec3 to_sun :
             {glm::vec3(0.1F, 0.2F, -1), glm::vec3(0.55F, 0.56F, -1), glm::vec3(1, 0.6F, -0.4F),
              glm::vec3(0.3F, 0.3F, 1), glm::vec3(-0.2F, 1, 0.1F), glm::vec3(0.01F, 0.05F, 1)}) {
            host.sun_direction = -glm::normalize(to_sun);
            const double found = difference(16).relative_rms;
            std::printf("%d: %.4f\n", shadows, found);
            EXPECT_LT(found, 0.03) << shadows << ": " << to_sun.x << ' ' << to_sun.y << ' ' << to_sun.z;
        }
    }
}

TEST_F(VolumetricsEpipolarSunlight, CloserSamplesDifferLess) {
    settings.epipolar.spacing = 0.25F;
    host.sun_direction = -glm::normalize(glm::vec3(1, 0.6F, -0.4F));
    const double coarse = difference(32).relative_rms, fine = difference(4).relative_rms;
    std::printf("32: %.4f, 4: %.4f\n", coarse, fine);
    EXPECT_LE(fine, coarse);
    EXPECT_LT(fine, 0.02);
}

TEST_F(VolumetricsEpipolarSunlight, UnshadowedItIsTheSame) {
    host.shadows = 0;
    const Difference found = difference(16);
    EXPECT_LT(found.relative_rms, 0.003);
    EXPECT_LT(found.largest, 0.03);
}

TEST_F(VolumetricsEpipolarSunlight, ColouredExtinctionHeightAndLocalMedia) {
    host.global = {{.sigma_s = glm::vec3(0.05F, 0.08F, 0.1F),
                    .sigma_a = glm::vec3(0.02F, 0.01F, 0),
                    .anisotropy = 0.4F,
                    .height = true,
                    .base = -2,
                    .falloff = 4},
                   {.sigma_s = glm::vec3(0.01F, 0.02F, 0.04F), .rayleigh = true}};
    settings.march.steps = 6;
    settings.epipolar.spacing = 0.5F;
    EXPECT_LT(difference(8).relative_rms, 0.03);
    host.local = {
        {.center = {1, 1, -8}, .half_extent = glm::vec3(3), .sigma_s = glm::vec3(0.2F), .anisotropy = 0.2F}};
    EXPECT_LT(difference(8).relative_rms, 0.04);
    host.global = {};
    EXPECT_LT(difference(8).relative_rms, 0.06) << "most rays meet no medium";
}

// Poles a pixel wide before the sky: beside each break a sample asks, and what no sample has seen is marched.
TEST_F(VolumetricsEpipolarSunlight, BreaksOfDepthDoNotBleed) {
    host.count_work = true;
    host.shadows = 3;
    host.view_depth = [](int x, int y) { return x % 7 == 0 ? 3.0F : y % 11 == 0 ? 8.0F : sky; };
    host.sun_direction = -glm::normalize(glm::vec3(1, 0.6F, -0.4F));
    const Difference found = difference(16);
    EXPECT_LT(found.relative_rms, 0.03);
    EXPECT_LT(found.largest, 0.3);
    settings.epipolar.spacing = 4;
    const Frame coarse = render(16);
    EXPECT_GT(work(coarse, "epipolar_fix_up", gl::Work::medium_samples), 0U) << "pixels without a sample";
    EXPECT_LT(difference(16).largest, 0.4);
}

TEST_F(VolumetricsEpipolarSunlight, FewRaysAskAndNoPixelIsLeftOfAPlane) {
    host.count_work = true;
    host.view_depth = [](int, int) { return 12.0F; };
    const Frame exact = render(1), found = render(16);
    const auto nodes = [&](const Frame& frame, const char* pass) {
        return work(frame, pass, gl::Work::tree_nodes);
    };
    EXPECT_LT(4 * nodes(found, "epipolar_walk"), nodes(exact, "epipolar"));
    EXPECT_EQ(nodes(found, "epipolar_fix_up"), 0U);
    EXPECT_EQ(nodes(found, "epipolar"), 0U);
    EXPECT_LT(work(found, "epipolar_lines", gl::Work::shadow_lookups),
              work(exact, "epipolar_lines", gl::Work::shadow_lookups))
        << "lines end with what is seen";
}

TEST_F(VolumetricsEpipolarSunlight, SmallLongAndLowPictures) {
    host.shadows = 3;
    host.eye = {3, 0, 0};  // the middle ray is lit
    host.view_depth = [](int, int) { return 10.0F; };
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(1024, 4)}) {
        host.size = size;
        EXPECT_LT(difference(16).relative_rms, 0.03) << size.x << 'x' << size.y;
    }
    host.size = {101, 57};
    settings.resolution.size = volumetrics::Resolution::quarter;
    EXPECT_LT(difference(16).relative_rms, 0.03);
}

TEST_F(VolumetricsEpipolarSunlight, WithLampsTheyAreTheSame) {
    host.lights = {point_light({1, 1, -5}, 20, 30)};
    EXPECT_LT(difference(16).relative_rms, 0.03);
}

TEST_F(VolumetricsEpipolarSunlight, WithoutSamplesOrSunItsPassesSayWhy) {
    EXPECT_EQ(render(1).skipped.at("volumetrics/epipolar_walk"), "epipolar_step is 1");
    EXPECT_EQ(render(8).skipped.at("volumetrics/epipolar_view"), "nobody asks for it");
    host.has_sun = false;
    host.lights = {point_light({1, 1, -5}, 20, 30)};
    EXPECT_EQ(render(8).skipped.at("volumetrics/epipolar_walk"), "no sun");
}

}  // namespace
}  // namespace tyndall::test
