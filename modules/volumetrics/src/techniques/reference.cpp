#include <algorithm>

#include "frame/passes.h"
#include "shaders/shared/bindings.h"

namespace tyndall::volumetrics {
namespace {

const PermutationAxis height_media{"HEIGHT_MEDIA", {0, 1, MAX_HEIGHT_MEDIA}};
const ProgramDesc media_program{
    .name = "volumetrics/reference_media",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/reference_media.comp"}},
    .axes = {height_media, {"LOCAL_MEDIA", {0, 1}}, {"HAS_SUN", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramDesc lamp_program{
    .name = "volumetrics/reference_lamps",
    .stages = {{GL_COMPUTE_SHADER, "shaders/volumetrics/techniques/reference_lamps.comp"}},
    .axes = {height_media, {"LOCAL_MEDIA", {0, 1}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
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
    const int per_medium = (1 + noise_octaves) * (1 + settings.reference_light_steps);
    return std::clamp(iterations / (1 + static_cast<int>(media.local.size()) * per_medium), 1, steps_per_part);
}

}  // namespace

Outputs add_reference(PassList& passes, PassResources& resources, const Inputs& inputs, const Settings& settings,
                      const FrameMedia& media) {
    const gl::TextureDesc desc{.format = GL_RGBA32F, .size = {inputs.size, 1}};
    Outputs outputs;
    outputs.scattering = passes.create("volumetrics/scattering", desc);
    outputs.transmittance = passes.create("volumetrics/transmittance", desc);

    Permutation axes{{"HEIGHT_MEDIA", height_media_axis(media)},
                     {"LOCAL_MEDIA", !media.local.empty()},
                     {"COUNT_WORK", inputs.count_work}};
    const gl::Program* lamps = inputs.has_lamps ? &resources.shaders.get(lamp_program, axes) : nullptr;
    axes["HAS_SUN"] = inputs.has_sun;
    const gl::Program& sun = resources.shaders.get(media_program, axes);
    const bool lit = inputs.has_sun || inputs.has_lamps || inputs.has_ambient;
    const Reference reference{
        .media = sun,
        .lamps = lamps,
        .unfinished = resources.unfinished,
        .steps = (settings.reference_steps + steps_per_part - 1) / steps_per_part * steps_per_part,
        .steps_per_dispatch = media_steps_per_dispatch(media, settings),
        .groups = glm::uvec2((inputs.size + 7) / 8)};

    passes.add(
        "volumetrics/reference",
        [&](PassBuilder& builder) {
            builder.sample(inputs.depth);
            if (lit) {
                for (TextureRef texture : inputs.light_textures) builder.sample(texture);
                for (BufferRef buffer : inputs.light_buffers) builder.read(buffer);
            }
            outputs.scattering = builder.storage_write(outputs.scattering);
            outputs.transmittance = builder.storage_write(outputs.transmittance);
        },
        [outputs, reference, depth = inputs.depth, bind_lighting = lit ? inputs.bind_lighting : nullptr,
         lamp_samples = settings.reference_lamp_samples, light_steps = settings.reference_light_steps,
         has_global = media.has_global, &resources](const PassContext& context) {
            GLuint unit = 0;
            for (const TextureRef ref : {outputs.scattering, outputs.transmittance}) {
                const GLuint image = context.texture(ref).id;
                glClearTexImage(image, 0, GL_RGBA, GL_FLOAT, nullptr);
                glBindImageTexture(unit++, image, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
            }
            if (bind_lighting) bind_lighting();
            const BoundTextures bound{{context.texture(depth), resources.nearest}};
            resources.uniforms.bind(GL_UNIFORM_BUFFER, BINDING_VOLUMETRICS);
            if (resources.local_media) resources.local_media.bind(GL_SHADER_STORAGE_BUFFER, BINDING_LOCAL_MEDIA);
            resources.unfinished.bind(GL_SHADER_STORAGE_BUFFER, BINDING_UNFINISHED);
            for (const gl::Program* program : {&reference.media, reference.lamps}) {
                if (program == nullptr) continue;
                program->set("steps", reference.steps);
                program->set("light_steps", light_steps);
                program->set("lamp_samples", lamp_samples);
                program->set("has_global", has_global ? 1 : 0);
            }
            reference.run();
        });
    return outputs;
}

}  // namespace tyndall::volumetrics
