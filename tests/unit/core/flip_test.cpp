#include "engine/core/flip.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "engine/core/error.h"
#include "engine/core/image_metrics.h"

namespace tyndall {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

// FLIP as the papers state it, in double precision, with plain 2D filters: slow, and written apart from the
// engine's.

double decoded(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double encoded(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// Linear sRGB to XYZ: chromaticities (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) of the primaries; their amounts sum
/// to a white at (0.31271, 0.32902). Columns are primaries.
glm::dmat3 xyz_of_rgb() {
    const auto xyz = [](double x, double y) { return glm::dvec3(x / y, 1, (1 - x - y) / y); };
    const glm::dmat3 primaries(xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06));
    const glm::dvec3 amounts = glm::inverse(primaries) * xyz(0.31271, 0.32902);
    return {primaries[0] * amounts.x, primaries[1] * amounts.y, primaries[2] * amounts.z};
}

glm::dvec3 relative(glm::dvec3 linear) {
    return xyz_of_rgb() * linear / (xyz_of_rgb() * glm::dvec3(1));
}

glm::dvec3 hunt_lab(glm::dvec3 linear) {
    const glm::dvec3 t = relative(linear);
    glm::dvec3 f;
    for (int i = 0; i < 3; ++i)
        f[i] = t[i] > std::pow(6.0 / 29, 3) ? std::cbrt(t[i]) : (841.0 / 108) * t[i] + 4.0 / 29;
    const double lightness = 116 * f.y - 16;
    return {lightness, lightness / 100 * 500 * (f.x - f.y), lightness / 100 * 200 * (f.y - f.z)};
}

double hyab(glm::dvec3 a, glm::dvec3 b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// Error of two uniform linear colours: no filter changes them, and they have no features.
double color_error(glm::dvec3 a, glm::dvec3 b) {
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    const double e = std::pow(hyab(hunt_lab(a), hunt_lab(b)), 0.7);
    const double knee = 0.4 * largest;
    return e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (largest - knee);
}

using Plane = std::function<double(int x, int y)>;  ///< any x, y
using Weight = std::function<double(double x, double y)>;

double filtered(const Plane& plane, int x, int y, int radius, const Weight& weight, bool balanced) {
    double sum = 0, positive = 0, negative = 0;
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) (weight(i, j) > 0 ? positive : negative) += weight(i, j);
    for (int j = -radius; j <= radius; ++j)
        for (int i = -radius; i <= radius; ++i) {
            const double w = weight(i, j);
            const double norm = !balanced ? positive + negative : w > 0 ? positive : -negative;
            if (w != 0) sum += w / norm * plane(x + i, y + j);
        }
    return sum;
}

struct Slow {
    double ppd;
    const Image& image;

    [[nodiscard]] glm::dvec3 ycxcz(int x, int y) const {
        const float* p = image.at(std::clamp(x, 0, image.size.x - 1), std::clamp(y, 0, image.size.y - 1));
        const glm::dvec3 r = relative({decoded(p[0]), decoded(p[1]), decoded(p[2])});
        return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
    }
    [[nodiscard]] double sensed(int channel, int x, int y) const {
        const double terms[3][4] = {{1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
        const auto weight = [&](double i, double j) {
            const double d2 = (i * i + j * j) / (ppd * ppd);
            const double* t = terms[channel];
            return t[0] * std::sqrt(pi / t[1]) * std::exp(-pi * pi * d2 / t[1]) +
                   t[2] * std::sqrt(pi / t[3]) * std::exp(-pi * pi * d2 / t[3]);
        };
        return filtered([&](int u, int v) { return ycxcz(u, v)[channel]; }, x, y, radius, weight, false);
    }
    [[nodiscard]] glm::dvec3 color(int x, int y) const {
        const double luma = (sensed(0, x, y) + 16) / 116;
        const glm::dvec3 r(luma + sensed(1, x, y) / 500, luma, luma - sensed(2, x, y) / 200);
        const glm::dvec3 linear = glm::inverse(xyz_of_rgb()) * (r * (xyz_of_rgb() * glm::dvec3(1)));
        return hunt_lab(glm::clamp(linear, 0.0, 1.0));
    }
    [[nodiscard]] double feature(bool point, int x, int y) const {
        const double sigma = 0.5 * 0.082 * ppd;
        const auto along = [&](double a, double b) {
            const double g = std::exp(-(a * a + b * b) / (2 * sigma * sigma));
            return point ? (a * a / (sigma * sigma) - 1) * g : -a * g;
        };
        const auto luma = [&](int u, int v) { return (ycxcz(u, v).x + 16) / 116; };
        const int radius = static_cast<int>(std::ceil(3 * sigma));
        const double h = filtered(luma, x, y, radius, along, true);
        const double v = filtered(
            luma, x, y, radius, [&](double i, double j) { return along(j, i); }, true);
        return std::hypot(h, v);
    }
};

double slow_flip(const Image& a, const Image& b, double ppd, int x, int y) {
    const Slow s{ppd, a}, t{ppd, b};
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    const double e = std::pow(hyab(s.color(x, y), t.color(x, y)), 0.7);
    const double knee = 0.4 * largest;
    const double color = e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (largest - knee);
    const double feature = std::max(std::abs(s.feature(false, x, y) - t.feature(false, x, y)),
                                    std::abs(s.feature(true, x, y) - t.feature(true, x, y)));
    return std::pow(color, 1 - std::sqrt(feature / std::numbers::sqrt2));
}

Image uniform(glm::vec3 color, glm::ivec2 size = {30, 25}) {
    Image image(size, 3);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = color[c];
    return image;
}

/// Blocks, lines and points, and noise over them.
Image busy(unsigned seed, glm::ivec2 size) {
    Image image(size, 3);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0, 1);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            for (int c = 0; c < 3; ++c)
                image.at(x, y)[c] =
                    0.4f * any(random) + (x > size.x / 2 ? 0.5f : 0.0f) + (y == 5 && c < 2 ? 0.1f : 0.0f);
    return image;
}

void expect_uniform(const Image& error, double expected) {
    ASSERT_EQ(error.channels, 1);
    for (const float v : error.pixels) ASSERT_NEAR(v, expected, 5e-5);  // single precision
}

TEST(Flip, BlackAgainstWhiteByHand) {
    // HyAB 100: 100^0.7 = 25.1189. The largest is green against blue. L*a*b* of green 87.737 -86.183 83.186, with
    // Hunt 87.737 -75.615 72.985; of blue 32.299 79.191 -107.856, with Hunt 32.299 25.578 -34.836: HyAB 55.438 +
    // hypot(101.193, 107.821) = 203.309, to the power of 0.7 41.287. The knee is at 16.515:
    // 0.95 + 0.05 (25.1189 - 16.515) / (41.287 - 16.515) = 0.96737.
    const Image error = flip_error(uniform({0, 0, 0}), uniform({1, 1, 1}));
    expect_uniform(error, color_error({0, 0, 0}, {1, 1, 1}));
    EXPECT_NEAR(error.pixels[0], 0.96737, 1e-4);
}

TEST(Flip, GreenAgainstBlueIsTheLargestError) {
    expect_uniform(flip_error(uniform({0, 1, 0}), uniform({0, 0, 1})), 1.0);
}

TEST(Flip, UniformPicturesGiveTheColorError) {
    const glm::vec3 pairs[][2] = {
        {{0.5f, 0.5f, 0.5f}, {0.52f, 0.5f, 0.5f}}, {{1, 0, 0}, {0, 0, 1}}, {{0.2f, 0.4f, 0.6f}, {0.6f, 0.4f, 0.2f}},
        {{0, 0, 0}, {0.02f, 0.02f, 0.02f}},        {{1, 1, 0}, {1, 1, 1}}, {{0.03f, 0, 0.01f}, {0, 0.04f, 0}}};
    for (const auto& pair : pairs) {
        glm::dvec3 linear[2];
        for (int i = 0; i < 2; ++i)
            for (int c = 0; c < 3; ++c) linear[i][c] = decoded(pair[i][c]);
        const Image error = flip_error(uniform(pair[0]), uniform(pair[1]));
        expect_uniform(error, color_error(linear[0], linear[1]));
        EXPECT_EQ(error.pixels, flip_error(uniform(pair[1]), uniform(pair[0])).pixels) << "symmetric";
    }
}

TEST(Flip, IsThePapersFormulaPixelByPixel) {
    const Image a = busy(1, {27, 22}), b = busy(2, {27, 22});
    for (const double ppd : {flip_pixels_per_degree, 25.0}) {
        const Image error = flip_error(a, b, ppd);
        for (int y = 0; y < a.size.y; y += 3)
            for (int x = 0; x < a.size.x; x += 2)
                EXPECT_NEAR(error.at(x, y)[0], slow_flip(a, b, ppd, x, y), 1e-4) << ppd << ": " << x << ' ' << y;
    }
}

TEST(Flip, StripsAndThreadsLeaveNoSeam) {  // rows are worked on 64 at a time
    const Image a = busy(3, {9, 150}), b = busy(4, {9, 150});
    const Image error = flip_error(a, b);
    for (const int y : {0, 54, 63, 64, 70, 127, 128, 149})
        EXPECT_NEAR(error.at(4, y)[0], slow_flip(a, b, flip_pixels_per_degree, 4, y), 1e-4) << y;
}

TEST(Flip, OnePixelIsSeenAroundIt) {
    const Image grey = uniform({0.5f, 0.5f, 0.5f}, {41, 41});
    Image dot = grey;
    for (int c = 0; c < 3; ++c) dot.at(20, 20)[c] = 1;
    const Image error = flip_error(dot, grey);
    EXPECT_NEAR(error.at(20, 20)[0], slow_flip(dot, grey, flip_pixels_per_degree, 20, 20), 1e-4);
    EXPECT_EQ(error.at(9, 20)[0], 0);  // the widest filter reaches 10 pixels
    EXPECT_EQ(error.at(20, 31)[0], 0);
    EXPECT_GT(error.at(20, 20)[0], error.at(22, 20)[0]);
    EXPECT_GT(error.at(22, 20)[0], 0);
    EXPECT_NEAR(error.at(17, 20)[0], error.at(20, 23)[0], 1e-6);
    EXPECT_LT(flip_error(dot, grey, 200).at(20, 20)[0], error.at(20, 20)[0]) << "from farther away less is seen";
}

TEST(Flip, EqualPicturesHaveNoError) {
    const Image a = busy(5, {20, 20});
    expect_uniform(flip_error(a, a), 0);
    expect_uniform(hdr_flip_error(a, a), 0);
    expect_uniform(flip_error(uniform({0.1f, 0.2f, 0.3f}, {1, 1}), uniform({0.1f, 0.2f, 0.3f}, {1, 1})), 0);
    expect_uniform(flip_error(uniform({-3, 7, 0.5f}), uniform({0, 1, 0.5f})), 0);  // clamped
}

TEST(Flip, BadInputIsNamed) {
    const Image a = uniform({0, 0, 0});
    EXPECT_THAT([&] { (void)flip_error(a, uniform({0, 0, 0}, {3, 4})); }, ThrowsMessage<Error>(HasSubstr("3 x 4")));
    EXPECT_THROW((void)flip_error(Image({2, 2}, 1), Image({2, 2}, 1)), Error);
    EXPECT_THROW((void)hdr_flip_error(Image(), Image()), Error);
    for (const double ppd : {0.0, -1.0, 1e9, std::nan("")}) EXPECT_THROW((void)flip_error(a, a, ppd), Error) << ppd;
    Image bad = a;
    bad.at(7, 3)[1] = std::numeric_limits<float>::infinity();
    EXPECT_THAT([&] { (void)flip_error(bad, a); }, ThrowsMessage<Error>(HasSubstr("(7, 3)")));
    EXPECT_THAT([&] { (void)hdr_flip_error(a, bad); }, ThrowsMessage<Error>(HasSubstr("(7, 3)")));
}

TEST(Flip, HeatmapIsBlackToPaleAndEverBrighter) {
    Image error({101, 1}, 1);
    for (int x = 0; x <= 100; ++x) error.at(x, 0)[0] = static_cast<float>(x) / 100;
    const Image map = flip_heatmap(error);
    double before = -1;
    for (int x = 0; x <= 100; ++x) {
        const float* p = map.at(x, 0);
        const double lightness = hunt_lab({decoded(p[0]), decoded(p[1]), decoded(p[2])}).x;
        EXPECT_GT(lightness, before) << x;
        before = lightness;
    }
    EXPECT_LT(map.at(0, 0)[2], 0.05f);
    EXPECT_GT(map.at(100, 0)[0], 0.95f);
}

/// Narkowicz 2015, with the 0.6 that takes its exposure back.
double aces(double x) {
    x *= 0.6;
    return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}

TEST(HdrFlip, ExposuresBringTheBrightestAndTheMedianTo85Percent) {
    // Luminances 0.125, 0.25, 0.25, 1, 8: 0.25 is 5 stops under 8.
    Image image({5, 1}, 3);
    const float values[] = {1, 0.25f, 8, 0.125f, 0.25f};
    for (int x = 0; x < 5; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, 0)[c] = values[x];
    FlipExposures e = flip_exposures(image);
    EXPECT_NEAR(aces(8 * std::exp2(e.start)), 0.85, 1e-6);
    EXPECT_NEAR(aces(0.25 * std::exp2(e.stop)), 0.85, 1e-6);
    EXPECT_NEAR(e.stop - e.start, 5, 1e-5);
    // Of an even count the median is the mean of the middle two: (0.25 + 1) / 2.
    Image even = uniform({1, 1, 1}, {6, 1});
    std::copy(image.pixels.begin(), image.pixels.end(), even.pixels.begin());
    EXPECT_NEAR(aces(0.625 * std::exp2(flip_exposures(even).stop)), 0.85, 1e-6);
}

TEST(HdrFlip, CountIsTheStopsRoundedUp) {
    Image image = uniform({1, 1, 1}, {3, 1});
    const auto count = [&](float brightest) {
        for (int c = 0; c < 3; ++c) image.at(1, 0)[c] = brightest;
        return flip_exposures(image).count;
    };
    EXPECT_EQ(count(1), 2);
    EXPECT_EQ(count(3.9f), 2);
    EXPECT_EQ(count(4.1f), 3);
    EXPECT_EQ(count(1000), 10);  // log2 1000 = 9.966
}

TEST(HdrFlip, BlackDoesNotCountWhereItIsTheMedian) {
    EXPECT_EQ(flip_exposures(uniform({0, 0, 0})).start, 0);
    EXPECT_EQ(flip_exposures(uniform({0, 0, 0})).stop, 0);
    EXPECT_EQ(flip_exposures(uniform({0, 0, 0})).count, 2);
    Image image({7, 1}, 3);
    for (int c = 0; c < 3; ++c) {
        image.at(2, 0)[c] = 4;
        image.at(5, 0)[c] = 1;
        image.at(6, 0)[c] = 2;
    }
    EXPECT_NEAR(aces(2 * std::exp2(flip_exposures(image).stop)), 0.85, 1e-6);
    for (const float v : hdr_flip_error(image, uniform({1, 1, 1}, {7, 1})).pixels) EXPECT_TRUE(v >= 0 && v <= 1);
}

TEST(HdrFlip, UniformPicturesGiveTheColorErrorOfOneExposure) {
    // The reference is shown at 0.85; half of it at aces(x / 2) where aces(x) = 0.85.
    const double x = std::exp2(flip_exposures(uniform({1, 1, 1})).start);
    const glm::dvec3 reference(0.85), test(aces(0.5 * x));
    expect_uniform(hdr_flip_error(uniform({0.5f, 0.5f, 0.5f}), uniform({1, 1, 1})), color_error(test, reference));
}

Image radiance(unsigned seed) {
    Image image = busy(seed, {24, 20});
    for (float& v : image.pixels) v = std::exp2(9 * v - 5);
    return image;
}

TEST(HdrFlip, IsTheLargestErrorOfItsExposures) {
    const Image a = radiance(6), b = radiance(7);
    const Image error = hdr_flip_error(a, b);
    const FlipExposures e = flip_exposures(b);
    ASSERT_GT(e.count, 2);
    Image largest(a.size, 1);
    for (int i = 0; i < e.count; ++i) {
        const double scale = std::exp2(e.start + (e.stop - e.start) * i / (e.count - 1));
        Image shown[2] = {a, b};
        for (Image& image : shown)
            for (float& v : image.pixels) v = static_cast<float>(encoded(aces(v * scale)));
        const Image one = flip_error(shown[0], shown[1]);
        for (std::size_t p = 0; p < one.pixels.size(); ++p)
            largest.pixels[p] = std::max(largest.pixels[p], one.pixels[p]);
    }
    for (std::size_t p = 0; p < largest.pixels.size(); ++p)
        EXPECT_NEAR(error.pixels[p], largest.pixels[p], 5e-5) << p;
}

TEST(HdrFlip, DoesNotDependOnTheUnitOfRadiance) {
    const Image a = radiance(8), b = radiance(9);
    const Image error = hdr_flip_error(a, b);
    for (const float scale : {1.0f / 4096, 1e-3f, 1e4f}) {
        Image a2 = a, b2 = b;
        for (float& v : a2.pixels) v *= scale;
        for (float& v : b2.pixels) v *= scale;
        const Image scaled = hdr_flip_error(a2, b2);
        for (std::size_t p = 0; p < error.pixels.size(); ++p) EXPECT_NEAR(scaled.pixels[p], error.pixels[p], 1e-4);
    }
}

}  // namespace
}  // namespace tyndall
