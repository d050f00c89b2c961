#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

class GltfExtensions : public SceneFolderTest {
  protected:
    /// A triangle with two sets of coordinates, whose only material has the given textures.
    GltfBuilder textured(const json& material) const {
        GltfBuilder b;
        json& primitive = b.triangle();
        primitive["material"] = 0;
        primitive["attributes"]["TEXCOORD_0"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, GltfBuilder::f32, "VEC2");
        b.doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
            b.accessor<float>({5, 5, 6, 5, 5, 6}, GltfBuilder::f32, "VEC2");
        write_image(folder / "picture.png", Image({2, 2}, 4));
        b.doc["images"] = {{{"bufferView", b.view(read_text(folder / "picture.png"))}, {"mimeType", "image/png"}}};
        b.doc["textures"] = {{{"source", 0}}};
        b.doc["materials"] = {material};
        b.doc["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_unlit"};
        return b;
    }
    static json texture(const json& transform) {
        return {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    }
    static json based(const json& texture) { return {{"pbrMetallicRoughness", {{"baseColorTexture", texture}}}}; }

    [[nodiscard]] std::vector<glm::vec2> uv(const GltfBuilder& b) {
        GltfNotes notes;
        const Scene scene = load_gltf(write("scene.gltf", b.text()), notes);
        left_out_ = notes.left_out;
        std::vector<glm::vec2> all;
        for (const Vertex& v : scene.meshes.at(0).vertices) all.push_back(v.uv);
        return all;
    }
    void expect_error(const GltfBuilder& b, const std::string& fragment) const {
        EXPECT_THAT([&] { (void)load(b); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("scene.gltf: "), HasSubstr(fragment))));
    }
    std::vector<std::string> left_out_;
};

auto near(float u, float v) {
    return testing::Truly([=](glm::vec2 given) { return glm::distance(given, glm::vec2(u, v)) < 1e-6f; });
}

TEST_F(GltfExtensions, TextureTransformScalesTurnsAndMoves) {
    EXPECT_THAT(uv(textured(based(texture({{"offset", {0, -1}}, {"scale", {2, 3}}})))),
                ElementsAre(near(0, -1), near(2, -1), near(0, 2)));
    // A quarter turn counter-clockwise, as seen: v points down, so +u becomes -v and +v becomes +u. As Blender's
    // Mapping node does, which turns about a lower left corner.
    EXPECT_THAT(uv(textured(based(
                    texture({{"rotation", std::numbers::pi / 2}, {"offset", {0.25, 0}}, {"scale", {2, 3}}})))),
                ElementsAre(near(0.25f, 0), near(0.25f, -2), near(3.25f, 0)));
    EXPECT_THAT(uv(textured(based(texture({{"texCoord", 1}, {"offset", {1, 0}}})))),
                ElementsAre(near(6, 5), near(7, 5), near(6, 6)));
    EXPECT_THAT(left_out_, IsEmpty());
}

TEST_F(GltfExtensions, TextureCoordinatesOfAnySet) {
    EXPECT_THAT(uv(textured(based({{"index", 0}, {"texCoord", 1}}))),
                ElementsAre(near(5, 5), near(6, 5), near(5, 6)));
    EXPECT_THAT(left_out_, IsEmpty());
    EXPECT_THAT(uv(textured(based({{"index", 0}, {"texCoord", 2}}))),
                ElementsAre(near(0, 0), near(0, 0), near(0, 0)));
    EXPECT_THAT(left_out_, ElementsAre(HasSubstr("has no TEXCOORD_2")));
    expect_error(textured(based({{"index", 0}, {"texCoord", -1}})), "texture coordinates -1");
    json material = based({{"index", 0}, {"texCoord", 1}});
    material["occlusionTexture"] = {{"index", 0}};
    EXPECT_THAT(uv(textured(material)), ElementsAre(near(5, 5), near(6, 5), near(5, 6)));
    EXPECT_THAT(left_out_, ElementsAre(HasSubstr("occlusionTexture: its texture coordinates are not supported")));
}

TEST_F(GltfExtensions, TexturesOfAMaterialAreLaidAlike) {
    const json half = {{"scale", {0.5, 0.5}}};
    json material = based(texture(half));
    material["normalTexture"] = texture(half);
    EXPECT_THAT(uv(textured(material)), ElementsAre(near(0, 0), near(0.5f, 0), near(0, 0.5f)));
    EXPECT_THAT(left_out_, IsEmpty());
    material["normalTexture"] = texture({{"scale", {2, 2}}});
    GltfBuilder b = textured(material);
    EXPECT_THAT(uv(b), ElementsAre(near(0, 0), near(0.5f, 0), near(0, 0.5f)));
    EXPECT_THAT(left_out_, ElementsAre(HasSubstr("normalTexture: its texture coordinates")));
    b.doc["extensionsRequired"] = {"KHR_texture_transform"};
    expect_error(b, "material 0 \"\": normalTexture: its KHR_texture_transform differs");
}

TEST_F(GltfExtensions, TextureTransformOfAWrongType) {
    const std::pair<json, const char*> cases[] = {
        {{{"scale", 2}}, "scale: two numbers"},       {{{"offset", {0, 0, 0}}}, "offset: two numbers"},
        {{{"offset", {0, "x"}}}, "offset: a number"}, {{{"rotation", "pi"}}, "rotation: a number"},
        {{{"scale", {1e300, 1}}}, "scale: 1e+300"},   {{{"texCoord", 0.5}}, "texCoord: a whole number"}};
    for (const auto& [transform, says] : cases) expect_error(textured(based(texture(transform))), says);
}

TEST_F(GltfExtensions, UnlitShowsItsColourAtTheExposure) {
    json material = based({{"index", 0}});
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0.5, 0, 0.25};
    material["alphaMode"] = "BLEND";
    material["extensions"]["KHR_materials_unlit"] = json::object();
    GltfBuilder b = textured(material);
    b.doc["extensionsRequired"] = {"KHR_materials_unlit"};
    b.doc["scenes"][0]["extras"]["exposure"] = 3;
    const Scene scene = load(b);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.emissive, 9.6f * glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(m.emissive_picture, m.base_color_picture);
    EXPECT_EQ(m.base_color, glm::vec4(0, 0, 0, 0.25f));
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.dielectric_f0, 0);
    b.doc["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        b.accessor<float>({1, 0, 0, 1, 1, 1, 1, 1, 1}, GltfBuilder::f32, "VEC3");
    (void)uv(b);
    EXPECT_THAT(left_out_, ElementsAre(HasSubstr("vertex colours of unlit materials")));
}

TEST_F(GltfExtensions, RequiredAndUnsupportedIsRefusedUsedIsToldOnce) {
    GltfBuilder b;
    b.triangle();
    for (const char* name : {"KHR_texture_basisu", "KHR_draco_mesh_compression"}) {
        b.doc["extensionsUsed"] = {name};
        b.doc["extensionsRequired"] = json::array();
        (void)uv(b);
        EXPECT_THAT(left_out_, ElementsAre(HasSubstr(name)));
        b.doc["extensionsRequired"] = {name};
        expect_error(b, std::string("requires the extension ") + name);
    }
}

}  // namespace
}  // namespace tyndall
