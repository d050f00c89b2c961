#include <gtest/gtest.h>

#include "volumetrics/inputs.h"  // compiles alone

TEST(VolumetricsHeaders, Inputs) {
    EXPECT_FALSE(tyndall::volumetrics::Inputs{}.depth);
}
