#include "tools/level/level.h"

#include "tools/level/parts.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

vec3 to_sun() {
    constexpr float kElevation = 16.0f * kPi / 180.0f, kSouthOfWest = 42.0f * kPi / 180.0f;
    return {-cosine(kElevation) * cosine(kSouthOfWest), sine(kElevation), cosine(kElevation) * sine(kSouthOfWest)};
}

Level build_level() {
    Level level;
    level.name = "abbey";
    level.exposure = 5.9f;
    const Lamps lamps = make_lamps(level);
    const Props props = make_props(level);
    add_sun(level);
    add_terrain(level);
    add_abbey(level, lamps, props);
    add_cloister(level, lamps, props);
    add_street(level, lamps, props);
    add_tree(level);
    add_glasshouse(level, lamps, props);
    add_media(level);
    add_cameras(level);
    return level;
}

}  // namespace tyndall::level
