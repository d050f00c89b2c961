#include <gtest/gtest.h>

#include "volumetrics/volumetrics.h"  // compiles alone

TEST(VolumetricsHeaders, Volumetrics) {
    EXPECT_FALSE(std::is_copy_constructible_v<tyndall::volumetrics::Volumetrics>);
}
