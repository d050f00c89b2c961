#include "reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include "engine/core/image.h"
#include "engine/core/output_files.h"
#include "engine/render/passes/tonemap.h"
#include "engine/render/render_settings.h"
#include "sample_game/commands/commands.h"
#include "session/number_option.h"
#include "session/progress.h"
#include "session/scene_options.h"
#include "shaders/lib/glm_subset.h"
#include "volumetrics/settings.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/tonemap.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

struct ReferenceOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string output, layer = "color";
    int samples = 1, threads = 0, sky_samples = reference::Settings{}.sky_samples;
    double tolerance = reference::Settings{}.tolerance;
    bool black_surfaces = false, black_sky = false;
};

const std::map<std::string, Image reference::Picture::*> layers{
    {"color", &reference::Picture::color},
    {"scattering", &reference::Picture::scattering},
    {"transmittance", &reference::Picture::transmittance},
    {"depth", &reference::Picture::depth},
    {"error", &reference::Picture::error}};

/// What a player sees, without the dither of the engine's last pass.
Image displayed(const Image& color, float exposure) {
    Image shown(color.size, 3);
    for (int y = 0; y < color.size.y; ++y)
        for (int x = 0; x < color.size.x; ++x) {
            const float* from = color.at(x, y);
            const glm::vec3 mapped = glsl::tonemap(exposure * glm::vec3(from[0], from[1], from[2]));
            for (int i = 0; i < 3; ++i) shown.at(x, y)[i] = glsl::srgb_encode(mapped[i]);
        }
    return shown;
}

void print_error(const reference::Picture& picture) {
    double mean = 0, error = 0, most = 0;
    for (const float v : picture.scattering.pixels) mean += v;
    for (const float v : picture.error.pixels) error += v, most = std::max<double>(most, v);
    mean /= static_cast<double>(picture.scattering.pixels.size());
    error /= static_cast<double>(picture.error.pixels.size());
    if (mean > 0)
        fmt::print("scattering: mean {:.6g} cd/m²; estimated error relative to that: mean {:.2g}, max {:.2g}\n",
                   mean, error / mean, most / mean);
    else
        fmt::print("scattering: none\n");
}

void run(const ReferenceOptions& o) {
    check_picture_name("--output", o.output);
    check_outputs(std::array{NamedFile{"--output", o.output}}, o.scene.inputs());
    o.view.check();
    volumetrics::Settings volumetrics;
    RenderSettings render;
    SettingsSet settings;
    settings.add(volumetrics::settings_table(), &volumetrics);
    settings.add(render_settings_table(), &render);
    o.scene.apply(settings);
    const glm::ivec2 size = o.scene.pixels();

    Scene scene = o.scene.load();
    animate(scene, o.view.time.value_or(0));
    const View view = o.view.view(scene, size);
    if (volumetrics.technique == "off") scene.media.clear();
    const reference::Reference integrator(
        scene, {.light_transmittance = volumetrics.light.transmittance,
                .phase = {.kind = static_cast<reference::ParticlePhase::Kind>(volumetrics.light.phase),
                          .back_anisotropy = volumetrics.light.back_anisotropy,
                          .back_weight = volumetrics.light.back_weight,
                          .droplet_diameter = volumetrics.light.droplet_diameter},
                .shadows = render.shadows,
                .ambient = render.ambient,
                .sky_visibility = render.sky_visibility,
                .sky_samples = o.sky_samples,
                .black_surfaces = o.black_surfaces,
                .black_sky = o.black_sky,
                .tolerance = o.tolerance});
    reference::Picture picture;
    {
        Progress progress("reference, row", size.y);
        picture =
            reference::render(integrator, view, size, o.samples, o.threads, [&](int, int) { progress.step(); });
    }
    const bool display = o.output.ends_with(".png") && o.layer == "color";
    write_image(o.output,
                display ? displayed(picture.color, exposure_factor(scene.exposure_ev100, render.exposure_bias))
                        : picture.*layers.at(o.layer));
    print_error(picture);
}

}  // namespace

void add_reference_command(CLI::App& app) {
    auto o = std::make_shared<ReferenceOptions>();
    CLI::App* command = app.add_subcommand(
        "reference",
        "The same picture from the ground truth: double precision on the CPU, exact visibility, no GL. Of the "
        "settings, ambient, sky_visibility, light_transmittance, phase and its back "
        "lobe, shadows and exposure_bias change it, and technique=off, which leaves the media out");
    o->scene.add_to(*command, "", "640x360");
    command->add_option("-o,--output", o->output, "OUT.exr or OUT.png")->required();
    o->view.add_to(*command);
    command->add_option("--layer", o->layer, "what to write; error: the estimated error of scattering")
        ->check(CLI::IsMember(layers))
        ->capture_default_str();
    command->add_option("--samples", o->samples, "rays per pixel and axis: N x N, averaged; 1: through its centre")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    command->add_option("--threads", o->threads, "0: all processors; the picture does not depend on it")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->add_option("--tolerance", o->tolerance, "of the scattering of a ray, relative")
        ->check(number_in(1e-12, 0.1))
        ->capture_default_str();
    command
        ->add_option("--sky-samples", o->sky_samples,
                     "with sky_visibility: directions for each ray's air, and a quarter of that for each lobe of "
                     "its surface")
        ->check(CLI::Range(1024, 1 << 24))
        ->capture_default_str();
    command->add_flag("--black-surfaces", o->black_surfaces, "surfaces block and hide, and send no light");
    command->add_flag("--black-sky", o->black_sky, "nothing is seen behind the scene");
    command->callback([o] { run(*o); });
}

}  // namespace tyndall
