// Which passes a frame has, what they cost, and that the permutations of every program build.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <cstdio>
#include <map>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/gl/program_limits.h"
#include "engine/gl/readback.h"
#include "engine/scene/data_root.h"
#include "tests/gpu/support/covering_permutations.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/program_bindings.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::UnorderedElementsAre;

class VolumetricsPasses : public GlTest {
  protected:
    StubHost host;
    const GlobalMedium fog{.sigma_s = glm::vec3(0.1F)};
    const LocalMedium ball{.center = {0, 0, -5}, .sigma_s = glm::vec3(0.1F)};
};

TEST_F(VolumetricsPasses, WithoutMediumNothingIsAddedOrHeld) {
    Settings settings;
    settings.technique = "ray_march";
    for (int i = 0; i < 2; ++i) {
        host.global = {fog};
        EXPECT_GT(host.render(settings).persistent_bytes, 0U);
        host.global = i == 0 ? std::vector<GlobalMedium>{} : std::vector<GlobalMedium>{GlobalMedium{}};
        const Frame frame = host.render(settings);
        EXPECT_THAT(frame.live_passes, IsEmpty());
        EXPECT_THAT(frame.skipped,
                    UnorderedElementsAre(Key("volumetrics/noise_volume"), Key("volumetrics/depth_downsample"),
                                         Key("volumetrics/march"), Key("volumetrics/filter_horizontal"),
                                         Key("volumetrics/filter_vertical"), Key("volumetrics/relight"),
                                         Key("volumetrics/upsample"), Key("volumetrics/temporal"),
                                         Key("volumetrics/refine_mask"), Key("volumetrics/refine"),
                                         Key("volumetrics/sky_light"), Key("volumetrics/sky_light_again"),
                                         Key("volumetrics/froxel_sky"), Key("volumetrics/composite")));
        EXPECT_EQ(frame.persistent_bytes, 0U);
    }
}

TEST_F(VolumetricsPasses, TechniqueOffIsAsIfThereWereNoMedium) {
    host.global = {fog};
    Settings settings;
    settings.technique = "off";
    const Frame frame = host.render(settings);
    EXPECT_THAT(frame.live_passes, IsEmpty());
    EXPECT_EQ(frame.skipped.at("volumetrics/march"), "technique is off");
    EXPECT_EQ(frame.persistent_bytes, 0U);
}

TEST_F(VolumetricsPasses, EachPassIsThereWhenItIsNeeded) {
    host.global = {fog};
    Settings settings;
    settings.technique = "ray_march";
    settings.filter.kernel = volumetrics::Filter::none;
    settings.temporal.mode = volumetrics::Temporal::off;
    EXPECT_THAT(host.render(settings).live_passes, ElementsAre("volumetrics/march"));
    settings.temporal.mode = volumetrics::Temporal::accumulate;
    EXPECT_THAT(host.render(settings).live_passes, ElementsAre("volumetrics/march", "volumetrics/temporal"));
    settings.temporal.mode = volumetrics::Temporal::off;
    settings.filter.kernel = volumetrics::Filter::gaussian15;
    EXPECT_THAT(host.render(settings).live_passes,
                ElementsAre("volumetrics/march", "volumetrics/filter_horizontal", "volumetrics/filter_vertical"));
    host.global.clear();
    host.local = {ball};
    EXPECT_THAT(host.render(settings).live_passes,
                ElementsAre("volumetrics/march", "volumetrics/filter_horizontal", "volumetrics/filter_vertical"));
    host.local[0].noise_scale = host.local[0].noise_amount = 1;
    EXPECT_THAT(host.render(settings).live_passes,
                ElementsAre("volumetrics/froxel_columns", "volumetrics/noise_volume", "volumetrics/march",
                            "volumetrics/filter_horizontal", "volumetrics/filter_vertical"));
}

TEST_F(VolumetricsPasses, MoreHeightMediaThanTheBlockHoldsAreAnError) {
    host.global.assign(5, {.sigma_s = glm::vec3(0.1F), .height = true});
    EXPECT_THROW(host.render(Settings{}), Error);
}

/// Without what Tyndall's own shaders/interface reads, and the buffer of counted work.
std::string module_numbers(const ProgramBindings::Numbers& numbers) {
    static const std::set<std::string> others{
        "FrameBlock",       "ClusterBuffer", "ClusterLightBuffer", "light_texels",   "shadow_tile_texels",
        "sun_cascade_maps", "shadow_atlas",  "sun_static_map",     "sun_glass_maps", "lamp_glass_map",
        "ambient_cube",     "sky_volume",    "WorkBuffer"};
    std::string text;
    for (const auto& [number, names] : numbers)
        if (!std::ranges::includes(others, names)) text += (text.empty() ? "" : ", ") + std::to_string(number);
    return text;
}

/// The module's guide has a row of every program's bindings, and no other.
void expect_guide_lists(const std::map<std::string, ProgramBindings>& bindings) {
    const std::string guide = read_text(data_root() / "modules/volumetrics/README.md");
    std::string rows;
    for (const auto& [name, used] : bindings)
        rows += fmt::format("| `{}` | {} | {} | {} | {} |\n", name.substr(name.find('/') + 1),
                            module_numbers(used.textures), module_numbers(used.images),
                            module_numbers(used.storage), module_numbers(used.uniforms));
    EXPECT_NE(guide.find("\n|---|---|---|---|---|\n" + rows + "\n"), std::string::npos) << "expected:\n" << rows;
}

constexpr std::size_t most_permutations = 950;

TEST_F(VolumetricsPasses, PermutationsBuildWithinWhatOpenGlPromises) {
    ShaderLibrary engine_lighting(data_root());
    std::size_t permutations = 0, built = 0;
    std::map<std::string, ProgramBindings> bindings;
    const auto start = std::chrono::steady_clock::now();
    for (const ProgramDesc* desc : ProgramRegistry::all()) {
        if (!desc->name.starts_with("volumetrics/")) continue;
        std::vector<Permutation> all = all_permutations(*desc);
        // What counts its work is the same text and more; without it all other tests build.
        std::erase_if(all, [](const Permutation& permutation) {
            return permutation.contains("COUNT_WORK") && permutation.at("COUNT_WORK") == 0;
        });
        permutations += all.size();
        for (const Permutation& permutation : permutations_to_build(all)) {
            const gl::Program& program = engine_lighting.get(*desc, permutation);
            EXPECT_NO_THROW(gl::check_limits(desc->name, gl::program_needs(program.id()), gl::promised_limits));
            bindings[desc->name].add(program.id());
            ++built;
        }
    }
    expect_guide_lists(bindings);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::printf("%zu of %zu permutations built in %.0f s\n", built, permutations, time.count());
    EXPECT_GT(built, 100U);
    EXPECT_LE(permutations, most_permutations);
}

TEST_F(VolumetricsPasses, WorkIsCountedExactly) {
    host.count_work = true;
    host.size = {8, 8};
    host.global = {fog};
    host.has_sun = true;
    host.lights = {point_light({0, 1, -3}, 10), point_light({0, -1, -3}, 10)};
    host.lights[1].cone_shadow.z = -1;  // casts no shadow
    constexpr std::uint64_t pixels = 64, steps = 5;
    for (const auto lamps : {volumetrics::LampIntegration::center, volumetrics::LampIntegration::segment}) {
        Settings settings = plain_settings(steps);
        settings.light.lamp_integration = lamps;
        const gl::WorkCounts work = host.render(settings).work.at("volumetrics/march");
        EXPECT_EQ(work[int(gl::Work::medium_samples)], pixels * steps);
        EXPECT_EQ(work[int(gl::Work::shadow_lookups)], pixels * steps * 2);  // the sun and one lamp
        EXPECT_EQ(work[int(gl::Work::light_evaluations)], pixels * steps * 2);
        EXPECT_EQ(work[int(gl::Work::texture_fetches)], pixels);
    }
    Settings settings = plain_settings(steps);
    settings.filter.kernel = volumetrics::Filter::gaussian15;
    settings.filter.reconstruct = volumetrics::Reconstruct::light;
    EXPECT_EQ(host.render(settings).work.at("volumetrics/filter_vertical")[int(gl::Work::texture_fetches)],
              pixels * 30);
}

TEST_F(VolumetricsPasses, LampsElsewhereCostNothing) {
    host.count_work = true;
    host.global = {fog};
    host.slices = 10;
    host.slice_depth = 1;
    host.view_depth = [](int, int) { return 10.0F; };
    const auto evaluations = [&](int lamps) {
        host.lights.assign(lamps, point_light({0, 500, 0}, 10, 5));
        host.lights[0] = point_light({0, 1, -3}, 10, 2);
        host.listed = [](int light, int) { return light == 0; };
        return host.render(plain_settings(8)).work.at("volumetrics/march")[int(gl::Work::light_evaluations)];
    };
    const auto one = evaluations(1);
    EXPECT_GT(one, 0U);
    EXPECT_EQ(evaluations(4096), one);
}

TEST_F(VolumetricsPasses, CompositeBlendsPerChannel) {
    host.size = {4, 4};
    host.vertical_fov = 1e-3F;
    host.ambient = glm::vec3(1);
    for (const glm::vec3 sigma_a : {glm::vec3(0.1F), glm::vec3(0, 0.1F, 0.3F)}) {
        host.global = {{.sigma_s = glm::vec3(0.05F), .sigma_a = sigma_a}};
        gl::Texture color({.format = GL_RGBA16F, .size = {4, 4, 1}}, "color");
        color.clear_float(8, 8, 8, 1);
        PassList passes;
        const Inputs inputs = host.inputs(passes);
        const Settings settings = plain_settings(4);
        host.volumetrics().prepare(inputs, settings);
        const volumetrics::Outputs outputs = host.volumetrics().add_passes(passes, inputs, settings);
        const TextureRef before = passes.import("color", color);
        const TextureRef after = host.volumetrics().composite(passes, outputs, before);
        EXPECT_NE(after, before);
        passes.export_texture(after);
        passes.compile();
        TransientPool pool;
        passes.execute(pool);
        const Image image = gl::read_texture(color);
        for (int c = 0; c < 3; ++c) {
            const double sigma_t = 0.05 + sigma_a[c];
            const double expected = 0.05 / sigma_t * -std::expm1(-sigma_t * 10) + 8 * std::exp(-sigma_t * 10);
            EXPECT_NEAR(image.at(1, 1)[c], expected, 2e-3 * expected);
        }
    }
}

TEST_F(VolumetricsPasses, CompositeOfNothingReturnsTheSameTexture) {
    PassList passes;
    const gl::Texture color({.format = GL_RGBA16F, .size = {4, 4, 1}}, "color");
    const TextureRef before = passes.import("color", color);
    EXPECT_EQ(host.volumetrics().composite(passes, {}, before), before);
}

}  // namespace
}  // namespace tyndall::test
