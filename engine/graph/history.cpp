#include "engine/graph/history.h"

namespace tyndall {

void History::begin_frame(const gl::TextureDesc& desc, const std::string& label) {
    const gl::TextureDesc wanted = gl::with_all_levels(desc);
    if (!pair_[0] || pair_[0].desc() != wanted) {
        release();
        for (gl::Texture& texture : pair_) texture = gl::Texture(wanted, label + " (history)");
    } else if (in_frame_) {
        valid_ = false;
    }
    in_frame_ = true;
}

void History::end_frame() {
    current_ = 1 - current_;
    valid_ = true;
    in_frame_ = false;
}

std::size_t History::bytes() const {
    return pair_[0] ? 2 * gl::byte_size(pair_[0].desc()) : 0;
}

void History::release() {
    *this = History();
}

}  // namespace tyndall
