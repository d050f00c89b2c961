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
    std::vector<Triangle> triangles;
    dvec3 center{0};    ///< of the bounds, and Embree's origin: its single precision is best spent near the scene
    double radius = 0;  ///< of a sphere around it that holds all triangles, m
    std::unique_ptr<RTCDeviceTy, EmbreeRelease> device;
    std::unique_ptr<RTCSceneTy, EmbreeRelease> embree;
    std::unique_ptr<SliceTree> casters;

    Impl(const Scene& scene, bool shadows);

    [[nodiscard]] const Material& material(const Triangle& triangle) const {
        return scene.materials[static_cast<std::size_t>(scene.meshes[triangle.mesh].material)];
    }
    [[nodiscard]] const Vertex& vertex(const Triangle& triangle, std::size_t corner) const {
        const Mesh& mesh = scene.meshes[triangle.mesh];
        return mesh.vertices[mesh.indices[triangle.first_index + corner]];
    }
    [[nodiscard]] dvec2 uv(const Triangle& triangle, dvec2 barycentric) const;
    /// Of the vertices' colours.
    [[nodiscard]] double alpha(const Triangle& triangle, dvec2 barycentric) const;

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
