#include "engine/scene/scene_doubts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall {
namespace {

using Lines = std::vector<std::string>;

float brightest(const glm::vec3& rgb) {
    return std::max({rgb.r, rgb.g, rgb.b});
}

bool from_blender(const GltfNotes& notes) {
    return notes.generator.find("Blender") != std::string::npos;
}

/// The luminance (cd/m²) of a white surface that faces a light, 2 m from a lamp.
float lit_white(const Light& light) {
    constexpr float distance = 2;
    const float illuminance = brightest(light.intensity) / (light.type == LightType::sun ? 1 : distance * distance);
    return illuminance / std::numbers::pi_v<float>;
}

/// Of the light that is brightest there; 0 without lights.
float lit_white(const Scene& scene) {
    float most = 0;
    for (const Light& light : scene.lights) most = std::max(most, lit_white(light));
    return most;
}

void doubt_what_is_missing(const Scene& scene, const GltfNotes& notes, Lines& lines) {
    const bool blender = from_blender(notes);
    if (lit_white(scene) == 0)
        lines.push_back(fmt::format("no light: it is night, but for what surfaces and media emit{}",
                                    blender ? "; Blender exports lights where Punctual Lights is ticked" : ""));
    const bool orthographic = std::ranges::any_of(
        notes.left_out, [](const std::string& line) { return line.find("orthographic") != std::string::npos; });
    if (scene.cameras.empty())
        lines.push_back(
            fmt::format("no perspective camera: pictures show the whole scene from a place that is chosen{}",
                        blender && !orthographic ? "; Blender exports cameras where Cameras is ticked" : ""));
    if (scene.meshes.empty()) lines.push_back("no triangles: nothing but sky and fog is seen");
    if (!blender) return;
    if (scene.media.empty())
        lines.push_back(
            "no media: Blender exports custom properties, which hold fog, where Custom Properties is ticked");
    std::vector<bool> parent(scene.nodes.size());
    for (const Node& node : scene.nodes)
        if (node.parent >= 0) parent[static_cast<std::size_t>(node.parent)] = true;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.name.starts_with("Area") && node.meshes.empty() && node.light < 0 && node.camera < 0 && !parent[i])
            lines.push_back(fmt::format(
                "node \"{}\" is empty: Blender's exporter leaves area lights out, a spot may stand in for it",
                node.name));
    }
}

/// The first few names of lights that `is` true of, quoted.
std::string names_of(const Scene& scene, auto is) {
    constexpr std::size_t most = 3;
    Lines names;
    for (const Light& light : scene.lights)
        if (is(light)) names.push_back('"' + light.name + '"');
    const std::size_t more = names.size() - std::min(names.size(), most);
    names.resize(names.size() - more);
    std::string text = fmt::format("{}", fmt::join(names, ", "));
    if (more > 0) text += fmt::format(" and {} more", more);
    return text;
}

void doubt_units(const Scene& scene, const GltfNotes& notes, Lines& lines) {
    const char* hint =
        from_blender(notes) ? " Blender's exporter in Unitless leaves W, which is right where all light is so" : "";
    const std::string dim_lamps = names_of(scene, [](const Light& light) {
        const float cd = brightest(light.intensity);
        return light.type != LightType::sun && cd > 0 && cd < 5;
    });
    if (!dim_lamps.empty())
        lines.push_back(
            fmt::format("lamps of less than 5 cd: {}; a candle has 1 cd, a bulb of 60 W 60 cd; are they in cd?{}",
                        dim_lamps, hint));
    const std::string dim_suns = names_of(scene, [](const Light& light) {
        const float lux = brightest(light.intensity);
        return light.type == LightType::sun && lux >= 0.5f && lux < 100;
    });
    if (!dim_suns.empty())
        lines.push_back(fmt::format(
            "suns of less than 100 lx: {}; daylight has 1000 to 100000 lx, a full moon 0.3; are they in lx?{}",
            dim_suns, hint));
}

void doubt_exposure(const Scene& scene, const GltfNotes& notes, Lines& lines) {
    const float light = lit_white(scene);
    if (light == 0) return;
    const float suits = std::log2(light / 1.2f);
    const float off = suits - scene.exposure_ev100;
    // Authors who give one know of shade and of lamps that are far away.
    const float most = notes.exposure ? 10 : 5;
    if (std::abs(off) > most)
        lines.push_back(fmt::format(
            "exposure EV {:.1f}{} shows a white surface before the brightest light {:.0f} stops too {}; "
            "an \"exposure\" of {:.1f} in the extras of the scene would suit it",
            scene.exposure_ev100, notes.exposure ? "" : " (the file gives none)", std::abs(off),
            off > 0 ? "bright" : "dark", suits));
}

/// Blender's exporter in Standard units makes 683 lm of a watt of its lights, and leaves emission as it is.
void doubt_emission(const Scene& scene, const GltfNotes& notes, Lines& lines) {
    constexpr float lm_per_watt = 683;
    const float light = lit_white(scene);
    if (!from_blender(notes) || light < 4) return;  // of a lamp of 50 cd
    const Material* most = nullptr;
    for (const Material& material : scene.materials)
        if (brightest(material.emissive) > (most ? brightest(most->emissive) : 0)) most = &material;
    if (most == nullptr || brightest(most->emissive) > light / 20) return;
    const float emission = brightest(most->emissive);
    lines.push_back(
        fmt::format("material \"{}\" emits {:.3g} cd/m², nothing beside lights that make white surfaces {:.3g} "
                    "cd/m²: Blender's exporter in "
                    "Standard units makes 683 lm of a watt of light and none of emission; {:.3g} cd/m² meant? "
                    "Unitless keeps them alike",
                    most->name, emission, light, emission * lm_per_watt));
}

void doubt_fog(const Scene& scene, float far_end, Lines& lines) {
    if (scene.cameras.empty()) return;
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        const Medium& medium = scene.media[i];
        if (!is_bounded(medium)) continue;
        const Aabb box = world_bounds(medium);
        float nearest = HUGE_VALF;
        for (const Camera& camera : scene.cameras) {
            const glm::vec3 eye(scene.nodes[static_cast<std::size_t>(camera.node)].world[3]);
            nearest = std::min(nearest, glm::distance(eye, glm::clamp(eye, box.min, box.max)));
        }
        if (nearest > far_end)
            lines.push_back(
                fmt::format("medium {} ({}) begins {:.0f} m from the nearest camera, beyond the far end at {:g} m "
                            "(max_distance)",
                            i, name_of(medium.shape), nearest, far_end));
    }
}

}  // namespace

std::vector<std::string> likely_mistakes(const Scene& scene, const GltfNotes& notes, float far_end) {
    Lines lines;
    doubt_what_is_missing(scene, notes, lines);
    doubt_units(scene, notes, lines);
    doubt_exposure(scene, notes, lines);
    doubt_emission(scene, notes, lines);
    doubt_fog(scene, far_end, lines);
    lines.insert(lines.end(), notes.doubts.begin(), notes.doubts.end());
    return lines;
}

}  // namespace tyndall
