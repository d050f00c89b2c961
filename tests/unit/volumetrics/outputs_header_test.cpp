#include <gtest/gtest.h>

#include "volumetrics/outputs.h"  // compiles alone

TEST(VolumetricsHeaders, Outputs) {
    EXPECT_FALSE(tyndall::volumetrics::Outputs{}.scattering);
}
