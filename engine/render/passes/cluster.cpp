#include "engine/render/passes/cluster.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gl/program_limits.h"
#include "shaders/engine/visible_lights.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/bindings.h"

TYNDALL_GLSL_BEGIN
#include "shaders/engine/light_reach.glsl"
TYNDALL_GLSL_END

namespace tyndall {
namespace {

const ProgramDesc cull_program{
    "light_cull", {{GL_COMPUTE_SHADER, "shaders/engine/light_cull.comp"}}, {{"OCCLUSION", {0, 1}}}, {}};
const ProgramDesc cluster_program{"cluster", {{GL_COMPUTE_SHADER, "shaders/engine/cluster.comp"}}, {}, {}};
const ProgramRegistry::Registration cull_registration(cull_program), cluster_registration(cluster_program);

/// m; the first slice holds everything nearer.
constexpr float cluster_near = 1.0f;

/// The pool's bound is computed in other roundings than the shader's: a lamp is taken for this much larger.
constexpr float slack = 1.001f;

std::size_t cells(float lo, float hi, std::uint32_t count) {
    const float last = static_cast<float>(count) - 0.5f;
    return static_cast<std::size_t>(glm::clamp(hi, 0.0f, last)) -
           static_cast<std::size_t>(glm::clamp(lo, 0.0f, last)) + 1;
}

void grow(gl::Buffer& buffer, std::size_t bytes, const char* label) {
    if (buffer.size() < bytes) buffer = gl::Buffer(bytes + bytes / 16 * 4, label);
}

std::size_t cluster_count(const shared::FrameData& frame) {
    return std::size_t{frame.cluster_size.x} * frame.cluster_size.y * frame.cluster_size.z;
}

}  // namespace

void set_cluster_grid(shared::FrameData& frame, const RenderSettings& settings, float znear, std::size_t lights) {
    const float near = std::max(znear, cluster_near);
    const float far = std::max(settings.cluster_far, 2 * near);
    frame.cluster_size = {settings.cluster_x, settings.cluster_y, settings.cluster_z, lights};
    frame.depth = {znear, near, far, static_cast<float>(settings.cluster_z) / std::log(far / near)};
}

std::size_t cluster_list_bound(const shared::FrameData& frame, std::span<const shared::GpuLight> lights) {
    const glm::vec2 tan_half_fov(1 / frame.projection[0][0], 1 / frame.projection[1][1]);
    const glm::vec2 half_grid = 0.5f * glm::vec2(frame.cluster_size.x, frame.cluster_size.y);
    const auto slice = [&](float depth) { return std::log(std::max(depth / frame.depth.y, 1.0f)) * frame.depth.w; };
    std::size_t total = 0;
    for (const shared::GpuLight& light : lights) {
        const glm::vec4 sphere = reach(light);
        const glm::vec3 center(frame.view * glm::vec4(glm::vec3(sphere), 1));
        const glsl::ScreenBounds b = glsl::screen_bounds(center, slack * sphere.w, tan_half_fov);
        if (b.far <= frame.depth.x || b.lo.x >= 1 || b.lo.y >= 1 || b.hi.x <= -1 || b.hi.y <= -1) continue;
        // A thousandth of a cell more on each side, for a sphere that touches the border between two.
        const glm::vec2 lo = (b.lo + 1.0f) * half_grid - 1e-3f, hi = (b.hi + 1.0f) * half_grid + 1e-3f;
        total += cells(lo.x, hi.x, frame.cluster_size.x) * cells(lo.y, hi.y, frame.cluster_size.y) *
                 cells(slice(b.near) - 1e-3f, slice(b.far) + 1e-3f, frame.cluster_size.z);
    }
    return total;
}

void ClusterPass::reserve(const FrameContext& frame, const LightSet& lights) {
    const std::size_t bytes = cluster_list_bound(frame.frame, lights.lights()) * sizeof(std::uint32_t);
    GLint64 limit = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
    if (bytes > static_cast<std::size_t>(limit))
        throw Error(
            fmt::format("{} lamps in {}x{}x{} clusters may need {} bytes of lists, the driver allows {}: lower "
                        "cluster_x, cluster_y or cluster_z",
                        lights.lights().size(), frame.frame.cluster_size.x, frame.frame.cluster_size.y,
                        frame.frame.cluster_size.z, bytes, limit));
    grow(pool_, bytes, "cluster light lists");
    grow(ranges_, cluster_count(frame.frame) * sizeof(shared::ClusterRange), "cluster ranges");
    grow(visible_, sizeof(shared::VisibleLightsHeader) + lights.lights().size() * sizeof(shared::VisibleLight),
         "visible lights");
    const glm::uvec4 size = frame.frame.cluster_size;
    grow(rows_, std::size_t{size.x + size.y + size.z} * ((size.w + 31) / 32) * sizeof(std::uint32_t),
         "visible rows");
}

ClusterPass::Output ClusterPass::add(FrameContext& frame, const LightSet& lights, TextureRef pyramid) {
    reserve(frame, lights);
    const auto in_view = static_cast<std::size_t>(frame.facts.local_lights_in_view);
    // Of surface_shading.glsl: for each 32 lamps one, and for each of them one that finds it, one that adds it, and
    // one in which the media dim it.
    if (const std::size_t most = std::size_t{gl::loop_rounds()} / 97 * 32; in_view > most && !warned_) {
        warned_ = true;
        spdlog::warn(
            "lamps: {} in view; this driver ends a shader's loops early: where more than {} overlap, surfaces lack "
            "light; give them ranges",
            in_view, most);
    }
    BufferRef all = frame.passes.import_buffer("lights", lights.buffer());
    BufferRef visible = frame.passes.import_buffer("visible lights", visible_.id());
    BufferRef rows = frame.passes.import_buffer("visible rows", rows_.id());
    Output output{frame.passes.import_buffer("cluster ranges", ranges_.id()),
                  frame.passes.import_buffer("cluster light lists", pool_.id())};

    frame.passes.add(
        "light_cull",
        [&](PassBuilder& pass) {
            pass.read(all);
            pass.sample(pyramid);
            visible = pass.write(visible);
            rows = pass.write(rows);
        },
        [this, &frame, &lights, pyramid](const PassContext& pass) {
            lights.bind();
            visible_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_VISIBLE_LIGHTS);
            rows_.clear_uint(0);
            rows_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_VISIBLE_ROWS);
            if (pyramid) glBindTextureUnit(0, pass.texture(pyramid).id);
            frame.shaders.get(cull_program, {{"OCCLUSION", pyramid ? 1 : 0}}).use();
            glDispatchCompute(1, 1, 1);
        });
    frame.passes.add(
        "cluster",
        [&](PassBuilder& pass) {
            pass.read(visible);
            pass.read(rows);
            visible = pass.write(visible);
            output.ranges = pass.write(output.ranges);
            output.lights = pass.write(output.lights);
        },
        [this, &frame](const PassContext&) {
            visible_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_VISIBLE_LIGHTS);
            rows_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_VISIBLE_ROWS);
            bind();
            frame.shaders.get(cluster_program).use();
            glDispatchCompute(static_cast<GLuint>((cluster_count(frame.frame) + 63) / 64), 1, 1);
        });
    return output;
}

void ClusterPass::bind() const {
    ranges_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_CLUSTERS);
    pool_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_CLUSTER_LIGHTS);
}

}  // namespace tyndall
