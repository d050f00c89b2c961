#include "tools/modeling/media.h"

namespace tyndall::modeling {

using nlohmann::json;

namespace {

json triple(float x) {
    return {x, x, x};
}
json point(vec3 v) {
    return {v.x, v.y, v.z};
}

json medium(const char* shape, const Coefficients& c) {
    return {{"shape", shape},
            {"scattering", triple(c.scattering)},
            {"absorption", triple(c.absorption)},
            {"anisotropy", c.anisotropy},
            {"emission", triple(0.0f)}};
}

}  // namespace

json global_medium(const Coefficients& c) {
    return medium("global", c);
}

json height_medium(const Coefficients& c, float base, float falloff) {
    json m = medium("height", c);
    m["base"] = base;
    m["falloff"] = falloff;
    return m;
}

json box_medium(const Coefficients& c, vec3 center, vec3 size, float softness) {
    json m = medium("box", c);
    m["center"] = point(center);
    m["size"] = point(size);
    m["rotation"] = {0.0f, 0.0f, 0.0f, 1.0f};
    m["softness"] = softness;
    return m;
}

json ellipsoid_medium(const Coefficients& c, vec3 center, vec3 radii, float softness) {
    json m = medium("ellipsoid", c);
    m["center"] = point(center);
    m["radii"] = point(radii);
    m["softness"] = softness;
    return m;
}

json medium_noise(float scale, float amount, int seed) {
    return {{"scale", scale}, {"amount", amount}, {"seed", seed}};
}

}  // namespace tyndall::modeling
