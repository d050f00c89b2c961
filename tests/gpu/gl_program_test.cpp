#include <gmock/gmock.h>

#include <chrono>
#include <glm/gtc/matrix_transform.hpp>
#include <thread>

#include "engine/core/error.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/program_limits.h"
#include "engine/gl/readback.h"
#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "engine/shader/shader_library.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/support/temp_root.h"

namespace tyndall {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const char* const fullscreen_vert =
    "layout(location = 0) out vec2 uv;\n"
    "void main() { uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2); gl_Position = vec4(uv * 2.0 - 1.0, 0, 1); "
    "}\n";

class GlProgram : public GlTest {
  protected:
    GlProgram() { root_.write("shaders/full.vert", fullscreen_vert); }

    /// The colour that the program of `desc_` gives one pixel.
    std::vector<float> pixel(const Permutation& permutation = {},
                             const std::function<void(const gl::Program&)>& set = {}) {
        const gl::Program& program = library_.get(desc_, permutation);
        const gl::Texture target({gl::TextureKind::d2, GL_RGBA32F, {1, 1, 1}, 1}, "pixel");
        const gl::Attachment attachment{target};
        const gl::Framebuffer framebuffer({&attachment, 1}, nullptr, "pixel");
        framebuffer.bind();
        gl::apply({});
        program.use();
        if (set) set(program);
        gl::draw_fullscreen();
        return gl::read_texture(target).pixels;
    }
    std::string error(const Permutation& permutation = {}) {
        try {
            (void)library_.get(desc_, permutation);
        } catch (const Error& error) {
            reset_debug_messages();  // Mesa reports compile errors there, too
            return error.what();
        }
        return "";
    }
    void write(const std::string& text) const { root_.write("shaders/a.frag", text); }
    int reload() {
        std::this_thread::sleep_for(std::chrono::milliseconds(510));
        const int rebuilt = library_.reload_changed();
        if (!library_.errors().empty()) reset_debug_messages();
        return rebuilt;
    }

    TempRoot root_;
    ShaderLibrary library_{root_.path()};
    ProgramDesc desc_{
        "a", {{GL_VERTEX_SHADER, "shaders/full.vert"}, {GL_FRAGMENT_SHADER, "shaders/a.frag"}}, {}, {}};
};

TEST_F(GlProgram, DefinesChooseThePermutation) {
    desc_.axes = {{"RED", {0, 1}}, {"GREEN", {2, 3}}};
    write(
        "out vec4 color;\n#ifndef TYNDALL_GLSL\n#include <glm/glm.hpp>\n#endif\n"
        "void main() { color = vec4(RED, GREEN, 0, 1); }\n");
    EXPECT_THAT(pixel({{"RED", 0}, {"GREEN", 3}}), ElementsAre(0, 3, 0, 1));
    EXPECT_THAT(pixel({{"RED", 1}, {"GREEN", 2}}), ElementsAre(1, 2, 0, 1));
    EXPECT_EQ(library_.program_count(), 2U);
}

TEST_F(GlProgram, SaysWhatItNeedsOfTheDriver) {
    write(
        "layout(std430, binding = 5) readonly buffer Values { float values[]; };\n"
        "layout(binding = 9) uniform sampler2DArrayShadow maps;\n"
        "layout(binding = 2) uniform usampler3D counts[2];\n"
        "layout(binding = 3, r32f) writeonly uniform image2D target;\n"
        "layout(location = 0) out vec4 a;\n"
        "layout(location = 3) out vec4 b;\n"
        "void main() {\n"
        "    a = vec4(values[0], texture(maps, vec4(0)), float(texelFetch(counts[1], ivec3(0), 0).r), 0);\n"
        "    b = vec4(1);\n"
        "    imageStore(target, ivec2(0), a);\n"
        "}\n");
    const gl::ProgramLimits needs = gl::program_needs(library_.get(desc_).id());
    EXPECT_EQ(needs.storage_bindings, 6);
    EXPECT_EQ(needs.storage_blocks, 1);
    EXPECT_EQ(needs.vertex_storage_blocks, 0);
    EXPECT_EQ(needs.fragment_storage_blocks, 1);
    EXPECT_EQ(needs.compute_storage_blocks, 0);
    EXPECT_EQ(needs.texture_units, 10);
    EXPECT_EQ(needs.image_units, 4);
    EXPECT_EQ(needs.draw_buffers, 4);
}

TEST_F(GlProgram, SamplersOfTwoTypesOnOneUnitAreAnError) {
    write(
        "layout(binding = 3) uniform sampler2D a[2];\n"
        "layout(binding = 4) uniform sampler3D b;\n"
        "layout(location = 0) out vec4 color;\n"
        "void main() { color = texelFetch(a[1], ivec2(0), 0) + texelFetch(b, ivec3(0), 0); }\n");
    EXPECT_THAT(error(), HasSubstr("share texture unit 4"));
}

TEST_F(GlProgram, NeedsBeyondALimitAreAnErrorOfOneLine) {
    const gl::ProgramLimits promised = gl::promised_limits;
    EXPECT_NO_THROW(gl::check_limits("fog", promised, promised));
    gl::ProgramLimits needs = promised;
    needs.texture_units = 17;
    try {
        gl::check_limits("fog", needs, promised);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "program 'fog': needs 17 texture units, the driver has 16");
    }
}

TEST_F(GlProgram, TheDriverHasWhatOpenGlPromises) {
    EXPECT_NO_THROW(gl::check_limits("any", gl::promised_limits, gl::driver_limits()));
}

TEST_F(GlProgram, UniformsOfEveryType) {
    write(
        "uniform int i; uniform uint u; uniform float f; uniform ivec2 i2; uniform ivec3 i3; uniform vec2 v2;\n"
        "uniform vec3 v3; uniform vec4 v4; uniform mat4 m;\n"
        "out vec4 color;\n"
        "void main() {\n"
        "    color = vec4(i, u, f, i2.y) + 10.0 * vec4(i3.z, v2.y, v3.z, v4.w) + 100.0 * (m * vec4(0, 0, 0, 1));\n"
        "}\n");
    const auto set = [](const gl::Program& p) {
        p.set("i", -1);
        p.set("u", 2U);
        p.set("f", 0.5f);
        p.set("i2", glm::ivec2(0, 3));
        p.set("i3", glm::ivec3(0, 0, 4));
        p.set("v2", glm::vec2(0, 5));
        p.set("v3", glm::vec3(0, 0, 6));
        p.set("v4", glm::vec4(0, 0, 0, 7));
        p.set("m", glm::translate(glm::mat4(1), glm::vec3(1, 2, 3)));
        p.set("not there", 1);
    };
    EXPECT_THAT(pixel({}, set), ElementsAre(-1 + 40 + 100, 2 + 50 + 200, 0.5f + 60 + 300, 3 + 70 + 100));
}

TEST_F(GlProgram, ACompileErrorNamesFileAndLine) {
    root_.write("shaders/lib.glsl", "float fine() { return 1.0; }\n\nfloat broken() { return undeclared; }\n");
    write("out vec4 color;\n#include \"shaders/lib.glsl\"\nvoid main() { color = vec4(broken()); }\n");
    EXPECT_THAT(error(), AllOf(HasSubstr("'a'"), HasSubstr("shaders/lib.glsl:3:"), HasSubstr("undeclared"),
                               Not(HasSubstr("\n"))));
}

TEST_F(GlProgram, LinesCountOnAfterIncludesDefinesAndExtensions) {
    desc_.axes = {{"AXIS", {1}}};
    root_.write("shaders/lib.glsl", "float fine() { return 1.0; }\n\n");
    write(
        "#include \"shaders/lib.glsl\"\n"
        "#extension GL_ARB_shader_draw_parameters : enable\n"
        "out vec4 color;\n"
        "void main() { color = vec4(nowhere); }\n");
    EXPECT_THAT(error({{"AXIS", 1}}), AllOf(HasSubstr("shaders/a.frag:4:"), HasSubstr("AXIS=1")));
}

TEST_F(GlProgram, ALinkErrorNamesTheProgram) {
    write("layout(location = 3) in vec4 missing;\nout vec4 color;\nvoid main() { color = missing; }\n");
    EXPECT_THAT(error(), AllOf(HasSubstr("'a'"), HasSubstr("link"), Not(HasSubstr("\n"))));
}

TEST_F(GlProgram, ExtensionsMayStandAnywhereInAFile) {
    write(
        "// a comment, then code\nout vec4 color;\n  #extension GL_ARB_shader_ballot : require\n"
        "#ifdef GL_ARB_shader_ballot\nvoid main() { color = vec4(5); }\n#endif\n");
    EXPECT_THAT(pixel(), ElementsAre(5, 5, 5, 5));
}

TEST_F(GlProgram, HotReloadKeepsTheOldProgramUntilTheNewOneBuilds) {
    root_.write("shaders/value.glsl", "const float value = 1.0;\n");
    write("#include \"shaders/value.glsl\"\nout vec4 color;\nvoid main() { color = vec4(value); }\n");
    EXPECT_THAT(pixel(), ElementsAre(1, 1, 1, 1));
    EXPECT_EQ(reload(), 0);

    root_.write("shaders/value.glsl", "const float value = 2.0;\n");
    EXPECT_EQ(library_.reload_changed(), 0) << "looks at the disk every 0.5 s";
    EXPECT_EQ(reload(), 1);
    EXPECT_THAT(pixel(), ElementsAre(2, 2, 2, 2));

    root_.write("shaders/value.glsl", "const float value = ;\n");
    EXPECT_EQ(reload(), 0);
    EXPECT_THAT(library_.errors(), ElementsAre(HasSubstr("shaders/value.glsl:1:")));
    EXPECT_THAT(pixel(), ElementsAre(2, 2, 2, 2));
    EXPECT_EQ(reload(), 0);
    EXPECT_THAT(library_.errors(), testing::SizeIs(1)) << "stays until it builds";

    root_.write("shaders/value.glsl", "const float value = 3.0;\n");
    EXPECT_EQ(reload(), 1);
    EXPECT_THAT(library_.errors(), testing::IsEmpty());
    EXPECT_THAT(pixel(), ElementsAre(3, 3, 3, 3));
}

TEST_F(GlProgram, HotReloadSeesAMissingIncludeAppear) {
    write("out vec4 color;\nvoid main() { color = vec4(1); }\n");
    EXPECT_THAT(pixel(), ElementsAre(1, 1, 1, 1));
    write("#include \"shaders/late.glsl\"\nout vec4 color;\nvoid main() { color = vec4(late); }\n");
    EXPECT_EQ(reload(), 0);
    EXPECT_THAT(library_.errors(), ElementsAre(HasSubstr("shaders/a.frag:1:")));
    root_.write("shaders/late.glsl", "const float late = 4.0;\n");
    EXPECT_EQ(reload(), 1);
    EXPECT_THAT(pixel(), ElementsAre(4, 4, 4, 4));
}

TEST_F(GlProgram, PremultipliedBlendMultipliesTransmittances) {
    desc_.axes = {{"LAYER", {0, 1}}};
    write(
        "out vec4 color;\n"
        "void main() { color = LAYER == 0 ? vec4(1, 2, 4, 0.5) : vec4(0.5, 0.25, 0, 0.25); }\n");
    const gl::Texture target({gl::TextureKind::d2, GL_RGBA32F, {2, 2, 1}, 1}, "target");
    const gl::Attachment attachment{target};
    const gl::Framebuffer framebuffer({&attachment, 1}, nullptr, "target");
    framebuffer.bind();
    glEnable(GL_SCISSOR_TEST);  // what a host may leave behind
    glScissor(0, 0, 0, 0);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (int layer : {0, 1}) {
        gl::DrawState state;
        state.blend = layer == 0 ? gl::Blend::none : gl::Blend::premultiplied;
        gl::apply(state);
        library_.get(desc_, {{"LAYER", layer}}).use();
        gl::draw_fullscreen();
    }
    const std::vector<float> pixels = gl::read_texture(target).pixels;
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_THAT(std::vector<float>(pixels.begin() + 4 * i, pixels.begin() + 4 * i + 4),
                    ElementsAre(0.75f, 0.75f, 1.0f, 0.125f));
}

TEST_F(GlProgram, DepthIsReversedAndCanBeWrittenUntested) {
    write(
        "layout(location = 0) in vec2 uv;\nout vec4 color;\nuniform float z;\n"
        "void main() { color = vec4(z); gl_FragDepth = z; }\n");
    const gl::Program& program = library_.get(desc_);
    const gl::Texture color({gl::TextureKind::d2, GL_R32F, {1, 1, 1}, 1}, "color");
    gl::Texture depth({gl::TextureKind::d2, GL_DEPTH_COMPONENT32F, {1, 1, 1}, 1}, "depth");
    depth.clear_float(0.5f, 0, 0, 0);
    const gl::Attachment color_attachment{color}, depth_attachment{depth};
    const gl::Framebuffer framebuffer({&color_attachment, 1}, &depth_attachment, "target");
    framebuffer.bind();
    program.use();
    const auto draw = [&](float z, bool test, bool write) {
        gl::DrawState state;
        state.depth_test = test;
        state.depth_write = write;
        gl::apply(state);
        program.set("z", z);
        gl::draw_fullscreen();
    };
    draw(0.75f, true, false);
    EXPECT_EQ(gl::read_texture(color).pixels[0], 0.75f);
    EXPECT_EQ(gl::read_texture(depth).pixels[0], 0.5f);
    draw(0.25f, true, true);  // farther: rejected
    EXPECT_EQ(gl::read_texture(color).pixels[0], 0.75f);
    EXPECT_EQ(gl::read_texture(depth).pixels[0], 0.5f);
    draw(0.25f, false, true);
    EXPECT_EQ(gl::read_texture(color).pixels[0], 0.25f);
    EXPECT_EQ(gl::read_texture(depth).pixels[0], 0.25f);
}

}  // namespace
}  // namespace tyndall
