// Motion vectors of the G-buffer against closed forms, and that they are there only where something needs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/files.h"
#include "engine/gl/readback.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

using volumetrics::Temporal;

constexpr glm::ivec2 size(96, 64);
constexpr float yfov = 1.0F;
const double tan_y = std::tan(0.5 * double{yfov}), tan_x = tan_y * size.x / size.y;

/// Where a camera at `eye` that looks along -Z sees p, 0..1.
glm::dvec2 uv_of(glm::dvec3 p, glm::dvec3 eye) {
    const glm::dvec3 q = p - eye;
    return 0.5 + 0.5 * glm::dvec2(q) / -q.z / glm::dvec2(tan_x, tan_y);
}

/// What that camera sees at pixel (x, y from the top) of the plane z = `z`.
glm::dvec3 seen(int x, int y, glm::dvec3 eye, double z) {
    const glm::dvec2 uv((x + 0.5) / size.x, 1 - (y + 0.5) / size.y);
    return eye + glm::dvec3((2.0 * uv - 1.0) * glm::dvec2(tan_x, tan_y), -1) * (eye.z - z);
}

class Motion : public GlTest {
  protected:
    Motion() {
        builder_.box({-2, 0, -0.5F}, {1, 1, 0.5F});  // node 0: its front is z = 0
        builder_.box({2, 0, -0.5F}, {1, 1, 0.5F});   // node 1
        builder_.scene.nodes[0].dynamic = true;
        Medium fog;
        fog.sigma_s = glm::vec3(0.01F);
        builder_.scene.media.push_back(fog);
        volumetrics_.settings.technique = "ray_march";  // one that asks for motion
        volumetrics_.settings.temporal.mode = Temporal::ema;
        renderer_.prepare(builder_.finish());
    }
    void draw() {
        const glm::vec3 eye(eye_);
        renderer_.render(builder_.scene, look_at(eye, eye + glm::vec3(0, 0, -1), yfov, 0.1F, 1.5F), size_,
                         options_);
    }
    void move_box(glm::vec3 by) {
        Node& node = builder_.scene.nodes[0];
        node.translation += by;
        node.world[3] = glm::vec4(node.translation, 1);
    }
    /// The picture, or nothing where the frame has none; y is up in its values.
    [[nodiscard]] std::optional<Image> motion() const {
        for (const PassList::TextureInfo& t : renderer_.passes().textures())
            if (t.name == "motion") {
                EXPECT_EQ(t.desc.format, GLenum{GL_RG16F});
                return gl::read_texture(gl::TextureView(t.id, t.desc));
            }
        return {};
    }
    /// Every pixel of a box's front, 2 m wide around `center` now: motion as `before` (the place of a point in the
    /// frame before) has it, to half precision. Returns how many pixels there are.
    int expect(const Image& image, glm::dvec3 center, glm::dvec3 eye_before,
               const std::function<glm::dvec3(glm::dvec3)>& before) const {
        int count = 0;
        double worst = 0;  // error / half of the last bit of a half, of 11, and 1e-6
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::dvec3 p = seen(x, y, eye_, center.z);
                if (std::abs(p.x - center.x) > 0.98 || std::abs(p.y - center.y) > 0.98) continue;
                ++count;
                const glm::dvec2 wanted = uv_of(p, eye_) - uv_of(before(p), eye_before);
                for (int c = 0; c < 2; ++c)
                    worst = std::max(worst,
                                     std::abs(image.at(x, y)[c] - wanted[c]) / (std::abs(wanted[c]) / 2048 + 1e-6));
            }
        EXPECT_LT(worst, 1);
        return count;
    }

    test::SceneBuilder builder_;
    glm::ivec2 size_ = size;
    glm::dvec3 eye_{0, 0, 8};
    FrameOptions options_;
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
};

TEST_F(Motion, BoxMovesBesideABoxThatStands) {
    draw();
    move_box({0.5F, 0.25F, 0});
    draw();
    const std::optional<Image> image = motion();
    ASSERT_TRUE(image);
    EXPECT_GT(expect(*image, {-1.5, 0.25, 0}, eye_, [](glm::dvec3 p) { return p - glm::dvec3(0.5, 0.25, 0); }), 90);
    EXPECT_GT(expect(*image, {2, 0, 0}, eye_, [](glm::dvec3 p) { return p; }), 90);
    // 8 m in front of a picture 13.1 m wide: 0.5 m are 3.67 of the 96 pixels.
    const glm::dvec2 box_uv = uv_of({-1.5, 0.25, 0}, eye_);
    const float* middle = image->at(int(box_uv.x * size.x), int((1 - box_uv.y) * size.y));
    EXPECT_NEAR(middle[0] * size.x, 0.5 / (2 * 8 * tan_x) * size.x, 2e-3);
    EXPECT_NEAR(middle[1] * size.y, 0.25 / (2 * 8 * tan_y) * size.y, 1e-3);
    EXPECT_EQ(image->at(0, 0)[0], 0);  // the sky
    EXPECT_EQ(image->at(0, 0)[1], 0);
}

TEST_F(Motion, OfTheCameraIsIncluded) {
    draw();
    const glm::dvec3 eye_before = std::exchange(eye_, {0.4, -0.2, 7});
    move_box({-0.25F, 0, 0.5F});  // towards the camera
    draw();
    const std::optional<Image> image = motion();
    ASSERT_TRUE(image);
    EXPECT_GT(
        expect(*image, {-2.25, 0, 0.5}, eye_before, [](glm::dvec3 p) { return p - glm::dvec3(-0.25, 0, 0.5); }),
        90);
    EXPECT_GT(expect(*image, {2, 0, 0}, eye_before, [](glm::dvec3 p) { return p; }), 90);
}

TEST_F(Motion, BoxTurns) {
    Node& node = builder_.scene.nodes[0];
    const glm::dvec3 center(node.translation);
    const glm::dquat before = glm::angleAxis(0.3, glm::dvec3(0, 0, 1));
    node.rotation = glm::quat(before);
    update_world_transforms(builder_.scene);
    draw();
    node.rotation = glm::quat(1, 0, 0, 0);
    update_world_transforms(builder_.scene);
    draw();
    const std::optional<Image> image = motion();
    ASSERT_TRUE(image);
    EXPECT_GT(expect(*image, {-2, 0, 0}, eye_, [&](glm::dvec3 p) { return center + before * (p - center); }), 90);
}

TEST_F(Motion, WhatWasBehindTheCameraLeadsOutOfThePicture) {
    move_box({2, 0, 20});
    draw();
    move_box({-2, 0, -20});
    draw();
    const std::optional<Image> image = motion();
    ASSERT_TRUE(image);
    const glm::dvec2 uv = uv_of({-2, 0, 0}, eye_);
    const float* there = image->at(int(uv.x * size.x), int((1 - uv.y) * size.y));
    EXPECT_GT(std::max(std::abs(there[0]), std::abs(there[1])), 1);
}

TEST_F(Motion, IsThereOnlyWhereSomethingMovesAndItIsRead) {
    const auto moved_there = [&](glm::vec3 by = {0.1F, 0, 0}) {
        move_box(by);
        draw();
        return motion().has_value();
    };
    const auto attached = [&] {
        for (const PassList::PassInfo& pass : renderer_.passes().passes())
            if (pass.name == "gbuffer") return pass.writes.size();
        return std::size_t{0};
    };
    draw();
    EXPECT_FALSE(motion()) << "the first frame";
    EXPECT_TRUE(moved_there());
    const std::size_t with = attached();
    eye_.x += 0.5;
    draw();
    EXPECT_FALSE(motion()) << "only the camera moves";
    EXPECT_EQ(attached(), with - 1);
    renderer_.invalidate_history();
    EXPECT_FALSE(moved_there()) << "a cut";
    EXPECT_TRUE(moved_there());
    size_ = {48, 32};
    EXPECT_FALSE(moved_there()) << "another size";
    EXPECT_TRUE(moved_there());
    EXPECT_FALSE(moved_there({0, 50, 0})) << "it is out of view";
    EXPECT_TRUE(moved_there({0, -50, 0}));

    for (const Temporal kept : {Temporal::ema, Temporal::acceptance, Temporal::accumulate}) {
        volumetrics_.settings.temporal.mode = kept;
        EXPECT_TRUE(moved_there());
    }
    for (const Temporal none : {Temporal::off, Temporal::blend}) {
        volumetrics_.settings.temporal.mode = none;
        EXPECT_FALSE(moved_there());
    }
    volumetrics_.settings.temporal.mode = Temporal::ema;
    volumetrics_.settings.technique = "analytic_fog";
    EXPECT_FALSE(moved_there()) << "nothing is sampled";
    volumetrics_.settings.technique = "ray_march";
    EXPECT_TRUE(moved_there());
    builder_.scene.media.clear();
    EXPECT_FALSE(moved_there()) << "no medium";
}

}  // namespace
}  // namespace tyndall
