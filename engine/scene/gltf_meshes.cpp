#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

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

/// COLOR_0: three or four numbers a vertex, of which there may be none.
void load_colors(const GltfFile& file, const tinygltf::Primitive& from, Mesh& mesh, const std::string& what) {
    const auto found = from.attributes.find("COLOR_0");
    if (found == from.attributes.end()) return;
    const std::string name = what + " COLOR_0";
    const int type = file.at(file.model().accessors, found->second, name + ": accessor").type;
    const bool opaque = type == TINYGLTF_TYPE_VEC3;
    const std::vector<double> values = file.read(found->second, opaque ? type : TINYGLTF_TYPE_VEC4, name);
    const std::size_t width = opaque ? 3 : 4;
    if (values.size() != mesh.vertices.size() * width)
        file.fail("{} has {} elements, POSITION has {}", name, values.size() / width, mesh.vertices.size());
    bool clamped = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = std::clamp(values[i], 0.0, 1.0);
        clamped = clamped || share != values[i];
        mesh.vertices[i / width].color[static_cast<int>(i % width)] = static_cast<float>(share);
    }
    if (clamped) file.skip("{}: numbers outside of 0 to 1 are taken as the nearer of the two", name);
}

/// The data of a primitive that is compressed, too, must be there as it is.
void require_plain_data(const GltfFile& file, const tinygltf::Primitive& from, const std::string& what) {
    if (!from.extensions.contains("KHR_draco_mesh_compression")) return;
    std::vector<int> accessors;
    for (const auto& [name, accessor] : from.attributes) accessors.push_back(accessor);
    if (from.indices != -1) accessors.push_back(from.indices);
    for (const int accessor : accessors)
        if (file.at(file.model().accessors, accessor, what + ": accessor").bufferView < 0)
            file.fail("{}: Draco compression is not supported, and accessor {} has no other data", what, accessor);
}

/// Moves the vertices as the skin's joints do in their rest pose.
void bend(const GltfFile& file, const tinygltf::Primitive& from, const std::vector<glm::dmat4>& joints, Mesh& mesh,
          const std::string& what) {
    const auto attribute = [&](const char* name) {
        if (!from.attributes.contains(name)) file.fail("{}: has a skin and no {}", what, name);
        const auto values = file.read_vectors<4>(from.attributes.at(name), what + " " + name);
        if (values.size() != mesh.vertices.size())
            file.fail("{}: {} has {} elements, POSITION has {}", what, name, values.size(), mesh.vertices.size());
        return values;
    };
    const std::vector<glm::vec4> indices = attribute("JOINTS_0"), weights = attribute("WEIGHTS_0");
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        glm::dmat4 m(0);
        for (int k = 0; k < 4; ++k) {
            if (weights[i][k] == 0) continue;
            if (!(weights[i][k] > 0) || !(indices[i][k] >= 0 && indices[i][k] < static_cast<float>(joints.size())))
                file.fail("{}: vertex {} has the weight {} of joint {}; there are {}", what, i, weights[i][k],
                          indices[i][k], joints.size());
            m += double{weights[i][k]} * joints[static_cast<std::size_t>(indices[i][k])];
        }
        if (!(m[3][3] > 0)) file.fail("{}: vertex {} has no weights", what, i);
        m /= m[3][3];  // the weights' sum
        const glm::dmat3 turn(m);
        const glm::dmat3 cofactor(glm::cross(turn[1], turn[2]), glm::cross(turn[2], turn[0]),
                                  glm::cross(turn[0], turn[1]));
        const double side = glm::determinant(turn) < 0 ? -1 : 1;
        Vertex& v = mesh.vertices[i];
        v.position = glm::vec3(m * glm::dvec4(glm::dvec3(v.position), 1));
        v.normal = glm::vec3(side * (cofactor * glm::dvec3(v.normal)));
        v.tangent = glm::vec4(glm::vec3(turn * glm::dvec3(glm::vec3(v.tangent))), side * v.tangent.w);
    }
}

/// `joints` moves it: empty where it has no skin.
Mesh load_primitive(const GltfFile& file, const tinygltf::Primitive& from, const std::vector<glm::dmat4>& joints,
                    Scene& scene, const std::string& what) {
    require_plain_data(file, from, what);
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
    mesh.indices = load_indices(file, from, mesh.vertices.size(), what);
    const auto textures = from.material == -1 ? std::nullopt : texture_coordinates(file, from.material);
    const std::string coordinates = fmt::format("TEXCOORD_{}", textures ? textures->set : 0);
    if (from.attributes.contains(coordinates)) {
        fill(coordinates.c_str(), &Vertex::uv);
    } else if (textures) {
        file.skip("{}: has no {}, textures are read at one point", what, coordinates);
    }
    if (textures)
        for (Vertex& v : mesh.vertices) v.uv = glm::vec2(textures->transform * glm::dvec3(v.uv, 1));
    load_colors(file, from, mesh, what);
    if (from.material >= 0 && scene.materials[static_cast<std::size_t>(mesh.material)].alpha_blend &&
        file.model().materials[static_cast<std::size_t>(from.material)].alphaMode == "OPAQUE")
        for (Vertex& v : mesh.vertices) v.color.a = 1;
    const bool has_normals = from.attributes.contains("NORMAL");
    const bool has_tangents =
        has_normals && from.attributes.contains("TANGENT");  // glTF: without, they are ignored
    if (has_normals) fill("NORMAL", &Vertex::normal);
    if (has_tangents) fill("TANGENT", &Vertex::tangent);
    if (!joints.empty()) bend(file, from, joints, mesh, what);
    for (const Vertex& v : mesh.vertices) mesh.bounds.add(v.position);
    if (has_normals)
        normalise_normals(mesh);
    else
        make_flat(mesh);
    if (!has_tangents) {
        if (scene.materials[static_cast<std::size_t>(mesh.material)].normal_picture >= 0)
            compute_tangents(mesh);
        else
            make_arbitrary_tangents(mesh);
    }
    return mesh;
}

/// What is left out of a primitive.
void tell_ignored(const GltfFile& file, const tinygltf::Primitive& from, const std::string& what) {
    if (!from.targets.empty()) file.skip("{}: morph targets are not supported, ignored", what);
    constexpr std::string_view read[] = {"POSITION", "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                         "COLOR_0",  "JOINTS_0", "WEIGHTS_0"};
    std::vector<std::string> ignored;
    for (const auto& [name, accessor] :
         from.attributes)  // a texture that asks for other coordinates says so itself
        if (std::ranges::find(read, name) == std::end(read) && !name.starts_with("TEXCOORD_") && name[0] != '_')
            ignored.push_back(name);
    if (!ignored.empty()) file.skip("{}: attributes ignored: {}", what, fmt::join(ignored, ", "));
}

}  // namespace

std::vector<int> load_mesh(const GltfFile& file, int index, const std::vector<glm::dmat4>& joints, Scene& scene) {
    const tinygltf::Mesh& from = file.at(file.model().meshes, index, "mesh");
    std::vector<int> primitives;
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
        const std::string what = fmt::format("mesh {} \"{}\" primitive {}", index, from.name, i);
        const tinygltf::Primitive& primitive = from.primitives[i];
        tell_ignored(file, primitive, what);
        if (primitive.mode >= TINYGLTF_MODE_POINTS && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
            file.skip("{}: points and lines are not supported, left out", what);
            continue;
        }
        Mesh mesh = load_primitive(file, primitive, joints, scene, what);
        mesh.name = from.name;
        primitives.push_back(static_cast<int>(scene.meshes.size()));
        scene.meshes.push_back(std::move(mesh));
    }
    return primitives;
}

std::vector<std::vector<int>> load_meshes(const GltfFile& file, Scene& scene) {
    std::vector<std::vector<int>> meshes;
    for (std::size_t i = 0; i < file.model().meshes.size(); ++i)
        meshes.push_back(load_mesh(file, static_cast<int>(i), {}, scene));
    return meshes;
}

}  // namespace tyndall::gltf
