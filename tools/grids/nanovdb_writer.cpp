#include "tools/grids/nanovdb_writer.h"

#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <sstream>

namespace tyndall::grid_models {

std::string to_nanovdb(const Voxels& voxels) {
    nanovdb::GridBuilder<float, nanovdb::Fp8> builder(0, nanovdb::GridClass::FogVolume);
    builder.setChecksum(nanovdb::ChecksumMode::Full);
    auto accessor = builder.getAccessor();
    for (int z = 0; z < voxels.size.z; ++z)
        for (int y = 0; y < voxels.size.y; ++y)
            for (int x = 0; x < voxels.size.x; ++x)
                if (const float value = voxels.at(x, y, z); value > 0) accessor.setValue({x, y, z}, value);

    // NanoVDB leaves padding as it finds it: in memory of zeros the bytes depend on the voxels alone.
    struct alignas(NANOVDB_DATA_ALIGNMENT) Chunk {
        char bytes[NANOVDB_DATA_ALIGNMENT];
    };
    constexpr std::size_t enough = std::size_t{64} << 20U;
    std::vector<Chunk> zeros(enough / sizeof(Chunk));
    const auto pool = nanovdb::HostBuffer::createPool(enough, zeros.data());
    const nanovdb::Vec3d origin(double(voxels.first_voxel.x), double(voxels.first_voxel.y),
                                double(voxels.first_voxel.z));
    const auto handle = builder.getHandle(double(voxels.voxel_size), origin, "density", nanovdb::AbsDiff(), pool);
    std::ostringstream file(std::string(4096, '\0'));  // NanoVDB seeks beyond its heads before it writes them
    nanovdb::io::writeGrid(file, handle, nanovdb::io::Codec::ZIP);
    return file.str().substr(0, static_cast<std::size_t>(file.tellp()));
}

}  // namespace tyndall::grid_models
