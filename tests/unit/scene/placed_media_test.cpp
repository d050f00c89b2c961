// Fog by placing: a node's extras.medium is the same as that medium in the scene's media, with the node's place and
// size.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "tests/support/grid_files.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

class PlacedMedia : public SceneFolderTest {
  protected:
    /// A node with a medium; its other members are `node`'s.
    static GltfBuilder placed(const json& medium, json node = json::object()) {
        GltfBuilder b;
        node["extras"]["medium"] = medium;
        b.node(std::move(node));
        return b;
    }
    void expect_error(const GltfBuilder& b, const std::string& fragment) const {
        EXPECT_THAT([&] { (void)load(b); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("scene.gltf: node 0 \"fog\": extras.medium"),
                                               HasSubstr(fragment), Not(HasSubstr("\n")))));
    }
};

json with(json medium, const json& more) {
    medium.update(more);
    return medium;
}

/// Of how they fill space; rotations up to rounding and sign.
void expect_same(const Medium& a, const Medium& b) {
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.sigma_s, b.sigma_s);
    EXPECT_EQ(a.sigma_a, b.sigma_a);
    EXPECT_EQ(a.anisotropy, b.anisotropy);
    EXPECT_EQ(a.emission, b.emission);
    EXPECT_LT(glm::distance(a.center, b.center), 1e-5f);
    EXPECT_LT(glm::distance(a.half_extent, b.half_extent), 1e-5f);
    EXPECT_NEAR(std::abs(glm::dot(a.rotation, b.rotation)), 1, 1e-6f);
    EXPECT_EQ(a.softness, b.softness);
    EXPECT_EQ(a.noise_scale, b.noise_scale);
    EXPECT_EQ(a.noise_amount, b.noise_amount);
    EXPECT_EQ(a.noise_seed, b.noise_seed);
    EXPECT_EQ(a.height_profile, b.height_profile);
    EXPECT_EQ(a.base, b.base);
    EXPECT_EQ(a.falloff, b.falloff);
    EXPECT_EQ(a.grid == nullptr, b.grid == nullptr);
    EXPECT_NEAR(a.scale, b.scale, 1e-5f);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.center_at_start, b.center_at_start);
}

const json room_fog =
    json::parse(R"({"scattering":[0.1,0.2,0.3], "absorption":[0.01,0,0], "anisotropy":0.4, "emission":[1,0,2],
    "softness":0.25, "noise":{"scale":1.5,"amount":0.6,"seed":7}, "height":{"base":0.5,"falloff":1.2}})");
const json turned = {{"translation", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 1, 0.5}}};

TEST_F(PlacedMedia, IsTheSameMediumWrittenByHand) {
    const std::tuple<json, json, json> cases[] = {
        // An empty is 2 m wide, high and deep. The shape is a box where none is given.
        {room_fog,
         turned,
         {{"shape", "box"}, {"center", {1, 2, 3}}, {"size", {4, 2, 1}}, {"rotation", {0, 0.6, 0, 0.8}}}},
        {with(room_fog, {{"shape", "ellipsoid"}}),
         turned,
         {{"shape", "ellipsoid"}, {"center", {1, 2, 3}}, {"radii", {2, 1, 0.5}}, {"rotation", {0, 0.6, 0, 0.8}}}},
        {with(room_fog, {{"shape", "sphere"}}),
         {{"translation", {0, 1, 0}}, {"scale", {3, 3, 3}}},
         {{"shape", "sphere"}, {"center", {0, 1, 0}}, {"radius", 3}}},
        // A mirrored one is as large as it is.
        {with(room_fog, {{"shape", "box"}}),
         {{"scale", {-1, 2, 3}}},
         {{"shape", "box"}, {"center", {0, 0, 0}}, {"size", {2, 4, 6}}}},
    };
    for (const auto& [medium, node, place] : cases) {
        SCOPED_TRACE(place.dump());
        const Scene by_node = load(placed(medium, node)), by_text = load(placed(medium.dump(), node));
        const Medium by_hand = parse_media(json::array({with(room_fog, place)}), "fog.json", ".").at(0);
        ASSERT_EQ(by_node.media.size(), 1u);
        expect_same(by_node.media[0], by_hand);
        expect_same(by_text.media.at(0), by_hand);
    }
}

TEST_F(PlacedMedia, AMeshSaysWhereAndIsNotDrawn) {
    GltfBuilder b;
    b.triangle();  // from 0 0 0 to 1 2 0
    b.doc["nodes"][0].update({{"name", "fog"}, {"translation", {0, 0, -1}}});
    b.node({{"name", "seen"}, {"mesh", 0}});
    const int corners = b.accessor<float>({-1, 0, -3, 3, 2, 3, 0, 1, 0}, GltfBuilder::f32, "VEC3");
    b.doc["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", corners}}}}}}});
    b.doc["nodes"][0]["mesh"] = 1;
    b.doc["nodes"][0]["extras"]["medium"] = room_fog;
    b.doc["scenes"][0]["extras"]["media"] = {{{"shape", "global"}, {"scattering", {1, 1, 1}}}};
    const Scene scene = load(b);
    ASSERT_EQ(scene.media.size(), 2u);  // behind those of the scene
    EXPECT_EQ(scene.media[1].center, glm::vec3(1, 1, -1));
    EXPECT_EQ(scene.media[1].half_extent, glm::vec3(2, 1, 3));
    EXPECT_THAT(scene.nodes[0].meshes, IsEmpty());
    EXPECT_EQ(scene.bounds.max, glm::vec3(1, 2, 0));
}

TEST_F(PlacedMedia, InAChainOfParents) {
    GltfBuilder b = placed(room_fog, {{"name", "fog"}, {"translation", {1, 0, 0}}, {"rotation", {0, 0, 0.6, 0.8}}});
    b.doc["nodes"].push_back({{"children", {0}}, {"translation", {0, 5, 0}}, {"scale", {2, 2, 2}}});
    b.doc["scenes"][0]["nodes"] = {1};
    const Medium medium = load(b).media.at(0);
    EXPECT_LT(glm::distance(medium.center, glm::vec3(2, 5, 0)), 1e-5f);
    EXPECT_LT(glm::distance(medium.half_extent, glm::vec3(2)), 1e-5f);
    EXPECT_NEAR(std::abs(medium.rotation.z), 0.6f, 1e-6f);
    b.doc["nodes"][1]["scale"] = {2, 1, 1};
    expect_error(b, "shear");
}

TEST_F(PlacedMedia, AGridInItsNode) {
    TestGrid ball;
    ball.voxels = {{{0, 0, 0}, 1}, {{1, 0, 0}, 0.5f}};
    write_vdb(folder / "scene/ball.vdb", {ball});
    const json grid = {{"shape", "grid"}, {"file", "ball.vdb"}, {"scattering", {1, 1, 1}}, {"density", 2}};
    json node = {{"name", "fog"}, {"translation", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 2, 2}}};
    const json by_hand = with(grid, {{"translation", {1, 2, 3}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", 2}});
    expect_same(load(placed(grid, node)).media.at(0),
                parse_media(json::array({by_hand}), "fog.json", folder / "scene").at(0));
    node["scale"] = {2, 2, -2};
    expect_error(placed(grid, node), "mirrors, one scale");
    node["scale"] = {2, 2, 1};
    expect_error(placed(grid, node), "scales by 2 2 1, one scale");
}

TEST_F(PlacedMedia, WhatIsWrongIsNamed) {
    const auto node = [](const json& more = json::object()) { return with({{"name", "fog"}}, more); };
    expect_error(placed(with(room_fog, {{"shape", "sphere"}}), node(turned)),
                 "radii of 2 1 0.5 m of the sphere, an ellipsoid");
    expect_error(placed(with(room_fog, {{"shape", "global"}}), node()), ".shape: \"global\" given");
    expect_error(placed(with(room_fog, {{"shape", 3}}), node()), ".shape: 3 given");
    expect_error(placed(with(room_fog, {{"center", {0, 0, 0}}}), node()), ".center: none expected");
    expect_error(placed(with(room_fog, {{"softness", -1}}), node()), ".softness: -1 given");
    expect_error(placed(with(room_fog, {{"colour", 1}}), node()), "unknown key \"colour\"");
    expect_error(placed(room_fog, node({{"scale", {1, 0, 1}}})), "a scale of 0");
    expect_error(placed(room_fog, node({{"scale", {1, 1e-9, 1}}})), ".size[1]: ");
    expect_error(placed("{", node()), "the text is not valid JSON");
    expect_error(placed("[]", node()), "[] given, an object");
    expect_error(placed(5, node()), "5 given, an object");
    GltfBuilder b = placed(room_fog, node());
    b.doc["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        b.accessor<float>({0, 0, 0}, GltfBuilder::f32, "VEC3");
    expect_error(b, "skin or instances");
}

TEST_F(PlacedMedia, StaysWhereItsNodeBegins) {
    GltfBuilder b = placed(room_fog, {{"name", "fog"}, {"translation", {9, 9, 9}}});
    const int times = b.accessor<float>({0, 1}, GltfBuilder::f32, "SCALAR"),
              places = b.accessor<float>({1, 0, 0, 5, 0, 0}, GltfBuilder::f32, "VEC3");
    b.doc["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    GltfNotes notes;
    const Scene scene = load_gltf(write("scene.gltf", b.text()), notes);
    EXPECT_EQ(scene.media.at(0).center, glm::vec3(1, 0, 0));
    EXPECT_THAT(notes.left_out,
                testing::ElementsAre("node 0 \"fog\": extras.medium: it stays where the node begins"));
}

}  // namespace
}  // namespace tyndall
