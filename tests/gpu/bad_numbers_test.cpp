// Numbers in files that are no numbers, or too large: the loader says so in one line, or what it loads gives a
// picture without a NaN.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "adapter/volumetrics_adapter.h"
#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/gl/readback.h"
#include "engine/render/renderer.h"
#include "support/gl_test.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A floor, a sun, a moving point lamp, a spot, a camera, and one medium of each kind.
const char* const scene_text = R"({
 "asset": {"version": "2.0"}, "scene": 0,
 "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
 "scenes": [{"nodes": [0, 1, 2, 3, 4], "extras": {"exposure": 3, "media": [
   {"shape": "global", "scattering": [0.01, 0.01, 0.01], "absorption": [0.01, 0.01, 0.01], "anisotropy": 0.5,
    "emission": [0.1, 0.1, 0.1]},
   {"shape": "height", "scattering": [0.02, 0.02, 0.02], "base": 1, "falloff": 2},
   {"shape": "ellipsoid", "scattering": [0.1, 0.1, 0.1], "center": [0, 1, 0], "radii": [1, 2, 1], "softness": 0.5,
    "noise": {"scale": 1, "amount": 0.5, "seed": 3}, "height": {"base": 1, "falloff": 2}},
   {"shape": "box", "scattering": [0.1, 0.1, 0.1], "center": [2, 1, 0], "size": [1, 2, 1]}]}}],
 "nodes": [{"mesh": 0, "translation": [0, 0, 0], "scale": [1, 1, 1]},
   {"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [-0.6, 0.2, 0, 0.77]},
   {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1, 2, 1]},
   {"extensions": {"KHR_lights_punctual": {"light": 2}}, "translation": [-1, 3, 1], "rotation": [-0.7, 0, 0, 0.71]},
   {"camera": 0, "translation": [0, 2, 6]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
 "extensions": {"KHR_lights_punctual": {"lights": [
   {"type": "directional", "intensity": 1000, "color": [1, 1, 1]},
   {"type": "point", "intensity": 100, "range": 10, "extras": {"radius": 0.1}},
   {"type": "spot", "intensity": 100, "range": 10, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}}]}},
 "materials": [{"doubleSided": true, "emissiveFactor": [0, 0, 0],
   "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1}},
   "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0, "roughnessFactor": 0.8}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "animations": [{"channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}],
   "samplers": [{"input": 1, "output": 2}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
    "min": [-20, 0, -20], "max": [20, 0, 20]},
   {"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
   {"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8},
   {"buffer": 0, "byteOffset": 44, "byteLength": 24}],
 "buffers": [{"byteLength": 68, "uri": "data.bin"}]})";

/// The triangle of the floor, two times, and two places of the lamp.
constexpr std::array<float, 17> scene_data{-20, 0, 20, 20, 0, 20, 0, 0, -20, 0, 1, 1, 2, 1, -1, 2, 1};

class BadNumbers : public GlTest {
  protected:
    BadNumbers() {
        std::string pattern = (fs::temp_directory_path() / "tyndall-numbers-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
        write_data(scene_data);
        // Of the default a new program would be built for nearly every number. The stress test draws all
        // techniques.
        volumetrics_.settings.technique = "ray_march";
    }
    ~BadNumbers() override { fs::remove_all(folder_); }

    void write_data(const std::array<float, 17>& data) {
        std::ofstream(folder_ / "data.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(data.data()), sizeof data);
    }
    /// The scene with the number at `pointer` replaced by `text`, which need not be JSON.
    void write_scene(const json& scene, const json::json_pointer& pointer, const std::string& text) {
        json changed = scene;
        changed[pointer] = "@";
        std::string all = changed.dump();
        all.replace(all.find("\"@\""), 3, text);
        std::ofstream(path()) << all;
    }
    [[nodiscard]] fs::path path() const { return folder_ / "scene.gltf"; }

    /// Loads and draws at two times; counts what was refused.
    void check(const std::string& what) {
        Scene scene;
        try {
            scene = load_gltf(path());
        } catch (const Error& error) {
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << what << ": " << message;
            EXPECT_NE(message.find("scene.gltf"), std::string::npos) << what << ": " << message;
            ++refused_;
            return;
        }
        ++drawn_;
        renderer_.prepare(scene, 1);
        for (const double time : {0.0, 0.5}) {
            animate(scene, time);
            const Camera& camera = scene.cameras.at(0);
            const View view = make_view(node_pose(scene, camera.node), camera.yfov, camera.znear, 17.0f / 9);
            FrameOptions options;
            options.layer = "scattering";
            options.more_layers = {"transmittance"};
            volumetrics_.settings.froxels.x = volumetrics_.settings.froxels.y = volumetrics_.settings.froxels.z =
                17;
            volumetrics_.settings.light_volumes.sun_size = 16;
            volumetrics_.settings.light_volumes.lamp_size = 8;
            options.render.cascade_size = options.render.static_shadow_size = 256;
            options.render.atlas_size = 512;
            renderer_.render(scene, view, {17, 9}, options);
            for (const float v : renderer_.read_layer("scattering").pixels)
                ASSERT_TRUE(v >= 0 && v <= 65504 * scene.light_unit()) << what << ": scattering " << v;
            for (const float v : renderer_.read_layer("transmittance").pixels)
                ASSERT_TRUE(v >= 0 && v <= 1) << what << ": transmittance " << v;
            for (const float v : gl::read_texture(renderer_.color()).pixels)
                ASSERT_TRUE(v >= 0 && v <= 65504) << what << ": color " << v;
        }
    }
    int refused_ = 0, drawn_ = 0;

  private:
    fs::path folder_;
    ShaderLibrary& shaders_ = shared_shaders();
    VolumetricsAdapter volumetrics_;
    Renderer renderer_{shaders_, {&volumetrics_}};
};

/// Every number in the parts of the scene that describe it.
std::vector<json::json_pointer> numbers_of(const json& scene) {
    std::vector<json::json_pointer> found;
    const json flat = scene.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        if (!value.is_number_float() && !value.is_number_integer()) continue;
        const bool index = pointer.starts_with("/accessors") || pointer.starts_with("/buffer") ||
                           pointer.starts_with("/meshes") || pointer.starts_with("/animations") ||
                           pointer.starts_with("/scene/") || pointer == "/scene" || pointer.find("/nodes/") == 9 ||
                           pointer.ends_with("/light") || pointer.ends_with("/mesh") ||
                           pointer.ends_with("/camera");
        if (!index) found.emplace_back(pointer);
    }
    return found;
}

TEST_F(BadNumbers, InTheSceneFileAreRefusedOrHarmless) {
    const json scene = json::parse(scene_text);
    const auto pointers = numbers_of(scene);
    ASSERT_GT(pointers.size(), 60u);
    for (const auto& pointer : pointers) {
        SCOPED_TRACE(pointer.to_string());
        for (const char* text : {"NaN", "1e999", "1e39", "3e38", "1e15", "9e8", "1e6", "-3e38", "1e-45", "0", "-1",
                                 "\"many\"", "null"}) {
            write_scene(scene, pointer, text);
            check(pointer.to_string() + " = " + text);
        }
    }
    EXPECT_GT(refused_, 300);
    EXPECT_GT(drawn_, 100);
}

TEST_F(BadNumbers, InBuffersAreRefusedOrHarmless) {
    std::ofstream(path()) << scene_text;
    constexpr float infinity = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t i = 0; i < scene_data.size(); ++i)
        for (const float bad : {nan, infinity, -infinity}) {
            std::array<float, 17> data = scene_data;
            data[i] = bad;
            write_data(data);
            check(fmt::format("value {} = {}", i, bad));
        }
    EXPECT_EQ(drawn_, 0) << "what is not finite is refused";
    for (std::size_t i = 0; i < scene_data.size(); ++i)
        for (const float large : {3e38f, -3e38f, 1e20f, 1e-45f}) {
            std::array<float, 17> data = scene_data;
            data[i] = large;
            write_data(data);
            check(fmt::format("value {} = {}", i, large));
        }
}

}  // namespace
}  // namespace tyndall
