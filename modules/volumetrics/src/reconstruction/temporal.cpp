#include "reconstruction/temporal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "reconstruction/reconstruction.h"
#include "reconstruction/reprojection.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

const ProgramDesc program{
    .name = "volumetrics/temporal",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/temporal.frag"}},
    .axes = {{"CLIP", {0, 1}}, {"REJECT", {0, 1}}, {"CHROMATIC", {0, 1}}, {"COUNT_WORK", {0, 1}}},
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

void TemporalHistory::begin_frame(const Inputs& at, const Settings& settings, const gl::TextureDesc& scattering,
                                  const gl::TextureDesc& transmittance) {
    chromatic_ = transmittance.size.x > 0;
    const bool statistics = reprojects(settings) && settings.temporal_reject;
    const gl::TextureDesc surface{
        .format = static_cast<GLenum>(statistics ? GL_RGBA32F : GL_RG32F), .size = {at.size, 1}, .levels = 1};
    scattering_.begin_frame(scattering, "volumetrics temporal scattering");
    surface_.begin_frame(surface, "volumetrics temporal surface");
    if (chromatic_)
        transmittance_.begin_frame(transmittance, "volumetrics temporal transmittance");
    else
        transmittance_.release();
    const Key key{settings.temporal, settings.temporal_place, settings.technique, settings.resolution};
    if (key != key_) scattering_.invalidate();
    key_ = key;
    if (!valid()) frame_ = 0;
    current_ = {.view = at.view,
                .projection = at.projection,
                .eye = at.eye,
                .motion = static_cast<bool>(at.motion),
                .has_sun = at.has_sun,
                .sun_direction = at.sun_direction,
                .global = at.global,
                .lamps = at.lamps};
}

void TemporalHistory::end_frame() {
    scattering_.end_frame();
    surface_.end_frame();
    if (chromatic_) transmittance_.end_frame();
    previous_ = current_;
    ++frame_;
}

bool TemporalHistory::valid() const {
    return scattering_.valid() && surface_.valid() && (!chromatic_ || transmittance_.valid());
}

std::size_t TemporalHistory::bytes() const {
    std::size_t bytes = 0;
    for (const History* history : {&scattering_, &transmittance_, &surface_})
        if (history->current()) bytes += 2 * gl::byte_size(history->current().desc());
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

TemporalMean add_temporal(PassList& passes, const PassResources& resources, const Inputs& at,
                          const Settings& settings, const Outputs& source, TemporalHistory& history) {
    const bool chromatic = static_cast<bool>(source.transmittance);
    history.begin_frame(at, settings, passes.desc(source.scattering),
                        chromatic ? passes.desc(source.transmittance) : gl::TextureDesc{.size = {0, 0, 0}});
    const auto import = [&](const gl::Texture& texture, const char* name) {
        return texture ? passes.import(name, texture) : TextureRef();
    };
    const TextureRef scattering_before =
        import(history.scattering().previous(), "volumetrics/temporal_scattering_before");
    const TextureRef transmittance_before =
        import(history.transmittance().previous(), "volumetrics/temporal_transmittance_before");
    const TextureRef surface_before = import(history.surface().previous(), "volumetrics/temporal_surface_before");
    TextureRef surface = import(history.surface().current(), "volumetrics/temporal_surface");
    Outputs target = source;
    target.scattering = import(history.scattering().current(), "volumetrics/temporal_scattering");
    target.transmittance = import(history.transmittance().current(), "volumetrics/temporal_transmittance");
    if (at.acceptance)
        target.acceptance = passes.create("volumetrics/acceptance", {.format = GL_R16F, .size = {at.size, 1}});

    const bool moves = reprojects(settings);
    const bool counted = settings.temporal == Temporal::accumulate;
    const int taps = !history.valid() ? 0 : !moves || history.still() ? 1 : 4;
    const gl::Program& shader = resources.shaders.get(program, {{"CLIP", moves && settings.temporal_clip},
                                                                {"REJECT", moves && settings.temporal_reject},
                                                                {"CHROMATIC", chromatic},
                                                                {"COUNT_WORK", at.count_work}});
    passes.add(
        "volumetrics/temporal",
        [&](PassBuilder& builder) {
            for (TextureRef ref : {at.depth, source.scattering, scattering_before, surface_before, at.motion,
                                   source.transmittance, transmittance_before})
                builder.sample(ref);
            target.scattering = builder.attach_color(target.scattering);
            surface = builder.attach_color(surface);
            if (chromatic) target.transmittance = builder.attach_color(target.transmittance);
            if (target.acceptance) target.acceptance = builder.attach_color(target.acceptance);
        },
        [=, &shader, &resources, &history, motion = at.motion, depth = at.depth,
         low = settings.temporal_place == TemporalPlace::before, mode = settings.temporal,
         weight = settings.temporal_weight, scale = settings.temporal_scale,
         frames = static_cast<float>(settings.temporal_frames)](const PassContext& context) {
            const auto texture = [&](TextureRef ref) { return ref ? context.texture(ref) : gl::TextureView(); };
            gl::apply({});
            context.bind_framebuffer();
            const gl::Sampler& nearest = resources.nearest;
            const BoundTextures bound{{texture(depth), nearest},
                                      {texture(source.scattering), resources.linear},
                                      {texture(scattering_before), resources.linear},
                                      {texture(surface_before), nearest},
                                      {texture(motion), nearest},
                                      {texture(source.transmittance), nearest},
                                      {texture(transmittance_before), nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            shader.set("taps", taps);
            shader.set("low", low ? 1 : 0);
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
            shader.use();
            gl::draw_fullscreen();
            history.end_frame();
        });
    return {target, surface};
}

}  // namespace tyndall::volumetrics
