#include "engine/grids/vdb_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <vector>

namespace tyndall::grids {
namespace {

using Tree = openvdb::FloatTree;

glm::ivec3 as_glm(const openvdb::Coord& c) {
    return {c.x(), c.y(), c.z()};
}
glm::dvec3 as_glm(const openvdb::Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}

void require_grid(const openvdb::io::File& file, const std::string& name) {
    if (file.hasGrid(name)) return;
    std::vector<std::string> names;
    for (auto it = file.beginName(); it != file.endName(); ++it) names.push_back('"' + it.gridName() + '"');
    throw Unreadable(fmt::format("no grid \"{}\"; there {}: {}", name, names.size() == 1 ? "is" : "are",
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

void require_density(const openvdb::GridBase& grid, const std::string& name) {
    const openvdb::GridClass kind = grid.getGridClass();
    if (kind != openvdb::GRID_FOG_VOLUME && kind != openvdb::GRID_UNKNOWN)
        throw Unreadable(fmt::format("grid \"{}\" is a {}, a fog volume expected", name,
                                     openvdb::GridBase::gridClassToString(kind)));
    if (!grid.isType<openvdb::FloatGrid>())
        throw Unreadable(fmt::format("grid \"{}\" is of {} ({}), single-precision numbers expected", name,
                                     grid.valueType(), grid.type()));
    if (!grid.transform().isLinear())
        throw Unreadable(
            fmt::format("grid \"{}\" has a {}, an affine transform expected", name, grid.transform().mapType()));
}

glm::dmat4 index_to_grid(const openvdb::math::Transform& transform) {
    const glm::dvec3 origin = as_glm(transform.indexToWorld(openvdb::Vec3d(0, 0, 0)));
    glm::dmat4 matrix{1};
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d unit(0, 0, 0);
        unit[axis] = 1;
        matrix[axis] = glm::dvec4(as_glm(transform.indexToWorld(unit)) - origin, 0);
    }
    matrix[3] = glm::dvec4(origin, 1);
    return matrix;
}

BrickValues active_values(const Tree::LeafNodeType& leaf) {
    BrickValues values{};
    for (auto it = leaf.cbeginValueOn(); it; ++it) {
        const openvdb::Coord at = Tree::LeafNodeType::offsetToLocalCoord(it.pos());
        values[static_cast<std::size_t>(at.x() + brick_side * (at.y() + brick_side * at.z()))] = *it;
    }
    return values;
}

}  // namespace

void read_vdb(const std::filesystem::path& path, const std::string& name, GridSink& sink) {
    openvdb::initialize();
    openvdb::io::File file(path.string());
    file.setCopyMaxBytes(0);
    constexpr bool only_as_needed = false;
    file.open(only_as_needed);
    require_grid(file, name);
    require_density(*file.readGridMetadata(name), name);
    const auto grid = openvdb::gridConstPtrCast<openvdb::FloatGrid>(file.readGrid(name));
    require_density(*grid, name);

    sink.transform(index_to_grid(grid->transform()));
    const Tree& tree = grid->tree();
    Tree::ValueOnCIter tile = tree.cbeginValueOn();
    for (tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1); tile; ++tile) {
        if (*tile == 0) continue;
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        sink.tile(as_glm(box.min()), box.dim().x(), *tile);
    }
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) sink.brick(as_glm(leaf->origin()), active_values(*leaf));
}

}  // namespace tyndall::grids
