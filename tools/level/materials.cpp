#include "tools/level/materials.h"

#include "tools/level/texture.h"

namespace tyndall::level {

using glm::vec2;
using glm::vec3;

namespace {

struct Set {
    MaterialSet out;

    Material& add(const std::string& name) {
        out.materials.push_back({});
        out.materials.back().name = name;
        return out.materials.back();
    }
    int image(EncodedImage encoded) {
        out.images.push_back(std::move(encoded));
        return static_cast<int>(out.images.size()) - 1;
    }
    // Albedo, normal and surface textures from one painter.
    Material& painted(const std::string& name, Mat mat, int size, const Painter& painter) {
        const Painted p = paint(size, painter);
        Material m;
        m.name = name;
        m.albedo = image(encode_albedo(p, name + "_albedo", 92));
        m.normal = image(encode_normal(p, name + "_normal", mat.tile_metres, 92));
        m.surface = image(encode_surface(p, name + "_surface", 82));
        m.metallic = 1.0f;
        out.materials.push_back(m);
        return out.materials.back();
    }
};

}  // namespace

MaterialSet make_materials() {
    Set set;
    const Masonry ashlar(6, 3, 0.8f, 1), flags(5, 4, 0.9f, 2);
    set.painted("ashlar", Mat::Ashlar, 512, [&](vec2 uv) { return paint_ashlar(ashlar, uv); });
    set.painted("trim", Mat::Trim, 256, paint_trim);
    set.painted("rubble", Mat::Rubble, 512, paint_rubble);
    set.painted("flags", Mat::Flags, 512, [&](vec2 uv) { return paint_flags(flags, uv); });
    set.painted("cobbles", Mat::Cobbles, 512, paint_cobbles);
    set.painted("plaster", Mat::Plaster, 256, paint_plaster);
    set.painted("timber", Mat::Timber, 256, paint_timber);
    set.painted("planks", Mat::Planks, 256, paint_planks);
    set.painted("slate", Mat::Slate, 512, paint_slate);
    set.painted("clay", Mat::Clay, 512, paint_clay);
    set.painted("grass", Mat::Grass, 512, paint_grass);
    const Material rock = set.painted("rock", Mat::Rock, 512, paint_rock);
    Material& hills = set.add("hills");
    hills.albedo = rock.albedo;
    hills.base_color = {0.45f, 0.55f, 0.40f, 1.0f};
    set.painted("bark", Mat::Bark, 256, paint_bark);
    Material& leaves = set.add("leaves");
    leaves.albedo = set.image(encode_albedo_alpha(paint(256, paint_leaves), "leaves_albedo"));
    leaves.roughness = 0.95f;
    leaves.mask = leaves.double_sided = true;
    set.painted("iron", Mat::Iron, 128, paint_iron);
    const Painted weave = paint(256, paint_cloth);
    const int cloth = set.image(encode_albedo(weave, "cloth_albedo", 75));
    const int cloth_normal = set.image(encode_normal(weave, "cloth_normal", Mat::ClothRed.tile_metres, 80));
    auto dye = [&](const std::string& name, vec3 color) {
        Material& m = set.add(name);
        m.albedo = cloth;
        m.normal = cloth_normal;
        m.base_color = {color, 1.0f};
        m.roughness = 0.95f;
        m.double_sided = true;
    };
    dye("cloth_red", {0.42f, 0.045f, 0.04f});
    dye("cloth_blue", {0.05f, 0.11f, 0.30f});
    dye("cloth_ochre", {0.62f, 0.36f, 0.09f});
    auto glow = [&](const std::string& name, vec3 color, float strength) {
        Material& m = set.add(name);
        m.base_color = {color, 1.0f};
        m.emissive = color;
        m.emissive_strength = strength;
        m.roughness = 0.3f;
    };
    glow("lantern", {1.0f, 0.58f, 0.22f}, 100.0f);
    glow("paper", {1.0f, 0.33f, 0.09f}, 55.0f);
    Material& window = set.painted("window", Mat::Window, 256, paint_window);
    window.base_color = {0.25f, 0.25f, 0.25f, 1.0f};
    window.emissive = vec3(1.0f);
    window.emissive_strength = 32.0f;
    window.glow_from_albedo = true;
    Material& water = set.add("water");
    water.base_color = {0.02f, 0.03f, 0.03f, 1.0f};
    water.roughness = 0.06f;
    water.normal = set.image(encode_normal(paint(256, paint_water), "water_normal", Mat::Water.tile_metres, 86));
    const int ripples = water.normal;
    Material& glass = set.add("glass");  // old panes: greenish, a little dusty
    glass.base_color = {0.35f, 0.42f, 0.36f, 0.11f};
    glass.roughness = 0.08f;
    glass.blend = glass.double_sided = true;
    Material& pond = set.add("pond");
    pond.base_color = {0.02f, 0.045f, 0.04f, 0.6f};
    pond.roughness = 0.05f;
    pond.normal = ripples;
    pond.blend = true;
    Material& stained = set.add("stained_glass");
    stained.albedo = set.image(encode_albedo(paint(512, paint_stained_glass), "stained_glass_albedo", 92));
    stained.roughness = 0.15f;
    stained.transmission = 1.0f;
    stained.double_sided = true;
    return std::move(set.out);
}

}  // namespace tyndall::level
