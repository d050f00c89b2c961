// The thesis' claim on the level's places: eight Bayer-dithered samples with a bilateral blur beat many undithered
// ones and white noise, measured against 512 undithered steps (128 in LocalLights).
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
        std::vector<std::string> arguments{"render",   level(),  "-o",      out.string(), "--camera",
                                           GetParam(), "--size", "240x135", "--layer",    "scattering"};
        for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_image(out, 3);
    }
    // Among the many lamps of LocalLights fewer: llvmpipe ends the loops of a shader after 65,535 iterations in
    // all.
    void SetUp() override {
        const bool lamps = std::string(GetParam()) == "LocalLights";
        reference_ = draw({lamps ? "steps=128" : "steps=512", "noise=none", "filter=none"});
    }
    TemporaryFolder folder_;
    Image reference_;
};

TEST_P(Dithering, EightBayerSamplesWithBlurBeatTheAlternatives) {
    const double bayer = rmse({"steps=8", "noise=bayer", "noise_size=8", "filter=gaussian15"});
    const double white = rmse({"steps=8", "noise=white_tile", "noise_size=8", "filter=gaussian15"});
    EXPECT_LT(bayer, white);
    if (std::string(GetParam()) != "LocalLights") {
        const double undithered = rmse({"steps=32", "noise=none", "filter=none"});
        EXPECT_LT(bayer, undithered);
    }
}

INSTANTIATE_TEST_SUITE_P(Places, Dithering, ::testing::Values("Sun", "Balance", "LocalLights"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tyndall::test
