#include "volumetrics/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <set>

#include "engine/core/error.h"
#include "volumetrics/technique.h"

namespace tyndall::volumetrics {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class VolumetricsSettings : public testing::Test {
  protected:
    VolumetricsSettings() { set_.add(settings_table(), &settings_); }  // fails where a default is out of its range
    Settings settings_;
    SettingsSet set_;

    /// Where in Settings a row's value is: the bytes that differ between its least and its greatest.
    static std::set<std::size_t> bytes_of(const Setting& row) {
        Settings settings;
        std::array<unsigned char, sizeof(Settings)> least{}, greatest{};
        row.set(&settings, row.min);
        std::memcpy(least.data(), static_cast<const void*>(&settings), sizeof settings);
        row.set(&settings, row.max);
        std::memcpy(greatest.data(), static_cast<const void*>(&settings), sizeof settings);
        std::set<std::size_t> bytes;
        for (std::size_t i = 0; i < sizeof settings; ++i)
            if (least[i] != greatest[i]) bytes.insert(i);
        return bytes;
    }
    /// That the names of a choice are those of the enumerators, and no others.
    template <class Enum>
    void expect_names(const std::string& key, const Enum& member,
                      const std::vector<std::pair<std::string, Enum>>& names) {
        for (const auto& [name, value] : names) {
            set_.set(key, name);
            EXPECT_EQ(member, value) << key << " = " << name;
            EXPECT_EQ(set_.get(key), name);
        }
        named_[key] = names.size();
    }
    std::map<std::string, std::size_t> named_;  ///< key: number of names
};

// Without a row a member is in no preset and has no range. Members are of 4 bytes but for booleans, and the
// technique.
TEST_F(VolumetricsSettings, EveryMemberHasOneRowThatExplainsIt) {
    std::set<std::string> keys;
    std::set<std::size_t> bytes, cells;
    for (const Setting& row : settings_table().settings()) {
        EXPECT_TRUE(keys.insert(row.key).second) << row.key;
        EXPECT_FALSE(row.label.empty()) << row.key;
        EXPECT_TRUE(row.help.ends_with('.')) << row.key;
        for (const std::size_t byte : bytes_of(row)) {
            EXPECT_TRUE(bytes.insert(byte).second) << row.key << " is the member of another row, too";
            cells.insert(byte / 4);
        }
    }
    const auto technique = static_cast<std::size_t>(reinterpret_cast<const char*>(&settings_.technique) -
                                                    reinterpret_cast<const char*>(&settings_));
    for (std::size_t i = 0; i < sizeof settings_.technique; i += 4) cells.insert((technique + i) / 4);
    for (std::size_t cell = 0; 4 * cell <= sizeof(Settings) - alignof(Settings); ++cell)  // the rest may be padding
        EXPECT_TRUE(cells.contains(cell)) << "no row for the member at byte " << 4 * cell;
}

TEST_F(VolumetricsSettings, NamesAreInEnumOrder) {
    const Settings& s = settings_;
    std::vector<std::pair<std::string, std::string>> techniques;
    for (const std::string& name : technique_names()) techniques.emplace_back(name, name);
    expect_names("technique", s.technique, techniques);
    expect_names("lamp_integration", s.light.lamp_integration,
                 {{"center", LampIntegration::center}, {"segment", LampIntegration::segment}});
    expect_names("stepping", s.march.stepping,
                 {{"uniform", Stepping::uniform}, {"exponential", Stepping::exponential}});
    expect_names("noise", s.noise.kind,
                 {{"none", Noise::none},
                  {"bayer", Noise::bayer},
                  {"white", Noise::white},
                  {"white_tile", Noise::white_tile},
                  {"ign", Noise::ign},
                  {"blue", Noise::blue},
                  {"stbn", Noise::stbn},
                  {"fast", Noise::fast}});
    expect_names("noise_time", s.noise.time,
                 {{"fixed", NoiseTime::fixed},
                  {"own", NoiseTime::own},
                  {"golden_ratio", NoiseTime::golden_ratio},
                  {"r2", NoiseTime::r2}});
    expect_names("fast_space", s.noise.fast_space,
                 {{"gaussian1", SpatialKernel::gaussian1},
                  {"box3", SpatialKernel::box3},
                  {"box5", SpatialKernel::box5},
                  {"binomial3", SpatialKernel::binomial3},
                  {"binomial5", SpatialKernel::binomial5}});
    expect_names("fast_time", s.noise.fast_time, {{"ema", TemporalKernel::ema}, {"box8", TemporalKernel::box8}});
    expect_names("filter", s.filter.kernel,
                 {{"none", Filter::none},
                  {"box3", Filter::box3},
                  {"box5", Filter::box5},
                  {"gaussian1", Filter::gaussian1},
                  {"binomial3", Filter::binomial3},
                  {"binomial5", Filter::binomial5},
                  {"gaussian15", Filter::gaussian15},
                  {"uniform9", Filter::uniform9}});
    expect_names("filter_depth", s.filter.depth,
                 {{"none", FilterDepth::none}, {"relative", FilterDepth::relative}, {"plane", FilterDepth::plane}});
    expect_names("reconstruct", s.filter.reconstruct,
                 {{"light", Reconstruct::light}, {"visibility", Reconstruct::visibility}});
    expect_names("resolution", s.resolution.size,
                 {{"full", Resolution::full}, {"half", Resolution::half}, {"quarter", Resolution::quarter}});
    expect_names(
        "resolution_depth", s.resolution.depth,
        {{"min", DepthChoice::min}, {"max", DepthChoice::max}, {"checkerboard", DepthChoice::checkerboard}});
    expect_names("upsample", s.resolution.upsample,
                 {{"nearest", Upsample::nearest},
                  {"bilinear", Upsample::bilinear},
                  {"bilateral", Upsample::bilateral},
                  {"nearest_depth", Upsample::nearest_depth}});
    expect_names("temporal", s.temporal.mode,
                 {{"off", Temporal::off},
                  {"blend", Temporal::blend},
                  {"ema", Temporal::ema},
                  {"acceptance", Temporal::acceptance},
                  {"accumulate", Temporal::accumulate}});
    expect_names("temporal_place", s.temporal.place,
                 {{"before", TemporalPlace::before}, {"after", TemporalPlace::after}});
    expect_names("phase", s.light.phase,
                 {{"henyey_greenstein", PhaseFunction::henyey_greenstein},
                  {"schlick", PhaseFunction::schlick},
                  {"cornette_shanks", PhaseFunction::cornette_shanks},
                  {"double_henyey_greenstein", PhaseFunction::double_henyey_greenstein},
                  {"hg_draine", PhaseFunction::hg_draine}});
    expect_names("froxel_distribution", s.froxels.distribution,
                 {{"linear", DepthDistribution::linear},
                  {"exponential", DepthDistribution::exponential},
                  {"logarithmic", DepthDistribution::logarithmic},
                  {"curve", DepthDistribution::curve},
                  {"auto", DepthDistribution::automatic}});
    expect_names("fog_mode", s.analytic_fog.mode,
                 {{"linear", FogMode::linear},
                  {"squared", FogMode::squared},
                  {"exponential", FogMode::exponential},
                  {"height", FogMode::height}});
    expect_names("radial_occlusion", s.radial_shafts.occlusion,
                 {{"coverage", RadialOcclusion::coverage}, {"intervals", RadialOcclusion::intervals}});
    for (const Setting& row : settings_table().settings())
        EXPECT_EQ(row.choices.size(), named_[row.key]) << row.key;
}

TEST_F(VolumetricsSettings, ValuesOutOfRangeAreRefused) {
    const auto expect_refused = [&](const std::string& key, const std::string& value) {
        const std::string before = set_.get(key);
        EXPECT_THAT([&] { set_.set(key, value); },
                    ThrowsMessage<UsageError>(AllOf(HasSubstr(key), HasSubstr(value))));
        EXPECT_EQ(set_.get(key), before);
    };
    for (const auto& [key, value] :
         std::vector<std::pair<std::string, std::string>>{{"steps", "0"},
                                                          {"steps", "1025"},
                                                          {"noise_size", "3"},
                                                          {"filter_sigma", "0"},
                                                          {"technique", "froxels"},
                                                          {"phase", "rayleigh"},
                                                          {"phase_back_anisotropy", "0.1"},
                                                          {"phase_back_weight", "1.1"}})
        expect_refused(key, value);
    for (const Setting& row : settings_table().settings()) {
        expect_refused(row.key, "nan");
        if (row.type == SettingType::boolean || row.type == SettingType::choice) continue;
        for (const double bound : {row.min, row.max}) {
            EXPECT_NO_THROW(set_.set(row.key, std::to_string(bound))) << row.key;
            EXPECT_FLOAT_EQ(static_cast<float>(row.get(&settings_)), static_cast<float>(bound)) << row.key;
        }
        const double beyond = row.type == SettingType::integer ? 1 : 0.01 * (row.max - row.min);
        expect_refused(row.key, std::to_string(row.min - beyond));
        expect_refused(row.key, std::to_string(row.max + beyond));
    }
}

}  // namespace
}  // namespace tyndall::volumetrics
