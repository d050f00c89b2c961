// The setting temporal: its closed forms, where it looks for what was, and what it must forget.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "engine/core/image_metrics.h"
#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

using volumetrics::Temporal;
using volumetrics::TemporalPlace;

constexpr Temporal modes[] = {Temporal::blend, Temporal::ema, Temporal::acceptance, Temporal::accumulate};

class VolumetricsTemporal : public GlTest {
  protected:
    struct Picture {
        Image scattering, acceptance;
    };
    StubHost host, other;
    float turn = 0;      ///< of the camera about +Y, rad
    gl::Texture motion;  ///< of every pixel, see Inputs::motion

    VolumetricsTemporal() {
        host.size = {16, 8};
        host.ambient = glm::vec3(1);
        host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.3F}};
    }

    /// Neither clips nor rejects.
    static Settings settings(Temporal temporal, float weight = 0.1F) {
        Settings s = plain_settings(4);
        s.temporal = temporal;
        s.temporal_place = TemporalPlace::after;
        s.temporal_weight = weight;
        s.temporal_scale = 4;
        s.temporal_clip = false;
        s.temporal_reject = false;
        return s;
    }
    /// White noise of few steps, other in each frame; the rest as it comes.
    static Settings noisy(Temporal temporal) {
        Settings s = plain_settings(4);
        s.temporal = temporal;
        s.temporal_place = TemporalPlace::after;
        s.noise = volumetrics::Noise::white;
        s.noise_time = volumetrics::NoiseTime::own;
        return s;
    }
    static Settings without(Settings s) {
        s.temporal = Temporal::off;
        return s;
    }

    Picture draw(const Settings& s) {
        const Picture picture = draw(host, s);
        ++host.frame_index;
        return picture;
    }
    Picture draw(StubHost& host, const Settings& s) {
        PassList passes;
        Inputs in = host.inputs(passes);
        in.view = glm::rotate(glm::mat4(1), turn, glm::vec3(0, 1, 0)) * in.view;
        if (motion) in.motion = passes.import("motion", motion);
        host.volumetrics().prepare(in, s);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, in, s);
        passes.export_texture(out.scattering);
        if (out.acceptance) passes.export_texture(out.acceptance);
        passes.compile();
        passes.execute(pool_);
        const auto textures = passes.textures();
        const auto read = [&](TextureRef ref) {
            return ref ? gl::read_texture(gl::TextureView(textures[ref.index].id, textures[ref.index].desc))
                       : Image();
        };
        return {read(out.scattering), read(out.acceptance)};
    }
    Picture after(int frames, const Settings& s) {
        Picture picture;
        for (int i = 0; i < frames; ++i) picture = draw(s);
        return picture;
    }
    Image truth() { return host.render(plain_settings(256)).scattering; }
    /// Without touching the history: by another host.
    Image of_other(const Settings& s) {
        other.size = host.size;
        other.eye = host.eye;
        other.view_depth = host.view_depth;
        other.global = host.global;
        other.has_sun = host.has_sun;
        other.sun_direction = host.sun_direction;
        other.sun_illuminance = host.sun_illuminance;
        other.ambient = host.ambient;
        other.lights = host.lights;
        other.shadows = host.shadows;
        other.frame_index = host.frame_index;
        return draw(other, s).scattering;
    }

    void add_sun_behind_fence() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.4F, -1, -0.5F));
        host.sun_illuminance = glm::vec3(1000);
        host.shadows = 1;
    }
    void set_motion(glm::vec2 uv) {
        motion = gl::Texture({.format = GL_RG16F, .size = {host.size, 1}}, "test motion");
        motion.clear_float(uv.x, uv.y, 0, 0);
    }

  private:
    TransientPool pool_;
};

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

double mean_of(const Image& image, int channel = 0) {
    double sum = 0;
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x) sum += image.at(x, y)[channel];
    return sum / (image.size.x * image.size.y);
}

/// Largest error relative to the mean.
void expect_near(const Image& image, const Image& expected, double tolerance, const char* what = "") {
    ASSERT_EQ(image.size, expected.size);
    const double allowed = tolerance * mean_of(expected);
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            ASSERT_NEAR(image.at(x, y)[0], expected.at(x, y)[0], allowed) << x << ' ' << y << ' ' << what;
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
    s.temporal_frames = 8;
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

// exp(-scale D), D = z' / z'' - 1 of a wall that was at z'' = 10 m; a wall that stays where it is and is approached
// is the same wall.
TEST_F(VolumetricsTemporal, AcceptanceFallsWithTheDistanceToWhatWasSeen) {
    for (const float scale : {0.0F, 1.0F, 4.0F})
        for (const float z : {8.0F, 10.0F, 15.0F}) {
            Settings s = settings(Temporal::acceptance);
            s.temporal_scale = scale;
            host.view_depth = [](int, int) { return 10.0F; };
            const double before = mean_of(after(2, s).scattering);
            host.view_depth = [z](int, int) { return z; };
            const Image now = draw(without(s)).scattering;
            host.view_depth = [](int, int) { return 10.0F; };
            after(2, s);
            host.view_depth = [z](int, int) { return z; };
            const Picture picture = draw(s);
            const double accepted = std::exp(-scale * (std::max(z, 10.0F) / std::min(z, 10.0F) - 1));
            EXPECT_NEAR(mean_of(picture.acceptance), accepted, 1e-3) << scale << ' ' << z;
            EXPECT_NEAR(mean_of(picture.scattering), mean_of(now) + 0.9 * accepted * (before - mean_of(now)),
                        2e-3 * before);
            draw(without(s));
        }
    Settings s = settings(Temporal::acceptance);
    s.temporal_scale = 100;
    for (const float eye : {0.0F, -0.1F, -0.2F}) {
        host.eye = {0, 0, eye};
        host.view_depth = [eye](int, int) { return 5 + eye; };
        EXPECT_GT(mean_of(draw(s).acceptance), eye == 0 ? -1 : 0.999);
    }
}

TEST_F(VolumetricsTemporal, SkyIsAcceptedWithSkyAndNothingElse) {
    const Settings s = settings(Temporal::accumulate);
    host.view_depth = [](int, int) { return sky; };
    draw(s);
    turn = 0.02F;
    EXPECT_GT(mean_of(draw(s).acceptance), 0.95);  // without the border that came into view
    host.view_depth = [](int, int) { return 1000.0F; };
    EXPECT_EQ(mean_of(draw(s).acceptance), 0);
    host.view_depth = [](int, int) { return sky; };
    EXPECT_EQ(mean_of(draw(s).acceptance), 0);
}

// A floor, of which depth changes by a quarter from row to row far away, under a camera that walks and turns.
TEST_F(VolumetricsTemporal, FloorsAtGrazingAnglesAreAccepted) {
    host.size = {32, 64};
    host.vertical_fov = 0.6F;
    host.view_depth = [this](int x, int y) {
        const glm::vec3 ray = host.ray(x, y);
        return ray.y < -0.003F ? -1.6F / ray.y * -ray.z : sky;
    };
    Settings s = settings(Temporal::acceptance);
    s.temporal_scale = 16;
    draw(s);
    for (int i = 1; i <= 4; ++i) {
        host.eye = glm::vec3(0.02F, 0, -0.06F) * static_cast<float>(i);
        turn = 0.003F * static_cast<float>(i);
        const Image acceptance = draw(s).acceptance;
        double sum = 0;
        int count = 0;
        for (int y = 34; y < 60; ++y)  // row 0 is at the top; below: came into view
            for (int x = 3; x < 29; ++x, ++count) sum += acceptance.at(x, y)[0];
        EXPECT_GT(sum / count, 0.98) << i;
    }
}

// The light is put out after the first frame: what is left is that frame, nine tenths of it, where its pixels are
// now.
TEST_F(VolumetricsTemporal, HistoryFollowsTheCamera) {
    host.size = {40, 20};
    host.vertical_fov = 0.1F;
    host.view_depth = [](int, int) { return 40.0F; };
    host.ambient = {};
    add_sun_behind_fence();
    const auto error = [&](Temporal mode, int pixels) {
        const Settings s = settings(mode);
        host.sun_illuminance = glm::vec3(1000);
        turn = 0;
        const Image before = draw(s).scattering;
        host.sun_illuminance = glm::vec3(0);
        // What is seen goes to the left.
        turn =
            2 * std::tan(0.5F * host.vertical_fov) / static_cast<float>(host.size.y) * static_cast<float>(pixels);
        const Image now = draw(s).scattering;
        double sum = 0, light = 0;
        for (int y = 0; y < host.size.y; ++y)
            for (int x = 8; x < host.size.x - 8; ++x) {
                sum += std::abs(now.at(x, y)[0] - 0.9 * before.at(x + pixels, y)[0]);
                light += 0.9 * before.at(x + pixels, y)[0];
            }
        draw(without(s));
        return sum / light;
    };
    for (const int pixels : {3, -5})
        for (const Temporal mode : {Temporal::ema, Temporal::acceptance})
            EXPECT_LT(error(mode, pixels), 0.01) << pixels;
    EXPECT_GT(error(Temporal::blend, 3), 0.1);
}

TEST_F(VolumetricsTemporal, HistoryFollowsWhatMoves) {
    host.size = {40, 20};
    host.ambient = {};
    add_sun_behind_fence();
    for (const Temporal mode : {Temporal::ema, Temporal::acceptance}) {
        const Settings s = settings(mode);
        set_motion({0, 0});
        host.sun_illuminance = glm::vec3(1000);
        const Image before = draw(s).scattering;
        host.sun_illuminance = glm::vec3(0);
        set_motion(glm::vec2(4, -2) / glm::vec2(host.size));
        const Image now = draw(s).scattering;
        for (int y = 2; y < 20; ++y)
            for (int x = 4; x < 40; ++x)  // 4 to the right and 2 down
                ASSERT_NEAR(now.at(x, y)[0], 0.9F * before.at(x - 4, y - 2)[0], 0.02 * mean_of(before))
                    << x << ' ' << y;
        for (int y = 0; y < 20; ++y) ASSERT_EQ(now.at(1, y)[0], 0);  // was off screen
        draw(without(s));
    }
}

// A pillar 0.5 m away, left of x = 0, before a wall 1 m away. The camera goes 0.05 m to the right: of the wall
// -0.05 <= x < 0 comes into view.
TEST_F(VolumetricsTemporal, WhatComesIntoViewIsOfTheNewFrameOnly) {
    host.size = {160, 8};
    host.vertical_fov = 0.1F;
    Settings s = settings(Temporal::acceptance, 0.05F);
    s.temporal_scale = 16;
    const auto tangent = [&](int x) { return host.ray(x, 4).x / -host.ray(x, 4).z; };
    host.view_depth = [&](int x, int) { return host.eye.x + 0.5F * tangent(x) < 0 ? 0.5F : 1.0F; };
    after(4, s);
    host.eye.x = 0.05F;
    const Image now = draw(without(s)).scattering;
    host.eye.x = 0;
    after(4, s);
    host.eye.x = 0.05F;
    const Picture picture = draw(s);
    const float margin = tangent(1) - tangent(0);
    int fresh = 0, known = 0;
    for (int x = 4; x < 150; ++x) {
        const float t = tangent(x);
        if (t > -0.1F + margin && t < -0.05F - margin) {
            EXPECT_EQ(picture.acceptance.at(x, 4)[0], 0);
            EXPECT_NEAR(picture.scattering.at(x, 4)[0], now.at(x, 4)[0], 1e-3 * now.at(x, 4)[0]);
            ++fresh;
        } else if (t > -0.05F + margin || t < -0.1F - margin) {
            EXPECT_GT(picture.acceptance.at(x, 4)[0], 0.99) << x;
            ++known;
        }
    }
    EXPECT_GE(fresh, 2);
    EXPECT_GE(known, 50);
}

TEST_F(VolumetricsTemporal, NotANumberIsGoneAfterOneFrame) {
    add_sun_behind_fence();
    for (const bool on : {false, true})
        for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity(), 1e30F}) {
            Settings s = settings(Temporal::accumulate);
            s.temporal_clip = s.temporal_reject = on;
            after(3, s);
            const Image expected = draw(without(s)).scattering;
            after(3, s);
            ASSERT_EQ(fill_history(value), 4);
            const Picture picture = draw(s);
            expect_near(picture.scattering, expected, 2e-3);
            EXPECT_EQ(mean_of(picture.acceptance), 0);
            EXPECT_EQ(mean_of(draw(s).acceptance), 1);
        }
}

TEST_F(VolumetricsTemporal, NothingStaleAfterAChange) {
    Settings first = settings(Temporal::accumulate);
    std::vector<Settings> changes(4, first);
    changes[0].temporal = Temporal::ema;
    changes[1].temporal_place = TemporalPlace::before;
    changes[2].technique = volumetrics::Technique::froxel;
    changes[3].resolution = volumetrics::Resolution::half;
    for (const Settings& change : changes) {
        after(2, first);
        EXPECT_EQ(mean_of(draw(first).acceptance), 1);
        EXPECT_EQ(mean_of(draw(change).acceptance), 0);
        EXPECT_EQ(mean_of(draw(change).acceptance), 1);
    }
    after(2, first);
    host.size = {9, 5};
    EXPECT_EQ(mean_of(draw(first).acceptance), 0);
    host.size = {1, 1};
    EXPECT_EQ(mean_of(draw(first).acceptance), 0);
    EXPECT_EQ(mean_of(draw(first).acceptance), 1);
}

// Of light that goes out, which is seen, and of a lamp that goes away, which is told, less than 5% is left after 4
// frames.
TEST_F(VolumetricsTemporal, ChangedLightIsForgotten) {
    host.size = {32, 18};
    host.ambient = glm::vec3(0.05F);
    host.shadows = 1;
    const auto lamp = [&](glm::vec3 place, float intensity) {
        host.lights = {point_light(place, intensity, 30)};
        host.lights[0].cone_shadow.z = 0;
    };
    for (const Temporal mode : {Temporal::ema, Temporal::accumulate})
        for (const bool clip : {false, true}) {
            Settings s = noisy(mode);
            s.temporal_clip = clip;
            lamp({-1, 5, -5}, 100);
            const Image on = after(32, s).scattering;
            lamp({-1, 5, -5}, 0);
            const Image off = of_other(plain_settings(256));
            EXPECT_LT(residual_light(after(4, s).scattering, on, off), 0.05) << int(mode) << clip;

            lamp({-1, 1, -5}, 100);  // in view
            const Image lit = after(32, s).scattering;
            lamp({500, 1, -5}, 100);
            const Image later = after(4, s).scattering;
            EXPECT_LT(residual_light(later, lit, of_other(plain_settings(256))), 0.05) << int(mode) << clip;
        }
}

TEST_F(VolumetricsTemporal, MediumThatChangesIsForgotten) {
    for (const Temporal mode : {Temporal::ema, Temporal::accumulate}) {
        after(8, settings(mode));
        host.global[0].sigma_s *= 1.3F;
        EXPECT_EQ(mean_of(draw(settings(mode)).acceptance), 0);
        after(8, settings(mode));
        host.global[0].sigma_s *= 1.001F;
        EXPECT_GT(mean_of(draw(settings(mode)).acceptance), 0.9);
    }
}

TEST_F(VolumetricsTemporal, NoiseIsNoChange) {
    host.size = {32, 18};
    add_sun_behind_fence();
    for (const auto filter : {volumetrics::Filter::none, volumetrics::Filter::gaussian15})
        for (const bool lamp : {false, true}) {
            if (lamp) {
                host.lights = {point_light({-1, 0.5F, -5}, 400, 30)};
                host.lights[0].cone_shadow.z = 0;
            } else {
                host.lights.clear();
            }
            Settings s = noisy(Temporal::accumulate);
            s.filter = filter;
            after(16, s);
            double accepted = 0;
            for (int i = 0; i < 16; ++i) accepted += mean_of(draw(s).acceptance) / 16;
            EXPECT_GT(accepted, 0.97) << lamp << int(filter);
            draw(without(s));
        }
}

// Ten steps, thin occluders, a light and a camera that move and come to rest.
TEST_F(VolumetricsTemporal, FewSamplesSettleAndNeverGetWorse) {
    host.size = {40, 22};
    host.ambient = {};
    host.view_depth = [this](int x, int y) {  // a pillar before a wall
        const glm::vec3 ray = host.ray(x, y);
        const float near = 12 + host.eye.z;
        return host.eye.x - ray.x / ray.z * near > 1.5F ? near : near + 13;
    };
    host.shadows = 1;
    Settings s = noisy(Temporal::accumulate);
    s.steps = 10;
    s.temporal_scale = 16;
    s.noise = volumetrics::Noise::ign;
    s.noise_time = volumetrics::NoiseTime::golden_ratio;
    const auto place = [&](int i) {
        const auto t = static_cast<float>(i);
        host.lights = {point_light({-2 + 0.05F * t, 6, -8}, 400, 40)};
        host.lights[0].cone_shadow.z = 0;
        host.eye = glm::vec3(0.03F, 0, -0.03F) * t;
    };
    constexpr int frames = 8;
    double single = 0;
    for (int i = 0; i < frames; ++i) {
        place(i);
        const Image now = draw(s).scattering;
        const Image expected = of_other(plain_settings(128));
        const double error = relative_rmse(now, expected);
        const double error_single = relative_rmse(of_other(without(s)), expected);
        EXPECT_LE(error, 1.1 * error_single) << i;
        single += error_single / frames;
    }
    const Image expected = of_other(plain_settings(128));
    const double error = relative_rmse(after(5, s).scattering, expected);
    EXPECT_LE(error, 0.25 * single);
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

}  // namespace
}  // namespace tyndall::test
