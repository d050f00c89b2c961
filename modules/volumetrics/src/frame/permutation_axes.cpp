#include "frame/passes.h"

namespace tyndall::volumetrics {

int height_media_axis(const FrameMedia& media) {
    const int heights = static_cast<int>(media.data.height_media_count);
    return heights > 1 ? MAX_HEIGHT_MEDIA : heights;
}

}  // namespace tyndall::volumetrics
