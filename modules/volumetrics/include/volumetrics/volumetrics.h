#pragma once

#include <memory>

#include "engine/shader/shader_library.h"
#include "volumetrics/inputs.h"
#include "volumetrics/outputs.h"
#include "volumetrics/settings.h"

namespace tyndall::volumetrics {

/// Light in participating media for an OpenGL 4.5 renderer. One object per view.
///
///     volumetrics.prepare(inputs, settings);
///     Outputs out = volumetrics.add_passes(passes, inputs, settings);
///     color = volumetrics.composite(passes, out, color);
///
/// Adds only the passes that the media and lights in `inputs` need; says why for the others (PassList::skip). With
/// no medium it adds nothing, allocates nothing and returns empty outputs.
class Volumetrics {
  public:
    explicit Volumetrics(ShaderLibrary& shaders);
    ~Volumetrics();
    Volumetrics(const Volumetrics&) = delete;
    Volumetrics& operator=(const Volumetrics&) = delete;

    /// Adds the passes that find out how much light local media leave on its way: before add_passes and before the
    /// host's lighting pass, which samples the volumes. A host that does not attenuate the light of surfaces need
    /// not call it: add_passes then does. Throws Error without a `prepare` before it.
    LightTransmittance add_light_passes(PassList& passes, const Inputs& inputs, const Settings& settings);
    /// Once after each `prepare`, with the same inputs. Throws Error otherwise, for textures that are not of
    /// `passes` in their newest version, and for such of another size than Inputs::size or of a format that is not
    /// read.
    [[nodiscard]] Outputs add_passes(PassList& passes, const Inputs& inputs, const Settings& settings);
    /// Applies the result to `color` (RGBA16F or RGBA32F of Inputs::size, linear radiance; Error otherwise), in
    /// place; returns its new version (the same ref when there is nothing to apply).
    [[nodiscard]] TextureRef composite(PassList& passes, const Outputs& outputs, TextureRef color);

    /// Declares what shaders/volumetrics/frame/apply.glsl samples, in a host's pass that draws with it over the
    /// composite.
    static void sample_fog(PassBuilder& builder, const Fog& fog);
    /// Binds it, and the uniform block, while that pass runs. The host's lights are bound as in its lighting pass.
    void bind_fog(const PassContext& context, const Fog& fog) const;

    /// Binds the uniform block at BINDING_VOLUMETRICS and the light volumes of add_light_passes, for host shaders
    /// that attenuate surface light with shaders/volumetrics/light/light_transmittance.glsl. Valid from `prepare`
    /// on.
    void bind_uniforms() const;
    /// Uploads this frame's uniforms and media; called before add_passes, and before the host's lighting pass runs.
    /// Passes run with what the last call uploaded: those added before it throw Error when they run. Where there is
    /// a medium and a technique, throws Error for a camera, size, depth or sun that cannot be, more height media or
    /// grids than there is room for, and files that are missing.
    void prepare(const Inputs& inputs, const Settings& settings);

    /// The view jumps (a camera cut): nothing of earlier frames shows in the next. What does not depend on the
    /// view, as the light volumes, stays.
    void forget_history();

    /// Bytes held between frames (history, tables), without the pass list's transient textures.
    [[nodiscard]] std::size_t persistent_bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace tyndall::volumetrics
