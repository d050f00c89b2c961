#include "engine/gl/buffer.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/gl/debug_scope.h"

namespace tyndall::gl {
namespace {
// GL refuses empty storage, and a shader's block needs something bound: an empty list still has a buffer.
constexpr std::size_t min_bytes = 16;
}  // namespace

Buffer::Buffer(std::size_t bytes, const std::string& label, const void* data) : bytes_(bytes) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    handle_ = Handle<Traits>(id);
    const bool direct = bytes >= min_bytes;
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(std::max(bytes, min_bytes)), direct ? data : nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    gl::label(GL_BUFFER, id, label);
    if (!direct && data != nullptr) write(0, bytes, data);
}

void Buffer::write(std::size_t offset, std::size_t bytes, const void* data) {
    TYNDALL_CHECK_LE(offset + bytes, bytes_);
    if (bytes > 0) glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::assign_bytes(const void* data, std::size_t bytes, const std::string& label) {
    // Grows by half, so that a list that lengthens every frame does not re-create its buffer every frame.
    if (!handle_ || bytes > bytes_) *this = Buffer(std::max(bytes, bytes_ + bytes_ / 2), label);
    write(0, bytes, data);
}

void Buffer::read(std::size_t offset, std::size_t bytes, void* out) const {
    TYNDALL_CHECK_LE(offset + bytes, bytes_);
    if (bytes == 0) return;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), out);
}

void Buffer::clear_uint(GLuint value) {
    glClearNamedBufferData(id(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void Buffer::bind(GLenum target, GLuint index) const {
    glBindBufferBase(target, index, id());
}

}  // namespace tyndall::gl
