#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/state.h"
#include "engine/graph/pass_list.h"
#include "engine/shader/shader_library.h"
#include "volumetrics/estimate.h"
#include "volumetrics/inputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

struct FrameMedia;
struct Resources;

/// A pass as techniques and reconstruction add it: Frame::add declares what it uses, binds it, and draws or
/// dispatches. The uniform block and what noise_offset.glsl reads are always bound.
struct Pass {
    struct Source {
        TextureRef texture;
        bool linear = false;  ///< filtered, else nearest
    };
    struct Image {
        TextureRef* texture;
        bool read = false;  ///< what was in it before the pass matters
    };
    std::string name;
    const gl::Program& program;
    std::vector<Source> sources = {};     ///< on texture units 0, 1, 2 …; an empty one leaves its unit as it is
    std::vector<BufferRef> buffers = {};  ///< that it reads
    Fog fog = {};                         ///< that it reads by shaders/volumetrics/frame/apply.glsl
    std::vector<TextureRef*> targets =
        {};                                ///< it draws to, in order; each becomes its new version; empty: left out
    std::vector<Image> images = {};        ///< on image units 0, 1, 2 …, likewise
    std::vector<BufferRef*> written = {};  ///< storage buffers that it writes, likewise
    TextureRef depth_test = {};            ///< a depth buffer, which hides what is drawn
    TextureRef* depth_target = nullptr;    ///< a depth buffer that it draws to
    bool host_size = false;                ///< it draws at the host's size, whatever Frame::size is
    bool lit = false;                      ///< reads shaders/interface/{lights,shadows}.glsl
    bool light_volumes = false;            ///< reads what local media leave of light on its way
    bool local_media = false;              ///< reads shaders/volumetrics/media/{local,ray}_media.glsl
    gl::DrawState state = {};
    /// Uniforms, buffers and clears of its own, before it draws.
    std::function<void(const PassContext&, const gl::Program&)> set = {};
    glm::ivec3 groups{0};             ///< work groups of a compute program
    std::function<void()> draw = {};  ///< instead of a triangle that covers the target, or of one dispatch
};

/// What a technique keeps from frame to frame; freed when another one is chosen.
struct Kept {
    virtual ~Kept() = default;
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// One frame, as a technique adds its passes to it.
class Frame {
  public:
    PassList& passes;
    ShaderLibrary& shaders;
    const Inputs& inputs;  ///< at the host's resolution
    const Settings& settings;
    const FrameMedia& media;  ///< what the inputs' media come to (src/media/media.h)
    Resources& resources;     ///< of the module (src/frame/resources.h)
    std::unique_ptr<Kept>& kept_by_technique;
    glm::ivec2 size{0};  ///< px that the technique draws to, by the setting resolution
    TextureRef depth;    ///< of that size: the host's, or R32F (depth_downsample.frag)

    /// A texture of `size` that lives within the frame.
    [[nodiscard]] TextureRef create(const std::string& name, GLenum format = GL_RGBA16F) const;
    /// Scattering and, where extinction is coloured, transmittance: targets of `size`, or of the host's.
    [[nodiscard]] Estimate create_estimate() const { return create_estimate(size); }
    [[nodiscard]] Estimate create_host_estimate() const { return create_estimate(inputs.size); }
    /// Of the axes that frames of all techniques have (GRIDS, HEIGHT_MEDIA, LOCAL_MEDIA, HAS_SUN, LAMPS,
    /// LIGHT_VOLUMES, GLASS, CHROMATIC, COUNT_WORK) those that `desc` declares need not be given: they follow from
    /// the frame.
    [[nodiscard]] const gl::Program& program(const ProgramDesc& desc, const Permutation& own = {}) const;
    /// A sun, lamps or ambient light.
    [[nodiscard]] bool has_light() const;
    void add(const Pass& pass);
    void skip(const std::string& pass, const std::string& reason) { passes.skip(pass, reason); }

    /// The technique's T, made at its first use. T is Kept; one type a technique.
    template <class T>
    [[nodiscard]] T& kept() {
        if (dynamic_cast<T*>(kept_by_technique.get()) == nullptr) kept_by_technique = std::make_unique<T>();
        return static_cast<T&>(*kept_by_technique);
    }

  private:
    [[nodiscard]] Estimate create_estimate(glm::ivec2 pixels) const;
};

}  // namespace tyndall::volumetrics
