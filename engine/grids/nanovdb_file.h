#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tyndall::grids {

/// A grid's bytes as they lie in memory, decompressed and aligned as NanoVDB wants them.
class NanoBuffer {
  public:
    static constexpr std::size_t alignment = 32;

    explicit NanoBuffer(std::size_t size) : chunks_((size + alignment - 1) / alignment), size_(size) {}
    [[nodiscard]] std::span<std::byte> bytes() { return {chunks_.data()->bytes, size_}; }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {chunks_.data()->bytes, size_}; }

  private:
    struct alignas(alignment) Chunk {
        std::byte bytes[alignment];
    };
    std::vector<Chunk> chunks_;
    std::size_t size_;
};

/// NanoVDB's own reader takes sizes on trust, and damaged data for whole. Throws Unreadable.
[[nodiscard]] NanoBuffer read_nanovdb_grid(const std::filesystem::path& file, const std::string& name);

}  // namespace tyndall::grids
