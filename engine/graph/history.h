#pragma once

#include <cstddef>
#include <string>

#include "engine/gl/texture.h"

namespace tyndall {

/// A previous/current pair of one texture. It is invalid after creation, a change of desc, or `invalidate` (a
/// camera cut), until a frame has written it; invalid means weight 0: never stale memory.
class History {
  public:
    /// Prepares this frame's pair; (re)allocates when `desc` differs. A frame that began without ending has left
    /// `previous` a frame too old: that invalidates, too.
    void begin_frame(const gl::TextureDesc& desc, const std::string& label);
    /// The current texture was written: it is `previous` from now on.
    void end_frame();
    void invalidate() { valid_ = false; }
    void release();  ///< frees both: the feature is off
    [[nodiscard]] bool valid() const { return valid_; }
    [[nodiscard]] std::size_t bytes() const;  ///< of both
    [[nodiscard]] const gl::Texture& previous() const { return pair_[1 - current_]; }
    [[nodiscard]] const gl::Texture& current() const { return pair_[current_]; }

  private:
    gl::Texture pair_[2];
    int current_ = 0;
    bool valid_ = false;
    bool in_frame_ = false;
};

}  // namespace tyndall
