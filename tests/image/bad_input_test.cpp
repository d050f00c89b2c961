// Every way a person can be wrong gives one clear line on stderr, the contract's exit code, and no output file.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "engine/core/image.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

struct Case {
    std::string name;
    std::vector<std::string> arguments;  ///< "{tmp}" stands for a temporary folder, "{level}" for the level
    int exit_code;
    std::vector<std::string> says;  ///< all must appear in the line
    std::vector<std::string> environment = {};
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

std::string replace(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

class BadInput : public ::testing::TestWithParam<Case> {
  protected:
    BadInput() {
        write(folder_ / "corrupt.glb", "glTF this is not");
        write(folder_ / "corrupt.json", "{\"media\": [");
        write(folder_ / "negative.json", R"({"media":[{"shape":"global","scattering":[-1,0,0]}]})");
        write(folder_ / "infinite.json", R"({"media":[{"shape":"global","scattering":[1e999,0,0]}]})");
        write(folder_ / "shape.json", R"({"media":[{"shape":"torus","scattering":[1,1,1]}]})");
        write(folder_ / "deep.json", std::string(100'000, '['));
        write(folder_ / "deep.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"extras":{"media":")" +
                                         std::string(100'000, '[') + "\"}}]}");
        write(folder_ / "preset.json", R"({"steps": 8, "no_such_setting": 1})");
        write(folder_ / "escape.gltf",
              R"({"asset":{"version":"2.0"},"buffers":[{"uri":"../secret.bin","byteLength":12}],"scenes":[{}]})");
        write(folder_ / "texture.gltf",
              R"({"asset":{"version":"2.0"},"images":[{"uri":"missing.png"}],"textures":[{"source":0}],)"
              R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"scenes":[{}]})");
        write(folder_ / "bad_texture.gltf",
              R"({"asset":{"version":"2.0"},"images":[{"uri":"bad.png"}],"textures":[{"source":0}],)"
              R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"scenes":[{}]})");
        write(folder_ / "bad.png", "this is no picture");
        write_image(folder_ / "good.png", Image({2, 2}, 3));
        std::filesystem::create_directory(folder_ / "folder.png");
        std::filesystem::create_symlink(folder_ / "none/lost.png", folder_ / "lost.png");
    }
    TemporaryFolder folder_;
};

TEST_P(BadInput, OneLineTheRightCodeAndNothingWritten) {
    const Case& c = GetParam();
    std::vector<std::string> arguments;
    for (const std::string& a : c.arguments)
        arguments.push_back(replace(replace(a, "{tmp}", folder_.path().string()), "{level}", level()));
    const CommandResult result = run_tyndall(arguments, c.environment);
    EXPECT_EQ(result.exit_code, c.exit_code) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("tyndall: ")) << result.err;
    for (const std::string& word : c.says)
        EXPECT_NE(result.err.find(word), std::string::npos) << word << "\n" << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.exr"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        EXPECT_EQ(entry.path().filename().string().find(".partial"), std::string::npos) << entry.path();
}

std::vector<std::string> reference(std::vector<std::string> more, const std::string& scene = "{level}") {
    std::vector<std::string> a{"reference", scene, "-o", "{tmp}/out.exr", "--size", "8x8"};
    a.insert(a.end(), more.begin(), more.end());
    return a;
}

std::vector<std::string> render(const std::string& scene, std::vector<std::string> more = {},
                                const std::string& out = "{tmp}/out.png") {
    std::vector<std::string> a{"render", scene, "-o", out, "--size", "32x18"};
    a.insert(a.end(), more.begin(), more.end());
    return a;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadInput,
    ::testing::Values(
        Case{"MissingScene", render("{tmp}/none.glb"), 1, {"none.glb"}},
        Case{"CorruptScene", render("{tmp}/corrupt.glb"), 1, {"corrupt.glb"}},
        Case{"InspectCorruptScene", {"inspect", "{tmp}/corrupt.glb"}, 1, {"corrupt.glb"}},
        Case{"InspectNothing", {"inspect"}, 2, {"SCENE"}},
        Case{"UriLeavesFolder", render("{tmp}/escape.gltf"), 1, {"escape.gltf", "../secret.bin"}},
        Case{"MissingTexture", render("{tmp}/texture.gltf"), 1, {"missing.png"}},
        Case{"CorruptTexture", render("{tmp}/bad_texture.gltf"), 1, {"bad.png"}},
        Case{"MissingMedia", render("{level}", {"--media", "{tmp}/none.json"}), 1, {"none.json"}},
        Case{"CorruptMedia", render("{level}", {"--media", "{tmp}/corrupt.json"}), 1, {"corrupt.json"}},
        Case{"NegativeMedium",
             render("{level}", {"--media", "{tmp}/negative.json"}),
             1,
             {"negative.json", "media[0]", "scattering"}},
        Case{"InfiniteMedium", render("{level}", {"--media", "{tmp}/infinite.json"}), 1, {"infinite.json"}},
        Case{"DeepMedia", render("{level}", {"--media", "{tmp}/deep.json"}), 1, {"deep.json", "nested deeper"}},
        Case{"DeepPreset", render("{level}", {"--preset", "{tmp}/deep.json"}), 1, {"deep.json", "nested deeper"}},
        Case{"DeepExtras", render("{tmp}/deep.gltf"), 1, {"deep.gltf", "extras.media", "nested deeper"}},
        Case{"UnknownShape", render("{level}", {"--media", "{tmp}/shape.json"}), 1, {"torus"}},
        Case{"UnknownSetting", render("{level}", {"--set", "stepz=4"}), 2, {"stepz"}},
        Case{"ValueOutOfRange", render("{level}", {"--set", "steps=0"}), 2, {"steps", "0", "1024"}},
        Case{"ValueNotANumber", render("{level}", {"--set", "steps=many"}), 2, {"steps", "many"}},
        Case{"NoEqualsSign", render("{level}", {"--set", "steps"}), 2, {"steps"}},
        Case{"UnknownTechnique", render("{level}", {"--technique", "magic"}), 2, {"magic", "ray_march"}},
        Case{"UnknownCamera", render("{level}", {"--camera", "Nowhere"}), 2, {"Nowhere", "LocalPM"}},
        Case{"UnknownPreset", render("{level}", {"--preset", "ultra"}), 2, {"ultra", "balanced"}},
        Case{"MissingPresetFile", render("{level}", {"--preset", "{tmp}/none.json"}), 1, {"none.json"}},
        Case{"PresetUnknownKey",
             render("{level}", {"--preset", "{tmp}/preset.json"}),
             1,
             {"preset.json", "no_such_setting"}},
        Case{"UnknownLayer", render("{level}", {"--layer", "smell"}), 2, {"smell"}},
        Case{"UnknownContext", render("{level}", {"--context", "vulkan"}), 2, {"vulkan"}},
        Case{"NoDisplay", render("{level}", {"--context", "glfw"}), 1, {"display"}, {"DISPLAY", "WAYLAND_DISPLAY"}},
        Case{"PlayNoDisplayGlfw",
             {"play", "{level}", "--context", "glfw"},
             1,
             {"display"},
             {"DISPLAY", "WAYLAND_DISPLAY"}},
        Case{"NoGl45", render("{level}", {"--context", "egl"}), 1, {"4.5"}, {"MESA_GL_VERSION_OVERRIDE=3.3"}},
        Case{"ZeroSize", {"render", "{level}", "-o", "{tmp}/out.png", "--size", "0x10"}, 2, {"0x10"}},
        Case{"AbsurdSize", {"render", "{level}", "-o", "{tmp}/out.png", "--size", "999999x2"}, 2, {"999999x2"}},
        Case{"UnknownExtension", render("{level}", {}, "{tmp}/out.gif"), 2, {"out.gif", ".png", ".exr"}},
        Case{"UnwritableOutput", render("{level}", {}, "{tmp}/no/such/out.png"), 1, {"no/such/out.png"}},
        Case{"OutputIsAFolder", render("{level}", {}, "{tmp}/folder.png"), 1, {"folder.png"}},
        Case{"EyeNotANumber",
             render("{level}", {"--eye", "nan,1,5", "--look", "0,0,0"}),
             2,
             {"--eye", "nan", "1000000"}},
        Case{"EyeInfinite",
             render("{level}", {"--eye", "0,inf,5", "--look", "0,0,0"}),
             2,
             {"--eye", "inf", "1000000"}},
        Case{"EyeFarOut",
             render("{level}", {"--eye", "0,1,1e20", "--look", "0,0,0"}),
             2,
             {"--eye", "1e20", "1000000"}},
        Case{"LookNotANumber", render("{level}", {"--eye", "0,1,5", "--look", "0,-nan,0"}), 2, {"--look", "nan"}},
        Case{"LookIsEye", render("{level}", {"--eye", "0,1,5", "--look", "0,1,5"}), 2, {"--look", "--eye"}},
        Case{"TimeNotANumber", render("{level}", {"--time", "nan"}), 2, {"--time", "nan", "1000000"}},
        Case{"TimeInfinite", render("{level}", {"--time", "-inf"}), 2, {"--time", "inf"}},
        Case{"FovNotANumber",
             render("{level}", {"--eye", "0,1,5", "--look", "0,0,0", "--fov", "nan"}),
             2,
             {"--fov", "170"}},
        Case{"FovWithoutEye", render("{level}", {"--fov", "40"}), 2, {"--fov", "--eye"}},
        Case{"FovOfACamera", render("{level}", {"--fov", "40", "--camera", "Sun"}), 2, {"--fov", "--eye"}},
        Case{"FrameTimeNotANumber", render("{level}", {"--frame-time", "nan"}), 2, {"--frame-time", "nan"}},
        Case{"SettingNotANumber", render("{level}", {"--set", "ambient=nan"}), 2, {"ambient", "nan"}},
        Case{"SettingInfinite", render("{level}", {"--set", "ambient=inf"}), 2, {"ambient", "inf"}},
        Case{"ReferenceEyeNotANumber", reference({"--eye", "nan,1,5", "--look", "0,0,0"}), 2, {"--eye", "nan"}},
        Case{"ReferenceToleranceNotANumber", reference({"--tolerance", "nan"}), 2, {"--tolerance", "nan"}},
        Case{"FlythroughRateNotANumber",
             {"flythrough", "{level}", "--out", "{tmp}/fly", "--frames-per-second", "nan"},
             2,
             {"--frames-per-second", "nan"}},
        Case{"FlythroughDurationNotANumber",
             {"flythrough", "{level}", "--out", "{tmp}/fly", "--duration", "nan"},
             2,
             {"--duration", "nan"}},
        Case{"FixedStepNotANumber", {"play", "{level}", "--fixed-step", "nan"}, 2, {"--fixed-step", "nan"}},
        Case{"ScaleTooSmall", {"play", "{level}", "--scale", "0.09"}, 2, {"--scale", "0.09", "0.1 to 1"}},
        Case{"ScaleTooLarge", {"play", "{level}", "--scale", "1.5"}, 2, {"--scale", "1.5"}},
        Case{"ScaleNotANumber", {"play", "{level}", "--scale", "nan"}, 2, {"--scale", "nan"}},
        Case{"UnwritableStats", render("{level}", {"--stats", "{tmp}/no/stats.json"}), 1, {"no/stats.json"}},
        Case{"StatsAreAFolder", render("{level}", {"--stats", "{tmp}/folder.png"}), 1, {"folder.png"}},
        Case{"StatsAreTheOutput", render("{level}", {"--stats", "{tmp}/./out.png"}), 2, {"--stats", "--output"}},
        Case{"StatsAreTheScene",
             render("{tmp}/flat_camera.gltf", {"--stats", "{tmp}/flat_camera.gltf"}),
             2,
             {"--stats", "SCENE"}},
        Case{"OutputLinkToNowhere", render("{level}", {}, "{tmp}/lost.png"), 1, {"lost.png"}},
        Case{"PlayScreenshotExtension",
             {"play", "{level}", "--screenshot", "{tmp}/out.gif", "--context", "egl"},
             2,
             {"--screenshot", "out.gif"}},
        Case{"PlayScreenshotIsTheStats",
             {"play", "{level}", "--screenshot", "{tmp}/out.png", "--stats", "{tmp}/out.png", "--context", "egl"},
             2,
             {"--stats", "--screenshot"}},
        Case{"PlayStatsWithoutADisplay",
             {"play", "{level}", "--stats", "{tmp}/stats.json"},
             1,
             {"display", "--stats"},
             {"DISPLAY", "WAYLAND_DISPLAY"}},
        Case{"CompareHeatmapIsTheThreshold",
             {"compare", "{tmp}/good.png", "{tmp}/good.png", "--heatmap", "{tmp}/out.png", "--threshold",
              "{tmp}/out.png"},
             2,
             {"--threshold", "--heatmap"}},
        Case{"CompareHeatmapIsAnInput",
             {"compare", "{tmp}/good.png", "{tmp}/good.png", "--heatmap", "{tmp}/good.png"},
             2,
             {"--heatmap"}},
        Case{"CompareUnwritableHeatmap",
             {"compare", "{tmp}/good.png", "{tmp}/good.png", "--heatmap", "{tmp}/no/out.png"},
             1,
             {"no/out.png"}},
        Case{"EyeWithoutLook", render("{level}", {"--eye", "0,0,0"}), 2, {"--look"}},
        Case{"CompareMissing", {"compare", "{tmp}/a.png", "{tmp}/b.png"}, 1, {"a.png"}},
        Case{"CompareUnknownMetric", {"compare", "a.png", "b.png", "--metric", "beauty"}, 2, {"beauty", "rmse"}},
        Case{
            "FlythroughWithoutPath", {"flythrough", "{tmp}/escape.gltf", "--out", "{tmp}/fly"}, 1, {"escape.gltf"}},
        Case{"NoCommand", {}, 2, {}}, Case{"UnknownCommand", {"dance"}, 2, {"dance"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace tyndall::test
