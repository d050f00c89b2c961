#pragma once

#include <glm/glm.hpp>

#include "engine/gl/texture.h"
#include "engine/render/draw_list.h"
#include "engine/render/gpu_scene.h"
#include "engine/shader/shader_library.h"
#include "shaders/shared/lights.h"

namespace tyndall {

/// Draws what glass leaves of light into maps beside shadow maps, for shaders/engine/glass_lookup.glsl.
class ShadowGlass {
  public:
    explicit ShadowGlass(ShaderLibrary& shaders) : shaders_(shaders) {}

    /// RGBA16, an array.
    [[nodiscard]] static gl::TextureDesc desc(int size, int layers);
    /// Clears the bound target, or what the scissor leaves of it: no glass.
    static void clear();

    struct Map {
        glm::mat4 world_to_clip;
        glm::vec4 nearness;        ///< dot(nearness, (world, 1)): 0..1, greater is nearer to the light
        gl::TextureView shadows;   ///< drawn before, of the same things
        int layer = 0;             ///< of `shadows`, if it is an array
        int size = 0;              ///< px, a side of the target
        bool depth_clamp = false;  ///< glass nearer to the light than the map counts
    };
    /// `list` holds glass.
    void draw(const GpuScene& gpu, const DrawList& list, int view, const Map& map) const;

  private:
    ShaderLibrary& shaders_;
};

/// ShadowGlass::Map::nearness of a lamp's or further sun's tile.
[[nodiscard]] glm::vec4 tile_nearness(const shared::ShadowTile& tile, bool is_sun);

}  // namespace tyndall
