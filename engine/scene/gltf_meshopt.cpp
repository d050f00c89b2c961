#include "engine/scene/gltf_meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace tyndall::gltf {
namespace {

using Filter = void (*)(void* data, std::size_t count, std::size_t stride);

using Decode = int (*)(void* to, std::size_t count, std::size_t stride, const unsigned char* from,
                       std::size_t size);

/// Of attributes, where their stride suits it; null where it does not.
Filter filter_of(const MeshoptView& view) {
    if (view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) return meshopt_decodeFilterOct;
    if (view.filter == "QUATERNION" && view.stride == 8) return meshopt_decodeFilterQuat;
    if (view.filter == "EXPONENTIAL") return meshopt_decodeFilterExp;
    return nullptr;
}

}  // namespace

std::vector<std::uint8_t> decode_meshopt(std::span<const std::uint8_t> compressed, const MeshoptView& view,
                                         const std::function<void(const std::string&)>& fail) {
    const auto [mode, filter, count, stride] = view;
    const bool attributes = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
    if (!attributes && !triangles && mode != "INDICES")
        fail(fmt::format("mode {} given, ATTRIBUTES, TRIANGLES or INDICES expected", mode));
    if (attributes ? stride == 0 || stride % 4 != 0 || stride > 256 : stride != 2 && stride != 4)
        fail(fmt::format("byteStride {} given, {} expected", stride,
                         attributes ? "a multiple of 4 up to 256" : "2 or 4"));
    const Filter unfilter = attributes ? filter_of(view) : nullptr;
    if (filter != "NONE" && unfilter == nullptr)
        fail(fmt::format("filter {} is not for {} of {} bytes", filter, mode, stride));
    // No byte of the codecs stands for more than 64 of what they decode to; a file's count is not trusted with
    // memory.
    constexpr std::size_t most_ratio = 64;
    if (triangles && count % 3 != 0) fail(fmt::format("{} indices are not whole triangles", count));
    if (count == 0 || count > most_ratio * compressed.size() / stride + 256)
        fail(fmt::format("count {} does not fit its {} bytes", count, compressed.size()));

    std::vector<std::uint8_t> data(count * stride);
    Decode decode = meshopt_decodeIndexSequence;
    if (attributes) decode = meshopt_decodeVertexBuffer;
    if (triangles) decode = meshopt_decodeIndexBuffer;
    if (decode(data.data(), count, stride, compressed.data(), compressed.size()) != 0)
        fail(fmt::format("{} bytes that are no {} {} of {} bytes", compressed.size(), count, mode, stride));
    if (unfilter != nullptr) unfilter(data.data(), count, stride);
    return data;
}

}  // namespace tyndall::gltf
