#pragma once

#include <gtest/gtest.h>

#include "engine/platform/gl_context.h"

namespace tyndall {

/// A test in the process's shared EGL context, which is current while it runs. It fails if the driver reports a
/// debug message of medium or high severity.
class GlTest : public ::testing::Test {
  protected:
    GlTest();
    ~GlTest() override;  ///< after the members of derived fixtures have freed their GL objects
    [[nodiscard]] static GlContext& context();
};

}  // namespace tyndall
