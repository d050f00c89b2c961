#include "engine/core/settings.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

enum class Dither { none, white, bayer };

struct Fog {
    bool enabled = true;
    int steps = 8;
    int dither_size = 8;
    float density = 0.1f;
    Dither dither = Dither::bayer;
};

const SettingsTable& fog_table() {
    static const SettingsTable table =
        SettingsTable("Fog")
            .boolean(&Fog::enabled, {"enabled", "Enabled", "Shows the fog."}, SettingEffect::permutation)
            .integer(&Fog::steps, {"steps", "Steps", "Samples a ray."}, 1, 1024, SettingEffect::uniform)
            .integer_of(&Fog::dither_size, {"dither_size", "Dither size", "Side.", "px"}, {2, 4, 8, 16},
                        SettingEffect::permutation)
            .real(&Fog::density, {"density", "Density", "Extinction.", "1/m"}, 0, 0.1)
            .choice(&Fog::dither, {"dither", "Dither", "Noise."}, {"none", "white", "bayer"},
                    SettingEffect::permutation);
    return table;
}

class Settings : public testing::Test {
  protected:
    Settings() { set_.add(fog_table(), &fog_); }
    Fog fog_;
    SettingsSet set_;
};

TEST_F(Settings, SetsEveryTypeFromText) {
    set_.set("steps=32");
    set_.set("dither_size", "16");
    set_.set("density", "0.025");
    set_.set("dither", "white");
    EXPECT_EQ(fog_.steps, 32);
    EXPECT_EQ(fog_.dither_size, 16);
    EXPECT_EQ(fog_.density, 0.025f);
    EXPECT_EQ(fog_.dither, Dither::white);
    for (const auto& [text, value] :
         {std::pair{"off", false}, {"on", true}, {"0", false}, {"1", true}, {"false", false}, {"true", true}}) {
        set_.set("enabled", text);
        EXPECT_EQ(fog_.enabled, value) << text;
    }
}

TEST_F(Settings, OutOfRangeNamesKeyValueAndRange) {
    EXPECT_THAT([&] { set_.set("steps=2000"); },
                ThrowsMessage<UsageError>(AllOf(HasSubstr("steps"), HasSubstr("2000"), HasSubstr("1 to 1024"))));
    EXPECT_THAT(
        [&] { set_.set("density=0.2"); },
        ThrowsMessage<UsageError>(AllOf(HasSubstr("density"), HasSubstr("0.2"), HasSubstr("0 to 0.1 1/m"))));
    EXPECT_THAT(
        [&] { set_.set("dither_size=3"); },
        ThrowsMessage<UsageError>(AllOf(HasSubstr("dither_size"), HasSubstr("3"), HasSubstr("2, 4, 8, 16"))));
    EXPECT_THAT(
        [&] { set_.set("dither=blue"); },
        ThrowsMessage<UsageError>(AllOf(HasSubstr("dither"), HasSubstr("blue"), HasSubstr("none, white, bayer"))));
    EXPECT_EQ(fog_.steps, 8);
    EXPECT_EQ(fog_.density, 0.1f);
    EXPECT_EQ(fog_.dither_size, 8);
    EXPECT_EQ(fog_.dither, Dither::bayer);
}

TEST_F(Settings, RejectsWhatIsNotAValue) {
    for (const char* bad :
         {"steps=8.5", "steps=", "steps=8x", "steps= 8", "steps=nan", "steps=1e999", "density=nan", "density=inf",
          "density=-1e-9", "density=0x1", "enabled=2", "enabled=yes", "dither=1", "dither=Bayer"}) {
        EXPECT_THROW(set_.set(bad), UsageError) << bad;
    }
}

TEST_F(Settings, BoundsAreAllowed) {
    set_.set("steps=1");
    set_.set("steps=1024");
    set_.set("density=0");
    set_.set("density=0.1");
    EXPECT_EQ(fog_.density, 0.1f);
}

TEST_F(Settings, UnknownKeyIsNamed) {
    EXPECT_THAT([&] { set_.set("step=3"); }, ThrowsMessage<UsageError>("unknown setting \"step\""));
    EXPECT_THAT([&] { (void)set_.get("step"); }, ThrowsMessage<UsageError>("unknown setting \"step\""));
    EXPECT_THROW(set_.set("steps"), UsageError);
}

TEST_F(Settings, JsonRoundTripKeepsEveryValue) {
    fog_ = {false, 77, 4, 0.0123456f, Dither::white};
    const json saved = json::parse(set_.to_json().dump());
    EXPECT_EQ(saved, json::parse(R"({"enabled":false,"steps":77,"dither_size":4,"density":0.0123456,
                                     "dither":"white"})"));
    fog_ = {};
    set_.from_json(saved, "preset.json");
    EXPECT_FALSE(fog_.enabled);
    EXPECT_EQ(fog_.steps, 77);
    EXPECT_EQ(fog_.dither_size, 4);
    EXPECT_EQ(fog_.density, 0.0123456f);
    EXPECT_EQ(fog_.dither, Dither::white);
}

TEST_F(Settings, BoundThatIsNoFloatRoundTrips) {
    fog_.density = 0.1f;  // as a double a little over the bound 0.1
    set_.from_json(set_.to_json(), "preset.json");
    set_.set("density", set_.get("density"));
    EXPECT_EQ(fog_.density, 0.1f);
    EXPECT_NO_THROW(set_.from_json(json{{"density", double(0.1f)}}, "preset.json"));
}

TEST_F(Settings, JsonIsAllOrNothing) {
    const json half_bad = {{"density", 0.05}, {"steps", 0}};
    EXPECT_THAT([&] { set_.from_json(half_bad, "dir/preset.json"); },
                ThrowsMessage<Error>(AllOf(StartsWith("dir/preset.json: "), HasSubstr("steps"), HasSubstr("0"),
                                           HasSubstr("1 to 1024"))));
    EXPECT_EQ(fog_.density, 0.1f);
    EXPECT_THROW(set_.from_json(json{{"density", 0.05}, {"nonsense", 1}}, "p"), Error);
    EXPECT_EQ(fog_.density, 0.1f);
}

TEST_F(Settings, JsonOfTheWrongTypeIsAnErrorButNoUsageError) {
    for (const json& bad : {json{{"steps", "8"}}, json{{"steps", true}}, json{{"enabled", 1}}, json{{"dither", 1}},
                            json{{"density", nullptr}}, json{{"density", json::array()}}, json::array(), json(3)}) {
        try {
            set_.from_json(bad, "p");
            FAIL() << bad;
        } catch (const UsageError&) {
            FAIL() << "a bad file is a run-time failure: " << bad;
        } catch (const Error&) {
        }
    }
}

TEST_F(Settings, KeysThatAreNotNamedKeepTheirValue) {
    fog_.steps = 99;
    set_.from_json(json{{"density", 0.05}}, "p");
    EXPECT_EQ(fog_.steps, 99);
    EXPECT_EQ(fog_.density, 0.05f);
}

TEST_F(Settings, ResetRestoresDefaults) {
    fog_ = {false, 77, 4, 0.01f, Dither::white};
    set_.reset_to_defaults();
    EXPECT_TRUE(fog_.enabled);
    EXPECT_EQ(fog_.steps, 8);
    EXPECT_EQ(fog_.dither_size, 8);
    EXPECT_EQ(fog_.density, 0.1f);
    EXPECT_EQ(fog_.dither, Dither::bayer);
}

using SettingsDeathTest = Settings;

TEST_F(SettingsDeathTest, DuplicateKeyIsAFailedCheck) {
    EXPECT_DEATH(set_.add(fog_table(), &fog_), "check failed.*enabled");
}

TEST_F(SettingsDeathTest, DefaultOutsideItsRangeIsAFailedCheck) {
    const SettingsTable bad =
        SettingsTable("bad").integer(&Fog::steps, {"other", "", ""}, 10, 20, SettingEffect::uniform);
    EXPECT_DEATH(set_.add(bad, &fog_), "check failed.*other");
}

struct Grouped {
    struct Inner {
        float width = 2;
        int count = 3;
    };
    Inner inner = {};
    std::string name = "first";
};

const std::vector<std::string>& grouped_names() {
    static const std::vector<std::string> names{"first", "second"};
    return names;
}

TEST(SettingsTable, RowsOfAGroupAndOfANameReadAndWriteTheirMember) {
    const SettingsTable table =
        SettingsTable("Grouped")
            .real(in(&Grouped::inner, &Grouped::Inner::width), {"width", "", ""}, 0, 10)
            .integer(in(&Grouped::inner, &Grouped::Inner::count), {"count", "", ""}, 0, 9, SettingEffect::uniform)
            .name(&Grouped::name, {"name", "", ""}, grouped_names, SettingEffect::uniform);
    Grouped grouped;
    SettingsSet set;
    set.add(table, &grouped);
    EXPECT_EQ(set.get("width"), "2");
    EXPECT_EQ(table.settings()[1].default_value, 3);
    set.set("width=4.5");
    set.set("count=7");
    set.set("name=second");
    EXPECT_EQ(grouped.inner.width, 4.5F);
    EXPECT_EQ(grouped.inner.count, 7);
    EXPECT_EQ(grouped.name, "second");
    EXPECT_THROW(set.set("name=third"), UsageError);
    grouped.name = "third";
    EXPECT_THROW((void)set.get("name"), Error);
}

}  // namespace
}  // namespace tyndall
