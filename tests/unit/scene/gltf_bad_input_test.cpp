#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::ThrowsMessage;

class GltfBadInput : public SceneFolderTest {
  protected:
    void expect_error(const std::filesystem::path& path, const std::string& fragment) const {
        EXPECT_THAT([&] { (void)load_gltf(path); },
                    ThrowsMessage<Error>(AllOf(HasSubstr(path.string()), HasSubstr(fragment), Not(HasSubstr("\n")),
                                               SizeIs(testing::Lt(600)))));
    }
    [[nodiscard]] std::string png() const {
        Image image({8, 8}, 4);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 7) / 7;
        write_image(folder / "picture.png", image);
        return read_text(folder / "picture.png");
    }
    /// A file with something of everything the loader reads.
    [[nodiscard]] GltfBuilder full() const {
        GltfBuilder b;
        json& primitive = b.triangle();
        primitive["material"] = 0;
        primitive["attributes"]["NORMAL"] =
            b.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, GltfBuilder::f32, "VEC3");
        primitive["attributes"]["TEXCOORD_0"] = b.accessor<float>({0, 0, 1, 0, 0, 1}, GltfBuilder::f32, "VEC2");
        b.doc["images"] = {{{"bufferView", b.view(png())}, {"mimeType", "image/png"}, {"name", "bricks"}}};
        b.doc["textures"] = {{{"source", 0}}};
        b.doc["materials"] = {{{"name", "wall"},
                               {"normalTexture", {{"index", 0}}},
                               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        b.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
        b.node({{"camera", 0}, {"rotation", {0, 0.6, 0, 0.8}}, {"children", {2}}});
        b.append("nodes", {{"translation", {1, 2, 3}}});
        b.light({{"type", "spot"}, {"intensity", 100}, {"spot", json::object()}, {"extras", {{"radius", 0.1}}}});
        const int times = b.accessor<float>({0, 1}, GltfBuilder::f32, "SCALAR");
        const int moves = b.accessor<float>({0, 0, 0, 1, 1, 1}, GltfBuilder::f32, "VEC3");
        b.doc["animations"] = {
            {{"name", "a"},
             {"samplers", {{{"input", times}, {"output", moves}}}},
             {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}};
        b.doc["scenes"][0]["extras"] = {{"exposure", 3},
                                        {"media", {{{"shape", "global"}, {"scattering", {1, 1, 1}}}}}};
        return b;
    }
};

TEST_F(GltfBadInput, FilesThatAreNotThereOrNotGltf) {
    expect_error(folder / "none.glb", "No such file");
    expect_error(folder / "scene", "folder");
    expect_error(write("empty.glb", ""), "not a valid glTF");
    expect_error(write("text.gltf", "hello, world"), "not a valid glTF");
    expect_error(write("json.gltf", "{\"asset\": "), "not a valid glTF");
    expect_error(write("list.gltf", "[1, 2]"), "not a valid glTF");
    expect_error(write("object.gltf", "{\"nodes\": []}"), "not a valid glTF");
    expect_error(write("old.gltf", R"({"asset": {"version": "1.0"}})"), "glTF version 1.0");
    expect_error(write("deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + std::string(200'000, '[')),
                 "nested");
}

TEST_F(GltfBadInput, TruncatedBinary) {
    const std::string glb = full().glb();
    ASSERT_NO_THROW((void)load_gltf(write("whole.glb", glb)));
    expect_error(write("a.glb", glb.substr(0, glb.size() - 1)), "cut off or damaged");
    expect_error(write("b.glb", glb.substr(0, 30)), "cut off or damaged");
    expect_error(write("c.glb", glb.substr(0, 4)), "cut off or damaged");
    std::string version = glb;
    version[4] = 1;
    expect_error(write("d.glb", version), "version 1");
    // A binary chunk that claims the eight bytes behind the file's end.
    std::string longer = glb;
    std::uint32_t json_size = 0, size = 0;
    std::memcpy(&json_size, &longer[12], 4);
    std::memcpy(&size, &longer[20 + json_size], 4);
    size += 8;
    std::memcpy(&longer[20 + json_size], &size, 4);
    expect_error(write("e.glb", longer), "cut off or damaged");
}

TEST_F(GltfBadInput, UrisMustStayInTheScenesFolder) {
    write_text(folder / "x.bin", std::string(128, 'x'));
    write_text(folder / "x.png", png());
    std::filesystem::create_symlink(folder / "x.bin", folder / "scene/link.bin");
    const std::string absolute = (folder / "x.bin").string();
    for (const std::string& uri :
         {std::string("../x.bin"), std::string("%2e%2e/x.bin"), std::string("a/../../x.bin"), absolute,
          "file://" + absolute, std::string("http://example.org/x.bin"), std::string("link.bin"),
          std::string("none.bin"), std::string("data:audio/mp3;base64,AAAA")}) {
        GltfBuilder b;
        b.triangle();
        b.doc["buffers"] = {{{"byteLength", 128}, {"uri", uri}}};
        expect_error(write("buffer.gltf", b.text()), uri.starts_with("%") ? "../x.bin" : uri);
    }
    for (const std::string& uri : {std::string("../x.png"), (folder / "x.png").string(), std::string("none.png")}) {
        GltfBuilder b = full();
        b.doc["images"] = {{{"uri", uri}}};
        expect_error(write("image.gltf", b.text()), uri);
    }
}

TEST_F(GltfBadInput, PicturesThatDoNotDecodeAreNamed) {
    const std::string good = png();
    for (const std::string& bytes :
         {std::string("no picture"), good.substr(0, good.size() / 2), good.substr(0, 20)}) {
        GltfBuilder b = full();
        b.doc["images"][0]["bufferView"] = b.view(bytes);
        expect_error(write("picture.glb", b.glb()), "image 0 \"bricks\"");
        b.doc["images"] = {{{"uri", "bricks.png"}}};
        write("bricks.png", bytes);
        expect_error(write("picture.gltf", b.text()), "image 0 \"bricks.png\"");
    }
}

TEST_F(GltfBadInput, EveryDamagedPartIsNamed) {
    using Damage = std::function<void(GltfBuilder&)>;
    const auto set = [](const std::string& pointer, const json& value) {
        return [=](GltfBuilder& b) { b.doc[json::json_pointer(pointer)] = value; };
    };
    const auto poke = [](std::size_t accessor, std::size_t offset, float value) {
        return [=](GltfBuilder& b) {
            const auto view = b.doc["accessors"][accessor]["bufferView"].get<std::size_t>();
            std::memcpy(&b.bytes[b.doc["bufferViews"][view]["byteOffset"].get<std::size_t>() + offset], &value, 4);
        };
    };
    const json huge = std::uint64_t(1) << 62;
    const std::pair<Damage, std::string> cases[] = {
        {set("/extensionsRequired", json::array({"KHR_draco_mesh_compression"})), "KHR_draco_mesh_compression"},
        {set("/extensionsRequired", json::array({"KHR_lights_punctual", "MY_invention"})), "MY_invention"},
        {set("/buffers", {{{"byteLength", 4}, {"uri", "data:application/octet-stream;base64,AAAAAAAA"}}}),
         "valid glTF"},
        // accessors and views
        {set("/accessors/1/count", 300), "accessor 1"},
        {set("/accessors/0/count", 0), "accessor 0"},
        {set("/accessors/0/count", huge), "accessor 0"},
        {set("/accessors/0/byteOffset", 10), "accessor 0"},
        {set("/accessors/0/byteOffset", huge), "accessor 0"},
        {set("/accessors/0/type", "VEC2"), "wrong type"},
        {set("/accessors/0/componentType", 5124), "component type 5124"},
        {set("/accessors/0/componentType", 5127), "component type 5127"},
        {set("/accessors/0/bufferView", 99), "buffer view 99"},
        {set("/accessors/2/sparse", {{"count", 9},
                                     {"indices", {{"bufferView", 0}, {"componentType", 5121}}},
                                     {"values", {{"bufferView", 0}}}}),
         "sparse"},
        {set("/accessors/2/sparse", {{"count", 1},
                                     {"indices", {{"bufferView", 2}, {"byteOffset", 10}, {"componentType", 5121}}},
                                     {"values", {{"bufferView", 0}}}}),
         "sparse index 128"},
        {set("/bufferViews/0/byteLength", huge), "buffer view 0"},
        {set("/bufferViews/0/byteOffset", huge), "buffer view 0"},
        {set("/bufferViews/0/buffer", 3), "buffer 3"},
        {set("/bufferViews/0/buffer", -1), "buffer -1"},
        {set("/images/0/bufferView", 1000), "1000"},
        {[](GltfBuilder& b) { b.doc["bufferViews"][4]["byteOffset"] = 1 << 30; }, "bricks"},
        // meshes
        {poke(0, 4, NAN), "POSITION"},
        {poke(0, 0, INFINITY), "POSITION"},
        {poke(2, 0, NAN), "NORMAL"},
        {poke(1, 0, 1e9f), "out of range"},
        {set("/meshes/0/primitives/0/indices", 0), "indices"},
        {set("/meshes/0/primitives/0/indices", 99), "out of bounds"},
        {set("/meshes/0/primitives/0/material", 7), "material 7"},
        {set("/meshes/0/primitives/0/mode", 9), "mode 9"},
        {set("/meshes/0/primitives/0/attributes", json::object()), "POSITION"},
        {set("/meshes/0/primitives/0/attributes/NORMAL", -5), "accessor -5"},
        {set("/meshes/0/primitives/0/attributes/TEXCOORD_0", 77), "accessor 77"},
        {[](GltfBuilder& b) { b.doc["accessors"][1]["count"] = 2; }, "whole triangles"},
        {[](GltfBuilder& b) { b.doc["accessors"][3]["count"] = 2; }, "TEXCOORD_0"},
        // materials
        {set("/materials/0/normalTexture/index", 4), "texture 4"},
        {set("/textures/0/source", 4), "image 4"},
        {set("/textures/0", json::object()), "image -1"},
        {set("/materials/0/pbrMetallicRoughness/roughnessFactor", 2), "roughnessFactor"},
        {set("/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, -1, 1}), "baseColorFactor"},
        {set("/materials/0/emissiveFactor", {1e39, 0, 0}), "emissiveFactor"},
        {set("/materials/0/extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", -1}}}}),
         "emissiveStrength"},
        {set("/materials/0/extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}), "ior"},
        {set("/materials/0/extensions", {{"KHR_materials_specular", {{"specularFactor", 2}}}}), "specularFactor"},
        {set("/materials/0/extensions", {{"KHR_materials_specular", {{"specularColorFactor", {1, 1}}}}}),
         "specularColorFactor"},
        {set("/materials/0/extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1.5}}}}),
         "transmissionFactor: 1.5 given, a number in [0, 1] expected"},
        {set("/materials/0/extensions", {{"KHR_materials_transmission", {{"transmissionFactor", "1"}}}}),
         "KHR_materials_transmission.transmissionFactor: \"1\" given, a number expected"},
        {set("/materials/0/alphaMode", "GLASS"), "alphaMode"},
        // nodes
        {set("/nodes/2/children", json::array({1})), "cycle"},
        {set("/nodes/1/children", json::array({1})), "cycle"},
        {set("/nodes/0/children", json::array({2})), "two parents"},
        {set("/nodes/1/children", json::array({50})), "child 50"},
        {set("/nodes/0/mesh", 3), "mesh 3"},
        {set("/nodes/0/mesh", -3), "mesh -3"},
        {set("/nodes/1/camera", 3), "camera 3"},
        {set("/nodes/0/translation", {1, 2}), "translation"},
        {set("/nodes/0/translation", {1e39, 0, 0}), "translation"},
        {set("/nodes/0/scale", {3e38, 3e38, 3e38}), "place in the world"},
        {set("/nodes/1/rotation", {0, 0, 0, 0}), "rotation"},
        {set("/nodes/0/matrix", {1, 0, 0}), "matrix"},
        {set("/nodes/0/matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}), "matrix"},
        {set("/nodes/0/matrix", std::vector<int>(16, 0)), "matrix"},
        {set("/nodes/0/extras", {{"cast_shadow", "no"}}), "cast_shadow"},
        {set("/nodes/0/extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", 3}}}}}}),
         "TRANSLATION"},
        {set("/nodes/0/extensions", {{"EXT_mesh_gpu_instancing", json::object()}}), "EXT_mesh_gpu_instancing"},
        {set("/scene", 5), "scene 5"},
        {set("/scenes/0/nodes", {0, 77}), "node 77"},
        {set("/scenes/0/nodes", {0, 0}), "twice"},
        {set("/scenes/0/nodes", json::array({2})), "not a root"},
        // lights and cameras
        {set("/nodes/3/extensions/KHR_lights_punctual/light", 3), "light 3"},
        {set("/extensions/KHR_lights_punctual/lights/0/intensity", -1), "intensity"},
        {set("/extensions/KHR_lights_punctual/lights/0/intensity", 1e300), "intensity"},
        {set("/extensions/KHR_lights_punctual/lights/0/color", {1, 1, -1}), "color"},
        {set("/extensions/KHR_lights_punctual/lights/0/range", -2), "range"},
        {set("/extensions/KHR_lights_punctual/lights/0/type", "laser"), "type laser"},
        {set("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", 2), "outerConeAngle"},
        {set("/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", 1), "innerConeAngle"},
        {set("/extensions/KHR_lights_punctual/lights/0/extras/radius", 0), "radius"},
        {set("/extensions/KHR_lights_punctual/lights/0/extras/shadow", 3), "shadow"},
        {set("/cameras/0/perspective/yfov", 4), "yfov"},
        {set("/cameras/0/perspective/znear", 0), "znear"},
        // animations
        {set("/animations/0/channels/0/target/node", 90), "node 90"},
        {set("/animations/0/channels/0/target/path", "colour"), "path colour"},
        {set("/animations/0/channels/0/sampler", 4), "sampler 4"},
        {set("/animations/0/samplers/0/interpolation", "SINE"), "interpolation SINE"},
        {set("/animations/0/samplers/0/interpolation", "CUBICSPLINE"), "2 values for 2 times"},
        {poke(4, 4, 0), "must rise"},
        {poke(4, 0, -1), "must not be negative"},
        {poke(4, 4, NAN), "times"},
        {poke(5, 4, NAN), "values"},
        {set("/animations/0/extras", {{"places", 1}}), "places"},
        {set("/animations/0/extras", {{"places", {{{"name", "x"}}}}}), "places"},
        {set("/animations/0/extras", {{"places", {{{"name", "x"}, {"time", -1}}}}}), "places"},
        // scene extras
        {set("/scenes/0/extras/exposure", "bright"), "exposure"},
        {set("/scenes/0/extras/media/0/radius", 1), "media[0]"},
        {set("/scenes/0/extras/media", "[{"), "media"},
    };
    for (const auto& [damage, fragment] : cases) {
        GltfBuilder b = full();
        damage(b);
        expect_error(write("bad.gltf", b.text()), fragment);
        if (HasFailure()) FAIL() << "expected: " << fragment;
    }
}

TEST_F(GltfBadInput, DamagedBytesLoadOrThrowButNeverCrash) {
    const std::string glb = full().glb();
    std::mt19937 random(7);
    int loaded = 0, refused = 0;
    const auto attempt = [&](const std::string& bytes) {
        const auto path = write("damaged.glb", bytes);
        try {
            (void)load_gltf(path);
            ++loaded;
        } catch (const Error& e) {
            ++refused;
            EXPECT_THAT(e.what(), AllOf(HasSubstr("damaged.glb"), Not(HasSubstr("\n"))));
        }
    };
    for (int i = 0; i < 100; ++i) attempt(glb.substr(0, random() % glb.size()));
    EXPECT_EQ(loaded, 0);
    for (int i = 0; i < 400; ++i) {
        std::string damaged = glb;
        damaged[random() % glb.size()] ^= static_cast<char>(1 << random() % 8);
        attempt(damaged);
    }
    for (int i = 0; i < 200; ++i) {  // numbers in the JSON part, which lead everywhere
        std::string damaged = glb;
        const std::size_t at = damaged.find_first_of("0123456789", 20 + random() % (glb.size() / 2));
        if (at == std::string::npos) continue;
        damaged[at] = static_cast<char>('0' + random() % 10);
        attempt(damaged);
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace tyndall
