#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/gl/buffer.h"
#include "engine/gl/texture.h"
#include "engine/graph/pass_list.h"
#include "engine/shader/shader_library.h"
#include "media/media.h"

namespace tyndall::volumetrics {

/// Optical depth of the local media from a light to each point of a 3D texture, linearly filtered: R16F, RGBA16F
/// where extinction is coloured (shaders read rgb of both). x and y lie across the light's rays, z along them.
[[nodiscard]] gl::Texture light_volume_texture(glm::ivec3 size, bool chromatic, const char* label);

/// A part of such a texture that holds the rays of one light.
struct LightRays {
    glm::ivec3 origin{0}, size{0};                    ///< texels
    glm::mat4 volume_to_world{1};                     ///< sun: from texture coordinates
    glm::vec3 lamp{0};                                ///< m
    glm::vec4 window{0};                              ///< lamp: see shaders/volumetrics/light/light_volume.glsl
    std::uint32_t first_medium = 0, media_count = 0;  ///< of those that dim light
    float begin = 0, end = 0;  ///< lamp: distances (m) of the first and the last texel; both 0 for the sun
    [[nodiscard]] bool of_lamp() const { return end > 0; }
};

/// What dims the light.
struct DimmingMedia {
    std::span<const shared::LocalMedium> all;
    const gl::Buffer& buffer;  ///< that holds them
    bool has_grids;
    const GridAtlas& grids;
};

/// The texels of a light's part whose slabs the medium may reach, never too few.
[[nodiscard]] IndexBox dimmed_texels(const LightRays& rays, const shared::LocalMedium& medium);

/// Fills parts of a volume by shaders/volumetrics/light/light_volume_slabs.comp and light_volume_sum.comp.
void fill_light_volume(ShaderLibrary& shaders, bool count_work, const gl::Texture& volume,
                       const DimmingMedia& media, std::span<const LightRays> rays);

/// The volume of the sun: a box along its rays round all local media that dim it, but for density grids. It is kept
/// until those or the sun change.
class SunVolume {
  public:
    void prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media);
    void release() { *this = {}; }
    [[nodiscard]] const gl::Texture& texture() const { return texture_; }
    [[nodiscard]] bool stale() const { return stale_; }
    void fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media);

  private:
    gl::Texture texture_;
    std::vector<shared::LocalMedium> media_;  ///< it was last prepared for
    glm::vec3 direction_{0};
    glm::mat4 world_to_volume_{1};
    LightRays rays_;
    bool stale_ = true;
};

/// The media that dim light, which LightVolumes has ordered: those that are no density grids, then those that are.
[[nodiscard]] std::span<const AttenuatingMedium> dimming_shapes(const FrameMedia& media);
[[nodiscard]] std::span<const AttenuatingMedium> dimming_grids(const FrameMedia& media);

/// Two unit directions across light, and its own.
[[nodiscard]] glm::dmat3 sun_axes(glm::dvec3 direction);

/// World to texture coordinates of a box along the sun's rays round media: across them the outermost texels lie
/// outside of all media, so that clamping there gives 0; along them the centre of the first texel is where light
/// enters the box and that of the last where it leaves.
[[nodiscard]] glm::dmat4 world_to_sun_box(std::span<const AttenuatingMedium> media, glm::dvec3 direction,
                                          glm::ivec3 size);

/// The sun's light through density grids: a part of one volume for each, as fine as its voxels, or as
/// grid_volume_size lets it be. Made anew where a grid is turned or scaled or the sun moves; a grid that drifts
/// takes its part along.
class GridSunVolumes {
  public:
    /// Throws Error for more than MAX_GRIDS. Where no grid matters in this frame it keeps what it has.
    void prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media);
    void release() { *this = {}; }
    [[nodiscard]] bool active() const { return active_; }  ///< in this frame
    [[nodiscard]] const gl::Texture& texture() const { return texture_; }
    [[nodiscard]] bool stale() const;
    void fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media);

  private:
    struct Part {
        std::shared_ptr<const DensityGrid> grid;
        glm::mat3 world_to_voxel{0};
        bool nearest = false;
        glm::vec3 direction{0};
        glm::ivec3 origin{0}, size{0};
        friend bool operator==(const Part&, const Part&) = default;
    };
    gl::Texture texture_;
    std::vector<Part> parts_;
    std::vector<LightRays> rays_;
    std::vector<bool> fresh_;  ///< of each part
    bool active_ = false;
};

/// The volumes of lamps, tiles of one atlas: directions, all or those towards the local media in range, with a
/// border of one texel, times distances from the nearest to the farthest of these media. Each is kept until its
/// lamp or those media change. Where lamps are more than the setting lamp_volume_count, those whose range ends
/// nearest to the eye come first.
class LampVolumes {
  public:
    void prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media);
    void release() { *this = {}; }
    [[nodiscard]] const gl::Texture& texture() const { return texture_; }
    [[nodiscard]] const gl::Buffer& table() const { return table_; }  ///< see light_transmittance.glsl
    [[nodiscard]] bool stale() const;
    [[nodiscard]] std::size_t left_out() const { return left_out_; }  ///< lamps that the limit leaves without
    void fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media);

  private:
    struct Slot {
        std::uint64_t key = 0;
        LightRays rays;
        bool used = false, stale = true;
    };
    struct Wanted;
    void allocate(std::size_t count, int directions, bool chromatic);
    Slot& slot_for(const Wanted& wanted);

    gl::Texture texture_;
    gl::Buffer table_;
    std::vector<Slot> slots_;
    std::vector<glm::vec4> entries_;  ///< of the table, two for each light
    std::size_t left_out_ = 0;
    std::uint32_t media_count_ = 0;
};

/// All of them, and what passes that sample them need.
class LightVolumes {
  public:
    /// Before the uniforms are uploaded: writes the volumes' places into media.data.
    void prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media);
    /// Adds the passes for what changed; says why for the others.
    void add_passes(PassList& passes, ShaderLibrary& shaders, const Inputs& inputs, const GridAtlas& grids);
    void release() { *this = {}; }

    /// Whether any light is dimmed by local media.
    [[nodiscard]] bool any() const { return sun_.texture() || grid_suns_.active() || lamps_.texture(); }
    /// Value of the axis LIGHT_VOLUMES.
    [[nodiscard]] int axis() const { return grid_suns_.active() ? 2 : any() ? 1 : 0; }
    [[nodiscard]] TextureRef sun() const { return sun_ref_; }
    [[nodiscard]] TextureRef grid_suns() const { return grid_suns_ref_; }
    [[nodiscard]] TextureRef lamps() const { return lamps_ref_; }
    void sample(PassBuilder& builder) const;
    /// In place of one that there is not a volume of nothing.
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    void release_volumes(const FrameMedia& media);

    SunVolume sun_;
    GridSunVolumes grid_suns_;
    LampVolumes lamps_;
    gl::Buffer media_;
    std::vector<shared::LocalMedium> uploaded_;
    gl::Texture nothing_;
    gl::Buffer no_lamps_;
    TextureRef sun_ref_, grid_suns_ref_, lamps_ref_;
};

/// Whether a combination of the axes LIGHT_VOLUMES, HAS_SUN and LAMPS can occur: without light there is none to
/// dim.
[[nodiscard]] bool is_light_volume_permutation(const Permutation& permutation);

}  // namespace tyndall::volumetrics
