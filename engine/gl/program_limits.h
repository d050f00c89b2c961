#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <string>

namespace tyndall::gl {

/// Types of uniforms, as GL_TYPE gives them.
[[nodiscard]] bool is_sampler(GLenum type);
[[nodiscard]] bool is_image(GLenum type);

/// What a linked program needs of the numbers that a driver limits, or what a driver has.
struct ProgramLimits {
    int storage_bindings = 0;  ///< the highest binding of a storage block, and 1
    int storage_blocks = 0;    ///< in all stages
    int vertex_storage_blocks = 0, fragment_storage_blocks = 0, compute_storage_blocks = 0;
    int texture_units = 0;  ///< the highest unit of a sampler, and 1
    int image_units = 0;    ///< the highest unit of an image, and 1
    int draw_buffers = 0;   ///< the highest location of a fragment's output, and 1
};

/// What OpenGL 4.5 promises everywhere (chapter 23.5); but for storage blocks in vertex shaders, of which it
/// promises none: transforms and sprites need them, and whether the driver has them is checked as the rest.
inline constexpr ProgramLimits promised_limits{8, 8, 8, 8, 8, 16, 8, 8};

[[nodiscard]] ProgramLimits program_needs(GLuint program);
[[nodiscard]] ProgramLimits driver_limits();

/// Rounds of all loops of one shader after which the driver ends them: software rasterisers have such a limit.
[[nodiscard]] std::uint32_t loop_rounds();

/// Throws Error that names the program, the first need beyond its limit, and both numbers.
void check_limits(const std::string& label, const ProgramLimits& needs, const ProgramLimits& limits);

/// Throws Error that names the program and the unit where two samplers of different types share one: nothing could
/// be drawn with it (OpenGL 4.5, 7.11).
void check_sampler_units(const std::string& label, GLuint program);

}  // namespace tyndall::gl
