#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>
#include <glad/gl.h>

#include <array>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/platform/backends.h"

namespace tyndall {
namespace {

template <class Function>
Function load(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

bool has(const char* extensions, std::string_view name) {
    return extensions != nullptr &&
           (' ' + std::string(extensions) + ' ').find(fmt::format(" {} ", name)) != std::string::npos;
}

struct Platform {
    EGLenum kind;
    void* native;
    const char* name;
};

/// Where a headless context may come from, best first: the devices of real GPUs, Mesa's surfaceless platform (which
/// has software rendering on every machine), software devices.
std::vector<Platform> platforms() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Platform> hardware;
    std::vector<Platform> software;
    if (has(extensions, "EGL_MESA_platform_surfaceless")) {
        software.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless"});
    }
    if (has(extensions, "EGL_EXT_platform_device") && has(extensions, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT")(EGLint(devices.size()), devices.data(), &count);
        const auto query_device = load<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
        for (int i = 0; i < count; ++i) {
            const bool is_software = has(query_device(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
            (is_software ? software : hardware).push_back({EGL_PLATFORM_DEVICE_EXT, devices[i], "device"});
        }
    }
    hardware.insert(hardware.end(), software.begin(), software.end());
    return hardware;
}

/// A context without a surface. The display it lives on is shared by all contexts of the process and stays open.
class EglContext final : public GlContext {
  public:
    EglContext(const Platform& platform, const ContextRequest& request) : size_(request.size) {
        display_ = eglGetPlatformDisplay(platform.kind, platform.native, nullptr);
        require(display_ != EGL_NO_DISPLAY && eglInitialize(display_, nullptr, nullptr), "open the display");
        const char* extensions = eglQueryString(display_, EGL_EXTENSIONS);
        for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"}) {
            if (!has(extensions, needed)) throw Error(fmt::format("{} is missing", needed));
        }
        require(eglBindAPI(EGL_OPENGL_API), "choose OpenGL");
        const EGLint core_4_5[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   4,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   5,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_CONTEXT_OPENGL_DEBUG,
                                   request.debug ? EGL_TRUE : EGL_FALSE,
                                   EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, core_4_5);
        if (context_ == EGL_NO_CONTEXT) {  // any version, so that `initialise` can say which one the driver has
            context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
        }
        require(context_ != EGL_NO_CONTEXT, "create a context");
    }
    ~EglContext() override {
        release();
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    }
    void open(bool debug) { initialise(eglGetProcAddress, debug); }

    [[nodiscard]] ContextKind kind() const override { return ContextKind::egl; }
    void present(unsigned, glm::ivec2) override { glFinish(); }
    void show_window(glm::ivec2 size) override { size_ = size; }
    [[nodiscard]] glm::ivec2 framebuffer_size() const override { return size_; }

  protected:
    void bind() override {
        eglBindAPI(EGL_OPENGL_API);
        require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_), "make the context current");
    }
    void unbind() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  private:
    static void require(bool done, const char* action) {
        if (!done) throw Error(fmt::format("cannot {} (EGL error {:#x})", action, eglGetError()));
    }
    glm::ivec2 size_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<GlContext> create_egl_context(const ContextRequest& request) {
    std::string reasons;
    for (const Platform& platform : platforms()) {
        try {
            auto context = std::make_unique<EglContext>(platform, request);
            context->open(request.debug);
            return context;
        } catch (const Error& e) {
            spdlog::debug("EGL {} platform: {}", platform.name, e.what());
            reasons += fmt::format("{}{} platform: {}", reasons.empty() ? "" : "; ", platform.name, e.what());
        }
    }
    throw Error(fmt::format("no EGL context: {}", reasons.empty() ? "no surfaceless or device platform" : reasons));
}

}  // namespace tyndall
