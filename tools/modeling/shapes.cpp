#include "tools/modeling/shapes.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "tools/modeling/random.h"

namespace tyndall::modeling {

void box(Mesh& mesh, Surface surface, vec3 l, vec3 h, unsigned skip) {
    if (!(skip & kLeft)) mesh.quad(surface, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
    if (!(skip & kRight)) mesh.quad(surface, {h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z});
    if (!(skip & kBottom)) mesh.quad(surface, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
    if (!(skip & kTop)) mesh.quad(surface, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
    if (!(skip & kBack)) mesh.quad(surface, {h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z});
    if (!(skip & kFront)) mesh.quad(surface, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
}

void chamfered_box(Mesh& mesh, Surface surface, vec3 low, vec3 high, float cut) {
    const vec3 centre = (low + high) * 0.5f, half = (high - low) * 0.5f;
    auto point = [&](vec3 sign, int axis) {  // corner of the inset face on `axis`
        vec3 p = sign * (half - cut);
        p[axis] = sign[axis] * half[axis];
        return centre + p;
    };
    auto outward = [&](std::vector<vec3> p) {  // orders the points so that the face looks away from the centre
        const vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        if (glm::dot(n, p[0] + p[1] + p[2] - 3.0f * centre) < 0.0f) std::ranges::reverse(p);
        mesh.polygon(surface, p);
    };
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        auto sign = [&](float x, float y, float z) {
            vec3 s;
            s[a] = x, s[b] = y, s[c] = z;
            return s;
        };
        for (const float x : {-1.0f, 1.0f}) {
            outward({point(sign(x, -1, -1), a), point(sign(x, 1, -1), a), point(sign(x, 1, 1), a),
                     point(sign(x, -1, 1), a)});
            for (const float y : {-1.0f, 1.0f}) {
                outward({point(sign(x, y, -1), a), point(sign(x, y, 1), a), point(sign(x, y, 1), b),
                         point(sign(x, y, -1), b)});
            }
        }
    }
    for (int i = 0; i < 8; ++i) {
        const vec3 s(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
        outward({point(s, 0), point(s, 1), point(s, 2)});
    }
}

void beam(Mesh& mesh, Surface surface, vec3 a, vec3 b, float width, float height, vec3 up, bool ends) {
    const vec3 along = glm::normalize(b - a);
    if (std::abs(glm::dot(along, up)) > 0.98f) up = std::abs(along.x) > 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0);
    const vec3 right = glm::normalize(glm::cross(along, up)) * (width * 0.5f);
    const vec3 top = glm::normalize(glm::cross(right, along)) * (height * 0.5f);
    const float scale = 1.0f / surface.tile_metres, length = glm::length(b - a) * scale;
    const float shift = glm::dot(a, vec3(0.37f, 0.73f, 0.59f));  // so that no two beams show the same grain
    const std::array<vec3, 4> ring{-right - top, right - top, right + top, -right + top};
    float u = shift - std::floor(shift);
    for (size_t i = 0; i < 4; ++i) {
        const vec3 p = ring[i], q = ring[(i + 1) % 4];
        const float du = glm::length(q - p) * scale;
        // Seen from outside with `along` pointing up, the ring runs to the left when looked at against travel.
        mesh.quad_uv(surface, {a + q, a + p, b + p, b + q},
                     {vec2(u + du, length), vec2(u, length), vec2(u, 0), vec2(u + du, 0)});
        u += du;
    }
    if (!ends) return;
    const vec2 d = vec2(width, height) * scale;
    mesh.quad_uv(surface, {a + ring[0], a + ring[1], a + ring[2], a + ring[3]},
                 {vec2(0, 0), vec2(d.x, 0), vec2(d.x, -d.y), vec2(0, -d.y)});
    mesh.quad_uv(surface, {b + ring[1], b + ring[0], b + ring[3], b + ring[2]},
                 {vec2(0, 0), vec2(d.x, 0), vec2(d.x, -d.y), vec2(0, -d.y)});
}

void extrude(Mesh& mesh, Surface surface, std::span<const vec3> front, vec3 depth) {
    mesh.polygon(surface, front);
    std::vector<vec3> back(front.rbegin(), front.rend());
    for (vec3& p : back) p += depth;
    mesh.polygon(surface, back);
    for (size_t i = 0; i < front.size(); ++i) {
        const vec3 p = front[i], q = front[(i + 1) % front.size()];
        mesh.quad(surface, q, p, p + depth, q + depth);
    }
}

void lathe(Mesh& mesh, Surface surface, vec3 base, std::span<const vec2> profile, int segments, float turn) {
    const size_t count = profile.size() - 1;
    std::vector<vec2> normals(count);
    float radius = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        const vec2 d = profile[i + 1] - profile[i];
        normals[i] = glm::normalize(vec2(d.y, -d.x));
        radius = std::max({radius, profile[i].x, profile[i + 1].x});
    }
    const float tiles = std::max(1.0f, std::round(2.0f * kPi * radius / surface.tile_metres));
    auto joined = [&](size_t i, size_t j) { return glm::dot(normals[i], normals[j]) > 0.766f; };
    float v = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        const float dv = glm::length(profile[i + 1] - profile[i]) / surface.tile_metres;
        const vec2 n0 = i > 0 && joined(i - 1, i) ? glm::normalize(normals[i - 1] + normals[i]) : normals[i];
        const vec2 n1 =
            i + 1 < count && joined(i, i + 1) ? glm::normalize(normals[i] + normals[i + 1]) : normals[i];
        std::vector<Vertex> rings;
        for (int r = 0; r < 2; ++r) {
            const vec2 p = profile[i + static_cast<size_t>(r)], n = r ? n1 : n0;
            for (int s = 0; s <= segments; ++s) {
                const float t = static_cast<float>(s % segments) / static_cast<float>(segments);
                const float angle = -2.0f * kPi * t + turn;  // to the right, seen from outside
                const vec3 dir(cosine(angle), 0, sine(angle));
                rings.push_back(
                    {base + dir * p.x + vec3(0, p.y, 0), dir * n.x + vec3(0, n.y, 0),
                     vec2(static_cast<float>(s) / static_cast<float>(segments) * tiles, -(v + (r ? dv : 0.0f)))});
            }
        }
        mesh.grid(surface, 2, segments + 1, rings);
        v += dv;
    }
}

namespace {

// Unit direction of travel at each point of a path, averaged at corners.
std::vector<vec3> directions(std::span<const vec3> path, bool loop) {
    std::vector<vec3> result(path.size());
    const size_t n = path.size();
    for (size_t i = 0; i < n; ++i) {
        const vec3 before = i > 0 ? path[i - 1] : (loop ? path[n - 1] : path[i]);
        const vec3 after = i + 1 < n ? path[i + 1] : (loop ? path[0] : path[i]);
        vec3 d(0.0f);
        if (before != path[i]) d += glm::normalize(path[i] - before);
        if (after != path[i]) d += glm::normalize(after - path[i]);
        result[i] = glm::normalize(d);
    }
    return result;
}

}  // namespace

void sweep(Mesh& mesh, Surface surface, std::span<const vec3> path, std::span<const vec2> section, vec3 up,
           bool loop) {
    const std::vector<vec3> dir = directions(path, loop);
    const size_t n = path.size(), m = section.size();
    std::vector<std::vector<vec3>> rings(n, std::vector<vec3>(m));
    for (size_t i = 0; i < n; ++i) {
        const vec3 right = glm::normalize(glm::cross(dir[i], up)), top = glm::cross(right, dir[i]);
        for (size_t k = 0; k < m; ++k) rings[i][k] = path[i] + right * section[k].x + top * section[k].y;
    }
    const float scale = 1.0f / surface.tile_metres;
    float v = 0.0f;
    for (size_t i = 0; i + (loop ? 0 : 1) < n; ++i) {
        const size_t j = (i + 1) % n;
        const float dv = glm::length(path[j] - path[i]) * scale;
        float u = 0.0f;
        for (size_t k = 0; k < m; ++k) {
            const size_t l = (k + 1) % m;
            const float du = glm::length(section[l] - section[k]) * scale;
            // The section is counter-clockwise seen against the travel, so the outside is on this side of the quad.
            mesh.quad_uv(surface, {rings[i][l], rings[i][k], rings[j][k], rings[j][l]},
                         {vec2(u + du, -v), vec2(u, -v), vec2(u, -v - dv), vec2(u + du, -v - dv)});
            u += du;
        }
        v += dv;
    }
    if (!loop) {
        mesh.polygon(surface, rings.front());
        std::ranges::reverse(rings.back());
        mesh.polygon(surface, rings.back());
    }
}

std::vector<vec2> rectangle_section(float w, float h) {
    return {{-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}};
}

std::vector<vec2> chamfered_section(float w, float h, float c) {
    const float x = w / 2, y = h / 2;
    return {{-x + c, -y}, {x - c, -y}, {x, -y + c}, {x, y - c}, {x - c, y}, {-x + c, y}, {-x, y - c}, {-x, -y + c}};
}

void tube(Mesh& mesh, Surface surface, std::span<const vec3> path, std::span<const float> radii, int segments) {
    const std::vector<vec3> dir = directions(path, false);
    vec3 right = std::abs(dir[0].y) > 0.9f ? vec3(1, 0, 0) : glm::normalize(glm::cross(dir[0], vec3(0, 1, 0)));
    const float tiles = std::max(1.0f, std::round(2.0f * kPi * radii[0] / surface.tile_metres));
    std::vector<Vertex> vertices;
    float v = 0.0f;
    for (size_t i = 0; i < path.size(); ++i) {
        right = glm::normalize(right - dir[i] * glm::dot(right, dir[i]));
        const vec3 other = glm::cross(dir[i], right);
        if (i > 0) v += glm::length(path[i] - path[i - 1]) / surface.tile_metres;
        for (int s = 0; s <= segments; ++s) {
            const float angle = 2.0f * kPi * static_cast<float>(s % segments) / static_cast<float>(segments);
            const vec3 n = right * cosine(angle) + other * sine(angle);
            vertices.push_back({path[i] + n * radii[i], n,
                                vec2(static_cast<float>(s) / static_cast<float>(segments) * tiles, -v)});
        }
    }
    mesh.grid(surface, static_cast<int>(path.size()), segments + 1, vertices);
}

void gable_roof(Mesh& mesh, Surface surface, Surface under, vec3 a, vec3 b, float half_width, float eave_y,
                float thickness) {
    const vec3 along = glm::normalize(b - a), side = glm::cross(along, vec3(0, 1, 0)) * half_width;
    const vec3 down(0, -thickness, 0), drop(0, eave_y - a.y, 0);
    for (const float s : {-1.0f, 1.0f}) {
        const vec3 ea = a + side * s + drop, eb = b + side * s + drop;
        auto face = [&](Surface face_surface, vec3 p, vec3 q, vec3 r, vec3 t) {
            s > 0 ? mesh.quad(face_surface, p, q, r, t) : mesh.quad(face_surface, t, r, q, p);
        };
        face(surface, ea, eb, b, a);
        face(under, a + down, b + down, eb + down, ea + down);
        face(under, ea + down, eb + down, eb, ea);
        face(under, a + down, ea + down, ea, a);
        face(under, eb + down, b + down, b, eb);
    }
}

void spire(Mesh& mesh, Surface surface, vec3 centre, float radius, float height, int sides) {
    const vec3 tip = centre + vec3(0, height, 0);
    auto corner = [&](int i) {
        const float angle = 2.0f * kPi * (static_cast<float>(i % sides) + 0.5f) / static_cast<float>(sides);
        return centre + vec3(cosine(angle), 0, -sine(angle)) * radius;
    };
    for (int i = 0; i < sides; ++i) mesh.triangle(surface, corner(i), corner(i + 1), tip);
}

void slab(Mesh& mesh, Surface surface, vec3 a, vec3 b, vec3 c, vec3 d, float thickness, Surface under) {
    const vec3 down(0, -thickness, 0);
    mesh.quad(surface, a, b, c, d);
    mesh.quad(under, d + down, c + down, b + down, a + down);
    const std::array<vec3, 4> p{a, b, c, d};
    for (size_t i = 0; i < 4; ++i) mesh.quad(under, p[i] + down, p[(i + 1) % 4] + down, p[(i + 1) % 4], p[i]);
}

void steps(Mesh& mesh, Surface surface, vec3 foot, vec3 along, float width, int count, float rise, float run,
           float floor_y) {
    const vec3 side = glm::cross(along, vec3(0, 1, 0)) * (width * 0.5f);
    auto at = [](vec3 p, float height) { return vec3(p.x, height, p.z); };
    for (int i = 0; i < count; ++i) {
        const vec3 middle = foot + along * (run * static_cast<float>(i));
        const vec3 a = middle - side, b = middle + side, a2 = a + along * run, b2 = b + along * run;
        const float y = foot.y + rise * static_cast<float>(i), top = y + rise;
        mesh.quad(surface, at(a, y), at(b, y), at(b, top), at(a, top));        // riser
        mesh.quad(surface, at(a, top), at(b, top), at(b2, top), at(a2, top));  // tread
        mesh.quad(surface, at(a2, floor_y), at(a, floor_y), at(a, top), at(a2, top));
        mesh.quad(surface, at(b, floor_y), at(b2, floor_y), at(b2, top), at(b, top));
    }
    const vec3 end = foot + along * (run * static_cast<float>(count)), a = end - side, b = end + side;
    const float top = foot.y + rise * static_cast<float>(count);
    mesh.quad(surface, at(b, floor_y), at(a, floor_y), at(a, top), at(b, top));
}

mat4 place(vec3 position, float yaw_degrees, float scale) {
    const float angle = yaw_degrees * kPi / 180.0f, c = cosine(angle) * scale, s = sine(angle) * scale;
    return {vec4(c, 0, -s, 0), vec4(0, scale, 0, 0), vec4(s, 0, c, 0), vec4(position, 1)};
}

}  // namespace tyndall::modeling
