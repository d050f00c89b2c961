// What a host may get wrong is an Error that says what is wrong, and the next right frame is drawn as ever.
#include <gmock/gmock.h>

#include <limits>

#include "engine/core/error.h"
#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

class VolumetricsBadInputs : public GlTest {
  protected:
    VolumetricsBadInputs() {
        host.size = {8, 6};
        host.global = {{.sigma_s = glm::vec3(0.1F)}};
        host.has_sun = true;
        settings.technique = "ray_march";
    }
    ~VolumetricsBadInputs() override { EXPECT_GT(host.render(settings).scattering.at(4, 3)[0], 0); }

    template <class Change>
    void expect_prepare_throws(Change change, const std::string& name) {
        PassList passes;
        Inputs inputs = host.inputs(passes);
        change(inputs);
        EXPECT_THAT(
            [&] { host.volumetrics().prepare(inputs, settings); },
            ThrowsMessage<Error>(AllOf(HasSubstr("volumetrics: "), HasSubstr(name), HasSubstr("expected"))));
        settings.technique = "off";
        EXPECT_NO_THROW(host.volumetrics().prepare(inputs, settings));  // nothing is read
        settings.technique = "ray_march";
    }
    template <class Change>
    void expect_add_passes_throws(Change change, const std::string& says) {
        PassList passes;
        Inputs inputs = host.inputs(passes);
        change(passes, inputs);
        host.volumetrics().prepare(inputs, settings);
        EXPECT_THAT([&] { (void)host.volumetrics().add_passes(passes, inputs, settings); },
                    ThrowsMessage<Error>(HasSubstr(says)));
    }

    StubHost host;
    Settings settings;
};

TEST_F(VolumetricsBadInputs, OfTheCameraAndTheSun) {
    expect_prepare_throws([](Inputs& in) { in.depth = {}; }, "Inputs::depth");
    expect_prepare_throws([](Inputs& in) { in.size.y = 0; }, "Inputs::size is 8 x 0");
    expect_prepare_throws([](Inputs& in) { in.eye.y = nan; }, "Inputs::eye is (0, nan, 0)");
    expect_prepare_throws([](Inputs& in) { in.view[3][1] = nan; }, "Inputs::view");
    expect_prepare_throws([](Inputs& in) { in.projection[0][0] = std::numeric_limits<float>::infinity(); },
                          "Inputs::projection");
    expect_prepare_throws([](Inputs& in) { in.znear = 0; }, "Inputs::znear is 0");
    expect_prepare_throws([](Inputs& in) { in.sun_direction = {0, -3, 0}; }, "Inputs::sun_direction is (0, -3, 0)");
    expect_prepare_throws([](Inputs& in) { in.lamps = {{.index = 0}}; }, "Inputs::lamps has 1 lamps");
}

TEST_F(VolumetricsBadInputs, OfTextures) {
    expect_add_passes_throws([](PassList&, Inputs& in) { in.size = {16, 6}; }, "Inputs::depth is 8 x 6 x 1");
    expect_add_passes_throws(
        [](PassList& passes, Inputs& in) {
            in.depth = passes.create("colour", {.format = GL_RGBA16F, .size = {8, 6, 1}});
        },
        "D32F or D32F_S8 expected");
    expect_add_passes_throws(
        [](PassList& passes, Inputs& in) {
            in.motion = passes.create("motion", {.format = GL_RG16F, .size = {4, 6, 1}});
        },
        "Inputs::motion is 4 x 6 x 1");
    expect_add_passes_throws([](PassList&, Inputs& in) { in.light_textures = {{.index = 1000}}; },
                             "light_textures");
    // A pass of the host wrote it since.
    expect_add_passes_throws(
        [](PassList& passes, Inputs& in) {
            passes.add(
                "host", [&](PassBuilder& builder) { builder.attach_depth(in.depth); }, [](const PassContext&) {});
        },
        "Inputs::depth is no texture of this pass list in its newest version");
}

TEST_F(VolumetricsBadInputs, ThePictureMustBeOfTheSameSizeAndAFormatOfFloats) {
    for (const bool size : {false, true}) {
        PassList passes;
        const Inputs inputs = host.inputs(passes);
        host.volumetrics().prepare(inputs, settings);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, inputs, settings);
        const TextureRef color =
            passes.create("color", {.format = GLenum(size ? GL_RGBA16F : GL_RGBA8), .size = {size ? 7 : 8, 6, 1}});
        EXPECT_THAT([&] { (void)host.volumetrics().composite(passes, out, color); },
                    ThrowsMessage<Error>(HasSubstr(size ? "is 7 x 6 x 1" : "RGBA16F or RGBA32F expected")));
    }
}

TEST_F(VolumetricsBadInputs, OrderOfCalls) {
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    volumetrics::Volumetrics& module = host.volumetrics();
    const auto without = ThrowsMessage<Error>(HasSubstr("without a prepare"));
    EXPECT_THAT([&] { (void)module.add_passes(passes, inputs, settings); }, without);
    EXPECT_THAT([&] { (void)module.add_light_passes(passes, inputs, settings); }, without);
    module.prepare(inputs, settings);
    (void)module.add_passes(passes, inputs, settings);
    EXPECT_THAT([&] { (void)module.add_passes(passes, inputs, settings); }, without);
}

TEST_F(VolumetricsBadInputs, TwoViewsOfOneObject) {
    TransientPool pool;
    PassList passes;
    for (int view = 0; view < 2; ++view) {
        const Inputs inputs = host.inputs(passes);
        host.volumetrics().prepare(inputs, settings);
        passes.export_texture(host.volumetrics().add_passes(passes, inputs, settings).scattering);
    }
    passes.compile();
    EXPECT_THAT([&] { passes.execute(pool); }, ThrowsMessage<Error>(HasSubstr("a Volumetrics of its own")));
}

TEST_F(VolumetricsBadInputs, NothingExported) {
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    host.volumetrics().prepare(inputs, settings);
    (void)host.volumetrics().add_passes(passes, inputs, settings);
    EXPECT_THAT([&] { passes.compile(); }, ThrowsMessage<Error>(HasSubstr("no texture and no buffer is exported")));
}

// What the guide lists as accepted is.
TEST_F(VolumetricsBadInputs, DepthWithStencilAndColorOfTwiceTheBitsAreGood) {
    host.local = {{.center = {0, 0, -6}, .half_extent = glm::vec3(3), .sigma_s = glm::vec3(0.3F)}};
    settings.resolution.size = volumetrics::Resolution::half;
    const auto picture = [&](GLenum depth_format, GLenum color_format) {
        gl::Texture depth({.format = depth_format, .size = {host.size, 1}}, "depth");
        gl::Texture color({.format = color_format, .size = {host.size, 1}}, "color");
        const gl::Attachment attachment{depth, 0, -1};
        const gl::Framebuffer target({}, &attachment, "target");
        const float seven_metres = host.znear / 7;
        glClearNamedFramebufferfv(target.id(), GL_DEPTH, 0, &seven_metres);
        color.clear_float(0.25F, 0.5F, 1, 1);
        PassList passes;
        TransientPool pool;
        Inputs inputs = host.inputs(passes);
        inputs.depth = passes.import("depth", depth);
        host.volumetrics().prepare(inputs, settings);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, inputs, settings);
        passes.export_texture(host.volumetrics().composite(passes, out, passes.import("color", color)));
        passes.compile();
        passes.execute(pool);
        return gl::read_texture(color);
    };
    for (const char* technique : {"auto", "ray_march", "particles", "billboards", "epipolar"}) {
        settings.technique = technique;
        host.volumetrics().forget_history();
        const Image usual = picture(GL_DEPTH_COMPONENT32F, GL_RGBA16F);
        host.volumetrics().forget_history();
        EXPECT_EQ(picture(GL_DEPTH32F_STENCIL8, GL_RGBA16F).pixels, usual.pixels) << technique;
        host.volumetrics().forget_history();
        const Image finer = picture(GL_DEPTH_COMPONENT32F, GL_RGBA32F);
        for (std::size_t i = 0; i < usual.pixels.size(); ++i)
            ASSERT_NEAR(finer.pixels[i], usual.pixels[i], 2e-3F * (1 + usual.pixels[i])) << technique;
    }
}

}  // namespace
}  // namespace tyndall::test
