#include "passes.h"

namespace tyndall::volumetrics {

Outputs add_radial_shafts(PassList&, PassResources&, const Inputs&, const Settings&, const FrameMedia&) {
    return {};
}

}  // namespace tyndall::volumetrics
