#include "sample_game/screen.h"

#include "engine/gl/readback.h"
#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall {
namespace {

const ProgramDesc antialias{
    "antialias",
    {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/game/antialias.frag"}},
    {},
    {}};
const ProgramRegistry::Registration registration(antialias);

}  // namespace

void Screen::Target::resize(glm::ivec2 size, const char* label) {
    if (texture && texture.size() == size) return;
    texture = gl::Texture({gl::TextureKind::d2, GL_RGBA8, {size, 1}, 1}, label);
    const gl::Attachment attachment{texture};
    framebuffer = gl::Framebuffer(std::span(&attachment, 1), nullptr, label);
}

Screen::Screen(ShaderLibrary& shaders) : shaders_(shaders), linear_(gl::SamplerDesc{}, "screen") {}

void Screen::show(const Renderer& renderer, glm::ivec2 window) {
    size_ = window;
    framebuffer_ = renderer.display_framebuffer();
    picture_ = renderer.display();
    const glm::ivec2 from = renderer.size();
    if (from == window) return;

    smooth_.resize(from, "smooth picture");
    smooth_.framebuffer.bind();
    gl::apply(gl::DrawState{});
    shaders_.get(antialias).use();
    glBindTextureUnit(0, picture_.id);
    glBindSampler(0, linear_.id());
    gl::draw_fullscreen();
    glBindSampler(0, 0);

    scaled_.resize(window, "screen");
    glBlitNamedFramebuffer(smooth_.framebuffer.id(), scaled_.framebuffer.id(), 0, 0, from.x, from.y, 0, 0, window.x,
                           window.y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    framebuffer_ = scaled_.framebuffer.id();
    picture_ = scaled_.texture;
}

Image Screen::read() const {
    return gl::read_texture(picture_);
}

}  // namespace tyndall
