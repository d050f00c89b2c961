#include <array>
#include <set>

#include "engine/scene/gltf_parts.h"

namespace tyndall::gltf {
namespace {

constexpr float farthest = 1e6f;   // m, m/s, m/s²
constexpr float brightest = 1e6f;  // cd/m²

/// The members of extras.particles. What is not given keeps its default.
class Members {
  public:
    Members(const GltfFile& file, const Json& json, std::string what)
        : file_(file), json_(json), what_(std::move(what)) {
        if (!json.is_object()) file.fail("{}: an object expected", what_);
        const std::set<std::string> known{"count",        "lifetime", "size",  "growth",  "extent",   "velocity",
                                          "acceleration", "spread",   "color", "opacity", "emission", "seed"};
        for (const auto& [key, value] : json.items())
            if (!known.contains(key)) file.fail("{}.{}: not known", what_, one_line(key));
    }
    void read(const char* key, float& value, float min, float max) const {
        if (json_.contains(key)) value = number(json_[key], key, min, max);
    }
    void read(const char* key, int& value, int min, int max) const {
        if (!json_.contains(key)) return;
        const Json& given = json_[key];
        if (!given.is_number_integer() || given.get<double>() < min || given.get<double>() > max)
            file_.fail("{}.{}: {} given, a whole number from {} to {} expected", what_, key, one_line(given.dump()),
                       min, max);
        value = given.get<int>();
    }
    void read(const char* key, glm::vec3& value, float min, float max) const {
        if (!json_.contains(key)) return;
        const Json& given = json_[key];
        if (!given.is_array() || given.size() != 3)
            file_.fail("{}.{}: {} given, three numbers expected", what_, key, one_line(given.dump()));
        for (int axis = 0; axis < 3; ++axis)
            value[axis] = number(given[static_cast<std::size_t>(axis)], key, min, max);
    }

  private:
    [[nodiscard]] float number(const Json& given, const char* key, float min, float max) const {
        if (!given.is_number() || !(given.get<double>() >= min && given.get<double>() <= max))
            file_.fail("{}.{}: {} given, a number from {} to {} expected", what_, key, one_line(given.dump()), min,
                       max);
        return given.get<float>();
    }
    const GltfFile& file_;
    const Json& json_;
    std::string what_;
};

}  // namespace

void load_particles(const GltfFile& file, const Json& extras, int node, Scene& scene, const std::string& what) {
    if (!extras.contains("particles")) return;
    const Members members(file, extras["particles"], what + ": extras.particles");
    ParticleEmitter emitter;
    emitter.node = node;
    members.read("count", emitter.count, 1, ParticleEmitter::most);
    members.read("lifetime", emitter.lifetime, 0.01f, 1e4f);
    members.read("size", emitter.size, 1e-3f, farthest);
    members.read("growth", emitter.growth, 0, farthest);
    members.read("extent", emitter.extent, 0, farthest);
    members.read("velocity", emitter.velocity, -farthest, farthest);
    members.read("acceleration", emitter.acceleration, -farthest, farthest);
    members.read("spread", emitter.spread, 0, farthest);
    members.read("color", emitter.color, 0, 1);
    members.read("opacity", emitter.opacity, 0, 1);
    members.read("emission", emitter.emission, 0, brightest);
    members.read("seed", emitter.seed, 0, 1 << 30);
    scene.emitters.push_back(emitter);
}

}  // namespace tyndall::gltf
