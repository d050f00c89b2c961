// Density grids as local media, against sums over their voxels that know nothing of bricks, levels and textures.

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "engine/core/error.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/light_probe.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/support/voxels.h"
#include "volumetrics/technique.h"

namespace tyndall::test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::shared_ptr<const volumetrics::DensityGrid> module_grid(const Voxels& voxels) {
    const std::shared_ptr<const DensityGrid> grid = voxels.grid();
    return volumetrics::density_grid(grid->bricks, grid->values, grid);
}

glm::dmat4 placed(glm::dvec3 center, glm::dvec3 scale, double angle) {
    glm::dmat4 m = glm::mat4_cast(glm::angleAxis(angle, glm::normalize(glm::dvec3(1, 2, -0.5))));
    for (int i = 0; i < 3; ++i) m[i] *= scale[i];
    m[3] = glm::dvec4(center, 1);
    return m;
}

class VolumetricsGrid : public GlTest, public testing::WithParamInterface<std::string> {
  protected:
    VolumetricsGrid() {
        host.size = {24, 18};
        host.vertical_fov = 0.6F;
        host.view_depth = [](int, int) { return sky; };
    }
    StubHost host;

    [[nodiscard]] static Settings settings() {
        Settings settings = plain_settings(32);
        settings.technique = GetParam();
        settings.reference.steps = 256;
        settings.froxels.x = settings.froxels.y = 48;
        settings.billboards.fade = 0;
        return settings;
    }
    /// Of a pixel's ray, in the mean over the voxels it passes, by a sum as fine as asked.
    [[nodiscard]] double depth(const Voxels& voxels, const LocalMedium& medium, int x, int y,
                               int parts = 4000) const {
        const glm::dvec3 d = glm::normalize(glm::dvec3(host.ray(x, y)));
        const double end = 40, step = end / parts;
        double sum = 0;
        for (int i = 0; i < parts; ++i) {
            const glm::dvec3 p = glm::dvec3(host.eye) + d * (step * (i + 0.5));
            sum += voxels.at(glm::dvec3(medium.world_to_voxel * glm::dvec4(p, 1)), medium.nearest);
        }
        return double(medium.sigma_a.x + medium.sigma_s.x) * sum * step;
    }
    struct Error {
        double worst = 0, mean = 0;
    };
    /// Of transmittance.
    Error error(const Voxels& voxels, const LocalMedium& medium) {
        host.local = {medium};
        const Frame frame = host.render(settings());
        Error error;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const double expected = std::exp(-depth(voxels, medium, x, host.size.y - 1 - y));
                const double off = double(frame.transmittance.at(x, y)[0]) - expected;
                error.worst = std::max(error.worst, std::abs(off));
                error.mean += off / (host.size.x * host.size.y);
            }
        return error;
    }
};

INSTANTIATE_TEST_SUITE_P(Techniques, VolumetricsGrid,
                         testing::Values("ray_march", "froxel", "billboards", "reference"),
                         [](const auto& info) { return info.param; });

TEST_P(VolumetricsGrid, VoxelsOfOneAreABox) {
    Voxels voxels;
    for (int z = -3; z < 17; ++z)
        for (int y = 5; y < 17; ++y)
            for (int x = -20; x < 4; ++x) voxels.set({x, y, z}, 1);
    for (const double angle : {0.0, 0.8}) {
        LocalMedium medium{.sigma_a = glm::vec3(0.4F)};
        const glm::dmat4 at_origin = placed({}, glm::dvec3(0.2, 0.3, 0.25), angle);
        const glm::dvec3 middle(at_origin * glm::dvec4(-8.5, 10.5, 6.5, 1));
        set_grid(medium, module_grid(voxels),
                 placed(glm::dvec3(0, 0, -12) - middle, glm::dvec3(0.2, 0.3, 0.25), angle), true);
        LocalMedium box{.shape = Shape::box, .sigma_a = glm::vec3(0.4F)};
        box.center = {0, 0, -12};
        box.half_extent = {2.4F, 1.8F, 2.5F};
        box.rotation = medium.rotation;
        EXPECT_NEAR(glm::distance(medium.center, box.center), 0, 1e-4);
        EXPECT_NEAR(glm::distance(medium.half_extent, box.half_extent), 0, 1e-4);
        host.local = {box};
        const Frame expected = host.render(settings());
        host.local = {medium};
        const Frame given = host.render(settings());
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x)
                EXPECT_NEAR(given.transmittance.at(x, y)[0], expected.transmittance.at(x, y)[0], 1e-3)
                    << x << " " << y << ", turned by " << angle;
    }
}

// Lumps of a few voxels with gaps of whole bricks between them, along and across bricks' borders; first with pixels
// smaller than voxels, then with larger ones, which see the mean over what they cover.
TEST_P(VolumetricsGrid, SparseVoxelsDimAsTheirSum) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    Voxels voxels;
    for (int lump = 0; lump < 40; ++lump) {
        const glm::ivec3 at(glm::vec3(unit(random), unit(random), unit(random)) * glm::vec3(90, 60, 70) - 20.0F);
        for (int i = 0; i < 200; ++i)
            voxels.set(at + glm::ivec3(glm::vec3(unit(random), unit(random), unit(random)) * 7.0F), unit(random));
    }
    for (const bool nearest : {false, true}) {
        LocalMedium medium{.sigma_a = glm::vec3(2)};
        set_grid(medium, module_grid(voxels), placed({-2.3, -1, -14}, glm::dvec3(0.08, 0.1, 0.09), 0.3), nearest);
        for (const float fov : {0.06F, 0.6F}) {
            host.vertical_fov = fov;
            const Error off = error(voxels, medium);
            std::printf("%s %s: worst %.4f, mean %.5f\n", GetParam().c_str(), nearest ? "nearest" : "linear",
                        off.worst, off.mean);
            if (fov < 0.1F) {
                EXPECT_LE(off.worst, nearest ? 0.05 : 0.01);
            }
            EXPECT_NEAR(off.mean, 0, 3e-3);
        }
    }
}

// A lump with holes, 20 voxels across.
Voxels cloud() {
    Voxels voxels;
    for (int z = -10; z <= 10; ++z)
        for (int y = -10; y <= 10; ++y)
            for (int x = -10; x <= 10; ++x) {
                const double rim = 10 - glm::length(glm::dvec3(x, y, z));
                const double lumps =
                    0.5 + 0.5 * std::sin(1.1 * x + 0.4 * z) * std::sin(0.9 * y) * std::sin(0.7 * z + 1);
                if (rim > 0) voxels.set({x, y, z}, static_cast<float>(std::min(rim / 3, 1.0) * lumps));
            }
    return voxels;
}

class VolumetricsGridLight : public GlTest {
  protected:
    VolumetricsGridLight() {
        host.view_depth = [](int, int) { return 20.0F; };
        medium.sigma_s = {0.3F, 0.4F, 0.5F};
        medium.sigma_a = glm::vec3(0.1F);
        place({0, 0, -12});
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.4F, -0.8F, -0.3F));
    }
    void place(glm::dvec3 center, double angle = 0.4) {
        set_grid(medium, grid, placed(center, glm::dvec3(0.2, 0.25, 0.2), angle));
        host.local = {medium};
    }
    /// Of the density, from a point on, m.
    [[nodiscard]] double density_length(glm::dvec3 from, glm::dvec3 direction, double length) const {
        constexpr int parts = 2000;
        double sum = 0;
        for (int i = 0; i < parts; ++i) {
            const glm::dvec3 p = from + direction * (length * (i + 0.5) / parts);
            sum += voxels.at(glm::dvec3(medium.world_to_voxel * glm::dvec4(p, 1)), false);
        }
        return sum * length / parts;
    }
    /// In the cloud, before it and behind it, seen from a light.
    [[nodiscard]] std::vector<glm::vec3> points(std::size_t count) const {
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(-1, 1);
        std::vector<glm::vec3> all;
        while (all.size() < count)
            all.push_back(medium.center + 3.0F * glm::vec3(unit(random), unit(random), unit(random)) +
                          host.sun_direction * (3 * unit(random)));
        return all;
    }
    void expect_sun(double tolerance) {
        const std::vector<glm::vec3> at = points(200);
        const std::vector<glm::vec3> found = probe.transmittance(host, settings, at);
        double worst = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double length = density_length(at[i], -glm::dvec3(host.sun_direction), 30);
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::abs(double(found[i][c]) -
                                             std::exp(-double(medium.sigma_s[c] + medium.sigma_a[c]) * length)));
        }
        EXPECT_LE(worst, tolerance);
    }
    const std::string sun_pass = "volumetrics/grid_sun_volume";
    Voxels voxels = cloud();
    std::shared_ptr<const volumetrics::DensityGrid> grid = module_grid(voxels);
    LocalMedium medium;
    StubHost host;
    Settings settings = plain_settings(8);
    LightProbe probe;
};

TEST_F(VolumetricsGridLight, TheSunIsDimmedByTheVoxelsOnItsWay) {
    for (const double elevation : {10.0, 30.0, 60.0}) {
        const double up = glm::radians(elevation);
        host.sun_direction = glm::vec3(-std::cos(up) * 0.8, -std::sin(up), std::cos(up) * 0.6);
        expect_sun(0.02);
        EXPECT_EQ(probe.skipped(sun_pass), "");
    }
}

TEST_F(VolumetricsGridLight, AFinerVolumeIsNearerToTheVoxels) {
    expect_sun(0.02);
    settings.light_volumes.grid_detail = 2;
    expect_sun(0.006);
    EXPECT_EQ(probe.skipped(sun_pass), "");
}

TEST_F(VolumetricsGridLight, WindMakesNothingAnewATurnDoes) {
    expect_sun(0.02);
    EXPECT_EQ(probe.skipped(sun_pass), "");
    place({1.3, 0.2, -10});
    expect_sun(0.02);
    EXPECT_NE(probe.skipped(sun_pass), "");
    place({1.3, 0.2, -10}, 0.9);
    expect_sun(0.02);
    EXPECT_EQ(probe.skipped(sun_pass), "");
}

// Thin voxels fill the picture: a piece a voxel, with one value each, and the sun at two places of it; and one
// before all.
TEST_F(VolumetricsGridLight, ReadsAreCountedApart) {
    Voxels slab;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 6; ++x) slab.set({x, y, z}, 1e-3F);
    grid = module_grid(slab);
    set_grid(medium, grid, placed({-10, -10, -14}, {4, 4, 1}, 0));
    host.local = {medium};
    host.size = {8, 8};
    host.vertical_fov = 0.02F;
    host.count_work = true;
    settings.march.steps = 1;
    const auto count = [](const gl::WorkCounts& work, gl::Work kind) {
        return work[static_cast<std::size_t>(kind)];
    };
    const gl::WorkCounts lit = host.render(settings).work.at("volumetrics/march");
    const std::uint64_t pixels = 64, pieces = count(lit, gl::Work::grid_reads);
    EXPECT_GE(pieces, 6 * pixels);
    EXPECT_LE(pieces, 8 * pixels);
    EXPECT_EQ(count(lit, gl::Work::grid_light_reads), 2 * pieces + pixels);
    EXPECT_EQ(count(lit, gl::Work::medium_samples), 2 * pieces);
    EXPECT_GT(count(lit, gl::Work::grid_page_reads), pieces);
    settings.march.grid_piece = 0.5F;
    const std::uint64_t halves = count(host.render(settings).work.at("volumetrics/march"), gl::Work::grid_reads);
    EXPECT_GE(halves, 2 * pieces - pixels);
    EXPECT_LE(halves, 2 * pieces);
    settings.march.grid_piece = 1;
    host.has_sun = false;
    const gl::WorkCounts dark = host.render(settings).work.at("volumetrics/march");
    EXPECT_EQ(count(dark, gl::Work::grid_light_reads), 0U);
    EXPECT_EQ(count(dark, gl::Work::grid_reads), pieces);
}

// A pixel sees about a voxel, so that a lower resolution leaves out detail; and what is beside the cloud is not
// drawn again.
TEST_F(VolumetricsGridLight, LowResolutionDrawsAgainWhatItCannotTell) {
    using volumetrics::Filter, volumetrics::Resolution;
    host.size = {48, 36};
    host.vertical_fov = 0.9F;
    host.view_depth = [](int, int) { return sky; };
    host.count_work = true;
    const auto render = [&](Resolution resolution, float tolerance) {
        settings.resolution.size = resolution;
        settings.resolution.tolerance = tolerance;
        return host.render(settings);
    };
    const auto reads = [](const Frame& frame, const std::string& pass) {
        return frame.work.at(pass)[static_cast<std::size_t>(gl::Work::grid_reads)];
    };
    for (const auto& [filter, resolution] : {std::pair{Filter::none, Resolution::half},
                                             {Filter::none, Resolution::quarter},
                                             {Filter::gaussian15, Resolution::half}}) {
        settings.filter.kernel = filter;
        const Frame full = render(Resolution::full, 0.1F), refined = render(resolution, 0.1F),
                    coarse = render(resolution, 1);
        const auto error = [&](const Frame& frame) {
            double squares = 0, sum = 0;
            for (int y = 0; y < host.size.y; ++y)
                for (int x = 0; x < host.size.x; ++x) {
                    const double expected = full.scattering.at(x, y)[1];
                    squares += std::pow(double(frame.scattering.at(x, y)[1]) - expected, 2);
                    sum += expected * expected;
                }
            return std::sqrt(squares / sum);
        };
        std::printf("resolution 1/%d: error %.4f, %.4f where nothing is drawn again\n", 1 << int(resolution),
                    error(refined), error(coarse));
        EXPECT_LT(error(refined), 0.05);
        EXPECT_GT(error(coarse), 2 * error(refined));
        EXPECT_EQ(coarse.skipped.at("volumetrics/refine"), "resolution_tolerance is 1");
        EXPECT_EQ(full.skipped.at("volumetrics/refine"), "resolution is full");
        EXPECT_LT(reads(refined, "volumetrics/refine"), reads(full, "volumetrics/march"));
    }
}

TEST_F(VolumetricsGridLight, SeveralGridsAreTheProductOfEach) {
    const std::vector<glm::vec3> at = points(60);
    const LocalMedium first = medium;
    place({1, 1.5, -11}, 2);
    const LocalMedium second = medium;
    const LocalMedium ball{.center = {-1, 2, -12}, .half_extent = glm::vec3(1.5F), .sigma_a = glm::vec3(0.4F)};
    const auto alone = [&](const LocalMedium& one) {
        host.local = {one};
        return probe.transmittance(host, settings, at);
    };
    const std::vector<glm::vec3> a = alone(first), b = alone(second), c = alone(ball);
    host.local = {first, ball, second};
    const std::vector<glm::vec3> all = probe.transmittance(host, settings, at);
    for (std::size_t i = 0; i < at.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(all[i][channel], a[i][channel] * b[i][channel] * c[i][channel], 0.02);
}

// In a cube of ones under a sun straight above, 2 m below its top and looking level along 3.5 m of it: the sun's
// optical depth is the same all along the ray, but for the cube's edge.
TEST_F(VolumetricsGridLight, LaterOrdersSeeHalfTheDepthAndScatterHalf) {
    Voxels ones;
    for (int z = 0; z < 20; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x) ones.set({x, y, z}, 1);
    LocalMedium cube{.sigma_s = glm::vec3(0.5F), .sigma_a = glm::vec3(0.1F)};
    set_grid(cube, module_grid(ones), placed({-1.9, -1.9, -13.9}, glm::dvec3(0.2), 0), true);
    host.local = {cube};
    host.eye = {0, 0, -10.5F};
    host.sun_direction = {0, -1, 0};
    host.sun_illuminance = glm::vec3(100);
    settings.light_volumes.grid_size = 64;
    for (const int orders : {1, 2, 4}) {
        settings.light.scattering_orders = orders;
        double expected = 0;
        for (int n = 0; n < orders; ++n)
            expected += std::exp2(-n) * 0.5 * 100 * phase_hg(0, 0) * std::exp(-0.6 * 2 * std::exp2(-n)) *
                        -std::expm1(-0.6 * 3.5) / 0.6;
        const Frame frame = host.render(settings);
        EXPECT_NEAR(frame.transmittance.at(0, 0)[0], std::exp(-0.6 * 3.5), 1e-3);
        EXPECT_NEAR(frame.scattering.at(0, 0)[0], expected, 0.02 * expected) << orders << " orders";
    }
}

TEST_F(VolumetricsGridLight, LampsAreDimmedByTheVoxelsOnTheirWay) {
    host.has_sun = false;
    host.lights = {point_light({0, 6, -12}, 1, 40)};
    settings.light_volumes.lamp_size = 48;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<glm::vec3> at;
    for (int i = 0; i < 100; ++i)
        at.push_back(medium.center + 2.5F * glm::vec3(unit(random), unit(random), unit(random)));
    const std::vector<glm::vec3> found = probe.transmittance(host, settings, at, 0);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const glm::dvec3 to_lamp = glm::dvec3(0, 6, -12) - glm::dvec3(at[i]);
        const double length = density_length(at[i], glm::normalize(to_lamp), glm::length(to_lamp));
        EXPECT_NEAR(found[i].g, std::exp(-0.5 * length), 0.04);
    }
}

// Of the same size, place and greatest value: nothing but the voxels tells them apart.
TEST_F(VolumetricsGridLight, AnotherGridInTheSamePlaceMakesLampVolumesAnew) {
    host.has_sun = false;
    host.lights = {point_light({0, 6, -12}, 1, 40)};
    Voxels ones, hollow;
    for (int z = 0; z < 20; ++z)
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 20; ++x) {
                ones.set({x, y, z}, 1);
                if (y == 0 || y == 19 || x == 0 || x == 19 || z == 0 || z == 19) hollow.set({x, y, z}, 1);
            }
    const auto below = [&](const Voxels& of) {
        set_grid(medium, module_grid(of), placed({-2, -2.5, -14}, glm::dvec3(0.2, 0.25, 0.2), 0));
        host.local = {medium};
        return probe.transmittance(host, settings, {glm::vec3(0, -4, -12)}, 0)[0].g;
    };
    EXPECT_NEAR(below(ones), std::exp(-0.5 * 5), 0.03);
    EXPECT_NEAR(below(hollow), std::exp(-0.5 * 0.5), 0.03);
}

TEST_F(VolumetricsGridLight, OutOfViewAndWithItsShadowItCostsNothingAndIsKept) {
    expect_sun(0.02);
    const LocalMedium behind_eye = [&] {
        place({0, 0, 40});
        return medium;
    }();
    host.local = {behind_eye};
    host.sun_direction = {0, -1, 0};
    host.global = {{.sigma_s = glm::vec3(0.1F)}};
    (void)probe.transmittance(host, settings, {glm::vec3(0)});
    EXPECT_NE(probe.skipped(sun_pass), "");
    Frame frame = host.render(settings);
    EXPECT_GT(frame.persistent_bytes, 100'000U);
    host.sun_direction = glm::normalize(glm::vec3(0, -0.2F, -1));  // its shadow falls into the view
    (void)probe.transmittance(host, settings, {glm::vec3(0)});
    EXPECT_EQ(probe.skipped(sun_pass), "");
    host.local.clear();
    frame = host.render(settings);
    EXPECT_LT(frame.persistent_bytes, 100'000U);
}

TEST_F(VolumetricsGridLight, WhatCannotBeIsSaid) {
    const std::vector<glm::ivec3> bricks{{0, 0, 0}, {8, 0, 0}};
    std::vector<float> values(1024, 1.0F);
    EXPECT_THAT([&] { (void)volumetrics::density_grid(bricks, std::span(values).first(1000), nullptr); },
                ThrowsMessage<Error>(HasSubstr("1000 values, 1024 expected")));
    values[7] = -1;
    EXPECT_THAT([&] { (void)volumetrics::density_grid(bricks, values, nullptr); },
                ThrowsMessage<Error>(HasSubstr("-1")));
    values[7] = NAN;
    EXPECT_THROW((void)volumetrics::density_grid(bricks, values, nullptr), Error);
    values[7] = 1;
    const std::vector<glm::ivec3> twice{{0, 0, 0}, {0, 0, 0}}, odd{{0, 0, 0}, {4, 0, 0}};
    EXPECT_THROW((void)volumetrics::density_grid(twice, values, nullptr), Error);
    EXPECT_THROW((void)volumetrics::density_grid(odd, values, nullptr), Error);
    EXPECT_THROW(set_grid(medium, grid, glm::dmat4(0)), Error);
    host.local.assign(9, medium);
    EXPECT_THAT([&] { (void)host.render(settings); }, ThrowsMessage<Error>(HasSubstr("9 density grids")));
    host.local = {{.shape = Shape::grid, .sigma_a = glm::vec3(1)}};
    EXPECT_THAT([&] { (void)host.render(settings); }, ThrowsMessage<Error>(HasSubstr("without a grid")));
    const std::vector<float> nothing(1024, 0.0F);
    set_grid(medium, volumetrics::density_grid(bricks, nothing, nullptr), glm::dmat4(1));
    host.local = {medium};
    EXPECT_TRUE(host.render(settings).live_passes.empty());
}

}  // namespace
}  // namespace tyndall::test
