#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <vector>

namespace tyndall {

/// A square of an atlas, in texels from the lower left.
struct AtlasTile {
    glm::ivec2 origin{0};
    int size = 0;
    friend bool operator==(const AtlasTile&, const AtlasTile&) = default;
};

/// Buddy allocation of squares whose sides are powers of two: a free square is split into four until it fits, and
/// four free quarters join again. Squares given out in falling size fill an empty atlas without gaps. The same
/// calls give the same places.
class AtlasAllocator {
  public:
    AtlasAllocator() = default;
    /// Both powers of two, smallest <= size.
    AtlasAllocator(int size, int smallest);
    /// A free square, lowest in Morton order of the least split size that holds one; nothing when there is none.
    /// `size` is a power of two from smallest to the atlas' size.
    [[nodiscard]] std::optional<AtlasTile> allocate(int size);
    /// Takes back a square that `allocate` gave.
    void free(const AtlasTile& tile);
    void clear();
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] long long free_area() const;

  private:
    [[nodiscard]] int level_of(int size) const;
    int size_ = 0, smallest_ = 0;
    // Per level (0 the whole atlas, each next half the side): Morton indices of the free squares.
    std::vector<std::set<unsigned>> free_;
};

}  // namespace tyndall
