// A technique that the module does not know, registered by its host: its file is this one and a shader.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/scene/data_root.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "volumetrics/frame.h"
#include "volumetrics/technique.h"

namespace tyndall::test {
namespace {

using namespace volumetrics;
using ::testing::ElementsAre;

Estimate add_one_sample(volumetrics::Frame& frame) {
    static const ProgramDesc program{
        .name = "host/one_sample",
        .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                   {GL_FRAGMENT_SHADER, (data_root() / "tests/gpu/volumetrics/host_technique.frag").string()}},
        .axes = {{"HEIGHT_MEDIA", {0, 1, 4}}, {"HAS_SUN", {1}}, {"CHROMATIC", {0}}},
        .valid = {}};
    Estimate estimate = frame.create_estimate();
    Part sun{.light = frame.create("host/sun"), .share = frame.create("host/sun_share")};
    frame.add({.name = "host/one_sample",
               .program = frame.program(program),
               .sources = {{frame.depth}},
               .targets = {&estimate.scattering, &sun.light, &sun.share},
               .lit = true});
    estimate.parts.push_back(sun);
    return estimate;
}

class HostTechnique : public GlTest {
  protected:
    static void SetUpTestSuite() {
        register_technique({.name = "one_sample",
                            .help = "One visibility of the sun a ray.",
                            .settings = "",
                            .passes = {"host/one_sample"},
                            .traits = {.sampling = Sampling::per_pixel, .any_resolution = true},
                            .add = add_one_sample});
    }
    HostTechnique() {
        host.global = {{.sigma_s = glm::vec3(0.1F)}};
        host.has_sun = true;
        host.sun_illuminance = glm::vec3(8);
        host.shadows = 3;  // x < 0
        host.size = {16, 8};
        host.vertical_fov = 0.2F;  // all of it below y = 4
        SettingsSet set;
        set.add(settings_table(), &settings);
        set.set("technique=one_sample");
    }
    StubHost host;
    Settings settings;
};

TEST_F(HostTechnique, IsReconstructedAsAllOthersAreAndTellsLitFromDark) {
    settings.resolution.size = Resolution::half;
    for (const float x : {1000.0F, -1000.0F}) {
        host.eye = {x, 0, 0};
        const Frame frame = host.render(settings);
        EXPECT_THAT(frame.live_passes,
                    ElementsAre("volumetrics/depth_downsample", "host/one_sample", "volumetrics/temporal",
                                "volumetrics/filter_horizontal", "volumetrics/filter_vertical",
                                "volumetrics/upsample", "volumetrics/relight"));
        EXPECT_EQ(frame.skipped.at("volumetrics/march"), "technique is one_sample");
        for (int pixel = 0; pixel < 16; ++pixel) {
            const double length = 10 / -static_cast<double>(host.ray(pixel, 4).z), t = std::exp(-0.1 * length);
            const double lit = x > 0 ? 8 * (1 - t) / (4 * std::numbers::pi) : 0;
            EXPECT_NEAR(frame.scattering.at(pixel, 3)[3], t, 0.01);
            EXPECT_NEAR(frame.scattering.at(pixel, 3)[0], lit, 0.02 * lit);
        }
    }
}

TEST_F(HostTechnique, ANameIsTakenOnce) {
    EXPECT_THROW(register_technique({.name = "one_sample", .help = "", .settings = "", .passes = {}, .add = {}}),
                 Error);
    EXPECT_THROW(register_technique({.name = "froxel", .help = "", .settings = "", .passes = {}, .add = {}}),
                 Error);
    settings.technique = "two_samples";
    EXPECT_THROW((void)host.render(settings), UsageError);
}

}  // namespace
}  // namespace tyndall::test
