#include "sample_game/ui/imgui_renderer.h"

#include <imgui.h>

#include <cstddef>
#include <vector>

#include "engine/gl/state.h"

namespace tyndall {
namespace {

const ProgramDesc imgui_program{
    "imgui",
    {{GL_VERTEX_SHADER, "shaders/game/imgui.vert"}, {GL_FRAGMENT_SHADER, "shaders/game/imgui.frag"}},
    {},
    {}};
const ProgramRegistry::Registration registration(imgui_program);

ImTextureID texture_id(GLuint name) {
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name));
}

}  // namespace

ImguiRenderer::ImguiRenderer(ShaderLibrary& shaders)
    : shaders_(shaders), sampler_(gl::SamplerDesc{}, "imgui"), vertex_array_("imgui") {
    ImGuiIO& io = ImGui::GetIO();
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    font_ = gl::Texture({gl::TextureKind::d2, GL_RGBA8, {width, height, 1}, 1}, "imgui font");
    font_.upload(0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    io.Fonts->SetTexID(texture_id(font_.id()));
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    vertex_array_.attribute(0, 0, 2, GL_FLOAT, offsetof(ImDrawVert, pos));
    vertex_array_.attribute(1, 0, 2, GL_FLOAT, offsetof(ImDrawVert, uv));
    vertex_array_.integer_attribute(2, 0, 1, GL_UNSIGNED_INT, offsetof(ImDrawVert, col));
}

void ImguiRenderer::draw(GLuint framebuffer, glm::ivec2 size) {
    const ImDrawData* data = ImGui::GetDrawData();
    if (data == nullptr || data->TotalVtxCount == 0) return;
    const gl::Program& program = shaders_.get(imgui_program);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size.x, size.y);
    gl::apply(gl::DrawState{});
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);
    program.use();
    program.set("u_display_size", glm::vec2(data->DisplaySize.x, data->DisplaySize.y));
    glBindSampler(0, sampler_.id());

    for (int n = 0; n < data->CmdListsCount; ++n) {
        const ImDrawList* list = data->CmdLists[n];
        vertices_.assign(std::span<const ImDrawVert>(list->VtxBuffer.Data, list->VtxBuffer.Size), "imgui vertices");
        indices_.assign(std::span<const ImDrawIdx>(list->IdxBuffer.Data, list->IdxBuffer.Size), "imgui indices");
        vertex_array_.vertex_buffer(0, vertices_.id(), 0, sizeof(ImDrawVert));
        vertex_array_.index_buffer(indices_.id());
        vertex_array_.bind();
        for (const ImDrawCmd& command : list->CmdBuffer) {
            const ImVec4& clip = command.ClipRect;  // from the top left
            const int x = static_cast<int>(clip.x), w = static_cast<int>(clip.z) - x;
            const int h = static_cast<int>(clip.w) - static_cast<int>(clip.y);
            if (w <= 0 || h <= 0) continue;
            glScissor(x, size.y - static_cast<int>(clip.w), w, h);
            glBindTextureUnit(0, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
            constexpr GLenum type = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
            glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), type,
                                     reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                                     static_cast<GLint>(command.VtxOffset));
        }
    }
    glDisable(GL_SCISSOR_TEST);
    glBindSampler(0, 0);
    gl::apply(gl::DrawState{});
}

}  // namespace tyndall
