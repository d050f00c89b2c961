#include "passes.h"

namespace tyndall::volumetrics {

Outputs add_analytic_fog(PassList&, PassResources&, const Inputs&, const Settings&, const FrameMedia&) {
    return {};
}

}  // namespace tyndall::volumetrics
