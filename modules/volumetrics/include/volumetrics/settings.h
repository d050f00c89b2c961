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
enum class PhaseFunction { henyey_greenstein, schlick, cornette_shanks, double_henyey_greenstein, hg_draine };
enum class DepthDistribution { linear, exponential, logarithmic, curve, automatic };
enum class FogMode { linear, squared, exponential, height };
enum class RadialOcclusion { coverage, intervals };

// Everything that a person can choose, by technique and concern. What each does: `settings_table()`, whose keys are
// those of presets and `--set`. Here: unit and range.

/// Of rays, for all techniques that march or end them.
struct MarchSettings {
    int steps = 8;  ///< 1 … 1024 segments a ray
    Stepping stepping = Stepping::exponential;
    float stepping_strength = 1.0f;  ///< 0.01 … 10: logarithm of the last segment's length over the first's
    float max_distance = 256;        ///< m, 1 … 100000; behind it global media go on in closed form
    float grid_piece = 1;  ///< 0.25 … 4 voxels, or pixels: what light and density of a grid are told apart by
};
struct LightSettings {
    LampIntegration lamp_integration = LampIntegration::segment;
    bool transmittance = true;  ///< media dim light on its way
    PhaseFunction phase = PhaseFunction::henyey_greenstein;
    float back_anisotropy = -0.5f;  ///< -0.999 … 0, of double_henyey_greenstein
    float back_weight = 0.2f;       ///< 0 … 1
    float droplet_diameter = 10;    ///< um, 5 … 50, of hg_draine
    int sky_steps = 12;             ///< 1 … 128, where ambient light differs from place to place
    int scattering_orders = 1;      ///< 1 … 8, of sunlight in density grids
};
/// Of techniques that sample.
struct NoiseSettings {
    Noise kind = Noise::bayer;
    int size = 8;  ///< px: 2, 4, 8 or 16, of bayer and white_tile
    NoiseTime time = NoiseTime::golden_ratio;
    SpatialKernel fast_space = SpatialKernel::gaussian1;
    TemporalKernel fast_time = TemporalKernel::ema;
};
struct FilterSettings {
    Filter kernel = Filter::gaussian15;
    float sigma = 2.0f;  ///< px, 0.3 … 7, of gaussian15
    bool narrows = true;
    FilterDepth depth = FilterDepth::relative;
    float depth_falloff = 3.0f;  ///< 0 … 100
    Reconstruct reconstruct = Reconstruct::visibility;
};
struct ResolutionSettings {
    Resolution size = Resolution::full;
    DepthChoice depth = DepthChoice::checkerboard;
    Upsample upsample = Upsample::bilateral;
    float tolerance = 0.1f;  ///< 0.01 … 1: differences of low pixels beyond it are drawn anew, of density grids
};
struct TemporalSettings {
    Temporal mode = Temporal::accumulate;
    TemporalPlace place = TemporalPlace::before;
    float weight = 0.1f;  ///< 0.01 … 1, least of the new frame, but for accumulate
    float scale = 16.0f;  ///< 0 … 1000, of the relative distance that lowers acceptance
    int frames = 32;      ///< 1 … 256, most that accumulate counts
    bool clip = true, reject = true;
};
/// Of local media, of the technique froxel, and of the fog in front of transparents.
struct FroxelSettings {
    int x = 80, y = 45, z = 64;  ///< 8 … 512, 8 … 512, 8 … 256 froxels
    int pixels = 3;              ///< 0 … 64 px, least width and height of a column in the picture; 0: none
    float far = 128;             ///< m, 4 … 4096 of view depth
    DepthDistribution distribution = DepthDistribution::automatic;
    /// Relative thickness of the slices in each eighth of them: any positive numbers make a rising curve.
    float curve_1 = 0.3f, curve_2 = 0.5f, curve_3 = 0.7f, curve_4 = 1, curve_5 = 1.5f, curve_6 = 2.5f, curve_7 = 6,
          curve_8 = 16;
    int history = 128;  ///< 0 … 256 frames, of the technique froxel
};
/// What local media leave of light.
struct LightVolumeSettings {
    int sun_size = 128;     ///< 8 … 512 texels across
    int grid_size = 256;    ///< 16 … 512 texels across, for each density grid
    float grid_detail = 1;  ///< 0.25 … 4 texels a voxel along the light, twice as many across it
    int lamp_size = 24;     ///< 4 … 64 directions across, and distances
    int lamp_count = 256;   ///< 1 … 1024
};
struct BillboardSettings {
    int layers = 24, local_layers = 16;  ///< 1 … 256 of global media; 1 … 64 of each local medium
    float fade = 0.5f;                   ///< m, 0 … 10
};
struct ParticleSettings {
    int count = 65536, local_count = 32768;  ///< 512 … 1048576; 32 … 1048576
    float distance = 64;                     ///< m, 4 … 4096
    float size = 1;                          ///< 0.25 … 4 spacings
    float drift = 0.1f;                      ///< m/s, 0 … 10
};
struct AnalyticFogSettings {
    FogMode mode = FogMode::height;
};
struct RadialShaftSettings {
    RadialOcclusion occlusion = RadialOcclusion::intervals;
    int samples = 32;     ///< 1 … 512
    float decay = 1.0f;   ///< 0.01 … 100
    float unseen = 1.0f;  ///< 0 … 1
};
struct ShaftGeometrySettings {
    int grid = 256;      ///< 16 … 1024 cells a side
    int segments = 6;    ///< 1 … 64 a ray
    int lamp_parts = 4;  ///< 1 … 64 a lamp and ray
};
struct EpipolarSettings {
    float spacing = 1;       ///< px, 0.25 … 16
    int cells = 1024;        ///< of the sun: a power of two, 64 … 2048
    int step = 1;            ///< samples, a power of two, 1 … 32; 1: every pixel asks the trees
    float tolerance = 0.1f;  ///< 0.001 … 1, relative, of depth
    bool tree = true;
    float lamp_spacing = 1;  ///< px, 0.25 … 64
    int lamp_cells = 512;    ///< a power of two, 16 … 2048
    int lamp_rays = 32;      ///< 1 … 1024 a pixel, of all lamps
};
/// Of the technique auto.
struct AutoSettings {
    int lamps = 8;  ///< 0 … 8 that pixels take one by one
    float least_lamp =
        0.5f;  ///< 0 … 1 of all lamps' light, for each of them; a tenth of it without local media in view
};
struct ReferenceSettings {
    int steps = 1024;       ///< 16 … 16384 a ray
    int lamp_samples = 16;  ///< 1 … 64 a lamp and 16 steps
    int light_steps = 16;   ///< 1 … 256 towards a light, in each soft or noisy local medium
};

struct Settings {
    std::string technique = "auto";  ///< the name of one of those in technique.h
    MarchSettings march = {};
    LightSettings light = {};
    NoiseSettings noise = {};
    FilterSettings filter = {};
    ResolutionSettings resolution = {};
    TemporalSettings temporal = {};
    FroxelSettings froxels = {};
    LightVolumeSettings light_volumes = {};
    BillboardSettings billboards = {};
    ParticleSettings particles = {};
    AnalyticFogSettings analytic_fog = {};
    RadialShaftSettings radial_shafts = {};
    ShaftGeometrySettings shaft_geometry = {};
    EpipolarSettings epipolar = {};
    AutoSettings automatic = {};
    ReferenceSettings reference = {};
};

[[nodiscard]] const SettingsTable& settings_table();

/// The eight of the curve.
inline constexpr std::array froxel_curve_settings{
    &FroxelSettings::curve_1, &FroxelSettings::curve_2, &FroxelSettings::curve_3, &FroxelSettings::curve_4,
    &FroxelSettings::curve_5, &FroxelSettings::curve_6, &FroxelSettings::curve_7, &FroxelSettings::curve_8};
/// View depth / froxel_far at 0, 1/16 … 16/16 of the slices, rising from 0 to 1: a monotone cubic through the sums
/// of the eight settings.
[[nodiscard]] std::array<float, 17> froxel_curve(const Settings& settings);

/// Names of a choice, in enum order.
[[nodiscard]] const std::vector<std::string>& spatial_kernel_names();
[[nodiscard]] const std::vector<std::string>& temporal_kernel_names();

}  // namespace tyndall::volumetrics
