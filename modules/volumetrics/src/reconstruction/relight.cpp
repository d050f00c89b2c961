#include "reconstruction/relight.h"

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/relight",
                          .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/relight.frag"}},
                          .axes = {{"SUN", {0, 1}}, {"LAMPS", {0, 1}}, {"COUNT_WORK", {0, 1}}},
                          .valid = [](const Permutation& p) { return p.at("SUN") + p.at("LAMPS") > 0; }};
const ProgramRegistry::Registration registration(program);

}  // namespace

const char* reason_for_light(const Settings& settings) {
    const bool temporal = settings.temporal != Temporal::off && settings.temporal_place == TemporalPlace::before;
    if (settings.reconstruct == Reconstruct::light) return "reconstruct is light";
    return settings.filter == Filter::none && !temporal ? "nothing filters visibility" : nullptr;
}

const char* reason_for_light(const Inputs& inputs, const Settings& settings, const FrameMedia& media) {
    if (const char* reason = reason_for_light(settings)) return reason;
    if (!inputs.has_sun && !inputs.has_lamps) return "no sun and no lamps";
    if (inputs.has_lamps && settings.lamp_integration == LampIntegration::center)
        return "lamp_integration is center: unshadowed light is noisy, too";
    if (!media.local.empty() && media.chromatic) return "local media in view and extinction is coloured";
    return nullptr;
}

Outputs noisy_part(const MarchedLight& marched) {
    if (!marched.sun && !marched.lamps) return marched.rest;
    Outputs noisy;
    noisy.scattering = marched.sun ? marched.sun.share : marched.lamps.share;
    if (marched.sun) noisy.transmittance = marched.lamps.share;
    return noisy;
}

Outputs add_relight(PassList& passes, const PassResources& resources, const MarchedLight& marched,
                    const Outputs& filtered, bool count_work) {
    const TextureRef rest = marched.rest.scattering;
    const bool sun = static_cast<bool>(marched.sun), lamps = static_cast<bool>(marched.lamps);
    const TextureRef sun_share = sun ? filtered.scattering : TextureRef{};
    const TextureRef lamp_share = !lamps ? TextureRef{} : sun ? filtered.transmittance : filtered.scattering;
    Outputs lit;
    lit.scattering = passes.create("volumetrics/relight/scattering", passes.desc(rest));
    lit.transmittance = marched.rest.transmittance;
    const gl::Program& shader =
        resources.shaders.get(program, {{"SUN", sun}, {"LAMPS", lamps}, {"COUNT_WORK", count_work}});
    passes.add(
        "volumetrics/relight",
        [&](PassBuilder& builder) {
            for (TextureRef texture : {rest, marched.sun.light, sun_share, marched.lamps.light, lamp_share})
                builder.sample(texture);
            lit.scattering = builder.attach_color(lit.scattering);
        },
        [rest, sun_light = marched.sun.light, sun_share, lamp_light = marched.lamps.light, lamp_share, &shader,
         &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            const BoundTextures bound{{texture(rest), resources.nearest},
                                      {texture(sun_light), resources.nearest},
                                      {texture(sun_share), resources.nearest},
                                      {texture(lamp_light), resources.nearest},
                                      {texture(lamp_share), resources.nearest}};
            shader.use();
            gl::draw_fullscreen();
        });
    return lit;
}

}  // namespace tyndall::volumetrics
