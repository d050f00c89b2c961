#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/relight.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

bool is_valid(const Permutation& p) {
    const int local = p.at("LOCAL_MEDIA");
    const bool lit = p.at("HAS_SUN") + p.at("LAMPS") > 0;
    if (local == 1 && !lit) return false;
    if (local == 0 && lit && p.at("HEIGHT_MEDIA") > 1) return false;  // see local_media_axis
    if (p.at("VISIBILITY") == 0) return true;
    if (p.at("LAMPS") == 1 || (p.at("LAMPS") == 0 && p.at("HAS_SUN") == 0)) return false;
    return local != 2 || p.at("CHROMATIC") == 0;
}

const ProgramDesc program{.name = "volumetrics/march",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/view_ray.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/ray_march.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"LOCAL_MEDIA", {0, 1, 2}},  // 1: they only dim light, 2: in view
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1, 2}},  // 1 + LampIntegration
                                   {"CHROMATIC", {0, 1}},
                                   {"VISIBILITY", {0, 1}},  // see reason_for_light
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_valid};
const ProgramRegistry::Registration registration(program);

/// Several height media are rare and slow: lit ones have no program of their own without light volumes.
int local_media_axis(const Inputs& inputs, const FrameMedia& media, const LightVolumes& volumes) {
    if (!media.local.empty()) return 2;
    const bool lit = inputs.has_sun || inputs.has_lamps;
    return volumes.any() || (lit && height_media_axis(media) > 1) ? 1 : 0;
}

Permutation permutation(const Inputs& inputs, const Settings& settings, const FrameMedia& media,
                        const LightVolumes& volumes, bool visibility) {
    const int lamps = 1 + static_cast<int>(settings.lamp_integration);
    return {{"HEIGHT_MEDIA", height_media_axis(media)},
            {"LOCAL_MEDIA", local_media_axis(inputs, media, volumes)},
            {"HAS_SUN", inputs.has_sun},
            {"LAMPS", inputs.has_lamps ? lamps : 0},
            {"CHROMATIC", media.chromatic},
            {"VISIBILITY", visibility},
            {"COUNT_WORK", inputs.count_work}};
}

Relit create_relit(PassList& passes, const std::string& name, const gl::TextureDesc& desc) {
    return {passes.create("volumetrics/" + name, desc), passes.create("volumetrics/" + name + "_share", desc)};
}

}  // namespace

MarchedLight add_march(PassList& passes, const PassResources& resources, const Inputs& inputs,
                       const Settings& settings, const FrameMedia& media, const FroxelMedia& froxels) {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    MarchedLight marched;
    Outputs& outputs = marched.rest;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);

    const char* whole = reason_for_light(inputs, settings, media);
    if (whole) passes.skip("volumetrics/relight", whole);
    if (!whole && inputs.has_sun) marched.sun = create_relit(passes, "sun", desc);
    if (!whole && inputs.has_lamps) marched.lamps = create_relit(passes, "lamps", desc);

    const gl::Program& shader =
        resources.shaders.get(program, permutation(inputs, settings, media, resources.light_volumes, !whole));
    const bool lit = inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
    passes.add(
        "volumetrics/march",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            builder.sample(froxels.scattering);
            builder.sample(froxels.extinction);
            builder.sample(froxels.emission);
            builder.sample(froxels.runs);
            resources.light_volumes.sample(builder);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (outputs.transmittance) outputs.transmittance = builder.attach_color(outputs.transmittance);
            for (TextureRef* ref :
                 {&marched.sun.light, &marched.sun.share, &marched.lamps.light, &marched.lamps.share})
                if (*ref) *ref = builder.attach_color(*ref);
        },
        [froxels, depth = inputs.depth, bind_lighting = lit ? inputs.bind_lighting : nullptr, &shader,
         &resources](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{
                {texture(depth), resources.nearest},
                {texture(froxels.scattering), resources.linear},
                {texture(froxels.extinction), resources.linear},
                {texture(froxels.emission ? froxels.emission : froxels.scattering), resources.linear},
                {texture(froxels.runs), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.light_volumes.bind();
            resources.noise.bind();
            shader.use();
            gl::draw_fullscreen();
        });
    return marched;
}

}  // namespace tyndall::volumetrics
