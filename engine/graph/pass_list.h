#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/framebuffer.h"
#include "engine/gl/query.h"
#include "engine/gl/texture.h"
#include "engine/gl/work_counters.h"

namespace tyndall {

/// A texture or buffer of one frame's pass list, at one version: each write makes a new version and using an old
/// one afterwards is a failed check. Default constructed: none.
struct TextureRef {
    std::uint32_t index = ~0u;
    std::uint32_t version = 0;
    explicit operator bool() const { return index != ~0u; }
    friend bool operator==(const TextureRef&, const TextureRef&) = default;
};
struct BufferRef {
    std::uint32_t index = ~0u;
    std::uint32_t version = 0;
    explicit operator bool() const { return index != ~0u; }
    friend bool operator==(const BufferRef&, const BufferRef&) = default;
};

/// How a pass touches a resource; barriers follow from the pair (last writer, this use).
enum class Access { sample, storage_read, storage_write, attach, indirect, vertex, uniform, copy };

class History;
class PassList;

/// What a pass sees while it runs.
class PassContext {
  public:
    [[nodiscard]] gl::TextureView texture(TextureRef ref) const;
    [[nodiscard]] GLuint buffer(BufferRef ref) const;
    /// Binds the framebuffer of what the pass attached (attachments in the order declared) and its viewport.
    void bind_framebuffer() const;

  private:
    friend class PassList;
    PassContext(const PassList& list, std::size_t pass) : list_(list), pass_(pass) {}
    const PassList& list_;
    std::size_t pass_;
};

/// Declares what a pass reads and writes.
class PassBuilder {
  public:
    /// Texture fetches of one level, or of any (-1); an empty ref is ignored. Attaching a sampled level in the
    /// same pass is a failed check, unless as read-only depth.
    TextureRef sample(TextureRef ref, int level = -1);
    TextureRef storage_write(TextureRef ref);  ///< imageStore; returns the new version
    TextureRef storage_read_write(TextureRef ref);
    TextureRef attach_color(TextureRef ref, int level = 0, int layer = -1);
    TextureRef attach_depth(TextureRef ref, int level = 0, int layer = -1);
    TextureRef attach_depth_read_only(TextureRef ref);
    BufferRef read(BufferRef ref, Access access = Access::storage_read);  ///< an empty ref is ignored
    BufferRef write(BufferRef ref);  ///< storage write; returns the new version
    /// The pass has an effect outside the list (a read-back, a present): it is never culled.
    void keep();

  private:
    friend class PassList;
    PassBuilder(PassList& list, std::size_t pass) : list_(list), pass_(pass) {}
    template <class Ref>
    Ref use(Ref ref, Access access, bool reads, bool writes, int level = -1);
    TextureRef attach(TextureRef ref, int level, int layer, bool depth, bool writes);
    PassList& list_;
    std::size_t pass_;
};

/// Keeps transient textures from frame to frame: same desc, same texture. Textures unused for `keep_frames` frames
/// are freed. One execution of a pass list is a frame.
class TransientPool {
  public:
    static constexpr int keep_frames = 60;
    TransientPool();
    ~TransientPool();
    TransientPool(const TransientPool&) = delete;
    TransientPool& operator=(const TransientPool&) = delete;
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t texture_count() const;

  private:
    friend class PassList;
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// One frame's passes, in the order they run. Rebuilt every frame: create, add passes, export, compile, execute.
/// Declaration and compile need no GL (tested so); only execute does.
class PassList {
  public:
    using Execute = std::function<void(const PassContext&)>;

    /// A texture that lives within the frame and comes from the pool.
    TextureRef create(const std::string& name, const gl::TextureDesc& desc);
    /// A texture that lives elsewhere. Writing to it is an effect outside the list only if it is also exported.
    TextureRef import(const std::string& name, const gl::TextureView& texture);
    BufferRef import_buffer(const std::string& name, GLuint buffer);
    /// This frame's pair of a history that began its frame (History::begin_frame) and outlives execute. `previous`
    /// is empty while it is not valid. The history's frame ends once the last pass that uses `current` has run; a
    /// list that culls those passes leaves a history without this frame, which is not valid in the next.
    struct HistoryRefs {
        TextureRef previous, current;
    };
    HistoryRefs import_history(const std::string& name, History& history);

    /// `setup` declares resources at once; `execute` runs later if the pass is not culled.
    void add(const std::string& name, const std::function<void(PassBuilder&)>& setup, Execute execute);
    /// Records that a pass was not added and why ("no medium in the scene"): the debug UI and tests show it.
    void skip(const std::string& name, const std::string& reason);

    /// What the frame is for: passes that do not contribute to an exported resource are culled.
    void export_texture(TextureRef ref);
    void export_buffer(BufferRef ref);

    /// Culls, computes lifetimes and barriers. Throws Error where passes were added and none would run, for nothing
    /// is exported: a host that forgot to export its picture.
    void compile();
    /// Runs the live passes, each in a debug group and a timer scope of its name, then makes all shader writes
    /// visible to whatever follows. `timer` and `counters` may be null; their begin_frame is the caller's.
    void execute(TransientPool& pool, gl::GpuTimer* timer = nullptr, gl::WorkCounters* counters = nullptr);

    struct PassInfo {
        std::string name;
        bool live = false;
        std::string reason;      ///< why it does not run, when it does not
        GLbitfield barrier = 0;  ///< glMemoryBarrier bits issued before it
        std::vector<std::string> reads, writes;
    };
    [[nodiscard]] const std::vector<PassInfo>& passes() const { return infos_; }
    [[nodiscard]] std::vector<std::string> live_pass_names() const;
    struct TextureInfo {
        std::string name;
        gl::TextureDesc desc;
        bool transient = false;
        bool live = false;
        GLuint id = 0;                        ///< after execute
        int first_pass = -1, last_pass = -1;  ///< live uses, as indices into passes()
        int slot = -1;                        ///< transients of one slot share a texture, one after the other
    };
    /// For the texture viewer: valid until the pool is used by the next frame. A transient whose slot a later one
    /// took shows that one's content: export what is to be looked at.
    [[nodiscard]] std::vector<TextureInfo> textures() const;
    [[nodiscard]] TextureInfo info(TextureRef ref) const;  ///< one of them
    [[nodiscard]] std::string to_text() const;
    [[nodiscard]] std::string to_dot() const;  ///< Graphviz

    [[nodiscard]] const gl::TextureDesc& desc(TextureRef ref) const;
    /// Whether it is a texture of this list, in its newest version.
    [[nodiscard]] bool holds(TextureRef ref) const;

  private:
    friend class PassBuilder;
    friend class PassContext;
    struct Resource {
        std::string name;
        gl::TextureDesc desc;
        gl::TextureView texture;  ///< imported, or from the pool during execute
        GLuint buffer = 0;
        bool is_buffer = false, transient = false, exported = false;
        std::uint32_t version = 0;
        int first_use = -1, last_use = -1;  ///< live passes, as indices into passes_
        int slot = -1;                      ///< of a live transient
        History* history = nullptr;         ///< whose current texture it is
    };
    struct Use {
        std::uint32_t resource;
        Access access;
        bool reads, writes;
        int level;  ///< sampled; -1 any
    };
    struct AttachmentUse {
        std::uint32_t resource;
        int level, layer;
        bool depth, writes;
    };
    struct Pass {
        std::vector<Use> uses;
        std::vector<AttachmentUse> attachments;
        Execute execute;
        bool keep = false;
        std::size_t info = 0;
    };
    /// A pooled texture and the transients that use it in turn.
    struct Slot {
        gl::TextureDesc desc;
        int last_use;
        gl::TextureView texture;  ///< during execute
    };

    std::uint32_t add_resource(Resource resource);
    [[nodiscard]] TextureInfo info_of(const Resource& resource) const;
    [[nodiscard]] const Resource& current(std::uint32_t index, std::uint32_t version) const;
    [[nodiscard]] const Resource& used_by(std::size_t pass, std::uint32_t index) const;
    void check_contents() const;
    void check_feedback(const Pass& pass) const;
    void cull();
    void assign_slots();
    void derive_barriers();
    void bind_slots();
    void label_first_uses(std::size_t pass);
    void end_histories(std::size_t pass);
    void bind_framebuffer(std::size_t pass) const;

    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
    std::vector<PassInfo> infos_;
    std::vector<Slot> slots_;
    TransientPool* pool_ = nullptr;  ///< during execute
    bool compiled_ = false;
};

}  // namespace tyndall
