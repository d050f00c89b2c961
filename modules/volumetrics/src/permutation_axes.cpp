#include "passes.h"

namespace tyndall::volumetrics {

int height_media_axis(const FrameMedia& media) {
    const int heights = static_cast<int>(media.data.counts.x);
    return heights > 1 || (heights == 0 && media.rayleigh) ? MAX_HEIGHT_MEDIA : heights;
}

int rayleigh_axis(const FrameMedia& media, bool lit) {
    return media.rayleigh && lit ? 1 : 0;
}

bool is_rayleigh_permutation(const Permutation& permutation) {
    const auto value = [&](const char* axis, int without) {
        const auto found = permutation.find(axis);
        return found == permutation.end() ? without : found->second;
    };
    if (value("RAYLEIGH", 0) == 0) return true;
    const bool knows_lights = permutation.contains("HAS_SUN") || permutation.contains("LAMPS");
    const bool lit = !knows_lights || value("HAS_SUN", 0) != 0 || value("LAMPS", 0) != 0;
    return lit && value("HEIGHT_MEDIA", 1) != 0 && value("CHROMATIC", 1) != 0;
}

}  // namespace tyndall::volumetrics
