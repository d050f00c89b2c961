#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/image.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::ElementsAre;

class Gltf : public SceneFolderTest {
  protected:
    /// The bytes of a PNG of one colour (0..1).
    [[nodiscard]] std::string png(glm::ivec2 size, glm::vec4 color) const {
        Image image(size, 4);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = color[static_cast<int>(i % 4)];
        write_image(folder / "picture.png", image);
        return read_text(folder / "picture.png");
    }
};

Mesh only_mesh(const Scene& scene) {
    EXPECT_EQ(scene.meshes.size(), 1u);
    return scene.meshes.at(0);
}

std::vector<glm::vec3> corners(const Mesh& mesh) {
    std::vector<glm::vec3> out;
    for (const std::uint32_t i : mesh.indices) out.push_back(mesh.vertices[i].position);
    return out;
}

TEST_F(Gltf, TextAndBinaryGiveTheSameTriangle) {
    GltfBuilder b;
    b.triangle();
    for (const auto& path : {write("a.gltf", b.text()), write("a.glb", b.glb())}) {
        const Scene scene = load_gltf(path);
        EXPECT_EQ(scene.path, path);
        EXPECT_THAT(corners(only_mesh(scene)), ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 2, 0)));
        EXPECT_EQ(scene.bounds.min, glm::vec3(0));
        EXPECT_EQ(scene.bounds.max, glm::vec3(1, 2, 0));
        ASSERT_EQ(scene.materials.size(), 1u);
        EXPECT_EQ(scene.materials[0].roughness, 1);
        EXPECT_THAT(scene.nodes.at(0).meshes, ElementsAre(0));
    }
}

TEST_F(Gltf, ReadsBuffersAndPicturesBesideIt) {
    GltfBuilder b;
    b.triangle()["material"] = 0;
    std::filesystem::create_directories(folder / "scene/my textures");
    write("my textures/a.png", png({2, 3}, {1, 0, 0, 1}));
    write("data 1.bin", b.bytes);
    b.doc["buffers"] = {{{"byteLength", b.bytes.size()}, {"uri", "data%201.bin"}}};
    b.doc["images"] = {{{"uri", "my%20textures/a.png"}}};
    b.doc["textures"] = {{{"source", 0}}};
    b.doc["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    const Scene scene = load(b);
    ASSERT_EQ(scene.pictures.size(), 1u);
    EXPECT_EQ(scene.pictures[0].size, glm::ivec2(2, 3));
    EXPECT_EQ(scene.materials[0].emissive_picture, 0);
    EXPECT_EQ(only_mesh(scene).vertices.size(), 3u);
}

TEST_F(Gltf, IndicesOfEveryWidthStripsFansAndNone) {
    const std::vector<float> quad = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<int> order = {0, 1, 2, 2, 1, 3};
    const auto index_accessor = [&](GltfBuilder& b, GltfBuilder::Component type) {
        if (type == GltfBuilder::u8)
            return b.accessor(std::vector<std::uint8_t>(order.begin(), order.end()), type, "SCALAR");
        if (type == GltfBuilder::u16)
            return b.accessor(std::vector<std::uint16_t>(order.begin(), order.end()), type, "SCALAR");
        return b.accessor(std::vector<std::uint32_t>(order.begin(), order.end()), type, "SCALAR");
    };
    for (const auto type : {GltfBuilder::u8, GltfBuilder::u16, GltfBuilder::u32}) {
        GltfBuilder b;
        json& primitive = b.triangle();
        primitive["attributes"]["POSITION"] = b.accessor(quad, GltfBuilder::f32, "VEC3");
        primitive["indices"] = index_accessor(b, type);
        const Mesh mesh = only_mesh(load(b));
        EXPECT_THAT(corners(mesh), ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0),
                                               glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0)));
    }
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        json& primitive = b.triangle();
        primitive["attributes"]["POSITION"] = b.accessor(quad, GltfBuilder::f32, "VEC3");
        primitive.erase("indices");
        primitive["mode"] = mode;
        const Mesh mesh = only_mesh(load(b));
        ASSERT_EQ(mesh.indices.size(), 6u);
        // Flat normals are of the winding: a strip of this quad faces +z twice, a fan of it +z and then -z.
        EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(mesh.vertices[3].normal, glm::vec3(0, 0, mode == 5 ? 1 : -1));
    }
}

TEST_F(Gltf, NormalisedInterleavedAndSparseAccessors) {
    GltfBuilder b;
    json& primitive = b.triangle();
    primitive["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 3, 0, 3, 0, 0, 0, 0}, GltfBuilder::f32, "VEC3");
    const int uv = b.accessor<std::uint16_t>({0, 65535, 32768, 0, 65535, 65535}, GltfBuilder::u16, "VEC2");
    b.doc["accessors"][static_cast<std::size_t>(uv)]["normalized"] = true;
    b.doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
    const int replaced = b.view<std::uint8_t>({2});
    const int values = b.view<float>({5, 6, 7});
    b.doc["accessors"][0]["sparse"] = {{"count", 1},
                                       {"indices", {{"bufferView", replaced}, {"componentType", 5121}}},
                                       {"values", {{"bufferView", values}}}};
    const Mesh mesh = only_mesh(load(b));
    EXPECT_EQ(mesh.vertices[0].uv, glm::vec2(0, 1));
    EXPECT_NEAR(mesh.vertices[1].uv.x, 32768.0f / 65535.0f, 1e-7f);
    EXPECT_EQ(mesh.vertices[2].position, glm::vec3(5, 6, 7));
    EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.vertices[1].normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.vertices[2].normal, glm::vec3(0, 1, 0));  // no length

    GltfBuilder stride;
    json& strided = stride.triangle();
    const int both =
        stride.accessor<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}, GltfBuilder::f32, "VEC3");
    json& accessor = stride.doc["accessors"][static_cast<std::size_t>(both)];
    accessor["count"] = 3;
    stride.doc["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteStride"] = 24;
    json normals = accessor;
    normals["byteOffset"] = 12;
    strided["attributes"] = {{"POSITION", both}, {"NORMAL", stride.append("accessors", normals)}};
    const Mesh interleaved = only_mesh(load(stride));
    EXPECT_EQ(interleaved.vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(interleaved.vertices[2].position, glm::vec3(0, 1, 0));
    EXPECT_EQ(interleaved.vertices[2].normal, glm::vec3(0, 0, 1));
}

TEST_F(Gltf, SignedNormalisedIntegersReachMinusOne) {
    GltfBuilder b;
    json& primitive = b.triangle();
    const int normal = b.accessor<std::int8_t>({-128, 0, 0, 127, 0, 0, 0, -127, 0}, GltfBuilder::i8, "VEC3");
    b.doc["accessors"][static_cast<std::size_t>(normal)]["normalized"] = true;
    primitive["attributes"]["NORMAL"] = normal;
    const Mesh mesh = only_mesh(load(b));
    EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(-1, 0, 0));
    EXPECT_EQ(mesh.vertices[1].normal, glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.vertices[2].normal, glm::vec3(0, -1, 0));
}

TEST_F(Gltf, MissingTangentsFollowTheTextureCoordinates) {
    // u runs along +y and v along +x of the triangle: the tangent is +y; the bitangent is against v, -x, which is
    // cross(+z, +y) * 1.
    GltfBuilder b;
    json& primitive = b.triangle();
    primitive["material"] = 0;
    primitive["attributes"]["NORMAL"] = b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, GltfBuilder::f32, "VEC3");
    primitive["attributes"]["TEXCOORD_0"] = b.accessor<float>({0, 0, 0, 1, 1, 0}, GltfBuilder::f32, "VEC2");
    const int image = b.view(png({1, 1}, {0.5f, 0.5f, 1, 1}));
    b.doc["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    b.doc["textures"] = {{{"source", 0}}};
    b.doc["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Mesh mapped = only_mesh(load(b));
    for (const Vertex& v : mapped.vertices) {
        EXPECT_NEAR(glm::distance(glm::vec3(v.tangent), glm::vec3(0, 1, 0)), 0, 1e-6f);
        EXPECT_EQ(v.tangent.w, 1);
    }
    // Without a normal map, or with no area in uv, any unit vector orthogonal to the normal will do.
    b.doc["materials"][0] = json::object();
    const Mesh unmapped = only_mesh(load(b));
    for (const Vertex& v : unmapped.vertices) {
        EXPECT_NEAR(glm::length(glm::vec3(v.tangent)), 1, 1e-6f);
        EXPECT_NEAR(v.tangent.z, 0, 1e-6f);
    }
}

TEST_F(Gltf, MaterialsWithAllTheirParts) {
    GltfBuilder b;
    b.triangle()["material"] = 1;
    const int red = b.view(png({4, 2}, {1, 0, 0.5f, 0.25f})), grey = b.view(png({1, 1}, {0.2f, 0.2f, 0.2f, 1}));
    b.doc["images"] = {
        {{"bufferView", grey}}, {{"bufferView", red}, {"name", "red"}}, {{"uri", "not-used.png"}, {"name", "x"}}};
    b.doc["images"].erase(2);
    b.doc["textures"] = {{{"source", 1}}, {{"source", 0}}};
    b.doc["materials"] = {
        {{"name", "plain"}},
        {{"name", "full"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.25},
           {"baseColorTexture", {{"index", 0}}},
           {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"normalTexture", {{"index", 1}, {"scale", 0.75}}},
         {"occlusionTexture", {{"index", 1}, {"strength", 0.5}}},
         {"emissiveTexture", {{"index", 0}}},
         {"emissiveFactor", {0.5, 1, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 200}}},
           {"KHR_materials_ior", {{"ior", 3}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {0.25, 0.5, 0.125}}}}}}},
        {{"alphaMode", "BLEND"}}};
    const Scene scene = load(b);
    ASSERT_EQ(scene.materials.size(), 3u);
    const Material& plain = scene.materials[0];
    EXPECT_EQ(plain.base_color, glm::vec4(1));
    EXPECT_EQ(plain.base_color_picture, -1);
    EXPECT_EQ(plain.dielectric_f0, 0.04f);
    EXPECT_FALSE(plain.alpha_mask || plain.alpha_blend || plain.double_sided);
    const Material& full = scene.materials[1];
    EXPECT_EQ(full.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(full.metallic, 0.5f);
    EXPECT_EQ(full.roughness, 0.25f);
    EXPECT_EQ(full.emissive, glm::vec3(100, 200, 0));
    EXPECT_EQ(full.dielectric_f0, 0.0625f);  // ((3 - 1) / (3 + 1))² * 0.5 * 0.5
    EXPECT_EQ(full.normal_scale, 0.75f);
    EXPECT_EQ(full.occlusion_strength, 0.5f);
    EXPECT_TRUE(full.alpha_mask && full.double_sided);
    EXPECT_EQ(full.alpha_cutoff, 0.3f);
    EXPECT_TRUE(scene.materials[2].alpha_blend);
    ASSERT_EQ(scene.pictures.size(), 2u);
    EXPECT_EQ(full.base_color_picture, full.emissive_picture);
    EXPECT_EQ(full.normal_picture, full.occlusion_picture);
    const Picture& picture = scene.pictures[static_cast<std::size_t>(full.base_color_picture)];
    EXPECT_EQ(picture.name, "red");
    EXPECT_EQ(picture.size, glm::ivec2(4, 2));
    EXPECT_THAT(std::vector(picture.rgba.end() - 4, picture.rgba.end()), ElementsAre(255, 0, 128, 64));
}

TEST_F(Gltf, WhatTransmitsLightIsTransparent) {
    const auto glass = [](double transmission, const char* mode) {
        return json{
            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 0.5}}, {"baseColorTexture", {{"index", 0}}}}},
            {"emissiveTexture", {{"index", 0}}},
            {"alphaMode", mode},
            {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}}}};
    };
    GltfBuilder b;
    b.doc["extensionsRequired"] = json::array({"KHR_materials_transmission"});
    b.doc["images"] = {{{"bufferView", b.view(png({1, 1}, {1, 0, 0.5f, 0.25f}))}}};
    b.doc["textures"] = {{{"source", 0}}};
    b.doc["materials"] = {glass(0.75, "OPAQUE"), glass(0.5, "BLEND"), glass(0.5, "MASK"), glass(0, "OPAQUE"),
                          glass(0, "MASK")};
    for (int i = 0; i < 5; ++i) {
        json& primitive = b.triangle();
        primitive["material"] = i;
        primitive["attributes"]["COLOR_0"] =
            b.accessor<float>({1, 1, 1, 0.5f, 1, 1, 1, 0.5f, 1, 1, 1, 0.5f}, GltfBuilder::f32, "VEC4");
    }
    const Scene scene = load(b);
    ASSERT_EQ(scene.materials.size(), 5u);
    const float transmission[] = {0.75f, 0.5f, 0.5f, 0, 0};
    const bool blend[] = {true, true, true, false, false}, mask[] = {false, false, false, false, true};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(scene.materials[i].transmission, transmission[i]) << i;
        EXPECT_EQ(scene.materials[i].alpha_blend, blend[i]) << i;
        EXPECT_EQ(scene.materials[i].alpha_mask, mask[i]) << i;
    }
    // Alpha is 1 where the file says OPAQUE, and what the file holds elsewhere.
    const auto alphas = [&](std::size_t i) {
        const Material& m = scene.materials[i];
        return glm::vec3(m.base_color.a,
                         scene.pictures[static_cast<std::size_t>(m.base_color_picture)].rgba[3] / 255.0f,
                         scene.meshes[i].vertices[2].color.a);
    };
    EXPECT_EQ(alphas(0), glm::vec3(1));
    EXPECT_NEAR(glm::distance(alphas(1), glm::vec3(0.5f, 0.25f, 0.5f)), 0, 1e-2f);
    EXPECT_NEAR(glm::distance(alphas(2), glm::vec3(0.5f, 0.25f, 0.5f)), 0, 1e-2f);
    EXPECT_EQ(scene.pictures.size(), 2u);
    EXPECT_NE(scene.materials[0].emissive_picture, scene.materials[0].base_color_picture);
}

TEST_F(Gltf, NodesMatricesAndInstancing) {
    GltfBuilder b;
    b.triangle();
    // Rotation by 90 degrees about z with scale (2, 3, 4) and translation (5, 6, 7), by columns.
    b.doc["nodes"][0] = {{"children", {1}}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}};
    const int translation = b.accessor<float>({1, 0, 0, 0, 1, 0}, GltfBuilder::f32, "VEC3");
    const int scale = b.accessor<float>({1, 1, 1, 2, 2, 2}, GltfBuilder::f32, "VEC3");
    b.append("nodes",
             {{"mesh", 0},
              {"extras", {{"cast_shadow", false}}},
              {"extensions",
               {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translation}, {"SCALE", scale}}}}}}}});
    const Scene scene = load(b);
    ASSERT_EQ(scene.nodes.size(), 4u);
    EXPECT_TRUE(scene.nodes[1].meshes.empty());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) EXPECT_LT(scene.nodes[i].parent, static_cast<int>(i));
    EXPECT_THAT(scene.nodes[2].meshes, ElementsAre(0));
    EXPECT_FALSE(scene.nodes[2].cast_shadow || scene.nodes[3].cast_shadow);
    EXPECT_NEAR(glm::distance(scene.nodes[0].scale, glm::vec3(2, 3, 4)), 0, 1e-6f);
    // (1, 0, 0) in the second instance is (2, 1, 0) in the parent: (5 - 3, 6 + 4, 7) in the world.
    const glm::vec4 p = scene.nodes[3].world * glm::vec4(1, 0, 0, 1);
    EXPECT_NEAR(glm::distance(glm::vec3(p), glm::vec3(2, 10, 7)), 0, 1e-5f);
}

TEST_F(Gltf, MirroredAndFlattenedNodesKeepTheMeshAsItIs) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}, {"scale", {-1, 1, 1}}});
    b.node({{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1}}});
    b.node({{"mesh", 0}, {"matrix", {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}}});
    b.node({{"mesh", 0}, {"matrix", {0, 1, 0, 0, -2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}}});
    const Scene scene = load(b);
    EXPECT_EQ(scene.meshes.size(), 1u);
    const bool mirrored[] = {false, true, true, false, false};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(mirrors(scene.nodes[i].world), mirrored[i]) << i;
    EXPECT_EQ(scene.nodes[3].scale, glm::vec3(3, 0, 0));
    EXPECT_NEAR(glm::distance(glm::vec3(scene.nodes[3].world * glm::vec4(1, 1, 1, 1)), glm::vec3(0, 0, 3)), 0,
                1e-6f);
    EXPECT_NEAR(glm::distance(glm::vec3(scene.nodes[4].world * glm::vec4(1, 1, 1, 1)), glm::vec3(-2, 1, 0)), 0,
                1e-6f);
}

TEST_F(Gltf, OnlyTheDefaultSceneIsLoaded) {
    GltfBuilder b;
    b.triangle();
    b.append("nodes", {{"name", "other"}});
    b.doc["scenes"].push_back({{"nodes", {1}}});
    b.doc["scene"] = 1;
    const Scene scene = load(b);
    ASSERT_EQ(scene.nodes.size(), 1u);
    EXPECT_EQ(scene.nodes[0].name, "other");
    EXPECT_TRUE(scene.bounds.empty());
}

TEST_F(Gltf, LightsAreSharedDefinitionsWithTheirExtras) {
    GltfBuilder b;
    b.light({{"type", "directional"}, {"color", {1, 0.5, 0.25}}, {"intensity", 1000}, {"name", "sun"}});
    b.light({{"type", "point"}, {"intensity", 4}});
    b.light({{"type", "spot"},
             {"intensity", 9},
             {"range", 5},
             {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}},
             {"extras", {{"radius", 0.125}, {"shadow", false}}}});
    b.node({{"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}, {"translation", {1, 2, 3}}});
    b.doc["extensionsRequired"] = json::array({"KHR_lights_punctual"});
    const Scene scene = load(b);
    ASSERT_EQ(scene.lights.size(), 4u);
    ASSERT_TRUE(scene.sun());
    EXPECT_EQ(scene.lights[*scene.sun()].name, "sun");
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(1000, 500, 250));
    EXPECT_EQ(scene.lights[1].type, LightType::point);
    EXPECT_NEAR(scene.lights[1].range, 20, 1e-4f);  // 4 cd / (20 m)^2 = 0.01 lx, in daylight
    EXPECT_EQ(scene.lights[1].radius, 0.01f);
    EXPECT_TRUE(scene.lights[1].shadow);
    for (const std::size_t i : {2u, 3u}) {
        EXPECT_EQ(scene.lights[i].type, LightType::spot);
        EXPECT_EQ(scene.lights[i].range, 5);
        EXPECT_EQ(scene.lights[i].inner_cone, 0.25f);
        EXPECT_EQ(scene.lights[i].outer_cone, 0.5f);
        EXPECT_EQ(scene.lights[i].radius, 0.125f);
        EXPECT_FALSE(scene.lights[i].shadow);
    }
    EXPECT_EQ(glm::vec3(scene.nodes[static_cast<std::size_t>(scene.lights[3].node)].world[3]), glm::vec3(1, 2, 3));
}

// What the end of a lamp without a range takes from a white surface is nowhere as much as half a step of 8 bits at
// the scene's exposure, in which 1.2 * 2^EV cd/m² are white and sRGB is linear near black.
TEST_F(Gltf, LampsWithoutARangeEndWhereTheyChangeNoPixel) {
    for (const double exposure : {-6.0, 0.0, 5.0, 15.0}) {
        GltfBuilder b;
        b.light({{"type", "point"}, {"intensity", 100}});
        b.doc["scenes"][0]["extras"]["exposure"] = exposure;
        const Light light = load(b).lights.at(0);
        const double range = light.range, step = std::numbers::pi * 1.2 * std::exp2(exposure) / (255 * 12.92);
        for (double d = range / 64; d < 4 * range; d *= 1.1) {
            const double window = std::max(1 - std::pow(d / range, 4), 0.0);
            EXPECT_LT(100 / (d * d) * (1 - window), 0.5 * step) << exposure << " EV at " << d << " m";
        }
        EXPECT_GE(range, 99.9) << "0.01 lx at the latest";
        EXPECT_LT(range, 1e4);
    }
}

TEST_F(Gltf, CamerasAnimationsAndSceneExtras) {
    GltfBuilder b;
    b.doc["cameras"] = {
        {{"type", "perspective"}, {"name", "Sun"}, {"perspective", {{"yfov", 0.75}, {"znear", 0.25}}}}};
    const int camera = b.node({{"name", "eye"}, {"camera", 0}, {"children", {1}}});
    b.append("nodes", {{"name", "child"}});
    b.append("nodes", {{"name", "still"}});
    b.doc["scenes"][0]["nodes"].push_back(2);
    const int times = b.accessor<float>({0.5f, 2}, GltfBuilder::f32, "SCALAR");
    const int moves = b.accessor<float>({1, 0, 0, 3, 0, 0}, GltfBuilder::f32, "VEC3");
    const int turns = b.accessor<float>({0, 0, 0, 2, 0, 2, 0, 0}, GltfBuilder::f32, "VEC4");
    b.doc["animations"] = {
        {{"name", "flythrough"},
         {"samplers",
          {{{"input", times}, {"output", moves}},
           {{"input", times}, {"output", turns}, {"interpolation", "STEP"}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", camera}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", camera}, {"path", "rotation"}}}}}},
         {"extras", {{"places", {{{"name", "Sun"}, {"time", 1.5}}, {{"name", "Depth"}, {"time", 2}}}}}}}};
    b.doc["scenes"][0]["extras"] = {{"exposure", 12.5},
                                    {"media", {{{"shape", "global"}, {"scattering", {0.1, 0.1, 0.1}}}}}};
    const Scene scene = load(b);
    EXPECT_EQ(scene.exposure_ev100, 12.5f);
    ASSERT_EQ(scene.media.size(), 1u);
    ASSERT_NE(scene.find_camera("Sun"), nullptr);
    EXPECT_EQ(scene.find_camera("Sun"), scene.find_camera("eye"));
    EXPECT_EQ(scene.find_camera("none"), nullptr);
    EXPECT_EQ(scene.find_camera("Sun")->yfov, 0.75f);
    EXPECT_EQ(scene.find_camera("Sun")->znear, 0.25f);
    const Animation* fly = scene.find_animation("flythrough");
    ASSERT_NE(fly, nullptr);
    EXPECT_EQ(fly->duration, 2);
    ASSERT_EQ(fly->places.size(), 2u);
    EXPECT_EQ(fly->places[0].name, "Sun");
    EXPECT_EQ(fly->places[0].time, 1.5f);
    ASSERT_EQ(fly->channels.size(), 2u);
    EXPECT_EQ(fly->channels[0].values[1], glm::vec4(3, 0, 0, 0));
    EXPECT_EQ(fly->channels[1].values[1], glm::vec4(0, 1, 0, 0));  // normalised
    EXPECT_TRUE(scene.find_node("eye")->dynamic && scene.find_node("child")->dynamic);
    EXPECT_FALSE(scene.find_node("still")->dynamic);
}

TEST_F(Gltf, MediaMayBeAnObjectOrText) {
    const json list = json::array({{{"shape", "global"}, {"scattering", {1, 1, 1}}}});
    for (const json& media : {list, json{{"media", list}}, json(list.dump())}) {
        GltfBuilder b;
        b.node({{"name", "empty"}});
        b.doc["scenes"][0]["extras"]["media"] = media;
        EXPECT_EQ(load(b).media.size(), 1u);
    }
}

TEST_F(Gltf, PointsAndLinesAreLeftOut) {
    GltfBuilder b;
    b.triangle()["mode"] = 1;
    EXPECT_TRUE(load(b).meshes.empty());
}

}  // namespace
}  // namespace tyndall
