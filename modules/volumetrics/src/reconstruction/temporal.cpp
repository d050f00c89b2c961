#include "reconstruction/temporal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "frame/resources.h"
#include "reconstruction/reconstruction.h"
#include "reconstruction/reprojection.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{
    .name = "volumetrics/temporal",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/temporal.frag"}},
    .axes = {{"CLIP", {0, 1}}, {"REJECT", {0, 1}}, {"TEXTURES", {1, 2, 3, 4}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program);

/// Relative change of a global medium in one frame after which no mean is worth more than that frame.
constexpr float medium_change = 0.05F;
/// The same of the camera [m], see temporal.frag.
constexpr float camera_travel = 0.15F;
/// Lamps that change in one frame, as many as temporal.frag has place for. The change of more is everywhere.
constexpr std::size_t most_lamps = 16;
/// Frames without any change; what is kept counts no more of them.
constexpr float many_frames = 256;

float largest_change(glm::vec3 a, glm::vec3 b) {
    float change = 0;
    for (int i = 0; i < 3; ++i) {
        const float most = std::max(a[i], b[i]);
        if (most > 0) change = std::max(change, std::abs(a[i] - b[i]) / most);
    }
    return change;
}

float largest_change(const GlobalMedium& a, const GlobalMedium& b) {
    if (a.height != b.height || a.rayleigh != b.rayleigh) return 1;
    float change = std::max({largest_change(a.sigma_s, b.sigma_s), largest_change(a.sigma_a, b.sigma_a),
                             largest_change(a.emission, b.emission), std::abs(a.anisotropy - b.anisotropy)});
    if (a.height)
        change = std::max({change, std::abs(a.base - b.base) / std::abs(b.falloff),
                           std::abs(a.falloff - b.falloff) / std::abs(b.falloff)});
    return change;
}

/// What becomes of a mode without reprojection: neither clipped nor rejected.
bool reprojects(const Settings& settings) {
    return settings.temporal != Temporal::blend;
}

}  // namespace

void TemporalHistory::begin_frame(const Inputs& inputs, const Settings& settings, glm::ivec2 size,
                                  const std::vector<gl::TextureDesc>& textures) {
    const bool statistics = reprojects(settings) && settings.temporal_reject;
    surface_.begin_frame({.format = static_cast<GLenum>(statistics ? GL_RGBA32F : GL_RG32F), .size = {size, 1}},
                         "volumetrics temporal surface");
    Key key{settings.temporal, settings.temporal_place, settings.technique, settings.resolution, textures.size()};
    if (key != key_) surface_.invalidate();
    key_ = std::move(key);
    for (std::size_t i = 0; i < most_textures; ++i) {
        if (i >= textures.size()) {
            textures_[i].release();
            continue;
        }
        textures_[i].begin_frame(textures[i], "volumetrics temporal");
        if (!textures_[i].valid()) surface_.invalidate();
    }
    if (!valid())
        for (History& texture : textures_) texture.invalidate();
    frame_ = valid() ? frame_ + 1 : 0;
    previous_ = current_;
    current_ = {.view = inputs.view,
                .projection = inputs.projection,
                .eye = inputs.eye,
                .motion = static_cast<bool>(inputs.motion),
                .has_sun = inputs.has_sun,
                .sun_direction = inputs.sun_direction,
                .global = inputs.global,
                .lamps = inputs.lamps};
}

std::size_t TemporalHistory::bytes() const {
    std::size_t bytes = surface_.bytes();
    for (const History& texture : textures_) bytes += texture.bytes();
    return bytes;
}

bool TemporalHistory::still() const {
    return !current_.motion && previous_.view == current_.view && previous_.projection == current_.projection;
}

glm::mat4 TemporalHistory::clip_before_from_view() const {
    return previous_clip_from_view(previous_.view, previous_.projection, current_.view);
}

float TemporalHistory::known_frames() const {
    if (current_.has_sun != previous_.has_sun || current_.global.size() != previous_.global.size()) return 1;
    float change = 1 / many_frames;
    if (current_.has_sun)
        change = std::max(change, glm::distance(previous_.sun_direction, current_.sun_direction) / sun_turn);
    for (std::size_t i = 0; i < current_.global.size(); ++i)
        change = std::max(change, largest_change(previous_.global[i], current_.global[i]) / medium_change);
    return std::max(1 / change, 1.0F);
}

void TemporalHistory::set_changes(const gl::Program& shader) const {
    float frames = known_frames();
    const std::vector<ChangedLamp> lamps = changed_lamps(previous_.lamps, current_.lamps);
    for (std::size_t i = most_lamps; i < lamps.size(); ++i) frames = std::min(frames, lamps[i].frames);
    const std::size_t count = std::min(lamps.size(), most_lamps);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 position = glm::dmat4(current_.view) * glm::dvec4(lamps[i].position, 1);
        shader.set(fmt::format("changed_lamps[{}]", i), glm::vec4(position, lamps[i].range));
        shader.set(fmt::format("changed_frames[{}]", i), lamps[i].frames);
    }
    shader.set("changed_lamp_count", static_cast<int>(count));
    shader.set("known_frames", frames);
    shader.set("travel", glm::distance(previous_.eye, current_.eye) / camera_travel);
}

TemporalMean add_temporal(Frame& frame, Textures textures) {
    const Settings& settings = frame.settings;
    const bool before = settings.temporal_place == TemporalPlace::before;
    const glm::ivec2 size = before ? frame.size : frame.inputs.size;
    TemporalHistory& history = frame.resources.temporal;
    if (textures.size() > TemporalHistory::most_textures)
        throw Error(fmt::format("technique {}: {} textures to average over frames, at most {} expected",
                                settings.technique, textures.size(), TemporalHistory::most_textures));
    std::vector<gl::TextureDesc> descs;
    for (const TextureRef* texture : textures) descs.push_back(frame.passes.desc(*texture));
    history.begin_frame(frame.inputs, settings, size, descs);

    const bool moves = reprojects(settings);
    const bool counted = settings.temporal == Temporal::accumulate;
    const int taps = !history.valid() ? 0 : !moves || history.still() ? 1 : 4;
    PassList::HistoryRefs surface = frame.passes.import_history("volumetrics/temporal/surface", history.surface());
    std::vector<Pass::Source> sources{
        {before ? frame.depth : frame.inputs.depth}, {surface.previous}, {frame.inputs.motion}};
    std::vector<Pass::Source> kept;
    std::vector<TextureRef*> targets{&surface.current};
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const auto [previous, current] = frame.passes.import_history(
            name_after("volumetrics/temporal", frame.passes.info(*textures[i])), history.texture(i));
        // The first is read between its pixels, for what changed.
        sources.push_back({*textures[i], i == 0});
        kept.push_back({previous, i == 0});
        *textures[i] = current;
        targets.push_back(textures[i]);
    }
    sources.insert(sources.end(), kept.begin(), kept.end());
    TemporalMean mean;
    if (frame.inputs.acceptance)
        mean.acceptance = frame.passes.create("volumetrics/acceptance", {.format = GL_R16F, .size = {size, 1}});
    targets.push_back(&mean.acceptance);

    const auto set = [=, &history, motion = static_cast<bool>(frame.inputs.motion), mode = settings.temporal,
                      weight = settings.temporal_weight, scale = settings.temporal_scale,
                      frames = static_cast<float>(settings.temporal_frames)](const PassContext&,
                                                                             const gl::Program& shader) {
        shader.set("taps", taps);
        shader.set("low", before ? 1 : 0);
        shader.set("motion", motion ? 1 : 0);
        shader.set("by_depth", mode == Temporal::acceptance || counted ? 1 : 0);
        shader.set("counted", counted ? 1 : 0);
        shader.set("scale", scale);
        shader.set("least_weight", weight);
        shader.set("most_frames", counted ? frames : many_frames);
        if (mode == Temporal::blend) {
            shader.set("known_frames", many_frames);
            shader.set("travel", 0.0F);
            shader.set("changed_lamp_count", 0);
        } else {
            history.set_changes(shader);
        }
        shader.set("frame", history.frame());
        shader.set("previous_clip_from_view", history.clip_before_from_view());
    };
    frame.add({.name = "volumetrics/temporal",
               .program = frame.program(program, {{"CLIP", moves && settings.temporal_clip},
                                                  {"REJECT", moves && settings.temporal_reject},
                                                  {"TEXTURES", static_cast<int>(textures.size())}}),
               .sources = sources,
               .targets = targets,
               .set = set});
    mean.frames = surface.current;
    return mean;
}

}  // namespace tyndall::volumetrics
