#include "techniques/froxel_history.h"

#include <algorithm>

#include "reconstruction/reprojection.h"
#include "shaders/shared/bindings.h"
#include "techniques/froxel_passes.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{.name = "volumetrics/froxel_history",
                          .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/froxel_history.comp"}},
                          .axes = {{"HAS_SUN", {0, 1}},
                                   {"HAS_LAMPS", {0, 1}},
                                   {"HISTORY", {0, 1, 2}},  // none, of another camera, of the same
                                   {"COUNT_WORK", {0, 1}}},
                          .valid = [](const Permutation& p) { return p.at("HAS_SUN") + p.at("HAS_LAMPS") > 0; }};
const ProgramRegistry::Registration registration(program);

/// Froxels of a group of froxel_history.comp: its columns, and RUN.
constexpr glm::ivec3 group{16, 16, 16};

/// R3 sequence (Roberts 2018): multiples of the inverse powers of the root of x^4 = x + 1.
constexpr glm::dvec3 sequence_step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

}  // namespace

bool keeps_history(const Inputs& inputs, const Settings& settings, const FrameMedia& media) {
    return settings.technique == Technique::froxel && settings.froxel_history > 0 && !media.empty() &&
           (inputs.has_sun || inputs.has_lamps);
}

void FroxelHistory::begin_frame(const Inputs& inputs, const Settings& settings, const FrameMedia& media) {
    const glm::ivec3 size{settings.froxels_x, settings.froxels_y, settings.froxels_z};
    const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16, .size = size, .levels = 1};
    visibility_.begin_frame(desc, "volumetrics froxel visibility");
    certainty_.begin_frame(desc, "volumetrics froxel certainty");
    if (!valid()) frame_ = 0;
    const shared::VolumetricsData& data = media.data;
    current_ = {.view = inputs.view,
                .projection = inputs.projection,
                .distribution = static_cast<int>(data.froxel_distribution),
                .depths = glm::vec2(data.froxel_depths),
                .begins = data.froxel_begins,
                .lengths = data.froxel_lengths};
    current_sun_ = inputs.sun_direction;
}

void FroxelHistory::end_frame() {
    visibility_.end_frame();
    certainty_.end_frame();
    previous_ = current_;
    previous_sun_ = current_sun_;
    ++frame_;
}

std::size_t FroxelHistory::bytes() const {
    return visibility_.current() ? 4 * gl::byte_size(visibility_.current().desc()) : 0;
}

glm::vec3 FroxelHistory::jitter() const {
    if (!valid()) return {0.5F, 0.5F, -1};
    return glm::fract(0.5 + sequence_step * double(frame_));
}

void FroxelHistory::set_uniforms(const gl::Program& shader) const {
    shader.set("previous_clip_from_view",
               previous_clip_from_view(previous_.view, previous_.projection, current_.view));
    shader.set("previous_distribution", previous_.distribution);
    shader.set("previous_depths", previous_.depths);
    shader.set("previous_begins", previous_.begins);
    shader.set("previous_lengths", previous_.lengths);
}

float FroxelHistory::sun_frames() const {
    const float turn = glm::distance(previous_sun_, current_sun_);
    return sun_turn / std::max(turn, 1e-5F);
}

TextureRef add_froxel_history(PassList& passes, const PassResources& resources, const Inputs& inputs,
                              const Settings& settings, TextureRef columns, const FroxelLight& light,
                              FroxelHistory& history) {
    const auto import = [&](const gl::Texture& texture, const char* name) {
        return texture ? passes.import(name, texture) : TextureRef();
    };
    const int kind = !history.valid() ? 0 : history.still() ? 2 : 1;
    const TextureRef visibility_before =
        import(history.visibility().previous(), "volumetrics/froxel_visibility_before");
    const TextureRef certainty_before =
        import(history.certainty().previous(), "volumetrics/froxel_certainty_before");
    TextureRef visibility = import(history.visibility().current(), "volumetrics/froxel_visibility_kept");
    TextureRef certainty = import(history.certainty().current(), "volumetrics/froxel_certainty_kept");
    TextureRef radiance = light.radiance;
    const gl::Program& shader = resources.shaders.get(program, {{"HAS_SUN", inputs.has_sun},
                                                                {"HAS_LAMPS", inputs.has_lamps},
                                                                {"HISTORY", kind},
                                                                {"COUNT_WORK", inputs.count_work}});
    const glm::ivec3 size{settings.froxels_x, settings.froxels_y, settings.froxels_z};
    passes.add(
        "volumetrics/froxel_history",
        [&](PassBuilder& builder) {
            for (TextureRef ref :
                 {columns, light.visibility, light.sun, light.lamps, visibility_before, certainty_before})
                builder.sample(ref);
            radiance = builder.storage_read_write(radiance);
            visibility = builder.storage_write(visibility);
            certainty = builder.storage_write(certainty);
        },
        [=, &shader, &resources, &history, frames = static_cast<float>(settings.froxel_history),
         groups = glm::uvec3((size + group - 1) / group)](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            const gl::Sampler& nearest = resources.nearest;
            const BoundTextures bound{{texture(columns), nearest},           {texture(light.visibility), nearest},
                                      {texture(light.sun), nearest},         {texture(light.lamps), nearest},
                                      {texture(visibility_before), nearest}, {texture(certainty_before), nearest}};
            glBindImageTexture(0, context.texture(radiance).id, 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA16F);
            glBindImageTexture(1, context.texture(visibility).id, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16);
            glBindImageTexture(2, context.texture(certainty).id, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16);
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            if (kind == 1) history.set_uniforms(shader);
            shader.set("most_frames", glm::vec2(frames, std::min(frames, history.sun_frames())));
            shader.use();
            glDispatchCompute(groups.x, groups.y, groups.z);
            history.end_frame();
        });
    return radiance;
}

}  // namespace tyndall::volumetrics
