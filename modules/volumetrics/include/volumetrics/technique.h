#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "volumetrics/estimate.h"

namespace tyndall::volumetrics {

class Frame;

/// What the module has to know of a technique before it adds its passes.
struct TechniqueTraits {
    /// The most that its estimates have: per_pixel makes the noise, per_frame and per_pixel keep a mean over
    /// frames.
    Sampling sampling = Sampling::exact;
    bool any_resolution = false;       ///< draws at Frame::size; else always at the host's resolution
    bool glass = true;                 ///< light takes the colours of glass; else it comes as through clear air
    bool local_media = true;           ///< sees local media; else only those that fill space
    bool unseen_local_media = false;   ///< wants them also where only light on its way passes through them
    bool needs_global_medium = false;  ///< adds nothing without one
    bool interactive = true;           ///< else a frame may take minutes: nobody should come to it by chance
};

/// A technique: one row of techniques(), one file of src/techniques.
struct TechniqueDesc {
    std::string name;      ///< value of the setting technique, snake_case
    std::string help;      ///< one line: how, and what it leaves out
    std::string settings;  ///< its own settings' keys begin so; empty: it has none
    /// All passes that it may add, but for those of reconstruction: a frame's list says of each why it is not
    /// there.
    std::vector<std::string> passes;
    TechniqueTraits traits = {};
    /// Called once a frame, with a medium in view. Adds passes; empty: adds nothing.
    std::function<Estimate(Frame&)> add;
};

/// In the order they were registered; the module's own come first.
[[nodiscard]] const std::vector<std::string>& technique_names();
/// Valid for ever. Throws UsageError that lists the names.
[[nodiscard]] const TechniqueDesc& technique(std::string_view name);
/// Adds a technique of the host's own: from then on a value of the setting `technique` like all others. Throws
/// Error if the name is empty or taken.
void register_technique(TechniqueDesc desc);

}  // namespace tyndall::volumetrics
