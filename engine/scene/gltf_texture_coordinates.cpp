#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

constexpr const char* name = "KHR_texture_transform";

double number(const GltfFile& file, const tinygltf::Value& value, const std::string& what) {
    if (!value.IsNumber()) file.fail("{}: a number expected", what);
    return double{file.number(value.GetNumberAsDouble(), what)};
}

glm::dvec2 pair(const GltfFile& file, const tinygltf::Value& value, const std::string& what) {
    if (!value.IsArray() || value.ArrayLen() != 2) file.fail("{}: two numbers expected", what);
    return {number(file, value.Get(0), what), number(file, value.Get(1), what)};
}

/// Of a material's texture; none where the material has no such texture.
template <class Info>
std::optional<TextureCoordinates> coordinates_of(const GltfFile& file, const Info& info, const std::string& slot) {
    if (info.index == -1) return std::nullopt;
    const std::string what = fmt::format("{}: {}", slot, name);
    const auto member = [&](const char* key) { return file.extension(info, name, key); };
    TextureCoordinates to;
    to.set = info.texCoord;
    glm::dvec2 scale(1), offset(0);
    double angle = 0;
    if (const auto* value = member("scale")) scale = pair(file, *value, what + ".scale");
    if (const auto* value = member("offset")) offset = pair(file, *value, what + ".offset");
    if (const auto* value = member("rotation")) angle = number(file, *value, what + ".rotation");
    if (const auto* value = member("texCoord")) {
        if (!value->IsInt()) file.fail("{}.texCoord: a whole number expected", what);
        to.set = value->GetNumberAsInt();
    }
    if (to.set < 0) file.fail("{}: texture coordinates {} given, 0 or more expected", slot, to.set);
    // Scaled, turned and moved. v points down: what is counter-clockwise to the eye is clockwise to the axes.
    const double c = std::cos(angle), s = std::sin(angle);
    to.transform = {{scale.x * c, -scale.x * s}, {scale.y * s, scale.y * c}, offset};
    return to;
}

}  // namespace

std::optional<TextureCoordinates> texture_coordinates(const GltfFile& file, int material) {
    const tinygltf::Material& from = file.model().materials[static_cast<std::size_t>(material)];
    const auto& needed = file.model().extensionsRequired;
    const bool required = std::ranges::find(needed, name) != needed.end();
    std::optional<TextureCoordinates> first;
    const auto look = [&](const auto& info, const char* slot) {
        const std::string what = fmt::format("material {} \"{}\": {}", material, from.name, slot);
        const auto own = coordinates_of(file, info, what);
        if (!first) first = own;
        if (!own || *own == *first) return;
        if (own->transform != first->transform && required)
            file.fail("{}: its {} differs from that of the material's first texture, one for all expected", what,
                      name);
        file.skip(
            "{}: its texture coordinates are not supported beside others, those of the first texture are used",
            what);
    };
    look(from.pbrMetallicRoughness.baseColorTexture, "baseColorTexture");
    look(from.pbrMetallicRoughness.metallicRoughnessTexture, "metallicRoughnessTexture");
    look(from.normalTexture, "normalTexture");
    look(from.occlusionTexture, "occlusionTexture");
    look(from.emissiveTexture, "emissiveTexture");
    return first;
}

}  // namespace tyndall::gltf
