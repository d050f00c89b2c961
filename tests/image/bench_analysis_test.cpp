// The benchmark's arithmetic against numbers worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/analysis.h"
#include "bench/errors.h"
#include "engine/core/image_metrics.h"

namespace tyndall::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Points = std::vector<glm::dvec2>;

TEST(Median, OfOddAndEvenCountsAndTheirQuartiles) {
    const std::vector<double> odd{9, 1, 5};  // sorted 1 5 9: quartiles 3 and 7
    EXPECT_DOUBLE_EQ(median_spread(odd).median, 5);
    EXPECT_DOUBLE_EQ(median_spread(odd).spread, 4);
    EXPECT_DOUBLE_EQ(median_spread(odd).least, 1);
    const std::vector<double> even{4, 1, 3, 2};  // quartiles 1.75 and 3.25
    EXPECT_DOUBLE_EQ(median_spread(even).median, 2.5);
    EXPECT_DOUBLE_EQ(median_spread(even).spread, 1.5);
    const std::vector<double> one{7};
    EXPECT_DOUBLE_EQ(median_spread(one).median, 7);
    EXPECT_DOUBLE_EQ(median_spread(one).spread, 0);
}

TEST(Median, OneOutlierMovesNeitherMuch) {
    const std::vector<double> values{10, 11, 12, 13, 1e6};
    EXPECT_DOUBLE_EQ(median_spread(values).median, 12);
    EXPECT_DOUBLE_EQ(median_spread(values).spread, 2);
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBoth) {
    const Points points{{1, 9}, {2, 10}, {3, 4}, {3, 5}, {4, 4}, {8, 1}, {9, 1}, {2, 7}};
    EXPECT_THAT(pareto_front(points), ElementsAre(0, 7, 2, 5));
}

TEST(ParetoFront, OfEqualPointsTheFirstOnly) {
    const Points points{{2, 2}, {2, 2}, {2, 2}};
    EXPECT_THAT(pareto_front(points), ElementsAre(0));
}

TEST(ParetoFront, LeavesOutWhatIsNotFinite) {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    const Points points{{nan, 0}, {1, inf}, {0, nan}, {5, 5}};
    EXPECT_THAT(pareto_front(points), ElementsAre(3));
    EXPECT_THAT(pareto_front(Points{}), IsEmpty());
}

TEST(ParetoFront, EveryPointIsBeatenOrOnIt) {
    Points points;
    for (int i = 0; i < 200; ++i)  // Weyl sequences: scattered without a random generator
        points.emplace_back(std::fmod(i * 0.7548776662466927, 1.0), std::fmod(i * 0.5698402909980532, 1.0));
    const std::vector<std::size_t> front = pareto_front(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        bool beaten = false;
        for (const glm::dvec2 q : points) beaten |= q != points[i] && q.x <= points[i].x && q.y <= points[i].y;
        EXPECT_EQ(std::ranges::count(front, i), beaten ? 0 : 1) << i;
    }
}

TEST(PowerFit, FindsTheLawThatMadeThePoints) {
    Points points;
    for (const double x : {1.0, 3.0, 10.0, 70.0}) points.emplace_back(x, 2.5 * std::pow(x, -1.7));
    const PowerFit fit = fit_power(points);
    EXPECT_NEAR(fit.exponent, -1.7, 1e-12);
    EXPECT_NEAR(fit.factor, 2.5, 1e-12);
    EXPECT_NEAR(fit.deviation, 0, 1e-12);
    EXPECT_EQ(fit.first, 1);
    EXPECT_EQ(fit.last, 70);
    EXPECT_EQ(fit.points, 4u);
}

TEST(PowerFit, ScatterIsTheDistanceInLogarithms) {
    // Symmetric about y = x at each x by a factor e^0.1 up and down: the law is y = x, each point 0.1 from it.
    const double e = std::exp(0.1);
    const Points points{{1, e}, {1, 1 / e}, {8, 8 * e}, {8, 8 / e}};
    const PowerFit fit = fit_power(points);
    EXPECT_NEAR(fit.exponent, 1, 1e-12);
    EXPECT_NEAR(fit.deviation, 0.1, 1e-12);
}

TEST(PowerFit, IgnoresWhatHasNoLogarithmAndNeedsTwo) {
    const Points points{{0, 5}, {2, 0}, {-1, 3}, {2, std::nan("")}, {2, 8}, {4, 16}};
    EXPECT_NEAR(fit_power(points).exponent, 1, 1e-12);
    EXPECT_EQ(fit_power(points).points, 2u);
    EXPECT_EQ(fit_power(Points{{2, 3}}).points, 0u);
    EXPECT_EQ(fit_power(Points{{2, 3}, {2, 4}}).points, 0u);
}

TEST(FirstReach, InterpolatesInLogarithms) {
    const Points points{{8, 0.4}, {32, 0.1}, {128, 0.025}};  // y = 3.2 / x
    EXPECT_NEAR(first_reach(points, 0.2), 16, 1e-9);
    EXPECT_NEAR(first_reach(points, 0.05), 64, 1e-9);
    EXPECT_NEAR(first_reach(points, 0.1), 32, 1e-9);
    EXPECT_EQ(first_reach(points, 0.5), 8);
    EXPECT_TRUE(std::isnan(first_reach(points, 0.01)));
}

TEST(InterpolateLog, BetweenAndBeyond) {
    const Points points{{10, 1}, {1000, 100}};
    EXPECT_NEAR(interpolate_log(points, 100), 10, 1e-9);
    EXPECT_EQ(interpolate_log(points, 1), 1);
    EXPECT_EQ(interpolate_log(points, 1e9), 100);
}

TEST(GeometricMean, OfTwoIsTheRootOfTheirProduct) {
    const std::vector<double> values{2, 8};
    EXPECT_NEAR(geometric_mean(values), 4, 1e-12);
    const std::vector<double> with_zero{0, 8};
    EXPECT_EQ(geometric_mean(with_zero), 0);
}

TEST(SameSurface, LeavesOutWhatAnotherSurfaceOrTheSkyHides) {
    Image depth({4, 1}, 1), truth({4, 1}, 3);
    const float drawn[] = {10, 10, 0, 0}, expected[] = {10.05f, 12, 5, 0};
    for (int x = 0; x < 4; ++x) {
        depth.at(x, 0)[0] = drawn[x];
        for (int c = 0; c < 3; ++c) truth.at(x, 0)[c] = expected[x];
    }
    const std::vector<bool> same = same_surface(depth, truth);
    EXPECT_EQ(same, (std::vector<bool>{true, false, false, true}));
    const Image left = kept(truth, same);
    EXPECT_EQ(left.size, glm::ivec2(2, 1));
    EXPECT_EQ(left.at(0, 0)[2], 10.05f);
    EXPECT_EQ(left.at(1, 0)[0], 0);
}

TEST(DimError, LeavesTheBrightestOut) {
    Image truth({100, 1}, 3), other({100, 1}, 3);
    for (int x = 0; x < 100; ++x)
        for (int c = 0; c < 3; ++c) {
            truth.at(x, 0)[c] = x < 99 ? 1.0f : 1000.0f;
            other.at(x, 0)[c] = x < 99 ? 1.1f : 0.0f;
        }
    EXPECT_NEAR(dim_relative_rmse(other, truth, 0.98), 0.1, 1e-6);  // 99 pixels are 0.1 too bright
    EXPECT_NEAR(dim_relative_rmse(other, truth, 1.0), relative_rmse(other, truth), 1e-6);
    EXPECT_GT(relative_rmse(other, truth), 9);  // one pixel is all there is: 1000 / sqrt(100) over a mean of 11
}

}  // namespace
}  // namespace tyndall::bench
