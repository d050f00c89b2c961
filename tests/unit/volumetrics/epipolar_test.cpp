// Which lines lights take.

#include "light/epipolar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace tyndall::volumetrics {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

class EpipolarPlanTest : public ::testing::Test {
  protected:
    Inputs inputs;
    Settings settings;
    glm::ivec2 pixels{320, 180};

    void SetUp() override {
        inputs.projection = glm::mat4(0);
        inputs.projection[0][0] = 1.5F * 9 / 16;
        inputs.projection[1][1] = 1.5F;
        inputs.projection[2][3] = -1;
        inputs.projection[3][2] = 0.1F;
        turn(0);
    }
    void turn(float yaw) { inputs.view = glm::rotate(glm::mat4(1), yaw, glm::vec3(0, 1, 0)); }
    void sun_at(glm::vec3 direction) {
        inputs.has_sun = true;
        inputs.sun_direction = -glm::normalize(direction);
    }
    [[nodiscard]] EpipolarPlan plan() const { return plan_epipolar(inputs, inputs.lamps, settings, pixels); }
    /// Angle (rad) round the light of a direction, from the first line on.
    static float angle_of(const EpipolarLines& light, glm::vec3 direction) {
        const float angle =
            std::atan2(glm::dot(direction, glm::cross(light.axis, light.first)), glm::dot(direction, light.first));
        return angle < 0 ? angle + 2 * pi : angle;
    }
};

TEST_F(EpipolarPlanTest, ASunInThePictureHasAWholeTurnOfLines) {
    sun_at({0.1F, 0.1F, -1});
    const EpipolarLines sun = plan().lights.at(0);
    EXPECT_NEAR(static_cast<float>(sun.lines) / sun.lines_per_radian, 2 * pi, 1e-3F);
    sun_at({0.1F, 0.1F, 1});
    EXPECT_NEAR(static_cast<float>(plan().lights.at(0).lines) / sun.lines_per_radian, 2 * pi, 1e-3F) << "behind";
}

TEST_F(EpipolarPlanTest, LinesCoverThePictureAPixelApart) {
    for (const glm::vec3 to_sun :
         {glm::vec3(1, 0.3F, -0.3F), glm::vec3(0, 1, -0.2F), glm::vec3(-0.4F, -0.8F, 0.5F)}) {
        sun_at(to_sun);
        const EpipolarLines sun = plan().lights.at(0);
        for (float y = -1; y <= 1; y += 0.1F)
            for (float x = -1; x <= 1; x += 0.1F) {
                const glm::vec3 ray = glm::normalize(glm::vec3(x / inputs.projection[0][0], y / 1.5F, -1));
                const float line = angle_of(sun, ray) * sun.lines_per_radian;
                EXPECT_LT(line, static_cast<float>(sun.lines));
                // Beside it by a line is by a pixel at most.
                const float sine = glm::length(glm::cross(ray, sun.axis));
                EXPECT_LE(sine / sun.lines_per_radian, 1.01F * 2 / (1.5F * 180));
            }
        EXPECT_LT(sun.lines, 1000);
    }
}

TEST_F(EpipolarPlanTest, LinesKeepTheirPlacesAsTheCameraTurns) {
    sun_at({1, 0.3F, -0.3F});
    const EpipolarLines first = plan().lights.at(0);
    int same = 0;
    for (int i = 1; i <= 10; ++i) {
        turn(0.01F * static_cast<float>(i));
        const EpipolarLines sun = plan().lights.at(0);
        if (sun.lines_per_radian != first.lines_per_radian) continue;
        ++same;
        const float apart = angle_of(first, sun.first) * sun.lines_per_radian;
        EXPECT_NEAR(apart, std::round(apart), 2e-2F);
    }
    EXPECT_GT(same, 5);
}

TEST_F(EpipolarPlanTest, ALampFarAwayTakesFewerLinesThanOneRoundTheEye) {
    inputs.lamps = {{.index = 3, .position = {0, 0, -50}, .range = 5},
                    {.index = 7, .position = {0, 0, -2}, .range = 5}};
    const EpipolarPlan found = plan();
    ASSERT_EQ(found.lights.size(), 2U);
    EXPECT_EQ(found.lights[0].index, 4U);
    EXPECT_LT(4 * found.lights[0].lines, found.lights[1].lines);
    const auto table = found.table();
    ASSERT_EQ(table.size(), 4U * 9);
    EXPECT_EQ(table[4 * 4 + 2].z, static_cast<float>(found.lights[0].cells));
    EXPECT_EQ(table[4 * 5 + 2].z, 0) << "a lamp out of view has none";
}

TEST_F(EpipolarPlanTest, LampsTakeNoMoreRaysThanTheyMay) {
    for (std::uint32_t i = 0; i < 500; ++i)
        inputs.lamps.push_back({.index = i, .position = {0.01F * static_cast<float>(i), 0, -3}, .range = 20});
    for (const int rays : {8, 32, 128}) {
        settings.epipolar.lamp_rays = rays;
        const EpipolarPlan found = plan();
        EXPECT_EQ(found.lights.size(), 500U);
        EXPECT_LE(found.nodes, 2 * 320 * 180 * rays);
        EXPECT_GT(found.nodes, 2 * 320 * 180 * rays / 5);
    }
    settings.epipolar.lamp_rays = 1024;
    settings.epipolar.lamp_cells = 2048;
    EXPECT_LE(plan().nodes, most_epipolar_nodes);
}

TEST_F(EpipolarPlanTest, LargePicturesKeepTheSunWithinMemory) {
    sun_at({0.1F, 0.1F, -1});
    pixels = {8192, 4608};
    settings.epipolar.spacing = 0.25F;
    settings.epipolar.cells = 2048;
    EXPECT_LE(plan().nodes, most_epipolar_nodes / 2);
}

TEST_F(EpipolarPlanTest, SamplesCoverThePictureAPixelApartAndKeepTheirPlaces) {
    settings.epipolar.step = 8;
    for (const glm::vec3 to_sun : {glm::vec3(0.1F, 0.1F, -1), glm::vec3(1, 0.3F, -0.3F), glm::vec3(0, 0.1F, 1)}) {
        sun_at(to_sun);
        const EpipolarLines sun = plan().lights.at(0);
        EXPECT_EQ(sun.first_sample, std::round(sun.first_sample));
        EXPECT_NEAR(1 / sun.samples_per_radian, 2 / (1.5F * 180), 1e-5F);
        for (float y = -1; y <= 1; y += 0.5F)
            for (float x = -1; x <= 1; x += 0.5F) {
                const glm::vec3 ray = glm::normalize(glm::vec3(x / inputs.projection[0][0], y / 1.5F, -1));
                const float off_axis = std::acos(glm::clamp(glm::dot(ray, sun.axis), -1.0F, 1.0F));
                const float place = off_axis * sun.samples_per_radian - sun.first_sample;
                EXPECT_GE(place, 0);
                EXPECT_LT(place, static_cast<float>(sun.samples - 1));
            }
    }
    pixels = {8192, 4608};
    settings.epipolar.spacing = 0.25F;
    EXPECT_LE(plan().lights.at(0).samples, most_epipolar_samples);
    settings.epipolar.step = 1;
    EXPECT_EQ(plan().lights.at(0).samples, 0) << "every pixel asks";
}

TEST_F(EpipolarPlanTest, ADirectionFallsInThePixelThatShowsIt) {
    turn(0.7F);
    const glm::mat4 to_pixel = direction_to_pixel(inputs, {320, 180});
    for (const glm::vec2 pixel : {glm::vec2(0, 0), glm::vec2(160, 90), glm::vec2(17.25F, 133.5F)}) {
        const glm::vec2 ndc = 2.0F * pixel / glm::vec2(320, 180) - 1.0F;
        const glm::vec3 in_view(ndc.x / inputs.projection[0][0], ndc.y / inputs.projection[1][1], -1);
        const glm::vec4 found = to_pixel * glm::vec4(glm::transpose(glm::mat3(inputs.view)) * in_view, 0);
        EXPECT_NEAR(found.x / found.z, pixel.x, 1e-3F);
        EXPECT_NEAR(found.y / found.z, pixel.y, 1e-3F);
        EXPECT_GT(found.z, 0);
        EXPECT_LT((to_pixel * glm::vec4(glm::transpose(glm::mat3(inputs.view)) * -in_view, 0)).z, 0) << "behind";
    }
}

TEST_F(EpipolarPlanTest, ALampAtTheEyeNeedsNoLines) {
    inputs.lamps = {{.index = 0, .position = {0, 0.001F, 0}, .range = 5}};
    EXPECT_TRUE(plan().lights.empty());
}

TEST_F(EpipolarPlanTest, ASunWithoutAShadowNeedsNoLines) {
    sun_at({0.1F, 0.5F, -1});
    EXPECT_EQ(plan().lights.size(), 1U);
    inputs.sun_shadow = false;
    EXPECT_EQ(plan().lights.size(), 0U);
}

TEST_F(EpipolarPlanTest, ALampWithoutAShadowNeedsNoLines) {
    inputs.lamps = {{.index = 0, .position = {0, 0, -2}, .range = 5, .shadow = false}};
    EXPECT_TRUE(plan().lights.empty());
}

}  // namespace
}  // namespace tyndall::volumetrics
