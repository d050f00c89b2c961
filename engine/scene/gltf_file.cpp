#include "engine/scene/gltf_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>

#include "engine/core/files.h"
#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_meshopt.h"

namespace tyndall::gltf {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* supported_extensions[] = {"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                                "KHR_materials_ior",          "KHR_materials_specular",
                                                "KHR_materials_transmission", "KHR_materials_unlit",
                                                "KHR_mesh_quantization",      "KHR_texture_transform",
                                                "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression"};

/// Files that the glTF names, read through tinygltf's callbacks, from inside the scene's folder only.
struct SceneFolder {
    std::filesystem::path path;
    std::string first_error;
};

bool read_scene_file(Bytes* out, std::string*, const std::string& uri, void* user) {
    auto& folder = *static_cast<SceneFolder*>(user);
    try {
        *out = read_bytes(resolve_inside(folder.path, uri));
        return true;
    } catch (const Error& e) {
        if (folder.first_error.empty()) folder.first_error = e.what();
        return false;
    }
}

/// Every name is handed to read_scene_file as it is: tinygltf's own search would look in the working folder too.
tinygltf::FsCallbacks scene_folder_only(SceneFolder& folder) {
    return {[](const std::string&, void*) { return true; }, [](const std::string& uri, void*) { return uri; },
            read_scene_file, [](std::string*, const std::string&, const Bytes&, void*) { return false; }, &folder};
}

/// Keeps the encoded bytes of a picture in a file or a data URI. Those in a buffer view are read later, when the
/// view's range is checked: tinygltf passes a pointer it has not checked.
bool keep_encoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string_view as_text(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

double component(const std::uint8_t* p, int type, bool normalized) {
    const auto read = [&]<class T>(T value) {
        std::memcpy(&value, p, sizeof value);
        const auto v = static_cast<double>(value);
        if (std::is_floating_point_v<T> || !normalized) return v;
        return std::max(v / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
    };
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read(std::uint32_t{});
        default:
            return read(float{});
    }
}

/// Bytes of a component of a type that glTF allows in accessors; 0 for others.
std::size_t component_size(int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_INT || type == TINYGLTF_COMPONENT_TYPE_DOUBLE) return 0;
    return static_cast<std::size_t>(std::max(tinygltf::GetComponentSizeInBytes(static_cast<unsigned>(type)), 0));
}

}  // namespace

std::string one_line(std::string text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    constexpr std::size_t longest = 400;
    if (text.size() > longest) text = text.substr(0, longest - 3) + "...";
    return text;
}

GltfFile::GltfFile(std::filesystem::path path) : path_(std::move(path)) {
    const auto [bytes, binary] =
        read_document(read_bytes(path_), [this](const std::string& what) { fail("{}", what); });

    SceneFolder folder{path_.parent_path().empty() ? "." : path_.parent_path(), {}};
    tinygltf::TinyGLTF parser;
    parser.SetStoreOriginalJSONForExtrasAndExtensions(true);
    parser.SetImageLoader(keep_encoded, nullptr);
    parser.SetFsCallbacks(scene_folder_only(folder));
    std::string error, warning;
    bool parsed = false;
    try {
        const auto size = static_cast<unsigned>(bytes.size());
        parsed = binary ? parser.LoadBinaryFromMemory(&model_, &error, &warning, bytes.data(), size, "")
                        : parser.LoadASCIIFromString(&model_, &error, &warning, as_text(bytes).data(), size, "");
    } catch (const std::exception& e) {
        error += e.what();
    }
    check_extensions();  // first: why a file does not load is often the extension it requires
    if (!folder.first_error.empty()) fail("{}", folder.first_error);
    if (!parsed || !error.empty()) fail("not a valid glTF 2.0 file: {}", one_line(error));
    if (!model_.asset.version.starts_with("2.")) fail("glTF version {}, 2.0 expected", model_.asset.version);
    const std::string& least = model_.asset.minVersion;
    if (!least.empty() && least != "2.0") fail("asks for glTF {} at least, 2.0 is supported", least);
    decompress_views();
}

void GltfFile::decompress_views() {
    constexpr const char* name = "EXT_meshopt_compression";
    for (std::size_t i = 0; i < model_.bufferViews.size(); ++i) {
        const tinygltf::BufferView& view = model_.bufferViews[i];
        if (!view.extensions.contains(name)) continue;
        const std::string what = fmt::format("buffer view {}: {}", i, name);
        const auto whole = [&](const char* key) -> std::size_t {
            const tinygltf::Value* value = extension(view, name, key);
            const double number = value == nullptr ? 0 : value->GetNumberAsDouble();
            constexpr double most = std::numeric_limits<std::uint32_t>::max();
            if (!(number >= 0 && number <= most))
                fail("{}: {} {} given, 0 to {} expected", what, key, number, most);
            return static_cast<std::size_t>(number);
        };
        const auto text = [&](const char* key, const char* otherwise) {
            const tinygltf::Value* value = extension(view, name, key);
            return value == nullptr ? otherwise : value->Get<std::string>();
        };
        const std::size_t offset = whole("byteOffset"), length = whole("byteLength");
        const Bytes& data = at(model_.buffers, static_cast<int>(whole("buffer")), what + ": buffer").data;
        if (offset > data.size() || length > data.size() - offset)
            fail("{}: ends outside its buffer of {} bytes", what, data.size());
        decompressed_[static_cast<int>(i)] =
            decode_meshopt(std::span(data).subspan(offset, length),
                           {.mode = text("mode", "none"),
                            .filter = text("filter", "NONE"),
                            .count = whole("count"),
                            .stride = whole("byteStride")},
                           [&](const std::string& wrong) { fail("{}: {}", what, wrong); });
    }
}

void GltfFile::check_extensions() const {
    const auto known = [](const std::string& name) {
        return std::ranges::find(supported_extensions, name) != std::end(supported_extensions);
    };
    for (const std::string& name : model_.extensionsRequired)
        if (!known(name)) fail("requires the extension {}, which is not supported", name);
    std::vector<std::string> ignored = model_.extensionsUsed;
    std::erase_if(ignored, known);
    if (!ignored.empty()) skip("extensions ignored: {}", fmt::join(ignored, ", "));
}

float GltfFile::number(double value, const std::string& what, double min, double max) const {
    const auto result = static_cast<float>(value);
    if (!std::isfinite(result) || value < min || value > max)
        fail("{}: {} given, a number in [{}, {}] expected", what, value, min, max);
    return result;
}

float GltfFile::number(const Json& value, const std::string& what, double min, double max) const {
    if (!value.is_number()) fail("{}: a number expected", what);
    return number(value.get<double>(), what, min, max);
}

bool GltfFile::boolean(const Json& value, const std::string& what) const {
    if (value.is_boolean()) return value.get<bool>();
    if (value != 0 && value != 1) fail("{}: true or false expected", what);
    return value == 1;  // modelling programs without a boolean property write 0 and 1
}

glm::quat GltfFile::quaternion(glm::vec4 xyzw, const std::string& what) const {
    const float length = glm::length(xyzw);
    if (!(length > 1e-6f) || !std::isfinite(length)) fail("{}: a unit quaternion expected", what);
    return glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z) / length;
}

std::span<const std::uint8_t> GltfFile::view_bytes(int index, std::size_t offset, const std::string& what) const {
    const tinygltf::BufferView& view = at(model_.bufferViews, index, what + ": buffer view");
    if (const auto found = decompressed_.find(index); found != decompressed_.end()) {
        if (offset > found->second.size()) fail("{}: starts outside its buffer view {}", what, index);
        return std::span(found->second).subspan(offset);
    }
    const Bytes& data = at(model_.buffers, view.buffer, what + ": buffer").data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail("{}: buffer view {} ends outside its buffer of {} bytes", what, index, data.size());
    if (offset > view.byteLength) fail("{}: starts outside its buffer view {}", what, index);
    return std::span(data).subspan(view.byteOffset + offset, view.byteLength - offset);
}

/// Calls `element(i, pointer)` for `count` elements of `size` bytes, after checking that all lie in the view.
template <class Visit>
void GltfFile::visit(int view, std::size_t offset, std::size_t count, std::size_t size, const std::string& what,
                     Visit element) const {
    const auto bytes = view_bytes(view, offset, what);
    const std::size_t stride = std::max(model_.bufferViews[static_cast<std::size_t>(view)].byteStride, size);
    if (bytes.size() < size || count - 1 > (bytes.size() - size) / stride)
        fail("{}: {} elements do not fit in the {} bytes of buffer view {}", what, count, bytes.size(), view);
    for (std::size_t i = 0; i < count; ++i) element(i, bytes.data() + i * stride);
}

std::vector<double> GltfFile::read(int index, int type, const std::string& name) const {
    const std::string what = fmt::format("{} (accessor {})", name, index);
    const tinygltf::Accessor& accessor = at(model_.accessors, index, name + ": accessor");
    const std::size_t bytes = component_size(accessor.componentType);
    if (accessor.type != type) fail("{}: has the wrong type", what);
    if (bytes == 0) fail("{}: component type {} is not allowed", what, accessor.componentType);
    if (accessor.count == 0) fail("{}: has no elements", what);
    constexpr std::size_t most_without_data = std::size_t(1) << 24;
    if (accessor.bufferView < 0 && accessor.count > most_without_data)
        fail("{}: {} elements and no buffer view, at most {} expected", what, accessor.count, most_without_data);

    const auto components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<unsigned>(type)));
    const std::size_t size = components * bytes;
    std::vector<double> values;
    const auto store = [&](std::size_t i, const std::uint8_t* p) {
        for (std::size_t c = 0; c < components; ++c) {
            const double v = component(p + c * bytes, accessor.componentType, accessor.normalized);
            if (!std::isfinite(v)) fail("{}: element {} is not a finite number", what, i);
            values[i * components + c] = v;
        }
    };
    if (accessor.bufferView >= 0) {
        // Checked before anything is allocated for a count that the file cannot hold.
        visit(accessor.bufferView, accessor.byteOffset, accessor.count, size, what, [](auto, auto) {});
        values.resize(accessor.count * components);
        visit(accessor.bufferView, accessor.byteOffset, accessor.count, size, what, store);
    } else {
        values.resize(accessor.count * components);
    }
    if (accessor.sparse.isSparse) replace_sparse(accessor, size, what, store);
    return values;
}

template <class Store>
void GltfFile::replace_sparse(const tinygltf::Accessor& accessor, std::size_t size, const std::string& what,
                              Store store) const {
    const auto& sparse = accessor.sparse;
    const std::size_t index_size = component_size(sparse.indices.componentType);
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count || index_size == 0 ||
        sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        fail("{}: its sparse part is damaged", what);
    const auto count = static_cast<std::size_t>(sparse.count);
    std::vector<std::size_t> targets(count);
    visit(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size, what,
          [&](std::size_t i, const std::uint8_t* p) {
              const double target = component(p, sparse.indices.componentType, false);
              if (!(target >= 0 && target < static_cast<double>(accessor.count)))
                  fail("{}: sparse index {} is out of range", what, target);
              targets[i] = static_cast<std::size_t>(target);
          });
    visit(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, size, what,
          [&](std::size_t i, const std::uint8_t* p) { store(targets[i], p); });
}

}  // namespace tyndall::gltf
