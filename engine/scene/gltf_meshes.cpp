#include "engine/scene/gltf_parts.h"
#include "engine/scene/mesh_build.h"

namespace tyndall::gltf {
namespace {

/// A primitive without a material has glTF's default one, behind those of the file.
int material(const GltfFile& file, int index, Scene& scene, const std::string& what) {
    const std::size_t in_file = file.model().materials.size();
    if (index != -1) {
        (void)file.at(file.model().materials, index, what + ": material");
        return index;
    }
    if (scene.materials.size() == in_file) scene.materials.emplace_back().name = "default";
    return static_cast<int>(in_file);
}

std::vector<std::uint32_t> load_indices(const GltfFile& file, const tinygltf::Primitive& from,
                                        std::size_t vertex_count, const std::string& what) {
    std::vector<std::uint32_t> indices;
    if (from.indices == -1) {
        for (std::uint32_t i = 0; i < vertex_count; ++i) indices.push_back(i);
    } else {
        const auto& accessor = file.at(file.model().accessors, from.indices, what + ": accessor");
        if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.normalized)
            file.fail("{}: indices that are not unsigned integers", what);
        const std::vector<double> values = file.read(from.indices, TINYGLTF_TYPE_SCALAR, what + " indices");
        indices.reserve(values.size());
        for (const double index : values) {
            if (index < 0 || index >= static_cast<double>(vertex_count))
                file.fail("{}: index {} is out of range; there are {} vertices", what, index, vertex_count);
            indices.push_back(static_cast<std::uint32_t>(index));
        }
    }
    if (from.mode == TINYGLTF_MODE_TRIANGLE_STRIP) return triangles_of_strip(indices);
    if (from.mode == TINYGLTF_MODE_TRIANGLE_FAN) return triangles_of_fan(indices);
    if (from.mode != TINYGLTF_MODE_TRIANGLES) file.fail("{}: mode {} does not exist", what, from.mode);
    if (indices.size() % 3 != 0) file.fail("{}: {} indices are not whole triangles", what, indices.size());
    return indices;
}

Mesh load_primitive(const GltfFile& file, const tinygltf::Primitive& from, Scene& scene, const std::string& what) {
    if (from.extensions.contains("KHR_draco_mesh_compression"))
        file.fail("{}: Draco compression is not supported", what);
    Mesh mesh;
    const auto fill = [&]<int n>(const char* name, glm::vec<n, float> Vertex::*member) {
        const auto vectors = file.read_vectors<n>(from.attributes.at(name), what + " " + name);
        if (mesh.vertices.empty()) mesh.vertices.resize(vectors.size(), Vertex{{}, {}, {}, {}});
        if (vectors.size() != mesh.vertices.size())
            file.fail("{}: {} has {} elements, POSITION has {}", what, name, vectors.size(), mesh.vertices.size());
        for (std::size_t i = 0; i < vectors.size(); ++i) mesh.vertices[i].*member = vectors[i];
    };
    if (!from.attributes.contains("POSITION")) file.fail("{}: has no POSITION", what);

    mesh.material = material(file, from.material, scene, what);
    fill("POSITION", &Vertex::position);
    for (const Vertex& v : mesh.vertices) mesh.bounds.add(v.position);
    mesh.indices = load_indices(file, from, mesh.vertices.size(), what);
    if (from.attributes.contains("TEXCOORD_0")) fill("TEXCOORD_0", &Vertex::uv);
    const bool has_normals = from.attributes.contains("NORMAL");
    if (has_normals) {
        fill("NORMAL", &Vertex::normal);
        normalise_normals(mesh);
    } else {
        make_flat(mesh);
    }
    if (has_normals && from.attributes.contains("TANGENT")) {  // glTF: without normals, tangents are ignored
        fill("TANGENT", &Vertex::tangent);
    } else if (scene.materials[static_cast<std::size_t>(mesh.material)].normal_picture >= 0) {
        compute_tangents(mesh);
    } else {
        make_arbitrary_tangents(mesh);
    }
    return mesh;
}

}  // namespace

std::vector<std::vector<int>> load_meshes(const GltfFile& file, Scene& scene) {
    std::vector<std::vector<int>> meshes;
    for (const tinygltf::Mesh& from : file.model().meshes) {
        std::vector<int>& primitives = meshes.emplace_back();
        for (std::size_t i = 0; i < from.primitives.size(); ++i) {
            const std::string what = fmt::format("mesh {} \"{}\" primitive {}", meshes.size() - 1, from.name, i);
            const tinygltf::Primitive& primitive = from.primitives[i];
            if (!primitive.targets.empty()) file.skip("{}: morph targets are not supported, ignored", what);
            if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
                file.skip("{}: points and lines are not supported, left out", what);
                continue;
            }
            Mesh mesh = load_primitive(file, primitive, scene, what);
            mesh.name = from.name;
            primitives.push_back(static_cast<int>(scene.meshes.size()));
            scene.meshes.push_back(std::move(mesh));
        }
    }
    return meshes;
}

}  // namespace tyndall::gltf
