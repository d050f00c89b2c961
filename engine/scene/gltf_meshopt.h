#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tyndall::gltf {

/// What EXT_meshopt_compression says of a buffer view.
struct MeshoptView {
    std::string mode;             ///< ATTRIBUTES, TRIANGLES, INDICES
    std::string filter = "NONE";  ///< or OCTAHEDRAL, QUATERNION, EXPONENTIAL
    std::size_t count = 0;        ///< elements
    std::size_t stride = 0;       ///< bytes of one
};

/// The count * stride bytes that `compressed` stands for. Whatever it holds, nothing outside of it is read; `fail`
/// is called with what is wrong and throws.
[[nodiscard]] std::vector<std::uint8_t> decode_meshopt(std::span<const std::uint8_t> compressed,
                                                       const MeshoptView& view,
                                                       const std::function<void(const std::string&)>& fail);

}  // namespace tyndall::gltf
