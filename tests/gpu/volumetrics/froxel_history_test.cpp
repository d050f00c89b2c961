// The history of the technique froxel: what settles, what must not lag, and what must be forgotten.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "engine/core/image_metrics.h"
#include "engine/gl/readback.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

namespace tyndall::test {
namespace {

class VolumetricsFroxelHistory : public GlTest {
  protected:
    StubHost host;

    VolumetricsFroxelHistory() {
        host.size = {16, 9};
        host.view_depth = [](int, int) { return 30.0F; };
        host.global = {{.sigma_s = glm::vec3(0.02F), .anisotropy = 0.3F}};
    }

    static Settings settings(int history) {
        Settings s = plain_settings(1);
        s.technique = "froxel";
        s.froxels.x = 16;
        s.froxels.y = 9;
        s.froxels.z = 24;
        s.froxels.far = 40;
        s.froxels.distribution = volumetrics::DepthDistribution::exponential;
        s.froxels.history = history;
        return s;
    }

    /// Light and shade in stripes of metres, narrower than a slice far away.
    void add_sun_behind_fence() {
        host.has_sun = true;
        host.sun_direction = glm::normalize(glm::vec3(0.4F, -1, -0.5F));
        host.sun_illuminance = glm::vec3(1000);
        host.shadows = 1;
    }
    /// Between the rays of the pixels: what passes a lamp sees it with one visibility or another.
    void add_lamps(bool shadowed) {
        host.lights = {point_light({1, 1.1F, -6}, 400, 30), point_light({-3, 0.7F, -12}, 800, 30)};
        host.lights[0].intensity_radius = {400, 100, 20, 0.01F};
        for (shared::GpuLight& light : host.lights) light.cone_shadow.z = shadowed ? 0.0F : -1.0F;
    }

    /// The last of so many frames.
    Image after(int frames, const Settings& s) {
        Image image;
        for (int i = 0; i < frames; ++i, ++host.frame_index) image = host.render(s).scattering;
        return image;
    }
    Image truth() { return host.render(plain_settings(256)).scattering; }

    /// A frame of a camera that is turned about +Y [rad].
    Image turned(float angle, const Settings& s) {
        PassList passes;
        Inputs in = host.inputs(passes);
        in.view = glm::rotate(glm::mat4(1), angle, glm::vec3(0, 1, 0)) * in.view;
        host.volumetrics().prepare(in, s);
        const volumetrics::Outputs out = host.volumetrics().add_passes(passes, in, s);
        passes.export_texture(out.scattering);
        passes.compile();
        passes.execute(pool_);
        const PassList::TextureInfo info = passes.info(out.scattering);
        return gl::read_texture(gl::TextureView(info.id, info.desc));
    }

    /// The textures of the history whose label says this, too.
    static std::vector<GLuint> history_textures(const std::string& name = "") {
        std::vector<GLuint> found;
        for (GLuint id = 1; id < 10'000; ++id) {
            if (glIsTexture(id) == GL_FALSE) continue;
            char text[256] = "";
            glGetObjectLabel(GL_TEXTURE, id, sizeof text, nullptr, text);
            const std::string label = text;
            if (label.find("(history)") != label.npos && label.find(name) != label.npos) found.push_back(id);
        }
        return found;
    }

    /// Fills all textures of the history.
    static std::size_t fill_history(float value) {
        const float texel[4] = {value, value, value, value};
        const std::vector<GLuint> all = history_textures();
        for (const GLuint id : all) glClearTexImage(id, 0, GL_RGBA, GL_FLOAT, texel);
        return all.size();
    }

  private:
    TransientPool pool_;
};

bool is_finite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](float v) { return std::isfinite(v); });
}

TEST_F(VolumetricsFroxelHistory, WithoutShadowsItChangesNothing) {
    host.has_sun = true;
    host.sun_illuminance = {1000, 900, 800};
    host.ambient = glm::vec3(3);
    add_lamps(false);
    host.local = {{.center = {0, 0, -8}, .half_extent = glm::vec3(2), .sigma_s = {0.2F, 0.1F, 0.05F}}};
    const Image without = after(1, settings(0));
    for (const int frames : {1, 2, 9})
        EXPECT_LE(relative_rmse(after(frames, settings(16)), without), 1e-3) << frames;  // half-float rounding
}

TEST_F(VolumetricsFroxelHistory, FirstFrameSamplesTheMiddle) {
    add_sun_behind_fence();
    add_lamps(true);
    const Image without = after(1, settings(0));
    EXPECT_LE(relative_rmse(after(1, settings(16)), without), 1e-3);
}

// In columns narrow enough for the ray in their middle to stand for them.
TEST_F(VolumetricsFroxelHistory, SettlesNearerToTheTruth) {
    host.size = {32, 18};
    Settings s = settings(32);
    s.froxels.x = 32;
    s.froxels.y = 18;
    add_sun_behind_fence();
    const Image sun = truth();
    const double sun_once = relative_rmse(after(1, s), sun);
    const double sun_settled = relative_rmse(after(31, s), sun);
    EXPECT_LE(sun_settled, 0.5 * sun_once) << sun_once;

    host.has_sun = false;
    add_lamps(true);
    const Image lamps = truth();
    const double lamps_once = relative_rmse(after(1, s), lamps);
    const double lamps_settled = relative_rmse(after(31, s), lamps);
    EXPECT_LE(lamps_settled, 0.5 * lamps_once) << lamps_once;
}

TEST_F(VolumetricsFroxelHistory, SettledItDoesNotFlicker) {
    add_sun_behind_fence();
    add_lamps(true);
    const Settings s = settings(256);
    after(260, s);
    std::vector<Image> frames;
    for (int i = 0; i < 9; ++i) frames.push_back(after(1, s));
    EXPECT_LE(flicker(frames), 1e-3);
}

// A wall comes between a lamp and half of the view, without any change of the light itself.
TEST_F(VolumetricsFroxelHistory, ShadowOfWhatMovesDoesNotLag) {
    host.lights = {point_light({0.3F, 0.2F, -3}, 1000)};
    host.lights[0].cone_shadow.z = 0;
    const Settings s = settings(256);
    const Image on = after(100, s);
    host.shadows = 2;
    const Image later = after(4, s);
    const Image off = after(80, s);
    EXPECT_LE(residual_light(later, on, off), 0.02);
}

// Its light is gone at once, for only its visibility was kept; what its shadows leave behind counts as its light,
// too.
TEST_F(VolumetricsFroxelHistory, SpotThatMovesAwayLeavesNoLight) {
    host.ambient = glm::vec3(0.01F);
    host.shadows = 1;
    const auto spot = [&](float x) {
        host.lights = {spot_light({x, 4, -8}, {0.1F, -1, -0.1F}, 2000, 0.9F, 0.8F, 30)};
        host.lights[0].cone_shadow.z = 0;
    };
    const Settings s = settings(128);
    spot(-2);
    const Image on = after(40, s);
    spot(5);
    const Image later = after(4, s);
    host.lights.clear();
    const Image off = after(1, settings(0));
    double before = 0, left = 0;
    for (int y = 0; y < host.size.y; ++y)
        for (int x = 0; x < host.size.x / 3; ++x) {  // the new place is in the right third
            before += on.at(x, y)[0] - off.at(x, y)[0];
            left += std::abs(later.at(x, y)[0] - off.at(x, y)[0]);
        }
    EXPECT_LE(left, 0.02 * before);
}

TEST_F(VolumetricsFroxelHistory, NotANumberIsGoneAfterOneFrame) {
    add_sun_behind_fence();
    add_lamps(true);
    const Settings s = settings(32);
    after(8, s);
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity(), 1e30F}) {
        ASSERT_EQ(fill_history(value), 4U);
        EXPECT_TRUE(is_finite(after(1, s))) << value;
        EXPECT_TRUE(is_finite(after(1, s))) << value;
    }
    EXPECT_LE(relative_rmse(after(40, s), truth()), 0.1);
}

TEST_F(VolumetricsFroxelHistory, NothingStaleAfterAChangeOfTheGrid) {
    add_sun_behind_fence();
    add_lamps(true);
    Settings other = settings(32);
    std::vector<Settings> changes;
    other.froxels.z = 16;
    changes.push_back(other);
    other = settings(32);
    other.froxels.x = 12;
    changes.push_back(other);
    for (const Settings& change : changes) {
        Settings once = change;
        once.froxels.history = 0;
        const Image expected = after(1, once);
        after(3, settings(32));
        EXPECT_LE(relative_rmse(after(1, change), expected), 1e-3);
        after(1, once);
        EXPECT_LE(relative_rmse(after(1, change), expected), 1e-3);  // off and on again
    }
}

// Everything is lit, and some froxels hold that nothing was. Of 128 frames a froxel's sample has a variance of
// p (1 - p) (1 + 1/128) with p = 0.5 / 129, and 27 of them a standard deviation of 0.32: one sample that differs is
// chance, two are a change, and what the froxels around them hold is forgotten. So it is everywhere: where groups
// of the shader meet, at the edges of the volume, before the farthest surface.
TEST_F(VolumetricsFroxelHistory, TwoSamplesOfTwentySevenAreAChange) {
    Settings s = settings(256);
    const glm::ivec3 size{40, 36, 36};
    s.froxels.x = size.x;
    s.froxels.y = size.y;
    s.froxels.z = size.z;
    s.froxels.distribution = volumetrics::DepthDistribution::linear;
    host.size = {40, 36};
    host.view_depth = [&](int x, int) { return x < 20 ? 9.5F : 38.0F; };
    host.has_sun = true;
    host.sun_illuminance = glm::vec3(1000);
    host.lights = {point_light({1, 1.5F, -6}, 400)};
    host.lights[0].cone_shadow.z = -1;
    const auto index = [&](glm::ivec3 p) { return static_cast<std::size_t>((p.z * size.y + p.y) * size.x + p.x); };
    const std::size_t count = index(size - 1) + 1;
    // One in 60 is wrong for the lamps, one in 40 for the sun.
    std::mt19937 random(5);
    std::vector<glm::bvec2> wrong(count);
    for (glm::bvec2& w : wrong) w = {random() % 60 == 0, random() % 40 == 0};

    for (const float step : {0.0F, 1e-5F}) {  // of the camera [m]: too little to be seen
        after(2, s);
        const std::vector<GLuint> certainty = history_textures("certainty");
        const std::vector<GLuint> visibility = history_textures("visibility");
        ASSERT_EQ(certainty.size(), 2U);
        const auto read = [&](GLuint id) {
            std::vector<glm::vec4> texels(count);
            glGetTextureImage(id, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(count * sizeof(glm::vec4)),
                              texels.data());
            return texels;
        };
        const auto write = [&](GLuint id, const std::vector<glm::vec4>& texels) {
            glTextureSubImage3D(id, 0, 0, 0, 0, size.x, size.y, size.z, GL_RGBA, GL_FLOAT, texels.data());
        };
        std::vector<glm::vec4> held = read(certainty[0]);
        std::vector<glm::vec4> seen(count);
        for (std::size_t i = 0; i < count; ++i) {
            if (held[i].x > 0) held[i].x = held[i].y = 0.5F;
            seen[i] = {glm::vec3(wrong[i].x ? 0 : 1), wrong[i].y ? 0 : 1};
        }
        for (const GLuint id : certainty) write(id, held);
        for (const GLuint id : visibility) write(id, seen);
        held = read(certainty[0]);  // as it was rounded
        host.eye.x += step;
        after(1, s);
        std::vector<glm::vec4> now = read(certainty[0]);
        if (now == held) now = read(certainty[1]);

        int lit = 0, forgotten = 0, failures = 0;
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const std::size_t here = index({x, y, z});
                    if (held[here].x == 0) {
                        failures += now[here].x != 0 || now[here].y != 0;
                        continue;
                    }
                    glm::ivec2 changed(0);
                    for (int c = z - 1; c <= z + 1; ++c)
                        for (int b = y - 1; b <= y + 1; ++b)
                            for (int a = x - 1; a <= x + 1; ++a) {
                                const glm::ivec3 p{a, b, c};
                                if (glm::any(glm::lessThan(p, glm::ivec3(0))) ||
                                    glm::any(glm::greaterThanEqual(p, size)) || held[index(p)].x == 0)
                                    continue;
                                changed += glm::ivec2(wrong[index(p)]);
                            }
                    for (int light = 0; light < 2; ++light) {
                        const float frames = 256 * now[here][light];
                        const float expected = changed[light] >= 2 ? 1 : 129;
                        failures += std::abs(frames - expected) > 0.1F;
                        forgotten += expected == 1;
                    }
                    ++lit;
                }
        EXPECT_EQ(failures, 0) << step << ' ' << forgotten << " of " << 2 * lit;
        EXPECT_GT(lit, 20'000);
        EXPECT_GT(forgotten, 2'000);
    }
}

// A camera that walks or turns: 0.5 to 0.6 of the error without a history.
TEST_F(VolumetricsFroxelHistory, MovingCameraSeesLessErrorThanWithout) {
    add_sun_behind_fence();
    add_lamps(true);
    struct Motion {
        glm::vec3 step;
        float turn;
    };
    for (const Motion motion :
         {Motion{{0.08F, 0, 0}, 0}, {{0, 0, -0.1F}, 0}, {{0, 0.05F, 0}, 0}, {{0, 0, 0}, 0.01F}}) {
        constexpr int frames = 12;
        const auto frame = [&](int i, const Settings& s) {
            host.eye = motion.step * static_cast<float>(i);
            host.frame_index = static_cast<std::uint32_t>(i);
            return turned(motion.turn * static_cast<float>(i), s);
        };
        std::vector<Image> expected;
        double without = 0, with = 0;
        for (int i = 0; i < frames; ++i) expected.push_back(frame(i, plain_settings(256)));
        for (int i = 0; i < frames; ++i) without += relative_rmse(frame(i, settings(0)), expected[i]) / frames;
        for (int i = 0; i < frames; ++i) with += relative_rmse(frame(i, settings(128)), expected[i]) / frames;
        EXPECT_LE(with, 0.8 * without) << motion.step.x << ' ' << motion.step.z << ' ' << motion.turn;
        after(1, settings(0));
    }
}

TEST_F(VolumetricsFroxelHistory, IsThereWhenLightCanBeShadowed) {
    using ::testing::Contains;
    host.ambient = glm::vec3(1);
    const Frame ambient = host.render(settings(16));
    EXPECT_EQ(ambient.skipped.at("volumetrics/froxel_history"), "neither sun nor lamps");
    host.has_sun = true;
    const Frame off = host.render(settings(0));
    EXPECT_EQ(off.skipped.at("volumetrics/froxel_history"), "froxel_history is 0");
    const Frame on = host.render(settings(16));
    EXPECT_THAT(on.live_passes, Contains("volumetrics/froxel_history"));
    EXPECT_EQ(on.persistent_bytes - off.persistent_bytes, std::size_t{4 * 8 * 16 * 9 * 24});
    EXPECT_EQ(host.render(settings(0)).persistent_bytes, off.persistent_bytes);
}

}  // namespace
}  // namespace tyndall::test
