#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// Writes a glTF by hand: a JSON document that tests fill or damage as they like, and the bytes of buffer 0.
class GltfBuilder {
  public:
    enum Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

    nlohmann::json doc = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    /// Returns the index of a buffer view of `data`.
    int view(std::string_view data) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return append("bufferViews", {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", data.size()}},
                      data);
    }
    template <class T>
    int view(const std::vector<T>& data) {
        return view(std::string_view(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T)));
    }
    /// Returns the index of an accessor of `data`, interleaved components of the given type.
    template <class T>
    int accessor(const std::vector<T>& data, Component component, const std::string& type) {
        const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        return append("accessors", {{"bufferView", view(data)},
                                    {"componentType", component},
                                    {"type", type},
                                    {"count", data.size() / width}});
    }
    int append(const std::string& list, nlohmann::json item, std::string_view data = {}) {
        bytes += data;
        doc[list].push_back(std::move(item));
        return static_cast<int>(doc[list].size()) - 1;
    }

    /// A mesh of one right triangle in the plane z = 0, and a node that shows it. Returns the primitive.
    nlohmann::json& triangle() {
        const int position = accessor<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}, f32, "VEC3");
        const int indices = accessor<std::uint16_t>({0, 1, 2}, u16, "SCALAR");
        const nlohmann::json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", indices}};
        node({{"mesh", append("meshes", {{"primitives", nlohmann::json::array({primitive})}})}});
        return doc["meshes"].back()["primitives"][0];
    }
    /// Adds a node as a root of the scene.
    int node(nlohmann::json item) {
        const int index = append("nodes", std::move(item));
        doc["scenes"][0]["nodes"].push_back(index);
        return index;
    }
    int light(nlohmann::json item) {
        auto& lights = doc["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(std::move(item));
        return node({{"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
    }

    /// As a .gltf file with the buffer in a data URI.
    [[nodiscard]] std::string text() const {
        nlohmann::json out = doc;
        if (!bytes.empty() && !out.contains("buffers"))
            out["buffers"] = {
                {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return out.dump();
    }
    [[nodiscard]] std::string glb() const {
        nlohmann::json out = doc;
        std::string binary = bytes;
        binary.resize((binary.size() + 3) / 4 * 4);
        out["buffers"] = {{{"byteLength", binary.size()}}};
        std::string json = out.dump();
        json.resize((json.size() + 3) / 4 * 4, ' ');
        const auto size = static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size());
        return "glTF" + word(2) + word(size) + word(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
               word(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
    }

  private:
    static std::string word(std::uint32_t value) {
        std::string text(4, '\0');
        std::memcpy(text.data(), &value, 4);
        return text;
    }
    static std::string base64(const std::string& data) {
        constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out;
        for (std::size_t i = 0; i < data.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bits = bits << 8 | (i + k < data.size() ? static_cast<std::uint8_t>(data[i + k]) : 0u);
            for (std::size_t k = 0; k < 4; ++k)
                out += i + k > data.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
        }
        return out;
    }
};

}  // namespace tyndall
