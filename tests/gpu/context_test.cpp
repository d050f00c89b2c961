#include <glad/gl.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/platform/gl_context.h"
#include "tests/gpu/support/gl_test.h"

namespace tyndall {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr int side = 32;

GLuint compile(GLenum stage, const char* source) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    EXPECT_EQ(compiled, GL_TRUE);
    return shader;
}

/// Clears to blue and draws a triangle over the lower left half, red growing to the right and green upwards, in
/// plain GL calls: what every context must do alike. Rows from the bottom.
std::vector<GLubyte> draw_triangle(GlContext& context) {
    GLuint texture = 0;
    GLuint framebuffer = 0;
    GLuint vertices = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, side, side);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    glCreateVertexArrays(1, &vertices);
    const GLuint vertex = compile(GL_VERTEX_SHADER, R"(#version 450 core
        void main() {
            const vec2 corner[3] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1));
            gl_Position = vec4(corner[gl_VertexID], 0.25, 1);
        })");
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, R"(#version 450 core
        out vec4 color;
        void main() { color = vec4(gl_FragCoord.xy / 32, 0, 1); })");
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);

    const float blue[] = {0, 0, 1, 1};
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, side, side);
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, blue);
    glUseProgram(program);
    glBindVertexArray(vertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    std::vector<GLubyte> pixels(side * side * 4);
    glReadPixels(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    context.present(framebuffer, {side, side});

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glUseProgram(0);
    glBindVertexArray(0);
    glDeleteProgram(program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    glDeleteVertexArrays(1, &vertices);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
    return pixels;
}

/// By the rules of rasterisation: pixel centres strictly inside the triangle are covered, those strictly outside
/// are not; the diagonal itself is left to the driver.
void expect_triangle(const std::vector<GLubyte>& pixels) {
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (x + y + 1 == side) continue;
            const GLubyte* p = &pixels[std::size_t(y * side + x) * 4];
            const bool inside = x + y + 1 < side;
            ASSERT_NEAR(p[0], inside ? (x + 0.5) / side * 255 : 0, 1) << x << ", " << y;
            ASSERT_NEAR(p[1], inside ? (y + 0.5) / side * 255 : 0, 1) << x << ", " << y;
            ASSERT_EQ(p[2], inside ? 0 : 255) << x << ", " << y;
        }
    }
}

bool has_display() {
    const char* display = std::getenv("DISPLAY");
    return display != nullptr && *display != '\0';
}

class Contexts : public testing::Test {
  protected:
    Contexts() { reset_debug_messages(); }
    ~Contexts() override { EXPECT_EQ(debug_messages().count, 0) << debug_messages().last; }
};

TEST_F(Contexts, OneAfterTheOtherDrawTheSamePixels) {
    std::vector<ContextKind> kinds = {ContextKind::egl, ContextKind::osmesa, ContextKind::egl};
    if (has_display()) kinds.insert(kinds.end(), {ContextKind::glfw, ContextKind::osmesa, ContextKind::glfw});
    std::vector<GLubyte> first;
    for (const ContextKind kind : kinds) {
        SCOPED_TRACE(to_string(kind));
        const auto context = create_context({.kind = kind, .size = {side, side}});
        EXPECT_EQ(context->kind(), kind);
        const std::vector<GLubyte> pixels = draw_triangle(*context);
        expect_triangle(pixels);
        if (first.empty()) first = pixels;
        EXPECT_EQ(pixels, first);
    }
}

TEST_F(Contexts, LiveTogetherOneCurrentAtATime) {
    const auto egl = create_context({.kind = ContextKind::egl});
    const auto osmesa = create_context({.kind = ContextKind::osmesa});
    for (GlContext* context : {egl.get(), osmesa.get(), egl.get()}) {
        SCOPED_TRACE(to_string(context->kind()));
        context->make_current();
        expect_triangle(draw_triangle(*context));
    }
}

TEST_F(Contexts, HaveTheAgreedStateAndCapabilities) {
    for (const ContextKind kind : {ContextKind::egl, ContextKind::osmesa}) {
        SCOPED_TRACE(to_string(kind));
        const auto context = create_context({.kind = kind, .size = {640, 360}});
        GLint origin = 0;
        GLint depth = 0;
        GLint major = 0;
        glGetIntegerv(GL_CLIP_ORIGIN, &origin);
        glGetIntegerv(GL_CLIP_DEPTH_MODE, &depth);
        glGetIntegerv(GL_MAJOR_VERSION, &major);
        EXPECT_EQ(origin, GL_LOWER_LEFT);
        EXPECT_EQ(depth, GL_ZERO_TO_ONE);
        EXPECT_GE(major, 4);
        const Capabilities& c = context->capabilities();
        EXPECT_FALSE(c.renderer.empty());
        EXPECT_THAT(c.version, HasSubstr("Core Profile"));
        EXPECT_EQ(c.software, c.renderer.find("pipe") != std::string::npos);
        EXPECT_GE(c.max_texture_size, 16384) << "GL 4.5, table 23.54";
        EXPECT_GE(c.max_anisotropy, 1);
        EXPECT_EQ(context->framebuffer_size(), glm::ivec2(640, 360));
        EXPECT_FALSE(context->should_close());
    }
}

TEST(ContextDebugOutput, CountsMediumAndHighOnly) {
    for (const ContextKind kind : {ContextKind::egl, ContextKind::osmesa}) {
        SCOPED_TRACE(to_string(kind));
        const auto context = create_context({.kind = kind});
        reset_debug_messages();
        const auto say = [](GLenum severity, const char* text) {
            glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_OTHER, 1, severity, -1, text);
        };
        say(GL_DEBUG_SEVERITY_NOTIFICATION, "notification");
        say(GL_DEBUG_SEVERITY_LOW, "low");
        EXPECT_EQ(debug_messages().count, 0);
        say(GL_DEBUG_SEVERITY_MEDIUM, "medium");
        EXPECT_EQ(debug_messages().last, "medium");
        glEnable(GL_TEXTURE_2D);  // no such capability in the core profile: the driver's own message
        EXPECT_EQ(debug_messages().count, 2);
        EXPECT_NE(glGetError(), GLenum(GL_NO_ERROR));
        reset_debug_messages();
        EXPECT_EQ(debug_messages().count, 0);
        EXPECT_EQ(debug_messages().last, "");
    }
}

TEST(ContextKinds, HaveNames) {
    for (const char* name : {"auto", "egl", "osmesa", "glfw"}) {
        EXPECT_STREQ(to_string(parse_context_kind(name)), name);
    }
    EXPECT_EQ(parse_context_kind("osmesa"), ContextKind::osmesa);
    EXPECT_THAT([] { (void)parse_context_kind("wgl"); },
                ThrowsMessage<UsageError>(AllOf(HasSubstr("wgl"), HasSubstr("auto, egl, osmesa or glfw"))));
}

/// Runs in a process of its own, since a driver reads these variables once. Exits with 3 on an Error.
[[noreturn]] void create_with(const char* variable, const char* value, const ContextRequest& request) {
    if (value == nullptr) {
        ::unsetenv(variable);
    } else {
        ::setenv(variable, value, 1);
    }
    init_logging();
    try {
        const auto context = create_context(request);
        std::fprintf(stderr, "created %s", to_string(context->kind()));
    } catch (const Error& e) {
        std::fprintf(stderr, "%s", e.what());
        std::_Exit(3);
    }
    std::_Exit(0);
}

class ContextsDeathTest : public testing::Test {
  protected:
    ContextsDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(ContextsDeathTest, OldDriverIsNamedInOneLine) {
    for (const ContextKind kind : {ContextKind::egl, ContextKind::osmesa}) {
        EXPECT_EXIT(create_with("MESA_GL_VERSION_OVERRIDE", "3.3", {.kind = kind}), testing::ExitedWithCode(3),
                    "OpenGL 4.5 core needed, driver [^\n]* gives 3.3");
    }
}

TEST_F(ContextsDeathTest, WindowWithoutDisplaySaysWhatToDo) {
    EXPECT_EXIT(create_with("DISPLAY", nullptr, {.window = true}), testing::ExitedWithCode(3),
                "no display: set DISPLAY or use tyndall render");
    EXPECT_EXIT(create_with("DISPLAY", ":4711", {.window = true}), testing::ExitedWithCode(3),
                "no display: .*:4711");
}

TEST_F(ContextsDeathTest, HeadlessFallsBackToOsMesaAndSaysWhy) {
    EXPECT_EXIT(create_with("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", {}), testing::ExitedWithCode(0),
                "no EGL context.*trying OSMesa.*created osmesa");
}

TEST_F(GlTest, SharedContextSurvivesOthers) {
    { const auto other = create_context({.kind = ContextKind::osmesa}); }
    { const auto other = create_context({.kind = ContextKind::egl}); }
    context().make_current();
    expect_triangle(draw_triangle(context()));
}

TEST_F(GlTest, NextTestFindsTheSharedContextCurrent) {
    expect_triangle(draw_triangle(context()));
}

}  // namespace
}  // namespace tyndall
