// `tyndall reference`: what it writes, what it refuses, and its agreement with pictures that others computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "engine/core/image.h"
#include "engine/scene/data_root.h"
#include "support/command.h"
#include "support/scenes.h"

namespace tyndall::test {
namespace {

class ReferenceCommand : public ::testing::Test {
  protected:
    ReferenceCommand() {
        write_scene(folder_ / "scene.gltf",
                    {.lamps = {{{0, 2, 0}, 50, 12}},
                     .media = R"([{"shape":"global","scattering":[0.05,0.04,0.03],"anisotropy":0.3}])"});
    }
    [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] CommandResult run(const std::string& command, const std::string& out,
                                    const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{command, path("scene.gltf"), "-o", path(out), "--size", "48x27"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tyndall(arguments);
    }
    Image picture(const std::string& command, const std::vector<std::string>& more = {},
                  const std::string& extension = ".exr") const {
        const std::string out = command + extension;
        const CommandResult result = run(command, out, more);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_image(folder_ / out);
    }
    TemporaryFolder folder_;
};

/// Root mean square difference over mean of `b`, over the pixels whose luminance in `b` is not among the greatest
/// `left_out`.
double relative_rmse(const Image& a, const Image& b, double left_out = 0) {
    EXPECT_EQ(a.size, b.size);
    const int pixels = b.size.x * b.size.y;
    const auto value = [](const Image& image, int i) { return &image.pixels[std::size_t(i) * image.channels]; };
    const auto luminance = [&](int i) {
        const float* c = value(b, i);
        return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    };
    std::vector<float> sorted;
    for (int i = 0; i < pixels; ++i) sorted.push_back(luminance(i));
    std::ranges::sort(sorted);
    const float brightest = sorted[std::size_t((pixels - 1) * (1 - left_out))];
    double squares = 0, sum = 0, count = 0;
    for (int i = 0; i < pixels; ++i) {
        if (luminance(i) > brightest) continue;
        for (int c = 0; c < 3; ++c) {
            squares += std::pow(double(value(a, i)[c]) - value(b, i)[c], 2);
            sum += value(b, i)[c];
            ++count;
        }
    }
    return std::sqrt(squares / count) / (sum / count);
}

TEST_F(ReferenceCommand, NeedsNoGl) {
    const CommandResult result =
        run_tyndall({"reference", path("scene.gltf"), "-o", path("out.exr"), "--size", "8x4"},
                    {"DISPLAY", "WAYLAND_DISPLAY", "MESA_GL_VERSION_OVERRIDE=3.3", "EGL_PLATFORM=none"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(std::ranges::count(result.out, '\n'), 1) << result.out;
    EXPECT_NE(result.out.find("estimated error"), std::string::npos) << result.out;
    EXPECT_EQ(read_image(folder_ / "out.exr").size, glm::ivec2(8, 4));
}

TEST_F(ReferenceCommand, ThreadsDoNotShow) {
    const Image one = picture("reference", {"--threads", "1", "--samples", "2"});
    const Image three = picture("reference", {"--threads", "3", "--samples", "2"});
    EXPECT_EQ(one.pixels, three.pixels);
}

// Without a sun the sky is too dark to matter and shadows are of a lamp above an open floor: what is left are
// surfaces, one lamp in a homogeneous medium, and the engine's approximation of both.
TEST_F(ReferenceCommand, IsThePictureThatRenderDraws) {
    const std::vector<std::string> exact{"--set", "steps=256", "--set", "filter=none", "--set", "noise=none"};
    EXPECT_LT(relative_rmse(picture("render", exact), picture("reference")), 0.02);
    const auto layer = [&](const std::string& command, const std::string& name) {
        std::vector<std::string> options = command == "render" ? exact : std::vector<std::string>{};
        options.insert(options.end(), {"--layer", name});
        return picture(command, options);
    };
    EXPECT_LT(relative_rmse(layer("render", "scattering"), layer("reference", "scattering")), 0.02);
    EXPECT_LT(relative_rmse(layer("render", "transmittance"), layer("reference", "transmittance")), 2e-3);
    const Image drawn = layer("render", "depth"), traced = layer("reference", "depth");
    ASSERT_EQ(drawn.pixels.size(), traced.pixels.size());
    for (std::size_t i = 0; i < drawn.pixels.size(); ++i)
        EXPECT_NEAR(drawn.pixels[i], traced.pixels[i], 1e-3f * traced.pixels[i]) << i;
    // As a player sees it: within two steps of 8 bit (one is dither) nearly everywhere.
    const Image shown = picture("render", exact, ".png"), expected = picture("reference", {}, ".png");
    int far_off = 0;
    for (int y = 0; y < shown.size.y; ++y)
        for (int x = 0; x < shown.size.x; ++x)
            far_off += std::abs(shown.at(x, y)[1] - expected.at(x, y)[1]) > 2.5f / 255;
    EXPECT_LT(far_off, shown.size.x * shown.size.y / 100);
}

// Glass above the floor: what it leaves of the light of the floor and of the air. Neither shows the glass itself.
TEST_F(ReferenceCommand, GlassColoursLightAsItDoesInTheGroundTruth) {
    for (const bool sun : {true, false}) {
        SceneSpec spec{.media = R"([{"shape":"global","scattering":[0.05,0.05,0.05],"anisotropy":0.3}])"};
        spec.sun = sun;
        if (!sun) spec.lamps = {{{-2, 5, -1}, 50, 14}};
        const auto difference = [&](const std::string& layer, const std::string& technique) {
            const std::vector<std::string> options{"--layer",   layer,         "--set",
                                                   "ambient=0", "--technique", technique};
            std::vector<std::string> exact = options;
            exact.insert(exact.end(), {"--set", "steps=128", "--set", "filter=none", "--set", "noise=none"});
            return relative_rmse(picture("render", exact), picture("reference", options));
        };
        spec.glass = true;
        write_scene(folder_ / "scene.gltf", spec);
        for (const char* technique : {"ray_march", "epipolar"}) {
            EXPECT_LT(difference("scattering", technique), 0.02) << technique << (sun ? " sun" : " lamp");
        }
        const double tinted = difference("color", "ray_march");
        const std::vector<std::string> scattered{"--layer", "scattering", "--set", "ambient=0"};
        const Image glass = picture("reference", scattered);
        spec.glass = false;
        write_scene(folder_ / "scene.gltf", spec);
        EXPECT_GT(relative_rmse(glass, picture("reference", scattered)), 0.05) << "it does colour light";
        EXPECT_LT(tinted, difference("color", "ray_march") + 0.03) << "a texel of the map at the edge";
    }
}

// What two integrators of air and haze agree on, one on the GPU in single precision.
TEST_F(ReferenceCommand, IsTheTechniqueReferenceInAirAndHaze) {
    write_scene(folder_ / "scene.gltf", {.sun = true, .media = R"([
        {"shape":"height","scattering":[0.003,0.008,0.02],"phase":"rayleigh","base":0,"falloff":15},
        {"shape":"global","scattering":[0.004,0.004,0.004],"absorption":[0.002,0.001,0],"anisotropy":0.6}])"});
    for (const char* phase : {"cornette_shanks", "double_henyey_greenstein", "hg_draine"}) {
        const std::vector<std::string> options{"--layer",     "scattering",
                                               "--set",       "shadows=false",
                                               "--technique", "reference",
                                               "--set",       "max_distance=2000",
                                               "--set",       std::string("phase=") + phase};
        EXPECT_LT(relative_rmse(picture("render", options), picture("reference", options)), 1e-3) << phase;
    }
}

TEST_F(ReferenceCommand, SettingsThatMatter) {
    const Image all = picture("reference");
    EXPECT_LT(relative_rmse(picture("reference", {"--set", "steps=1", "--preset", "fast"}), all), 1e-9);
    EXPECT_GT(relative_rmse(picture("reference", {"--set", "light_transmittance=false"}), all), 0.01);
    EXPECT_GT(relative_rmse(picture("reference", {"--set", "phase=schlick"}), all), 1e-4);
    const Image clear = picture("reference", {"--technique", "off", "--layer", "transmittance"});
    EXPECT_TRUE(std::ranges::all_of(clear.pixels, [](float t) { return t == 1; }));
    const Image black = picture("reference", {"--black-surfaces", "--black-sky"});
    EXPECT_LT(relative_rmse(black, picture("reference", {"--layer", "scattering"})), 1e-9);
    const Image error = picture("reference", {"--layer", "error"});
    EXPECT_EQ(error.channels, 1);
    EXPECT_TRUE(std::ranges::all_of(error.pixels, [](float e) { return e >= 0 && e < 0.01f; }));
}

TEST_F(ReferenceCommand, RefusesInOneLine) {
    std::ofstream(folder_ / "corrupt.json") << "{\"media\": [";
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        std::string says;
    };
    const std::string scene = path("scene.gltf"), out = path("out.exr");
    for (const Case& c : {Case{{scene}, 2, "--output"}, Case{{scene, "-o", path("out.jpg")}, 2, "out.jpg"},
                          Case{{scene, "-o", path("no/such/out.exr")}, 1, "no/such/out.exr"},
                          Case{{path("none.glb"), "-o", out}, 1, "none.glb"},
                          Case{{scene, "-o", out, "--camera", "Nowhere"}, 2, "Nowhere"},
                          Case{{scene, "-o", out, "--eye", "0,0,0"}, 2, "--look"},
                          Case{{scene, "-o", out, "--media", path("corrupt.json")}, 1, "corrupt.json"},
                          Case{{scene, "-o", out, "--layer", "smell"}, 2, "smell"},
                          Case{{scene, "-o", out, "--samples", "0"}, 2, "--samples"},
                          Case{{scene, "-o", out, "--threads", "-1"}, 2, "--threads"},
                          Case{{scene, "-o", out, "--tolerance", "0"}, 2, "--tolerance"},
                          Case{{scene, "-o", out, "--size", "0x9"}, 2, "0x9"},
                          Case{{scene, "-o", out, "--set", "ambience=1"}, 2, "ambience"},
                          Case{{scene, "-o", out, "--context", "egl"}, 2, "--context"}}) {
        std::vector<std::string> arguments{"reference"};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, c.exit_code) << result.err;
        EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
        EXPECT_NE(result.err.find(c.says), std::string::npos) << c.says << "\n" << result.err;
        EXPECT_FALSE(std::filesystem::exists(out));
    }
}

/// A folder of data from outside the project: the environment's TYNDALL_TEST_DATA, or shared/data beside the
/// project.
std::filesystem::path test_data() {
    if (const char* named = std::getenv("TYNDALL_TEST_DATA")) return named;
    return data_root() / ".." / "shared" / "data";
}

// A room with a slatted wall under the sun: pictures of an independent integrator (single scattering by quadrature,
// exact visibility), which agree with a path tracer. They are averages of regular sub-pixels: 12 x 12 where
// surfaces are lit, and by its edges 4 x 4 where they are black. Nothing is seen of a sky.
TEST_F(ReferenceCommand, SlatsAgreeWithOutsideData) {
    const std::filesystem::path data = test_data() / "reference";
    for (const char* file : {"slats.glb", "slats.media.json", "slats_full.exr", "slats_volume.exr"})
        if (!std::filesystem::exists(data / file))
            GTEST_SKIP() << (data / file).string()
                         << " is absent: set TYNDALL_TEST_DATA to the folder of test data";
    const auto compare = [&](const std::string& expected, std::vector<std::string> more) {
        std::vector<std::string> arguments{"reference", (data / "slats.glb").string(),
                                           "--media",   (data / "slats.media.json").string(),
                                           "-o",        path("slats.exr"),
                                           "--camera",  "cam",
                                           "--size",    "320x180",
                                           "--set",     "ambient=0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const CommandResult result = run_tyndall(arguments, {}, 300);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return relative_rmse(read_image(folder_ / "slats.exr", 3), read_image(data / expected, 3), 0.02);
    };
    EXPECT_LT(compare("slats_volume.exr", {"--layer", "scattering", "--black-surfaces", "--samples", "4"}), 0.01);
    EXPECT_LT(compare("slats_full.exr", {"--black-sky", "--samples", "12", "--tolerance", "1e-3"}), 0.01);
}

}  // namespace
}  // namespace tyndall::test
