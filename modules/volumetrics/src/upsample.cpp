#include "reconstruction.h"

namespace tyndall::volumetrics {

Outputs add_upsample(PassList&, const PassResources&, const Inputs&, const Inputs&, const Settings&,
                     const Outputs& source) {
    return source;
}

}  // namespace tyndall::volumetrics
