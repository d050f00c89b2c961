#include "engine/gl/program.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>

#include "engine/core/error.h"
#include "engine/gl/debug_scope.h"
#include "engine/gl/program_limits.h"

namespace tyndall::gl {
namespace {

struct ShaderTraits {
    static void destroy(GLuint id) { glDeleteShader(id); }
};
using Shader = Handle<ShaderTraits>;

const char* stage_name(GLenum stage) {
    switch (stage) {
        case GL_VERTEX_SHADER:
            return "vertex";
        case GL_TESS_CONTROL_SHADER:
            return "tessellation control";
        case GL_TESS_EVALUATION_SHADER:
            return "tessellation evaluation";
        case GL_GEOMETRY_SHADER:
            return "geometry";
        case GL_FRAGMENT_SHADER:
            return "fragment";
        case GL_COMPUTE_SHADER:
            return "compute";
        default:
            return "unknown";
    }
}

template <class GetParameter, class GetLog>
std::string info_log(GLuint id, GetParameter get_parameter, GetLog get_log) {
    GLint length = 0;
    get_parameter(id, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    get_log(id, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    log.erase(log.find_last_not_of(" \n\t") + 1);
    return log.empty() ? "the driver gave no reason" : log;
}

Shader compile(const ShaderSource& source, const std::string& label) {
    Shader shader(glCreateShader(source.stage));
    gl::label(GL_SHADER, shader.id(), fmt::format("{} ({})", label, stage_name(source.stage)));
    const char* text = source.text.c_str();
    glShaderSource(shader.id(), 1, &text, nullptr);
    glCompileShader(shader.id());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok != GL_TRUE)
        throw Error(fmt::format("program '{}': the {} shader does not compile\n{}", label, stage_name(source.stage),
                                info_log(shader.id(), glGetShaderiv, glGetShaderInfoLog)));
    return shader;
}

}  // namespace

Program::Program(const std::vector<ShaderSource>& sources, const std::string& label) {
    std::vector<Shader> shaders;
    for (const ShaderSource& source : sources) shaders.push_back(compile(source, label));

    handle_ = Handle<Traits>(glCreateProgram());
    gl::label(GL_PROGRAM, id(), label);
    for (const Shader& shader : shaders) glAttachShader(id(), shader.id());
    glLinkProgram(id());
    for (const Shader& shader : shaders) glDetachShader(id(), shader.id());
    GLint ok = GL_FALSE;
    glGetProgramiv(id(), GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE)
        throw Error(fmt::format("program '{}': does not link\n{}", label,
                                info_log(id(), glGetProgramiv, glGetProgramInfoLog)));
    check_limits(label, program_needs(id()), driver_limits());
    check_sampler_units(label, id());
}

GLint Program::location(std::string_view name) const {
    std::string key(name);
    if (const auto found = locations_.find(key); found != locations_.end()) return found->second;
    const GLint location = glGetUniformLocation(id(), key.c_str());
    locations_.emplace(std::move(key), location);
    return location;
}

// Location -1, a name that the program does not use, is ignored by GL.
void Program::set(std::string_view name, int value) const {
    glProgramUniform1i(id(), location(name), value);
}
void Program::set(std::string_view name, unsigned value) const {
    glProgramUniform1ui(id(), location(name), value);
}
void Program::set(std::string_view name, float value) const {
    glProgramUniform1f(id(), location(name), value);
}
void Program::set(std::string_view name, glm::ivec2 value) const {
    glProgramUniform2iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, glm::ivec3 value) const {
    glProgramUniform3iv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, glm::vec2 value) const {
    glProgramUniform2fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, glm::vec3 value) const {
    glProgramUniform3fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::vec4& value) const {
    glProgramUniform4fv(id(), location(name), 1, glm::value_ptr(value));
}
void Program::set(std::string_view name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(id(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace tyndall::gl
