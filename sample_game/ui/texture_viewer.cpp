#include "sample_game/ui/texture_viewer.h"

#include <imgui.h>

#include <algorithm>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall {
namespace {

const ProgramDesc view_program{
    "texture_view",
    {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/game/texture_view.frag"}},
    {{"VIEW", {0, 1, 2, 3}}},
    {}};
const ProgramRegistry::Registration registration(view_program);

constexpr glm::ivec2 picture_size{480, 270};

int view_of(gl::TextureKind kind) {
    switch (kind) {
        case gl::TextureKind::d2:
            return 0;
        case gl::TextureKind::d2_array:
            return 1;
        case gl::TextureKind::d3:
            return 2;
        case gl::TextureKind::cube:
        case gl::TextureKind::cube_array:
            return 3;
    }
    return 0;
}

int slice_count(const gl::TextureDesc& desc) {
    switch (desc.kind) {
        case gl::TextureKind::d2_array:
        case gl::TextureKind::d3:
            return desc.size.z;
        case gl::TextureKind::cube:
            return 6;
        default:
            return 1;
    }
}

}  // namespace

TextureViewer::TextureViewer(ShaderLibrary& shaders)
    : shaders_(shaders),
      picture_({gl::TextureKind::d2, GL_RGBA8, {picture_size, 1}, 1}, "texture viewer"),
      sampler_(gl::SamplerDesc{.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "texture viewer") {
    const gl::Attachment color{picture_};
    framebuffer_ = gl::Framebuffer(std::span(&color, 1), nullptr, "texture viewer");
}

void TextureViewer::draw(const gl::TextureView& texture) {
    framebuffer_.bind();
    gl::apply(gl::DrawState{});
    const gl::Program& program = shaders_.get(view_program, {{"VIEW", view_of(texture.desc.kind)}});
    program.use();
    const bool volume = texture.desc.kind == gl::TextureKind::d3;
    const float slice = static_cast<float>(slice_);
    program.set("u_slice", volume ? (slice + 0.5f) / static_cast<float>(texture.desc.size.z) : slice);
    program.set("u_low", low_);
    program.set("u_high", high_);
    program.set("u_channels", channels_);
    program.set("u_size", glm::vec2(picture_size));
    glBindTextureUnit(0, texture.id);
    glBindSampler(0, sampler_.id());
    gl::draw_fullscreen();
    glBindSampler(0, 0);
}

void TextureViewer::panel(const PassList& passes) {
    const std::vector<PassList::TextureInfo> textures = passes.textures();
    const auto shown = std::find_if(textures.begin(), textures.end(),
                                    [&](const auto& t) { return t.name == selected_ && t.id != 0; });
    if (ImGui::BeginCombo("texture", selected_.empty() ? "(choose)" : selected_.c_str())) {
        for (const PassList::TextureInfo& t : textures)
            if (t.live && t.id != 0 && t.desc.kind != gl::TextureKind::cube_array &&
                ImGui::Selectable(t.name.c_str(), t.name == selected_)) {
                selected_ = t.name;
                slice_ = 0;
            }
        ImGui::EndCombo();
    }
    if (shown == textures.end()) return;
    const glm::ivec3 size = shown->desc.size;
    ImGui::TextDisabled("%d x %d x %d, %.2f MiB%s", size.x, size.y, size.z,
                        static_cast<double>(gl::byte_size(shown->desc)) / (1 << 20),
                        shown->transient ? ", transient" : "");
    const int slices = slice_count(shown->desc);
    slice_ = std::clamp(slice_, 0, slices - 1);
    if (slices > 1) ImGui::SliderInt("slice", &slice_, 0, slices - 1);
    ImGui::Combo("channels", &channels_, "rgb\0red\0green\0blue\0alpha\0");
    ImGui::DragFloatRange2("range", &low_, &high_, 0.01f, -1e5f, 1e5f, "%.4g");
    draw({shown->id, shown->desc});
    const float width = ImGui::GetContentRegionAvail().x;
    // GL pictures have their first row at the bottom.
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_.id())),
                 ImVec2(width, width * static_cast<float>(picture_size.y) / static_cast<float>(picture_size.x)),
                 ImVec2(0, 1), ImVec2(1, 0));
}

}  // namespace tyndall
