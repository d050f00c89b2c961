// A renderer of its own that takes in Tyndall's volumetrics module: EGL and glad, forward lights, a shadow map.
// modules/volumetrics/README.md walks through it. usage: host [--out PICTURE.ppm] [--technique NAME]
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "volumetrics/volumetrics.h"

namespace {

using tyndall::Error;

constexpr glm::ivec2 size{480, 270};
constexpr int shadow_side = 1024;
constexpr float znear = 0.1F, shadow_extent = 20;  // m; the latter holds the hall
const glm::vec3 eye{0, 1.6F, 7};                   // m; looks along -Z

struct Box {
    glm::vec3 center, half_size, albedo;
};
/// A hall whose roof has three openings; the sun falls in through them.
const std::vector<Box> boxes{
    {{0, -0.1F, 1}, {6, 0.1F, 7}, {0.5F, 0.45F, 0.4F}},     // floor
    {{0, 2, -5.1F}, {6, 2.2F, 0.1F}, {0.4F, 0.4F, 0.45F}},  // walls
    {{-6.1F, 2, 1}, {0.1F, 2.2F, 7}, {0.4F, 0.4F, 0.45F}},
    {{6.1F, 2, 1}, {0.1F, 2.2F, 7}, {0.4F, 0.4F, 0.45F}},
    {{0, 4.1F, -3.75F}, {6, 0.1F, 1.25F}, {0.3F, 0.3F, 0.3F}},  // roof: behind, before and between the openings
    {{0, 4.1F, 3.75F}, {6, 0.1F, 4.25F}, {0.3F, 0.3F, 0.3F}},
    {{-4.625F, 4.1F, -1.5F}, {1.375F, 0.1F, 1}, {0.3F, 0.3F, 0.3F}},
    {{-1.75F, 4.1F, -1.5F}, {1, 0.1F, 1}, {0.3F, 0.3F, 0.3F}},
    {{0.75F, 4.1F, -1.5F}, {1, 0.1F, 1}, {0.3F, 0.3F, 0.3F}},
    {{4.125F, 4.1F, -1.5F}, {1.875F, 0.1F, 1}, {0.3F, 0.3F, 0.3F}},
    {{0.9F, 0.6F, -1.5F}, {0.4F, 0.6F, 1.2F}, {0.6F, 0.3F, 0.2F}},  // stands in the sun of the middle one
};

/// HostFrame of shaders/host_frame.glsl.
struct FrameBlock {
    glm::mat4 world_to_clip, world_to_shadow;
    glm::vec4 sun_direction, sun_illuminance, ambient, lamp_position, lamp_intensity;
};

glm::mat4 view_matrix() {
    glm::mat4 view(1);
    view[3] = glm::vec4(-eye, 1);
    return view;
}

/// Reversed depth, infinite far plane: clip depth is near / view depth.
glm::mat4 projection_matrix() {
    const float f = 1 / std::tan(glm::radians(18.0F));
    glm::mat4 p(0);
    p[0][0] = f * static_cast<float>(size.y) / static_cast<float>(size.x);
    p[1][1] = f;
    p[2][3] = -1;
    p[3][2] = znear;
    return p;
}

/// Parallel light over the whole hall: x and y across it, z along it, each to 0..1.
glm::mat4 shadow_matrix(glm::vec3 sun) {
    const glm::vec3 x = glm::normalize(glm::cross(sun, glm::vec3(0, 0, 1))), y = glm::cross(x, sun);
    const glm::vec3 center{0, 2, 1};
    glm::mat4 m(1);
    const glm::vec3 axes[3] = {x, y, sun};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) m[column][row] = axes[row][column] / shadow_extent;
        m[3][row] = 0.5F - glm::dot(axes[row], center) / shadow_extent;
    }
    return m;
}

FrameBlock frame_block() {
    const glm::vec3 sun = glm::normalize(glm::vec3(0.5F, -1, 0));
    return {.world_to_clip = projection_matrix() * view_matrix(),
            .world_to_shadow = shadow_matrix(sun),
            .sun_direction = {sun, shadow_extent},
            .sun_illuminance = {30, 27, 22, 0},
            .ambient = {0.07F, 0.08F, 0.1F, 0},
            .lamp_position = {-3.4F, 1.4F, -3, 12},
            .lamp_intensity = {3, 1.5F, 0.6F, 0.05F}};
}

/// OpenGL 4.5 core without a surface; stays current for the life of the program.
void make_context() {
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) throw Error("EGL: no surfaceless display");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    eglBindAPI(EGL_OPENGL_API);
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) throw Error("EGL: no context of OpenGL 4.5");
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
    if (gladLoadGL(eglGetProcAddress) == 0) throw Error("glad: no OpenGL");
}

GLuint compile(GLuint program, GLenum stage, const char* name) {
    const std::filesystem::path folder = std::filesystem::path(HOST_DIR) / "shaders";
    const std::string text =
        "#version 450 core\n" + tyndall::read_text(folder / "host_frame.glsl") + tyndall::read_text(folder / name);
    const char* source = text.c_str();
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    return shader;
}

GLuint make_program(const char* fragment) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader :
         {compile(program, GL_VERTEX_SHADER, "box.vert"), compile(program, GL_FRAGMENT_SHADER, fragment)})
        glDeleteShader(shader);
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked == 0) throw Error(std::string(fragment) + ": does not build");
    return program;
}

GLuint make_texture(GLenum format, glm::ivec2 pixels) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, pixels.x, pixels.y);
    return texture;
}

GLuint make_shadow_map() {
    const GLuint map = make_texture(GL_DEPTH_COMPONENT32F, glm::ivec2(shadow_side));
    const float lit[4] = {1, 1, 1, 1};
    glTextureParameterfv(map, GL_TEXTURE_BORDER_COLOR, lit);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTextureParameteri(map, wrap, GL_CLAMP_TO_BORDER);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTextureParameteri(map, filter, GL_LINEAR);
    glTextureParameteri(map, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    return map;
}

/// The host's own renderer.
class Renderer {
  public:
    GLuint color = make_texture(GL_RGBA16F, size), depth = make_texture(GL_DEPTH_COMPONENT32F, size);
    GLuint shadow_map = make_shadow_map();
    FrameBlock block = frame_block();

    Renderer() {
        glCreateBuffers(1, &uniforms_);
        glNamedBufferStorage(uniforms_, sizeof block, &block, 0);
        glCreateFramebuffers(1, &target_);
        glNamedFramebufferTexture(target_, GL_COLOR_ATTACHMENT0, color, 0);
        glNamedFramebufferTexture(target_, GL_DEPTH_ATTACHMENT, depth, 0);
        glCreateFramebuffers(1, &shadow_target_);
        glNamedFramebufferTexture(shadow_target_, GL_DEPTH_ATTACHMENT, shadow_map, 0);
        glCreateVertexArrays(1, &no_vertices_);
        glCreateSamplers(1, &depth_sampler_);
        glSamplerParameteri(depth_sampler_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(depth_sampler_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }

    /// What both its own shaders and those of shaders/interface read.
    void bind_lighting() const {
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniforms_);
        glBindTextureUnit(8, shadow_map);
        glBindTextureUnit(9, shadow_map);
        glBindSampler(9, depth_sampler_);
    }

    /// The state that a pass needs is set here: the module leaves its own behind.
    void draw() const {
        bind_lighting();
        glBindVertexArray(no_vertices_);
        glDisable(GL_BLEND);
        glDisable(GL_CULL_FACE);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);

        const float farthest = 1, sky_depth = 0, sky[4] = {0.1F, 0.2F, 0.4F, 1};
        glBindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
        glViewport(0, 0, shadow_side, shadow_side);
        glClearNamedFramebufferfv(shadow_target_, GL_DEPTH, 0, &farthest);
        glDepthFunc(GL_LESS);
        draw_boxes(depth_program_, true);

        glBindFramebuffer(GL_FRAMEBUFFER, target_);
        glViewport(0, 0, size.x, size.y);
        glClearNamedFramebufferfv(target_, GL_COLOR, 0, sky);
        glClearNamedFramebufferfv(target_, GL_DEPTH, 0, &sky_depth);
        glDepthFunc(GL_GREATER);
        draw_boxes(forward_program_, false);
    }

  private:
    static void draw_boxes(GLuint program, bool into_shadow_map) {
        glUseProgram(program);
        glUniform1i(2, into_shadow_map ? 1 : 0);
        for (const Box& box : boxes) {
            glUniform3fv(0, 1, &box.center.x);
            glUniform3fv(1, 1, &box.half_size.x);
            if (!into_shadow_map) glUniform3fv(3, 1, &box.albedo.x);
            glDrawArrays(GL_TRIANGLES, 0, 36);
        }
    }

    GLuint forward_program_ = make_program("forward.frag"), depth_program_ = make_program("depth.frag");
    GLuint uniforms_ = 0, target_ = 0, shadow_target_ = 0, no_vertices_ = 0, depth_sampler_ = 0;
};

/// What the module is told of a frame.
tyndall::volumetrics::Inputs volumetric_inputs(tyndall::PassList& passes, const Renderer& renderer) {
    const FrameBlock& block = renderer.block;
    tyndall::volumetrics::Inputs in;
    in.view = view_matrix();
    in.projection = projection_matrix();
    in.eye = eye;
    in.znear = znear;
    in.size = size;
    in.depth = passes.import("host depth", {renderer.depth, {.format = GL_DEPTH_COMPONENT32F, .size = {size, 1}}});
    in.global = {{.sigma_s = glm::vec3(0.05F), .anisotropy = 0.2F}};
    in.has_sun = in.has_lamps = in.has_ambient = true;
    in.sun_direction = block.sun_direction;
    in.has_shadow_maps = true;
    in.lamps = {{.position = block.lamp_position,
                 .range = block.lamp_position.w,
                 .shadow = false,
                 .intensity = (block.lamp_intensity.r + block.lamp_intensity.g + block.lamp_intensity.b) / 3}};
    in.light_textures = {passes.import(
        "host shadow map",
        {renderer.shadow_map, {.format = GL_DEPTH_COMPONENT32F, .size = {shadow_side, shadow_side, 1}}})};
    in.bind_lighting = [&renderer] { renderer.bind_lighting(); };
    return in;
}

/// Rows from top to bottom; 1 - exp(-radiance), gamma 2.2.
void write_picture(const char* path, GLuint color) {
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(size.x * size.y));
    glGetTextureImage(color, 0, GL_RGB, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof pixels[0]),
                      pixels.data());
    std::string bytes = "P6 " + std::to_string(size.x) + " " + std::to_string(size.y) + " 255\n";
    for (int y = size.y - 1; y >= 0; --y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const float radiance = pixels[static_cast<std::size_t>(y * size.x + x)][c];
                const float shown = std::pow(1 - std::exp(-radiance), 1 / 2.2F);
                bytes += static_cast<char>(std::lround(255 * shown));
            }
    tyndall::write_text(path, bytes);
}

void run(const char* picture, const char* technique) {
    make_context();
    const Renderer renderer;
    tyndall::ShaderLibrary shaders({HOST_DIR, TYNDALL_DATA_DIR});
    tyndall::volumetrics::Volumetrics volumetrics(shaders);
    tyndall::volumetrics::Settings settings;
    settings.technique = technique;
    tyndall::TransientPool pool;
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        renderer.draw();
        tyndall::PassList passes;
        tyndall::volumetrics::Inputs inputs = volumetric_inputs(passes, renderer);
        inputs.frame_index = frame;
        volumetrics.prepare(inputs, settings);
        const tyndall::volumetrics::Outputs out = volumetrics.add_passes(passes, inputs, settings);
        tyndall::TextureRef color =
            passes.import("host color", {renderer.color, {.format = GL_RGBA16F, .size = {size, 1}}});
        color = volumetrics.composite(passes, out, color);
        passes.export_texture(color);
        passes.compile();
        passes.execute(pool);
    }
    write_picture(picture, renderer.color);
}  // here go pool, module and shaders, in this order, while the context is current

}  // namespace

int main(int count, char** arguments) try {
    const char *picture = "host.ppm", *technique = "auto";
    for (int i = 1; i + 1 < count; i += 2) {
        const std::string option = arguments[i];
        if (option == "--out") picture = arguments[i + 1];
        if (option == "--technique") technique = arguments[i + 1];
    }
    run(picture, technique);
    return EXIT_SUCCESS;
} catch (const std::exception& failure) {
    std::fprintf(stderr, "host: %s\n", failure.what());
    return EXIT_FAILURE;
}
