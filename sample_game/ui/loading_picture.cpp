#include "sample_game/ui/loading_picture.h"

#include <imgui.h>

#include <algorithm>

#include "sample_game/ui/banner.h"

namespace tyndall {
namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs;

}  // namespace

void LoadingPicture::ContextDeleter::operator()(ImGuiContext* context) const {
    ImGui::DestroyContext(context);
}

LoadingPicture::LoadingPicture(GlContext& context, ShaderLibrary& shaders)
    : context_(context), imgui_(ImGui::CreateContext()) {
    ImGui::GetIO().IniFilename = nullptr;
    renderer_ = std::make_unique<ImguiRenderer>(shaders);
    const glm::ivec2 size = glm::max(context.framebuffer_size(), glm::ivec2(1));
    picture_ = gl::Texture({gl::TextureKind::d2, GL_RGBA8, glm::ivec3(size, 1), 1}, "loading picture");
    const gl::Attachment attachment{picture_};
    framebuffer_ = gl::Framebuffer(std::span(&attachment, 1), nullptr, "loading picture");
}

LoadingPicture::~LoadingPicture() = default;

void LoadingPicture::show(const std::string& doing, float share) {
    context_.poll();
    keys_pressed_ |= context_.input().keys_pressed;
    const ImVec2 size(static_cast<float>(picture_.size().x), static_cast<float>(picture_.size().y));
    ImGui::GetIO().DisplaySize = size;
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(ImVec2(0, 0));
    ImGui::SetNextWindowSize(size);
    if (ImGui::Begin("loading", nullptr, flags)) {
        ImGui::SetCursorPosY(size.y * 0.42f);
        ImGui::SetWindowFontScale(3);
        centred("Tyndall", amber());
        ImGui::SetWindowFontScale(1);
        centred(doing, pale());
        ImGui::PushStyleColor(ImGuiCol_PlotHistogram, amber());
        const float width = std::min(size.x * 0.5f, 320.0f);
        ImGui::SetCursorPosX((size.x - width) / 2);
        ImGui::ProgressBar(share, ImVec2(width, 6), "");
        ImGui::PopStyleColor();
    }
    ImGui::End();
    ImGui::Render();
    picture_.clear_float(0.07f, 0.06f, 0.05f, 1);
    renderer_->draw(framebuffer_.id(), picture_.size());
    context_.present(framebuffer_.id(), picture_.size());
}

}  // namespace tyndall
