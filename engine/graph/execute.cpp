#include <algorithm>

#include "engine/gl/debug_scope.h"
#include "engine/graph/history.h"
#include "engine/graph/pass_list.h"
#include "engine/graph/require.h"
#include "engine/graph/transient_pool.h"

namespace tyndall {

using detail::require;

namespace {

class TimerScope {
  public:
    TimerScope(gl::GpuTimer* timer, const std::string& name) : timer_(timer) {
        if (timer_ != nullptr) timer_->begin(name);
    }
    ~TimerScope() {
        if (timer_ != nullptr) timer_->end();
    }
    TimerScope(const TimerScope&) = delete;
    TimerScope& operator=(const TimerScope&) = delete;

  private:
    gl::GpuTimer* timer_;
};

}  // namespace

void PassList::execute(TransientPool& pool, gl::GpuTimer* timer, gl::WorkCounters* counters) {
    TYNDALL_CHECK(compiled_);
    pool_ = &pool;
    pool.impl_->begin_frame();
    bind_slots();
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        const PassInfo& info = infos_[passes_[p].info];
        if (!info.live) continue;
        label_first_uses(p);
        if (info.barrier != 0) glMemoryBarrier(info.barrier);
        const gl::DebugScope group(info.name);
        if (counters != nullptr) counters->begin_pass(info.name);
        const TimerScope time(timer, info.name);
        passes_[p].execute(PassContext(*this, p));
        end_histories(p);
    }
    // What follows (a read-back, the next frame's list) knows nothing of this list's writes.
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    pool_ = nullptr;
}

void PassList::bind_slots() {
    for (Slot& slot : slots_) slot.texture = pool_->impl_->acquire(slot.desc);
    for (Resource& resource : resources_)
        if (resource.slot >= 0) resource.texture = slots_[static_cast<std::size_t>(resource.slot)].texture;
}

void PassList::label_first_uses(std::size_t pass) {
    for (const Resource& resource : resources_)
        if (resource.slot >= 0 && resource.first_use == static_cast<int>(pass))
            pool_->impl_->label(resource.texture.id, resource.name);
}

void PassList::end_histories(std::size_t pass) {
    for (const Resource& resource : resources_)
        if (resource.history != nullptr && resource.last_use == static_cast<int>(pass))
            resource.history->end_frame();
}

const PassList::Resource& PassList::used_by(std::size_t pass, std::uint32_t index) const {
    TYNDALL_CHECK_LT(index, resources_.size());
    const Pass& p = passes_[pass];
    require(std::ranges::any_of(p.uses, [&](const Use& use) { return use.resource == index; }),
            "pass '" + infos_[p.info].name + "' declared what it uses", resources_[index].name);
    return resources_[index];
}

void PassList::bind_framebuffer(std::size_t pass) const {
    const Pass& p = passes_[pass];
    const std::string& name = infos_[p.info].name;
    require(!p.attachments.empty(), "a pass that binds its framebuffer attached something", name);
    std::vector<gl::Attachment> color, depth;
    bool pooled = true;
    for (const AttachmentUse& use : p.attachments) {
        const Resource& resource = resources_[use.resource];
        (use.depth ? depth : color).push_back({resource.texture, use.level, use.layer});
        pooled = pooled && resource.transient;
    }
    require(depth.size() <= 1, "a pass attaches one depth texture", name);
    pool_->impl_->framebuffer(color, depth.empty() ? nullptr : depth.data(), pooled, name).bind();
}

gl::TextureView PassContext::texture(TextureRef ref) const {
    return list_.used_by(pass_, ref.index).texture;
}
GLuint PassContext::buffer(BufferRef ref) const {
    return list_.used_by(pass_, ref.index).buffer;
}
void PassContext::bind_framebuffer() const {
    list_.bind_framebuffer(pass_);
}

}  // namespace tyndall
