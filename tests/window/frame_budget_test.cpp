// Dynamic resolution against frames whose time is a + b pixels. No display needed.

#include "sample_game/frame_budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tyndall {
namespace {

constexpr double budget = 100;
constexpr float least = 0.25f;

/// Walks through frames that take `fixed` ms and `whole` ms more at scale 1, 5% more or less at random.
class Frames {
  public:
    Frames(double fixed, double whole, float scale) : fixed_(fixed), whole_(whole), scale_(scale) {}
    void set_cost(double fixed, double whole) {
        fixed_ = fixed;
        whole_ = whole;
    }
    void frames(int count) {
        changes_ = 0;
        for (int i = 0; i < count; ++i) {
            std::uniform_real_distribution<double> jitter(0.95, 1.05);
            double ms = time() * jitter(random_);
            if (i % 37 == 5) ms += 2000;  // compiles a shader
            const float next = budget_.next(scale_, ms);
            changes_ += next != scale_;
            scale_ = next;
        }
    }
    [[nodiscard]] double time() const { return fixed_ + whole_ * scale_ * scale_; }
    [[nodiscard]] float scale() const { return scale_; }
    [[nodiscard]] int changes() const { return changes_; }

  private:
    double fixed_, whole_;
    float scale_;
    int changes_ = 0;
    FrameBudget budget_{budget, least, 1};
    std::mt19937 random_{1};
};

TEST(FrameBudget, IsHeldAndUsedWhateverFramesCost) {
    for (const double fixed : {0.0, 20.0, 60.0})
        for (const double whole : {150.0, 400.0, 1000.0, 3000.0})
            for (const float start : {least, 0.4f, 1.0f}) {
                Frames walk(fixed, whole, start);
                if (fixed + whole * least * least > 0.95 * budget) continue;  // not to be had
                walk.frames(150);
                EXPECT_LE(walk.time(), 1.1 * budget) << fixed << ' ' << whole << ' ' << start;
                EXPECT_GE(walk.time(), 0.74 * budget) << fixed << ' ' << whole << ' ' << start;
            }
}

// Whoever stands still sees no change.
TEST(FrameBudget, ComesToRest) {
    for (const double fixed : {0.0, 40.0})
        for (const double whole : {150.0, 700.0}) {
            Frames walk(fixed, whole, 0.5f);
            walk.frames(200);
            walk.frames(300);
            EXPECT_LE(walk.changes(), 3) << fixed << ' ' << whole;
        }
}

TEST(FrameBudget, FollowsWhatBecomesDearOrCheap) {
    Frames walk(20, 300, 0.5f);
    walk.frames(100);
    const float before = walk.scale();
    walk.set_cost(40, 900);
    walk.frames(40);
    EXPECT_LT(walk.scale(), before);
    EXPECT_LE(walk.time(), 1.1 * budget);
    walk.set_cost(20, 300);
    walk.frames(200);
    EXPECT_NEAR(walk.scale(), before, 0.15f * before);
}

TEST(FrameBudget, EndsAtTheLeastAndAtTheWholePicture) {
    Frames dear(500, 1000, 1);
    dear.frames(100);
    EXPECT_EQ(dear.scale(), least);
    Frames cheap(1, 10, 0.3f);
    cheap.frames(300);
    EXPECT_EQ(cheap.scale(), 1);
}

}  // namespace
}  // namespace tyndall
