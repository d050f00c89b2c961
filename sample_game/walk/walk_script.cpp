#include "sample_game/walk/walk_script.h"

#include "engine/core/files.h"
#include "engine/scene/json_field.h"

namespace tyndall {
namespace {

using Field = JsonField;

constexpr float apart = 1e-3f;  // m: eye and look

/// Each element of a list that has some.
template <class Parse>
auto list(const Field& field, bool may_be_empty, Parse parse) {
    if (!field.json.is_array() || (field.json.empty() && !may_be_empty))
        field.fail(may_be_empty ? "a list" : "a list with something in it");
    std::vector<decltype(parse(field))> items;
    for (std::size_t i = 0; i < field.json.size(); ++i)
        items.push_back(parse(Field{field.json[i], fmt::format("{}[{}]", field.where, i)}));
    return items;
}

std::vector<std::string> lines(const Field& field) {
    return list(field, false, [](const Field& line) { return line.text(); });
}

float seconds(const Field& field) {
    return field.number("a number from 1 to 3600", [](float v) { return v >= 1 && v <= 3600; });
}

WalkScript::View view(const Field& field) {
    field.require_object({"eye", "look", "words"});
    const WalkScript::View v{field.at("eye").vector<3>(&Field::place), field.at("look").vector<3>(&Field::place)};
    if (glm::distance(v.eye, v.look) < apart) field.fail("an eye apart from what it looks at");
    return v;
}

Aabb box(const Field& field) {
    field.require_object({"from", "to"});
    const Aabb b{field.at("from").vector<3>(&Field::place), field.at("to").vector<3>(&Field::place)};
    if (glm::any(glm::greaterThan(b.min, b.max))) field.fail("a \"from\" that is nowhere above \"to\"");
    return b;
}

WalkScript::Fog fog(const Field& field) {
    field.require_object({"medium", "before"});
    const Field medium = field.at("medium");
    if (!medium.json.is_number_unsigned()) medium.fail("a medium's number, from 0");
    return {medium.json.get<std::size_t>(),
            field.at("before").number("a number from 0 to 100", [](float v) { return v >= 0 && v <= 100; })};
}

WalkScript::Place place(const Field& field) {
    field.require_object({"name", "at", "reach", "lamps", "fog", "words", "hint"});
    WalkScript::Place p{.name = field.at("name").text(),
                        .at = field.at("at").vector<3>(&Field::place),
                        .reach = field.at("reach").size(),
                        .lamps = box(field.at("lamps")),
                        .fog = {},
                        .words = field.at("words").text(),
                        .hint = field.at("hint").text()};
    if (field.has("fog")) p.fog = list(field.at("fog"), true, fog);
    return p;
}

WalkScript::Lantern lantern(const Field& field) {
    field.require_object({"candela", "range", "color"});
    return {field.at("candela").coefficient(), field.at("range").size(),
            field.at("color").vector<3>(&Field::share)};
}

WalkScript::Night night(const Field& field) {
    field.require_object({"sun", "color", "exposure"});
    return {field.at("sun").share(), field.at("color").vector<3>(&Field::share),
            field.at("exposure").number("a number from -20 to 20", [](float v) { return v >= -20 && v <= 20; })};
}

}  // namespace

WalkScript parse_walk(const nlohmann::json& json, const std::string& where) {
    const Field field{json, where};
    field.require_object({"title", "beginning", "lantern", "night", "hint_after", "places", "end"});
    return {.title = view(field.at("title")),
            .title_words = field.at("title").at("words").text(),
            .beginning = lines(field.at("beginning")),
            .lantern = lantern(field.at("lantern")),
            .night = night(field.at("night")),
            .hint_after = seconds(field.at("hint_after")),
            .places = list(field.at("places"), false, place),
            .end = view(field.at("end")),
            .end_words = lines(field.at("end").at("words"))};
}

WalkScript load_walk(const std::filesystem::path& path) {
    return parse_walk(read_json(path), path.string());
}

std::filesystem::path walk_path(const std::filesystem::path& level) {
    return std::filesystem::path(level).replace_extension(".walk.json");
}

}  // namespace tyndall
