#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/core/settings.h"

namespace tyndall::volumetrics {

enum class LampIntegration { center, segment };
enum class Stepping { uniform, exponential };
enum class Noise { none, bayer, white, white_tile, ign, blue, stbn, fast };
enum class NoiseTime { fixed, own, golden_ratio, r2 };
enum class SpatialKernel { gaussian1, box3, box5, binomial3, binomial5 };
enum class TemporalKernel { ema, box8 };
enum class Filter { none, box3, box5, gaussian1, binomial3, binomial5, gaussian15, uniform9 };
enum class FilterDepth { none, relative, plane };
enum class Reconstruct { light, visibility };
enum class Resolution { full, half, quarter };
enum class DepthChoice { min, max, checkerboard };
enum class Upsample { nearest, bilinear, bilateral, nearest_depth };
enum class Temporal { off, blend, ema, acceptance, accumulate };
enum class TemporalPlace { before, after };
enum class PhaseFunction { henyey_greenstein, schlick, cornette_shanks, double_henyey_greenstein };
enum class DepthDistribution { linear, exponential, logarithmic, curve, automatic };
enum class FogMode { linear, squared, exponential, height };
enum class RadialOcclusion { coverage, intervals };

/// Everything a person can choose. Ranges, units and help: `settings_table()`.
struct Settings {
    std::string technique = "ray_march";  ///< the name of one of those in technique.h
    int steps = 8;
    Stepping stepping = Stepping::exponential;
    float stepping_strength = 1.0f;
    float max_distance = 256;
    LampIntegration lamp_integration = LampIntegration::segment;
    bool light_transmittance = true;
    PhaseFunction phase = PhaseFunction::henyey_greenstein;
    float phase_back_anisotropy = -0.5f;
    float phase_back_weight = 0.2f;
    Noise noise = Noise::bayer;
    int noise_size = 8;
    NoiseTime noise_time = NoiseTime::golden_ratio;
    SpatialKernel fast_space = SpatialKernel::gaussian1;
    TemporalKernel fast_time = TemporalKernel::ema;
    Filter filter = Filter::gaussian15;
    float filter_sigma = 2.0f;
    bool filter_narrows = true;
    FilterDepth filter_depth = FilterDepth::relative;
    float filter_depth_falloff = 3.0f;
    Reconstruct reconstruct = Reconstruct::visibility;
    Resolution resolution = Resolution::full;
    DepthChoice resolution_depth = DepthChoice::checkerboard;
    Upsample upsample = Upsample::bilateral;
    Temporal temporal = Temporal::accumulate;
    TemporalPlace temporal_place = TemporalPlace::before;
    float temporal_weight = 0.1f;
    float temporal_scale = 16.0f;
    int temporal_frames = 32;
    bool temporal_clip = true;
    bool temporal_reject = true;
    int froxels_x = 160, froxels_y = 90, froxels_z = 64;
    float froxel_far = 128;
    DepthDistribution froxel_distribution = DepthDistribution::exponential;
    float froxel_curve_1 = 0.3f, froxel_curve_2 = 0.5f, froxel_curve_3 = 0.7f, froxel_curve_4 = 1,
          froxel_curve_5 = 1.5f, froxel_curve_6 = 2.5f, froxel_curve_7 = 6, froxel_curve_8 = 16;
    int froxel_history = 128;
    int sun_volume_size = 128;
    int lamp_volume_size = 24;
    int lamp_volume_count = 256;
    int billboard_layers = 24;
    int billboard_local_layers = 16;
    float billboard_fade = 0.5f;
    int particle_count = 65536;
    int particle_local_count = 32768;
    float particle_distance = 64;
    float particle_size = 1;
    float particle_drift = 0.1f;
    FogMode fog_mode = FogMode::height;
    RadialOcclusion radial_occlusion = RadialOcclusion::intervals;
    int radial_samples = 32;
    float radial_decay = 1.0f;
    float radial_unseen = 1.0f;
    int shaft_grid = 256;
    int shaft_segments = 6;
    int shaft_lamp_parts = 4;
    int reference_steps = 1024;
    int reference_lamp_samples = 16;
    int reference_light_steps = 16;
};

[[nodiscard]] const SettingsTable& settings_table();

/// The settings froxel_curve_1 … 8: relative thickness of the slices in each eighth of them. Any positive numbers
/// make a rising curve.
inline constexpr std::array froxel_curve_settings{
    &Settings::froxel_curve_1, &Settings::froxel_curve_2, &Settings::froxel_curve_3, &Settings::froxel_curve_4,
    &Settings::froxel_curve_5, &Settings::froxel_curve_6, &Settings::froxel_curve_7, &Settings::froxel_curve_8};
/// View depth / froxel_far at 0, 1/16 … 16/16 of the slices, rising from 0 to 1: a monotone cubic through the sums
/// of the eight settings.
[[nodiscard]] std::array<float, 17> froxel_curve(const Settings& settings);

/// Names of a choice, in enum order.
[[nodiscard]] const std::vector<std::string>& spatial_kernel_names();
[[nodiscard]] const std::vector<std::string>& temporal_kernel_names();

}  // namespace tyndall::volumetrics
