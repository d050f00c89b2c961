#include "engine/scene/medium.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/scene/json_field.h"

namespace tyndall {
namespace {

using Json = nlohmann::json;

using Field = JsonField;

/// What a media file says of a shape.
struct ShapeRow {
    std::string_view name;
    Medium::Shape shape;
    std::vector<std::string_view> own_keys;
    const char* extent = nullptr;  ///< key of its size; none: fills space
    glm::vec3 (*half_extent)(const Field& extent) = nullptr;
};

const ShapeRow shapes[] = {
    {"global", Medium::Shape::global, {"phase"}},
    {"height", Medium::Shape::height, {"phase", "base", "falloff"}},
    {"sphere", Medium::Shape::sphere, {}, "radius", [](const Field& field) { return glm::vec3(field.size()); }},
    {"ellipsoid",
     Medium::Shape::ellipsoid,
     {},
     "radii",
     [](const Field& field) { return field.vector<3>(&Field::size); }},
    {"box",
     Medium::Shape::box,
     {},
     "size",
     [](const Field& field) { return field.vector<3>(&Field::size) * 0.5f; }},
    {"grid",
     Medium::Shape::grid,
     {"file", "grid", "translation", "rotation", "scale", "density", "sampling", "wind"}}};

/// What a list of media has read, by file and name.
struct GridFiles {
    std::filesystem::path folder;
    std::map<std::pair<std::filesystem::path, std::string>, std::shared_ptr<const DensityGrid>> read = {};
};

const ShapeRow& parse_shape(const Field& medium) {
    const Field field = medium.at("shape");
    for (const ShapeRow& row : shapes)
        if (field.json == row.name) return row;
    std::vector<std::string_view> names;
    for (const ShapeRow& row : shapes) names.push_back(row.name);
    field.fail(fmt::format("one of {}", fmt::join(names, ", ")));
}

void require_known_keys(const Field& field, const ShapeRow& shape) {
    std::vector<std::string_view> keys{"shape",      "scattering", "absorption", "albedo",
                                       "extinction", "anisotropy", "emission"};
    keys.insert(keys.end(), shape.own_keys.begin(), shape.own_keys.end());
    if (shape.extent) keys.insert(keys.end(), {"center", shape.extent, "rotation", "softness", "noise", "height"});
    field.require_object(keys);
}

/// Scattering with or without absorption, or albedo with extinction.
void parse_coefficients(const Field& field, Medium& medium) {
    if (!field.has("albedo") && !field.has("extinction")) {
        medium.sigma_s = field.at("scattering").vector<3>(&Field::coefficient);
        if (field.has("absorption")) medium.sigma_a = field.at("absorption").vector<3>(&Field::coefficient);
        return;
    }
    for (const char* other : {"scattering", "absorption"})
        if (field.has(other))
            throw Error(
                fmt::format("{}.{}: given beside albedo or extinction; scattering and absorption, or albedo "
                            "and extinction expected",
                            field.where, other));
    const glm::vec3 albedo = field.at("albedo").vector<3>(&Field::share);
    const glm::vec3 extinction = field.at("extinction").vector<3>(&Field::coefficient);
    medium.sigma_s = albedo * extinction;
    medium.sigma_a = (1.0f - albedo) * extinction;
}

void parse_phase(const Field& field, Medium& medium) {
    if (field.json == "mie") return;
    if (field.json != "rayleigh") field.fail("one of mie, rayleigh");
    if (medium.anisotropy != 0) throw Error(field.where + ": rayleigh has no anisotropy, 0 or none expected");
    medium.rayleigh = true;
}

void parse_height_profile(const Field& field, Medium& medium) {
    medium.height_profile = true;
    medium.base = field.at("base").place();
    medium.falloff = field.at("falloff").size();
}

void parse_noise(const Field& field, Medium& medium) {
    field.require_object({"scale", "amount", "seed"});
    medium.noise_scale = field.at("scale").size();
    medium.noise_amount = field.at("amount").share();
    if (field.has("seed")) {
        const Field seed = field.at("seed");
        constexpr int largest = 1 << 24;  // exact in the shader's float
        if (!seed.json.is_number_integer() || seed.json < 0 || seed.json > largest)
            seed.fail(fmt::format("an integer in [0, {}]", largest));
        medium.noise_seed = seed.json.get<int>();
    }
}

void parse_bounded_shape(const Field& field, const ShapeRow& shape, Medium& medium) {
    medium.center = field.at("center").vector<3>(&Field::place);
    medium.half_extent = shape.half_extent(field.at(shape.extent));
    if (field.has("rotation")) medium.rotation = field.at("rotation").rotation();
    if (field.has("softness")) medium.softness = field.at("softness").width();
    if (field.has("noise")) parse_noise(field.at("noise"), medium);
    if (field.has("height")) {
        field.at("height").require_object({"base", "falloff"});
        parse_height_profile(field.at("height"), medium);
    }
}

std::shared_ptr<const DensityGrid> read_grid(const Field& field, GridFiles& files) {
    const Field file = field.at("file");
    const std::string name = field.has("grid") ? field.at("grid").text() : "density";
    const std::filesystem::path path = file.file_in(files.folder);
    auto& grid = files.read[{path, name}];
    if (grid) return grid;
    try {
        grid = load_density_grid(path, name);
    } catch (const Error& e) {
        throw Error(fmt::format("{}: {}", file.where, e.what()));
    }
    return grid;
}

/// What scale and density make of the grid's own numbers stays within the ranges of all media.
void require_grid_in_range(const Field& field, const Medium& medium) {
    const glm::dmat4 to_world = index_to_world(medium);
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = glm::length(glm::dvec3(to_world[axis]));
        if (!(edge >= 1e-6 && edge <= 1e9))
            throw Error(fmt::format("{}.scale: voxels of {:g} m, 1e-6 to 1e9 expected", field.where, edge));
    }
    if (medium.grid->empty()) return;
    const Aabb box = world_bounds(medium);
    const glm::vec3 most = glm::max(glm::abs(box.min), glm::abs(box.max));
    const float reach = std::max({most.x, most.y, most.z});
    if (!(reach <= 1e9F))
        throw Error(
            fmt::format("{}: the grid reaches {:g} m from the origin, at most 1e9 expected", field.where, reach));
    const double greatest = double{medium.density} * medium.grid->greatest;
    if (!(greatest <= 1e6))
        throw Error(fmt::format("{}.density: {:g} with the grid's greatest value, at most 1e6 expected",
                                field.where, greatest));
}

void parse_grid(const Field& field, GridFiles& files, Medium& medium) {
    if (field.has("translation")) medium.center = field.at("translation").vector<3>(&Field::place);
    medium.center_at_start = medium.center;
    if (field.has("rotation")) medium.rotation = field.at("rotation").rotation();
    if (field.has("scale")) medium.scale = field.at("scale").size();
    if (field.has("density")) medium.density = field.at("density").coefficient();
    if (field.has("sampling")) medium.nearest = field.at("sampling").choice({"linear", "nearest"}) == 1;
    if (field.has("wind")) medium.wind = field.at("wind").vector<3>(&Field::velocity);
    medium.grid = read_grid(field, files);
    require_grid_in_range(field, medium);
}

Medium parse_medium(const Field& field, GridFiles& files) {
    if (!field.json.is_object()) field.fail("an object");
    const ShapeRow& shape = parse_shape(field);
    Medium medium;
    medium.shape = shape.shape;
    if (is_bounded(medium) && field.has("phase"))
        throw Error(field.where + ".phase: only the shapes global and height have one");
    require_known_keys(field, shape);
    parse_coefficients(field, medium);
    if (field.has("emission")) medium.emission = field.at("emission").vector<3>(&Field::radiance);
    if (field.has("anisotropy"))
        medium.anisotropy =
            field.at("anisotropy").number("a number between -1 and 1", [](float v) { return v > -1 && v < 1; });
    if (field.has("phase")) parse_phase(field.at("phase"), medium);
    if (medium.shape == Medium::Shape::height) parse_height_profile(field, medium);
    if (medium.shape == Medium::Shape::grid)
        parse_grid(field, files, medium);
    else if (is_bounded(medium))
        parse_bounded_shape(field, shape, medium);
    return medium;
}

}  // namespace

std::string_view name_of(Medium::Shape shape) {
    return std::ranges::find(shapes, shape, &ShapeRow::shape)->name;
}

bool is_bounded(const Medium& medium) {
    return medium.shape != Medium::Shape::global && medium.shape != Medium::Shape::height;
}

glm::dmat4 index_to_world(const Medium& medium) {
    glm::dmat4 to_world = glm::mat4_cast(glm::normalize(glm::dquat(medium.rotation)));
    to_world *= glm::dmat4(glm::dmat3(double(medium.scale)));
    to_world[3] = glm::dvec4(medium.center, 1);
    return to_world * medium.grid->index_to_grid;
}

bool has_clouds(const std::vector<Medium>& media) {
    return std::ranges::any_of(media, [](const Medium& medium) {
        if (medium.shape != Medium::Shape::grid || medium.grid->empty()) return false;
        const Aabb bounds = world_bounds(medium);
        const glm::vec3 size = bounds.max - bounds.min;
        return std::max({size.x, size.y, size.z}) >= 100;
    });
}

Aabb world_bounds(const Medium& bounded) {
    if (bounded.shape == Medium::Shape::grid) {
        const glm::vec3 reach(bounded.nearest ? 0.5F : 1.0F);
        return transformed({glm::vec3(bounded.grid->lower) - reach, glm::vec3(bounded.grid->upper) + reach},
                           glm::mat4(index_to_world(bounded)));
    }
    glm::mat4 to_world = glm::mat4_cast(bounded.rotation);
    to_world[3] = glm::vec4(bounded.center, 1);
    return transformed({-bounded.half_extent, bounded.half_extent}, to_world);
}

std::vector<Medium> parse_media(const Json& json, const std::string& where, const std::filesystem::path& folder) {
    const Field root{json, where};
    if (json.is_object()) {
        if (json.contains("shape"))
            throw Error(where + ": one medium given, a list of media expected: put it in [ ]");
        root.require_object({"media"});
        if (!json.contains("media")) throw Error(where + ": \"media\" is missing");
    }
    const Json& list = json.is_object() ? json.at("media") : json;
    if (!list.is_array()) Field{list, where + ": media"}.fail("a list");
    GridFiles files{folder};
    std::vector<Medium> media;
    for (std::size_t i = 0; i < list.size(); ++i)
        media.push_back(parse_medium({list[i], fmt::format("{}: media[{}]", where, i)}, files));
    return media;
}

Medium parse_medium(const Json& json, const std::string& where, const std::filesystem::path& folder) {
    GridFiles files{folder};
    return parse_medium({json, where}, files);
}

std::vector<Medium> load_media(const std::filesystem::path& path) {
    return parse_media(read_json(path), path.string(), path.parent_path());
}

}  // namespace tyndall
