#pragma once

#include <algorithm>
#include <cmath>

#include "engine/core/image.h"

namespace tyndall::test {

/// The largest difference of a picture from one that it must equal, relative to the latter. A pixel may be as any
/// that lies beside it there, as edges may fall to either side. Not finite where the picture is not.
inline double worst_error(const Image& picture, const Image& expected) {
    double worst = 0;
    const glm::ivec2 last = expected.size - 1;
    for (int y = 0; y <= last.y; ++y)
        for (int x = 0; x <= last.x; ++x)
            for (int c = 0; c < expected.channels; ++c) {
                double low = HUGE_VAL, high = 0;
                for (int j = std::max(y - 1, 0); j <= std::min(y + 1, last.y); ++j)
                    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, last.x); ++i) {
                        low = std::min<double>(low, expected.at(i, j)[c]);
                        high = std::max<double>(high, expected.at(i, j)[c]);
                    }
                const double value = picture.at(x, y)[c];
                if (!std::isfinite(value)) return HUGE_VAL;
                worst = std::max(worst, std::max({low - value, value - high, 0.0}) / std::max(high, 0.01));
            }
    return worst;
}

}  // namespace tyndall::test
