#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tyndall::noise {

/// Scalar noise that tiles in space and in time: `depth` slices of side x side bytes, x fastest, then y, then the
/// slice. A byte b stands for (b + 0.5) / 256.
struct Volume {
    int side = 0, depth = 0;  ///< powers of two
    std::vector<std::uint8_t> bytes = {};

    [[nodiscard]] std::size_t slice_size() const { return static_cast<std::size_t>(side) * side; }
    [[nodiscard]] std::size_t size() const { return slice_size() * depth; }
};

}  // namespace tyndall::noise
