#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/gl/handle.h"

namespace tyndall::gl {

struct ShaderSource {
    GLenum stage;
    std::string text;  ///< complete, with #version
};

/// A linked program. Uniforms are set by name with DSA; setting a name the program does not use is allowed and
/// does nothing (the compiler may have removed it).
class Program {
  public:
    Program() = default;
    /// Throws Error with the compiler's log, or what it needs that the driver has not (program_limits.h).
    Program(const std::vector<ShaderSource>& sources, const std::string& label);

    [[nodiscard]] GLuint id() const { return handle_.id(); }
    explicit operator bool() const { return static_cast<bool>(handle_); }
    void use() const { glUseProgram(id()); }

    void set(std::string_view name, int value) const;
    void set(std::string_view name, unsigned value) const;
    void set(std::string_view name, float value) const;
    void set(std::string_view name, glm::ivec2 value) const;
    void set(std::string_view name, glm::ivec3 value) const;
    void set(std::string_view name, glm::vec2 value) const;
    void set(std::string_view name, glm::vec3 value) const;
    void set(std::string_view name, const glm::vec4& value) const;
    void set(std::string_view name, const glm::mat4& value) const;

  private:
    [[nodiscard]] GLint location(std::string_view name) const;
    struct Traits {
        static void destroy(GLuint id) { glDeleteProgram(id); }
    };
    Handle<Traits> handle_;
    mutable std::unordered_map<std::string, GLint> locations_;
};

}  // namespace tyndall::gl
