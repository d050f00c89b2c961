#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "engine/core/image.h"
#include "engine/scene/scene.h"
#include "engine/scene/view.h"
#include "reference/geometry.h"
#include "reference/phase.h"

namespace tyndall::reference {

/// What of the engine's settings changes the ground truth, and how exact it is.
struct Settings {
    bool light_transmittance = true;  ///< media attenuate light on its way to the point (and to surfaces)
    ParticlePhase phase{};            ///< of all media but air
    bool shadows = true;
    double ambient = 0.4;  ///< factor on the sky's light
    /// The scene and its media stand before the sky, whose light comes from where it is bright. Off: its mean comes
    /// from everywhere, through everything.
    bool sky_visibility = false;
    int sky_samples = 8192;  ///< directions for each ray's air, a quarter for each lobe of its surface; from 1024
    bool black_surfaces = false;  ///< surfaces block and hide, and send no light
    bool black_sky = false;       ///< what leaves the scene sees nothing; light of the sky is `ambient`
    double tolerance = 1e-4;      ///< of the radiance of a ray, relative; absolute below `floor`
    double floor = 1e-6;          ///< cd/m²
};

/// Ground truth of one scene: single scattering and direct light in double precision, exact visibility. Shares with
/// the engine what describes scene, media and sky, and no code that integrates, scatters, shadows or reflects.
///
///     L = ∫ T(0,t) σ_s(t) Σ_i p(cos θ_i) V_i(t) T_i(t) E_i(t) dt + ∫ T(0,t) e(t) dt + T(0,d) L_surface
///
/// with σ_s p the sum of what the particles and the air at t scatter, and V_i a colour behind transparent surfaces
/// (Tint), which are not seen themselves. The sky's light comes on top, see SkyLight.
/// Rays go on to infinity. Thread-safe after construction; the scene must outlive it and not move.
class Reference {
  public:
    Reference(const Scene& scene, const Settings& settings);
    ~Reference();
    Reference(const Reference&) = delete;
    Reference& operator=(const Reference&) = delete;

    struct Ray {
        dvec3 scattering{0};     ///< in-scattered and emitted radiance that reaches the origin, cd/m²
        dvec3 transmittance{1};  ///< from the surface, or infinity, to the origin
        dvec3 background{0};     ///< radiance that leaves the surface or the sky towards the origin
        double distance = 0;     ///< m; infinite where there is only sky
        double error = 0;        ///< estimated absolute error of `scattering`, largest channel
        [[nodiscard]] dvec3 color() const { return scattering + transmittance * background; }
    };
    /// `begin`: surfaces nearer than this are not seen (the near plane, along the ray); media are.
    [[nodiscard]] Ray trace(dvec3 origin, dvec3 unit_direction, double begin) const;
    /// Its distance alone.
    [[nodiscard]] double visible_distance(dvec3 origin, dvec3 unit_direction, double begin) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Layers as Renderer::read_layer gives them: linear, 3 channels (depth and error: 1), row 0 at the top.
struct Picture {
    Image color, scattering, transmittance;
    Image depth;  ///< view depth at the pixel's centre ray, m; 0: sky
    Image error;  ///< estimate for `scattering`: quadrature, and for samples > 1 nothing of the sub-pixels' spread
};

/// `samples` × `samples` rays a pixel at the centres of its equal parts (1: the engine's own sample), averaged.
/// `threads` 0: all. `progress(rows done, rows)` is called from one thread at a time. The result does not depend on
/// the number of threads.
[[nodiscard]] Picture render(const Reference& reference, const View& view, glm::ivec2 size, int samples,
                             int threads, const std::function<void(int, int)>& progress = {});

}  // namespace tyndall::reference
