#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall::gltf {

/// What is done to a file's bytes before tinygltf reads them, which takes much on trust: the lengths of chunks, how
/// deep JSON is nested, and members of a wrong type, which it passes over in silence. `fail` is called with what is
/// wrong and throws.
using Fail = std::function<void(const std::string&)>;

struct Document {
    std::vector<std::uint8_t> bytes;  ///< as tinygltf understands them
    bool binary = false;
};
[[nodiscard]] Document read_document(std::vector<std::uint8_t> bytes, const Fail& fail);

}  // namespace tyndall::gltf
