#include <algorithm>

#include "frame/resources.h"
#include "media/shape.h"
#include "reconstruction/reconstruction.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sprites.h"
#include "techniques/sprites.h"
#include "techniques/techniques.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/froxel.glsl"
TYNDALL_GLSL_END

// See shaders/volumetrics/techniques/billboards.frag.
namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/billboards",
                          .stages = {{GL_VERTEX_SHADER, "shaders/volumetrics/techniques/billboards.vert"},
                                     {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/billboards.frag"}},
                          .axes = {{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}},
                                   {"HAS_SUN", {0, 1}},
                                   {"LAMPS", {0, 1}},  // 1: at a point, as LampIntegration::center
                                   {"GRIDS", {0, 1}},
                                   {"LIGHT_VOLUMES", {0, 1, 2}},
                                   {"GLASS", {0, 1, 2, 3}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = [](const Permutation& p) {
                              return is_light_volume_permutation(p) && is_grid_permutation(p) &&
                                     is_glass_permutation(p);
                          }};
const ProgramDesc resolve_program{
    .name = "volumetrics/billboards_resolve",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/techniques/billboards_resolve.frag"}},
    .axes = {{"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program), resolve_registration(resolve_program);

constexpr glm::vec4 whole_screen{-1, -1, 1, 1};
/// What stands for "without end" in view depth [m].
constexpr float endless = 1e9F;

void add_sheets(const Settings& settings, std::vector<shared::Billboard>& sprites) {
    const auto depth = [&](int layer) {
        return glsl::froxel_view_depth_from_w(
            glsl::FROXEL_LOGARITHMIC, static_cast<float>(layer) / static_cast<float>(settings.billboards.layers),
            settings.march.max_distance / 32, settings.march.max_distance);
    };
    for (int layer = 0; layer < settings.billboards.layers; ++layer)
        sprites.push_back({whole_screen, {depth(layer), depth(layer + 1), BILLBOARD_GLOBAL, 0}});
    sprites.push_back({whole_screen, {depth(settings.billboards.layers), endless, BILLBOARD_HORIZON, 0}});
}

/// Nearest and farthest view depth [m] of a shape; the nearest is not behind the eye.
glm::vec2 depths_of(const shared::LocalMedium& medium, const glm::mat4& view) {
    const glm::vec3 center = glm::vec3(glm::inverse(medium.world_to_shape)[3]);
    const float half = half_extent_along(medium, -glm::vec3(view[0][2], view[1][2], view[2][2]));
    const float middle = -(view * glm::vec4(center, 1)).z;
    return {std::max(middle - half, 0.0F), middle + half};
}

void add_local(const Inputs& inputs, const Settings& settings, const FrameMedia& media,
               std::vector<shared::Billboard>& sprites) {
    for (std::size_t i = 0; i < media.local.size(); ++i) {
        const glm::vec2 depths = depths_of(media.local[i], inputs.view);
        if (depths.x >= depths.y) continue;
        const ViewBounds& bounds = media.local_bounds[i];
        const glm::vec4 rect = 2.0F * glm::clamp(glm::vec4(bounds.lower, bounds.upper), -1.0F, 2.0F) - 1.0F;
        const auto depth = [&](int layer) {
            return glm::mix(depths.x, depths.y,
                            static_cast<float>(layer) / static_cast<float>(settings.billboards.local_layers));
        };
        for (int layer = 0; layer < settings.billboards.local_layers; ++layer)
            sprites.push_back({rect, {depth(layer), depth(layer + 1), static_cast<float>(i), 0}});
    }
}

/// From the far to the near one, by the middle of the slab.
std::vector<shared::Billboard> sorted_billboards(const Inputs& inputs, const Settings& settings,
                                                 const FrameMedia& media) {
    std::vector<shared::Billboard> sprites;
    if (media.has_global) add_sheets(settings, sprites);
    add_local(inputs, settings, media, sprites);
    std::ranges::stable_sort(sprites, std::ranges::greater(),
                             [](const shared::Billboard& b) { return b.slab.x + b.slab.y; });
    return sprites;
}

/// One texture for each channel that is blended by a transmittance of its own.
using Layers = std::vector<TextureRef>;

Layers add_draw(Frame& frame, const gl::Buffer& sprites, GLsizei count) {
    Layers layers;
    for (const char* name :
         {"volumetrics/billboards_red", "volumetrics/billboards_green", "volumetrics/billboards_blue"})
        if (layers.empty() || frame.media.chromatic) layers.push_back(frame.create(name, GL_RGBA32F));
    std::vector<TextureRef*> targets;
    for (TextureRef& layer : layers) targets.push_back(&layer);
    const bool hides = is_depth_buffer(frame);
    frame.add({.name = "volumetrics/billboards",
               .program = frame.program(program, {{"LAMPS", frame.inputs.has_lamps}}),
               .sources = {{frame.depth}},
               .targets = targets,
               .depth_test = hides ? frame.depth : TextureRef{},
               .lit = true,
               .light_volumes = true,
               .local_media = true,
               .state = {.depth_test = hides, .blend = gl::Blend::premultiplied},
               .set =
                   [&sprites, targets = static_cast<GLint>(layers.size()), fade = frame.settings.billboards.fade](
                       const PassContext&, const gl::Program& shader) {
                       const glm::vec4 nothing{0, 0, 0, 1};
                       for (GLint target = 0; target < targets; ++target)
                           glClearBufferfv(GL_COLOR, target, &nothing.x);
                       sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
                       shader.set("fade", fade);
                   },
               .draw = [count] { draw_sprites(count); }});
    return layers;
}

void add_resolve(Frame& frame, const Layers& layers, Estimate& estimate) {
    const auto layer = [&](std::size_t i) { return layers[std::min(i, layers.size() - 1)]; };
    frame.add({.name = "volumetrics/billboards_resolve",
               .program = frame.program(resolve_program),
               .sources = {{layer(0)}, {layer(1)}, {layer(2)}},
               .targets = {&estimate.scattering, &estimate.transmittance}});
}

Estimate add(Frame& frame) {
    const std::vector<shared::Billboard> sorted = sorted_billboards(frame.inputs, frame.settings, frame.media);
    gl::Buffer& sprites = frame.kept<Sprites>().buffer;
    sprites.assign(std::span<const shared::Billboard>(sorted), "volumetrics billboards");
    Estimate estimate = frame.create_estimate();
    estimate.sampling = Sampling::per_pixel;
    add_resolve(frame, add_draw(frame, sprites, static_cast<GLsizei>(sorted.size())), estimate);
    return estimate;
}

}  // namespace

TechniqueDesc billboards() {
    return {.name = "billboards",
            .help = "Blends sheets of fog, one light sample each; local media in layers.",
            .settings = "billboard_",
            .passes = {"volumetrics/billboards", "volumetrics/billboards_resolve"},
            .traits = {.sampling = Sampling::per_pixel, .any_resolution = true},
            .add = add};
}

}  // namespace tyndall::volumetrics
