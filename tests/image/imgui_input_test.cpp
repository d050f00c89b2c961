// A slider under the keys and clicks of one slow frame, in which all of them have come and gone.
#include "sample_game/ui/imgui_input.h"

#include <gtest/gtest.h>
#include <imgui.h>

namespace tyndall {
namespace {

class SlowFrames : public ::testing::Test {
  protected:
    SlowFrames() : context_(ImGui::CreateContext()) {
        ImGui::GetIO().IniFilename = nullptr;
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        input_.emplace();
        frame({});
    }
    ~SlowFrames() override { ImGui::DestroyContext(context_); }

    /// One second long.
    void frame(const Input& input) {
        input_->feed(input, {400, 300}, 1, true);
        ImGui::NewFrame();
        ImGui::SetNextWindowPos(ImVec2(0, 0));
        ImGui::SetNextWindowSize(ImVec2(400, 300));
        ImGui::Begin("test", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::SetNextItemWidth(200);
        ImGui::SliderFloat("value", &value_, 0, 1);
        ImGui::End();
        ImGui::Render();
    }
    /// Pointer over the slider's first quarter.
    static Input pointing() {
        Input input;
        input.pointer = {50, 18};
        return input;
    }
    static Input clicking(bool control) {
        Input input = pointing();
        input.buttons_pressed[static_cast<std::size_t>(MouseButton::left)] = true;
        input.press_modifiers = Input::Modifiers{false, control, false};
        return input;
    }
    /// Types and confirms.
    void type(const char* text) {
        Input input = pointing();
        input.text = text;
        frame(input);
        Input enter = pointing();
        enter.keys_pressed[static_cast<std::size_t>(Key::enter)] = true;
        frame(enter);
        frame(pointing());
    }

    ImGuiContext* context_;
    std::optional<ImguiInput> input_;
    float value_ = 0.5f;
};

TEST_F(SlowFrames, ControlClickOpensTheSlidersText) {
    frame(pointing());
    frame(clicking(true));
    frame(pointing());
    EXPECT_EQ(value_, 0.5f) << "a plain click would have moved it";
    type("0.75");
    EXPECT_EQ(value_, 0.75f);
}

TEST_F(SlowFrames, AlsoWhereThePointerArrivedInThatFrame) {
    Input input = clicking(true);
    input.pointer_delta = {50, 18};
    frame(input);
    frame(pointing());
    frame(pointing());
    EXPECT_EQ(value_, 0.5f);
    type("0.75");
    EXPECT_EQ(value_, 0.75f);
}

TEST_F(SlowFrames, APlainClickMovesTheSlider) {
    frame(pointing());
    Input input = clicking(false);  // and control pressed after it
    input.keys_pressed[static_cast<std::size_t>(Key::control)] = true;
    frame(input);
    frame(pointing());
    EXPECT_NEAR(value_, 0.21f, 0.05f);
}

TEST_F(SlowFrames, ControlAMarksTheWholeText) {
    frame(pointing());
    frame(clicking(true));
    frame(pointing());
    Input end = pointing();  // what is marked at first no longer is
    end.keys_pressed[static_cast<std::size_t>(Key::end)] = true;
    frame(end);
    Input all = pointing();
    all.keys_pressed[static_cast<std::size_t>(Key::a)] = true;
    all.press_modifiers = Input::Modifiers{false, true, false};
    frame(all);
    type("0.25");
    EXPECT_EQ(value_, 0.25f);
}

}  // namespace
}  // namespace tyndall
