// Files that are right and were refused or read as something else, files that are wrong and were accepted, and what
// is said of what is left out.
#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

class GltfFiles : public SceneFolderTest {
  protected:
    /// The scene, and in `log_` what was said while it was loaded.
    Scene load_heard(const GltfBuilder& builder) {
        std::ostringstream text;
        const auto before = spdlog::default_logger();
        spdlog::set_default_logger(
            std::make_shared<spdlog::logger>("heard", std::make_shared<spdlog::sinks::ostream_sink_mt>(text)));
        spdlog::default_logger()->set_pattern("%v");
        const auto heard = [&] {
            spdlog::set_default_logger(before);
            log_ = text.str();
        };
        try {
            Scene scene = load(builder);
            heard();
            return scene;
        } catch (...) {
            heard();
            throw;
        }
    }
    void expect_error(const GltfBuilder& builder, const std::string& fragment) const {
        EXPECT_THAT(
            [&] { (void)load(builder); },
            ThrowsMessage<Error>(AllOf(HasSubstr("scene.gltf"), HasSubstr(fragment), Not(HasSubstr("\n")))));
    }
    [[nodiscard]] std::string png() const {
        write_image(folder / "picture.png", Image({2, 2}, 4));
        return read_text(folder / "picture.png");
    }
    std::string log_;
};

TEST_F(GltfFiles, SpotWhoseConesDifferByLessThanSinglePrecisionTells) {
    GltfBuilder b;
    b.light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.69999999}, {"outerConeAngle", 0.7}}}});
    const Scene scene = load(b);
    EXPECT_LE(scene.lights[0].inner_cone, scene.lights[0].outer_cone);
    b.doc["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["innerConeAngle"] = 0.70001;
    expect_error(b, "innerConeAngle");
}

TEST_F(GltfFiles, OptionalDracoIsReadFromItsPlainData) {
    GltfBuilder b;
    json& primitive = b.triangle();
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
    b.doc["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    EXPECT_EQ(load_heard(b).meshes.at(0).vertices.size(), 3u);
    EXPECT_THAT(log_, HasSubstr("extensions ignored: KHR_draco_mesh_compression"));
    b.doc["accessors"][0].erase("bufferView");
    expect_error(b, "Draco compression is not supported, and accessor 0 has no other data");
}

TEST_F(GltfFiles, AccessorsWithoutAViewAreZeros) {
    GltfBuilder b;
    const int empty = b.append("accessors", {{"componentType", 5126}, {"type", "VEC2"}, {"count", 3}});
    b.triangle()["attributes"]["TEXCOORD_0"] = empty;
    const Scene scene = load(b);
    for (const Vertex& v : scene.meshes.at(0).vertices) EXPECT_EQ(v.uv, glm::vec2(0));
    b.doc["accessors"][static_cast<std::size_t>(empty)]["count"] = std::uint64_t(1) << 40;
    expect_error(b, "and no buffer view");
}

TEST_F(GltfFiles, VertexColoursOfEveryForm) {
    const auto colors = [&](auto add) {
        GltfBuilder b;
        json& primitive = b.triangle();
        const int accessor = add(b);
        primitive = b.doc["meshes"][0]["primitives"][0];
        b.doc["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
        std::vector<glm::vec4> out;
        const Scene scene = load_heard(b);
        for (const Vertex& v : scene.meshes.at(0).vertices) out.push_back(v.color);
        return out;
    };
    const auto normalised = [](GltfBuilder& b, int accessor) {
        b.doc["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
        return accessor;
    };
    EXPECT_THAT(colors([](GltfBuilder& b) {
                    return b.accessor<float>({1, 0, 0, 0, 0.5f, 0, 0, 0, 0.25f}, GltfBuilder::f32, "VEC3");
                }),
                ElementsAre(glm::vec4(1, 0, 0, 1), glm::vec4(0, 0.5f, 0, 1), glm::vec4(0, 0, 0.25f, 1)));
    EXPECT_EQ(log_, "");
    EXPECT_THAT(colors([&](GltfBuilder& b) {
                    return normalised(b, b.accessor<std::uint8_t>({255, 0, 0, 51, 0, 255, 0, 255, 0, 0, 0, 0},
                                                                  GltfBuilder::u8, "VEC4"));
                }),
                ElementsAre(glm::vec4(1, 0, 0, 0.2f), glm::vec4(0, 1, 0, 1), glm::vec4(0)));
    EXPECT_EQ(colors([&](GltfBuilder& b) {
                  return normalised(b, b.accessor<std::uint16_t>({65535, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                                                                 GltfBuilder::u16, "VEC4"));
              }).at(0),
              glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(colors([](GltfBuilder& b) {
                  return b.accessor<float>({2, 0, -1, 0, 0, 0, 0, 0, 0}, GltfBuilder::f32, "VEC3");
              }).at(0),
              glm::vec4(1, 0, 0, 1));
    EXPECT_THAT(log_, HasSubstr("COLOR_0: numbers outside of 0 to 1"));
}

TEST_F(GltfFiles, SamplersAreKeptAndAPictureReadInTwoWaysIsTwo) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.doc["images"] = {{{"bufferView", b.view(png())}, {"mimeType", "image/png"}}};
    b.doc["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9984}},
                         json::object()};
    b.doc["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}, {"sampler", 1}}, {{"source", 0}}};
    b.doc["materials"] = {{{"emissiveTexture", {{"index", 0}}},
                           {"occlusionTexture", {{"index", 1}}},
                           {"normalTexture", {{"index", 2}}}}};
    const Scene scene = load(b);
    ASSERT_EQ(scene.pictures.size(), 2u);
    const Material& m = scene.materials[0];
    const Sampling own{.u = Wrap::clamp, .v = Wrap::mirror, .nearest = true, .minification = 9984};
    EXPECT_EQ(scene.pictures[static_cast<std::size_t>(m.emissive_picture)].sampling, own);
    EXPECT_EQ(scene.pictures[static_cast<std::size_t>(m.normal_picture)].sampling, Sampling());
    EXPECT_EQ(m.normal_picture, m.occlusion_picture);
    b.doc["samplers"][0]["wrapS"] = 10496;
    expect_error(b, "wrapS 10496 given");
    b.doc["samplers"] = json::array();
    expect_error(b, "does not exist; there are 0");
}

TEST_F(GltfFiles, APlusInAUriIsAPlus) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    write("a + b.bin", b.bytes);
    write("x+y.png", png());
    b.doc["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", "a%20+ b.bin"}}};
    b.doc["images"] = {{{"uri", "x+y.png"}}};
    b.doc["textures"] = {{{"source", 0}}};
    b.doc["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    const Scene scene = load(b);
    EXPECT_EQ(scene.meshes.at(0).vertices.at(2).position, glm::vec3(0, 2, 0));
    EXPECT_EQ(scene.pictures.at(0).size, glm::ivec2(2));
    // In a binary file, whose header then has another length.
    b.doc.erase("buffers");
    const Scene binary = load_gltf(write("scene.glb", b.glb()));
    EXPECT_EQ(binary.meshes.at(0).vertices.at(2).position, glm::vec3(0, 2, 0));
    EXPECT_EQ(binary.pictures.at(0).size, glm::ivec2(2));
}

TEST_F(GltfFiles, ASkinsJointsAlonePlaceItsMesh) {
    GltfBuilder b;
    json& primitive = b.triangle();
    primitive["attributes"]["JOINTS_0"] =
        b.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, GltfBuilder::u8, "VEC4");
    primitive = b.doc["meshes"][0]["primitives"][0];
    const int weights = b.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0}, GltfBuilder::f32, "VEC4");
    b.doc["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
    // Two joints below a root that is moved by (10, 0, 0); the second is mirrored in z and raised by 4. The first
    // one's inverse bind matrix takes the root's movement back.
    std::vector<float> inverse(32, 0);
    for (std::size_t i = 0; i < 4; ++i) inverse[i * 5] = inverse[16 + i * 5] = 1;
    inverse[12] = -10;
    const int binds = b.view(inverse);
    b.append("accessors", {{"bufferView", binds}, {"componentType", 5126}, {"type", "MAT4"}, {"count", 2}});
    b.doc["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", b.doc["accessors"].size() - 1}}};
    b.doc["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    b.doc["nodes"][0]["skin"] = 0;
    b.node({{"translation", {10, 0, 0}}, {"children", {2, 3}}});
    b.append("nodes", json::object());
    b.append("nodes", {{"translation", {0, 4, 0}}, {"scale", {1, 1, -1}}});
    const Scene scene = load_heard(b);
    EXPECT_THAT(log_, HasSubstr("skins are not moved, drawn in its rest pose"));
    std::vector<glm::vec3> placed;
    for (const Node& node : scene.nodes)
        for (const int mesh : node.meshes)
            for (const Vertex& v : scene.meshes[static_cast<std::size_t>(mesh)].vertices)
                placed.emplace_back(node.world * glm::vec4(v.position, 1));
    // (0, 0, 0) by the first; (1, 0, 0) by the second; (0, 2, 0) by a quarter and three quarters.
    EXPECT_THAT(placed, ElementsAre(glm::vec3(0), glm::vec3(11, 4, 0), glm::vec3(7.5f, 5, 0)));
    b.doc["skins"][0]["joints"] = {2};
    expect_error(b, "1 joints and 2 inverse bind matrices");
    b.doc["skins"][0].erase("inverseBindMatrices");
    expect_error(b, "joint 1; there are 1");
    b.doc["skins"][0]["joints"] = {2, 99};
    expect_error(b, "joint 99 does not exist");
}

TEST_F(GltfFiles, MembersOfAWrongTypeAreNamed) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    b.doc["materials"] = {{{"pbrMetallicRoughness", json::object()}}};
    b.light({{"type", "spot"}, {"intensity", 10}, {"spot", json::object()}});
    b.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    b.node({{"camera", 0}});
    ASSERT_NO_THROW((void)load(b));
    const std::string light = "/extensions/KHR_lights_punctual/lights/0";
    const std::tuple<std::string, json, std::string> cases[] = {
        {light + "/intensity", "10", "extensions.KHR_lights_punctual.lights[0].intensity: \"10\" given, a number"},
        {light + "/range", true, "lights[0].range: true given, a number"},
        {light + "/color", {1, "x", 1}, "lights[0].color"},
        {light + "/spot/outerConeAngle", {0.5}, "lights[0].spot.outerConeAngle: [0.5] given, a number"},
        {"/nodes/1/extensions/KHR_lights_punctual/light", 1.5, "light: 1.5 given, a whole number"},
        {"/nodes/1/extensions/KHR_lights_punctual/light", "0", "light: \"0\" given, a whole number"},
        {"/nodes/0/mesh", 0.5, "nodes[0].mesh: 0.5 given"},
        {"/nodes/0/scale", "big", "nodes[0].scale: \"big\" given, a list of numbers"},
        {"/nodes/0/translation", {0, nullptr, 0}, "nodes[0].translation"},
        {"/materials/0/doubleSided", 1, "materials[0].doubleSided: 1 given, true or false"},
        {"/materials/0/pbrMetallicRoughness/roughnessFactor", "1", "roughnessFactor: \"1\" given"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1, 1.5}, "baseColorFactor: 1.5 given"},
        {"/cameras/0/perspective/yfov", "wide", "cameras[0].perspective.yfov"},
        {"/accessors/0/normalized", "true", "accessors[0].normalized"},
        {"/scene", "0", "scene: \"0\" given"},
        {"/asset/minVersion", "2.1", "asks for glTF 2.1"},
        {"/asset/minVersion", 2.0, "asset.minVersion"},
        {"/scenes/0/extras/exposure", 1e30, "extras.exposure"},
    };
    for (const auto& [pointer, value, fragment] : cases) {
        GltfBuilder damaged = b;
        damaged.doc[json::json_pointer(pointer)] = value;
        SCOPED_TRACE(pointer);
        expect_error(damaged, fragment);
    }
    b.doc["asset"]["minVersion"] = "2.0";
    EXPECT_NO_THROW((void)load(b));
}

TEST_F(GltfFiles, WhatIsIgnoredIsNamedInOneLine) {
    GltfBuilder b;
    json& primitive = b.triangle();
    primitive["attributes"]["COLOR_1"] = 0;
    primitive["attributes"]["TEXCOORD_1"] = 0;
    primitive["attributes"]["_CURVATURE"] = 0;
    b.doc["nodes"][0]["extras"] = {{"hp", 3}, {"cast_shadow", true}};
    b.doc["scenes"][0]["extras"] = {{"media ", "[]"}, {"fog", "x"}, {"exposure", 1}};
    b.doc["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_lights_punctual"};
    (void)load_heard(b);
    EXPECT_THAT(log_, HasSubstr("extras: \"fog\" of a scene is not read: \"media\" meant?\n"));
    EXPECT_THAT(log_, HasSubstr("extras: \"media \" of a scene is not read: \"media\" meant?\n"));
    EXPECT_THAT(log_, HasSubstr("extras ignored: \"hp\" of a node\n"));
    EXPECT_THAT(log_, HasSubstr("extensions ignored: KHR_materials_clearcoat\n"));
    EXPECT_THAT(log_, HasSubstr("attributes ignored: COLOR_1\n"));
    EXPECT_EQ(std::ranges::count(log_, '\n'), 5);
    // A material of a volume alone, as an exporter leaves it.
    b.doc["materials"] = {{{"name", "fog"}, {"doubleSided", true}, {"pbrMetallicRoughness", json::object()}}};
    b.doc["meshes"][0]["primitives"][0]["material"] = 0;
    (void)load_heard(b);
    EXPECT_THAT(log_, HasSubstr("material 0 \"fog\": it says nothing of its surface, drawn as white metal; "));
    b.doc["materials"] = {
        {{"alphaMode", "MASK"},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", {{"index", 0}}}}}}}}};
    (void)load_heard(b);
    EXPECT_THAT(log_, HasSubstr("material 0 \"\": transmissionTexture is not supported\n"));
    EXPECT_THAT(log_, HasSubstr("material 0 \"\": alphaMode MASK is taken as BLEND, as it transmits light\n"));
    // Of a file that is refused, the reason alone is told.
    b.doc["nodes"][0]["mesh"] = 7;
    EXPECT_THROW((void)load_heard(b), Error);
    EXPECT_EQ(log_, "");
}

TEST_F(GltfFiles, MediaInExtras) {
    GltfBuilder b;
    b.node({{"name", "empty"}});
    json& media = b.doc["scenes"][0]["extras"]["media"];
    media = {{"shape", "global"}, {"scattering", {1, 1, 1}}};
    expect_error(b, "one medium given, a list of media expected");
    media = std::string(100'000, '[');
    expect_error(b, "extras.media: the text is not valid JSON: the JSON is nested deeper than 100 levels");
    media = "[{]";
    expect_error(b, "extras.media: the text is not valid JSON: parse error");
}

TEST_F(GltfFiles, AnimationsThatLeaveTheRangeOfNumbersAreRefused) {
    for (const char* path : {"scale", "translation"}) {
        GltfBuilder b;
        b.triangle();
        const int times = b.accessor<float>({0, 1}, GltfBuilder::f32, "SCALAR");
        const int values = b.accessor<float>({1, 1, 1, 1e30f, 1, 1}, GltfBuilder::f32, "VEC3");
        b.doc["animations"] = {{{"samplers", {{{"input", times}, {"output", values}}}},
                                {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
        expect_error(b, "its animation may take it");
    }
    GltfBuilder b;
    b.triangle();
    b.doc["nodes"][0]["scale"] = {1e10, 1, 1};
    expect_error(b, "its mesh reaches farther than");
}

}  // namespace
}  // namespace tyndall
