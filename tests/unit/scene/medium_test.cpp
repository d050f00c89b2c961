#include "engine/scene/medium.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

json ball() {
    return {{"shape", "sphere"}, {"center", {1, 2, 3}}, {"radius", 2}, {"scattering", {0.1, 0.2, 0.3}}};
}
json box() {
    return {{"shape", "box"}, {"center", {1, 2, 3}}, {"size", {4, 5, 6}}, {"scattering", {0.1, 0.2, 0.3}}};
}
Medium parse_one(const json& medium) {
    return parse_media(json::array({medium}), "fog.json", ".").at(0);
}

TEST(Medium, EveryFieldOfEveryShape) {
    const json list = json::parse(R"({"media": [
        {"shape":"global", "scattering":[0.05,0.06,0.07], "absorption":[0.01,0,0.02], "anisotropy":0.5, "emission":[1,2,3]},
        {"shape":"height", "scattering":[0.1,0.1,0.1], "anisotropy":-0.2, "base":-1.5, "falloff":8},
        {"shape":"sphere", "center":[0,1,0], "radius":2, "softness":0.5, "scattering":[1,1,1],
         "noise":{"scale":1.5,"amount":0.6,"seed":7}, "height":{"base":0.5,"falloff":1.2}},
        {"shape":"ellipsoid", "center":[1,2,3], "radii":[1,2,4], "rotation":[0,0.6,0,0.8], "scattering":[1,1,1]},
        {"shape":"box", "center":[0,1,0], "size":[4,2,3], "scattering":[1,1,1]}]})");
    const std::vector<Medium> media = parse_media(list, "fog.json", ".");
    ASSERT_EQ(media.size(), 5u);
    EXPECT_EQ(media[0].shape, Medium::Shape::global);
    EXPECT_EQ(media[0].sigma_s, glm::vec3(0.05f, 0.06f, 0.07f));
    EXPECT_EQ(media[0].sigma_a, glm::vec3(0.01f, 0, 0.02f));
    EXPECT_EQ(media[0].anisotropy, 0.5f);
    EXPECT_EQ(media[0].emission, glm::vec3(1, 2, 3));
    EXPECT_FALSE(media[0].height_profile);
    EXPECT_EQ(media[1].shape, Medium::Shape::height);
    EXPECT_TRUE(media[1].height_profile);
    EXPECT_EQ(media[1].base, -1.5f);
    EXPECT_EQ(media[1].falloff, 8);
    EXPECT_EQ(media[1].anisotropy, -0.2f);
    EXPECT_EQ(media[2].half_extent, glm::vec3(2));
    EXPECT_EQ(media[2].softness, 0.5f);
    EXPECT_EQ(media[2].noise_scale, 1.5f);
    EXPECT_EQ(media[2].noise_amount, 0.6f);
    EXPECT_EQ(media[2].noise_seed, 7);
    EXPECT_TRUE(media[2].height_profile);
    EXPECT_EQ(media[2].falloff, 1.2f);
    EXPECT_EQ(media[3].shape, Medium::Shape::ellipsoid);
    EXPECT_EQ(media[3].half_extent, glm::vec3(1, 2, 4));
    EXPECT_NEAR(media[3].rotation.y, 0.6f, 1e-6f);
    EXPECT_NEAR(media[3].rotation.w, 0.8f, 1e-6f);
    EXPECT_EQ(media[4].half_extent, glm::vec3(2, 1, 1.5f));
}

TEST(Medium, Defaults) {
    const Medium medium = parse_one(ball());
    EXPECT_EQ(medium.sigma_a, glm::vec3(0));
    EXPECT_EQ(medium.emission, glm::vec3(0));
    EXPECT_EQ(medium.anisotropy, 0);
    EXPECT_EQ(medium.softness, 0);
    EXPECT_EQ(medium.noise_amount, 0);
    EXPECT_FALSE(medium.height_profile);
    EXPECT_EQ(medium.rotation, glm::quat(1, 0, 0, 0));
}

TEST(Medium, AlbedoAndExtinctionStandForScatteringAndAbsorption) {
    json medium = ball();
    medium.erase("scattering");
    medium["albedo"] = {1, 0.75, 0};
    medium["extinction"] = {2, 4, 8};
    EXPECT_EQ(parse_one(medium).sigma_s, glm::vec3(2, 3, 0));
    EXPECT_EQ(parse_one(medium).sigma_a, glm::vec3(0, 1, 8));
}

TEST(Medium, AirHasRayleighsPhase) {
    const json air{
        {"shape", "height"}, {"scattering", {1, 2, 3}}, {"base", 0}, {"falloff", 8000}, {"phase", "rayleigh"}};
    EXPECT_TRUE(parse_one(air).rayleigh);
    json haze{{"shape", "global"}, {"scattering", {1, 2, 3}}, {"anisotropy", 0.5}};
    EXPECT_FALSE(parse_one(haze).rayleigh);
    haze["phase"] = "mie";
    EXPECT_FALSE(parse_one(haze).rayleigh);
}

TEST(Medium, BareListAndObjectAreTheSame) {
    EXPECT_EQ(parse_media(json::array({ball(), box()}), "a", ".").size(), 2u);
    EXPECT_EQ(parse_media({{"media", json::array({ball(), box()})}}, "a", ".").size(), 2u);
    EXPECT_TRUE(parse_media(json::array(), "a", ".").empty());
}

TEST(Medium, EveryMistakeNamesFileIndexAndKey) {
    const auto with = [](json medium, const std::string& key, const json& value) {
        medium[key] = value;
        return medium;
    };
    const auto without = [](json medium, const std::string& key) {
        medium.erase(key);
        return medium;
    };
    const std::pair<json, std::string> cases[] = {
        {with(ball(), "colour", 1), "\"colour\""},
        {with(ball(), "size", {1, 1, 1}), "\"size\""},
        {with(box(), "radius", 1), "\"radius\""},
        {with({{"shape", "global"}, {"scattering", {1, 1, 1}}}, "noise", json::object()), "\"noise\""},
        {with(ball(), "shape", "cone"), ".shape"},
        {with(ball(), "shape", 3), ".shape"},
        {without(ball(), "shape"), "\"shape\" is missing"},
        {without(ball(), "scattering"), "\"scattering\" is missing"},
        {without(ball(), "center"), "\"center\" is missing"},
        {without(ball(), "radius"), "\"radius\" is missing"},
        {without(box(), "size"), "\"size\" is missing"},
        {with(ball(), "scattering", 1), ".scattering"},
        {with(ball(), "scattering", {1, 1}), ".scattering"},
        {with(ball(), "scattering", {1, -1, 1}), ".scattering[1]"},
        {with(ball(), "scattering", {1, 1, "1"}), ".scattering[2]"},
        {with(ball(), "scattering", {1, 1, NAN}), ".scattering[2]"},
        {with(ball(), "scattering", {1e39, 1, 1}), ".scattering[0]"},
        {with(ball(), "absorption", {0, 0, -0.1}), ".absorption[2]"},
        {with(ball(), "emission", {INFINITY, 0, 0}), ".emission[0]"},
        {with(with(ball(), "albedo", {1, 1, 1}), "extinction", {1, 1, 1}), ".scattering: given beside albedo"},
        {with(without(ball(), "scattering"), "albedo", {1, 1, 1}), "\"extinction\" is missing"},
        {with(without(ball(), "scattering"), "extinction", {1, 1, 1}), "\"albedo\" is missing"},
        {with(with(without(ball(), "scattering"), "albedo", {1, 1.1, 1}), "extinction", {1, 1, 1}), ".albedo[1]"},
        {with(with(without(ball(), "scattering"), "albedo", {1, 1, 1}), "extinction", {1, -1, 1}),
         ".extinction[1]"},
        {with(ball(), "anisotropy", 1), ".anisotropy"},
        {with(ball(), "anisotropy", -1), ".anisotropy"},
        {with(ball(), "anisotropy", true), ".anisotropy"},
        {with(ball(), "phase", "rayleigh"), ".phase: only the shapes global and height"},
        {{{"shape", "global"}, {"scattering", {1, 1, 1}}, {"phase", "air"}},
         ".phase: \"air\" given, one of mie, rayleigh"},
        {{{"shape", "global"}, {"scattering", {1, 1, 1}}, {"phase", 1}}, ".phase"},
        {{{"shape", "global"}, {"scattering", {1, 1, 1}}, {"phase", "rayleigh"}, {"anisotropy", 0.5}},
         ".phase: rayleigh has no anisotropy"},
        {with(ball(), "radius", 0), ".radius"},
        {with(ball(), "radius", nullptr), ".radius"},
        {with(box(), "size", {1, 0, 1}), ".size[1]"},
        {with(box(), "rotation", {0, 0, 0, 2}), ".rotation"},
        {with(box(), "rotation", {0, 0, 0, 0}), ".rotation"},
        {with(box(), "rotation", {0, 0, 1}), ".rotation"},
        {with(ball(), "softness", -1), ".softness"},
        {with(ball(), "softness", 1e30), ".softness"},
        {with(ball(), "center", {0, 1e30, 0}), ".center[1]"},
        {with(ball(), "radius", 1e-30), ".radius"},
        {with(ball(), "radius", 1e30), ".radius"},
        {with(ball(), "height", {{"base", -1e30}, {"falloff", 1}}), ".height.base"},
        {with(ball(), "noise", 1), ".noise"},
        {with(ball(), "noise", {{"scale", 0}, {"amount", 0.5}}), ".noise.scale"},
        {with(ball(), "noise", {{"scale", 1}, {"amount", 1.5}}), ".noise.amount"},
        {with(ball(), "noise", {{"scale", 1}, {"amount", 1}, {"seed", 1.5}}), ".noise.seed"},
        {with(ball(), "noise", {{"scale", 1}, {"amount", 1}, {"seed", -1}}), ".noise.seed"},
        {with(ball(), "noise", {{"scale", 1}, {"amount", 1}, {"lacunarity", 2}}), "\"lacunarity\""},
        {with(ball(), "height", {{"base", 0}}), "\"falloff\" is missing"},
        {with(ball(), "height", {{"base", 0}, {"falloff", 0}}), ".height.falloff"},
        {{{"shape", "height"}, {"scattering", {1, 1, 1}}, {"base", 0}, {"falloff", -1}}, ".falloff"},
        {{{"shape", "grid"}, {"scattering", {1, 1, 1}}}, "\"file\" is missing"},
        {json(3), "an object expected"},
    };
    for (const auto& [medium, fragment] : cases) {
        const json list = {{"media", json::array({ball(), medium})}};
        EXPECT_THAT(
            [&] { (void)parse_media(list, "fog.json", "."); },
            ThrowsMessage<Error>(AllOf(HasSubstr("fog.json: media[1]"), HasSubstr(fragment), Not(HasSubstr("\n")))))
            << medium;
    }
}

TEST(Medium, TheListItselfIsChecked) {
    for (const json& root : {json(1), json("x"), json(nullptr), json{{"media", 1}}, json::object(),
                             json{{"media", json::array()}, {"medium", 1}}})
        EXPECT_THAT([&] { (void)parse_media(root, "fog.json", "."); }, ThrowsMessage<Error>(HasSubstr("fog.json")))
            << root;
}

class MediumFile : public SceneFolderTest {};

TEST_F(MediumFile, LoadsAndNamesWhatFails) {
    const auto good = write("good.json", json{{"media", {ball()}}}.dump());
    EXPECT_EQ(load_media(good).size(), 1u);
    EXPECT_THAT([&] { (void)load_media(folder / "none.json"); }, ThrowsMessage<Error>(HasSubstr("none.json")));
    const auto garbage = write("garbage.json", "{\"media\": [");
    EXPECT_THAT([&] { (void)load_media(garbage); },
                ThrowsMessage<Error>(AllOf(HasSubstr("garbage.json"), HasSubstr("line 1"), Not(HasSubstr("\n")))));
    const auto deep = write("deep.json", std::string(100'000, '['));
    EXPECT_THAT(
        [&] { (void)load_media(deep); },
        ThrowsMessage<Error>(AllOf(HasSubstr("deep.json: the JSON is nested deeper"), Not(HasSubstr("\n")))));
    const auto one = write("one.json", ball().dump());
    EXPECT_THAT([&] { (void)load_media(one); },
                ThrowsMessage<Error>(HasSubstr("one.json: one medium given, a list of media expected")));
    const auto bad = write("bad.json", json{{"media", {{{"shape", "box\nx"}}}}}.dump());
    EXPECT_THAT([&] { (void)load_media(bad); },
                ThrowsMessage<Error>(AllOf(HasSubstr("bad.json: media[0].shape"), Not(HasSubstr("\n")))));
}

}  // namespace
}  // namespace tyndall
