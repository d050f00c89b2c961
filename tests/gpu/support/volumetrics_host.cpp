#include "tests/gpu/support/volumetrics_host.h"

#include <glad/gl.h>
#include <unistd.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "engine/core/files.h"
#include "engine/gl/readback.h"
#include "shaders/shared/bindings.h"
#include "tests/gpu/support/gl_test.h"

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* lights_glsl = R"(
#include "shaders/shared/bindings.h"
#include "shaders/shared/lights.h"
layout(std140, binding = BINDING_FRAME) uniform StubBlock {
    vec4 stub_sun_direction;
    vec4 stub_sun_illuminance;
    vec4 stub_ambient;
    vec4 stub_options;  // x slices, y thickness, z shadows
    vec4 stub_glass;
};
layout(std430, binding = 3) readonly buffer StubLights { GpuLight stub_lights[]; };
layout(std430, binding = BINDING_CLUSTERS) readonly buffer StubRanges { ClusterRange stub_ranges[]; };
layout(std430, binding = BINDING_CLUSTER_LIGHTS) readonly buffer StubList { uint stub_list[]; };
vec3 sun_direction() { return stub_sun_direction.xyz; }
vec3 sun_illuminance() { return stub_sun_illuminance.rgb; }
vec3 ambient_radiance() { return stub_ambient.rgb; }
int light_slice(float view_depth) { return int(min(view_depth / stub_options.y, stub_options.x - 0.5)); }
float light_slice_end(int slice) {
    return slice + 1 >= int(stub_options.x) ? 1.0e9 : stub_options.y * float(slice + 1);
}
ClusterRange lights_in_slice(vec2 uv, int slice) { return stub_ranges[slice]; }
ClusterRange lights_near(vec2 uv, float view_depth) { return lights_in_slice(uv, light_slice(view_depth)); }
uint light_index(uint i) { return stub_list[i]; }
GpuLight light_at(uint index) { return stub_lights[index]; }
)";

constexpr const char* shadows_glsl = R"(
#include "shaders/interface/lights.glsl"
float sun_visibility(vec3 world, float view_depth) {
    if ((stub_options.z != 1.0 && stub_options.z != 3.0) || world.y > 4.0) return 1.0;
    vec3 d = stub_sun_direction.xyz;
    float x = world.x - d.x / d.y * (world.y - 4.0);
    if (stub_options.z == 3.0) return x < 0.0 ? 0.0 : 1.0;
    float z = world.z - d.z / d.y * (world.y - 4.0);
    return fract(0.37 * x + 0.21 * z) < 0.6 ? 1.0 : 0.0;
}
float light_visibility(uint index, GpuLight light, vec3 world) {
    if (stub_options.z == 0.0) return 1.0;
    vec3 v = world - light.position_range.xyz;
    if (stub_options.z == 2.0) {
        float s = (-6.0 - light.position_range.z) / v.z;
        return s > 0.0 && s < 1.0 && light.position_range.x + s * v.x < 0.0 ? 0.0 : 1.0;
    }
    return fract(1.6 * atan(v.z, v.x) + 0.3 * float(index)) < 0.6 ? 1.0 : 0.0;
}
#if GLASS
vec3 sun_filter(vec3 world, float view_depth) { return world.x < 0.0 ? stub_glass.rgb : vec3(1.0); }
vec3 light_filter(uint index, GpuLight light, vec3 world) { return sun_filter(world, 0.0); }
#endif
)";

constexpr const char* shadow_maps_glsl = R"(
#include "shaders/interface/shadows.glsl"
#if GLASS
bool sun_ray_meets_glass(vec3 world) { return any(lessThan(stub_glass.rgb, vec3(1.0))); }
#endif
const float NO_OCCLUDER = 1.0e9;
float sun_occluder(vec3 world) {
    vec3 d = stub_sun_direction.xyz;
    vec2 cross_place = world.xz - d.xz / d.y * (world.y - 4.0);
    if (stub_options.z == 4.0) {
        vec2 cell = floor(3.0 * cross_place);
        return (world.y - 6.0 * fract(43.7 * sin(dot(cell, vec2(12.9, 78.2))))) / d.y;
    }
    vec3 under = vec3(cross_place.x, 4.0, cross_place.y) + d * 1.0e-3;
    return sun_visibility(under, 0.0) > 0.5 ? -NO_OCCLUDER : (world.y - 4.0) / d.y;
}
float light_occluder(uint index, GpuLight light, vec3 world) {
    vec3 v = world - light.position_range.xyz;
    if (stub_options.z != 2.0) return light_visibility(index, light, world) > 0.5 ? -NO_OCCLUDER : length(v);
    float s = (-6.0 - light.position_range.z) / v.z;
    return s > 0.0 && light.position_range.x + s * v.x < 0.0 ? length(v) * (1.0 - s) : -NO_OCCLUDER;
}
)";

struct StubBlock {
    glm::vec4 sun_direction, sun_illuminance, ambient, options, glass;
};

Image as_rgb(const Image& image, int channel) {
    Image rgb(image.size, 3);
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            for (int c = 0; c < 3; ++c) rgb.at(x, y)[c] = image.at(x, y)[channel < 0 ? c : channel];
    return rgb;
}

/// Of all hosts.
const ShaderFolder& stub_folder() {
    static const ShaderFolder folder;
    return folder;
}

}  // namespace

ShaderFolder::ShaderFolder() {
    static int count = 0;
    path_ = fs::temp_directory_path() /
            ("tyndall_stub_host_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path_ / "shaders/interface");
    write_text(path_ / "shaders/interface/lights.glsl", lights_glsl);
    write_text(path_ / "shaders/interface/shadows.glsl", shadows_glsl);
    write_text(path_ / "shaders/interface/shadow_maps.glsl", shadow_maps_glsl);
}

ShaderFolder::~ShaderFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

StubHost::StubHost() : volumetrics_(shared_shaders(stub_folder().roots())) {}

glm::mat4 StubHost::projection() const {
    const float f = 1 / std::tan(0.5F * vertical_fov);
    glm::mat4 p(0);
    p[0][0] = f * static_cast<float>(size.y) / static_cast<float>(size.x);
    p[1][1] = f;
    p[2][3] = -1;
    p[3][2] = znear;
    return p;
}

glm::vec3 StubHost::ray(int x, int y) const {
    const glm::vec2 ndc = 2.0F * (glm::vec2(x, y) + 0.5F) / glm::vec2(size) - 1.0F;
    const glm::mat4 p = projection();
    return rotation * glm::normalize(glm::vec3(ndc.x / p[0][0], ndc.y / p[1][1], -1));
}

void StubHost::upload() {
    const StubBlock block{glm::vec4(sun_direction, 0), glm::vec4(sun_illuminance, 0), glm::vec4(ambient, 0),
                          glm::vec4(slices, slice_depth, shadows, 0), glm::vec4(glass.value_or(glm::vec3(1)), 0)};
    uniforms_.assign(std::span(&block, 1), "stub host uniforms");
    std::vector<shared::GpuLight> listed_lights = lights;
    for (shared::GpuLight& light : listed_lights) light.cone_shadow.w = glass ? 1.0F : 0.0F;
    lights_.assign(std::span<const shared::GpuLight>(listed_lights), "stub host lights");
    std::vector<shared::ClusterRange> ranges;
    std::vector<std::uint32_t> list;
    for (int slice = 0; slice < slices; ++slice) {
        const auto first = static_cast<std::uint32_t>(list.size());
        for (int light = 0; light < static_cast<int>(lights.size()); ++light)
            if (listed(light, slice)) list.push_back(static_cast<std::uint32_t>(light));
        ranges.push_back({first, static_cast<std::uint32_t>(list.size()) - first});
    }
    ranges_.assign(std::span<const shared::ClusterRange>(ranges), "stub host ranges");
    list_.assign(std::span<const std::uint32_t>(list), "stub host list");

    std::vector<float> depths;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const float depth = view_depth(x, y);
            depths.push_back(depth == sky ? 0.0F : znear / depth);
        }
    const gl::TextureDesc desc{.format = GL_DEPTH_COMPONENT32F, .size = {size, 1}};
    if (!depth_ || !(depth_.desc() == desc)) depth_ = gl::Texture(desc, "stub host depth");
    depth_.upload(0, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
}

Inputs StubHost::inputs(PassList& passes) {
    upload();
    Inputs in;
    in.view = glm::translate(glm::mat4(glm::transpose(rotation)), -eye);
    in.projection = projection();
    in.eye = eye;
    in.znear = znear;
    in.size = size;
    in.depth = passes.import("depth", depth_);
    in.global = global;
    in.local = local;
    in.has_sun = has_sun;
    in.sun_direction = sun_direction;
    in.has_lamps = !lights.empty();
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const shared::GpuLight& light = lights[i];
        const bool spot = light.direction_type.w == LIGHT_SPOT;
        in.lamps.push_back(
            {.index = static_cast<std::uint32_t>(i),
             .position = light.position_range,
             .range = light.position_range.w,
             .axis = light.direction_type,
             .cos_outer = spot ? -light.cone_shadow.y / light.cone_shadow.x : -1.0F,
             .intensity = (light.intensity_radius.r + light.intensity_radius.g + light.intensity_radius.b) / 3});
    }
    in.has_ambient = ambient != glm::vec3(0);
    in.bind_lighting = [this] {
        uniforms_.bind(GL_UNIFORM_BUFFER, BINDING_FRAME);
        lights_.bind(GL_SHADER_STORAGE_BUFFER, 3);
        ranges_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_CLUSTERS);
        list_.bind(GL_SHADER_STORAGE_BUFFER, BINDING_CLUSTER_LIGHTS);
    };
    in.has_shadow_maps = has_shadow_maps;
    in.sun_shadow = sun_shadow;
    in.sun_through_glass = glass && (glass_of & GLASS_SUN) != 0;
    for (volumetrics::Lamp& lamp : in.lamps) lamp.through_glass = glass && (glass_of & GLASS_LAMPS) != 0;
    in.count_work = count_work;
    in.frame_index = frame_index;
    return in;
}

Frame StubHost::render(const Settings& settings) {
    PassList passes;
    const Inputs in = inputs(passes);
    volumetrics_.prepare(in, settings);
    const volumetrics::Outputs out = volumetrics_.add_passes(passes, in, settings);
    if (out.scattering) passes.export_texture(out.scattering);
    if (out.transmittance) passes.export_texture(out.transmittance);
    passes.compile();
    gl::WorkCounters counters;
    gl::GpuTimer timer(gl::TimerMode::finish);
    if (count_work) counters.begin_frame();
    timer.begin_frame();
    passes.execute(pool_, &timer, count_work ? &counters : nullptr);
    timer.begin_frame();

    Frame frame;
    frame.live_passes = passes.live_pass_names();
    for (const PassList::PassInfo& pass : passes.passes())
        if (!pass.live) frame.skipped[pass.name] = pass.reason;
    for (const gl::GpuTimer::Scope& scope : timer.results()) frame.milliseconds[scope.name] = scope.gpu_ms;
    if (count_work)
        for (const auto& [name, counts] : counters.read()) frame.work[name] = counts;
    frame.persistent_bytes = volumetrics_.persistent_bytes();
    const auto read = [&](TextureRef ref) {
        const PassList::TextureInfo info = passes.info(ref);
        return gl::read_texture(gl::TextureView(info.id, info.desc));
    };
    if (out.scattering) {
        frame.scattering = read(out.scattering);
        frame.transmittance = out.transmittance ? as_rgb(read(out.transmittance), -1) : as_rgb(frame.scattering, 3);
    }
    return frame;
}

Settings plain_settings(int steps) {
    Settings settings;
    settings.technique = "ray_march";
    settings.march.steps = steps;
    settings.noise.kind = volumetrics::Noise::none;
    settings.filter.kernel = volumetrics::Filter::none;
    settings.temporal.mode = volumetrics::Temporal::off;
    settings.froxels.pixels = 0;
    return settings;
}

shared::GpuLight point_light(glm::vec3 position, float intensity, float range, float radius) {
    return {.position_range = {position, range},
            .intensity_radius = {glm::vec3(intensity), radius},
            .direction_type = {0, -1, 0, LIGHT_POINT},
            .cone_shadow = {0, 1, 0, 0}};
}

shared::GpuLight spot_light(glm::vec3 position, glm::vec3 direction, float intensity, float cos_inner,
                            float cos_outer, float range) {
    const float scale = 1 / std::max(0.001F * (1 - cos_outer), cos_inner - cos_outer);
    return {.position_range = {position, range},
            .intensity_radius = {glm::vec3(intensity), 0.01F},
            .direction_type = {glm::normalize(direction), LIGHT_SPOT},
            .cone_shadow = {scale, -cos_outer * scale, 0, 0}};
}

double phase_hg(double g, double cos_theta) {
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cos_theta, 1.5));
}

}  // namespace tyndall::test
