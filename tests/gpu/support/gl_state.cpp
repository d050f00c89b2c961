#include "tests/gpu/support/gl_state.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tyndall::test {
namespace {

using Name = std::pair<GLenum, const char*>;

constexpr Name switches[] = {{GL_BLEND, "blend"},
                             {GL_COLOR_LOGIC_OP, "logic op"},
                             {GL_CULL_FACE, "cull"},
                             {GL_DEPTH_CLAMP, "depth clamp"},
                             {GL_DEPTH_TEST, "depth test"},
                             {GL_FRAMEBUFFER_SRGB, "sRGB"},
                             {GL_POLYGON_OFFSET_FILL, "polygon offset"},
                             {GL_PRIMITIVE_RESTART, "primitive restart"},
                             {GL_RASTERIZER_DISCARD, "rasterizer discard"},
                             {GL_SAMPLE_ALPHA_TO_COVERAGE, "alpha to coverage"},
                             {GL_SCISSOR_TEST, "scissor test"},
                             {GL_STENCIL_TEST, "stencil test"},
                             {GL_CLIP_DISTANCE0, "clip distance 0"},
                             {GL_CLIP_DISTANCE7, "clip distance 7"},
                             {GL_DITHER, "dither"},
                             {GL_MULTISAMPLE, "multisample"},
                             {GL_PROGRAM_POINT_SIZE, "point size of programs"},
                             {GL_SAMPLE_MASK, "sample mask"},
                             {GL_TEXTURE_CUBE_MAP_SEAMLESS, "seamless cubes"}};
constexpr Name numbers[] = {{GL_BLEND_SRC_RGB, "blend source"},
                            {GL_BLEND_SRC_ALPHA, "blend source alpha"},
                            {GL_BLEND_DST_RGB, "blend destination"},
                            {GL_BLEND_DST_ALPHA, "blend destination alpha"},
                            {GL_BLEND_EQUATION_RGB, "blend equation"},
                            {GL_BLEND_EQUATION_ALPHA, "blend equation alpha"},
                            {GL_BLEND_COLOR, "blend color"},
                            {GL_COLOR_WRITEMASK, "color mask"},
                            {GL_CULL_FACE_MODE, "cull face"},
                            {GL_FRONT_FACE, "front face"},
                            {GL_DEPTH_FUNC, "depth func"},
                            {GL_DEPTH_WRITEMASK, "depth mask"},
                            {GL_DEPTH_RANGE, "depth range"},
                            {GL_CLIP_ORIGIN, "clip origin"},
                            {GL_CLIP_DEPTH_MODE, "clip depth"},
                            {GL_POLYGON_MODE, "polygon mode"},
                            {GL_POLYGON_OFFSET_FACTOR, "polygon offset factor"},
                            {GL_POLYGON_OFFSET_UNITS, "polygon offset units"},
                            {GL_VIEWPORT, "viewport"},
                            {GL_SCISSOR_BOX, "scissor box"},
                            {GL_STENCIL_FUNC, "stencil func"},
                            {GL_STENCIL_WRITEMASK, "stencil mask"},
                            {GL_COLOR_CLEAR_VALUE, "clear color"},
                            {GL_DEPTH_CLEAR_VALUE, "clear depth"},
                            {GL_LINE_WIDTH, "line width"},
                            {GL_LOGIC_OP_MODE, "logic op mode"},
                            {GL_PATCH_VERTICES, "patch vertices"},
                            {GL_PROVOKING_VERTEX, "provoking vertex"},
                            {GL_PRIMITIVE_RESTART_INDEX, "restart index"},
                            {GL_ACTIVE_TEXTURE, "active texture"},
                            {GL_CURRENT_PROGRAM, "program"},
                            {GL_VERTEX_ARRAY_BINDING, "vertex array"},
                            {GL_DRAW_FRAMEBUFFER_BINDING, "draw framebuffer"},
                            {GL_READ_FRAMEBUFFER_BINDING, "read framebuffer"},
                            {GL_RENDERBUFFER_BINDING, "renderbuffer"},
                            {GL_ARRAY_BUFFER_BINDING, "array buffer"},
                            {GL_DRAW_INDIRECT_BUFFER_BINDING, "draw indirect buffer"},
                            {GL_DISPATCH_INDIRECT_BUFFER_BINDING, "dispatch indirect buffer"},
                            {GL_PIXEL_PACK_BUFFER_BINDING, "pack buffer"},
                            {GL_PIXEL_UNPACK_BUFFER_BINDING, "unpack buffer"},
                            {GL_UNIFORM_BUFFER_BINDING, "uniform buffer"},
                            {GL_SHADER_STORAGE_BUFFER_BINDING, "storage buffer"},
                            {GL_PACK_ALIGNMENT, "pack alignment"},
                            {GL_PACK_ROW_LENGTH, "pack row length"},
                            {GL_UNPACK_ALIGNMENT, "unpack alignment"},
                            {GL_UNPACK_ROW_LENGTH, "unpack row length"},
                            {GL_UNPACK_IMAGE_HEIGHT, "unpack image height"},
                            {GL_UNPACK_SKIP_PIXELS, "unpack skip pixels"},
                            {GL_UNPACK_SKIP_ROWS, "unpack skip rows"},
                            {GL_UNPACK_SKIP_IMAGES, "unpack skip images"}};
struct Indexed {
    GLuint count;
    const char* name;
    std::vector<GLenum> values;
};
const Indexed indexed[] = {
    {16,
     "texture unit",
     {GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP,
      GL_TEXTURE_BINDING_CUBE_MAP_ARRAY}},
    {16, "sampler", {GL_SAMPLER_BINDING}},
    {8, "image unit", {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_FORMAT, GL_IMAGE_BINDING_ACCESS}},
    {16, "uniform block", {GL_UNIFORM_BUFFER_BINDING}},
    {8, "storage block", {GL_SHADER_STORAGE_BUFFER_BINDING}}};

GLuint empty_program() {
    const char* text = "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
    return glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
}

}  // namespace

GlState gl_state() {
    GlState state;
    for (const auto& [value, name] : switches) state[name] = {double(glIsEnabled(value))};
    for (const auto& [value, name] : numbers) {
        std::array<GLdouble, 16> all{};
        glGetDoublev(value, all.data());
        state[name] = {all.begin(), all.end()};
    }
    for (const auto& [count, name, values] : indexed)
        for (GLuint i = 0; i < count; ++i)
            for (const GLenum value : values) {
                GLint is = 0;
                glGetIntegeri_v(value, i, &is);
                state[std::string(name) + ' ' + std::to_string(i)].push_back(is);
            }
    return state;
}

std::vector<std::string> changed(const GlState& before, const GlState& after) {
    std::vector<std::string> names;
    for (const auto& [name, value] : before)
        if (after.at(name) != value) names.push_back(name);
    return names;
}

HostileState::HostileState()
    : texture_({.format = GL_RGBA8, .size = {4, 4, 1}}, "hostile"),
      color_({.format = GL_RGBA16F, .size = {2, 2, 1}}, "hostile color"),
      buffer_(256, "hostile"),
      sampler_({.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR, .wrap = GL_REPEAT, .compare = true}, "hostile"),
      framebuffer_(std::array{gl::Attachment{color_, 0, -1}}, nullptr, "hostile"),
      vertices_("hostile"),
      program_(empty_program()) {}

void HostileState::set() const {
    for (const auto& [name, text] : switches) glEnable(name);
    for (const GLenum off : {GL_DITHER, GL_TEXTURE_CUBE_MAP_SEAMLESS}) glDisable(off);
    glBlendFuncSeparate(GL_ZERO, GL_DST_COLOR, GL_ZERO, GL_DST_ALPHA);
    glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MIN);
    glBlendColor(0.1F, 0.2F, 0.3F, 0.4F);
    glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glDepthRangef(0.3F, 0.6F);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_POINT);
    glPolygonOffset(3, 4);
    glViewport(1, 1, 1, 1);
    glScissor(0, 0, 1, 1);
    glStencilFunc(GL_NEVER, 1, 0xff);
    glStencilMask(0x0f);
    glSampleMaski(0, 0);
    glClearColor(5, 6, 7, 8);
    glClearDepth(0.125);
    glLineWidth(1);
    glLogicOp(GL_CLEAR);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glPrimitiveRestartIndex(0);
    glActiveTexture(GL_TEXTURE13);
    glUseProgram(program_);
    vertices_.bind();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    for (GLuint i = 0; i < 16; ++i) {
        glBindTextureUnit(i, 0);  // of all kinds
        glBindTextureUnit(i, texture_.id());
        glBindSampler(i, sampler_.id());
        glBindBufferBase(GL_UNIFORM_BUFFER, i, buffer_.id());
    }
    for (GLuint i = 0; i < 8; ++i) {
        glBindImageTexture(i, texture_.id(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA8);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer_.id());
    }
    for (const GLenum target : {GL_ARRAY_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER,
                                GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER})
        glBindBuffer(target, buffer_.id());
    for (const GLenum name : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                              GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_IMAGES, GL_PACK_ROW_LENGTH})
        glPixelStorei(name, 7);
    for (const GLenum name : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT}) glPixelStorei(name, 8);
}

}  // namespace tyndall::test
