// Settings resolution, resolution_depth and upsample: what each pixel of the host gets from the low resolution.
// All rays look the same way in a homogeneous medium under ambient light, unless a test says otherwise: a pixel's
// light is then a function of its depth alone, 0.5 (1 - exp(-0.1 depth)).

#include <gmock/gmock.h>

#include <cmath>
#include <tuple>

#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using volumetrics::DepthChoice;
using volumetrics::Resolution;
using volumetrics::Upsample;

constexpr std::array low_resolutions{Resolution::half, Resolution::quarter};
constexpr std::array choices{DepthChoice::min, DepthChoice::max, DepthChoice::checkerboard};
constexpr std::array modes{Upsample::nearest, Upsample::bilinear, Upsample::bilateral, Upsample::nearest_depth};
constexpr std::array edge_modes{Upsample::bilateral, Upsample::nearest_depth};
constexpr std::array odd_sizes{glm::ivec2(1), glm::ivec2(3, 5), glm::ivec2(33, 19)};

Settings settings(Resolution resolution, Upsample upsample = Upsample::bilateral,
                  DepthChoice choice = DepthChoice::checkerboard) {
    Settings settings = plain_settings(4);
    settings.resolution.size = resolution;
    settings.resolution.upsample = upsample;
    settings.resolution.depth = choice;
    return settings;
}

/// For messages.
std::string name_of(const Settings& s) {
    return "resolution " + std::to_string(int(s.resolution.size)) + ", upsample " +
           std::to_string(int(s.resolution.upsample)) + ", resolution_depth " +
           std::to_string(int(s.resolution.depth));
}

double light_at(double depth) {
    return 0.5 * -std::expm1(-0.1 * depth);
}

class VolumetricsResolution : public GlTest {
  protected:
    VolumetricsResolution() {
        host.size = {33, 19};
        host.vertical_fov = 1e-4F;
        host.ambient = glm::vec3(1);
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = glm::vec3(0.05F)}};
    }
    /// Largest |light - that of its depth| / that, over the pixels with y up.
    [[nodiscard]] double error_against_own_depth(const Frame& frame) const {
        double worst = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 0; x < host.size.x; ++x) {
                const float depth = host.view_depth(x, y);
                const double expected = depth == sky ? 0.5 : light_at(depth);
                worst = std::max(worst, std::abs(light(frame, x, y) / expected - 1));
            }
        return worst;
    }
    [[nodiscard]] double light(const Frame& frame, int x, int y) const {
        return frame.scattering.at(x, host.size.y - 1 - y)[0];
    }
    StubHost host;
};

TEST_F(VolumetricsResolution, ModesEqualFullResolutionOnAWallInSlowlyVaryingLight) {
    host.vertical_fov = 0.08F;
    host.lights = {point_light({3, 2, -6}, 100)};
    for (const glm::ivec2 size : {glm::ivec2(32, 16), glm::ivec2(33, 19)}) {
        host.size = size;
        const Image full = host.render(settings(Resolution::full)).scattering;
        EXPECT_GT(full.at(size.x - 1, 0)[0], 1.05 * full.at(0, size.y - 1)[0]) << "the light varies";
        for (const Resolution resolution : low_resolutions)
            for (const Upsample mode : modes) {
                const Settings s = settings(resolution, mode);
                const Image low = host.render(s).scattering;
                for (std::size_t i = 0; i < full.pixels.size(); ++i)
                    ASSERT_NEAR(low.pixels[i], full.pixels[i], 0.01 * full.pixels[i]) << name_of(s);
            }
    }
}

TEST_F(VolumetricsResolution, LowPixelsAreTheNearestOrFarthestOfTheirBlocks) {
    // Every pixel another depth, a sky pixel in some; `nearest` shows the low pixels as they are.
    host.view_depth = [](int x, int y) {
        return (7 * x + 3 * y) % 17 == 0 ? sky : 2 + static_cast<float>((5 * x + 11 * y) % 23);
    };
    for (const Resolution resolution : low_resolutions)
        for (const DepthChoice choice : choices) {
            const Settings s = settings(resolution, Upsample::nearest, choice);
            const Frame frame = host.render(s);
            const int f = resolution == Resolution::half ? 2 : 4;
            for (int y = 0; y < 19; ++y)
                for (int x = 0; x < 33; ++x) {
                    double nearest = 1e9, farthest = 0;
                    for (int v = y / f * f; v < std::min(y / f * f + f, 19); ++v)
                        for (int u = x / f * f; u < std::min(x / f * f + f, 33); ++u) {
                            const double depth = host.view_depth(u, v) == sky ? 1e6 : host.view_depth(u, v);
                            nearest = std::min(nearest, depth);
                            farthest = std::max(farthest, depth);
                        }
                    const bool even = (x / f + y / f) % 2 == 0;
                    const bool takes_nearest =
                        choice == DepthChoice::min || (choice == DepthChoice::checkerboard && even);
                    const double expected = light_at(takes_nearest ? nearest : farthest);
                    ASSERT_NEAR(light(frame, x, y), expected, 2e-3 * expected) << name_of(s) << x << ' ' << y;
                }
        }
}

TEST_F(VolumetricsResolution, BilinearIsLinearBetweenTheCentresOfBlocks) {
    // One depth a column of blocks, of which the last is cut to one pixel.
    host.size = {33, 4};
    for (const Resolution resolution : low_resolutions) {
        const int f = resolution == Resolution::half ? 2 : 4, last = 32 / f;
        const auto depth = [](int block) { return 3.0F + static_cast<float>(block * block % 7); };
        const auto centre = [&](int block) { return 0.5 * (block * f + std::min(block * f + f, 33)); };
        host.view_depth = [&](int x, int) { return depth(x / f); };
        const Frame frame = host.render(settings(resolution, Upsample::bilinear));
        for (int x = 0; x < 33; ++x) {
            int left = 0;
            while (left < last && centre(left + 1) < x + 0.5) ++left;
            const int right = std::min(left + 1, last);
            const double way = std::max(x + 0.5 - centre(left), 0.0);
            const double share = right > left ? way / (centre(right) - centre(left)) : 0;
            const double expected = (1 - share) * light_at(depth(left)) + share * light_at(depth(right));
            EXPECT_NEAR(light(frame, x, 1), expected, 2e-3 * expected) << x;
        }
    }
}

// Two walls, 5 and 20 m away, that meet at any column or row.
class VolumetricsResolutionEdge : public VolumetricsResolution,
                                  public ::testing::WithParamInterface<std::tuple<Resolution, bool>> {};

TEST_P(VolumetricsResolutionEdge, EachPixelHasTheLightOfItsOwnSide) {
    const auto [resolution, rows] = GetParam();
    double smeared = 0;
    for (const int edge : {1, 6, 7, 8, 9, 10, 18}) {
        host.view_depth = [edge, by_row = rows](int x, int y) { return (by_row ? y : x) < edge ? 5.0F : 20.0F; };
        for (const DepthChoice choice : choices) {
            // The side of one line is in no block's farthest depth.
            if (edge == 1 && choice == DepthChoice::max) continue;
            if (edge == 18 && rows && choice == DepthChoice::min && resolution == Resolution::quarter) continue;
            for (const Upsample mode : edge_modes) {
                const Settings s = settings(resolution, mode, choice);
                EXPECT_LT(error_against_own_depth(host.render(s)), 0.01) << name_of(s) << ", edge " << edge;
            }
            smeared = std::max(
                smeared, error_against_own_depth(host.render(settings(resolution, Upsample::bilinear, choice))));
        }
    }
    EXPECT_GT(smeared, 0.3) << "bilinear smears, so this can fail";
}

INSTANTIATE_TEST_SUITE_P(All, VolumetricsResolutionEdge,
                         ::testing::Combine(::testing::ValuesIn(low_resolutions), ::testing::Bool()));

TEST_F(VolumetricsResolution, SkyIsLikeItselfOnly) {
    host.view_depth = [](int x, int y) { return y >= 9 ? sky : x < 15 ? 20.0F : 5.0F; };
    for (const Resolution resolution : low_resolutions)
        for (const Upsample mode : edge_modes) {
            Settings s = settings(resolution, mode);
            s.filter.depth_falloff = 0;  // all depths are alike, but the sky is none
            host.view_depth = [](int, int y) { return y >= 9 ? sky : 5.0F; };
            EXPECT_LT(error_against_own_depth(host.render(s)), 0.01) << name_of(s);
        }
    EXPECT_GT(error_against_own_depth(host.render(settings(Resolution::half, Upsample::bilinear))), 0.1);
}

TEST_F(VolumetricsResolution, APoleOfOnePixelIsThereIfTheLowResolutionHoldsIt) {
    host.view_depth = [](int x, int) { return x == 17 ? 3.0F : 20.0F; };
    for (const Resolution resolution : low_resolutions)
        for (const Upsample mode : edge_modes) {
            for (const DepthChoice choice : {DepthChoice::min, DepthChoice::checkerboard}) {
                const Settings s = settings(resolution, mode, choice);
                EXPECT_LT(error_against_own_depth(host.render(s)), 0.01) << name_of(s);
            }
            // Nowhere the farthest: it has the light of what is behind it, and nothing else does.
            const Frame frame = host.render(settings(resolution, mode, DepthChoice::max));
            for (int x = 0; x < 33; ++x) EXPECT_NEAR(light(frame, x, 7), light_at(20), 0.01 * light_at(20)) << x;
        }
}

TEST_F(VolumetricsResolution, AGrazingFloorIsOneSurface) {
    // 2 m away at the lower border, 30 m at the upper one; buffer depth is linear. Neighbouring rows differ by up
    // to half of their depth, and yet none of the four low pixels is left out.
    // But for the uppermost row: beyond it nothing tells that the floor goes on.
    constexpr std::size_t row = 4 * 33;
    host.view_depth = [](int, int y) { return 1 / (0.5F - static_cast<float>(y) * (0.5F - 1 / 30.0F) / 18); };
    for (const Resolution resolution : low_resolutions)
        for (const DepthChoice choice : choices) {
            const Image bilinear = host.render(settings(resolution, Upsample::bilinear, choice)).scattering;
            for (const Upsample mode : edge_modes) {
                Settings s = settings(resolution, mode, choice);
                s.filter.depth_falloff = 100;
                const Image image = host.render(s).scattering;
                for (std::size_t i = row; i < image.pixels.size(); ++i)
                    ASSERT_NEAR(image.pixels[i], bilinear.pixels[i], 2e-3 * bilinear.pixels[i]) << name_of(s);
            }
        }
}

TEST_F(VolumetricsResolution, ColouredTransmittanceGoesTheSameWay) {
    const glm::vec3 sigma_a{0.01F, 0.2F, 0.8F};
    host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = sigma_a}};
    host.view_depth = [](int x, int) { return x < 15 ? 1.0F : 4.0F; };
    for (const Resolution resolution : low_resolutions)
        for (const Upsample mode : edge_modes) {
            const Frame frame = host.render(settings(resolution, mode));
            for (int x = 0; x < 33; ++x) {
                double mean = 0;
                for (int c = 0; c < 3; ++c) {
                    const double expected = std::exp(-(0.05 + sigma_a[c]) * host.view_depth(x, 0));
                    EXPECT_NEAR(frame.transmittance.at(x, 9)[c], expected, 2e-3 * expected);
                    mean += expected / 3;
                }
                EXPECT_NEAR(frame.scattering.at(x, 9)[3], mean, 2e-3 * mean);
            }
        }
}

TEST_F(VolumetricsResolution, OddSizesWork) {
    for (const char* technique : {"ray_march", "froxel"})
        for (const glm::ivec2 size : odd_sizes)
            for (const Resolution resolution : low_resolutions)
                for (const Upsample mode : modes) {
                    host.size = size;
                    Settings s = settings(resolution, mode);
                    s.technique = technique;
                    s.froxels.x = s.froxels.y = s.froxels.z = 8;
                    EXPECT_LT(error_against_own_depth(host.render(s)), 2e-3) << name_of(s) << ", width " << size.x;
                }
}

TEST_F(VolumetricsResolution, ABlockThatTheBorderCutsLooksThroughItsMiddle) {
    // One low pixel for the whole picture: its ray is the picture's axis, as of a picture of one pixel.
    host.vertical_fov = 2;
    host.lights = {point_light({0, 0, -6}, 100)};
    host.size = {1, 1};
    const float centre = host.render(settings(Resolution::full)).scattering.at(0, 0)[0];
    for (const int side : {1, 2, 3, 4}) {
        host.size = glm::ivec2(side);
        EXPECT_NEAR(host.render(settings(Resolution::quarter)).scattering.at(0, 0)[0], centre, 2e-3 * centre)
            << side;
    }
}

TEST_F(VolumetricsResolution, EverythingAtOnceIsFiniteAtAnySize) {
    host.vertical_fov = 1;
    host.has_sun = true;
    host.shadows = 1;
    host.lights = {point_light({0, 1, -4}, 100)};
    host.local = {{.center = {0, 0, -5}, .sigma_s = {0.1F, 0.2F, 0.3F}}};
    host.sun_direction = glm::normalize(glm::vec3(0.1F, -0.5F, 1));
    host.view_depth = [](int x, int y) { return (x + y) % 3 == 0 ? sky : (x + y) % 3 == 1 ? 0.1F : 50.0F; };
    for (const glm::ivec2 size : odd_sizes)
        for (const Upsample mode : modes) {
            host.size = size;
            Settings s = settings(size.x == 3 ? Resolution::quarter : Resolution::half, mode);
            s.filter.kernel = volumetrics::Filter::gaussian15;
            const Frame frame = host.render(s);
            ASSERT_EQ(frame.scattering.size, size);
            for (const float v : frame.scattering.pixels) ASSERT_TRUE(v >= 0 && std::isfinite(v));
            for (const float v : frame.transmittance.pixels) ASSERT_TRUE(v >= 0 && v <= 1);
        }
}

TEST_F(VolumetricsResolution, RadialShaftsFindTheSameWindow) {
    // Between the sun and a wall with a window, whose outline is that of blocks; the low picture covers 20 of 17
    // pixels.
    host.vertical_fov = 0.1F;
    host.ambient = glm::vec3(0);
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1000);
    host.size = {17, 17};
    host.sun_direction = glm::normalize(glm::vec3(-0.03F, -0.03F, 1));
    host.view_depth = [](int x, int y) { return x >= 12 && y >= 12 ? sky : 20.0F; };
    const auto shafts = [&](Resolution resolution) {
        Settings s = settings(resolution);
        s.technique = "radial_shafts";
        s.radial_shafts.samples = 64;
        return host.render(s).scattering;
    };
    const Image full = shafts(Resolution::full);
    for (const Resolution resolution : low_resolutions) {
        const Image low = shafts(resolution);
        double difference = 0, sum = 0, most = 0;
        for (int i = 0; i < 17 * 17; ++i) {
            const int x = i % 17, y = i / 17;
            if (host.view_depth(x, 16 - y) == sky) continue;
            difference += std::abs(low.at(x, y)[0] - full.at(x, y)[0]);
            sum += full.at(x, y)[0];
            most = std::max<double>(most, full.at(x, y)[0]);
        }
        EXPECT_GT(sum, 0.1 * 17 * 17 * most) << "there are shafts";
        EXPECT_LT(difference, (resolution == Resolution::half ? 0.05 : 0.1) * sum);
    }
}

TEST_F(VolumetricsResolution, TheMarchCostsAFourthOrASixteenth) {
    host.count_work = true;
    host.size = {32, 16};
    host.has_sun = true;
    const auto march = [&](Resolution resolution) {
        return host.render(settings(resolution)).work.at("volumetrics/march");
    };
    const gl::WorkCounts full = march(Resolution::full), half = march(Resolution::half),
                         quarter = march(Resolution::quarter);
    EXPECT_EQ(full[int(gl::Work::medium_samples)], 32U * 16 * 4);
    for (const gl::Work kind : {gl::Work::medium_samples, gl::Work::shadow_lookups, gl::Work::texture_fetches}) {
        EXPECT_EQ(full[int(kind)], 4 * half[int(kind)]);
        EXPECT_EQ(full[int(kind)], 16 * quarter[int(kind)]);
    }
}

TEST_F(VolumetricsResolution, AtFullResolutionThereIsNeitherPassNorTexture) {
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    host.volumetrics().prepare(inputs, settings(Resolution::full));
    (void)host.volumetrics().add_passes(passes, inputs, settings(Resolution::full));
    for (const PassList::TextureInfo& texture : passes.textures()) {
        EXPECT_THAT(texture.name, Not(HasSubstr("upsample")));
        EXPECT_THAT(texture.name, Not(HasSubstr("downsample")));
    }
    const Frame frame = host.render(settings(Resolution::full));
    EXPECT_THAT(frame.live_passes, ElementsAre("volumetrics/march"));
    for (const char* name : {"volumetrics/depth_downsample", "volumetrics/upsample"})
        EXPECT_EQ(frame.skipped.at(name), "resolution is full");
    EXPECT_THAT(host.render(settings(Resolution::half)).live_passes,
                ElementsAre("volumetrics/depth_downsample", "volumetrics/march", "volumetrics/upsample"));
    Settings other = settings(Resolution::half);
    other.technique = "analytic_fog";
    EXPECT_THAT(host.render(other).live_passes, ElementsAre("volumetrics/analytic_fog"));
}

TEST_F(VolumetricsResolution, FogOfTransparentsIsThatOfFullResolution) {
    host.vertical_fov = 1;
    host.lights = {point_light({0, 1, -4}, 100)};
    host.view_depth = [](int x, int y) { return 2.0F + static_cast<float>(x + y); };
    const auto fog = [&](const std::string& technique, Resolution resolution) {
        Settings s = settings(resolution);
        s.technique = technique;
        s.froxels.x = s.froxels.y = s.froxels.z = 8;
        s.froxels.history = 0;
        PassList passes;
        Inputs inputs = host.inputs(passes);
        inputs.transparents = {{glm::vec3(-1000), glm::vec3(1000)}};
        host.volumetrics().prepare(inputs, s);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, inputs, s);
        passes.export_texture(out.fog.radiance);
        passes.export_texture(out.fog.columns);
        passes.compile();
        TransientPool pool;
        passes.execute(pool);
        std::vector<float> pixels;
        const auto add = [&](TextureRef ref, int layer) {
            const PassList::TextureInfo info = passes.info(ref);
            const Image image = gl::read_texture(gl::TextureView(info.id, info.desc), layer);
            pixels.insert(pixels.end(), image.pixels.begin(), image.pixels.end());
        };
        add(out.fog.columns, 0);
        for (int slice = 0; slice < 8; ++slice) add(out.fog.radiance, slice);
        return pixels;
    };
    for (const char* technique : {"ray_march", "froxel"})
        EXPECT_EQ(fog(technique, Resolution::quarter), fog(technique, Resolution::full));
}

}  // namespace
}  // namespace tyndall::test
