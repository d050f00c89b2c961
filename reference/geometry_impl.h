#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <limits>

#include "reference/geometry.h"
#include "reference/slice.h"

namespace tyndall::reference {

/// A triangle of the scene, placed in the world.
struct Triangle {
    std::array<dvec3, 3> corner;
    std::uint32_t node, mesh, first_index;
    bool mirrored;  ///< the node's transform mirrors: the front is the side from which the corners run clockwise
    bool cast_shadow;
};

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

struct Geometry::Impl {
    const Scene& scene;
    bool shadows;
    std::vector<Triangle> triangles, glass;  ///< those that block, and transparent ones that cast shadows
    dvec3 center{0};    ///< of the bounds, and Embree's origin: its single precision is best spent near the scene
    double radius = 0;  ///< of a sphere around it that holds all triangles, m
    std::unique_ptr<RTCDeviceTy, EmbreeRelease> device;
    std::unique_ptr<RTCSceneTy, EmbreeRelease> embree;
    std::unique_ptr<SliceTree> casters;
    std::unique_ptr<SliceTree> panes;  ///< of `glass`; null where there is none, or nothing blocks light

    Impl(const Scene& scene, bool shadows);

    [[nodiscard]] const Material& material(const Triangle& triangle) const {
        return scene.materials[static_cast<std::size_t>(scene.meshes[triangle.mesh].material)];
    }
    [[nodiscard]] const Vertex& vertex(const Triangle& triangle, std::size_t corner) const {
        const Mesh& mesh = scene.meshes[triangle.mesh];
        return mesh.vertices[mesh.indices[triangle.first_index + corner]];
    }
    [[nodiscard]] dvec2 uv(const Triangle& triangle, dvec3 weights) const;
    /// Of the vertices.
    [[nodiscard]] glm::dvec4 color(const Triangle& triangle, dvec3 weights) const;
    /// By which a transparent triangle multiplies light, see Tint.
    [[nodiscard]] dvec3 filter(const Triangle& triangle, dvec3 weights) const;

    struct Crossing {
        std::uint32_t triangle;  ///< of `glass`
        dvec3 weights;
        double distance;  ///< m from where the line starts
    };
    /// The transparent triangles that light crosses on its last `distance` metres to a point; a light at infinity
    /// is a sun. In no order; an edge of two triangles counts once.
    [[nodiscard]] std::vector<Crossing> glass_between(dvec3 point, dvec3 to_light, double distance) const;

    /// From `point` this far in any direction there is nothing more, m.
    [[nodiscard]] double beyond(dvec3 point) const { return glm::length(center - point) + radius + 1; }

    enum class Sees { eye, light };
    /// The first triangle that `sees` does not see through, with begin < distance < end; exact in distance.
    [[nodiscard]] std::optional<Hit> first_hit(dvec3 origin, dvec3 direction, double begin, double end,
                                               Sees sees) const;
    [[nodiscard]] bool any_hit(dvec3 origin, dvec3 direction, double begin, double end) const;

  private:
    void collect_triangles();
    void build_embree();
};

}  // namespace tyndall::reference
