#include "volumetrics/frame.h"

#include <algorithm>
#include <optional>

#include "engine/core/error.h"
#include "engine/gl/vertex_array.h"
#include "frame/bound_sources.h"
#include "frame/resources.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/lights.h"
#include "techniques/froxel_fog.h"
#include "volumetrics/volumetrics.h"

namespace tyndall::volumetrics {
namespace {

void bind_image(GLuint unit, const gl::TextureView& texture) {
    const bool layered = texture.desc.kind != gl::TextureKind::d2;
    glBindImageTexture(unit, texture.id, 0, layered ? GL_TRUE : GL_FALSE, 0, GL_READ_WRITE, texture.desc.format);
}

/// What a pass needs once the frame that added it is gone.
struct Running {
    const gl::Program& program;
    Resources& resources;
    std::uint64_t prepared;  ///< Resources::prepared when it was added
    std::vector<Pass::Source> sources;
    std::vector<TextureRef> images;
    Fog fog;
    bool draws, host_size, light_volumes, local_media;
    gl::DrawState state;
    std::function<void()> bind_lighting;
    std::function<void(const PassContext&, const gl::Program&)> set;
    glm::uvec3 groups;
    std::function<void()> draw;

    void operator()(const PassContext& context) const {
        if (prepared != resources.prepared)
            throw Error("volumetrics: passes run before the next prepare; each view has a Volumetrics of its own");
        if (bind_lighting) bind_lighting();
        if (light_volumes) resources.light_volumes.bind();
        if (local_media && resources.local_media) {
            resources.local_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
            resources.screen_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_SCREEN_MEDIA);
            resources.grids.bind();
        }
        resources.noise.bind();
        const bool other = host_size && resources.host_uniforms;
        (other ? resources.host_uniforms : resources.uniforms).bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
        if (fog) bind_fog_textures(context, fog);
        const BoundSources bound(context, sources, resources);
        for (GLuint unit = 0; unit < images.size(); ++unit)
            if (images[unit]) bind_image(unit, context.texture(images[unit]));
        if (draws) {
            gl::apply(state);
            context.bind_framebuffer();
        }
        if (set) set(context, program);
        program.use();
        if (draw)
            draw();
        else if (draws)
            gl::draw_fullscreen();
        else
            glDispatchCompute(groups.x, groups.y, groups.z);
    }
};

std::optional<int> standard_axis(const Frame& frame, const std::string& define) {
    if (define == "GRIDS") return frame.media.uses_grids;
    if (define == "HEIGHT_MEDIA") return height_media_axis(frame.media);
    if (define == "LOCAL_MEDIA") return !frame.media.local.empty();
    if (define == "HAS_SUN") return frame.inputs.has_sun;
    if (define == "LAMPS")
        return frame.inputs.has_lamps ? 1 + static_cast<int>(frame.settings.light.lamp_integration) : 0;
    if (define == "LIGHT_VOLUMES") return frame.resources.light_volumes.axis();
    if (define == "GLASS") return frame.media.glass;
    if (define == "CHROMATIC") return frame.media.chromatic;
    if (define == "COUNT_WORK") return frame.inputs.count_work;
    return std::nullopt;
}

/// One program serves many frames with glass, see is_glass_permutation.
void make_glass_permutation(Permutation& p) {
    const auto lit = [&](const char* define) { return p.contains(define) && p[define] != 0; };
    const bool told = p.contains("HAS_SUN") || p.contains("LAMPS");
    if (told && !lit("HAS_SUN")) p["GLASS"] &= ~GLASS_SUN;
    if (told && !lit("LAMPS")) p["GLASS"] &= ~GLASS_LAMPS;
    if (p["GLASS"] == 0) return;
    if (lit("HAS_SUN") && p["GLASS"] == GLASS_LAMPS) p["GLASS"] |= GLASS_SUN;
    const auto at_least = [&](const char* define, int value) {
        if (p.contains(define)) p[define] = std::max(p[define], value);
    };
    at_least("HEIGHT_MEDIA", MAX_HEIGHT_MEDIA);
    at_least("LOCAL_MEDIA", 1);
    at_least("LIGHT_VOLUMES", 1);
}

}  // namespace

TextureRef Frame::create(const std::string& name, GLenum format) const {
    return passes.create(name, {.format = format, .size = {size, 1}});
}

Estimate Frame::create_estimate(glm::ivec2 pixels) const {
    const gl::TextureDesc desc{.format = GL_RGBA16F, .size = {pixels, 1}};
    Estimate estimate;
    estimate.scattering = passes.create("volumetrics/scattering", desc);
    if (media.chromatic) estimate.transmittance = passes.create("volumetrics/transmittance", desc);
    return estimate;
}

const gl::Program& Frame::program(const ProgramDesc& desc, const Permutation& own) const {
    Permutation permutation = own;
    for (const PermutationAxis& axis : desc.axes)
        if (!own.contains(axis.define))
            if (const std::optional<int> value = standard_axis(*this, axis.define))
                permutation[axis.define] = *value;
    if (permutation.contains("GRIDS")) {
        if (permutation.contains("LOCAL_MEDIA")) permutation["GRIDS"] &= int(permutation["LOCAL_MEDIA"] > 0);
        if (permutation["GRIDS"] != 0 && permutation.contains("HEIGHT_MEDIA"))
            permutation["HEIGHT_MEDIA"] = MAX_HEIGHT_MEDIA;
    }
    if (permutation.contains("GLASS")) make_glass_permutation(permutation);
    return shaders.get(desc, permutation);
}

bool Frame::has_light() const {
    return inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
}

void Frame::add(const Pass& pass) {
    const bool lit = pass.lit && has_light();
    Running running{.program = pass.program,
                    .resources = resources,
                    .prepared = resources.prepared,
                    .sources = pass.sources,
                    .images = {},
                    .fog = pass.fog,
                    .draws = !pass.targets.empty() || pass.depth_target != nullptr,
                    .host_size = pass.host_size,
                    .light_volumes = pass.light_volumes,
                    .local_media = pass.local_media,
                    .state = pass.state,
                    .bind_lighting = lit ? inputs.bind_lighting : nullptr,
                    .set = pass.set,
                    .groups = pass.groups,
                    .draw = pass.draw};
    const auto declare = [&](PassBuilder& builder) {
        for (const Pass::Source& source : pass.sources) builder.sample(source.texture);
        if (lit) {
            for (const TextureRef texture : inputs.light_textures) builder.sample(texture);
            for (const BufferRef buffer : inputs.light_buffers) builder.read(buffer);
        }
        if (pass.light_volumes) resources.light_volumes.sample(builder);
        for (const BufferRef buffer : pass.buffers) builder.read(buffer);
        if (pass.fog) Volumetrics::sample_fog(builder, pass.fog);
        for (BufferRef* buffer : pass.written) *buffer = builder.write(*buffer);
        for (TextureRef* target : pass.targets)
            if (*target) *target = builder.attach_color(*target);
        for (const auto& [texture, read] : pass.images)
            if (*texture) *texture = read ? builder.storage_read_write(*texture) : builder.storage_write(*texture);
        if (pass.depth_target) *pass.depth_target = builder.attach_depth(*pass.depth_target);
        if (pass.depth_test) builder.attach_depth_read_only(pass.depth_test);
    };
    // A pass that runs finds its textures by index, whatever their version.
    for (const Pass::Image& image : pass.images) running.images.push_back(*image.texture);
    passes.add(pass.name, declare, std::move(running));
}

}  // namespace tyndall::volumetrics
