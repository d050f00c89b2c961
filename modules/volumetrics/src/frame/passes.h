#pragma once

#include "engine/gl/buffer.h"
#include "engine/gl/sampler.h"
#include "engine/shader/shader_library.h"
#include "light/light_volume.h"
#include "media/media.h"
#include "reconstruction/noise.h"
#include "volumetrics/outputs.h"

namespace tyndall::volumetrics {

/// Froxel volumes of the local media: RGBA16F 3D textures, see shaders/volumetrics/media/inject_media.comp.
struct FroxelMedia {
    /// Farthest view depth of each column, see froxel_columns.frag: nothing is injected behind it.
    TextureRef columns;
    TextureRef scattering, extinction, emission;  ///< emission only where some local medium emits
    TextureRef runs;  ///< RG32UI, see froxel_runs.comp; only for the march with visibility apart from light
};

class FroxelHistory;
class TemporalHistory;
struct MarchedLight;

/// What all passes of one frame share.
struct PassResources {
    ShaderLibrary& shaders;
    gl::Sampler nearest = {}, linear = {};
    gl::Buffer uniforms = {}, local_media = {}, media_tiles = {}, unfinished = {}, sprites = {};
    LightVolumes light_volumes = {};
    NoiseSource noise = {};
};

[[nodiscard]] FroxelMedia add_inject_media(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                           const Settings& settings, const FrameMedia& media);
[[nodiscard]] MarchedLight add_march(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                     const Settings& settings, const FrameMedia& media, const FroxelMedia& froxels);
/// Light and transmittance of froxels: the steps of the technique froxel before the last.
[[nodiscard]] Fog add_froxel_fog(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                 const Settings& settings, const FrameMedia& media, const FroxelMedia& froxels,
                                 FroxelHistory& history);
/// The same, interpolated at each pixel's depth of `low`, see reconstruction.h.
[[nodiscard]] Outputs add_froxel(PassList& passes, const PassResources& resources, const Inputs& inputs,
                                 const Inputs& low, const Settings& settings, const FrameMedia& media,
                                 const FroxelMedia& froxels, FroxelHistory& history);
/// The approaches that froxels are compared with. Each says in its file what it models and what it cannot.
[[nodiscard]] Outputs add_billboards(PassList& passes, PassResources& resources, const Inputs& inputs,
                                     const Settings& settings, const FrameMedia& media);
[[nodiscard]] Outputs add_particles(PassList& passes, PassResources& resources, const Inputs& inputs,
                                    const Settings& settings, const FrameMedia& media);
/// There is a global medium.
[[nodiscard]] MarchedLight add_shaft_geometry(PassList& passes, PassResources& resources, const Inputs& inputs,
                                              const Settings& settings, const FrameMedia& media);
[[nodiscard]] Outputs add_analytic_fog(PassList& passes, PassResources& resources, const Inputs& inputs,
                                       const Settings& settings, const FrameMedia& media);
/// There is a sun.
[[nodiscard]] Outputs add_radial_shafts(PassList& passes, PassResources& resources, const Inputs& inputs,
                                        const Settings& settings, const FrameMedia& media,
                                        TemporalHistory& history);
/// Value of the axis HEIGHT_MEDIA.
[[nodiscard]] int height_media_axis(const FrameMedia& media);

/// Brute force in RGBA32F; `transmittance` is always given.
[[nodiscard]] Outputs add_reference(PassList& passes, PassResources& resources, const Inputs& inputs,
                                    const Settings& settings, const FrameMedia& media);
[[nodiscard]] TextureRef add_composite(PassList& passes, const PassResources& resources, const Outputs& outputs,
                                       TextureRef color, bool count_work);

/// Textures and samplers of a pass, on units 0, 1, 2 …; unbinds the samplers when it goes, so that none outlives
/// the pass on a host's texture.
class BoundTextures {
  public:
    struct Unit {
        gl::TextureView texture;
        const gl::Sampler& sampler;
    };
    BoundTextures(std::initializer_list<Unit> units);
    ~BoundTextures();
    BoundTextures(const BoundTextures&) = delete;
    BoundTextures& operator=(const BoundTextures&) = delete;

  private:
    std::size_t count_;
};

}  // namespace tyndall::volumetrics
