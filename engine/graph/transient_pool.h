#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/framebuffer.h"
#include "engine/graph/pass_list.h"

namespace tyndall {

struct TransientPool::Impl {
    struct Item {
        gl::Texture texture;
        std::string label;
        std::uint64_t last_frame;
    };
    struct Target {
        gl::Framebuffer framebuffer;
        std::uint64_t last_frame;
        bool pooled;  ///< all attachments are pool textures; a host may delete others and reuse their names
    };
    std::deque<Item> items;
    std::map<std::vector<GLuint>, Target> targets;  ///< by attachments
    std::uint64_t frame = 0;

    void begin_frame();
    gl::TextureView acquire(const gl::TextureDesc& desc);
    void label(GLuint texture, const std::string& name);
    const gl::Framebuffer& framebuffer(std::span<const gl::Attachment> color, const gl::Attachment* depth,
                                       bool pooled, const std::string& name);
};

}  // namespace tyndall
