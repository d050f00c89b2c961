#include "tools/level/wall.h"

#include <algorithm>

#include "tools/modeling/random.h"

namespace tyndall::level {

Opening rectangle_opening(float centre, float width, float sill, float head) {
    return {{centre - width / 2, centre + width / 2}, {sill, sill}, {head, head}};
}

Opening pointed_opening(float centre, float width, float sill, float spring, int segments, float sharpness) {
    Opening o;
    const float half = width / 2, radius = half * (1.0f + sharpness);
    const float end = static_cast<float>(std::acos(static_cast<double>(sharpness / (1.0f + sharpness))));
    auto add = [&](float u, float y) {
        o.us.push_back(centre + u);
        o.lower.push_back(sill);
        o.upper.push_back(y);
    };
    for (int i = 0; i <= segments; ++i) {  // left arc, struck from the right
        const float angle = end * static_cast<float>(i) / static_cast<float>(segments);
        add(half * sharpness - radius * cosine(angle), spring + radius * sine(angle));
    }
    for (int i = segments - 1; i >= 0; --i) {
        const float angle = end * static_cast<float>(i) / static_cast<float>(segments);
        add(radius * cosine(angle) - half * sharpness, spring + radius * sine(angle));
    }
    return o;
}

Opening round_opening(float centre, float width, float sill, float spring, int segments) {
    return pointed_opening(centre, width, sill, spring, segments, 0.0f);
}

Opening circle_opening(float centre, float centre_y, float radius, int segments) {
    Opening o;
    for (int i = 0; i <= segments; ++i) {
        const float angle = kPi * static_cast<float>(i) / static_cast<float>(segments);
        o.us.push_back(centre - radius * cosine(angle));
        o.lower.push_back(centre_y - radius * sine(angle));
        o.upper.push_back(centre_y + radius * sine(angle));
    }
    return o;
}

namespace {

struct Builder {
    Mesh& mesh;
    Mat mat;
    const Wall& w;
    vec3 out = glm::cross(w.along, vec3(0, 1, 0)) * (w.thickness / 2);

    float top(float u) const { return w.top ? w.top(u) : w.height; }
    vec3 at(float u, float y, float side) const { return wall_point(w, u, y) + out * side; }

    // Front and back of the strip between two upright edges with vertices at the given heights (growing).
    void strip(float u0, const std::vector<float>& left, float u1, const std::vector<float>& right) {
        size_t i = 0, j = 0;
        while (i + 1 < left.size() || j + 1 < right.size()) {
            const bool go_left = j + 1 >= right.size() || (i + 1 < left.size() && left[i + 1] <= right[j + 1]);
            const float u2 = go_left ? u0 : u1, y2 = go_left ? left[i + 1] : right[j + 1];
            mesh.triangle(mat, at(u0, left[i], 1), at(u1, right[j], 1), at(u2, y2, 1));
            mesh.triangle(mat, at(u1, right[j], -1), at(u0, left[i], -1), at(u2, y2, -1));
            go_left ? ++i : ++j;
        }
    }
    void across(float u0, float y0, float u1,
                float y1) {  // quad through the thickness; open side on the left of travel
        mesh.quad(mat, at(u0, y0, 1), at(u1, y1, 1), at(u1, y1, -1), at(u0, y0, -1));
    }
    void solid(float u0, std::vector<float> left_marks, float u1, std::vector<float> right_marks) {
        std::vector<float> us{u0};
        if (w.top) {
            const int parts = std::max(1, static_cast<int>(std::ceil((u1 - u0) / w.top_step)));
            for (int i = 1; i < parts; ++i)
                us.push_back(u0 + (u1 - u0) * static_cast<float>(i) / static_cast<float>(parts));
        }
        us.push_back(u1);
        for (size_t i = 0; i + 1 < us.size(); ++i) {
            auto edge = [&](float u, const std::vector<float>* marks) {
                std::vector<float> ys{0.0f};
                if (marks) ys.insert(ys.end(), marks->begin(), marks->end());
                ys.push_back(top(u));
                std::ranges::sort(ys);
                ys.erase(std::unique(ys.begin(), ys.end()), ys.end());
                return ys;
            };
            strip(us[i], edge(us[i], i == 0 ? &left_marks : nullptr), us[i + 1],
                  edge(us[i + 1], i + 2 == us.size() ? &right_marks : nullptr));
            across(us[i], top(us[i]), us[i + 1], top(us[i + 1]));
        }
    }
    void opening(const Opening& o) {
        const size_t n = o.us.size();
        for (size_t i = 0; i + 1 < n; ++i) {
            const float u0 = o.us[i], u1 = o.us[i + 1];
            if (o.lower[i] > 0.0f || o.lower[i + 1] > 0.0f) {
                strip(u0, {0.0f, o.lower[i]}, u1, {0.0f, o.lower[i + 1]});
                across(u0, o.lower[i], u1, o.lower[i + 1]);
            }
            strip(u0, {o.upper[i], top(u0)}, u1, {o.upper[i + 1], top(u1)});
            across(u1, o.upper[i + 1], u0, o.upper[i]);
            across(u0, top(u0), u1, top(u1));
        }
        across(o.us[0], o.upper[0], o.us[0], o.lower[0]);
        across(o.us[n - 1], o.lower[n - 1], o.us[n - 1], o.upper[n - 1]);
    }
};

}  // namespace

void wall(Mesh& mesh, Mat mat, const Wall& w) {
    Builder b{mesh, mat, w};
    float u = 0.0f;
    std::vector<float> marks;
    for (const Opening& o : w.openings) {
        b.solid(u, marks, o.us.front(), {o.lower.front(), o.upper.front()});
        b.opening(o);
        u = o.us.back();
        marks = {o.lower.back(), o.upper.back()};
    }
    b.solid(u, marks, w.length, {});
    if (!w.skip_ends) {
        b.across(0, 0, 0, b.top(0));
        b.across(w.length, b.top(w.length), w.length, 0);
    }
}

void archivolt(Mesh& mesh, Mat mat, const Wall& w, const Opening& o, float width, float proud, float side,
               float inset) {
    std::vector<vec2> line;
    const size_t n = o.us.size();
    const bool closed = o.lower[n / 2] < o.lower.front() - 1e-3f;  // a circle
    const bool jambs = o.upper.front() - o.lower.front() > 1e-3f;
    if (jambs) line.emplace_back(o.us.front(), o.lower.front());
    for (size_t i = 0; i < n; ++i) line.emplace_back(o.us[i], o.upper[i]);
    if (jambs) line.emplace_back(o.us.back(), o.lower.back());
    if (closed) {
        for (size_t i = n - 2; i > 0; --i) line.emplace_back(o.us[i], o.lower[i]);
        line.push_back(line.front());
    }
    const vec3 out = glm::cross(w.along, vec3(0, 1, 0)) * side;
    const size_t count = line.size();
    std::vector<vec2> normal(count);  // points away from the opening
    for (size_t i = 0; i < count; ++i) {
        vec2 d(0.0f);
        const vec2 before = i > 0 ? line[i - 1] : (closed ? line[count - 2] : line[i]);
        const vec2 after = i + 1 < count ? line[i + 1] : (closed ? line[1] : line[i]);
        if (before != line[i]) d += glm::normalize(line[i] - before);
        if (after != line[i]) d += glm::normalize(after - line[i]);
        d = glm::normalize(d);
        normal[i] = vec2(-d.y, d.x);
    }
    auto at = [&](size_t i, float offset, float depth) {
        const vec2 p = line[i] + normal[i] * offset;
        return wall_point(w, p.x, p.y) + out * (w.thickness / 2 + depth);
    };
    auto face = [&](vec3 a, vec3 b, vec3 c, vec3 d) {
        side > 0 ? mesh.quad(mat, d, c, b, a) : mesh.quad(mat, a, b, c, d);
    };
    const float bevel = std::min(width, proud) * 0.35f;
    for (size_t i = 0; i + 1 < count; ++i) {
        const size_t j = i + 1;
        face(at(i, inset, proud - bevel), at(j, inset, proud - bevel), at(j, inset, -0.05f), at(i, inset, -0.05f));
        face(at(i, bevel + inset, proud), at(j, bevel + inset, proud), at(j, inset, proud - bevel),
             at(i, inset, proud - bevel));
        face(at(i, width, proud), at(j, width, proud), at(j, bevel + inset, proud), at(i, bevel + inset, proud));
        face(at(i, width, -0.05f), at(j, width, -0.05f), at(j, width, proud), at(i, width, proud));
    }
    if (!closed) {  // feet
        face(at(0, inset, -0.05f), at(0, width, -0.05f), at(0, width, proud), at(0, inset, proud));
        face(at(count - 1, width, -0.05f), at(count - 1, inset, -0.05f), at(count - 1, inset, proud),
             at(count - 1, width, proud));
    }
}

}  // namespace tyndall::level
