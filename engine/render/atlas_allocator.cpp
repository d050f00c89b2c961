#include "engine/render/atlas_allocator.h"

#include <bit>

#include "engine/core/check.h"

namespace tyndall {
namespace {

// A Morton index: bits of x and y in turn, so that the four quarters of square m are 4m .. 4m + 3.
unsigned morton(glm::uvec2 cell) {
    unsigned index = 0;
    for (unsigned bit = 0; bit < 16; ++bit)
        index |= (cell.x >> bit & 1u) << (2 * bit) | (cell.y >> bit & 1u) << (2 * bit + 1);
    return index;
}

glm::ivec2 cell_of(unsigned index) {
    glm::uvec2 cell{0};
    for (unsigned bit = 0; bit < 16; ++bit) {
        cell.x |= (index >> (2 * bit) & 1u) << bit;
        cell.y |= (index >> (2 * bit + 1) & 1u) << bit;
    }
    return cell;
}

}  // namespace

AtlasAllocator::AtlasAllocator(int size, int smallest) : size_(size), smallest_(smallest) {
    TYNDALL_CHECK(std::has_single_bit(static_cast<unsigned>(size)));
    TYNDALL_CHECK(std::has_single_bit(static_cast<unsigned>(smallest)));
    TYNDALL_CHECK_LE(smallest, size);
    clear();
}

void AtlasAllocator::clear() {
    free_.assign(level_of(smallest_) + 1, {});
    free_[0].insert(0);
}

int AtlasAllocator::level_of(int size) const {
    return std::countr_zero(static_cast<unsigned>(size_)) - std::countr_zero(static_cast<unsigned>(size));
}

std::optional<AtlasTile> AtlasAllocator::allocate(int size) {
    TYNDALL_CHECK(std::has_single_bit(static_cast<unsigned>(size)));
    TYNDALL_CHECK(size >= smallest_ && size <= size_);
    const int wanted = level_of(size);
    int level = wanted;
    while (level >= 0 && free_[level].empty()) --level;
    if (level < 0) return std::nullopt;
    unsigned index = *free_[level].begin();
    free_[level].erase(free_[level].begin());
    while (level < wanted) {
        ++level;
        index *= 4;
        free_[level].insert({index + 1, index + 2, index + 3});
    }
    return AtlasTile{cell_of(index) * size, size};
}

void AtlasAllocator::free(const AtlasTile& tile) {
    int level = level_of(tile.size);
    unsigned index = morton(tile.origin / tile.size);
    while (level > 0) {
        const unsigned first = index & ~3u;
        int others = 0;
        for (unsigned i = first; i < first + 4; ++i)
            if (i != index) others += static_cast<int>(free_[level].count(i));
        if (others < 3) break;
        for (unsigned i = first; i < first + 4; ++i) free_[level].erase(i);
        index /= 4;
        --level;
    }
    const bool was_taken = free_[level].insert(index).second;
    TYNDALL_CHECK(was_taken);
}

long long AtlasAllocator::free_area() const {
    long long area = 0;
    for (std::size_t level = 0; level < free_.size(); ++level) {
        const long long side = size_ >> level;
        area += side * side * static_cast<long long>(free_[level].size());
    }
    return area;
}

}  // namespace tyndall
