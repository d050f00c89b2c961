// Where pixels sample, as shaders find it: every kind of noise in space, every way in time, and what it costs.

#include "modules/volumetrics/src/reconstruction/noise.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/scene/data_root.h"
#include "modules/volumetrics/src/media/media.h"
#include "shaders/shared/bindings.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using volumetrics::Noise;
using volumetrics::NoiseSource;
using volumetrics::NoiseTime;

constexpr int side = 128;
constexpr std::array kinds{Noise::bayer, Noise::white, Noise::white_tile, Noise::ign,
                           Noise::blue,  Noise::stbn,  Noise::fast};
constexpr std::array textures{Noise::blue, Noise::stbn, Noise::fast};
const ProgramDesc probe{
    .name = "noise test", .stages = {{GL_COMPUTE_SHADER, "shaders/noise_test.comp"}}, .axes = {}, .valid = {}};

int stratum(float offset, int strata) {
    return static_cast<int>(offset * static_cast<float>(strata));
}

class VolumetricsNoise : public GlTest {
  protected:
    VolumetricsNoise() : shaders(folder.roots()) {
        write_text(folder.path() / "shaders/noise_test.comp", R"(
#include "shaders/volumetrics/reconstruction/noise_offset.glsl"
layout(local_size_x = 16, local_size_y = 16) in;
layout(std430, binding = 0) writeonly buffer Results { float results[]; };
void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    results[pixel.x + gl_NumWorkGroups.x * gl_WorkGroupSize.x * pixel.y] = noise_offset(pixel);
}
)");
    }
    /// Offsets of 128 x 128 pixels in one frame.
    std::vector<float> offsets(const Settings& settings, std::uint32_t frame) {
        Inputs inputs;
        inputs.frame_index = frame;
        inputs.size = {side, side};
        inputs.global = {{.sigma_s = glm::vec3(1)}};
        const volumetrics::FrameMedia media = volumetrics::gather_media(inputs, settings);
        uniforms.assign(std::span<const shared::VolumetricsData>(&media.data, 1), "uniforms");
        uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
        source.prepare(settings, shaders.roots());
        source.bind();
        results.bind(GL_SHADER_STORAGE_BUFFER, 0);
        shaders.get(probe).use();
        glDispatchCompute(side / 16, side / 16, 1);
        std::vector<float> values(side * side);
        results.read(0, results.size(), values.data());
        return values;
    }
    static Settings with(Noise noise, NoiseTime time = NoiseTime::fixed) {
        Settings settings;
        settings.technique = "ray_march";
        settings.noise.kind = noise;
        settings.noise.time = time;
        return settings;
    }
    ShaderFolder folder;
    ShaderLibrary shaders;
    NoiseSource source;
    gl::Buffer uniforms, results{sizeof(float) * side * side, "results"};
};

TEST_F(VolumetricsNoise, NoneIsTheMiddleInEveryFrame) {
    for (const NoiseTime time : {NoiseTime::fixed, NoiseTime::own, NoiseTime::golden_ratio, NoiseTime::r2})
        for (const float offset : offsets(with(Noise::none, time), 3)) ASSERT_EQ(offset, 0.5F);
}

TEST_F(VolumetricsNoise, EachTileHoldsEachStratumOnce) {
    for (const Noise noise : {Noise::bayer, Noise::white_tile})
        for (const int size : {2, 4, 8, 16}) {
            Settings settings = with(noise);
            settings.noise.size = size;
            const std::vector<float> all = offsets(settings, 5);
            std::vector<std::set<float>> tiles((side / size) * (side / size));
            for (int i = 0; i < side * side; ++i)
                tiles[i % side / size + side / size * (i / side / size)].insert(all[i]);
            for (const std::set<float>& tile : tiles) {
                ASSERT_EQ(tile.size(), std::size_t(size * size));
                int rank = 0;
                for (const float offset : tile)
                    ASSERT_FLOAT_EQ(offset, (static_cast<float>(rank++) + 0.5F) / static_cast<float>(size * size));
            }
        }
}

// White noise and IGN, too, but those only on average: standard deviation of a count of 1024 is 31.
TEST_F(VolumetricsNoise, OffsetsAreUniformAndOpen) {
    for (const Noise noise : kinds)
        for (const NoiseTime time : {NoiseTime::fixed, NoiseTime::own, NoiseTime::golden_ratio, NoiseTime::r2}) {
            std::array<int, 16> counts{};
            for (const float offset : offsets(with(noise, time), 12345)) {
                ASSERT_GT(offset, 0) << int(noise) << int(time);
                ASSERT_LT(offset, 1) << int(noise) << int(time);
                ++counts[stratum(offset, 16)];
            }
            for (const int count : counts) EXPECT_NEAR(count, 1024, 5 * 31) << int(noise) << int(time);
        }
}

TEST_F(VolumetricsNoise, TexturesAreReadByteByByteAndSliceBySlice) {
    for (const Noise noise : textures)
        for (const std::uint32_t frame : {0U, 7U, 31U, 32U * 1000003U + 5U}) {
            const Settings settings = with(noise, NoiseTime::own);
            const std::vector<std::uint8_t> bytes =
                read_bytes(data_root() / "assets/noise" / volumetrics::noise_texture_name(settings));
            const std::vector<float> all = offsets(settings, frame);
            const std::size_t slice = std::size_t(side) * side * (frame % 32);
            std::array<int, 256> counts{};
            for (std::size_t i = 0; i < all.size(); ++i) {
                ASSERT_NEAR(all[i], (bytes[slice + i] + 0.5) / 256, 1e-6) << int(noise) << ' ' << frame;
                ++counts[stratum(all[i], 256)];
            }
            for (const int count : counts) EXPECT_EQ(count, 64);
        }
}

TEST_F(VolumetricsNoise, EveryTextureIsThereAndAnother) {
    std::set<std::vector<float>> different;
    for (int space = 0; space < 5; ++space)
        for (int time = 0; time < 2; ++time) {
            Settings settings = with(Noise::fast);
            settings.noise.fast_space = static_cast<volumetrics::SpatialKernel>(space);
            settings.noise.fast_time = static_cast<volumetrics::TemporalKernel>(time);
            different.insert(offsets(settings, 0));
        }
    different.insert(offsets(with(Noise::blue), 0));
    different.insert(offsets(with(Noise::stbn), 0));
    EXPECT_EQ(different.size(), 12U);
}

TEST_F(VolumetricsNoise, FixedStaysAndTheOthersChange) {
    for (const Noise noise : kinds) {
        const std::vector<float> first = offsets(with(noise), 0);
        EXPECT_EQ(offsets(with(noise), 17), first) << int(noise);
        for (const NoiseTime time : {NoiseTime::own, NoiseTime::golden_ratio, NoiseTime::r2}) {
            const std::vector<float> begin = offsets(with(noise, time), 0), later = offsets(with(noise, time), 17);
            int same = 0;
            for (std::size_t i = 0; i < first.size(); ++i) {
                EXPECT_NEAR(begin[i], first[i], 1e-6);
                same += std::abs(later[i] - first[i]) < 1e-6 ? 1 : 0;
            }
            EXPECT_LT(same, side * side / 100) << int(noise) << int(time);
        }
    }
}

TEST_F(VolumetricsNoise, IgnShiftsByJimenezOffset) {
    const auto fract = [](double x) { return x - std::floor(x); };
    for (const std::uint32_t frame : {0U, 1U, 63U, 64U}) {
        const std::vector<float> all = offsets(with(Noise::ign, NoiseTime::own), frame);
        for (int i = 0; i < side * side; ++i) {
            const double x = i % side + 5.588238 * (frame % 64), y = i / side + 5.588238 * (frame % 64);
            const double d = fract(all[i] - 52.9829189 * fract(0.06711056 * x + 0.00583715 * y));
            ASSERT_LT(std::min(d, 1 - d), 1e-4) << frame << ' ' << i;
        }
    }
}

// Gaps of F_n points of the golden ratio's sequence: at most 1.1708 / F_n (theorem of three distances).
TEST_F(VolumetricsNoise, GoldenRatioSpreadsTheFramesOfEachPixel) {
    constexpr int frames = 13;
    for (const NoiseTime time : {NoiseTime::golden_ratio, NoiseTime::own})
        for (const Noise noise : kinds) {
            const bool tile = noise == Noise::bayer || noise == Noise::white_tile;
            if (time == NoiseTime::own && !tile) continue;
            std::vector<std::vector<float>> pixels(side * side);
            for (std::uint32_t frame = 0; frame < frames; ++frame) {
                const std::vector<float> all = offsets(with(noise, time), 3000000000U + frame);
                for (std::size_t i = 0; i < all.size(); ++i) pixels[i].push_back(all[i]);
            }
            for (std::vector<float>& pixel : pixels) {
                std::ranges::sort(pixel);
                float gap = pixel.front() + 1 - pixel.back();
                for (int i = 1; i < frames; ++i) gap = std::max(gap, pixel[i] - pixel[i - 1]);
                ASSERT_LT(gap * frames, 1.18) << int(noise);
            }
        }
}

TEST_F(VolumetricsNoise, R2MovesThePatternOfEachPeriodAsAWhole) {
    for (const Noise noise : {Noise::bayer, Noise::white_tile, Noise::blue, Noise::stbn, Noise::fast}) {
        const std::vector<float> first = offsets(with(noise), 0), moved = offsets(with(noise, NoiseTime::r2), 5);
        const int period = noise == Noise::bayer || noise == Noise::white_tile ? 8 : side;
        const double p = 1.32471795724474602596;
        const int dx = static_cast<int>(std::fmod(5 / p, 1) * period),
                  dy = static_cast<int>(std::fmod(5 / p / p, 1) * period);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                ASSERT_EQ(moved[x + side * y], first[(x + dx) % side + side * ((y + dy) % side)]) << int(noise);
    }
}

TEST_F(VolumetricsNoise, OnlyTheTextureThatIsChosenIsHeld) {
    constexpr std::size_t texture = 128 * 128 * 32, tile = 16 * 16 * 4;
    for (const Noise noise : kinds) {
        source.prepare(with(noise), shaders.roots());
        EXPECT_EQ(source.bytes(), tile + (std::ranges::count(textures, noise) > 0 ? texture : 0));
    }
    Settings settings = with(Noise::stbn);
    settings.technique = "froxel";  // samples no noise
    source.prepare(settings, shaders.roots());
    EXPECT_EQ(source.bytes(), 0U);
}

TEST_F(VolumetricsNoise, AMissingOrShortFileIsOneClearErrorAndChangesNothing) {
    source.prepare(with(Noise::blue), shaders.roots());
    const Roots own(folder.path());
    const std::string name = "assets/noise/stbn_128x128x32_r8.raw";
    const std::filesystem::path path = folder.path() / name;
    EXPECT_THAT([&] { source.prepare(with(Noise::stbn), own); },
                ThrowsMessage<Error>(name + ": no such file in " + folder.path().string()));
    std::filesystem::create_directories(path.parent_path());
    write_text(path, "short");
    EXPECT_THAT([&] { source.prepare(with(Noise::stbn), own); },
                ThrowsMessage<Error>(path.string() + ": 5 bytes, 524288 of noise expected"));
    EXPECT_EQ(source.bytes(), std::size_t(128 * 128 * 32 + 16 * 16 * 4));
    EXPECT_EQ(offsets(with(Noise::blue), 0).size(), std::size_t(side * side));
}

TEST_F(VolumetricsNoise, MarchSamplesWhereTheNoiseSaysAndPaysForTexturesAlone) {
    StubHost host;
    host.size = {16, 16};
    host.global = {{.sigma_s = glm::vec3(0.05F)}};
    host.has_sun = true;
    host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.2F));
    host.shadows = 1;
    host.count_work = true;
    const auto draw = [&](Noise noise, NoiseTime time, std::uint32_t frame) {
        Settings settings = plain_settings(4);
        settings.noise.kind = noise;
        settings.noise.time = time;
        host.frame_index = frame;
        return host.render(settings);
    };
    std::set<std::vector<float>> pictures{draw(Noise::none, NoiseTime::own, 3).scattering.pixels};
    for (const Noise noise : kinds) {
        const Frame first = draw(noise, NoiseTime::fixed, 1);
        EXPECT_EQ(draw(noise, NoiseTime::fixed, 2).scattering.pixels, first.scattering.pixels) << int(noise);
        EXPECT_NE(draw(noise, NoiseTime::own, 2).scattering.pixels, first.scattering.pixels) << int(noise);
        pictures.insert(first.scattering.pixels);
        const bool texture = std::ranges::count(textures, noise) > 0;
        EXPECT_EQ(first.work.at("volumetrics/march")[int(gl::Work::texture_fetches)], texture ? 512U : 256U);
    }
    EXPECT_EQ(pictures.size(), 1 + kinds.size());
}

}  // namespace
}  // namespace tyndall::test
