// The curve of froxel depths under the mouse, whose state Dear ImGui is given as imgui_input does.
#include "sample_game/ui/curve_editor.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>

namespace tyndall {
namespace {

class CurveEditor : public ::testing::Test {
  protected:
    CurveEditor() : context_(ImGui::CreateContext()) {
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = ImVec2(400, 300);
        io.DeltaTime = 1.0f / 60;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        frame();
    }
    ~CurveEditor() override { ImGui::DestroyContext(context_); }

    void frame() {
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(ImVec2(400, 300));
        ImGui::Begin("test", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::PushItemWidth(200);
        origin_ = ImGui::GetCursorScreenPos();
        curve_editor(settings);
        ImGui::PopItemWidth();
        ImGui::End();
        ImGui::Render();
    }
    void mouse(ImVec2 at) {
        ImGui::GetIO().MousePos = at;
        frame();
    }
    void button(bool down) {
        ImGui::GetIO().MouseDown[ImGuiMouseButton_Left] = down;
        frame();
    }
    [[nodiscard]] ImVec2 point(int i) const {
        return {origin_.x + 25.0f * static_cast<float>(i), height_of(share(i))};
    }
    [[nodiscard]] float height_of(float depth_share) const {
        return origin_.y + curve_height * (1 - std::log(1 + 63 * depth_share) / std::log(64.0f));
    }
    /// Of the depth, at the i-th eighth of the slices.
    [[nodiscard]] float share(int i) const {
        float before = 0, total = 0;
        for (int k = 0; k < 8; ++k) {
            const float part = settings.froxels.*volumetrics::froxel_curve_settings[static_cast<std::size_t>(k)];
            total += part;
            if (k < i) before += part;
        }
        return before / total;
    }

    volumetrics::Settings settings;

  private:
    ImGuiContext* context_;
    ImVec2 origin_{0, 0};
};

TEST_F(CurveEditor, ADraggedPointFollowsTheMouseAndTheOthersStay) {
    std::array<float, 9> before{};
    for (int i = 0; i <= 8; ++i) before[static_cast<std::size_t>(i)] = share(i);
    mouse(point(5));
    button(true);
    const ImVec2 target(point(5).x + 30, height_of(0.5f * (share(5) + share(6))));
    mouse(target);
    EXPECT_NEAR(height_of(share(5)), target.y, 0.6f);
    button(false);
    mouse(ImVec2(target.x, target.y - 40));
    EXPECT_NEAR(height_of(share(5)), target.y, 0.6f) << "let go";
    for (const int i : {1, 2, 3, 4, 6, 7, 8})
        EXPECT_NEAR(share(i), before[static_cast<std::size_t>(i)], 1e-5f) << i;
}

TEST_F(CurveEditor, NoDragMakesTheCurveFall) {
    for (int i = 1; i < 8; ++i)
        for (const float y : {-500.0f, 800.0f}) {
            mouse(point(i));
            button(true);
            mouse(ImVec2(point(i).x, y));
            button(false);
            const std::array<float, 17> curve = volumetrics::froxel_curve(settings);
            for (std::size_t k = 0; k < 16; ++k) ASSERT_LT(curve[k], curve[k + 1]) << i << ' ' << y;
            for (const auto member : volumetrics::froxel_curve_settings) {
                EXPECT_GE(settings.froxels.*member, 0.001f);
                EXPECT_LE(settings.froxels.*member, 1000);
            }
        }
}

TEST_F(CurveEditor, APressBesideThePointsMovesNothing) {
    const volumetrics::Settings before = settings;
    mouse(ImVec2(point(3).x, point(3).y - 30));
    button(true);
    mouse(ImVec2(point(3).x, point(3).y - 60));
    button(false);
    for (const auto member : volumetrics::froxel_curve_settings)
        EXPECT_EQ(settings.froxels.*member, before.froxels.*member);
}

}  // namespace
}  // namespace tyndall
