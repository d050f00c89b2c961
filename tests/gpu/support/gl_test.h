#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "engine/core/files.h"
#include "engine/platform/gl_context.h"
#include "engine/scene/data_root.h"
#include "engine/shader/shader_library.h"

namespace tyndall {

/// A test in the process's shared EGL context, which is current while it runs. It fails if the driver reports a
/// debug message of medium or high severity.
class GlTest : public ::testing::Test {
  protected:
    GlTest();
    ~GlTest() override;  ///< after the members of derived fixtures have freed their GL objects
    [[nodiscard]] static GlContext& context();
};

/// The programs of folders that do not change, told apart by the first of them, compiled once for all tests of the
/// process: most of a test's time is the driver's compiler's.
[[nodiscard]] ShaderLibrary& shared_shaders(const Roots& roots = data_root());

}  // namespace tyndall
