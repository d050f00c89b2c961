#pragma once

#include <optional>

#include "engine/scene/gltf_file.h"
#include "engine/scene/scene.h"

namespace tyndall::gltf {

// The steps of load_gltf, in this order. Each adds its part of the file to the scene.

/// Materials, and the pictures that they use.
void load_materials(const GltfFile& file, Scene& scene);
/// How the textures of a material are laid on a primitive: TEXCOORD_`set`, through KHR_texture_transform.
struct TextureCoordinates {
    int set = 0;
    glm::dmat3x2 transform{1};  ///< of (u, v, 1)
    bool operator==(const TextureCoordinates&) const = default;
};
/// Those of its first texture, for all of them: others are told, or refused where KHR_texture_transform is
/// required. None: it has no texture.
[[nodiscard]] std::optional<TextureCoordinates> texture_coordinates(const GltfFile& file, int material);
/// A mesh per primitive. Returns, for each mesh of the file, the indices of the scene's meshes.
[[nodiscard]] std::vector<std::vector<int>> load_meshes(const GltfFile& file, Scene& scene);
/// The scene's meshes of one of the file's. `joints` of a skin, in the world, move its vertices; none: no skin.
[[nodiscard]] std::vector<int> load_mesh(const GltfFile& file, int index, const std::vector<glm::dmat4>& joints,
                                         Scene& scene);
/// Nodes with their lights and cameras. Returns, for each node of the file, the scene's; -1 outside the scene.
[[nodiscard]] std::vector<int> load_nodes(const GltfFile& file, const std::vector<std::vector<int>>& meshes,
                                          Scene& scene);
/// The node's emitter, if its extras have one.
void load_particles(const GltfFile& file, const Json& extras, int node, Scene& scene, const std::string& what);
/// `only`: the one that is loaded beside "flythrough"; throws UsageError where there is none of the name.
void load_animations(const GltfFile& file, const std::vector<int>& nodes, const std::optional<std::string>& only,
                     Scene& scene);
/// The media of the scene's extras, then those of nodes' extras, whose places and sizes are the nodes'; the meshes
/// of these nodes are not drawn. Leaves the scene at time 0.
void load_media(const GltfFile& file, const Json& scene_extras, const std::vector<int>& nodes, Scene& scene);
/// KHR_materials_unlit: makes surfaces that only emit, so that a base colour of 1 shows as 1 at the scene's
/// exposure.
void light_unlit(const GltfFile& file, Scene& scene);
/// Doubts materials of drawn meshes that say nothing.
void doubt_empty_materials(const GltfFile& file, const Scene& scene);
/// Names the extras that nothing reads, and doubts those that look like ones that are read.
void tell_ignored_extras(const GltfFile& file);

}  // namespace tyndall::gltf
