#include "techniques/techniques.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "engine/core/error.h"
#include "frame/settings_table.h"

namespace tyndall::volumetrics {
namespace {

struct Techniques {
    std::deque<TechniqueDesc> all;  // grows without moving what technique() gave out
    std::vector<std::string> names;

    void add(TechniqueDesc desc) {
        names.push_back(desc.name);
        all.push_back(std::move(desc));
    }
};

/// Off, and the order of the game's key V and of `tyndall list techniques`.
Techniques& techniques() {
    static Techniques list = [] {
        Techniques own;
        own.add(
            {.name = "off", .help = "No light in media; costs nothing.", .settings = "", .passes = {}, .add = {}});
        for (const auto make : {ray_march, froxel, billboards, particles, shaft_geometry, analytic_fog,
                                radial_shafts, epipolar, automatic, reference})
            own.add(make());
        return own;
    }();
    return list;
}

}  // namespace

const std::vector<std::string>& technique_names() {
    return techniques().names;
}

const TechniqueDesc& technique(std::string_view name) {
    const auto found = std::ranges::find(techniques().all, name, &TechniqueDesc::name);
    if (found == techniques().all.end())
        throw UsageError(
            fmt::format("technique '{}': expected one of {}", name, fmt::join(technique_names(), ", ")));
    return *found;
}

void register_technique(TechniqueDesc desc) {
    if (desc.name.empty()) throw Error("a technique without a name cannot be registered");
    if (std::ranges::count(technique_names(), desc.name) > 0)
        throw Error(fmt::format("technique '{}' is registered already", desc.name));
    growing_settings_table().add_choice("technique", desc.name);
    techniques().add(std::move(desc));
}

}  // namespace tyndall::volumetrics
