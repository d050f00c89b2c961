#include <gmock/gmock.h>

#include "engine/core/files.h"
#include "engine/core/image.h"
#include "support/command.h"
#include "tests/unit/support/gltf_builder.h"

namespace tyndall::test {
namespace {

/// A triangle that two animations take towards the camera at 1 and 2 m/s, in 4 s.
std::string sliding_triangle() {
    GltfBuilder b;
    b.triangle();
    const int times = b.accessor<float>({0, 4}, GltfBuilder::f32, "SCALAR");
    for (const auto& [name, end] : {std::pair("fast", 8.0f), std::pair("slow", 4.0f)}) {
        const int places = b.accessor<float>({0, 0, 0, 0, 0, end}, GltfBuilder::f32, "VEC3");
        b.append("animations",
                 {{"name", name},
                  {"samplers", {{{"input", times}, {"output", places}}}},
                  {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    }
    return b.text();
}

class AnimationOptions : public testing::Test {
  protected:
    AnimationOptions() { write_text(folder_ / "scene.gltf", sliding_triangle()); }

    /// Of the triangle from a camera at z = 20, m.
    [[nodiscard]] float depth(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"render",  folder_ / "scene.gltf",
                                           "-o",      folder_ / "depth.exr",
                                           "--size",  "9x9",
                                           "--eye",   "0.3,0.3,20",
                                           "--look",  "0.3,0.3,0",
                                           "--layer", "depth",
                                           "--fov",   "5"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const CommandResult result = run_tyndall(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_image(folder_ / "depth.exr").at(4, 4)[0];
    }
    TemporaryFolder folder_;
};

TEST_F(AnimationOptions, FramesPlayFromZeroOrUpToTheTime) {
    const std::vector<std::string> slow{"--animation", "slow"};
    const auto with = [&](std::vector<std::string> options) {
        options.insert(options.end(), slow.begin(), slow.end());
        return depth(options);
    };
    EXPECT_NEAR(with({}), 20, 1e-3);
    EXPECT_NEAR(with({"--time", "3"}), 17, 1e-3);
    EXPECT_NEAR(with({"--frames", "3", "--frame-time", "0.5"}), 19, 1e-3);  // at 0, 0.5, 1
    EXPECT_NEAR(with({"--frames", "3", "--frame-time", "0.5", "--time", "3"}), 17, 1e-3);
}

TEST_F(AnimationOptions, OneIsChosenByName) {
    EXPECT_NEAR(depth({"--time", "1", "--animation", "fast"}), 18, 1e-3);
    EXPECT_NEAR(depth({"--time", "1"}), 19, 1e-3);  // the later one wins
    const CommandResult none =
        run_tyndall({"render", folder_ / "scene.gltf", "-o", folder_ / "none.exr", "--animation", "x"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, testing::AllOf(testing::HasSubstr("animation x: not in"),
                                         testing::HasSubstr("which has fast, slow")));
    const CommandResult both = run_tyndall({"inspect", folder_ / "scene.gltf"});
    EXPECT_THAT(both.out, testing::HasSubstr("  animations \"fast\" and \"slow\" move the same node"));
}

}  // namespace
}  // namespace tyndall::test
