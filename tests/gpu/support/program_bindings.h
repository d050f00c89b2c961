#pragma once

#include <glad/gl.h>

#include <array>
#include <map>
#include <set>
#include <string>

#include "engine/gl/program_limits.h"

namespace tyndall::test {

/// Numbers that programs bind to, and the names that shaders give what is bound there.
struct ProgramBindings {
    using Numbers = std::map<int, std::set<std::string>>;
    Numbers textures, images, storage, uniforms;

    /// Those of a linked program.
    void add(GLuint program) {
        for_each(program, GL_UNIFORM, [&](GLuint i, const std::string& name) {
            const std::array<GLenum, 3> asked{GL_TYPE, GL_LOCATION, GL_ARRAY_SIZE};
            std::array<GLint, 3> value{};
            glGetProgramResourceiv(program, GL_UNIFORM, i, 3, asked.data(), 3, nullptr, value.data());
            const bool image = gl::is_image(static_cast<GLenum>(value[0]));
            if (!image && !gl::is_sampler(static_cast<GLenum>(value[0]))) return;
            for (GLint element = 0; element < value[2]; ++element) {
                GLint unit = 0;
                glGetUniformiv(program, value[1] + element, &unit);
                (image ? images : textures)[unit].insert(name);
            }
        });
        for (const GLenum kind : {GL_SHADER_STORAGE_BLOCK, GL_UNIFORM_BLOCK})
            for_each(program, kind, [&](GLuint i, const std::string& name) {
                const GLenum asked = GL_BUFFER_BINDING;
                GLint binding = 0;
                glGetProgramResourceiv(program, kind, i, 1, &asked, 1, nullptr, &binding);
                (kind == GL_UNIFORM_BLOCK ? uniforms : storage)[binding].insert(name);
            });
    }

  private:
    template <class Visit>
    static void for_each(GLuint program, GLenum kind, Visit visit) {
        GLint count = 0;
        glGetProgramInterfaceiv(program, kind, GL_ACTIVE_RESOURCES, &count);
        for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
            std::array<char, 256> name{};
            glGetProgramResourceName(program, kind, i, GLsizei(name.size()), nullptr, name.data());
            visit(i, name.data());
        }
    }
};

}  // namespace tyndall::test
