
#include "engine/core/files.h"
#include "engine/gl/buffer.h"
#include "engine/shader/shader_library.h"
#include "shaders/lib/glm_subset.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/phase.glsl"
TYNDALL_GLSL_END

namespace tyndall::test {
namespace {

constexpr const char* integrate_phase = R"(
#include "shaders/lib/phase.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) writeonly buffer Results { float results[]; };
layout(std430, binding = 1) readonly buffer Anisotropies { float anisotropies[]; };
// 2 pi int p(cos theta) sin theta d theta by the midpoint rule, in theta = pi s^2 (3 - 2 s), whose points lie close at
// both poles, where the lobes are.
void main() {
    float g = anisotropies[gl_GlobalInvocationID.x];
    int kind = int(gl_GlobalInvocationID.y);
    const int RAYLEIGH_HERE = 6;
    const int BLOCKS = 64;
    const int POINTS = 256;
    float total = 0.0;
    for (int block = 0; block < BLOCKS; ++block) {
        float sum = 0.0;
        for (int i = 0; i < POINTS; ++i) {
            float s = (float(block * POINTS + i) + 0.5) / float(BLOCKS * POINTS);
            float theta = PI * s * s * (3.0 - 2.0 * s);
            float p = kind == RAYLEIGH_HERE ? phase_rayleigh(cos(theta)) : phase(kind, g, -0.5, 20.0, 0.25, cos(theta));
            sum += p * sin(theta) * PI * 6.0 * s * (1.0 - s);
        }
        total += sum;
    }
    results[gl_GlobalInvocationID.x + gl_NumWorkGroups.x * gl_GlobalInvocationID.y] =
        2.0 * PI * total / float(BLOCKS * POINTS);
}
)";

class VolumetricsPhase : public GlTest {};

TEST_F(VolumetricsPhase, FunctionsIntegrateToOneOnTheGpu) {
    const ShaderFolder folder;
    write_text(folder.path() / "shaders/phase_test.comp", integrate_phase);
    static const ProgramDesc desc{
        .name = "phase test", .stages = {{GL_COMPUTE_SHADER, "shaders/phase_test.comp"}}, .axes = {}, .valid = {}};
    ShaderLibrary shaders(folder.roots());
    const std::vector<float> anisotropies{-0.9F, -0.5F, 0, 0.3F, 0.7F, 0.9F};
    std::vector<float> results(7 * anisotropies.size());
    const gl::Buffer result_buffer(results.size() * sizeof(float), "results");
    const gl::Buffer input = gl::Buffer::of(std::span<const float>(anisotropies), "anisotropies");
    result_buffer.bind(GL_SHADER_STORAGE_BUFFER, 0);
    input.bind(GL_SHADER_STORAGE_BUFFER, 1);
    shaders.get(desc).use();
    glDispatchCompute(static_cast<GLuint>(anisotropies.size()), 7, 1);
    result_buffer.read(0, results.size() * sizeof(float), results.data());
    for (std::size_t i = 0; i < results.size(); ++i) EXPECT_NEAR(results[i], 1, 1e-3) << i;
}

constexpr const char* tabulate_phase = R"(
#include "shaders/lib/phase.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) writeonly buffer Results { float results[]; };
layout(std430, binding = 1) readonly buffer Arguments { vec4 arguments[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 a = arguments[i];
    results[3u * i] = phase_cornette_shanks(a.x, a.w);
    results[3u * i + 1u] = phase_two_lobes(a.x, a.y, 5.0, a.z, a.w);
    results[3u * i + 2u] = phase_rayleigh(a.w);
}
)";

// One source compiled by two compilers: single precision, and little more than its rounding apart.
TEST_F(VolumetricsPhase, ValuesAreThoseOfCpp) {
    const ShaderFolder folder;
    write_text(folder.path() / "shaders/phase_test.comp", tabulate_phase);
    static const ProgramDesc desc{
        .name = "phase test", .stages = {{GL_COMPUTE_SHADER, "shaders/phase_test.comp"}}, .axes = {}, .valid = {}};
    ShaderLibrary shaders(folder.roots());
    std::vector<glm::vec4> arguments;
    for (const float g : {-1.0F, -0.999F, -0.4F, 0.0F, 0.3F, 0.97F, 1.0F})
        for (const float c : {-1.0F, -0.99F, -0.3F, 0.0F, 0.5F, 0.999F, 1.0F})
            for (const float weight : {0.0F, 0.3F, 1.0F}) arguments.emplace_back(g, -0.6F, weight, c);
    std::vector<float> results(3 * arguments.size());
    const gl::Buffer result_buffer(results.size() * sizeof(float), "results");
    const gl::Buffer input = gl::Buffer::of(std::span<const glm::vec4>(arguments), "arguments");
    result_buffer.bind(GL_SHADER_STORAGE_BUFFER, 0);
    input.bind(GL_SHADER_STORAGE_BUFFER, 1);
    shaders.get(desc).use();
    glDispatchCompute(static_cast<GLuint>(arguments.size()), 1, 1);
    result_buffer.read(0, results.size() * sizeof(float), results.data());
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const glm::vec4 a = arguments[i];
        EXPECT_NEAR(results[3 * i] / glsl::phase_cornette_shanks(a.x, a.w), 1, 2e-5) << a.x << ' ' << a.w;
        EXPECT_NEAR(results[3 * i + 1] / glsl::phase_two_lobes(a.x, a.y, 5.0F, a.z, a.w), 1, 2e-5);
        EXPECT_NEAR(results[3 * i + 2] / glsl::phase_rayleigh(a.w), 1, 2e-5);
    }
}

}  // namespace
}  // namespace tyndall::test
