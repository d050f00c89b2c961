#include "engine/render/atlas_allocator.h"

#include <gtest/gtest.h>

#include <random>

namespace tyndall {
namespace {

// Counts, in units of the smallest tile, how many squares cover each cell.
class Cover {
  public:
    Cover(int size, int unit) : cells_(size / unit), unit_(unit), count_(cells_ * cells_, 0) {}
    void add(const AtlasTile& tile, int sign) {
        ASSERT_EQ(tile.origin.x % tile.size, 0);
        ASSERT_EQ(tile.origin.y % tile.size, 0);
        for (int y = tile.origin.y / unit_; y < (tile.origin.y + tile.size) / unit_; ++y)
            for (int x = tile.origin.x / unit_; x < (tile.origin.x + tile.size) / unit_; ++x) {
                ASSERT_TRUE(x >= 0 && y >= 0 && x < cells_ && y < cells_);
                int& count = count_[y * cells_ + x];
                count += sign;
                ASSERT_TRUE(count == 0 || count == 1) << "at " << x << ", " << y;
            }
    }

  private:
    int cells_, unit_;
    std::vector<int> count_;
};

TEST(AtlasAllocator, RandomUseNeverOverlapsNorLeavesTheAtlas) {
    std::mt19937 random(7);
    AtlasAllocator atlas(1024, 16);
    Cover cover(1024, 16);
    std::vector<AtlasTile> held;
    long long area = 1024LL * 1024;
    for (int step = 0; step < 5000; ++step) {
        if (random() % 5 < 3 || held.empty()) {
            const int size = 16 << random() % 6;
            const auto tile = atlas.allocate(size);
            if (!tile) continue;
            ASSERT_EQ(tile->size, size);
            cover.add(*tile, 1);
            held.push_back(*tile);
            area -= 1LL * size * size;
        } else {
            const std::size_t i = random() % held.size();
            cover.add(held[i], -1);
            atlas.free(held[i]);
            area += 1LL * held[i].size * held[i].size;
            held.erase(held.begin() + static_cast<std::ptrdiff_t>(i));
        }
        ASSERT_EQ(atlas.free_area(), area);
        if (HasFatalFailure()) return;
    }
    for (const AtlasTile& tile : held) atlas.free(tile);
    EXPECT_TRUE(atlas.allocate(1024)) << "freed squares join to the whole atlas again";
}

TEST(AtlasAllocator, FallingSizesFillTheAtlasCompletely) {
    AtlasAllocator atlas(256, 16);
    int left = 256 * 256;
    for (const int size : {128, 128, 64, 64, 64, 64, 64, 32, 32, 32, 32}) {
        ASSERT_TRUE(atlas.allocate(size)) << size;
        left -= size * size;
    }
    for (; left > 0; left -= 16 * 16) ASSERT_TRUE(atlas.allocate(16));
    EXPECT_FALSE(atlas.allocate(16));
    EXPECT_EQ(atlas.free_area(), 0);
}

TEST(AtlasAllocator, ReusesFreedSpace) {
    AtlasAllocator atlas(64, 16);
    std::vector<AtlasTile> tiles;
    for (int i = 0; i < 4; ++i) tiles.push_back(atlas.allocate(32).value());
    EXPECT_FALSE(atlas.allocate(16));
    atlas.free(tiles[2]);
    EXPECT_EQ(atlas.allocate(32), tiles[2]);
}

TEST(AtlasAllocator, SameCallsGiveSamePlaces) {
    const auto run = [] {
        std::mt19937 random(3);
        AtlasAllocator atlas(512, 16);
        std::vector<AtlasTile> all;
        for (int i = 0; i < 300; ++i) {
            if (const auto tile = atlas.allocate(16 << random() % 3)) all.push_back(*tile);
            if (i % 3 == 0 && !all.empty()) {
                atlas.free(all.back());
                all.pop_back();
            }
        }
        return all;
    };
    EXPECT_EQ(run(), run());
}

TEST(AtlasAllocatorDeathTest, TakingBackTwiceIsAnError) {
    AtlasAllocator atlas(64, 16);
    const AtlasTile tile = atlas.allocate(16).value();
    const AtlasTile kept = atlas.allocate(16).value();  // so that the first one does not join its siblings
    (void)kept;
    atlas.free(tile);
    EXPECT_DEATH(atlas.free(tile), "was_taken");
}

}  // namespace
}  // namespace tyndall
