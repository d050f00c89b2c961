#pragma once

namespace tyndall::reference {

/// Phase functions [1/sr]. cos_theta is between the directions in which light travels before and after: +1 is
/// forward, and g > 0 scatters forward. Beyond |g| = 0.999 they stay as they are there.
[[nodiscard]] double henyey_greenstein(double g, double cos_theta);
/// Of Blasi, Le Saec and Schlick 1993, with the fit k = 1.55 g - 0.55 g³ held at |k| <= 0.999.
[[nodiscard]] double schlick(double g, double cos_theta);

/// Of Cornette and Shanks 1992: Rayleigh's where g is 0.
[[nodiscard]] double cornette_shanks(double g, double cos_theta);
/// Of Draine 2003: Henyey-Greenstein times 1 + alpha cos², normalised.
[[nodiscard]] double draine(double g, double alpha, double cos_theta);
/// Of water droplets of a diameter of 5 … 50 um in visible light, fitted by Jendersie and d'Eon 2023.
[[nodiscard]] double droplets(double diameter, double cos_theta);
/// Of molecules: 3 (1 + cos²) / (16 pi).
[[nodiscard]] double rayleigh(double cos_theta);

/// The greatest value over all directions.
[[nodiscard]] double henyey_greenstein_peak(double g);
[[nodiscard]] double schlick_peak(double g);
[[nodiscard]] double cornette_shanks_peak(double g);
[[nodiscard]] double droplets_peak(double diameter);
[[nodiscard]] double rayleigh_peak();

/// The phase function of all media that are not air.
struct ParticlePhase {
    /// In the order of the setting. double_henyey_greenstein: a share back_weight of the light goes into a lobe of
    /// back_anisotropy (< 0). hg_draine: of droplets, whatever the anisotropy.
    enum class Kind { henyey_greenstein, schlick, cornette_shanks, double_henyey_greenstein, hg_draine };
    Kind kind = Kind::henyey_greenstein;
    double back_anisotropy = 0, back_weight = 0;
    double droplet_diameter = 10;  ///< um

    [[nodiscard]] double operator()(double g, double cos_theta) const;
    [[nodiscard]] double peak(double g) const;  ///< no less than the greatest value over all directions
};

}  // namespace tyndall::reference
