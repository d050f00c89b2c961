#include "temporal.h"

#include "reconstruction.h"

namespace tyndall::volumetrics {

Outputs add_temporal(PassList&, const PassResources&, const Inputs&, const Settings&, const Outputs& source,
                     TemporalHistory&) {
    return source;
}

}  // namespace tyndall::volumetrics
