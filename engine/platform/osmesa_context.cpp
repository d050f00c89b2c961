#include <dlfcn.h>
#include <fmt/format.h>
#include <glad/gl.h>

#include <array>

#include "engine/core/error.h"
#include "engine/platform/backends.h"

namespace tyndall {
namespace {

/// libOSMesa, opened at run time so that it stays optional, and declared here because its header clashes with glad.
struct OsMesa {
    struct Context;
    Context* (*create)(const int* attributes, Context* share) = nullptr;
    void (*destroy)(Context*) = nullptr;
    GLboolean (*make_current)(Context*, void* buffer, GLenum type, GLsizei width, GLsizei height) = nullptr;
    GlContext::Loader get_proc_address = nullptr;

    // GL/osmesa.h
    static constexpr int format = 0x22, rgba = GL_RGBA, profile = 0x33, core_profile = 0x34, major_version = 0x36,
                         minor_version = 0x37;
};

/// The library stays open for the life of the process: its compiler threads do not survive a dlclose.
const OsMesa& library() {
    static const OsMesa functions = [] {
        void* handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
        if (handle == nullptr) throw Error(fmt::format("no OSMesa context: {}", dlerror()));
        OsMesa f;
        const auto load = [&](auto& function, const char* name) {
            function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(handle, name));
            if (function == nullptr) throw Error(fmt::format("no OSMesa context: {} is missing", name));
        };
        load(f.create, "OSMesaCreateContextAttribs");
        load(f.destroy, "OSMesaDestroyContext");
        load(f.make_current, "OSMesaMakeCurrent");
        load(f.get_proc_address, "OSMesaGetProcAddress");
        return f;
    }();
    return functions;
}

class OsMesaContext final : public GlContext {
  public:
    explicit OsMesaContext(const ContextRequest& request) : mesa_(library()), size_(request.size) {
        const int core_4_5[] = {OsMesa::format,
                                OsMesa::rgba,
                                OsMesa::profile,
                                OsMesa::core_profile,
                                OsMesa::major_version,
                                4,
                                OsMesa::minor_version,
                                5,
                                0};
        context_ = mesa_.create(core_4_5, nullptr);
        if (context_ == nullptr) {  // any version, so that `initialise` can say which one the driver has
            const int any[] = {OsMesa::format, OsMesa::rgba, 0};
            context_ = mesa_.create(any, nullptr);
        }
        if (context_ == nullptr) throw Error("no OSMesa context: OSMesaCreateContextAttribs failed");
    }
    ~OsMesaContext() override {
        release();
        mesa_.destroy(context_);
    }
    void open(bool debug) { initialise(mesa_.get_proc_address, debug); }

    [[nodiscard]] ContextKind kind() const override { return ContextKind::osmesa; }
    void present(unsigned, glm::ivec2) override { glFinish(); }
    void show_window(glm::ivec2 size) override { size_ = size; }
    [[nodiscard]] glm::ivec2 framebuffer_size() const override { return size_; }

  protected:
    void bind() override {
        if (mesa_.make_current(context_, default_framebuffer_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            throw Error("no OSMesa context: OSMesaMakeCurrent failed");
        }
    }
    void unbind() override { mesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  private:
    const OsMesa& mesa_;
    OsMesa::Context* context_ = nullptr;
    glm::ivec2 size_;
    std::array<GLubyte, 4> default_framebuffer_{};  ///< one pixel: OSMesa insists on having one
};

}  // namespace

std::unique_ptr<GlContext> create_osmesa_context(const ContextRequest& request) {
    auto context = std::make_unique<OsMesaContext>(request);
    context->open(request.debug);
    return context;
}

}  // namespace tyndall
