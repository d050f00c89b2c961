// The scenes of the benchmark, one function each, and the table of all.
#pragma once

#include <span>

#include "tools/modeling/scene.h"

namespace tyndall::bench_scenes {

using namespace modeling;

MaterialSet make_materials();

Scene slats_sun();
Scene slats_spot();
Scene teapot();
Scene depths();
Scene cube();
Scene ragged();
Scene lamps_open();
Scene lamps_shadowed();
Scene open_sun();
Scene sky_room();
Scene sky_court();
Scene sky_forest();
Scene sky_thin_wall();
Scene torture_posts();
Scene torture_slats();
Scene torture_lamp_at_eye();
Scene torture_lamp_behind_wall();
Scene torture_sky();
Scene torture_dense();
Scene torture_forward();
Scene torture_backward();

struct Entry {
    const char* name;
    Scene (*build)();
};
std::span<const Entry> all_scenes();

}  // namespace tyndall::bench_scenes
