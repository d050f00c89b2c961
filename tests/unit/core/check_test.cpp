#include "engine/core/check.h"

#include <gtest/gtest.h>

namespace {

TEST(CheckDeathTest, PrintsBothValues) {
    EXPECT_DEATH(TYNDALL_CHECK_EQ(1 + 1, 3), "check failed: 1 \\+ 1 == 3 \\(2 vs 3\\)");
    EXPECT_DEATH(TYNDALL_CHECK_LT(5, 4), "5 vs 4");
    EXPECT_DEATH(TYNDALL_CHECK(1 > 2), "check failed: 1 > 2");
}

TEST(Check, EvaluatesOnce) {
    int calls = 0;
    TYNDALL_CHECK_LE(++calls, 1);
    EXPECT_EQ(calls, 1);
}

}  // namespace
