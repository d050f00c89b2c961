#include <algorithm>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/reconstruction.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/sprites.h"

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
                                   {"LIGHT_VOLUMES", {0, 1}},
                                   {"CHROMATIC", {0, 1}},
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = is_light_volume_permutation};
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
            glsl::FROXEL_LOGARITHMIC, static_cast<float>(layer) / static_cast<float>(settings.billboard_layers),
            settings.max_distance / 32, settings.max_distance);
    };
    for (int layer = 0; layer < settings.billboard_layers; ++layer)
        sprites.push_back({whole_screen, {depth(layer), depth(layer + 1), BILLBOARD_GLOBAL, 0}});
    sprites.push_back({whole_screen, {depth(settings.billboard_layers), endless, BILLBOARD_HORIZON, 0}});
}

/// Nearest and farthest view depth [m] of a shape; the nearest is not behind the eye.
glm::vec2 depths_of(const shared::LocalMedium& medium, const glm::mat4& view) {
    const glm::vec3 center = glm::vec3(glm::inverse(medium.world_to_shape)[3]);
    const glm::vec3 forward = glm::mat3(medium.world_to_shape) * -glm::vec3(view[0][2], view[1][2], view[2][2]);
    const glm::vec3 reach = forward * glm::vec3(medium.extent_softness);
    const bool box = static_cast<int>(medium.sigma_a_shape.w) == SHAPE_BOX;
    const float half = box ? glm::dot(glm::abs(reach), glm::vec3(1)) : glm::length(reach);
    const float middle = -(view * glm::vec4(center, 1)).z;
    return {std::max(middle - half, 0.0F), middle + half};
}

void add_local(const Inputs& inputs, const Settings& settings, const FrameMedia& media,
               std::vector<shared::Billboard>& sprites) {
    const glm::vec2 froxels{settings.froxels_x, settings.froxels_y};
    for (std::size_t i = 0; i < media.local.size(); ++i) {
        const glm::vec2 depths = depths_of(media.local[i], inputs.view);
        if (depths.x >= depths.y) continue;
        const IndexBox& box = media.local_froxels[i];
        const glm::vec4 rect{2.0F * glm::vec2(box.lower) / froxels - 1.0F,
                             2.0F * glm::vec2(box.upper) / froxels - 1.0F};
        const auto depth = [&](int layer) {
            return glm::mix(depths.x, depths.y,
                            static_cast<float>(layer) / static_cast<float>(settings.billboard_local_layers));
        };
        for (int layer = 0; layer < settings.billboard_local_layers; ++layer)
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

Layers add_draw(PassList& passes, const PassResources& resources, const Inputs& inputs, const Settings& settings,
                const FrameMedia& media, GLsizei count) {
    Layers layers;
    for (const char* name :
         {"volumetrics/billboards_red", "volumetrics/billboards_green", "volumetrics/billboards_blue"})
        if (layers.empty() || media.chromatic)
            layers.push_back(passes.create(name, {.format = GL_RGBA32F, .size = {inputs.size, 1}}));
    const gl::Program& shader = resources.shaders.get(program, {{"HEIGHT_MEDIA", height_media_axis(media)},
                                                                {"HAS_SUN", inputs.has_sun},
                                                                {"LAMPS", inputs.has_lamps},
                                                                {"LIGHT_VOLUMES", resources.light_volumes.any()},
                                                                {"CHROMATIC", media.chromatic},
                                                                {"COUNT_WORK", inputs.count_work}});
    const bool lit = inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
    const bool hides = is_depth_buffer(passes, inputs);
    passes.add(
        "volumetrics/billboards",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            resources.light_volumes.sample(builder);
            for (TextureRef& layer : layers) layer = builder.attach_color(layer);
            if (hides) builder.attach_depth_read_only(inputs.depth);
        },
        [hides, depth = inputs.depth, targets = static_cast<GLint>(layers.size()), count,
         bind_lighting = lit ? inputs.bind_lighting : nullptr, fade = settings.billboard_fade, &shader,
         &resources](const PassContext& context) {
            gl::apply({.depth_test = hides, .blend = gl::Blend::premultiplied});
            context.bind_framebuffer();
            const glm::vec4 nothing{0, 0, 0, 1};
            for (GLint target = 0; target < targets; ++target) glClearBufferfv(GL_COLOR, target, &nothing.x);
            if (bind_lighting) bind_lighting();
            resources.light_volumes.bind();
            resources.noise.bind();
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            resources.sprites.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SPRITES);
            if (resources.local_media) resources.local_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
            shader.set("fade", fade);
            shader.use();
            const gl::VertexArray empty("billboards");
            empty.bind();
            glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
            glBindVertexArray(0);
        });
    return layers;
}

Outputs add_resolve(PassList& passes, const PassResources& resources, const Inputs& inputs, const Layers& layers) {
    const bool chromatic = layers.size() > 1;
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {inputs.size, 1}};
    Outputs outputs;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    if (chromatic) outputs.transmittance = passes.create("volumetrics/transmittance", desc);
    const gl::Program& shader =
        resources.shaders.get(resolve_program, {{"CHROMATIC", chromatic}, {"COUNT_WORK", inputs.count_work}});
    passes.add(
        "volumetrics/billboards_resolve",
        [&](PassBuilder& builder) {
            for (const TextureRef layer : layers) builder.sample(layer);
            outputs.scattering = builder.attach_color(outputs.scattering);
            if (chromatic) outputs.transmittance = builder.attach_color(outputs.transmittance);
        },
        [layers, &shader, &resources](const PassContext& context) {
            gl::apply({});
            context.bind_framebuffer();
            const auto layer = [&](std::size_t i) {
                return context.texture(layers[std::min(i, layers.size() - 1)]);
            };
            const BoundTextures bound{
                {layer(0), resources.nearest}, {layer(1), resources.nearest}, {layer(2), resources.nearest}};
            shader.use();
            gl::draw_fullscreen();
        });
    return outputs;
}

}  // namespace

Outputs add_billboards(PassList& passes, PassResources& resources, const Inputs& inputs, const Settings& settings,
                       const FrameMedia& media) {
    const std::vector<shared::Billboard> sprites = sorted_billboards(inputs, settings, media);
    resources.sprites.assign(std::span<const shared::Billboard>(sprites), "volumetrics billboards");
    const Layers layers =
        add_draw(passes, resources, inputs, settings, media, static_cast<GLsizei>(sprites.size()));
    return add_resolve(passes, resources, inputs, layers);
}

}  // namespace tyndall::volumetrics
