#include "engine/gl/program_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "engine/core/error.h"
#include "engine/gl/software_driver.h"

namespace tyndall::gl {
namespace {

bool is_between(GLenum type, GLenum first, GLenum last) {
    return type >= first && type <= last;
}
/// Calls `visit` with the values of `properties` for each active resource of a kind.
template <std::size_t N, class Visit>
void for_each_resource(GLuint program, GLenum kind, const std::array<GLenum, N>& properties, Visit visit) {
    GLint count = 0;
    glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<GLint, N> values{};
        glGetProgramResourceiv(program, kind, static_cast<GLuint>(i), N, properties.data(), N, nullptr,
                               values.data());
        visit(values);
    }
}

void raise(int& need, int value) {
    need = std::max(need, value);
}

int driver_limit(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

}  // namespace

bool is_sampler(GLenum type) {
    return is_between(type, GL_SAMPLER_1D, GL_SAMPLER_2D_RECT_SHADOW) ||
           is_between(type, GL_SAMPLER_1D_ARRAY, GL_SAMPLER_CUBE_SHADOW) ||
           is_between(type, GL_INT_SAMPLER_1D, GL_UNSIGNED_INT_SAMPLER_BUFFER) ||
           is_between(type, GL_SAMPLER_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY) ||
           is_between(type, GL_SAMPLER_2D_MULTISAMPLE, GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY);
}
bool is_image(GLenum type) {
    return is_between(type, GL_IMAGE_1D, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY);
}

ProgramLimits program_needs(GLuint program) {
    ProgramLimits needs;
    for_each_resource(program, GL_SHADER_STORAGE_BLOCK,
                      std::array<GLenum, 4>{GL_BUFFER_BINDING, GL_REFERENCED_BY_VERTEX_SHADER,
                                            GL_REFERENCED_BY_FRAGMENT_SHADER, GL_REFERENCED_BY_COMPUTE_SHADER},
                      [&](const std::array<GLint, 4>& block) {
                          raise(needs.storage_bindings, block[0] + 1);
                          needs.vertex_storage_blocks += block[1];
                          needs.fragment_storage_blocks += block[2];
                          needs.compute_storage_blocks += block[3];
                          // A block counts in each stage that reads it.
                          needs.storage_blocks += block[1] + block[2] + block[3];
                      });
    for_each_resource(program, GL_UNIFORM, std::array<GLenum, 3>{GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE},
                      [&](const std::array<GLint, 3>& uniform) {
                          const auto type = static_cast<GLenum>(uniform[0]);
                          if (!is_sampler(type) && !is_image(type)) return;
                          for (GLint i = 0; i < uniform[2]; ++i) {
                              GLint unit = 0;
                              glGetUniformiv(program, uniform[1] + i, &unit);
                              raise(is_sampler(type) ? needs.texture_units : needs.image_units, unit + 1);
                          }
                      });
    for_each_resource(program, GL_PROGRAM_OUTPUT,
                      std::array<GLenum, 2>{GL_LOCATION, GL_REFERENCED_BY_FRAGMENT_SHADER},
                      [&](const std::array<GLint, 2>& output) {
                          if (output[1] != 0) raise(needs.draw_buffers, output[0] + 1);
                      });
    return needs;
}

void check_sampler_units(const std::string& label, GLuint program) {
    std::map<GLint, GLenum> types;
    for_each_resource(
        program, GL_UNIFORM, std::array<GLenum, 3>{GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE},
        [&](const std::array<GLint, 3>& uniform) {
            const auto type = static_cast<GLenum>(uniform[0]);
            if (!is_sampler(type)) return;
            for (GLint i = 0; i < uniform[2]; ++i) {
                GLint unit = 0;
                glGetUniformiv(program, uniform[1] + i, &unit);
                if (types.emplace(unit, type).first->second != type)
                    throw Error(fmt::format("{}: samplers of two types share texture unit {}", label, unit));
            }
        });
}

ProgramLimits driver_limits() {
    return {.storage_bindings = driver_limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS),
            .storage_blocks = driver_limit(GL_MAX_COMBINED_SHADER_STORAGE_BLOCKS),
            .vertex_storage_blocks = driver_limit(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS),
            .fragment_storage_blocks = driver_limit(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS),
            .compute_storage_blocks = driver_limit(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS),
            .texture_units = driver_limit(GL_MAX_TEXTURE_IMAGE_UNITS),
            .image_units = driver_limit(GL_MAX_IMAGE_UNITS),
            .draw_buffers = driver_limit(GL_MAX_DRAW_BUFFERS)};
}

std::uint32_t loop_rounds() {
    const std::string_view renderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    return is_software_driver(renderer) ? 65'535 : std::numeric_limits<std::uint32_t>::max();
}

void check_limits(const std::string& label, const ProgramLimits& needs, const ProgramLimits& limits) {
    constexpr std::pair<const char*, int ProgramLimits::*> kinds[] = {
        {"storage-buffer bindings", &ProgramLimits::storage_bindings},
        {"storage blocks", &ProgramLimits::storage_blocks},
        {"storage blocks in its vertex shader", &ProgramLimits::vertex_storage_blocks},
        {"storage blocks in its fragment shader", &ProgramLimits::fragment_storage_blocks},
        {"storage blocks in its compute shader", &ProgramLimits::compute_storage_blocks},
        {"texture units", &ProgramLimits::texture_units},
        {"image units", &ProgramLimits::image_units},
        {"draw buffers", &ProgramLimits::draw_buffers}};
    for (const auto& [what, number] : kinds)
        if (needs.*number > limits.*number)
            throw Error(fmt::format("program '{}': needs {} {}, the driver has {}", label, needs.*number, what,
                                    limits.*number));
}

}  // namespace tyndall::gl
