#include "engine/scene/scene_doubts.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr float far_end = 256;

class SceneDoubts : public SceneFolderTest {
  protected:
    /// A triangle, a camera and a lamp: nothing to doubt.
    static GltfBuilder sound() {
        GltfBuilder b;
        b.triangle();
        b.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
        b.node({{"camera", 0}, {"translation", {0, 0, 5}}});
        b.light({{"name", "lamp"}, {"type", "point"}, {"intensity", 60}});
        return b;
    }
    static GltfBuilder sunny(float lux) {
        GltfBuilder b = sound();
        lights(b)[0] = {{"name", "sun"}, {"type", "directional"}, {"intensity", lux}};
        return b;
    }
    static json& lights(GltfBuilder& b) { return b.doc["extensions"]["KHR_lights_punctual"]["lights"]; }
    static json& scene_extras(GltfBuilder& b) { return b.doc["scenes"][0]["extras"]; }
    /// From Blender, with fog.
    static void blender(GltfBuilder& b) {
        b.doc["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
        scene_extras(b)["media"] = {{{"shape", "global"}, {"scattering", {0.1, 0.1, 0.1}}}};
    }

    [[nodiscard]] std::vector<std::string> doubts(const GltfBuilder& b) const {
        GltfNotes notes;
        const Scene scene = load_gltf(write("scene.gltf", b.text()), notes);
        return likely_mistakes(scene, notes, far_end);
    }
};

TEST_F(SceneDoubts, ASoundSceneHasNone) {
    EXPECT_THAT(doubts(sound()), IsEmpty());
    for (const float lux : {0.3f, 100.0f, 100'000.0f}) EXPECT_THAT(doubts(sunny(lux)), IsEmpty()) << lux;
    GltfBuilder b = sound();
    b.doc["nodes"][0]["extras"] = {{"cast_shadow", true},
                                   {"hp", 3}};  // "hp" is left out, and like nothing that is read
    EXPECT_THAT(doubts(b), IsEmpty());
}

TEST_F(SceneDoubts, NoLightNoCameraNothingToSee) {
    GltfBuilder b;
    b.doc["scenes"] = {json::object()};
    EXPECT_THAT(doubts(b),
                ElementsAre(HasSubstr("no light"), HasSubstr("no perspective camera"), HasSubstr("no triangles")));
    blender(b);
    EXPECT_THAT(doubts(b), ElementsAre(HasSubstr("Punctual Lights is ticked"), HasSubstr("Cameras is ticked"),
                                       HasSubstr("no triangles")));
    scene_extras(b).clear();
    EXPECT_THAT(doubts(b), testing::Contains(HasSubstr("Custom Properties is ticked")));
    GltfBuilder flat = sound();
    blender(flat);
    flat.doc["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 0}}}}};
    EXPECT_THAT(doubts(flat), ElementsAre(testing::EndsWith("from a place that is chosen")));
    GltfBuilder dark = sound();
    lights(dark)[0]["intensity"] = 0;
    EXPECT_THAT(doubts(dark), ElementsAre(HasSubstr("no light")));
}

TEST_F(SceneDoubts, AnEmptyNodeThatBlenderCallsArea) {
    GltfBuilder b = sound();
    b.node({{"name", "Area.001"}});
    EXPECT_THAT(doubts(b), IsEmpty());
    blender(b);
    EXPECT_THAT(doubts(b), ElementsAre(AllOf(HasSubstr("Area.001"), HasSubstr("area lights"))));
    b.doc["nodes"].back()["mesh"] = 0;
    EXPECT_THAT(doubts(b), IsEmpty());
}

TEST_F(SceneDoubts, LightsInOtherUnits) {
    GltfBuilder b = sound();
    lights(b)[0]["intensity"] = 1;
    for (int i = 0; i < 4; ++i) b.light({{"name", "l" + std::to_string(i)}, {"type", "point"}, {"intensity", 4.7}});
    b.light({{"name", "right"}, {"type", "point"}, {"intensity", 5}});
    EXPECT_THAT(doubts(b), ElementsAre(HasSubstr("less than 5 cd: \"lamp\", \"l0\", \"l1\" and 2 more;")));
    for (const float lux : {0.5f, 1.0f, 99.0f})
        EXPECT_THAT(doubts(sunny(lux)), ElementsAre(HasSubstr("suns of less than 100 lx: \"sun\""))) << lux;
}

TEST_F(SceneDoubts, ExposureThatSuitsNoLight) {
    // Without a sun and an exposure EV is 0; a lamp of 6000 cd makes 477 cd/m² in 2 m: 8.6 stops more.
    GltfBuilder b = sound();
    lights(b)[0]["intensity"] = 6000;
    EXPECT_THAT(doubts(b), ElementsAre(AllOf(HasSubstr("EV 0.0 (the file gives none)"),
                                             HasSubstr("9 stops too bright"), HasSubstr("\"exposure\" of 8.6"))));
    scene_extras(b)["exposure"] = 0;  // of an author who knows
    EXPECT_THAT(doubts(b), IsEmpty());
    for (const auto& [exposure, says] :
         {std::pair(-3.0, "12 stops too bright"), std::pair(20.0, "11 stops too dark")}) {
        scene_extras(b)["exposure"] = exposure;
        EXPECT_THAT(doubts(b), ElementsAre(HasSubstr(says)));
    }
}

TEST_F(SceneDoubts, EmissionThatBlenderLeavesInWatts) {
    GltfBuilder b = sunny(3 * 683);  // a white surface has 652 cd/m²
    b.doc["materials"] = {{{"name", "panel"},
                           {"emissiveFactor", {1, 1, 1}},
                           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}}}};
    EXPECT_THAT(doubts(b), IsEmpty());
    blender(b);
    EXPECT_THAT(doubts(b),
                ElementsAre(AllOf(HasSubstr("\"panel\" emits 5 cd/m²"), HasSubstr("3.42e+03 cd/m² meant"))));
    b.doc["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 5 * 683;
    EXPECT_THAT(doubts(b), IsEmpty());
}

TEST_F(SceneDoubts, FogBeyondTheFarEnd) {
    GltfBuilder b = sound();
    const auto ball = [&](float z) {
        scene_extras(b)["media"] = {
            {{"shape", "sphere"}, {"center", {0, 0, z}}, {"radius", 10}, {"scattering", {1, 1, 1}}}};
    };
    ball(-far_end);  // begins 251 m from the camera at z = 5
    EXPECT_THAT(doubts(b), IsEmpty());
    ball(-far_end - 10);
    EXPECT_THAT(doubts(b), ElementsAre(AllOf(HasSubstr("medium 0 (sphere) begins 261 m"), HasSubstr("256 m"))));
}

TEST_F(SceneDoubts, MaterialsThatAreOnlyAVolume) {
    GltfBuilder b = sound();
    b.doc["materials"] = {{{"name", "fog"}, {"doubleSided", true}, {"pbrMetallicRoughness", json::object()}}};
    EXPECT_THAT(doubts(b), IsEmpty());  // nothing has it
    b.doc["meshes"][0]["primitives"][0]["material"] = 0;
    EXPECT_THAT(doubts(b), ElementsAre(AllOf(HasSubstr("material 0 \"fog\""), HasSubstr("volume"))));
}

TEST_F(SceneDoubts, ExtrasThatAreNearlyWhatIsRead) {
    GltfBuilder b = sound();
    scene_extras(b) = {{"Media", "[]"}, {"exposre", 1}, {"fog", "x"}};
    b.doc["nodes"][0]["extras"] = {{"media", "[]"}, {"castShadow", true}, {"radius", 1}};
    b.doc["meshes"][0]["extras"] = {{"Fog", 1}, {"targetNames", json::array()}};
    lights(b)[0]["extras"] = {{"shadows", true}};
    EXPECT_THAT(doubts(b), ElementsAre(HasSubstr("\"Fog\" of a mesh is not read: \"medium\" of a node meant"),
                                       HasSubstr("\"Media\" of a scene is not read: \"media\" meant?"),
                                       HasSubstr("\"castShadow\" of a node is not read: \"cast_shadow\" meant?"),
                                       HasSubstr("\"exposre\" of a scene is not read: \"exposure\" meant?"),
                                       HasSubstr("\"fog\" of a scene is not read: \"media\" meant?"),
                                       HasSubstr("\"media\" of a node is not read: \"medium\" meant"),
                                       HasSubstr("\"radius\" of a node is not read: \"radius\" is read of a light"),
                                       HasSubstr("\"shadows\" of a light is not read: \"shadow\" meant?")));
}

}  // namespace
}  // namespace tyndall
