// A host's state: whatever it is, the picture is the same; and only what the guide says is another afterwards.
#include "tests/gpu/support/gl_state.h"

#include <gmock/gmock.h>

#include <map>
#include <memory>

#include "engine/gl/readback.h"
#include "engine/gl/state.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "volumetrics/technique.h"

namespace tyndall::test {
namespace {

using testing::IsEmpty;
using testing::IsSubsetOf;
using testing::UnorderedElementsAre;

/// What gl::apply sets: a pass list that composites leaves all of it as for a full-screen draw without blending.
const std::vector<std::string> fixed_function{"blend",
                                              "blend destination",
                                              "blend destination alpha",
                                              "blend equation",
                                              "blend equation alpha",
                                              "blend source",
                                              "blend source alpha",
                                              "logic op",
                                              "cull",
                                              "depth clamp",
                                              "depth test",
                                              "sRGB",
                                              "polygon offset",
                                              "polygon offset factor",
                                              "polygon offset units",
                                              "primitive restart",
                                              "rasterizer discard",
                                              "alpha to coverage",
                                              "scissor test",
                                              "stencil test",
                                              "clip distance 0",
                                              "clip distance 7",
                                              "color mask",
                                              "front face",
                                              "depth func",
                                              "depth mask",
                                              "depth range",
                                              "clip origin",
                                              "clip depth",
                                              "polygon mode"};

/// What is reset where a texture is uploaded.
const std::vector<std::string> unpacking{"unpack buffer",       "unpack alignment",   "unpack row length",
                                         "unpack image height", "unpack skip pixels", "unpack skip rows",
                                         "unpack skip images"};

class VolumetricsGlState : public GlTest {
  protected:
    VolumetricsGlState() {
        context_ = create_context({.kind = ContextKind::egl});  // what is done to its state goes with it
        hostile_ = std::make_unique<HostileState>();
        shaders_ = std::make_unique<ShaderLibrary>(folder_.roots());
        module_ = std::make_unique<volumetrics::Volumetrics>(*shaders_);
        pool_ = std::make_unique<TransientPool>();
        host_ = std::make_unique<StubHost>();
        host_->size = {16, 12};
        host_->global = {{.sigma_s = {0.03F, 0.05F, 0.04F}}};
        host_->local = {{.center = {0, 1, -6},
                         .half_extent = glm::vec3(2),
                         .sigma_s = glm::vec3(0.2F),
                         .noise_scale = 1,
                         .noise_amount = 0.5F}};
        host_->has_sun = true;
        host_->sun_direction = glm::normalize(glm::vec3(0.3F, -1, 0.2F));
        host_->shadows = 1;
        host_->lights = {point_light({0.5F, 1, -3}, 10)};
    }
    ~VolumetricsGlState() override {
        context_->make_current();
        host_.reset();
        pool_.reset();
        module_.reset();
        shaders_.reset();
        hostile_.reset();
        context_.reset();
    }

    /// The picture of one frame. All state is compared after each call, or but for execute, of which `fog_alone`
    /// looks at a pass of the host that binds fog.
    Image frame(const Settings& settings, bool is_hostile, bool fog_alone = false) {
        gl::Texture target({.format = GL_RGBA16F, .size = {host_->size, 1}}, "target");
        target.clear_float(0.2F, 0.3F, 0.4F, 1);
        PassList passes;
        Inputs inputs = host_->inputs(passes);
        inputs.frame_index = 3;
        inputs.transparents = {{{-1, 0, -5}, {1, 2, -4}}};
        if (is_hostile) hostile_->set();
        GlState before = gl_state();
        const auto same = [&](const char* call) {
            EXPECT_THAT(changed(before, gl_state()), IsEmpty()) << call << ' ' << settings.technique;
        };
        const auto uploads = [&](const char* call) {
            EXPECT_THAT(changed(before, gl_state()), IsSubsetOf(unpacking)) << call << ' ' << settings.technique;
            before = gl_state();
        };
        module_->prepare(inputs, settings);
        uploads("prepare");
        (void)module_->add_light_passes(passes, inputs, settings);
        same("add_light_passes");
        const volumetrics::Outputs out = module_->add_passes(passes, inputs, settings);
        uploads("add_passes");
        const TextureRef color = module_->composite(passes, out, passes.import("color", target));
        same("composite");
        if (fog_alone) add_fog_pass(passes, out.fog);
        passes.export_texture(color);
        passes.compile();
        same("compile");
        passes.execute(*pool_);
        if (!fog_alone) expect_as_in_the_guide(before, gl_state(), settings.technique);
        return gl::read_texture(target);
    }

    void add_fog_pass(PassList& passes, const volumetrics::Fog& fog) {
        passes.add(
            "transparents",
            [&](PassBuilder& builder) {
                volumetrics::Volumetrics::sample_fog(builder, fog);
                builder.keep();
            },
            [this, fog](const PassContext& context) {
                hostile_->set();
                const GlState before = gl_state();
                module_->bind_fog(context, fog);
                const GlState after = gl_state();
                EXPECT_THAT(
                    changed(before, after),
                    UnorderedElementsAre("uniform buffer", "storage buffer", "uniform block 1", "storage block 5",
                                         "texture unit 6", "texture unit 7", "texture unit 12", "texture unit 13",
                                         "texture unit 14", "texture unit 15", "sampler 6", "sampler 7",
                                         "sampler 12", "sampler 13", "sampler 14", "sampler 15"));
            });
    }

    /// The table of the guide, with what this host's own bind_lighting binds.
    static void expect_as_in_the_guide(const GlState& before, const GlState& after, const std::string& technique) {
        std::vector<std::string> may{"program",  "vertex array",   "draw framebuffer",
                                     "viewport", "uniform buffer", "storage buffer"};
        may.insert(may.end(), fixed_function.begin(), fixed_function.end());
        const auto add = [&](const char* name, const std::vector<int>& indices) {
            for (const int i : indices) may.push_back(std::string(name) + ' ' + std::to_string(i));
        };
        add("texture unit", {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 15});
        add("sampler", {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 15});
        add("image unit", {0, 1, 2, 3});
        add("uniform block", {0, 1, 2});
        add("storage block", {0, 1, 2, 3, 5, 6});
        const std::vector<std::string> all = changed(before, after);
        EXPECT_THAT(all, IsSubsetOf(may)) << technique;
        for (const std::string& name : all)
            EXPECT_TRUE(!name.starts_with("sampler ") || after.at(name)[0] == 0) << name << ' ' << technique;
        EXPECT_EQ(after.at("vertex array")[0], 0);
        gl::apply({});
        const GlState plain = gl_state();
        for (const std::string& name : fixed_function) EXPECT_EQ(after.at(name), plain.at(name)) << name;
    }

    ShaderFolder folder_;
    std::unique_ptr<GlContext> context_;
    std::unique_ptr<HostileState> hostile_;
    std::unique_ptr<ShaderLibrary> shaders_;
    std::unique_ptr<volumetrics::Volumetrics> module_;
    std::unique_ptr<TransientPool> pool_;
    std::unique_ptr<StubHost> host_;
};

TEST_F(VolumetricsGlState, OfAHostMayBeWhatItWillAndChangesAsTheGuideSays) {
    std::map<std::string, Image> plain;
    for (const bool is_hostile : {false, true})
        for (const std::string& technique : volumetrics::technique_names())
            for (const auto size : {volumetrics::Resolution::full, volumetrics::Resolution::half}) {
                const bool half = size == volumetrics::Resolution::half;
                if (technique == "off" || (half && technique != "ray_march")) continue;
                Settings settings;
                settings.technique = technique;
                settings.noise.kind = volumetrics::Noise::blue;
                settings.resolution.size = size;
                module_ = std::make_unique<volumetrics::Volumetrics>(*shaders_);  // uploads everything anew
                const Image picture = frame(settings, is_hostile);
                Image& expected = plain[technique + std::to_string(int(size))];
                if (!is_hostile) expected = picture;
                EXPECT_EQ(picture.pixels, expected.pixels) << technique;
            }
}

TEST_F(VolumetricsGlState, BindFogChangesWhatTheGuideSays) {
    Settings settings;
    settings.technique = "froxel";
    (void)frame(settings, true, true);
}

}  // namespace
}  // namespace tyndall::test
