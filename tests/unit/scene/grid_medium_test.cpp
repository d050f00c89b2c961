#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/scene/medium.h"
#include "tests/support/grid_files.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

class GridMedium : public SceneFolderTest {
  protected:
    GridMedium() {
        TestGrid density, heat;
        density.voxels = {{{0, 0, 0}, 1}, {{3, 2, 1}, 4}};
        density.index_to_grid = glm::dmat4(glm::dmat3(0.5));
        density.index_to_grid[3] = {1, 0, 0, 1};
        heat.name = "heat";
        heat.voxels = {{{0, 0, 0}, 2}};
        write_vdb(folder / "scene/cloud.vdb", {density, heat});
        std::filesystem::copy(folder / "scene/cloud.vdb", folder / "outside.vdb");
    }
    static json cloud() { return {{"shape", "grid"}, {"file", "cloud.vdb"}, {"scattering", {0.1, 0.2, 0.3}}}; }
    static json with(json medium, const std::string& key, const json& value) {
        medium[key] = value;
        return medium;
    }
    [[nodiscard]] std::vector<Medium> parse(const json& list) const {
        return parse_media(list, "fog.json", folder / "scene");
    }
    [[nodiscard]] Medium parse_one(const json& medium) const { return parse(json::array({medium})).at(0); }
};

TEST_F(GridMedium, EveryField) {
    json medium = cloud();
    medium.update(json::parse(R"({"grid":"heat", "translation":[1,2,3], "rotation":[0,0.6,0,0.8], "scale":2.5,
        "density":0.25, "sampling":"nearest", "wind":[4,5,-6], "absorption":[1,0,2], "anisotropy":0.5,
        "emission":[1,2,3]})"));
    const Medium parsed = parse_one(medium);
    EXPECT_EQ(parsed.shape, Medium::Shape::grid);
    EXPECT_EQ(name_of(parsed.shape), "grid");
    EXPECT_TRUE(is_bounded(parsed));
    EXPECT_EQ(parsed.grid->greatest, 2);
    EXPECT_EQ(parsed.center, glm::vec3(1, 2, 3));
    EXPECT_EQ(parsed.center_at_start, glm::vec3(1, 2, 3));
    EXPECT_NEAR(parsed.rotation.y, 0.6F, 1e-6F);
    EXPECT_EQ(parsed.scale, 2.5F);
    EXPECT_EQ(parsed.density, 0.25F);
    EXPECT_TRUE(parsed.nearest);
    EXPECT_EQ(parsed.wind, glm::vec3(4, 5, -6));
    EXPECT_EQ(parsed.sigma_s, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(parsed.sigma_a, glm::vec3(1, 0, 2));
    EXPECT_EQ(parsed.anisotropy, 0.5F);
    EXPECT_EQ(parsed.emission, glm::vec3(1, 2, 3));
}

TEST_F(GridMedium, Defaults) {
    const Medium parsed = parse_one(cloud());
    EXPECT_EQ(parsed.grid->greatest, 4);
    EXPECT_EQ(parsed.center, glm::vec3(0));
    EXPECT_EQ(parsed.rotation, glm::quat(1, 0, 0, 0));
    EXPECT_EQ(parsed.scale, 1);
    EXPECT_EQ(parsed.density, 1);
    EXPECT_FALSE(parsed.nearest);
    EXPECT_EQ(parsed.wind, glm::vec3(0));
}

TEST_F(GridMedium, ItsPlaceInTheWorld) {
    json medium = with(with(cloud(), "translation", {10, 0, 0}), "scale", 2);
    medium["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // x to y
    const glm::dvec3 place(index_to_world(parse_one(medium)) * glm::dvec4(3, 2, 1, 1));
    EXPECT_NEAR(glm::length(place - glm::dvec3(10 - 2, 2 * (1.5 + 1), 1)), 0, 1e-6);
    const Aabb box = world_bounds(parse_one(cloud()));
    EXPECT_EQ(box.min, glm::vec3(0.5F, -0.5F, -0.5F));
    EXPECT_EQ(box.max, glm::vec3(3, 1.5F, 1));
    EXPECT_EQ(world_bounds(parse_one(with(cloud(), "sampling", "nearest"))).max, glm::vec3(2.75F, 1.25F, 0.75F));
}

TEST_F(GridMedium, AFileIsReadOnce) {
    const auto media = parse({cloud(), with(cloud(), "grid", "heat"), with(cloud(), "file", "./cloud.vdb")});
    EXPECT_EQ(media[0].grid, media[2].grid);
    EXPECT_NE(media[0].grid, media[1].grid);
}

TEST_F(GridMedium, EveryMistakeNamesFileIndexAndKey) {
    std::filesystem::create_symlink(folder / "outside.vdb", folder / "scene/link.vdb");
    std::filesystem::create_directory_symlink(folder, folder / "scene/up");
    const std::pair<json, std::string> cases[] = {
        {with(cloud(), "file", 3), ".file: 3 given, a text expected"},
        {with(cloud(), "file", ""), ".file"},
        {with(cloud(), "file", "none.vdb"), "none.vdb: cannot read"},
        {with(cloud(), "file", "../outside.vdb"), ".file: \"../outside.vdb\" given, a path without \"..\""},
        {with(cloud(), "file", "x/../cloud.vdb"), "a path without \"..\""},
        {with(cloud(), "file", (folder / "scene/cloud.vdb").string()), "is absolute"},
        {with(cloud(), "file", "link.vdb"), "leaves the folder"},
        {with(cloud(), "file", "up/outside.vdb"), "leaves the folder"},
        {with(cloud(), "file", "https://a/cloud.vdb"), "has a scheme"},
        {with(cloud(), "file", std::string("cloud.vdb\0x", 11)), "a path without control characters"},
        {with(cloud(), "file", "cloud\n.vdb"), "a path without control characters"},
        {with(cloud(), "grid", "smoke"), "no grid \"smoke\"; there are: \"density\", \"heat\""},
        {with(cloud(), "grid", 1), ".grid: 1 given, a text expected"},
        {with(cloud(), "translation", {0, 1e30, 0}), ".translation[1]"},
        {with(cloud(), "rotation", {0, 0, 0, 2}), ".rotation"},
        {with(cloud(), "scale", 0), ".scale"},
        {with(cloud(), "scale", -1), ".scale"},
        {with(cloud(), "scale", 1.5e-6), ".scale: voxels of 7.5e-07 m"},
        {with(cloud(), "scale", 9e8), "the grid reaches"},
        {with(cloud(), "density", -1), ".density"},
        {with(cloud(), "density", 3e5), ".density: 1.2e+06 with the grid's greatest value"},
        {with(cloud(), "density", NAN), ".density"},
        {with(cloud(), "sampling", "cubic"), ".sampling: \"cubic\" given, one of linear, nearest"},
        {with(cloud(), "wind", {1, 2}), ".wind"},
        {with(cloud(), "wind", {1, 2, 1e5}), ".wind[2]"},
        {with(cloud(), "center", {0, 0, 0}), "\"center\""},
        {with(cloud(), "softness", 1), "\"softness\""},
        {with(cloud(), "noise", json::object()), "\"noise\""},
        {with(cloud(), "height", json::object()), "\"height\""},
        {with(cloud(), "phase", "mie"), ".phase"},
        {with(cloud(), "scattering", {1, -1, 1}), ".scattering[1]"},
    };
    for (const auto& [medium, fragment] : cases)
        EXPECT_THAT(
            [&] { (void)parse({cloud(), medium}); },
            ThrowsMessage<Error>(AllOf(HasSubstr("fog.json: media[1]"), HasSubstr(fragment), Not(HasSubstr("\n")))))
            << medium;
}

TEST_F(GridMedium, MediaFilesAndScenesNameFilesOfTheirOwnFolder) {
    const auto media = write("fog.json", json{{"media", {cloud()}}}.dump());
    EXPECT_EQ(load_media(media).at(0).grid->greatest, 4);
    GltfBuilder builder;
    builder.triangle();
    builder.doc["scenes"][0]["extras"]["media"] = {cloud()};
    EXPECT_EQ(load(builder).media.at(0).grid->greatest, 4);
}

TEST_F(GridMedium, WindMovesIt) {
    GltfBuilder builder;
    builder.triangle();
    builder.doc["scenes"][0]["extras"]["media"] = {with(with(cloud(), "wind", {1, 0, -2}), "translation", {5, 6, 7})};
    Scene scene = load(builder);
    EXPECT_EQ(scene.media[0].center, glm::vec3(5, 6, 7));
    animate(scene, 3);
    EXPECT_EQ(scene.media[0].center, glm::vec3(8, 6, 1));
}

}  // namespace
}  // namespace tyndall
