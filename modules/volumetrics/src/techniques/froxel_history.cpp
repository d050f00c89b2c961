#include "techniques/froxel_history.h"

#include <algorithm>

#include "frame/resources.h"
#include "media/froxel_grid.h"
#include "reconstruction/reprojection.h"
#include "techniques/froxel_steps.h"

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

void FroxelHistory::begin_frame(const Inputs& inputs, const Settings& settings, const FrameMedia& media) {
    const glm::ivec3 size = froxel_size(settings, inputs.size);
    const gl::TextureDesc desc{.kind = gl::TextureKind::d3, .format = GL_RGBA16, .size = size, .levels = 1};
    visibility_.begin_frame(desc, "volumetrics froxel visibility");
    certainty_.begin_frame(desc, "volumetrics froxel certainty");
    if (!std::ranges::equal(few_lamps_, media.data.few_lamps)) {
        // Froxels hold other lamps.
        visibility_.invalidate();
        certainty_.invalidate();
        std::ranges::copy(media.data.few_lamps, few_lamps_);
    }
    frame_ = valid() ? frame_ + 1 : 0;
    previous_ = current_;
    previous_sun_ = current_sun_;
    const shared::VolumetricsData& data = media.data;
    current_ = {.view = inputs.view,
                .projection = inputs.projection,
                .distribution = static_cast<int>(data.froxel_distribution),
                .depths = glm::vec2(data.froxel_depths),
                .begins = data.froxel_begins,
                .lengths = data.froxel_lengths};
    current_sun_ = inputs.sun_direction;
}

std::size_t FroxelHistory::bytes() const {
    return visibility_.bytes() + certainty_.bytes();
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

TextureRef add_froxel_history(Frame& frame, TextureRef columns, const FroxelLight& light, FroxelHistory& history) {
    const int kind = !history.valid() ? 0 : history.still() ? 2 : 1;
    auto [visibility_before, visibility] =
        frame.passes.import_history("volumetrics/froxel_visibility_kept", history.visibility());
    auto [certainty_before, certainty] =
        frame.passes.import_history("volumetrics/froxel_certainty_kept", history.certainty());
    TextureRef radiance = light.radiance;
    frame.add(
        {.name = froxel_pass("history", light.content),
         .program = frame.program(program, {{"HAS_SUN", static_cast<bool>(light.sun)},
                                            {"HAS_LAMPS", static_cast<bool>(light.lamps)},
                                            {"HISTORY", kind}}),
         .sources =
             {{columns}, {light.visibility}, {light.sun}, {light.lamps}, {visibility_before}, {certainty_before}},
         .images = {{&radiance, true}, {&visibility}, {&certainty}},
         .set =
             [&history, kind, frames = static_cast<float>(frame.settings.froxels.history)](
                 const PassContext&, const gl::Program& shader) {
                 if (kind == 1) history.set_uniforms(shader);
                 shader.set("most_frames", glm::vec2(frames, std::min(frames, history.sun_frames())));
             },
         .groups = (frame.passes.desc(radiance).size + group - 1) / group});
    return radiance;
}

}  // namespace tyndall::volumetrics
