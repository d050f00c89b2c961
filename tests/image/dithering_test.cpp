// The thesis' claim on the level's places: eight Bayer-dithered samples with a bilateral blur beat 32 undithered
// ones and white noise, measured against what the march tends to: the error of sampling alone.
#include <gtest/gtest.h>

#include "engine/core/image.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

class Dithering : public ::testing::TestWithParam<const char*> {
  protected:
    double rmse(const std::vector<std::string>& settings) {
        return compare_images(draw(settings), reference_).rmse;
    }

    /// The scattering layer: linear radiance, so that surfaces do not hide the difference.
    Image draw(const std::vector<std::string>& settings) {
        const std::filesystem::path out = folder_ / "out.exr";
        std::vector<std::string> arguments{"render", level(), "-o",      out.string(), "--camera",    GetParam(),
                                           "--size", "96x54", "--layer", "scattering", "--technique", "ray_march"};
        for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_image(out, 3);
    }
    void SetUp() override { reference_ = draw({"steps=128", "noise=none", "filter=none"}); }
    TemporaryFolder folder_;
    Image reference_;
};

TEST_P(Dithering, EightBayerSamplesWithBlurBeatTheAlternatives) {
    const double bayer = rmse({"steps=8", "noise=bayer", "noise_size=8", "filter=gaussian15"});
    const double white = rmse({"steps=8", "noise=white_tile", "noise_size=8", "filter=gaussian15"});
    EXPECT_LT(bayer, white);
    const double undithered = rmse({"steps=32", "noise=none", "filter=none"});
    EXPECT_LT(bayer, undithered);
}

INSTANTIATE_TEST_SUITE_P(Places, Dithering, ::testing::Values("Sun", "Balance"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tyndall::test
