#pragma once

#include <optional>

#include "frame.h"
#include "reference/media.h"
#include "reference/reference.h"

namespace tyndall::stress {

using glm::dvec3;

struct PixelRay {
    dvec3 origin, direction;
    double begin;        ///< m along the ray, where the near plane is
    double view_cosine;  ///< view depth per metre
};
[[nodiscard]] PixelRay pixel_ray(const View& view, glm::dvec2 size, glm::dvec2 pixel);

/// The scene of a comparable frame as its technique knows it, by the CPU's ground truth: without lamps, local media
/// and shadows where the technique's documentation leaves them out. Light is in units of Scene::light_unit().
class Truth {
  public:
    Truth(const StressFrame& frame, Scene scene);
    [[nodiscard]] bool has_shadows() const { return shadowed_ != nullptr; }

    struct Pixel {
        glm::dvec2 place;
        PixelRay ray;
        reference::Reference::Ray open;  ///< nothing casts a shadow
    };
    [[nodiscard]] Pixel trace(glm::ivec2 pixel) const;
    [[nodiscard]] dvec3 transmittance(glm::ivec2 pixel) const;
    /// Scattering, with shadows.
    [[nodiscard]] dvec3 shadowed(const PixelRay& ray) const;
    [[nodiscard]] const reference::Media& local_media() const { return local_; }
    /// The same without their noise.
    [[nodiscard]] const reference::Media& smooth_media() const { return smooth_; }
    [[nodiscard]] const reference::Media& media() const { return media_; }
    /// How far one sees along a ray, m.
    [[nodiscard]] double visible_distance(const PixelRay& ray) const;
    [[nodiscard]] bool is_homogeneous() const;
    [[nodiscard]] const Scene& scene() const { return scene_; }

  private:
    /// The fog of fixed functions, which takes the media as they are at the eye.
    void apply_fog_mode(reference::Reference::Ray& ray) const;

    const StressFrame& frame_;
    Scene scene_;
    reference::Media media_, local_, smooth_;
    std::unique_ptr<reference::Reference> open_, shadowed_;
};

}  // namespace tyndall::stress
