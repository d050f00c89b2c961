#include <algorithm>
#include <limits>

#include "engine/core/error.h"
#include "engine/graph/pass_list.h"
#include "engine/graph/require.h"

namespace tyndall {

using detail::require;

namespace {

/// The barrier that makes earlier shader writes visible to `access`; for a storage write, also what holds it back
/// until earlier accesses are done (GL 4.5 core, section 7.12.2).
GLbitfield barrier_for(Access access, bool is_buffer) {
    switch (access) {
        case Access::sample:
            return GL_TEXTURE_FETCH_BARRIER_BIT;
        case Access::storage_read:
        case Access::storage_write:
            return is_buffer ? GL_SHADER_STORAGE_BARRIER_BIT : GL_SHADER_IMAGE_ACCESS_BARRIER_BIT;
        case Access::attach:
            return GL_FRAMEBUFFER_BARRIER_BIT;
        case Access::indirect:
            return GL_COMMAND_BARRIER_BIT;
        case Access::vertex:
            return GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT;
        case Access::uniform:
            return GL_UNIFORM_BARRIER_BIT;
        case Access::copy:
            return GL_BUFFER_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
    }
    return GL_ALL_BARRIER_BITS;
}

/// Barriers issued since the last access to, and the last storage write of, one texture or buffer. `execute` ends
/// with every barrier, so a frame begins with all of them issued.
struct Issued {
    GLbitfield since_access = ~0U;
    GLbitfield since_write = ~0U;
};

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

void PassList::compile() {
    TYNDALL_CHECK(!compiled_);
    compiled_ = true;
    check_contents();
    for (const Pass& pass : passes_) check_feedback(pass);
    cull();
    if (!passes_.empty() && std::ranges::none_of(resources_, &Resource::exported) &&
        std::ranges::none_of(infos_, &PassInfo::live))
        throw Error(
            fmt::format("pass list: none of its {} passes would run, for no texture and no buffer is exported",
                        passes_.size()));
    assign_slots();
    derive_barriers();
}

void PassList::check_contents() const {
    std::vector<bool> written(resources_.size());
    for (std::size_t i = 0; i < resources_.size(); ++i) written[i] = !resources_[i].transient;
    for (const Pass& pass : passes_) {
        for (const Use& use : pass.uses)
            require(!use.reads || written[use.resource],
                    "what pass '" + infos_[pass.info].name + "' reads has been written before",
                    resources_[use.resource].name);
        for (const Use& use : pass.uses)
            if (use.writes) written[use.resource] = true;
    }
    for (std::size_t i = 0; i < resources_.size(); ++i)
        require(!resources_[i].exported || written[i], "an exported texture is written", resources_[i].name);
}

void PassList::check_feedback(const Pass& pass) const {
    for (const AttachmentUse& attachment : pass.attachments)
        for (const Use& use : pass.uses)
            require(!attachment.writes || use.access != Access::sample || use.resource != attachment.resource ||
                        (use.level >= 0 && use.level != attachment.level),
                    "pass '" + infos_[pass.info].name + "' does not sample the level it attaches",
                    resources_[use.resource].name);
}

// A write keeps what it does not cover, so whoever wrote before a needed pass is needed, too.
void PassList::cull() {
    std::vector<bool> needed(resources_.size());
    for (std::size_t i = 0; i < resources_.size(); ++i) needed[i] = resources_[i].exported;
    for (std::size_t p = passes_.size(); p-- > 0;) {
        const Pass& pass = passes_[p];
        PassInfo& info = infos_[pass.info];
        info.live = pass.keep ||
                    std::ranges::any_of(pass.uses, [&](const Use& u) { return u.writes && needed[u.resource]; });
        if (!info.live) {
            info.reason = info.writes.empty() ? "writes nothing" : "nothing uses " + joined(info.writes);
            continue;
        }
        for (const Use& use : pass.uses) {
            Resource& resource = resources_[use.resource];
            needed[use.resource] = true;
            resource.first_use = static_cast<int>(p);
            resource.last_use = std::max(resource.last_use, static_cast<int>(p));
        }
    }
}

void PassList::assign_slots() {
    for (int p = 0; p < static_cast<int>(passes_.size()); ++p) {
        for (Resource& resource : resources_) {
            if (!resource.transient || resource.first_use != p) continue;
            const auto free = std::ranges::find_if(
                slots_, [&](const Slot& slot) { return slot.last_use < p && slot.desc == resource.desc; });
            resource.slot = static_cast<int>(free - slots_.begin());
            if (free == slots_.end()) slots_.push_back({resource.desc, 0, {}});
            slots_[static_cast<std::size_t>(resource.slot)].last_use =
                resource.exported ? std::numeric_limits<int>::max() : resource.last_use;
        }
    }
}

void PassList::derive_barriers() {
    // Transients that share a texture share its state: slots first, then what is imported.
    std::vector<Issued> issued(slots_.size() + resources_.size());
    const auto state = [&](const Use& use) -> Issued& {
        const int slot = resources_[use.resource].slot;
        return issued[slot >= 0 ? static_cast<std::size_t>(slot) : slots_.size() + use.resource];
    };
    for (const Pass& pass : passes_) {
        PassInfo& info = infos_[pass.info];
        if (!info.live) continue;
        for (const Use& use : pass.uses) {
            const Issued& i = state(use);
            const GLbitfield bits = barrier_for(use.access, resources_[use.resource].is_buffer);
            info.barrier |= bits & ~(use.access == Access::storage_write ? i.since_access : i.since_write);
        }
        for (Issued& i : issued) {
            i.since_access |= info.barrier;
            i.since_write |= info.barrier;
        }
        for (const Use& use : pass.uses) {
            state(use).since_access = 0;
            if (use.access == Access::storage_write) state(use).since_write = 0;
        }
    }
}

}  // namespace tyndall
