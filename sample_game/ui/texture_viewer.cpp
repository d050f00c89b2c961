#include "sample_game/ui/texture_viewer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/gl/readback.h"
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

constexpr float longest_side = 480;  // px of the picture

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

bool has_one_channel(GLenum format) {
    switch (format) {
        case GL_R8:
        case GL_R16F:
        case GL_R32F:
        case GL_DEPTH_COMPONENT16:
        case GL_DEPTH_COMPONENT24:
        case GL_DEPTH_COMPONENT32F:
            return true;
        default:
            return false;
    }
}

/// The transient that used `t`'s memory after it, so that its content is gone; null if none did.
const PassList::TextureInfo* overwritten_by(const PassList::TextureInfo& t,
                                            const std::vector<PassList::TextureInfo>& textures) {
    const PassList::TextureInfo* last = nullptr;
    for (const PassList::TextureInfo& other : textures)
        if (t.transient && other.transient && other.live && other.slot == t.slot &&
            other.first_pass > t.last_pass && (last == nullptr || other.first_pass > last->first_pass))
            last = &other;
    return last;
}

bool can_show(const PassList::TextureInfo& t) {
    return t.live && t.id != 0 && t.desc.kind != gl::TextureKind::cube_array;
}

}  // namespace

TextureViewer::TextureViewer(ShaderLibrary& shaders)
    : shaders_(shaders),
      sampler_(gl::SamplerDesc{.min_filter = GL_NEAREST, .mag_filter = GL_NEAREST}, "texture viewer") {}

void TextureViewer::resize(glm::ivec3 texture_size) {
    const glm::vec2 wanted(texture_size);
    const glm::ivec2 size =
        glm::max(glm::ivec2(glm::round(wanted * (longest_side / std::max(wanted.x, wanted.y)))), glm::ivec2(1));
    if (picture_ && picture_.size() == size) return;
    picture_ = gl::Texture({gl::TextureKind::d2, GL_RGBA8, {size, 1}, 1}, "texture viewer");
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
    program.set("u_channels", has_one_channel(texture.desc.format) ? 1 : channels_);
    program.set("u_size", glm::vec2(picture_.size()));
    glBindTextureUnit(0, texture.id);
    glBindSampler(0, sampler_.id());
    gl::draw_fullscreen();
    glBindSampler(0, 0);
}

void TextureViewer::fit_range(const gl::TextureView& texture) {
    const Image image = gl::read_texture(texture, slice_);
    const int first = channels_ == 0 ? 0 : std::min(channels_ - 1, image.channels - 1);
    const int last = channels_ == 0 ? std::min(3, image.channels) : first + 1;
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const int channel = static_cast<int>(i % static_cast<std::size_t>(image.channels));
        if (channel < first || channel >= last || !std::isfinite(image.pixels[i])) continue;
        low = std::min(low, image.pixels[i]);
        high = std::max(high, image.pixels[i]);
    }
    if (low > high) return;  // nothing is finite
    low_ = low;
    high_ = high > low ? high : low + 1;
}

void TextureViewer::choose(const std::vector<PassList::TextureInfo>& textures) {
    if (!ImGui::BeginCombo("texture", selected_.empty() ? "(choose)" : selected_.c_str())) return;
    for (const PassList::TextureInfo& t : textures) {
        if (!can_show(t)) continue;
        const PassList::TextureInfo* later = overwritten_by(t, textures);
        if (later != nullptr) {
            ImGui::TextDisabled("%s: overwritten by %s", t.name.c_str(), later->name.c_str());
        } else if (ImGui::Selectable(t.name.c_str(), t.name == selected_)) {
            selected_ = t.name;
            slice_ = 0;
        }
    }
    ImGui::EndCombo();
}

void TextureViewer::panel(const PassList& passes) {
    const std::vector<PassList::TextureInfo> textures = passes.textures();
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.7f);
    choose(textures);
    const auto shown =
        std::find_if(textures.begin(), textures.end(), [&](const auto& t) { return t.name == selected_; });
    const bool usable = shown != textures.end() && can_show(*shown) && overwritten_by(*shown, textures) == nullptr;
    if (usable) {
        const glm::ivec3 size = shown->desc.size;
        const gl::TextureView texture(shown->id, shown->desc);
        ImGui::TextDisabled("%d x %d x %d, %.2f MiB%s", size.x, size.y, size.z,
                            static_cast<double>(gl::byte_size(shown->desc)) / (1 << 20),
                            shown->transient ? ", transient" : "");
        const int slices = slice_count(shown->desc);
        slice_ = std::clamp(slice_, 0, slices - 1);
        if (slices > 1) ImGui::SliderInt("slice", &slice_, 0, slices - 1);
        if (!has_one_channel(shown->desc.format))
            ImGui::Combo("channels", &channels_, "rgb\0red\0green\0blue\0alpha\0");
        ImGui::DragFloatRange2("range", &low_, &high_, 0.01f, -1e5f, 1e5f, "%.4g");
        ImGui::SameLine();
        if (ImGui::Button("fit")) fit_range(texture);
        resize(size);
        draw(texture);
        const glm::vec2 picture(picture_.size());
        const float width = ImGui::GetContentRegionAvail().x;
        // GL pictures have their first row at the bottom.
        ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_.id())),
                     ImVec2(width, width * picture.y / picture.x), ImVec2(0, 1), ImVec2(1, 0));
    } else if (!selected_.empty()) {
        ImGui::TextDisabled("not in this frame");
    }
    ImGui::PopItemWidth();
}

}  // namespace tyndall
