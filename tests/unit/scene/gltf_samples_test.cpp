#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/scene/data_root.h"
#include "engine/scene/mesh_build.h"
#include "engine/scene/scene.h"

namespace tyndall {
namespace {

/// Files from outside the project, beside its folder; absent in a fresh clone.
class GltfSamples : public testing::Test {
  protected:
    std::filesystem::path data = data_root() / "../shared/data";
    void SetUp() override {
        if (!std::filesystem::exists(data / "scenes/Box.glb"))
            GTEST_SKIP() << "no test data in " << data.lexically_normal();
    }
    static std::size_t triangles(const Scene& scene) {
        std::size_t count = 0;
        for (const Node& node : scene.nodes)
            for (const int mesh : node.meshes)
                count += scene.meshes[static_cast<std::size_t>(mesh)].indices.size() / 3;
        return count;
    }
};

TEST_F(GltfSamples, EveryFileLoads) {
    int files = 0;
    for (const char* folder : {"scenes", "reference"}) {
        for (const auto& entry : std::filesystem::directory_iterator(data / folder)) {
            if (entry.path().extension() != ".glb") continue;
            ++files;
            const Scene scene = load_gltf(entry.path());
            EXPECT_GT(triangles(scene), 0u) << entry.path();
            EXPECT_FALSE(scene.bounds.empty()) << entry.path();
        }
    }
    EXPECT_GE(files, 8);
}

TEST_F(GltfSamples, LevelAndHouseHaveTheTrianglesTheirAuthorsCount) {
    EXPECT_EQ(triangles(load_gltf(data / "scenes/zdm2.glb")), 58'772u);
    EXPECT_EQ(triangles(load_gltf(data / "scenes/house.glb")), 10'497u);
}

TEST_F(GltfSamples, SunsAreInLux) {
    const Scene room = load_gltf(data / "scenes/VolumetricFogExample.glb");
    ASSERT_TRUE(room.sun());
    EXPECT_NEAR(room.lights[*room.sun()].intensity.x, 68'300, 1);
    const Scene slats = load_gltf(data / "reference/slats.glb");
    ASSERT_TRUE(slats.sun());
    EXPECT_NEAR(slats.lights[*slats.sun()].intensity.z, 13'660 * 0.75, 1);
    ASSERT_NE(slats.find_camera("cam"), nullptr);
    EXPECT_NEAR(slats.find_camera("cam")->yfov, 50 * std::numbers::pi / 180, 1e-6);
    EXPECT_EQ(load_media(data / "reference/slats.media.json").size(), 1u);
}

TEST_F(GltfSamples, InstancingMakesACubeOfFiveCubes) {
    const Scene scene = load_gltf(data / "scenes/SimpleInstancing.glb");
    EXPECT_EQ(triangles(scene), 125u * 12u);
    EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST_F(GltfSamples, EmissionGrowsWithItsStrength) {
    const Scene scene = load_gltf(data / "scenes/EmissiveStrengthTest.glb");
    for (const Material& material : scene.materials) {
        if (!material.name.starts_with("Emit")) continue;
        EXPECT_NEAR(material.emissive.x, 0.1f * std::stof(material.name.substr(4)), 1e-5f) << material.name;
    }
}

TEST_F(GltfSamples, ComputedTangentsAgreeWithAuthoredOnes) {
    const Scene scene = load_gltf(data / "scenes/AlphaBlendModeTest.glb");
    for (const Mesh& mesh : scene.meshes) {
        Mesh computed = mesh;
        compute_tangents(computed);
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
            EXPECT_EQ(computed.vertices[i].tangent.w, mesh.vertices[i].tangent.w);
            EXPECT_GT(glm::dot(glm::vec3(computed.vertices[i].tangent), glm::vec3(mesh.vertices[i].tangent)),
                      0.99f);
        }
    }
}

}  // namespace
}  // namespace tyndall
