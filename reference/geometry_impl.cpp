#include "reference/geometry_impl.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/error.h"
#include "reference/surface_texture.h"

namespace tyndall::reference {
namespace {

/// A ray in double precision behind Embree's single one: its filter decides by this.
struct Query {
    RTCIntersectContext context;
    const Geometry::Impl* geometry;
    dvec3 origin, direction;
    double begin, end;
    Geometry::Impl::Sees sees;
};

struct PlaneHit {
    double distance;
    dvec2 barycentric;
    bool counter_clockwise;
};

/// Where the ray meets the triangle's plane; distance NaN or infinite where it runs along it.
PlaneHit meet_plane(const Triangle& triangle, dvec3 origin, dvec3 direction) {
    const dvec3 a = triangle.corner[0], u = triangle.corner[1] - a, v = triangle.corner[2] - a;
    const dvec3 normal = glm::cross(u, v), to_a = a - origin;
    const double facing = glm::dot(normal, direction);
    const dvec3 moment = glm::cross(direction, to_a);
    return {glm::dot(normal, to_a) / facing, dvec2(-glm::dot(moment, v), glm::dot(moment, u)) / facing, facing < 0};
}

/// What of a hit of Embree's counts.
bool blocks(const Query& query, const Triangle& triangle) {
    if (query.sees == Geometry::Impl::Sees::light && !triangle.cast_shadow) return false;
    const PlaneHit hit = meet_plane(triangle, query.origin, query.direction);
    if (!(hit.distance > query.begin && hit.distance < query.end)) return false;
    const Material& material = query.geometry->material(triangle);
    const bool front = hit.counter_clockwise != triangle.mirrored;
    if (query.sees == Geometry::Impl::Sees::eye && !front && !material.double_sided) return false;
    const dvec3 weights(1 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
    return !material.alpha_mask ||
           query.geometry->color(triangle, weights).a *
                   mask_alpha(query.geometry->scene, material, query.geometry->uv(triangle, weights)) >=
               material.alpha_cutoff;
}

void embree_filter(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    // The context is the query's first member.
    const Query& query = *reinterpret_cast<const Query*>(arguments->context);
    const unsigned index = RTCHitN_primID(arguments->hit, arguments->N, 0);
    if (!blocks(query, query.geometry->triangles[index])) arguments->valid[0] = 0;
}

/// Single precision moves surfaces: Embree looks this much farther, the filter is exact.
double slack(double distance) {
    return 1e-4 * (1 + std::abs(distance));
}

RTCRay embree_ray(const Query& query) {
    const dvec3 origin = query.origin - query.geometry->center;
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(query.direction.x);
    ray.dir_y = static_cast<float>(query.direction.y);
    ray.dir_z = static_cast<float>(query.direction.z);
    ray.tnear = static_cast<float>(std::max(query.begin - slack(query.begin), 0.0));
    ray.tfar = static_cast<float>(query.end + slack(query.end));
    ray.mask = ~0u;
    return ray;
}

Query make_query(const Geometry::Impl& geometry, dvec3 origin, dvec3 direction, double begin, double end,
                 Geometry::Impl::Sees sees) {
    Query query{{}, &geometry, origin, direction, begin, end, sees};
    rtcInitIntersectContext(&query.context);
    return query;
}

}  // namespace

Geometry::Impl::Impl(const Scene& from, bool with_shadows) : scene(from), shadows(with_shadows) {
    collect_triangles();
    build_embree();
    if (!shadows) return;
    std::vector<Caster> list;
    for (std::size_t index = 0; index < triangles.size(); ++index) {
        const Triangle& triangle = triangles[index];
        if (!triangle.cast_shadow) continue;
        const Material& m = material(triangle);
        Caster caster{triangle.corner, static_cast<std::uint32_t>(index), {}, {}, m.alpha_mask ? &m : nullptr};
        for (std::size_t i = 0; i < 3; ++i) {
            caster.uv[i] = vertex(triangle, i).uv;
            caster.alpha[static_cast<int>(i)] = vertex(triangle, i).color.a;
        }
        list.push_back(caster);
    }
    casters = std::make_unique<SliceTree>(scene, std::move(list), center);
    if (glass.empty()) return;
    std::vector<Caster> transparent;
    for (const Triangle& triangle : glass)
        transparent.push_back({triangle.corner, static_cast<std::uint32_t>(transparent.size()), {}, {}, nullptr});
    panes = std::make_unique<SliceTree>(scene, std::move(transparent), center);
}

void Geometry::Impl::collect_triangles() {
    dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const glm::dmat4 world(node.world);
        const glm::dmat3 linear(world);
        const double sizes = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
        // A transform that flattens mirrors nothing, whatever the sign that rounding leaves.
        const bool mirrored = glm::determinant(linear) < -1e-6 * sizes;
        for (const int m : node.meshes) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(m)];
            const bool transparent = scene.materials[static_cast<std::size_t>(mesh.material)].alpha_blend;
            if (transparent && !node.cast_shadow) continue;
            for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
                Triangle triangle{{},
                                  static_cast<std::uint32_t>(n),
                                  static_cast<std::uint32_t>(m),
                                  static_cast<std::uint32_t>(i),
                                  mirrored,
                                  node.cast_shadow};
                for (std::size_t k = 0; k < 3; ++k)
                    triangle.corner[k] = world * glm::dvec4(mesh.vertices[mesh.indices[i + k]].position, 1);
                const auto& [a, b, c] = triangle.corner;
                if (!(glm::length(glm::cross(b - a, c - a)) > 0)) continue;
                (transparent ? glass : triangles).push_back(triangle);
                low = glm::min(low, glm::min(a, glm::min(b, c)));
                high = glm::max(high, glm::max(a, glm::max(b, c)));
            }
        }
    }
    if (triangles.empty() && glass.empty()) return;
    center = 0.5 * (low + high);
    radius = 0.5 * glm::length(high - low);
}

void Geometry::Impl::build_embree() {
    device.reset(rtcNewDevice(nullptr));
    if (!device) throw Error(fmt::format("Embree: no device (error {})", int{rtcGetDeviceError(nullptr)}));
    embree.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(embree.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree.get(), RTC_BUILD_QUALITY_HIGH);
    if (!triangles.empty()) {
        const RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * triangles.size()));
        auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles.size()));
        if (positions == nullptr || indices == nullptr) throw Error("Embree: out of memory");
        for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
            const glm::vec3 p(triangles[i / 3].corner[i % 3] - center);
            std::copy_n(&p.x, 3, positions + 3 * i);
            indices[i] = static_cast<unsigned>(i);
        }
        rtcSetGeometryIntersectFilterFunction(geometry, embree_filter);
        rtcSetGeometryOccludedFilterFunction(geometry, embree_filter);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree.get());
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
        throw Error(fmt::format("Embree: error {}", int{error}));
}

dvec2 Geometry::Impl::uv(const Triangle& triangle, dvec3 weights) const {
    return weights.x * dvec2(vertex(triangle, 0).uv) + weights.y * dvec2(vertex(triangle, 1).uv) +
           weights.z * dvec2(vertex(triangle, 2).uv);
}

dvec4 Geometry::Impl::color(const Triangle& triangle, dvec3 weights) const {
    return weights.x * dvec4(vertex(triangle, 0).color) + weights.y * dvec4(vertex(triangle, 1).color) +
           weights.z * dvec4(vertex(triangle, 2).color);
}

dvec3 Geometry::Impl::filter(const Triangle& triangle, dvec3 weights) const {
    const Material& m = material(triangle);
    const dvec4 base = base_color(scene, m, uv(triangle, weights), color(triangle, weights));
    return (1 - base.a) + base.a * double{m.transmission} * dvec3(base);
}

std::vector<Geometry::Impl::Crossing> Geometry::Impl::glass_between(dvec3 point, dvec3 to_light,
                                                                    double distance) const {
    if (!panes) return {};
    // A slice along any short ray across the light: what darkens its middle lies on the line.
    const dvec3 size = glm::abs(to_light);
    const dvec3 axis = size.x <= size.y && size.x <= size.z ? dvec3(1, 0, 0)
                       : size.y <= size.z                   ? dvec3(0, 1, 0)
                                                            : dvec3(0, 0, 1);
    const dvec3 across = glm::normalize(glm::cross(to_light, axis));
    constexpr double half = 1e-6;
    const auto slice = std::isfinite(distance) ? lamp_slice(point, across, -half, half, point + distance * to_light)
                                               : sun_slice(point, across, -half, half, to_light);
    if (!slice) return {};
    std::vector<Crossing> found;
    for (const auto& [index, shadow] : panes->cuts(*slice)) {
        const Interval part = shadow.on_ray(shadow.part, *slice);
        if (!(part.begin < 0 && part.end >= 0)) continue;
        const dvec3 w = shadow.weights_at(0);
        const auto& [a, b, c] = glass[index].corner;
        found.push_back({index, w, glm::dot(w.x * a + w.y * b + w.z * c - point, to_light)});
    }
    return found;
}

std::optional<Geometry::Hit> Geometry::Impl::first_hit(dvec3 origin, dvec3 direction, double begin, double end,
                                                       Sees sees) const {
    Query query = make_query(*this, origin, direction, begin, end, sees);
    RTCRayHit ray{embree_ray(query), {}};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree.get(), &query.context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Triangle& triangle = triangles[ray.hit.primID];
    const PlaneHit hit = meet_plane(triangle, origin, direction);
    return Hit{hit.distance, ray.hit.primID, hit.barycentric, hit.counter_clockwise != triangle.mirrored};
}

bool Geometry::Impl::any_hit(dvec3 origin, dvec3 direction, double begin, double end) const {
    if (!(begin < end)) return false;
    Query query = make_query(*this, origin, direction, begin, end, Sees::light);
    RTCRay ray = embree_ray(query);
    rtcOccluded1(embree.get(), &query.context, &ray);
    return ray.tfar < 0;
}

}  // namespace tyndall::reference
