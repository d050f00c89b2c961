#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/gl/buffer.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/sampler.h"
#include "engine/gl/texture.h"
#include "engine/render/draw_list.h"
#include "engine/render/frame_context.h"
#include "engine/render/passes/shadow_casters.h"
#include "engine/render/passes/sky.h"
#include "engine/render/sky_directions.h"

namespace tyndall {

/// Something opaque that stands still casts shadows.
[[nodiscard]] bool has_static_casters(const GpuScene& gpu);

/// Light of the sky as it arrives at the cells of a grid, past all casters that stand still: up to SKY_LEVELS
/// levels of equal numbers of cells, each of cells three times as wide as the one before; the finer ones round the
/// eye, the coarsest over the scene. Each direction of the sky has a depth map of the casters, against which all
/// cells of a level are tested. A level is built anew when the sky, a caster or a setting changed, or the eye has
/// come near its border, and until it is ready the one before is used.
class SkyVolumePass {
  public:
    /// Of all textures that it keeps.
    static constexpr std::size_t most_bytes = std::size_t{32} << 20;
    explicit SkyVolumePass(ShaderLibrary& shaders);

    /// Adds "sky_volume/level_0" … "_2", or says why not, and fills frame.sky_level and sky_cells. Without casters
    /// one cell holds the open sky. `sky` is unchanged as long as `sky_key` is.
    TextureRef add(FrameContext& frame, TextureRef sky, std::uint64_t sky_key);
    void bind() const;  ///< at UNIT_AMBIENT

  private:
    struct Place {
        glm::vec3 low{0};  ///< centre of the first cell, m
        float cell = 1;    ///< m
        friend bool operator==(const Place&, const Place&) = default;
    };
    struct Level {
        Place place;                  ///< where it is wanted
        Place shown;                  ///< of what the volume holds
        std::uint64_t key = 0;        ///< of what is wanted
        std::uint64_t shown_key = 0;  ///< 0: the volume holds nothing yet
    };
    void release(FrameContext& frame, const char* reason);
    void place_levels(const FrameContext& frame);
    void resize(int directions);
    void fill_frame(FrameContext& frame) const;
    void read_sky(GLuint cube, std::uint64_t key);
    void begin(const FrameContext& frame, const Level& level);
    void gather(const FrameContext& frame, const Level& level, int first, int count);
    void spread(int level, float scale) const;

    ShaderLibrary& shaders_;
    ShadowDepth depth_;
    gl::Sampler compare_;
    int directions_ = 0;
    std::vector<SkyPart> sky_;   ///< a part for each direction
    std::uint64_t sky_key_ = 0;  ///< of the sky that those are of
    glm::ivec3 cells_{0};
    int level_count_ = 0;
    std::array<Level, SKY_LEVELS> levels_;
    int building_ = -1;  ///< the level whose sums are being gathered
    std::uint64_t building_key_ = 0;
    int gathered_ = 0;  ///< directions in the sums
    gl::Texture volume_, sums_, links_, maps_;
    std::vector<gl::Framebuffer> map_framebuffers_;  ///< of the layers of maps_
    gl::Buffer direction_buffer_;
    DrawList draws_;
};

}  // namespace tyndall
