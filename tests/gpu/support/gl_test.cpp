#include "tests/gpu/support/gl_test.h"

#include <glad/gl.h>

#include <map>
#include <memory>

namespace tyndall {
namespace {

std::unique_ptr<GlContext> shared_context;
std::map<std::filesystem::path, ShaderLibrary> libraries;

/// Frees the context before the driver's own exit handlers run.
class FreeContext : public ::testing::Environment {
  public:
    void TearDown() override {
        if (!libraries.empty()) shared_context->make_current();
        libraries.clear();
        shared_context.reset();
    }
};
[[maybe_unused]] ::testing::Environment* const environment = ::testing::AddGlobalTestEnvironment(new FreeContext);

}  // namespace

GlContext& GlTest::context() {
    if (!shared_context) shared_context = create_context({.kind = ContextKind::egl});
    return *shared_context;
}

GlTest::GlTest() {
    context().make_current();
    reset_debug_messages();
}

GlTest::~GlTest() {
    context().make_current();
    glFinish();
    EXPECT_EQ(debug_messages().count, 0) << debug_messages().last;
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

ShaderLibrary& shared_shaders(const Roots& roots) {
    return libraries.try_emplace(roots.first(""), roots).first->second;
}

}  // namespace tyndall
