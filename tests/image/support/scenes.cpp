#include "scenes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

namespace tyndall::test {
namespace {

using nlohmann::json;

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

/// Floor 40 x 40 m at y = 0 and a wall 8 x 4 m at z = -6, facing the camera.
void add_geometry(json& gltf) {
    constexpr std::array<float, 24> positions{-20, 0, 20, 20, 0, 20, 20, 0, -20, -20, 0, -20,
                                              -4,  0, -6, 4,  0, -6, 4,  4, -6,  -4,  4, -6};
    constexpr std::array<float, 24> normals{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    constexpr std::array<std::uint16_t, 12> indices{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    std::vector<std::uint8_t> bytes(sizeof positions + sizeof normals + sizeof indices);
    std::memcpy(bytes.data(), positions.data(), sizeof positions);
    std::memcpy(bytes.data() + sizeof positions, normals.data(), sizeof normals);
    std::memcpy(bytes.data() + sizeof positions + sizeof normals, indices.data(), sizeof indices);
    gltf["buffers"] = {
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
    gltf["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 96}},
                           {{"buffer", 0}, {"byteOffset", 96}, {"byteLength", 96}},
                           {{"buffer", 0}, {"byteOffset", 192}, {"byteLength", 24}}};
    gltf["accessors"] = {{{"bufferView", 0},
                          {"componentType", 5126},
                          {"count", 8},
                          {"type", "VEC3"},
                          {"min", {-20, 0, -20}},
                          {"max", {20, 4, 20}}},
                         {{"bufferView", 1}, {"componentType", 5126}, {"count", 8}, {"type", "VEC3"}},
                         {{"bufferView", 2}, {"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}}};
    gltf["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}},
         {"doubleSided", true}}};
    gltf["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", 0}}}}}};
    gltf["nodes"].push_back({{"name", "ground"}, {"mesh", 0}});
}

/// A level sheet, 10 x 10 m at y = 3, left of the camera, seen from above alone.
void add_glass(json& gltf) {
    gltf["accessors"].push_back({{"bufferView", 2}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    gltf["materials"].push_back(
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.9, 0.3, 0.1, 1}}, {"metallicFactor", 0}}},
         {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}});
    gltf["meshes"].push_back(
        {{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 3}, {"material", 1}}}}});
    gltf["nodes"].push_back(
        {{"name", "glass"}, {"mesh", 1}, {"translation", {-5, 3, 0}}, {"scale", {0.25, 0.25, 0.25}}});
    gltf["extensionsUsed"].push_back("KHR_materials_transmission");
}

}  // namespace

void write_scene(const std::filesystem::path& path, const SceneSpec& spec) {
    json gltf{{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    gltf["nodes"] = json::array();
    gltf["nodes"].push_back({{"name", "camera"}, {"camera", 0}, {"translation", {0, 2, 10}}});
    gltf["cameras"] = {
        {{"name", "camera"}, {"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    if (spec.floor) add_geometry(gltf);
    if (spec.glass) add_glass(gltf);
    json lights = json::array();
    const auto add_light = [&](json light, json node) {
        node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
        lights.push_back(std::move(light));
        gltf["nodes"].push_back(std::move(node));
    };
    if (spec.sun)  // -Z turned 45 degrees down
        add_light({{"type", "directional"}, {"intensity", 10}, {"color", {1, 0.9, 0.8}}},
                  {{"name", "sun"}, {"rotation", {-0.38268343, 0, 0, 0.92387953}}});
    for (const Lamp& lamp : spec.lamps) {
        json light{{"type", lamp.spot ? "spot" : "point"}, {"intensity", lamp.candela}, {"range", lamp.range}};
        if (lamp.spot) light["spot"] = {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.6}};
        json node{{"translation", {lamp.position.x, lamp.position.y, lamp.position.z}}};
        if (lamp.spot) node["rotation"] = {-0.70710678, 0, 0, 0.70710678};  // straight down
        add_light(std::move(light), std::move(node));
    }
    if (!lights.empty()) {
        gltf["extensions"]["KHR_lights_punctual"]["lights"] = lights;
        gltf["extensionsUsed"].push_back("KHR_lights_punctual");
    }
    json roots = json::array();
    for (std::size_t i = 0; i < gltf["nodes"].size(); ++i) roots.push_back(i);
    gltf["scenes"] = {{{"nodes", roots}, {"extras", {{"media", json::parse(spec.media)}}}}};
    std::ofstream(path) << gltf.dump();
}

}  // namespace tyndall::test
