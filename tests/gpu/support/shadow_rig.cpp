#include "support/shadow_rig.h"

#include <algorithm>

#include "engine/scene/data_root.h"
#include "shaders/shared/bindings.h"

namespace tyndall {
namespace {

const char* call_of(ShadowRig::Lookup lookup) {
    switch (lookup) {
        case ShadowRig::Lookup::sun_surface:
            return "sun_shadow_surface(p.world_depth.xyz, p.normal_light.xyz, p.world_depth.w)";
        case ShadowRig::Lookup::sun_volume:
            return "sun_shadow_volume(p.world_depth.xyz, p.world_depth.w)";
        case ShadowRig::Lookup::light_surface:
            return "light_shadow_surface(light_data(uint(p.normal_light.w)), p.world_depth.xyz, "
                   "p.normal_light.xyz)";
        case ShadowRig::Lookup::light_volume:
            return "light_shadow_volume(light_data(uint(p.normal_light.w)), p.world_depth.xyz)";
        case ShadowRig::Lookup::sun_occluder:
            return "sun_shadow_occluder(p.world_depth.xyz)";
        case ShadowRig::Lookup::light_occluder:
            return "light_shadow_occluder(light_data(uint(p.normal_light.w)), p.world_depth.xyz)";
    }
    return "";
}

}  // namespace

std::string shadow_shader(const std::string& defines, const std::string& main) {
    return "#version 450 core\n#define TYNDALL_GLSL 1\n" + defines +
           resolve_includes(data_root(), "shaders/engine/shadow_occluder.glsl") + main;
}

ShadowRig::ShadowRig(Scene scene_) : scene(std::move(scene_)), gpu_(scene), sun(shaders_), atlas(shaders_) {
    settings.cascade_size = 512;
    settings.cascade_distance = 40;
    settings.static_shadow_size = 1024;
    settings.atlas_size = 2048;
    settings.tile_size_max = 256;
}

void ShadowRig::frame() {
    std::vector<std::size_t> lamps;
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (scene.lights[i].type != LightType::sun) lamps.push_back(i);
    frame(lamps);
}

void ShadowRig::frame(std::span<const std::size_t> in_view) {
    update_world_transforms(scene);
    gpu_.update(scene);
    FrameFacts facts;
    facts.has_sun = scene.sun().has_value();
    for (const std::size_t light : in_view) facts.lamps.push_back({.light = light, .in_view = true});
    if (facts.has_sun)
        data.sun_direction = -scene.nodes[static_cast<std::size_t>(scene.lights[*scene.sun()].node)].world[2];
    passes_ = std::make_unique<PassList>();
    FrameContext context{scene, gpu_, view, facts, settings, shaders_, *passes_, data, {64, 64}};
    sun_output = sun.add(context);
    atlas_output = atlas.add(context);
    for (const TextureRef ref : {sun_output.cascades, sun_output.static_map, atlas_output.atlas})
        if (ref) passes_->export_texture(ref);
    passes_->compile();
    passes_->execute(pool_);

    frame_buffer_.assign(std::span<const shared::FrameData>(&data, 1), "frame");
    std::vector<shared::GpuLight> lights;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        const glm::mat4& world = scene.nodes[static_cast<std::size_t>(light.node)].world;
        lights.push_back(gpu_light(light, world, atlas.first_tile(i)));
    }
    light_buffer_.assign(std::span<const shared::GpuLight>(lights), "lights");
}

bool ShadowRig::ran(const std::string& pass) const {
    return std::ranges::count(passes_->live_pass_names(), pass) > 0;
}

int ShadowRig::ran_with_prefix(const std::string& prefix) const {
    return static_cast<int>(std::ranges::count_if(
        passes_->live_pass_names(), [&](const std::string& name) { return name.starts_with(prefix); }));
}

std::string ShadowRig::skip_reason(const std::string& pass) const {
    for (const PassList::PassInfo& info : passes_->passes())
        if (info.name == pass && !info.live) return info.reason;
    return "";
}

const gl::Program& ShadowRig::program(Lookup lookup, bool count_work) {
    gl::Program& program = programs_[{lookup, count_work}];
    if (!program)
        program = gl::Program({{GL_COMPUTE_SHADER, shadow_shader(count_work ? "#define COUNT_WORK 1\n" : "",
                                                                 R"(
layout(local_size_x = 64) in;
struct Point { vec4 world_depth, normal_light; };
layout(std430, binding = 12) readonly buffer Points { Point points[]; };
layout(std430, binding = 13) writeonly buffer Results { float results[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < points.length()) {
        Point p = points[i];
        results[i] = )" + std::string(call_of(lookup)) + R"(;
    }
    flush_work();
})")}},
                              "shadow lookup");
    return program;
}

void ShadowRig::dispatch(const gl::Program& program, std::span<const Point> points, gl::Buffer& results) {
    const auto point_buffer = gl::Buffer::of(points, "points");
    results = gl::Buffer(points.size() * sizeof(float), "results");
    frame_buffer_.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);
    light_buffer_.bind(IMAGE_LIGHTS);
    point_buffer.bind(GL_SHADER_STORAGE_BUFFER, 12);
    results.bind(GL_SHADER_STORAGE_BUFFER, 13);
    sun.bind();
    atlas.bind();
    program.use();
    glDispatchCompute(static_cast<GLuint>((points.size() + 63) / 64), 1, 1);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

std::vector<float> ShadowRig::look_up(Lookup lookup, std::span<const Point> points) {
    gl::Buffer results;
    dispatch(program(lookup, false), points, results);
    std::vector<float> values(points.size());
    results.read(0, values.size() * sizeof(float), values.data());
    return values;
}

std::uint64_t ShadowRig::counted(Lookup lookup, std::span<const Point> points) {
    gl::WorkCounters counters;
    counters.begin_frame();
    counters.begin_pass("lookup");
    gl::Buffer results;
    dispatch(program(lookup, true), points, results);
    const auto counts = counters.read();
    return counts.empty() ? 0 : counts[0].second[static_cast<int>(gl::Work::shadow_lookups)];
}

}  // namespace tyndall
