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
    return !material.alpha_mask ||
           query.geometry->alpha(triangle, hit.barycentric) *
                   mask_alpha(query.geometry->scene, material, query.geometry->uv(triangle, hit.barycentric)) >=
               material.alpha_cutoff;
}

void filter(const RTCFilterFunctionNArguments* arguments) {
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
    for (const Triangle& triangle : triangles) {
        if (!triangle.cast_shadow) continue;
        const Material& m = material(triangle);
        Caster caster{triangle.corner, {}, {}, m.alpha_mask ? &m : nullptr};
        for (std::size_t i = 0; i < 3; ++i) {
            caster.uv[i] = vertex(triangle, i).uv;
            caster.alpha[static_cast<int>(i)] = vertex(triangle, i).color.a;
        }
        list.push_back(caster);
    }
    casters = std::make_unique<SliceTree>(scene, std::move(list), center);
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
            if (scene.materials[static_cast<std::size_t>(mesh.material)].alpha_blend) continue;
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
                triangles.push_back(triangle);
                low = glm::min(low, glm::min(a, glm::min(b, c)));
                high = glm::max(high, glm::max(a, glm::max(b, c)));
            }
        }
    }
    if (triangles.empty()) return;
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
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(embree.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree.get());
    if (const RTCError error = rtcGetDeviceError(device.get()); error != RTC_ERROR_NONE)
        throw Error(fmt::format("Embree: error {}", int{error}));
}

dvec2 Geometry::Impl::uv(const Triangle& triangle, dvec2 barycentric) const {
    return (1 - barycentric.x - barycentric.y) * dvec2(vertex(triangle, 0).uv) +
           barycentric.x * dvec2(vertex(triangle, 1).uv) + barycentric.y * dvec2(vertex(triangle, 2).uv);
}

double Geometry::Impl::alpha(const Triangle& triangle, dvec2 barycentric) const {
    const dvec3 corner(vertex(triangle, 0).color.a, vertex(triangle, 1).color.a, vertex(triangle, 2).color.a);
    return glm::dot(corner, dvec3(1 - barycentric.x - barycentric.y, barycentric));
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
