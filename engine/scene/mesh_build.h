#pragma once

#include "engine/scene/scene.h"

namespace tyndall {

/// Indices of separate triangles, from a strip's or a fan's; every second triangle of a strip is turned so that all
/// keep the winding of the first.
[[nodiscard]] std::vector<std::uint32_t> triangles_of_strip(const std::vector<std::uint32_t>& strip);
[[nodiscard]] std::vector<std::uint32_t> triangles_of_fan(const std::vector<std::uint32_t>& fan);

/// Normals of length 1; one of no length becomes +Y.
void normalise_normals(Mesh& mesh);

/// Gives each triangle vertices of its own, with the triangle's normal (a degenerate one: +Y).
void make_flat(Mesh& mesh);

/// Tangents along growing u, averaged over the triangles of a vertex and made orthogonal to its normal (Lengyel
/// 2001); the bitangent along falling v, as glTF's normal maps expect; any direction orthogonal to the normal where
/// uv is degenerate. w is the bitangent's sign.
void compute_tangents(Mesh& mesh);

/// Any tangent orthogonal to the normal: enough where no normal map is used.
void make_arbitrary_tangents(Mesh& mesh);

}  // namespace tyndall
