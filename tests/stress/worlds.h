#pragma once

#include <array>
#include <memory>

#include "adapter/volumetrics_adapter.h"
#include "engine/render/renderer.h"

namespace tyndall::stress {

/// nothing: no surface. standing: a floor, boxes, thin posts and a lamp shade at the origin. moving: the same as
/// dynamic objects, which a frame places.
enum class World { nothing, standing, moving };
constexpr int world_count = 3;

/// Scenes that are prepared once and drawn by many frames, each by a renderer of its own.
class Worlds {
  public:
    explicit Worlds(ShaderLibrary& shaders);
    struct Place {
        Scene scene;  ///< without lights, media and cameras
        std::unique_ptr<VolumetricsAdapter> volumetrics;
        std::unique_ptr<Renderer> renderer;
    };
    [[nodiscard]] Place& operator[](World world);

  private:
    ShaderLibrary& shaders_;
    std::array<Place, world_count> places_;
};

}  // namespace tyndall::stress
