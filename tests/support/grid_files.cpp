#include "tests/support/grid_files.h"

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>

namespace tyndall {
namespace {

openvdb::Coord as_coord(const glm::ivec3& v) {
    return {v.x, v.y, v.z};
}

openvdb::GridClass as_class(TestGrid::Kind kind) {
    switch (kind) {
        case TestGrid::Kind::fog:
            return openvdb::GRID_FOG_VOLUME;
        case TestGrid::Kind::level_set:
            return openvdb::GRID_LEVEL_SET;
        case TestGrid::Kind::staggered:
            return openvdb::GRID_STAGGERED;
        default:
            return openvdb::GRID_UNKNOWN;
    }
}

/// OpenVDB's matrices are the transposed of glm's, and so are their parentheses.
openvdb::math::Transform::Ptr as_transform(const TestGrid& grid) {
    if (grid.frustum)
        return openvdb::math::Transform::createFrustumTransform(
            openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10.0);
    openvdb::math::Mat4d matrix;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) matrix(column, row) = grid.index_to_grid[column][row];
    return openvdb::math::Transform::createLinearTransform(matrix);
}

openvdb::FloatGrid::Ptr make_density(const TestGrid& from) {
    const auto grid = openvdb::FloatGrid::create(from.background);
    grid->setSaveFloatAsHalf(from.type == TestGrid::Type::half);
    auto& tree = grid->tree();
    for (const TestGrid::Tile& tile : from.tiles) {
        const openvdb::Index level = tile.side == 8 ? 1 : tile.side == 128 ? 2 : 3;
        tree.addTile(level, as_coord(tile.at), tile.value, tile.active);
    }
    for (const TestGrid::Voxel& voxel : from.voxels) tree.setValueOn(as_coord(voxel.at), voxel.value);
    for (const TestGrid::Voxel& voxel : from.inactive) tree.setValueOff(as_coord(voxel.at), voxel.value);
    return grid;
}

/// Those of other types are empty: to fill them takes the compiler as long as all else here.
openvdb::GridBase::Ptr make(const TestGrid& from) {
    const auto grid = [&]() -> openvdb::GridBase::Ptr {
        switch (from.type) {
            case TestGrid::Type::twice:
                return openvdb::GridBase::createGrid("Tree_double_5_4_3");
            case TestGrid::Type::integer:
                return openvdb::GridBase::createGrid("Tree_int32_5_4_3");
            case TestGrid::Type::vector:
                return openvdb::GridBase::createGrid("Tree_vec3s_5_4_3");
            default:
                return make_density(from);
        }
    }();
    grid->setName(from.name);
    grid->setGridClass(as_class(from.kind));
    grid->setTransform(as_transform(from));
    return grid;
}

using Handle = nanovdb::GridHandle<nanovdb::HostBuffer>;

template <class Build>
Handle to_nano(const openvdb::FloatGrid& grid, nanovdb::ChecksumMode checksum) {
    return nanovdb::openToNanoVDB<nanovdb::HostBuffer, openvdb::FloatTree, Build>(
        grid, nanovdb::StatsMode::Default, checksum);
}

Handle to_nano(const openvdb::FloatGrid& grid, NanoBits bits, nanovdb::ChecksumMode checksum) {
    switch (bits) {
        case NanoBits::four:
            return to_nano<nanovdb::Fp4>(grid, checksum);
        case NanoBits::eight:
            return to_nano<nanovdb::Fp8>(grid, checksum);
        case NanoBits::sixteen:
            return to_nano<nanovdb::Fp16>(grid, checksum);
        case NanoBits::varying:
            return to_nano<nanovdb::FpN>(grid, checksum);
        default:
            return to_nano<float>(grid, checksum);
    }
}

Handle to_nano(const TestGrid& from, NanoBits bits, nanovdb::ChecksumMode checksum) {
    TestGrid density = from;
    density.type = TestGrid::Type::single;
    Handle handle = to_nano(*openvdb::gridPtrCast<openvdb::FloatGrid>(make(density)), bits, checksum);
    nanovdb::GridType& type = reinterpret_cast<nanovdb::GridData*>(handle.data())->mGridType;
    if (from.type == TestGrid::Type::twice) type = nanovdb::GridType::Double;
    if (from.type == TestGrid::Type::integer) type = nanovdb::GridType::Int32;
    if (from.type == TestGrid::Type::vector) type = nanovdb::GridType::Vec3f;
    return handle;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids, VdbCompression compression) {
    openvdb::initialize();
    openvdb::GridCPtrVec written;
    for (const TestGrid& grid : grids) written.push_back(make(grid));
    openvdb::io::File file(path.string());
    std::uint32_t flags = openvdb::io::COMPRESS_ACTIVE_MASK;
    if (compression == VdbCompression::zip) flags |= openvdb::io::COMPRESS_ZIP;
    if (compression == VdbCompression::blosc) flags |= openvdb::io::COMPRESS_BLOSC;
    if (compression == VdbCompression::none) flags = openvdb::io::COMPRESS_NONE;
    file.setCompression(flags);
    file.write(written);
}

void write_nanovdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids, NanoBits bits,
                   NanoCodec codec, bool whole_checksum) {
    openvdb::initialize();
    std::vector<Handle> handles;
    for (const TestGrid& grid : grids)
        handles.push_back(to_nano(
            grid, bits, whole_checksum ? nanovdb::ChecksumMode::Full : nanovdb::ChecksumMode::Partial));
    nanovdb::io::writeGrids(path.string(), handles, static_cast<nanovdb::io::Codec>(codec));
}

}  // namespace tyndall
