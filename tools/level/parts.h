// The parts that the level is put together from, one source file each.
#pragma once

#include "tools/level/level.h"

namespace tyndall::level {

// Meshes of the things that give light; every lamp of a kind is an instance.
struct Lamps {
    int lantern, paper_red, paper_ochre, bracket, post, candles, candle_stand, brazier, embers;
};
Lamps make_lamps(Level& level);
// `hook` is the point the lamp hangs from.
void hang_lantern(Level& level, const Lamps& lamps, vec3 hook, float candela, float yaw = 0.0f, bool shadow = true);
void hang_paper(Level& level, const Lamps& lamps, vec3 hook, float candela, int colour, bool shadow = true);
// `at` lies on the wall, `yaw` turns the arm from +Z.
void wall_lantern(Level& level, const Lamps& lamps, vec3 at, float yaw, float candela, bool shadow = true);
void post_lantern(Level& level, const Lamps& lamps, vec3 foot, float yaw, float candela);
void floor_lantern(Level& level, const Lamps& lamps, vec3 foot, float candela, bool shadow = true);
void candle_stand(Level& level, const Lamps& lamps, vec3 foot, float candela);
void brazier(Level& level, const Lamps& lamps, vec3 foot, float candela, bool shadow = true);

struct Props {
    int barrel, crate, stall_red, stall_blue, stall_ochre, banner_red, banner_blue, tuft, ivy, block, bench,
        baluster, urn;
};
Props make_props(Level& level);

void add_sun(Level& level);
void add_terrain(Level& level);
void add_abbey(Level& level, const Lamps& lamps, const Props& props);
void add_abbey_details(Level& level, const Lamps& lamps, const Props& props);
void add_cloister(Level& level, const Lamps& lamps, const Props& props);
void add_glasshouse(Level& level, const Lamps& lamps, const Props& props);
void add_street(Level& level, const Lamps& lamps, const Props& props);
void add_tree(Level& level);
void add_media(Level& level);
void add_cameras(Level& level);

// Houses: front towards +Z at z = 0, ground at y = 0, foundations below.
struct HouseStyle {
    float width, depth;
    int upper_floors;
    bool gable_front;
    Mat roof, ground;
    uint32_t seed;
};
Mesh make_house(const HouseStyle& style);

// Height of the paving in the village street at x (m).
float street_height(float x);

}  // namespace tyndall::level
