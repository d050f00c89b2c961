// The generator of noise textures, and the committed ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>

#include "engine/core/files.h"
#include "engine/scene/data_root.h"
#include "tools/noise/filters.h"
#include "tools/noise/measure.h"
#include "tools/noise/recipes.h"

namespace tyndall::noise {
namespace {

Volume read(const std::filesystem::path& path) {
    const std::string bytes = read_text(path);
    Volume volume{.side = 128, .depth = 32, .bytes = {bytes.begin(), bytes.end()}};
    EXPECT_EQ(volume.bytes.size(), volume.size()) << path;
    return volume;
}
Volume committed(const std::string& name) {
    return read(data_root() / "assets/noise" / (name + "_128x128x32_r8.raw"));
}
Volume white() {
    std::mt19937 random(1);
    Volume volume{.side = 128, .depth = 32};
    for (std::size_t i = 0; i < volume.size(); ++i)
        volume.bytes.push_back(static_cast<std::uint8_t>(random() >> 24));
    return volume;
}
/// 255 below the threshold, else 0: what noise makes of a shadow's edge.
Volume below(const Volume& volume, int threshold) {
    Volume result = volume;
    for (std::uint8_t& b : result.bytes) b = b < threshold ? 255 : 0;
    return result;
}

TEST(NoiseMeasure, WhiteNoiseIsOneEverywhere) {
    const Volume volume = white();
    for (const std::string& time : temporal_filter_names())
        EXPECT_NEAR(filtered_variance(volume, "", time), 1, 0.02) << time;
    for (const std::string& space : spatial_filter_names())
        EXPECT_NEAR(filtered_variance(volume, space, ""), 1, 0.04) << space;
    for (const double power : temporal_spectrum(volume)) EXPECT_NEAR(power, 1, 0.04);
    const std::vector<double> spectrum = spatial_spectrum(volume);
    for (std::size_t k = 4; k < spectrum.size(); ++k) EXPECT_NEAR(spectrum[k], 1, 0.2) << k;
    EXPECT_FALSE(has_uniform_slices(volume));
}

TEST(NoiseMeasure, AWaveHasOneFrequencyAndTheFiltersResponse) {
    Volume volume{.side = 128, .depth = 32};
    for (int z = 0; z < 32; ++z)
        for (int i = 0; i < 128 * 128; ++i)
            volume.bytes.push_back(static_cast<std::uint8_t>(
                std::lround(127.5 + 127 * std::cos(2 * M_PI * (16.0 * (i % 128) / 128 + 8.0 * z / 32)))));
    // box3 leaves (1 + 2 cos w)/3 of a wave along x, which is all of it along y; white noise: 1/3 along each.
    const double response = (1 + 2 * std::cos(2 * M_PI * 16 / 128)) / 3;
    EXPECT_NEAR(filtered_variance(volume, "box3", ""), response * response * 9, 0.01);
    const std::vector<double> space = spatial_spectrum(volume), time = temporal_spectrum(volume);
    EXPECT_EQ(std::ranges::max_element(space) - space.begin(), 16);
    EXPECT_EQ(std::ranges::max_element(time) - time.begin(), 8 - 1);
    EXPECT_LT(space[15] + space[17], 1e-3 * space[16]);
}

TEST(NoiseGenerate, TheSameSeedGivesTheSameBytesAndSwapsKeepHistograms) {
    const std::vector<Energy> energies{{{1, 0.5}, {}}};
    const Volume volume = generate(energies, 7, 1);
    EXPECT_EQ(volume.bytes, generate(energies, 7, 1).bytes);
    EXPECT_NE(volume.bytes, generate(energies, 8, 1).bytes);
    EXPECT_TRUE(has_uniform_slices(volume));
}

TEST(NoiseGenerate, EnergiesThatDoNotFitAreErrors) {
    EXPECT_THROW((void)generate({{{}, {}}}, 1, 1), std::invalid_argument);
    EXPECT_THROW((void)generate({{std::vector<double>(10, 1.0), {}}}, 1, 1), std::invalid_argument);
    EXPECT_THROW((void)generate({{{1}, {1, 0.5}}}, 1, 1), std::invalid_argument);
    EXPECT_THROW((void)spatial_taps("box4"), std::invalid_argument);
    EXPECT_THROW((void)temporal_taps("box4", 32), std::invalid_argument);
}

TEST(NoiseTextures, EachIsUniformAndBestForItsOwnFilters) {
    for (const Recipe& recipe : recipes()) EXPECT_TRUE(has_uniform_slices(committed(recipe.name))) << recipe.name;
    const auto left = [](const char* made_for, const char* filter) {
        return filtered_variance(committed(std::string("fast_ema_") + made_for), filter, "");
    };
    EXPECT_LT(left("box3", "box3"), left("binomial5", "box3"));
    EXPECT_LT(left("binomial5", "binomial5"), left("box3", "binomial5"));
    EXPECT_LT(left("box5", "box5"), left("gaussian1", "box5"));
    EXPECT_LT(left("gaussian1", "gaussian1"), left("box5", "gaussian1"));
}

TEST(NoiseTextures, SpectraAreBlueInSpaceAndWhereMeantInTime) {
    for (const char* name : {"blue", "stbn", "fast_ema_gaussian1"}) {
        const std::vector<double> space = spatial_spectrum(committed(name));
        for (int k = 2; k < 16; ++k) EXPECT_LT(space[k], 0.1) << name << k;
        EXPECT_GT(*std::max_element(space.begin() + 32, space.end()), 1) << name;
    }
    const std::vector<double> independent = temporal_spectrum(committed("blue"));
    EXPECT_NEAR(independent.front(), 1, 0.1);
    for (const char* name : {"stbn", "fast_ema_gaussian1"}) {
        const std::vector<double> time = temporal_spectrum(committed(name));
        EXPECT_LT(time.front(), 0.15) << name;
        EXPECT_GT(time.back(), 1) << name;
    }
}

/// The folder of textures that others publish.
std::filesystem::path published_folder() {
    const char* data = std::getenv("TYNDALL_TEST_DATA");
    return (data != nullptr ? std::filesystem::path(data) : data_root().parent_path() / "shared/data") / "noise";
}

/// At most 5% more variance, of the values behind the filters of which `spatial` is one, and of what a shadow's
/// edge makes of the values.
TEST(NoiseTextures, AreAsGoodAsThePublishedOnes) {
    struct Pair {
        const char *name, *published, *spatial;
        bool alone = true;  ///< also behind either filter without the other
    };
    const Pair pairs[] = {
        {"fast_ema_gaussian1", "packed_real_uniform_gauss1_0_exp0101_separate05_128x128x32_r8.raw", "gaussian1"},
        {"fast_ema_binomial3", "packed_real_uniform_binomial3x3_exp0101_separate05_128x128x32_r8.raw", "binomial3",
         false},
        {"stbn", "packed_stbn_sigma1_9_128x128x32_r8.raw", "gaussian1"},
        {"stbn", "packed_stbn_sigma1_0_128x128x32_r8.raw", "gaussian1", false}};
    for (const auto& [name, published, spatial, alone] : pairs) {
        const std::filesystem::path path = published_folder() / published;
        if (!std::filesystem::exists(path))
            GTEST_SKIP() << "no " << path << "; TYNDALL_TEST_DATA names the folder above noise/";
        const Volume ours = committed(name), theirs = read(path);
        std::vector<std::pair<std::string, std::string>> filters{{spatial, "ema"}};
        if (alone) filters.insert(filters.end(), {{"", "ema"}, {spatial, ""}});
        for (const auto& [space, time] : filters) {
            EXPECT_LT(filtered_variance(ours, space, time), 1.05 * filtered_variance(theirs, space, time))
                << name << ' ' << published << ' ' << space << ' ' << time;
            if (!alone) continue;
            EXPECT_LT(filtered_variance(below(ours, 128), space, time),
                      1.2 * filtered_variance(below(theirs, 128), space, time))
                << name << ' ' << space << ' ' << time << ", half a shadow";
        }
    }
}

}  // namespace
}  // namespace tyndall::noise
