// The level's materials: names, texel density and the textures painted for them.
#pragma once

#include "tools/modeling/materials.h"

namespace tyndall::level {

using namespace modeling;

struct Mat : Surface {
    static const Mat Ashlar, Trim, Rubble, Flags, Cobbles, Plaster, Timber, Planks, Slate, Clay, Grass, Rock, Hills,
        Bark, Leaves, Iron, ClothRed, ClothBlue, ClothOchre, Lantern, Paper, Window, Water, Glass, Pond, Stained;
};
inline constexpr Mat Mat::Ashlar{{0, 2.4f}};
inline constexpr Mat Mat::Trim{{1, 1.5f}};
inline constexpr Mat Mat::Rubble{{2, 2.0f}};
inline constexpr Mat Mat::Flags{{3, 3.0f}};
inline constexpr Mat Mat::Cobbles{{4, 2.0f}};
inline constexpr Mat Mat::Plaster{{5, 3.0f}};
inline constexpr Mat Mat::Timber{{6, 1.0f}};
inline constexpr Mat Mat::Planks{{7, 1.2f}};
inline constexpr Mat Mat::Slate{{8, 2.0f}};
inline constexpr Mat Mat::Clay{{9, 2.0f}};
inline constexpr Mat Mat::Grass{{10, 4.0f}};
inline constexpr Mat Mat::Rock{{11, 8.0f}};
inline constexpr Mat Mat::Hills{{12, 90.0f}};
inline constexpr Mat Mat::Bark{{13, 1.2f}};
inline constexpr Mat Mat::Leaves{{14, 1.0f}};
inline constexpr Mat Mat::Iron{{15, 0.6f}};
inline constexpr Mat Mat::ClothRed{{16, 0.5f}};
inline constexpr Mat Mat::ClothBlue{{17, 0.5f}};
inline constexpr Mat Mat::ClothOchre{{18, 0.5f}};
inline constexpr Mat Mat::Lantern{{19, 1.0f}};
inline constexpr Mat Mat::Paper{{20, 1.0f}};
inline constexpr Mat Mat::Window{{21, 0.8f}};
inline constexpr Mat Mat::Water{{22, 3.0f}};
inline constexpr Mat Mat::Glass{{23, 1.0f}};
inline constexpr Mat Mat::Pond{{24, 1.5f}};
inline constexpr Mat Mat::Stained{{25, 1.0f}};

// In the order of Mat.
MaterialSet make_materials();

}  // namespace tyndall::level
