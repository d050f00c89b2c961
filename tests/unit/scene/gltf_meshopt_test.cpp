#include <gmock/gmock.h>
#include <meshoptimizer.h>

#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

using Bytes = std::vector<std::uint8_t>;

Bytes encoded_vertices(const void* data, std::size_t count, std::size_t stride) {
    Bytes out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
    return out;
}

const std::vector<float> triangle_corners{0, 0, 0, 1, 0, 0, 0, 2, 0};
const std::vector<std::uint32_t> triangle_order{0, 1, 2};

class GltfMeshopt : public SceneFolderTest {
  protected:
    /// A triangle whose views are compressed; the second buffer is the one that other readers would need.
    static GltfBuilder triangle() {
        GltfBuilder b;
        Bytes indices(meshopt_encodeIndexBufferBound(3, 3));
        indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), triangle_order.data(), 3));
        const int position = accessor(b, encoded_vertices(triangle_corners.data(), 3, 12),
                                      {{"mode", "ATTRIBUTES"}, {"byteStride", 12}}, GltfBuilder::f32, "VEC3"),
                  index =
                      accessor(b, indices, {{"mode", "TRIANGLES"}, {"byteStride", 2}}, GltfBuilder::u16, "SCALAR");
        b.doc["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", index}}}}}};
        b.node({{"mesh", 0}});
        b.doc["extensionsUsed"] = b.doc["extensionsRequired"] = {"EXT_meshopt_compression"};
        return b;
    }
    /// Of three elements.
    static int accessor(GltfBuilder& b, const Bytes& compressed, json how, GltfBuilder::Component type,
                        const std::string& shape) {
        const int source = b.view(compressed);
        how["buffer"] = 0;
        how["byteOffset"] = b.doc["bufferViews"][static_cast<std::size_t>(source)]["byteOffset"];
        how["byteLength"] = compressed.size();
        how["count"] = 3;
        const int view = b.append("bufferViews", {{"buffer", 1},
                                                  {"byteLength", 3 * how["byteStride"].get<int>()},
                                                  {"extensions", {{"EXT_meshopt_compression", how}}}});
        return b.append("accessors",
                        {{"bufferView", view}, {"componentType", type}, {"type", shape}, {"count", 3}});
    }
    [[nodiscard]] std::filesystem::path file(const GltfBuilder& b) const {
        write("data.bin", b.bytes);
        json doc = b.doc;
        doc["buffers"] = {
            {{"byteLength", b.bytes.size()}, {"uri", "data.bin"}},
            {{"byteLength", 42}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
        return write("scene.gltf", doc.dump());
    }
    void expect_error(const GltfBuilder& b, const std::string& fragment) const {
        EXPECT_THAT(
            [&] { (void)load_gltf(file(b)); },
            ThrowsMessage<Error>(AllOf(HasSubstr("scene.gltf: "), HasSubstr(fragment), Not(HasSubstr("\n")))));
    }
};

TEST_F(GltfMeshopt, AttributesAndTriangles) {
    const Mesh mesh = load_gltf(file(triangle())).meshes.at(0);
    EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
    EXPECT_EQ(mesh.vertices.at(1).position, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.vertices.at(2).position, glm::vec3(0, 2, 0));
}

TEST_F(GltfMeshopt, FiltersAndSequences) {
    GltfBuilder b = triangle();
    // Normals in two bytes and positions in mantissa and exponent.
    const std::vector<float> normals{0, 0.6f, 0.8f, 0, 0, 0, 1, 0, 1, 0, 0, 0};
    Bytes octahedral(12);
    meshopt_encodeFilterOct(octahedral.data(), 3, 4, 8, normals.data());
    const int normal =
        accessor(b, encoded_vertices(octahedral.data(), 3, 4),
                 {{"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}, {"byteStride", 4}}, GltfBuilder::i8, "VEC3");
    b.doc["accessors"].back()["normalized"] = true;
    b.doc["bufferViews"].back()["byteStride"] = 4;
    Bytes exponential(36);
    meshopt_encodeFilterExp(exponential.data(), 3, 12, 20, triangle_corners.data());
    const int position =
        accessor(b, encoded_vertices(exponential.data(), 3, 12),
                 {{"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}, {"byteStride", 12}}, GltfBuilder::f32, "VEC3");
    Bytes sequence(meshopt_encodeIndexSequenceBound(3, 3));
    sequence.resize(meshopt_encodeIndexSequence(sequence.data(), sequence.size(), triangle_order.data(), 3));
    const int index = accessor(b, sequence, {{"mode", "INDICES"}, {"byteStride", 4}}, GltfBuilder::u32, "SCALAR");
    b.doc["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                                           {"indices", index}};
    const Mesh mesh = load_gltf(file(b)).meshes.at(0);
    EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2));
    EXPECT_LT(glm::distance(mesh.vertices.at(2).position, glm::vec3(0, 2, 0)), 1e-5f);
    EXPECT_LT(glm::distance(mesh.vertices.at(0).normal, glm::vec3(0, 0.6f, 0.8f)), 0.02f);
    EXPECT_LT(glm::distance(mesh.vertices.at(2).normal, glm::vec3(1, 0, 0)), 0.02f);
}

TEST_F(GltfMeshopt, WhatIsWrongIsNamed) {
    const std::tuple<const char*, json, const char*> cases[] = {
        {"mode", "POINTS", "buffer view 1: EXT_meshopt_compression: mode POINTS"},
        {"filter", "WAVELET", "filter WAVELET"},
        {"filter", "OCTAHEDRAL", "filter OCTAHEDRAL is not for ATTRIBUTES of 12 bytes"},
        {"filter", 1, "filter: 1 given, text expected"},
        {"byteStride", 6, "byteStride 6"},
        {"byteStride", 0, "byteStride 0"},
        {"byteStride", 260, "byteStride 260"},
        {"count", 2'000'000'000, "count 2000000000 does not fit"},
        {"count", 0, "count 0"},
        {"count", -1, "count -1"},
        {"count", 1e300, "count 1e+300"},
        {"buffer", 7, "buffer 7 does not exist"},
        {"byteLength", 100'000, "ends outside its buffer"},
        {"byteLength", 10, "10 bytes that are no 3 ATTRIBUTES"},
        {"byteOffset", 8, "ATTRIBUTES of 12 bytes"},
    };
    for (const auto& [key, value, says] : cases) {
        SCOPED_TRACE(key);
        GltfBuilder b = triangle();
        b.doc["bufferViews"][1]["extensions"]["EXT_meshopt_compression"][key] = value;
        expect_error(b, says);
    }
    GltfBuilder b = triangle();  // fewer than the accessor asks for
    b.doc["accessors"][0]["count"] = 4;
    expect_error(b, "4 elements do not fit in the 36 bytes");
    b = triangle();  // the buffer that has no data
    b.doc["bufferViews"][1].erase("extensions");
    expect_error(b, "outside its buffer of 1 bytes");
}

}  // namespace
}  // namespace tyndall
