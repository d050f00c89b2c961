#include "reconstruction.h"

namespace tyndall::volumetrics {

Inputs add_depth_downsample(PassList& passes, const PassResources&, const Inputs& inputs, const Settings& settings) {
    if (settings.resolution == Resolution::full) passes.skip("volumetrics/depth_downsample", "resolution is full");
    return inputs;
}

}  // namespace tyndall::volumetrics
