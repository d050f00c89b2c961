// The setting temporal over still pictures: its closed forms, its rounding, and what it keeps.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/gpu/support/temporal_fixture.h"

namespace tyndall::test {
namespace {

constexpr Temporal modes[] = {Temporal::blend, Temporal::ema, Temporal::acceptance, Temporal::accumulate};

/// Fills all textures of the history.
int fill_history(float value) {
    int found = 0;
    for (GLuint id = 1; id < 10'000; ++id) {
        if (glIsTexture(id) == GL_FALSE) continue;
        char label[256] = "";
        glGetObjectLabel(GL_TEXTURE, id, sizeof label, nullptr, label);
        if (std::string(label).find("temporal") == std::string::npos) continue;
        const float texel[4] = {value, value, value, value};
        glClearTexImage(id, 0, GL_RGBA, GL_FLOAT, texel);
        ++found;
    }
    return found;
}

/// Largest error relative to the mean.
void expect_near(const Image& image, const Image& expected, double tolerance) {
    ASSERT_EQ(image.size, expected.size);
    const double allowed = tolerance * mean_of(expected);
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            ASSERT_NEAR(image.at(x, y)[0], expected.at(x, y)[0], allowed) << x << ' ' << y;
}

TEST_F(VolumetricsTemporal, MeanOfAConstantIsTheConstant) {
    const Image expected = draw(without(settings(Temporal::ema))).scattering;
    for (const Temporal mode : modes) expect_near(after(40, settings(mode, 0.01F)).scattering, expected, 0);
}

// All but the first of the means of accumulate are another test's.
TEST_F(VolumetricsTemporal, ExponentialMeanFollowsAStep) {
    for (const Temporal mode : {Temporal::blend, Temporal::ema, Temporal::acceptance}) {
        const Settings s = settings(mode, 0.1F);
        host.ambient = glm::vec3(1);
        const double from = mean_of(after(2, s).scattering);
        host.ambient = glm::vec3(2);
        for (int k = 1; k <= 12; ++k) {
            const double share = 1 - std::pow(0.9, k);
            EXPECT_NEAR(mean_of(draw(s).scattering), from * (1 + share), 1e-3 * from) << k;
        }
        draw(without(s));
    }
}

TEST_F(VolumetricsTemporal, AccumulateIsTheArithmeticMeanOfItsFirstFrames) {
    Settings s = settings(Temporal::accumulate);
    s.temporal.frames = 8;
    const double one = mean_of(draw(without(s)).scattering);
    double sum = 0, kept = 0;
    for (int k = 1; k <= 20; ++k) {
        const double input = k % 3 == 0 ? 3 : k % 2;
        host.ambient = glm::vec3(static_cast<float>(input));
        sum += input;
        kept = k <= 8 ? sum / k : kept + (input - kept) / 8;
        EXPECT_NEAR(mean_of(draw(s).scattering), kept * one, 1.5e-3 * one) << k;
    }
}

// The change of 5% times the weight is less than half a step of a half float long before the end.
TEST_F(VolumetricsTemporal, HalfFloatsDoNotLockUp) {
    const Settings s = settings(Temporal::ema, 0.05F);
    for (const float light : {1.0F, 3.7e-4F, 5000.0F}) {
        host.ambient = glm::vec3(light);
        after(2, s);
        host.ambient = glm::vec3(1.05F * light);
        const Image expected = draw(without(settings(Temporal::off))).scattering;
        host.ambient = glm::vec3(light);
        after(2, s);
        host.ambient = glm::vec3(1.05F * light);
        const Image image = after(160, s).scattering;
        EXPECT_NEAR(mean_of(image), mean_of(expected), 0.0005 * mean_of(expected)) << light;
        expect_near(image, expected, 0.002);
    }
}

// Rounding that truncates loses half a step a frame: at this weight 50 steps, 2.4 to 5%.
TEST_F(VolumetricsTemporal, ExponentialMeanDoesNotDrift) {
    const Settings s = settings(Temporal::ema, 0.01F);
    host.ambient = glm::vec3(1);
    const double one = mean_of(draw(without(s)).scattering);
    double kept = 0;
    for (int k = 0; k < 300; ++k) {
        const double input = 1 + 0.3 * std::sin(1.7 * k);
        host.ambient = glm::vec3(static_cast<float>(input));
        kept = k == 0 ? input : kept + 0.01 * (input - kept);
        const Image image = draw(s).scattering;
        EXPECT_NEAR(mean_of(image), kept * one, 2e-3 * one) << k;
    }
}

TEST_F(VolumetricsTemporal, OffHoldsNothing) {
    using ::testing::Contains;
    host.global[0].sigma_a = {0.01F, 0.02F, 0.04F};
    const Frame off = host.render(without(settings(Temporal::ema)));
    EXPECT_EQ(off.skipped.at("volumetrics/temporal"), "temporal is off");
    const Frame on = host.render(settings(Temporal::ema));
    EXPECT_THAT(on.live_passes, Contains("volumetrics/temporal"));
    EXPECT_EQ(on.persistent_bytes - off.persistent_bytes, std::size_t{2 * (8 + 8 + 8) * 16 * 8});
    EXPECT_EQ(host.render(without(settings(Temporal::ema))).persistent_bytes, off.persistent_bytes);
}

TEST_F(VolumetricsTemporal, ColouredTransmittanceIsKept) {
    host.global[0].sigma_a = {0.01F, 0.02F, 0.04F};
    const Settings s = settings(Temporal::blend, 0.25F);
    const Image from = host.render(s).transmittance;
    host.view_depth = [](int, int) { return 40.0F; };
    const Image to = host.render(without(s)).transmittance;
    host.view_depth = [](int, int) { return 10.0F; };
    (void)host.render(s);
    host.view_depth = [](int, int) { return 40.0F; };
    const Image now = host.render(s).transmittance;
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(now.at(3, 3)[c], 0.75F * from.at(3, 3)[c] + 0.25F * to.at(3, 3)[c], 1e-3) << c;
}

TEST_F(VolumetricsTemporal, AcceptanceIsGivenWhereItIsAskedFor) {
    const Settings s = settings(Temporal::acceptance);
    Picture of[2][2];  // asked, coloured
    for (const bool asked : {false, true})
        for (const bool coloured : {false, true}) {
            asks_acceptance = asked;
            host.global[0].sigma_a = {0.01F, 0.01F, coloured ? 0.04F : 0.01F};
            host.view_depth = [](int, int) { return 10.0F; };
            draw(s);
            host.view_depth = [](int x, int) { return 10.0F + static_cast<float>(x); };
            of[asked][coloured] = draw(s);
            draw(without(s));
        }
    for (const bool coloured : {false, true}) {
        EXPECT_TRUE(of[false][coloured].acceptance.pixels.empty());
        EXPECT_EQ(of[false][coloured].scattering.pixels, of[true][coloured].scattering.pixels);
        EXPECT_EQ(of[true][coloured].acceptance.pixels, of[true][false].acceptance.pixels);
    }
    EXPECT_EQ(of[true][false].acceptance.size, host.size);
}

TEST_F(VolumetricsTemporal, NotANumberIsGoneAfterOneFrame) {
    add_sun_behind_fence();
    for (const bool on : {false, true})
        for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity(), 1e30F}) {
            Settings s = settings(Temporal::accumulate);
            s.temporal.clip = s.temporal.reject = on;
            after(3, s);
            const Image expected = draw(without(s)).scattering;
            after(3, s);
            ASSERT_EQ(fill_history(value), 4);
            const Picture picture = draw(s);
            expect_near(picture.scattering, expected, 2e-3);
            EXPECT_EQ(mean_of(picture.acceptance), 0);
            EXPECT_EQ(accepted(s), 1);
        }
}

}  // namespace
}  // namespace tyndall::test
