#pragma once

#include "engine/core/settings.h"

namespace tyndall::volumetrics {

enum class Technique {
    off,
    ray_march,
    froxel,
    billboards,
    particles,
    shaft_geometry,
    analytic_fog,
    radial_shafts,
    reference
};
enum class LampIntegration { center, segment };
enum class Stepping { uniform, exponential };
enum class Dither { none, white, bayer };
enum class Blur { none, gaussian, bilateral };
enum class PhaseFunction { henyey_greenstein, schlick };
enum class DepthDistribution { linear, exponential, logarithmic };

/// Everything a person can choose. Ranges, units and help: `settings_table()`.
struct Settings {
    Technique technique = Technique::ray_march;
    int steps = 8;
    Stepping stepping = Stepping::exponential;
    float stepping_strength = 1.0f;
    float max_distance = 256;
    LampIntegration lamp_integration = LampIntegration::segment;
    bool light_transmittance = true;
    PhaseFunction phase = PhaseFunction::henyey_greenstein;
    Dither dither = Dither::bayer;
    int dither_size = 8;
    Blur blur = Blur::bilateral;
    float blur_sigma = 2.0f;
    float blur_depth_falloff = 3.0f;
    int froxels_x = 160, froxels_y = 90, froxels_z = 64;
    float froxel_far = 128;
    DepthDistribution froxel_distribution = DepthDistribution::exponential;
    bool froxel_jitter = false;
    int reference_steps = 1024;
    int reference_lamp_samples = 16;
    int reference_light_steps = 16;
};

[[nodiscard]] const SettingsTable& settings_table();

/// `--technique` names, in enum order.
[[nodiscard]] const std::vector<std::string>& technique_names();

}  // namespace tyndall::volumetrics
