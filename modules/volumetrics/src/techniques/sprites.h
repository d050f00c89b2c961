#pragma once

#include "engine/gl/buffer.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {

/// What billboards and particles draw, at BINDING_SPRITES: structs of shaders/shared/sprites.h.
struct Sprites : Kept {
    gl::Buffer buffer;
    [[nodiscard]] std::size_t bytes() const override { return buffer.size(); }
};

/// A square for each, as the vertex shader places it.
void draw_sprites(GLsizei count);

}  // namespace tyndall::volumetrics
