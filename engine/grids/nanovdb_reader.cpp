#include "engine/grids/nanovdb_reader.h"

#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridChecksum.h>

#include <cstdint>
#include <type_traits>

#include "engine/grids/nanovdb_file.h"

namespace tyndall::grids {
namespace {

/// Walks the nodes of a grid whose offsets may point anywhere.
template <class Build>
class Walk {
  public:
    using Upper = nanovdb::NanoUpper<Build>;
    using Lower = nanovdb::NanoLower<Build>;
    using Leaf = nanovdb::NanoLeaf<Build>;

    Walk(std::span<const std::byte> grid, GridSink& sink) : grid_(grid), sink_(sink) {}

    void run() {
        const auto& tree = *at<nanovdb::TreeData<3>>(sizeof(nanovdb::GridData));
        const auto root_at = static_cast<std::int64_t>(sizeof(nanovdb::GridData) + tree.mNodeOffset[3]);
        using Root = nanovdb::RootData<Upper>;
        const Root& root = *at<Root>(root_at);
        for (std::uint32_t i = 0; i < root.mTableSize; ++i) {
            const auto& tile = *at<typename Root::Tile>(
                root_at + static_cast<std::int64_t>(sizeof(Root) + i * sizeof(typename Root::Tile)));
            const nanovdb::Coord key = tile.origin();
            const glm::ivec3 lower(key[0], key[1], key[2]);
            if (tile.isChild())
                upper(root_at + tile.child, lower);
            else if (tile.isActive())
                emit_tile(lower, 4096, tile.value);
        }
    }

  private:
    template <class T>
    const T* at(std::int64_t offset) const {
        const auto place = static_cast<std::uint64_t>(offset);
        if (place > grid_.size() || grid_.size() - place < sizeof(T) || place % alignof(T) != 0)
            throw Unreadable("damaged: an offset leads out of its grid");
        return reinterpret_cast<const T*>(grid_.data() + place);
    }
    void emit_tile(const glm::ivec3& lower, int side, float value) {
        if (value != 0) sink_.tile(lower, side, value);
    }

    /// child(offset, lowest voxel) for each of an internal node, whose voxels lie as x, y, z, the last the fastest.
    template <class Node, int log_side, class Child>
    void internal(std::int64_t offset, const glm::ivec3& lower, int child_side, Child child) {
        const auto& node = *reinterpret_cast<const typename Node::DataType*>(at<Node>(offset));
        constexpr std::uint32_t side = 1U << log_side;
        for (std::uint32_t i = 0; i < side * side * side; ++i) {
            const glm::ivec3 corner =
                lower + child_side * glm::ivec3(glm::uvec3(i >> (2 * log_side), (i >> log_side) % side, i % side));
            if (node.isChild(i))
                child(offset + node.mTable[i].child, corner);
            else if (node.isActive(i))
                emit_tile(corner, child_side, node.mTable[i].value);
        }
    }
    void upper(std::int64_t offset, const glm::ivec3& lower_corner) {
        internal<Upper, 5>(offset, lower_corner, 128, [&](std::int64_t child, const glm::ivec3& corner) {
            internal<Lower, 4>(child, corner, brick_side, [&](std::int64_t leaf_at, const glm::ivec3& leaf_corner) {
                leaf(leaf_at, leaf_corner);
            });
        });
    }
    void leaf(std::int64_t offset, const glm::ivec3& lower) {
        const auto& data = *reinterpret_cast<const typename Leaf::DataType*>(at<Leaf>(offset));
        if constexpr (std::is_same_v<Build, nanovdb::FpN>) {
            constexpr int widest = 4;  // log2 of bits
            if (data.mFlags >> 5U > widest) throw Unreadable("damaged: a leaf has values of an unknown width");
            (void)at<std::byte>(offset + static_cast<std::int64_t>(data.memUsage()) - 1);
        }
        BrickValues values{};
        for (std::uint32_t i = 0; i < values.size(); ++i)
            if (data.mValueMask.isOn(i)) values[(i % 8) * 64 + (i / 8 % 8) * 8 + i / 64] = data.getValue(i);
        sink_.brick(lower, values);
    }

    std::span<const std::byte> grid_;
    GridSink& sink_;
};

template <class Build>
void read(std::span<const std::byte> bytes, GridSink& sink) {
    Walk<Build>(bytes, sink).run();
    const auto& grid = *reinterpret_cast<const nanovdb::NanoGrid<Build>*>(bytes.data());
    const nanovdb::GridChecksum noted(grid.checksum());
    nanovdb::GridChecksum found;
    found(grid, noted.mode());
    if (noted != found) throw Unreadable("damaged: its checksum is wrong");
}

glm::dmat4 index_to_grid(const nanovdb::Map& map) {
    const auto apply = [&](double x, double y, double z) {
        const nanovdb::Vec3d v = map.applyMap(nanovdb::Vec3d(x, y, z));
        return glm::dvec3(v[0], v[1], v[2]);
    };
    const glm::dvec3 origin = apply(0, 0, 0);
    return {glm::dvec4(apply(1, 0, 0) - origin, 0), glm::dvec4(apply(0, 1, 0) - origin, 0),
            glm::dvec4(apply(0, 0, 1) - origin, 0), glm::dvec4(origin, 1)};
}

}  // namespace

void read_nanovdb(const std::filesystem::path& path, const std::string& name, GridSink& sink) {
    using nanovdb::GridClass, nanovdb::GridType;
    const NanoBuffer buffer = read_nanovdb_grid(path, name);
    const auto bytes = buffer.bytes();
    const auto& data = *reinterpret_cast<const nanovdb::GridData*>(bytes.data());
    if (data.mMagic != NANOVDB_MAGIC_NUMBER || data.mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER ||
        data.mGridType >= GridType::End || data.mGridClass >= GridClass::End)
        throw Unreadable("damaged: the head of its grid is wrong");
    if (data.mGridClass != GridClass::FogVolume && data.mGridClass != GridClass::Unknown)
        throw Unreadable(
            fmt::format("grid \"{}\" is of class {}, a fog volume expected", name, toStr(data.mGridClass)));
    sink.transform(index_to_grid(data.mMap));
    switch (data.mGridType) {
        case GridType::Float:
            return read<float>(bytes, sink);
        case GridType::Fp4:
            return read<nanovdb::Fp4>(bytes, sink);
        case GridType::Fp8:
            return read<nanovdb::Fp8>(bytes, sink);
        case GridType::Fp16:
            return read<nanovdb::Fp16>(bytes, sink);
        case GridType::FpN:
            return read<nanovdb::FpN>(bytes, sink);
        default:
            throw Unreadable(fmt::format("grid \"{}\" is of {}, single-precision numbers expected", name,
                                         toStr(data.mGridType)));
    }
}

}  // namespace tyndall::grids
