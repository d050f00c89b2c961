#pragma once

namespace tyndall::reference {

/// Phase functions [1/sr]. cos_theta is between the directions in which light travels before and after: +1 is
/// forward, and g > 0 scatters forward. Beyond |g| = 0.999 they stay as they are there.
[[nodiscard]] double henyey_greenstein(double g, double cos_theta);
/// Of Blasi, Le Saec and Schlick 1993, with the fit k = 1.55 g - 0.55 g³ held at |k| <= 0.999.
[[nodiscard]] double schlick(double g, double cos_theta);

/// The greatest value over all directions.
[[nodiscard]] double henyey_greenstein_peak(double g);
[[nodiscard]] double schlick_peak(double g);

}  // namespace tyndall::reference
