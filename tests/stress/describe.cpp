#include "describe.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "draw_scene.h"
#include "engine/core/error.h"

namespace tyndall::stress {
namespace {

std::string text(glm::vec3 v) {
    return fmt::format("({:.7g}, {:.7g}, {:.7g})", v.x, v.y, v.z);
}

std::string text(const StressFrame::Lamp& lamp) {
    static constexpr const char* types[] = {"sun", "point", "spot"};
    const Light& light = lamp.light;
    return fmt::format("  {} {} range {:.7g} radius {:.7g} cone {:.7g} to {:.7g} at {} towards {}{}\n",
                       types[static_cast<int>(light.type)], text(light.intensity), light.range, light.radius,
                       light.inner_cone, light.outer_cone, text(lamp.pose[3]), text(-lamp.pose[2]),
                       light.shadow ? ", shadows" : "");
}

std::string text(const Medium& medium) {
    std::string line =
        fmt::format("  {} scattering {} absorption {} g {:.7g} emission {}", name_of(medium.shape),
                    text(medium.sigma_s), text(medium.sigma_a), medium.anisotropy, text(medium.emission));
    if (medium.height_profile) line += fmt::format(" base {:.7g} falloff {:.7g}", medium.base, medium.falloff);
    if (is_bounded(medium))
        line += fmt::format(" at {} half extent {} softness {:.7g} noise {:.7g} of {:.7g} m", text(medium.center),
                            text(medium.half_extent), medium.softness, medium.noise_amount, medium.noise_scale);
    return line + "\n";
}

nlohmann::json settings_of(const StressFrame& frame) {
    StressOptions options = frame.options;
    SettingsSet settings;
    settings.add(volumetrics::settings_table(), &options.volumetrics);
    settings.add(render_settings_table(), &options.render);
    return settings.to_json();
}

}  // namespace

std::string describe(const StressFrame& frame) {
    static constexpr const char* worlds[] = {"nothing", "standing", "moving"};
    const View& view = frame.view;
    const glm::vec3 forward = -glm::vec3(view.view[0][2], view.view[1][2], view.view[2][2]);
    std::string all = fmt::format("  {}x{}, objects: {}, eye {} looks along {}, fov {:.7g}, near {:.7g}\n",
                                  frame.size.x, frame.size.y, worlds[static_cast<int>(frame.world)], text(view.eye),
                                  text(forward), glm::degrees(view.yfov), view.znear);
    for (const auto& light : frame.lights) all += text(light);
    for (const Medium& medium : frame.media) all += text(medium);
    return all + "  " + settings_of(frame).dump() + "\n";
}

bool has(const StressFrame& frame, std::string_view condition) {
    static constexpr const char* features[] = {"plain", "filter", "history", "low_resolution"};
    nlohmann::json values = settings_of(frame);
    values["feature"] = frame.comparable ? features[static_cast<int>(frame.feature)] : "extreme";
    const std::size_t equals = condition.find('=');
    const auto found = values.find(condition.substr(0, equals));
    if (equals == condition.npos || found == values.end())
        throw Error(fmt::format("--where {}: KEY=VALUE expected, KEY a setting or feature", condition));
    const std::string_view value = condition.substr(equals + 1);
    return found->is_string() ? found->get<std::string>() == value : found->dump() == value;
}

}  // namespace tyndall::stress
