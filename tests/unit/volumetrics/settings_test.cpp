#include "volumetrics/settings.h"

#include <gtest/gtest.h>

#include <set>

#include "engine/core/error.h"
#include "volumetrics/technique.h"

namespace tyndall::volumetrics {
namespace {

TEST(VolumetricsSettings, TableHoldsTheDefaultsAndExplainsEveryRow) {
    Settings settings;
    SettingsSet set;
    set.add(settings_table(), &settings);  // fails where a default is outside its range
    std::set<std::string> keys;
    for (const Setting& row : settings_table().settings()) {
        EXPECT_TRUE(keys.insert(row.key).second) << row.key;
        EXPECT_FALSE(row.label.empty()) << row.key;
        EXPECT_TRUE(row.help.ends_with('.')) << row.key;
    }
    EXPECT_EQ(keys.size(), 67U);  // one row for each member of Settings
}

TEST(VolumetricsSettings, NamesAreInEnumOrder) {
    Settings settings;
    SettingsSet set;
    set.add(settings_table(), &settings);
    set.set("technique", "off");
    EXPECT_EQ(settings.technique, "off");
    set.set("lamp_integration", "center");
    EXPECT_EQ(settings.lamp_integration, LampIntegration::center);
    set.set("stepping", "exponential");
    EXPECT_EQ(settings.stepping, Stepping::exponential);
    set.set("noise", "white");
    EXPECT_EQ(settings.noise, Noise::white);
    set.set("filter", "box3");
    EXPECT_EQ(settings.filter, Filter::box3);
    set.set("phase", "schlick");
    EXPECT_EQ(settings.phase, PhaseFunction::schlick);
    set.set("phase", "double_henyey_greenstein");
    EXPECT_EQ(settings.phase, PhaseFunction::double_henyey_greenstein);
    set.set("froxel_distribution", "linear");
    EXPECT_EQ(settings.froxel_distribution, DepthDistribution::linear);
    for (const std::string& name : technique_names()) {
        set.set("technique", name);
        EXPECT_EQ(settings.technique, name);
        EXPECT_EQ(set.get("technique"), name);
    }
}

TEST(VolumetricsSettings, ValuesOutOfRangeAreRefused) {
    Settings settings;
    SettingsSet set;
    set.add(settings_table(), &settings);
    for (const char* assignment : {"steps=0", "steps=1025", "noise_size=3", "filter_sigma=0", "technique=froxels",
                                   "phase=rayleigh", "phase_back_anisotropy=0.1", "phase_back_weight=1.1"})
        EXPECT_THROW(set.set(assignment), UsageError) << assignment;
}

}  // namespace
}  // namespace tyndall::volumetrics
