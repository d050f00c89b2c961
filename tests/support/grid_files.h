#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace tyndall {

/// A grid that tests write as a .vdb or .nvdb file.
struct TestGrid {
    struct Voxel {
        glm::ivec3 at;
        float value;
    };
    struct Tile {
        glm::ivec3 at;  ///< any voxel in it
        int side;       ///< 8, 128 or 4096
        float value;
        bool active = true;
    };
    enum class Kind { fog, unknown, level_set, staggered };
    enum class Type { single, half, twice, integer, vector };

    std::string name = "density";
    Kind kind = Kind::fog;
    Type type = Type::single;
    float background = 0;
    std::vector<Tile> tiles;
    std::vector<Voxel> voxels;    ///< active
    std::vector<Voxel> inactive;  ///< with a value all the same
    glm::dmat4 index_to_grid{1};
    bool frustum = false;
};

enum class VdbCompression { none, zip, blosc };
void write_vdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids,
               VdbCompression compression = VdbCompression::blosc);

enum class NanoBits { full, four, eight, sixteen, varying };
enum class NanoCodec { none, zip, blosc };
/// Grids of types other than single only say that they are of them. A whole checksum covers the leaves too.
void write_nanovdb(const std::filesystem::path& path, const std::vector<TestGrid>& grids,
                   NanoBits bits = NanoBits::full, NanoCodec codec = NanoCodec::none, bool whole_checksum = false);

}  // namespace tyndall
