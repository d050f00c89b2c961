#include "engine/graph/transient_pool.h"

#include <algorithm>

#include "engine/gl/debug_scope.h"

namespace tyndall {

TransientPool::TransientPool() : impl_(std::make_unique<Impl>()) {}
TransientPool::~TransientPool() = default;

std::size_t TransientPool::bytes() const {
    std::size_t sum = 0;
    for (const Impl::Item& item : impl_->items) sum += gl::byte_size(item.texture.desc());
    return sum;
}

std::size_t TransientPool::texture_count() const {
    return impl_->items.size();
}

void TransientPool::Impl::begin_frame() {
    ++frame;
    const auto unused = [&](const auto& entry) { return frame - entry.last_frame > keep_frames; };
    // A framebuffer is used no longer than its textures are, so it goes with or before them.
    std::erase_if(targets, [&](const auto& t) { return !t.second.pooled || unused(t.second); });
    std::erase_if(items, unused);
}

gl::TextureView TransientPool::Impl::acquire(const gl::TextureDesc& desc) {
    auto item = std::ranges::find_if(
        items, [&](const Item& i) { return i.last_frame != frame && i.texture.desc() == desc; });
    if (item == items.end()) item = items.insert(items.end(), {gl::Texture(desc, "transient"), "", 0});
    item->last_frame = frame;
    return item->texture;
}

void TransientPool::Impl::label(GLuint texture, const std::string& name) {
    const auto item = std::ranges::find_if(items, [&](const Item& i) { return i.texture.id() == texture; });
    if (item == items.end() || item->label == name) return;
    item->label = name;
    gl::label(GL_TEXTURE, texture, name);
}

const gl::Framebuffer& TransientPool::Impl::framebuffer(std::span<const gl::Attachment> color,
                                                        const gl::Attachment* depth, bool pooled,
                                                        const std::string& name) {
    std::vector<GLuint> key;
    const auto add = [&](const gl::Attachment& a) {
        key.insert(key.end(), {a.texture.id, static_cast<GLuint>(a.level), static_cast<GLuint>(a.layer)});
    };
    for (const gl::Attachment& attachment : color) add(attachment);
    key.push_back(depth != nullptr ? 1 : 0);
    if (depth != nullptr) add(*depth);

    auto found = targets.find(key);
    if (found == targets.end())
        found = targets.emplace(key, Target{gl::Framebuffer(color, depth, name), frame, pooled}).first;
    found->second.last_frame = frame;
    return found->second.framebuffer;
}

}  // namespace tyndall
