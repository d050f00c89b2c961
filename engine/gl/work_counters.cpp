#include "engine/gl/work_counters.h"

#include <algorithm>

#include "engine/core/check.h"
#include "shaders/shared/bindings.h"

namespace tyndall::gl {
namespace {

constexpr std::size_t max_passes = 64;
constexpr std::size_t kinds = static_cast<std::size_t>(Work::count);

/// As shaders/lib/work.glsl declares it: 64-bit counters as (low, high) words.
struct Slot {
    std::uint32_t words[kinds][2];
};

std::size_t slot_stride() {
    GLint alignment = 1;
    glGetIntegerv(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT, &alignment);
    const auto unit = static_cast<std::size_t>(alignment);
    return (sizeof(Slot) + unit - 1) / unit * unit;
}

}  // namespace

const char* to_string(Work work) {
    constexpr const char* names[] = {"medium_samples", "shadow_lookups", "light_evaluations", "texture_fetches",
                                     "tree_nodes",     "grid_reads",     "grid_light_reads",  "grid_page_reads"};
    static_assert(std::size(names) == kinds);
    TYNDALL_CHECK_LT(static_cast<std::size_t>(work), kinds);
    return names[static_cast<std::size_t>(work)];
}

void WorkCounters::begin_frame() {
    if (!buffer_) buffer_ = Buffer(max_passes * slot_stride(), "work counters");
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    buffer_.clear_uint(0);
    passes_.clear();
}

void WorkCounters::begin_pass(const std::string& name) {
    TYNDALL_CHECK_LT(passes_.size(), max_passes);
    TYNDALL_CHECK(buffer_);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, BINDING_WORK, buffer_.id(),
                      static_cast<GLintptr>(passes_.size() * slot_stride()), sizeof(Slot));
    passes_.push_back(name);
}

std::vector<std::pair<std::string, WorkCounts>> WorkCounters::read() const {
    std::vector<std::pair<std::string, WorkCounts>> result;
    for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
        Slot slot;
        buffer_.read(pass * slot_stride(), sizeof slot, &slot);
        WorkCounts counts{};
        for (std::size_t kind = 0; kind < kinds; ++kind)
            counts[kind] = (std::uint64_t{slot.words[kind][1]} << 32U) | slot.words[kind][0];
        if (std::ranges::any_of(counts, [](std::uint64_t n) { return n > 0; }))
            result.emplace_back(passes_[pass], counts);
    }
    return result;
}

}  // namespace tyndall::gl
