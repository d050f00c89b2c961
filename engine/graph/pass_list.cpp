#include "engine/graph/pass_list.h"

#include "engine/graph/history.h"
#include "engine/graph/require.h"

namespace tyndall {

using detail::require;

std::uint32_t PassList::add_resource(Resource resource) {
    require(!compiled_, "resources are added before compile", resource.name);
    resources_.push_back(std::move(resource));
    return static_cast<std::uint32_t>(resources_.size() - 1);
}

TextureRef PassList::create(const std::string& name, const gl::TextureDesc& desc) {
    Resource resource;
    resource.name = name;
    resource.desc = gl::with_all_levels(desc);
    resource.transient = true;
    return {add_resource(std::move(resource)), 0};
}

TextureRef PassList::import(const std::string& name, const gl::TextureView& texture) {
    Resource resource;
    resource.name = name;
    resource.desc = gl::with_all_levels(texture.desc);
    resource.texture = texture;
    return {add_resource(std::move(resource)), 0};
}

BufferRef PassList::import_buffer(const std::string& name, GLuint buffer) {
    Resource resource;
    resource.name = name;
    resource.buffer = buffer;
    resource.is_buffer = true;
    return {add_resource(std::move(resource)), 0};
}

PassList::HistoryRefs PassList::import_history(const std::string& name, History& history) {
    HistoryRefs refs;
    if (history.valid()) refs.previous = import(name + "_before", history.previous());
    refs.current = import(name, history.current());
    resources_[refs.current.index].history = &history;
    return refs;
}

void PassList::add(const std::string& name, const std::function<void(PassBuilder&)>& setup, Execute execute) {
    require(!compiled_, "passes are added before compile", name);
    require(execute != nullptr, "a pass has something to execute", name);
    Pass pass;
    pass.execute = std::move(execute);
    pass.info = infos_.size();
    passes_.push_back(std::move(pass));
    PassInfo info;
    info.name = name;
    infos_.push_back(std::move(info));
    PassBuilder builder(*this, passes_.size() - 1);
    setup(builder);
}

void PassList::skip(const std::string& name, const std::string& reason) {
    PassInfo info;
    info.name = name;
    info.reason = reason;
    infos_.push_back(std::move(info));
}

void PassList::export_texture(TextureRef ref) {
    (void)current(ref.index, ref.version);
    resources_[ref.index].exported = true;
}

void PassList::export_buffer(BufferRef ref) {
    (void)current(ref.index, ref.version);
    resources_[ref.index].exported = true;
}

const gl::TextureDesc& PassList::desc(TextureRef ref) const {
    return current(ref.index, ref.version).desc;
}

bool PassList::holds(TextureRef ref) const {
    return ref.index < resources_.size() && !resources_[ref.index].is_buffer &&
           ref.version == resources_[ref.index].version;
}

const PassList::Resource& PassList::current(std::uint32_t index, std::uint32_t version) const {
    TYNDALL_CHECK_LT(index, resources_.size());
    const Resource& resource = resources_[index];
    if (version != resource.version)
        require(false, fmt::format("version {} is the newest: a pass wrote version {}", version, resource.version),
                resource.name);
    return resource;
}

std::vector<std::string> PassList::live_pass_names() const {
    std::vector<std::string> names;
    for (const PassInfo& info : infos_)
        if (info.live) names.push_back(info.name);
    return names;
}

PassList::TextureInfo PassList::info_of(const Resource& r) const {
    const auto pass_info = [&](int pass) {
        return pass < 0 ? -1 : static_cast<int>(passes_[static_cast<std::size_t>(pass)].info);
    };
    return {
        r.name, r.desc, r.transient, r.first_use >= 0, r.texture.id, pass_info(r.first_use), pass_info(r.last_use),
        r.slot};
}

std::vector<PassList::TextureInfo> PassList::textures() const {
    std::vector<TextureInfo> result;
    for (const Resource& r : resources_)
        if (!r.is_buffer) result.push_back(info_of(r));
    return result;
}

PassList::TextureInfo PassList::info(TextureRef ref) const {
    return info_of(current(ref.index, ref.version));
}

template <class Ref>
Ref PassBuilder::use(Ref ref, Access access, bool reads, bool writes, int level) {
    const PassList::Resource& resource = list_.current(ref.index, ref.version);
    require(!writes || !resource.exported, "nothing writes a resource after its export", resource.name);
    PassList::Pass& pass = list_.passes_[pass_];
    pass.uses.push_back({ref.index, access, reads, writes, level});
    PassList::PassInfo& info = list_.infos_[pass.info];
    if (reads) info.reads.push_back(resource.name);
    if (writes) {
        info.writes.push_back(resource.name);
        ref.version = ++list_.resources_[ref.index].version;
    }
    return ref;
}

TextureRef PassBuilder::attach(TextureRef ref, int level, int layer, bool depth, bool writes) {
    const TextureRef result = use(ref, Access::attach, !writes, writes);
    list_.passes_[pass_].attachments.push_back({ref.index, level, layer, depth, writes});
    return result;
}

TextureRef PassBuilder::sample(TextureRef ref, int level) {
    return ref ? use(ref, Access::sample, true, false, level) : ref;
}
TextureRef PassBuilder::storage_write(TextureRef ref) {
    return use(ref, Access::storage_write, false, true);
}
TextureRef PassBuilder::storage_read_write(TextureRef ref) {
    return use(ref, Access::storage_write, true, true);
}
TextureRef PassBuilder::attach_color(TextureRef ref, int level, int layer) {
    return attach(ref, level, layer, false, true);
}
TextureRef PassBuilder::attach_depth(TextureRef ref, int level, int layer) {
    return attach(ref, level, layer, true, true);
}
TextureRef PassBuilder::attach_depth_read_only(TextureRef ref) {
    return attach(ref, 0, -1, true, false);
}
BufferRef PassBuilder::read(BufferRef ref, Access access) {
    return ref ? use(ref, access, true, false) : ref;
}
BufferRef PassBuilder::write(BufferRef ref) {
    return use(ref, Access::storage_write, false, true);
}
void PassBuilder::keep() {
    list_.passes_[pass_].keep = true;
}

}  // namespace tyndall
