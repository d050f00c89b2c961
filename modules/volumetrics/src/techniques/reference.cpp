#include <algorithm>

#include "frame/resources.h"
#include "shaders/shared/bindings.h"
#include "techniques/techniques.h"
#include "volumetrics/frame.h"

namespace tyndall::volumetrics {
namespace {

const PermutationAxis height_media{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}}, local_media{"LOCAL_MEDIA", {0, 1}},
    grids{"GRIDS", {0, 1}}, glass{"GLASS", {0, 1, 2}};

bool is_valid(const Permutation& p) {
    return is_grid_permutation(p) && is_glass_permutation(p);
}

const ProgramDesc media_program{
    .name = "volumetrics/reference_media",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/reference_media.comp"}},
    .axes = {height_media, local_media, grids, {"HAS_SUN", {0, 1}}, glass, {"COUNT_WORK", {0, 1}}},
    .valid = is_valid};
const ProgramDesc lamp_program{
    .name = "volumetrics/reference_lamps",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/reference_lamps.comp"}},
    .axes = {height_media, local_media, grids, {"LAMPS", {2}}, glass, {"COUNT_WORK", {0, 1}}},
    .valid = is_valid};
const ProgramRegistry::Registration media_registration(media_program), lamp_registration(lamp_program);

/// MAX_STEP_COUNT of reference_lamps.comp.
constexpr int steps_per_part = 16;

/// Everything a frame of the technique needs while it runs.
struct Reference {
    const gl::Program& media;
    const gl::Program* lamps;  ///< null: none in view
    gl::Buffer& unfinished;    ///< see reference_lamps.comp
    int steps;
    int steps_per_dispatch;  ///< of the media
    glm::uvec2 groups;

    void dispatch(const gl::Program& program, int first, int count) const {
        program.set("first_step", first);
        program.set("step_count", count);
        program.use();
        glDispatchCompute(groups.x, groups.y, 1);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    }
    void light_by_lamps(int first) const {
        GLuint more = 1;
        while (more != 0) {
            more = 0;
            unfinished.write(0, sizeof more, &more);
            dispatch(*lamps, first, steps_per_part);
            unfinished.read(0, sizeof more, &more);
        }
    }
    void run() const {
        for (int part = 0; part < steps; part += steps_per_part) {
            if (lamps != nullptr) light_by_lamps(part);
            for (int first = part; first < part + steps_per_part; first += steps_per_dispatch) {
                const int count = std::min(steps_per_dispatch, part + steps_per_part - first);
                media.set("last", first + count == steps ? 1 : 0);
                dispatch(media, first, count);
            }
        }
    }
};

/// So many steps that the loops of a dispatch stay far from what drivers end or take for a hang.
int media_steps_per_dispatch(const FrameMedia& media, const Settings& settings) {
    constexpr int iterations = 8000, noise_octaves = 4;
    const int per_medium = (1 + noise_octaves) * (1 + settings.reference.light_steps);
    return std::clamp(iterations / (1 + static_cast<int>(media.local.size()) * per_medium), 1, steps_per_part);
}

/// For reference_lamps.comp: whether a dispatch left lamps for another.
struct Unfinished : Kept {
    gl::Buffer buffer{16, "volumetrics unfinished lamps"};
    [[nodiscard]] std::size_t bytes() const override { return buffer.size(); }
};

/// Brute force in RGBA32F; the transmittance is always given.
Estimate add(Frame& frame) {
    Estimate estimate;
    estimate.scattering = frame.create("volumetrics/scattering", GL_RGBA32F);
    estimate.transmittance = frame.create("volumetrics/transmittance", GL_RGBA32F);
    const Settings& settings = frame.settings;
    const Reference reference{
        .media = frame.program(media_program),
        .lamps = frame.inputs.has_lamps ? &frame.program(lamp_program, {{"LAMPS", 2}}) : nullptr,
        .unfinished = frame.kept<Unfinished>().buffer,
        .steps = (settings.reference.steps + steps_per_part - 1) / steps_per_part * steps_per_part,
        .steps_per_dispatch = media_steps_per_dispatch(frame.media, settings),
        .groups = glm::uvec2((frame.size + 7) / 8)};
    const auto set = [estimate, reference, lamp_samples = settings.reference.lamp_samples,
                      light_steps = settings.reference.light_steps](const PassContext& context,
                                                                    const gl::Program&) {
        for (const TextureRef ref : {estimate.scattering, estimate.transmittance})
            glClearTexImage(context.texture(ref).id, 0, GL_RGBA, GL_FLOAT, nullptr);
        reference.unfinished.bind(GL_SHADER_STORAGE_BUFFER, BINDING_UNFINISHED);
        for (const gl::Program* program : {&reference.media, reference.lamps}) {
            if (program == nullptr) continue;
            program->set("steps", reference.steps);
            program->set("light_steps", light_steps);
            program->set("lamp_samples", lamp_samples);
        }
    };
    frame.add({.name = "volumetrics/reference",
               .program = reference.media,
               .sources = {{frame.depth}},
               .images = {{&estimate.scattering}, {&estimate.transmittance}},
               .lit = true,
               .local_media = true,
               .set = set,
               .draw = [reference] { reference.run(); }});
    return estimate;
}

}  // namespace

TechniqueDesc reference() {
    return {.name = "reference",
            .help = "Brute force over the engine's shadow maps: slow, and what the others are measured against.",
            .settings = "reference_",
            .passes = {"volumetrics/reference"},
            .traits = {.unseen_local_media = true, .interactive = false},
            .add = add};
}

}  // namespace tyndall::volumetrics
