// The abbey church: x from -44 (west, over the cliff) to 0 (portal), nave 9 m wide between arcades, aisles to z =
// +-9.5. Eight bays of 5.5 m, numbered from the portal. Bays 2 to 5 have lost their roofs.
#include <algorithm>

#include "tools/level/parts.h"
#include "tools/level/stained_glass.h"
#include "tools/level/wall.h"
#include "tools/modeling/random.h"

namespace tyndall::level {

namespace {

constexpr float kBay = 5.5f, kArcade = 4.6f, kAisle = 9.5f, kEave = 15.0f, kRidge = 21.0f;
constexpr int kBays = 8;

float bay_centre(int i) {
    return -kBay * (static_cast<float>(i) + 0.5f);
}
bool roofed(int i) {
    return i < 2 || i > 5;
}

Wall clerestory_wall() {
    return {{-kBay / 2, 8.0f, 0}, {1, 0, 0}, kBay, kEave - 8.0f, 0.9f, {}, {}, 0.55f};
}
Opening clerestory_window() {
    return pointed_opening(kBay / 2, 2.1f, 1.8f, 3.9f, 6, 0.9f);
}
Wall aisle_wall() {
    return {{-kBay / 2, 0, 0}, {1, 0, 0}, kBay, 7.0f, 0.8f, {}, {}, 0.6f, true};
}
Opening lancet() {
    return pointed_opening(kBay / 2, 2.5f, 1.7f, 4.2f, 5, 0.9f);
}

// One bay of the wall between nave and aisle; +Z is the nave. `ruin` breaks the top off.
Mesh arcade_bay(const std::string& name, bool ruin, uint32_t seed) {
    Mesh m{name, {}, mat4(1.0f)};
    Wall arcade{{-kBay / 2, 0, 0}, {1, 0, 0}, kBay, 8.0f, 0.9f, {}, {}, 0.8f, true};
    arcade.openings = {pointed_opening(kBay / 2, 4.0f, 0.0f, 4.2f, 6, 0.85f)};
    wall(m, Mat::Ashlar, arcade);
    Opening arch = arcade.openings[0];
    std::ranges::fill(arch.lower, 4.2f);  // mouldings only round the arch, not down the piers
    archivolt(m, Mat::Trim, arcade, arch, 0.42f, 0.10f, 1);
    archivolt(m, Mat::Trim, arcade, arch, 0.24f, 0.19f, 1, 0.03f);
    archivolt(m, Mat::Trim, arcade, arch, 0.36f, 0.10f, -1);
    Wall clerestory = clerestory_wall();
    if (ruin) {
        clerestory.top = [=](float u) {
            return 6.2f - 5.6f * fractal_noise(vec2(u * 0.8f, 0.5f), {0, 0}, 3, seed);
        };
    } else {
        clerestory.openings = {clerestory_window()};
    }
    wall(m, Mat::Ashlar, clerestory);
    if (!ruin) archivolt(m, Mat::Trim, clerestory, clerestory.openings[0], 0.26f, 0.10f, 1);
    sweep(m, Mat::Trim, std::array{vec3(-kBay / 2, 8.05f, 0.47f), vec3(kBay / 2, 8.05f, 0.47f)},
          chamfered_section(0.30f, 0.26f, 0.08f), {0, 1, 0});
    if (!ruin)
        sweep(m, Mat::Trim, std::array{vec3(-1.3f, 9.74f, 0), vec3(1.3f, 9.74f, 0)},
              chamfered_section(1.12f, 0.16f, 0.05f), {0, 1, 0});
    return m;
}

// Base, shafts and capitals that dress a pier; +Z is the nave. The nave shaft rises to carry the transverse arch.
Mesh pier_mesh() {
    Mesh m{"pier", {}, mat4(1.0f)};
    chamfered_box(m, Mat::Trim, {-0.98f, -0.1f, -0.72f}, {0.98f, 0.34f, 0.78f}, 0.06f);
    chamfered_box(m, Mat::Trim, {-0.88f, 0.3f, -0.60f}, {0.88f, 0.58f, 0.66f}, 0.05f);
    auto shaft = [&](float x, float z, float r, float top) {
        const std::array<vec2, 8> p{{{r + 0.10f, 0.57f},
                                     {r + 0.10f, 0.66f},
                                     {r, 0.80f},
                                     {r, top - 0.42f},
                                     {r + 0.05f, top - 0.38f},
                                     {r + 0.02f, top - 0.33f},
                                     {r + 0.17f, top - 0.06f},
                                     {r + 0.17f, top}}};
        lathe(m, Mat::Trim, {x, 0, z}, p, 8);
    };
    shaft(0.0f, 0.50f, 0.24f, 9.3f);
    shaft(0.0f, -0.48f, 0.20f, 4.3f);
    shaft(0.74f, 0.0f, 0.22f, 4.2f);
    shaft(-0.74f, 0.0f, 0.22f, 4.2f);
    chamfered_box(m, Mat::Trim, {-1.02f, 4.14f, -0.70f}, {1.02f, 4.36f, 0.56f}, 0.05f);
    return m;
}

// Pointed rib across the nave, in the plane x = 0; `upto` < 1 leaves broken stumps.
Mesh transverse_arch(const std::string& name, float upto, bool walled) {
    Mesh m{name, {}, mat4(1.0f)};
    const Opening o = pointed_opening(0.0f, 2 * (kArcade - 0.55f), 0.0f, 9.3f, 10, 0.42f);
    const auto n = o.us.size();
    const std::vector<vec2> section = chamfered_section(0.62f, 0.55f, 0.14f);
    auto run = [&](size_t from, size_t count, bool reverse) {
        std::vector<vec3> path;
        for (size_t i = 0; i < count; ++i) {
            const size_t k = reverse ? n - 1 - i : from + i;
            path.emplace_back(0.0f, o.upper[k], o.us[k]);
        }
        sweep(m, Mat::Trim, path, section, {1, 0, 0});
    };
    if (upto >= 1.0f) {
        run(0, n, false);
    }
    if (walled) {
        // The wall that the rib carries up to the roof.
        Wall diaphragm{{0, 9.0f, 4.15f}, {0, 0, -1}, 8.3f, 6.9f, 0.42f, {}, {}, 0.8f, true};
        diaphragm.top = [](float u) { return 6.4f + std::max(0.0f, 4.15f - std::abs(u - 4.15f)) * 1.02f; };
        Opening cut = o;
        for (size_t i = 0; i < n; ++i) {
            cut.us[i] += 4.15f;
            cut.lower[i] = 0.0f;
            cut.upper[i] -= 9.0f;
        }
        diaphragm.openings = {cut};
        wall(m, Mat::Ashlar, diaphragm);
    }
    if (upto < 1.0f) {
        const auto count = static_cast<size_t>(static_cast<float>(n / 2) * upto) + 2;
        run(0, count, false);
        run(0, count > 4 ? count - 2 : count, true);
    }
    return m;
}

// Outer wall of an aisle; +Z is outside. Sun comes in through the lancet.
Mesh aisle_bay(const std::string& name, bool door, bool ruined) {
    Mesh m{name, {}, mat4(1.0f)};
    Wall w = aisle_wall();
    w.openings = {door ? pointed_opening(kBay / 2, 1.5f, 0.0f, 1.75f, 5) : lancet()};
    if (ruined) {
        w.top = [](float u) {
            const float edge = std::min(u, kBay - u) < 0.02f ? 0.0f : 1.0f;
            return 7.0f - edge * 1.1f * fractal_noise(vec2(u * 1.3f, 8.0f), {0, 0}, 3, 31);
        };
    }
    wall(m, Mat::Ashlar, w);
    for (const float side : {1.0f, -1.0f}) archivolt(m, Mat::Trim, w, w.openings[0], 0.24f, 0.10f, side);
    if (!door) {  // sill, mullion and cusps
        chamfered_box(m, Mat::Trim, {-1.45f, 1.52f, -0.5f}, {1.45f, 1.73f, 0.52f}, 0.05f);
        sweep(m, Mat::Trim, std::array{vec3(0, 1.7f, 0), vec3(0, 5.0f, 0)}, chamfered_section(0.15f, 0.22f, 0.05f),
              {0, 0, 1});
        for (const float s : {-1.0f, 1.0f}) {
            const std::array<vec3, 4> cusp{
                {{s * 1.25f, 4.1f, 0}, {s * 1.05f, 4.8f, 0}, {s * 0.55f, 5.1f, 0}, {0, 4.4f, 0}}};
            sweep(m, Mat::Trim, cusp, chamfered_section(0.13f, 0.20f, 0.04f), {0, 0, 1});
        }
    }
    const auto string_course = [&](float from, float to) {
        sweep(m, Mat::Trim, std::array{vec3(from, 0.95f, 0.42f), vec3(to, 0.95f, 0.42f)},
              chamfered_section(0.22f, 0.22f, 0.07f), {0, 1, 0});
    };
    if (door) {  // it ends at the archivolt
        constexpr float jamb = 0.75f + 0.24f;
        string_course(-kBay / 2, -jamb);
        string_course(jamb, kBay / 2);
    } else {
        string_course(-kBay / 2, kBay / 2);
    }
    if (!ruined)
        sweep(m, Mat::Trim, std::array{vec3(-kBay / 2, 6.93f, 0.42f), vec3(kBay / 2, 6.93f, 0.42f)},
              chamfered_section(0.34f, 0.28f, 0.09f), {0, 1, 0});
    return m;
}

Mesh buttress_mesh() {  // against +Z wall face at z = 0.38; two set-offs
    Mesh m{"buttress", {}, mat4(1.0f)};
    auto stage = [&](float depth, float depth_above, float low, float high, float slope, float half) {
        const float z = 0.36f;
        box(m, Mat::Ashlar, {-half, low, z}, {half, high, z + depth}, kBack | kBottom | kTop);
        m.quad(Mat::Trim, {-half - 0.04f, high - 0.02f, z + depth + 0.08f},
               {half + 0.04f, high - 0.02f, z + depth + 0.08f}, {half + 0.04f, high + slope, z + depth_above},
               {-half - 0.04f, high + slope, z + depth_above});
        for (const float s : {-1.0f, 1.0f}) {
            const vec3 a(s * (half + 0.04f), high - 0.02f, z + depth + 0.08f),
                b(s * (half + 0.04f), high + slope, z + depth_above), c(s * (half + 0.04f), high - 0.02f, z);
            s > 0 ? m.polygon(Mat::Trim, std::array{a, c, b}) : m.polygon(Mat::Trim, std::array{c, a, b});
        }
        m.quad(Mat::Trim, {-half - 0.04f, high - 0.02f, z}, {half + 0.04f, high - 0.02f, z},
               {half + 0.04f, high - 0.02f, z + depth + 0.08f}, {-half - 0.04f, high - 0.02f, z + depth + 0.08f});
    };
    stage(1.5f, 1.0f, -8.0f, 2.2f, 0.75f, 0.55f);
    stage(1.0f, 0.0f, 2.1f, 5.3f, 1.3f, 0.48f);
    return m;
}

Mesh aisle_roof(bool whole) {  // lean-to over one bay; +Z is outside, z = 0 the outer wall's middle
    Mesh m{whole ? "aisle_roof" : "aisle_rafters", {}, mat4(1.0f)};
    const float x = kBay / 2, z0 = -(kAisle - kArcade) + 0.3f;
    if (whole) {
        slab(m, Mat::Slate, {-x, 6.9f, 0.85f}, {x, 6.9f, 0.85f}, {x, 9.35f, z0}, {-x, 9.35f, z0}, 0.22f,
             Mat::Planks);
    }
    for (int i = 0; i < 4; ++i) {
        if (!whole && i == 2) continue;
        const float c = -x + 0.7f + 1.37f * static_cast<float>(i);
        beam(m, Mat::Timber, {c, 6.58f, 0.3f}, {c, 8.98f, z0}, 0.16f, 0.20f);
    }
    return m;
}

Mesh nave_roof(bool whole) {  // over one bay, ridge along x
    Mesh m{whole ? "nave_roof" : "nave_rafters", {}, mat4(1.0f)};
    const float x = kBay / 2;
    if (whole) {
        gable_roof(m, Mat::Slate, Mat::Planks, {-x, kRidge + 0.3f, 0}, {x, kRidge + 0.3f, 0}, 5.7f, kEave - 0.35f,
                   0.22f);
        beam(m, Mat::Trim, {-x, kRidge + 0.3f, 0}, {x, kRidge + 0.3f, 0}, 0.3f, 0.2f);
    }
    for (int i = 0; i < 3; ++i) {
        if (!whole && i == 1) continue;
        const float c = -x + 0.92f + 1.83f * static_cast<float>(i);
        for (const float s : {-1.0f, 1.0f})
            beam(m, Mat::Timber, {c, kEave - 0.15f, s * 5.0f}, {c, kRidge - 0.12f, 0.06f * s}, 0.20f, 0.24f);
        beam(m, Mat::Timber, {c, 17.4f, -2.9f}, {c, 17.4f, 2.9f}, 0.18f, 0.22f);
    }
    for (const float s : {-1.0f, 1.0f})
        beam(m, Mat::Timber, {-x, kEave + 0.08f, s * 4.55f}, {x, kEave + 0.08f, s * 4.55f}, 0.3f, 0.22f);
    return m;
}

// The sun's side keeps its glass, but for the bays in ruins.
void glazing(Level& level) {
    using enum StainedGlass;
    constexpr StainedGlass order[kBays] = {Amber, Ruby, Cobalt, Ruby, Emerald, Cobalt, Amber, Ruby};
    int lancets[4], clerestories[4];
    for (const StainedGlass colour : {Ruby, Cobalt, Emerald, Amber}) {
        const auto i = static_cast<size_t>(colour);
        lancets[i] = level.add_mesh(stained_window("stained_lancet", aisle_wall(), lancet(), std::array{colour}));
        clerestories[i] = level.add_mesh(
            stained_window("stained_clerestory", clerestory_wall(), clerestory_window(), std::array{colour}));
    }
    for (int i = 0; i < kBays; ++i) {
        const float x = bay_centre(i);
        const bool ruined = i == 3 || i == 4, door = i == 2;
        const auto colour = static_cast<size_t>(order[i]), other = static_cast<size_t>(order[(i + 3) % kBays]);
        if (!ruined && !door) add_stained_window(level, lancets[colour], {x, 0, kAisle}, 0.0f);
        if (!ruined) add_stained_window(level, clerestories[other], {x, 0, kArcade}, 180.0f);
    }
}

void floors(Level& level) {
    Mesh m{"abbey_floor", {}, mat4(1.0f)};
    m.quad(Mat::Flags, {-44.2f, 0, kAisle + 0.2f}, {0.2f, 0, kAisle + 0.2f}, {0.2f, 0, -kAisle - 0.2f},
           {-44.2f, 0, -kAisle - 0.2f});
    // Foundations, seen from the court and the valley.
    for (const float s : {-1.0f, 1.0f}) {
        box(m, Mat::Ashlar, {-45.46f, -14.0f, std::min(s * 8.9f, s * 10.3f)},
            {0.4f, -0.02f, std::max(s * 8.9f, s * 10.3f)}, kBottom);
        sweep(m, Mat::Trim, std::array{vec3(-45.5f, -0.16f, s * 10.3f), vec3(0.3f, -0.16f, s * 10.3f)},
              chamfered_section(0.24f, 0.22f, 0.08f), {0, 1, 0});
    }
    box(m, Mat::Ashlar, {-46.3f, -18.0f, -10.5f}, {-44.0f, -0.03f, 10.5f}, kBottom);
    // Dais of the altar, three steps.
    for (int i = 0; i < 3; ++i) {
        const float in = 0.4f * static_cast<float>(i);
        chamfered_box(m, Mat::Trim, {-44.0f, -0.2f, -3.6f + in},
                      {-36.6f - in, 0.18f * static_cast<float>(i + 1), 3.6f - in}, 0.03f);
    }
    level.add_static(std::move(m));
}

}  // namespace

void add_abbey(Level& level, const Lamps& lamps, const Props& props) {
    floors(level);
    const int whole = level.add_mesh(arcade_bay("arcade_bay", false, 0)),
              ruin_a = level.add_mesh(arcade_bay("arcade_bay_ruin_a", true, 41)),
              ruin_b = level.add_mesh(arcade_bay("arcade_bay_ruin_b", true, 44));
    const int pier = level.add_mesh(pier_mesh()),
              arch = level.add_mesh(transverse_arch("transverse_arch", 1.0f, false)),
              walled = level.add_mesh(transverse_arch("transverse_arch_walled", 1.0f, true)),
              stump = level.add_mesh(transverse_arch("transverse_arch_stump", 0.5f, false));
    const int aisle = level.add_mesh(aisle_bay("aisle_bay", false, false)),
              aisle_ruin = level.add_mesh(aisle_bay("aisle_bay_ruin", false, true)),
              aisle_door = level.add_mesh(aisle_bay("aisle_bay_door", true, false)),
              buttress = level.add_mesh(buttress_mesh());
    const int lean_to = level.add_mesh(aisle_roof(true)), rafters = level.add_mesh(aisle_roof(false));
    const int roof = level.add_mesh(nave_roof(true)), roof_rafters = level.add_mesh(nave_roof(false));
    for (const float s : {-1.0f, 1.0f}) {
        const float in = s < 0 ? 0.0f : 180.0f, out = 180.0f - in;
        for (int i = 0; i < kBays; ++i) {
            const float x = bay_centre(i);
            const bool broken = s > 0 ? i == 3 || i == 4 : i == 3;
            level.add_instance("arcade", broken ? (i == 3 ? ruin_a : ruin_b) : whole, {x, 0, s * kArcade}, in);
            const bool open_aisle = s > 0 && (i == 3 || i == 4);
            level.add_instance("aisle_wall",
                               s > 0 && i == 2 ? aisle_door
                               : open_aisle    ? aisle_ruin
                                               : aisle,
                               {x, 0, s * kAisle}, out);
            level.add_instance("aisle_roof", open_aisle ? rafters : lean_to, {x, 0, s * kAisle}, out);
            if (i > 0) level.add_instance("pier", pier, {x + kBay / 2, 0, s * kArcade}, in);
            // The stair passage and the tower stand where buttresses would.
            if (i > 1 && !(s > 0 && (i == 3 || i == 4)))
                level.add_instance("buttress", buttress, {x + kBay / 2, 0, s * kAisle}, out);
        }
        level.add_instance("pier", pier, {-kBay * kBays, 0, s * kArcade}, in);
    }
    for (int i = 0; i < kBays; ++i) {
        if (roofed(i)) level.add_instance("nave_roof", roof, {bay_centre(i), 0, 0});
        if (i == 2 || i == 5) level.add_instance("nave_rafters", roof_rafters, {bay_centre(i), 0, 0});
        if (i > 0)
            level.add_instance("rib",
                               i == 4             ? stump
                               : i == 2 || i == 6 ? walled
                                                  : arch,
                               {-kBay * static_cast<float>(i), 0, 0});
    }
    glazing(level);
    add_abbey_details(level, lamps, props);
}

}  // namespace tyndall::level
