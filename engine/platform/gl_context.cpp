#include "engine/platform/gl_context.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <utility>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gl/software_driver.h"
#include "engine/platform/backends.h"

namespace tyndall {
namespace {

constexpr std::pair<ContextKind, const char*> kind_names[] = {{ContextKind::automatic, "auto"},
                                                              {ContextKind::egl, "egl"},
                                                              {ContextKind::osmesa, "osmesa"},
                                                              {ContextKind::glfw, "glfw"}};
GlContext* current = nullptr;
DebugMessages messages;

void GLAPIENTRY on_debug_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei length, const GLchar* text,
                                 const void*) {
    if (severity != GL_DEBUG_SEVERITY_HIGH && severity != GL_DEBUG_SEVERITY_MEDIUM) return;
    ++messages.count;
    messages.last = length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length));
    spdlog::warn("OpenGL: {}", messages.last);
}

std::string gl_string(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

void load_functions(GlContext::Loader loader) {
    gladLoadGLUserPtr([](void* user, const char* name) { return (*static_cast<GlContext::Loader*>(user))(name); },
                      &loader);
}

bool is_core_4_5() {
    if (GLAD_GL_VERSION_4_5 == 0) return false;
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    return (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0;
}

Capabilities query_capabilities() {
    Capabilities c;
    c.vendor = gl_string(GL_VENDOR);
    c.renderer = gl_string(GL_RENDERER);
    c.version = gl_string(GL_VERSION);
    c.software = gl::is_software_driver(c.renderer);
    c.indirect_parameters = GLAD_GL_ARB_indirect_parameters != 0;
    if (GLAD_GL_EXT_texture_filter_anisotropic != 0) {
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &c.max_anisotropy);
    }
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &c.max_texture_size);
    return c;
}

std::unique_ptr<GlContext> create_headless_context(const ContextRequest& request) {
    try {
        return create_egl_context(request);
    } catch (const Error& e) {
        spdlog::warn("{}; trying OSMesa", e.what());
        return create_osmesa_context(request);
    }
}

}  // namespace

GlContext::~GlContext() {
    if (current == this) current = nullptr;
}

void GlContext::release() {
    if (current == this) unbind();
}

void GlContext::make_current() {
    if (current == this) return;
    if (current != nullptr) std::exchange(current, nullptr)->unbind();
    bind();
    current = this;
    load_functions(loader_);
}

void GlContext::initialise(Loader loader, bool debug) {
    loader_ = loader;
    make_current();
    if (!is_core_4_5()) {
        throw Error(fmt::format("{} context: OpenGL 4.5 core needed, driver {} gives {}", to_string(kind()),
                                gl_string(GL_RENDERER), gl_string(GL_VERSION)));
    }
    capabilities_ = query_capabilities();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (debug) {  // also enabled by hand: OSMesa takes no debug flag
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(on_debug_message, nullptr);
    }
}

std::unique_ptr<GlContext> create_context(const ContextRequest& request) {
    switch (request.kind) {
        case ContextKind::egl:
            return create_egl_context(request);
        case ContextKind::osmesa:
            return create_osmesa_context(request);
        case ContextKind::glfw:
            return create_glfw_context(request);
        case ContextKind::automatic:
            break;
    }
    return request.window ? create_glfw_context(request) : create_headless_context(request);
}

ContextKind parse_context_kind(const std::string& name) {
    for (const auto& [kind, text] : kind_names) {
        if (name == text) return kind;
    }
    throw UsageError(fmt::format("context \"{}\": auto, egl, osmesa or glfw expected", name));
}

const char* to_string(ContextKind kind) {
    return kind_names[static_cast<int>(kind)].second;
}

DebugMessages debug_messages() {
    return messages;
}

void reset_debug_messages() {
    messages = {};
}

}  // namespace tyndall
