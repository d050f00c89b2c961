// How a medium scatters into a direction.
#ifndef VOLUMETRICS_SCATTERING_GLSL
#define VOLUMETRICS_SCATTERING_GLSL

#include "shaders/lib/phase.glsl"
#include "shaders/volumetrics/media/global_media.glsl"

// The phase function of the settings, which all media have but those of Rayleigh's; `part`: of its anisotropy.
float particle_phase(float anisotropy, float part, float cos_theta) {
    int kind = int(volumetrics.phase);
    float g = kind == PHASE_HG_DRAINE ? volumetrics.droplet_anisotropy : anisotropy;
    return phase(kind, part * g, part * volumetrics.second_anisotropy, part * volumetrics.second_alpha, volumetrics.second_weight,
                 cos_theta);
}

// The volume scattering function [1/(m sr)]: scattering coefficient times phase function, summed over the media. For
// ambient light: ambient.glsl.
vec3 volume_scattering(Medium m, float cos_theta) {
    vec3 sum = particle_sigma_s(m) * particle_phase(m.anisotropy, 1.0, cos_theta);
#if RAYLEIGH
    sum += m.sigma_s_rayleigh * phase_rayleigh(cos_theta);
#endif
    return sum;
}

#endif
