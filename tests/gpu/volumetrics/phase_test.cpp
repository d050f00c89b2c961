#include <cmath>

#include "engine/core/files.h"
#include "engine/gl/buffer.h"
#include "engine/shader/shader_library.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"

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
    const int BLOCKS = 64;
    const int POINTS = 256;
    float total = 0.0;
    for (int block = 0; block < BLOCKS; ++block) {
        float sum = 0.0;
        for (int i = 0; i < POINTS; ++i) {
            float s = (float(block * POINTS + i) + 0.5) / float(BLOCKS * POINTS);
            float theta = PI * s * s * (3.0 - 2.0 * s);
            sum += phase(kind, g, cos(theta)) * sin(theta) * PI * 6.0 * s * (1.0 - s);
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
    ShaderLibrary shaders(folder.path());
    const std::vector<float> anisotropies{-0.9F, -0.5F, 0, 0.3F, 0.7F, 0.9F};
    std::vector<float> results(3 * anisotropies.size());
    const gl::Buffer result_buffer(results.size() * sizeof(float), "results");
    const gl::Buffer input = gl::Buffer::of(std::span<const float>(anisotropies), "anisotropies");
    result_buffer.bind(GL_SHADER_STORAGE_BUFFER, 0);
    input.bind(GL_SHADER_STORAGE_BUFFER, 1);
    shaders.get(desc).use();
    glDispatchCompute(static_cast<GLuint>(anisotropies.size()), 3, 1);
    result_buffer.read(0, results.size() * sizeof(float), results.data());
    for (std::size_t i = 0; i < results.size(); ++i) EXPECT_NEAR(results[i], 1, 1e-3) << i;
}

}  // namespace
}  // namespace tyndall::test
