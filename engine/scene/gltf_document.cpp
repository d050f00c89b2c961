#include "engine/scene/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall::gltf {
namespace {

using Json = nlohmann::json;

enum class Kind { number, whole, flag, text, object, numbers, wholes, texts, list, wholes_by_name };

const char* name_of(Kind kind) {
    switch (kind) {
        case Kind::number:
            return "a number";
        case Kind::whole:
            return "a whole number";
        case Kind::flag:
            return "true or false";
        case Kind::text:
            return "text";
        case Kind::object:
            return "an object";
        case Kind::numbers:
            return "a list of numbers";
        case Kind::wholes:
            return "a list of whole numbers";
        case Kind::texts:
            return "a list of texts";
        case Kind::list:
            return "a list of objects";
        case Kind::wholes_by_name:
            return "an object of whole numbers";
    }
    return "";
}

bool is_whole(const Json& value) {
    return value.is_number_integer() || (value.is_number_float() && std::floor(value.get<double>()) == value);
}

bool is_a(const Json& value, Kind kind) {
    const auto all = [&](auto accept) { return std::all_of(value.begin(), value.end(), accept); };
    switch (kind) {
        case Kind::number:
            return value.is_number();
        case Kind::whole:
            return is_whole(value);
        case Kind::flag:
            return value.is_boolean();
        case Kind::text:
            return value.is_string();
        case Kind::object:
            return value.is_object();
        case Kind::numbers:
            return value.is_array() && all([](const Json& v) { return v.is_number(); });
        case Kind::wholes:
            return value.is_array() && all(is_whole);
        case Kind::texts:
            return value.is_array() && all([](const Json& v) { return v.is_string(); });
        case Kind::list:
            return value.is_array() && all([](const Json& v) { return v.is_object(); });
        case Kind::wholes_by_name:
            return value.is_object() && all(is_whole);
    }
    return false;
}

/// Of the members that are read, what glTF 2.0 and the supported extensions say they are. [] stands for each
/// element.
struct Row {
    const char* path;
    Kind kind;
};
constexpr Row rows[] = {
    {"asset", Kind::object},
    {"asset.version", Kind::text},
    {"asset.minVersion", Kind::text},
    {"extensionsUsed", Kind::texts},
    {"extensionsRequired", Kind::texts},
    {"extensions", Kind::object},
    {"extensions.KHR_lights_punctual", Kind::object},
    {"extensions.KHR_lights_punctual.lights", Kind::list},
    {"extensions.KHR_lights_punctual.lights[].name", Kind::text},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::text},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot", Kind::object},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number},
    {"scene", Kind::whole},
    {"scenes", Kind::list},
    {"scenes[].nodes", Kind::wholes},
    {"nodes", Kind::list},
    {"nodes[].name", Kind::text},
    {"nodes[].camera", Kind::whole},
    {"nodes[].mesh", Kind::whole},
    {"nodes[].skin", Kind::whole},
    {"nodes[].children", Kind::wholes},
    {"nodes[].matrix", Kind::numbers},
    {"nodes[].translation", Kind::numbers},
    {"nodes[].rotation", Kind::numbers},
    {"nodes[].scale", Kind::numbers},
    {"nodes[].extensions", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual", Kind::object},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::whole},
    {"nodes[].extensions.EXT_mesh_gpu_instancing", Kind::object},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", Kind::wholes_by_name},
    {"meshes", Kind::list},
    {"meshes[].name", Kind::text},
    {"meshes[].primitives", Kind::list},
    {"meshes[].primitives[].attributes", Kind::wholes_by_name},
    {"meshes[].primitives[].indices", Kind::whole},
    {"meshes[].primitives[].material", Kind::whole},
    {"meshes[].primitives[].mode", Kind::whole},
    {"accessors", Kind::list},
    {"accessors[].bufferView", Kind::whole},
    {"accessors[].byteOffset", Kind::whole},
    {"accessors[].componentType", Kind::whole},
    {"accessors[].count", Kind::whole},
    {"accessors[].type", Kind::text},
    {"accessors[].normalized", Kind::flag},
    {"accessors[].sparse", Kind::object},
    {"accessors[].sparse.count", Kind::whole},
    {"accessors[].sparse.indices.bufferView", Kind::whole},
    {"accessors[].sparse.indices.byteOffset", Kind::whole},
    {"accessors[].sparse.indices.componentType", Kind::whole},
    {"accessors[].sparse.values.bufferView", Kind::whole},
    {"accessors[].sparse.values.byteOffset", Kind::whole},
    {"bufferViews", Kind::list},
    {"bufferViews[].buffer", Kind::whole},
    {"bufferViews[].byteOffset", Kind::whole},
    {"bufferViews[].byteLength", Kind::whole},
    {"bufferViews[].byteStride", Kind::whole},
    {"bufferViews[].extensions", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression", Kind::object},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", Kind::whole},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", Kind::text},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", Kind::text},
    {"buffers", Kind::list},
    {"buffers[].byteLength", Kind::whole},
    {"buffers[].uri", Kind::text},
    {"buffers[].extensions", Kind::object},
    {"buffers[].extensions.EXT_meshopt_compression", Kind::object},
    {"buffers[].extensions.EXT_meshopt_compression.fallback", Kind::flag},
    {"images", Kind::list},
    {"images[].name", Kind::text},
    {"images[].uri", Kind::text},
    {"images[].mimeType", Kind::text},
    {"images[].bufferView", Kind::whole},
    {"textures", Kind::list},
    {"textures[].source", Kind::whole},
    {"textures[].sampler", Kind::whole},
    {"samplers", Kind::list},
    {"samplers[].magFilter", Kind::whole},
    {"samplers[].minFilter", Kind::whole},
    {"samplers[].wrapS", Kind::whole},
    {"samplers[].wrapT", Kind::whole},
    {"materials", Kind::list},
    {"materials[].name", Kind::text},
    {"materials[].alphaMode", Kind::text},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::flag},
    {"materials[].emissiveFactor", Kind::numbers},
    {"materials[].emissiveTexture", Kind::object},
    {"materials[].emissiveTexture.index", Kind::whole},
    {"materials[].emissiveTexture.texCoord", Kind::whole},
    {"materials[].normalTexture", Kind::object},
    {"materials[].normalTexture.index", Kind::whole},
    {"materials[].normalTexture.texCoord", Kind::whole},
    {"materials[].normalTexture.scale", Kind::number},
    {"materials[].occlusionTexture", Kind::object},
    {"materials[].occlusionTexture.index", Kind::whole},
    {"materials[].occlusionTexture.texCoord", Kind::whole},
    {"materials[].occlusionTexture.strength", Kind::number},
    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers},
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.baseColorTexture", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorTexture.index", Kind::whole},
    {"materials[].pbrMetallicRoughness.baseColorTexture.texCoord", Kind::whole},
    {"materials[].pbrMetallicRoughness.metallicRoughnessTexture", Kind::object},
    {"materials[].pbrMetallicRoughness.metallicRoughnessTexture.index", Kind::whole},
    {"materials[].pbrMetallicRoughness.metallicRoughnessTexture.texCoord", Kind::whole},
    {"materials[].extensions", Kind::object},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::number},
    {"materials[].extensions.KHR_materials_ior.ior", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularFactor", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor", Kind::numbers},
    {"materials[].extensions.KHR_materials_transmission.transmissionFactor", Kind::number},
    {"cameras", Kind::list},
    {"cameras[].name", Kind::text},
    {"cameras[].type", Kind::text},
    {"cameras[].perspective", Kind::object},
    {"cameras[].perspective.yfov", Kind::number},
    {"cameras[].perspective.znear", Kind::number},
    {"skins", Kind::list},
    {"skins[].joints", Kind::wholes},
    {"skins[].inverseBindMatrices", Kind::whole},
    {"animations", Kind::list},
    {"animations[].name", Kind::text},
    {"animations[].channels", Kind::list},
    {"animations[].channels[].sampler", Kind::whole},
    {"animations[].channels[].target", Kind::object},
    {"animations[].channels[].target.node", Kind::whole},
    {"animations[].channels[].target.path", Kind::text},
    {"animations[].samplers", Kind::list},
    {"animations[].samplers[].input", Kind::whole},
    {"animations[].samplers[].output", Kind::whole},
    {"animations[].samplers[].interpolation", Kind::text},
};

/// Follows the rest of a row's path from `json`, whose own path is `where`.
void check(const Json& json, std::string_view path, Kind kind, const std::string& where, const Fail& fail) {
    if (path.empty()) {
        if (is_a(json, kind)) return;
        return fail(fmt::format("{}: {} given, {} expected", where,
                                json.dump(-1, ' ', true, Json::error_handler_t::replace).substr(0, 60),
                                name_of(kind)));
    }
    if (path.starts_with("[]")) {
        for (std::size_t i = 0; json.is_array() && i < json.size(); ++i)
            check(json[i], path.substr(2), kind, fmt::format("{}[{}]", where, i), fail);
        return;
    }
    if (path.starts_with(".")) path.remove_prefix(1);
    const std::string key(path.substr(0, path.find_first_of(".[")));
    if (!json.is_object() || !json.contains(key)) return;
    check(json[key], path.substr(key.size()), kind, where.empty() ? key : where + "." + key, fail);
}

/// A buffer without data, for readers that do not know EXT_meshopt_compression.
bool is_fallback(const Json& buffer) {
    return !buffer.contains("uri") &&
           buffer.value(Json::json_pointer("/extensions/EXT_meshopt_compression/fallback"), false);
}

/// Says otherwise what a file says rightly and tinygltf misunderstands: "+" in a URI, which it takes for a space,
/// skins without matrices and buffers without data, which it refuses. Whether there was any.
bool say_otherwise(Json& document) {
    bool any = false;
    if (document.contains("buffers"))
        for (Json& buffer : document["buffers"])
            if (is_fallback(buffer)) {
                buffer = {{"uri", "data:application/octet-stream;base64,AA=="}, {"byteLength", 1}};
                any = true;
            }
    if (document.contains("skins"))
        for (Json& skin : document["skins"]) any = skin.emplace("inverseBindMatrices", -1).second || any;
    for (const char* list : {"buffers", "images"}) {
        if (!document.contains(list)) continue;
        for (Json& item : document[list]) {
            if (!item.contains("uri")) continue;
            auto& uri = item["uri"].get_ref<std::string&>();
            if (uri.starts_with("data:")) continue;
            for (std::size_t at = uri.find('+'); at != std::string::npos; at = uri.find('+', at)) {
                uri.replace(at, 1, "%2B");
                any = true;
            }
        }
    }
    return any;
}

std::uint32_t word(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    if (offset + 4 <= bytes.size()) std::memcpy(&value, &bytes[offset], 4);
    return value;
}

/// Where the JSON of a binary file ends; it begins at 20.
std::size_t check_chunks(const std::vector<std::uint8_t>& bytes, const Fail& fail) {
    const std::size_t size = std::max<std::size_t>(word(bytes, 8), 20),
                      json_end = 20 + std::size_t{word(bytes, 12)};
    const std::size_t end = json_end < size ? json_end + 8 + word(bytes, json_end) : json_end;
    if (size > bytes.size() || end > size)
        fail(fmt::format("cut off or damaged: it has {} bytes, its header and chunks ask for {}", bytes.size(),
                         std::max(size, end)));
    if (word(bytes, 4) != 2) fail(fmt::format("binary glTF version {}, 2 expected", word(bytes, 4)));
    return json_end;
}

}  // namespace

Document read_document(std::vector<std::uint8_t> bytes, const Fail& fail) {
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) fail("larger than 4 GiB");
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool binary = all.starts_with("glTF");
    const std::size_t begin = binary ? 20 : 0, end = binary ? check_chunks(bytes, fail) : bytes.size();
    Json document;
    try {
        document = parse_json(all.substr(begin, end - begin));
    } catch (const Error& e) {
        fail(std::string("not a valid glTF 2.0 file: ") + e.what());
    }
    if (!document.is_object()) fail("not a valid glTF 2.0 file: an object expected");
    for (const Row& row : rows) check(document, row.path, row.kind, "", fail);
    if (!say_otherwise(document)) return {std::move(bytes), binary};

    std::string text = document.dump();
    if (!binary) return {{text.begin(), text.end()}, binary};
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto length = static_cast<std::uint32_t>(text.size()),
               size = static_cast<std::uint32_t>(20 + text.size() + (bytes.size() - end));
    std::vector<std::uint8_t> out(bytes.begin(), bytes.begin() + 20);
    std::memcpy(&out[8], &size, 4);
    std::memcpy(&out[12], &length, 4);
    out.insert(out.end(), text.begin(), text.end());
    out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
    return {std::move(out), binary};
}

}  // namespace tyndall::gltf
