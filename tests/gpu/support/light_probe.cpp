#include "tests/gpu/support/light_probe.h"

#include "engine/core/files.h"

namespace tyndall::test {
namespace {

constexpr const char* glsl = R"(
#include "shaders/volumetrics/light/light_transmittance.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Points { vec4 points[]; };
uniform vec3 light;  // towards the sun; or where the lamp is
uniform int lamp;    // its index; < 0: the sun
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec3 point = points[i].xyz;
    vec3 to_lamp = light - point;
    points[i].rgb = lamp < 0 ? medium_sun_transmittance(point, light)
                             : medium_lamp_transmittance(uint(lamp), point, normalize(to_lamp), length(to_lamp));
}
)";
const ProgramDesc desc{.name = "probe",
                       .stages = {{GL_COMPUTE_SHADER, "shaders/probe.comp"}},
                       .axes = {{"LIGHT_VOLUMES", {0, 1, 2}}},
                       .valid = {}};

}  // namespace

LightProbe::LightProbe() : programs_(folder_.roots()) {
    write_text(folder_.path() / "shaders/probe.comp", glsl);
}

const gl::Program& LightProbe::program(int light_volumes) {
    return programs_.get(desc, {{"LIGHT_VOLUMES", light_volumes}});
}

std::vector<glm::vec3> LightProbe::transmittance(StubHost& host, const Settings& settings,
                                                 const std::vector<glm::vec3>& points, int lamp) {
    PassList passes;
    const Inputs inputs = host.inputs(passes);
    host.volumetrics().prepare(inputs, settings);
    const volumetrics::LightTransmittance light = host.volumetrics().add_light_passes(passes, inputs, settings);
    std::vector<glm::vec4> values;
    for (const glm::vec3 point : points) values.emplace_back(point, 0);
    gl::Buffer buffer = gl::Buffer::of(std::span<const glm::vec4>(values), "points");
    passes.add(
        "probe",
        [&](PassBuilder& builder) {
            builder.sample(light.sun_volume);
            builder.sample(light.grid_sun_volume);
            builder.sample(light.lamp_volumes);
            builder.keep();
        },
        [&](const PassContext&) {
            host.volumetrics().bind_uniforms();
            buffer.bind(GL_SHADER_STORAGE_BUFFER, 0);
            const gl::Program& asking = program(light.light_volumes);
            asking.set("light",
                       lamp < 0 ? -host.sun_direction : glm::vec3(host.lights[std::size_t(lamp)].position_range));
            asking.set("lamp", lamp);
            asking.use();
            glDispatchCompute(static_cast<GLuint>(values.size()), 1, 1);
        });
    passes.compile();
    passes.execute(pool_);
    skipped_.clear();
    for (const PassList::PassInfo& pass : passes.passes()) skipped_[pass.name] = pass.live ? "" : pass.reason;
    buffer.read(0, values.size() * sizeof values[0], values.data());
    return {values.begin(), values.end()};
}

}  // namespace tyndall::test
