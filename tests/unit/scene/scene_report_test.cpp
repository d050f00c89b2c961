#include "engine/scene/scene_report.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SceneReport : public SceneFolderTest {
  protected:
    [[nodiscard]] std::string report_of(const GltfBuilder& b) const {
        GltfNotes notes;
        const Scene scene = load_gltf(write("scene.gltf", b.text()), notes);
        return report(scene, notes, {"a doubt"});
    }
};

TEST_F(SceneReport, SaysWhatThereIs) {
    GltfBuilder b;
    b.triangle();
    b.node({{"mesh", 0}, {"translation", {0, 0, -3}}, {"scale", {2, 1, 1}}});
    b.doc["asset"]["generator"] = "by\nhand";
    b.doc["cameras"] = {
        {{"name", "eye\n"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}},
        {{"name", "plan"},
         {"type", "orthographic"},
         {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}}};
    b.node({{"camera", 0}, {"translation", {0, 1, 5}}});
    b.node({{"camera", 1}, {"name", "above"}});
    b.light({{"name", "sun"}, {"type", "directional"}, {"intensity", 1000}, {"color", {0.5, 0.25, 0}}});
    b.light(
        {{"name", "bulb"}, {"type", "point"}, {"intensity", 60}, {"range", 7}, {"extras", {{"shadow", false}}}});
    b.light({{"name", "torch"},
             {"type", "spot"},
             {"intensity", 900},
             {"range", 20},
             {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}});
    b.doc["nodes"].back()["translation"] = {1, 2, 3};
    b.doc["scenes"][0]["extras"] = {
        {"exposure", 2},
        {"media", json::parse(R"([{"shape":"global","scattering":[0.1,0.2,0.3],"absorption":[0,0,0.1]},
                         {"shape":"height","scattering":[0,0,0],"base":1,"falloff":8,"emission":[1,2,3]},
                         {"shape":"box","center":[1,2,3],"size":[4,5,6],"rotation":[0,0.6,0,0.8],"scattering":[1,1,1]}])")}};
    const int times = b.accessor<float>({0, 2.5f}, GltfBuilder::f32, "SCALAR"),
              places = b.accessor<float>({0, 0, 0, 1, 0, 0}, GltfBuilder::f32, "VEC3");
    b.doc["animations"] = {{{"name", "slide"},
                            {"samplers", {{{"input", times}, {"output", places}}}},
                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    b.doc["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat"};
    const std::string text = report_of(b);
    for (const char* line :
         {"written by: by hand\n", "nodes: 7\n", "meshes: 1, of 1 triangles; all instances have 2\n",
          "bounds: 0 0 -3 to 2 2 0 m, 2 2 3 m wide, high and deep\n",
          "exposure: EV 2.00, a luminance of 4.8 cd/m² shows as 1\n",
          "cameras: 1\n  \"eye\\n\": perspective, 28.6° vertical, at 0 1 5 m\n",
          "lights: 3\n  \"sun\": sun, 500 lx, color 1 0.5 0, towards 0 0 -1\n",
          "  \"bulb\": point, 60 cd, color 1 1 1, at 0 0 0 m, range 7 m, radius 0.01 m, no shadow\n",
          "  \"torch\": spot, 900 cd, color 1 1 1, at 1 2 3 m, towards 0 0 -1, cone 11.5° full to 22.9° dark from "
          "its axis, "
          "range 20 m, radius 0.01 m\n",
          "media: 3\n  global: scattering 0.1 0.2 0.3, absorption 0 0 0.1 1/m, mean free path 2.5 m\n",
          "  height above 1 m, thinner by e in 8 m: scattering 0 0 0, absorption 0 0 0 1/m, emission 1 2 3 cd/m² a "
          "metre\n",
          "  box at 1 2 3 m, 4 5 6 m wide, high and deep, turned by 0 0.6 0 0.8: scattering 1 1 1, absorption 0 0 "
          "0 1/m, "
          "mean free path 1 m\n",
          "particle emitters: 0\ntextures: none\nanimations: 1\n  \"slide\": 2.5 s, 1 channels\n",
          "extensions: 2\n  KHR_lights_punctual\n  KHR_materials_clearcoat\n", "left out: 2\n",
          "  extensions ignored: KHR_materials_clearcoat\n",
          "  node 3 \"above\": orthographic cameras are not supported, left out\n", "warnings: 1\n  a doubt\n"})
        EXPECT_THAT(text, HasSubstr(line));
}

TEST_F(SceneReport, NothingIsThere) {
    GltfBuilder b;
    b.doc["scenes"] = {json::object()};
    EXPECT_THAT(report_of(b),
                HasSubstr("bounds: none\nexposure: EV 0.00 (the file gives none), a luminance of 1.2 cd/m² "
                          "shows as 1\ncameras: none\nlights: none\nmedia: none\n"));
}

}  // namespace
}  // namespace tyndall
