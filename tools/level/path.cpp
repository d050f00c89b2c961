#include "tools/level/path.h"

#include <cmath>

namespace tyndall::level {

namespace {

constexpr int kKeysPerSecond = 10;

// Hermite segment between way[i] and way[i+1] for one scalar of the pose; slopes are those of the parabola through
// the neighbours, zero at the ends of the path.
template <typename Get>
float interpolate(const std::vector<Waypoint>& way, size_t i, float time, Get get) {
    auto slope = [&](size_t k) {
        if (k == 0 || k + 1 == way.size()) return 0.0f;
        const float before = way[k].time - way[k - 1].time, after = way[k + 1].time - way[k].time;
        const float d0 = (get(way[k].pose) - get(way[k - 1].pose)) / before,
                    d1 = (get(way[k + 1].pose) - get(way[k].pose)) / after;
        return d0 * d1 <= 0.0f ? 0.0f
                               : (d0 * after + d1 * before) / (before + after);  // no overshoot at turning points
    };
    const float length = way[i + 1].time - way[i].time, t = (time - way[i].time) / length, t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * get(way[i].pose) + (t3 - 2 * t2 + t) * length * slope(i) +
           (3 * t2 - 2 * t3) * get(way[i + 1].pose) + (t3 - t2) * length * slope(i + 1);
}

}  // namespace

Pose pose_at(const std::vector<Waypoint>& way, float time) {
    size_t i = 0;
    while (i + 2 < way.size() && time >= way[i + 1].time) ++i;
    auto value = [&](auto get) { return interpolate(way, i, time, get); };
    return {vec3(value([](const Pose& p) { return p.eye.x; }), value([](const Pose& p) { return p.eye.y; }),
                 value([](const Pose& p) { return p.eye.z; })),
            value([](const Pose& p) { return p.yaw; }), value([](const Pose& p) { return p.pitch; })};
}

Animation flythrough(const std::vector<Waypoint>& way, int node) {
    Animation animation{"flythrough", {{node, false, {}, {}}, {node, true, {}, {}}}, {}};
    const int count = static_cast<int>(std::lround(way.back().time * kKeysPerSecond));
    quat last(1, 0, 0, 0);
    for (int i = 0; i <= count; ++i) {
        const float time = static_cast<float>(i) / kKeysPerSecond;
        const Pose pose = pose_at(way, time);
        quat q = pose.rotation();
        if (i > 0 && glm::dot(q, last) < 0.0f) q = -q;
        last = q;
        for (Channel& c : animation.channels) {
            c.times.push_back(time);
            c.values.push_back(c.rotation ? vec4(q.x, q.y, q.z, q.w) : vec4(pose.eye, 0.0f));
        }
    }
    animation.extras["places"] = nlohmann::json::array();
    for (const Waypoint& w : way) {
        if (!w.place.empty()) animation.extras["places"].push_back({{"name", w.place}, {"time", w.time}});
    }
    return animation;
}

}  // namespace tyndall::level
