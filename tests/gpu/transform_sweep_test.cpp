// Surfaces under every kind of transform, and lights under every kind, drawn and traced: each must look as the same
// thing does with the transform worked into its vertices, or with the light simply placed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtx/quaternion.hpp>
#include <random>

#include "engine/core/files.h"
#include "engine/render/renderer.h"
#include "reference/reference.h"
#include "support/gl_test.h"
#include "support/picture_error.h"
#include "support/test_scene.h"
#include "tests/unit/support/gltf_builder.h"

namespace tyndall {
namespace {

using glm::dmat3;
using glm::dmat4;
using glm::dvec3;

constexpr glm::ivec2 size(20, 20);
constexpr float pi = 3.14159265f;

/// Translation, rotation and scale of a node.
struct Step {
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
};
/// Of nodes inside one another, the outermost first.
using Chain = std::vector<Step>;

dmat4 matrix(const Chain& chain) {
    dmat4 m(1);
    for (const Step& step : chain)
        m = glm::scale(glm::translate(m, dvec3(step.translation)) * glm::mat4_cast(glm::dquat(step.rotation)),
                       dvec3(step.scale));
    return m;
}

std::vector<Chain> transforms() {
    std::mt19937 engine(3);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine); };
    const auto rotation = [&] {
        return glm::normalize(glm::quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    };
    std::vector<Chain> all;
    for (int signs = 0; signs < 8; ++signs) {
        const glm::vec3 mirror(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1);
        all.push_back({{.scale = mirror}});
        all.push_back({{.rotation = rotation(), .scale = mirror * glm::vec3(0.5f, 1.2f, 0.8f)}});
        // Scaled across the axes of a rotated child: sheared.
        all.push_back(
            {{.rotation = rotation(), .scale = {1, 0.6f, -1.2f}}, {.rotation = rotation(), .scale = mirror}});
    }
    all.push_back({{.scale = glm::vec3(1e-12f)}, {.scale = {-1e12f, 1e12f, 1e12f}}});
    all.push_back({{.scale = glm::vec3(1e-18f)}, {.rotation = rotation(), .scale = glm::vec3(1e18f)}});
    return all;
}

/// A dome, open below, with smooth normals, a slanted normal map and one side: its outside alone is seen.
Mesh dome() {
    Mesh mesh;
    mesh.material = 1;
    constexpr int rings = 12, around = 24;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j <= around; ++j) {
            const float a = 0.6f * pi * static_cast<float>(i) / rings, b = 2 * pi * static_cast<float>(j) / around;
            const glm::vec3 n(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b));
            mesh.vertices.push_back({n * glm::vec3(1, 0.7f, 0.8f),
                                     glm::normalize(n / glm::vec3(1, 0.7f, 0.8f)),
                                     glm::vec4(std::cos(b), 0, -std::sin(b), 1),
                                     {static_cast<float>(j) / around, static_cast<float>(i) / rings}});
        }
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t j = 0; j < around; ++j) {
            const std::uint32_t k = i * (around + 1) + j, below = k + around + 1;
            for (const std::uint32_t index : {k, below, below + 1, k, below + 1, k + 1})
                mesh.indices.push_back(index);
        }
    for (const Vertex& vertex : mesh.vertices) mesh.bounds.add(vertex.position);
    return mesh;
}

/// The mesh as a transform makes it look: positions by the transform; normals by its inverse transpose, to the
/// outside; faces wound so that their outside is the front; the bitangent on the side of the transform's.
Mesh worked_in(Mesh mesh, const dmat4& m) {
    const dmat3 linear(m), carries_normals(glm::transpose(glm::inverse(linear)));
    const bool mirrored = glm::dot(glm::cross(linear[0], linear[1]), linear[2]) < 0;
    mesh.bounds = {};
    for (Vertex& v : mesh.vertices) {
        const dvec3 bitangent =
            linear * (double{v.tangent.w} * glm::cross(dvec3(v.normal), dvec3(glm::vec3(v.tangent))));
        v.position = glm::vec3(m * glm::dvec4(dvec3(v.position), 1));
        v.normal = glm::vec3(glm::normalize(carries_normals * dvec3(v.normal)));
        const glm::vec3 tangent(glm::normalize(linear * dvec3(glm::vec3(v.tangent))));
        const bool same = glm::dot(dvec3(glm::cross(v.normal, tangent)), bitangent) > 0;
        v.tangent = glm::vec4(tangent, same ? 1 : -1);
        mesh.bounds.add(v.position);
    }
    for (std::size_t i = 0; mirrored && i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

int place(Scene& scene, const Chain& chain) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        Node node;
        node.translation = chain[i].translation;
        node.rotation = chain[i].rotation;
        node.scale = chain[i].scale;
        node.parent = i == 0 ? -1 : static_cast<int>(scene.nodes.size()) - 1;
        scene.nodes.push_back(node);
    }
    return static_cast<int>(scene.nodes.size()) - 1;
}

/// How a file says a transform: by translation, rotation and scale, by a matrix, or the last step by an instance.
enum class Said { parts, matrices, instance };

nlohmann::json node_of(const Step& step, Said said) {
    if (said == Said::matrices) {
        const dmat4 m = matrix({step});
        return {{"matrix", std::vector<double>(&m[0][0], &m[0][0] + 16)}};
    }
    return {{"translation", {step.translation.x, step.translation.y, step.translation.z}},
            {"rotation", {step.rotation.x, step.rotation.y, step.rotation.z, step.rotation.w}},
            {"scale", {step.scale.x, step.scale.y, step.scale.z}}};
}

/// The mesh in a glTF file, under a chain of nodes, as it comes out of the loader.
Scene loaded(const Mesh& mesh, const Chain& chain, Said said) {
    GltfBuilder b;
    std::vector<float> positions, normals, tangents;
    for (const Vertex& v : mesh.vertices) {
        positions.insert(positions.end(), &v.position.x, &v.position.x + 3);
        normals.insert(normals.end(), &v.normal.x, &v.normal.x + 3);
        tangents.insert(tangents.end(), &v.tangent.x, &v.tangent.x + 4);
    }
    const nlohmann::json attributes = {{"POSITION", b.accessor(positions, GltfBuilder::f32, "VEC3")},
                                       {"NORMAL", b.accessor(normals, GltfBuilder::f32, "VEC3")},
                                       {"TANGENT", b.accessor(tangents, GltfBuilder::f32, "VEC4")}};
    const int indices = b.accessor(mesh.indices, GltfBuilder::u32, "SCALAR");
    const nlohmann::json primitive = {{"attributes", attributes}, {"indices", indices}};
    b.append("meshes", {{"primitives", nlohmann::json::array({primitive})}});
    const std::size_t nodes = chain.size() - (said == Said::instance ? 1 : 0);
    for (std::size_t i = 0; i < nodes; ++i) {
        b.append("nodes", node_of(chain[i], said));
        if (i > 0) b.doc["nodes"][i - 1]["children"] = {i};
    }
    if (said == Said::instance) {
        const Step& step = chain.back();
        const auto floats = [](const auto& v, int n) { return std::vector<float>(&v.x, &v.x + n); };
        const nlohmann::json of_instance = {
            {"TRANSLATION", b.accessor(floats(step.translation, 3), GltfBuilder::f32, "VEC3")},
            {"ROTATION", b.accessor<float>({step.rotation.x, step.rotation.y, step.rotation.z, step.rotation.w},
                                           GltfBuilder::f32, "VEC4")},
            {"SCALE", b.accessor(floats(step.scale, 3), GltfBuilder::f32, "VEC3")}};
        b.append("nodes", {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", of_instance}}}}}});
        if (nodes > 0) b.doc["nodes"][nodes - 1]["children"] = {nodes};
    }
    b.doc["nodes"].back()["mesh"] = 0;
    b.doc["scenes"][0]["nodes"] = {0};
    const auto path = std::filesystem::temp_directory_path() / fmt::format("tyndall_sweep.{}.gltf", ::getpid());
    write_text(path, b.text());
    Scene scene = load_gltf(path);
    std::filesystem::remove(path);
    return scene;
}

/// Puts a file's nodes and meshes into a scene, with the scene's material 1.
void add_loaded(Scene& scene, const Scene& from) {
    const auto nodes = static_cast<int>(scene.nodes.size()), meshes = static_cast<int>(scene.meshes.size());
    for (Node node : from.nodes) {
        if (node.parent >= 0) node.parent += nodes;
        for (int& mesh : node.meshes) mesh += meshes;
        scene.nodes.push_back(node);
    }
    for (const Mesh& mesh : from.meshes) scene.meshes.emplace_back(mesh).material = 1;
}

/// A floor, and lights that the caller turns on.
Scene empty_stage() {
    test::SceneBuilder builder;
    builder.ground({0, -1, 0}, 8);
    builder.scene.pictures.push_back({"slanted", {1, 1}, {178, 98, 208, 255}});
    Material& material = builder.scene.materials.emplace_back();
    material.metallic = 0;
    material.base_color = {0.8f, 0.6f, 0.4f, 1};
    material.normal_picture = 0;
    return std::move(builder.finish());
}

enum class Lit { sun, point, spot };
constexpr Lit lights[] = {Lit::sun, Lit::point, Lit::spot};

Light make_light(Lit kind) {
    Light light;
    light.type = kind == Lit::sun ? LightType::sun : kind == Lit::point ? LightType::point : LightType::spot;
    light.intensity = kind == Lit::sun ? glm::vec3(3) : glm::vec3(40);
    light.range = 40;
    light.inner_cone = 0.3f;
    light.outer_cone = 0.6f;
    return light;
}

void set_light(Scene& scene, Lit kind, const Chain& chain) {
    Light light = make_light(kind);
    light.node = place(scene, chain);
    scene.nodes.back().light = 0;
    scene.lights = {light};
    update_world_transforms(scene);
}

/// Above the stage, to one side; shines at its middle.
Chain plain_light() {
    const glm::vec3 at(2.5f, 3, 1.5f);
    return {{.translation = at, .rotation = glm::quatLookAt(glm::normalize(-at), glm::vec3(0, 1, 0))}};
}

using test::worst_error;

class TransformSweep : public GlTest {
  protected:
    TransformSweep() {
        options_.render.ambient = 0;
        options_.render.cascade_size = 512;
        options_.render.static_shadow_size = 512;
        options_.render.atlas_size = 2048;
    }
    Image draw(const Scene& scene) {
        renderer_.render(scene, view_, size, options_);
        return renderer_.read_layer();
    }
    Image trace(const Scene& scene) {
        const reference::Reference truth(scene, {.ambient = 0});
        return reference::render(truth, view_, size, 1, 2).color;
    }
    View view_ = look_at({0.5f, 4, 3.5f}, {0, -0.4f, 0}, 0.9f, 0.1f, 1);
    FrameOptions options_;
    Renderer renderer_{shared_shaders()};
};

TEST_F(TransformSweep, SurfacesLookAsTheirTransformMakesThem) {
    double worst_drawn = 0, worst_animated = 0, worst_traced = 0, worst_between = 0;
    const std::vector<Chain> chains = transforms();
    for (const Chain& chain : chains) {
        Scene baked = empty_stage();
        baked.meshes.push_back(worked_in(dome(), matrix(chain)));
        baked.nodes[static_cast<std::size_t>(place(baked, {Step{}}))].meshes = {1};
        const Said said = static_cast<Said>((&chain - chains.data()) % 3);
        Scene scene = empty_stage();
        add_loaded(scene, loaded(dome(), chain, said));
        // The same nodes, that only come to their transform after the scene was prepared.
        Scene moving = scene;
        for (std::size_t i = 1; i < moving.nodes.size(); ++i) {
            moving.nodes[i].dynamic = true;
            moving.nodes[i].scale = glm::vec3(1);
        }
        for (const Lit kind : lights) {
            Scene expected = baked, placed = scene, animated = moving;
            for (Scene* s : {&expected, &placed, &animated}) set_light(*s, kind, plain_light());
            renderer_.prepare(expected);
            const Image wanted = draw(expected), truth = trace(expected);
            renderer_.prepare(placed);
            const double drawn = worst_error(draw(placed), wanted), traced = worst_error(trace(placed), truth);
            // Shadow maps are compared with the truth elsewhere: near the terminator of a slanted normal they
            // differ.
            placed.lights[0].shadow = false;
            const double between = worst_error(draw(placed), trace(placed));
            if (kind == Lit::sun) {
                renderer_.prepare(animated);
                (void)draw(animated);
                for (std::size_t i = 1; i < scene.nodes.size(); ++i) animated.nodes[i].scale = scene.nodes[i].scale;
                update_world_transforms(animated);
                worst_animated = std::max(worst_animated, worst_error(draw(animated), wanted));
            }
            if (std::max({drawn, traced, between}) > 0.02)
                ADD_FAILURE() << "transform " << &chain - chains.data() << " light " << int(kind) << ": drawn "
                              << drawn << ", traced " << traced << ", drawn against traced " << between;
            worst_drawn = std::max(worst_drawn, drawn);
            worst_traced = std::max(worst_traced, traced);
            worst_between = std::max(worst_between, between);
        }
    }
    std::printf("worst error of surfaces: drawn %.4f, animated %.4f, traced %.4f, drawn against traced %.4f\n",
                worst_drawn, worst_animated, worst_traced, worst_between);
    EXPECT_LT(worst_drawn, 0.02);
    EXPECT_LT(worst_animated, 0.02);
    EXPECT_LT(worst_traced, 0.02);
    EXPECT_LT(worst_between, 0.02);
}

// Squares that face +Y, above the floor and seen from above, turned or mirrored to face -Y: their backs are not
// seen, whatever else the scene holds.
TEST_F(TransformSweep, OneMirroredNodeLeavesCullingToTheOthers) {
    view_ = look_at({0, 4, 0}, {0, 0, 0}, 0.9f, 0.1f, 1);
    options_.layer = "depth";
    const Step turned{.translation = {0.7f, 1, 0}, .rotation = glm::angleAxis(pi, glm::vec3(1, 0, 0))};
    const Step mirrored{.translation = {-0.7f, 1, 0}, .scale = {1, -1, 1}};
    const Step seen{.translation = {0, 1, 0.9f}, .scale = {-1, 1, 1}};
    test::SceneBuilder builder;
    builder.ground({0, 0, 0}, 8);
    builder.ground({0, 0, 0}, 0.5f);
    Scene scene = std::move(builder.finish());
    scene.nodes[1].meshes.clear();
    for (const Step& step : {turned, mirrored, seen})
        scene.nodes[static_cast<std::size_t>(place(scene, {step}))].meshes = {1};
    update_world_transforms(scene);
    renderer_.prepare(scene);
    const Image depth = draw(scene);
    const reference::Reference truth(scene, {.ambient = 0});
    const Image traced = reference::render(truth, view_, size, 1, 2).depth;
    const auto pixel = [&](float place, float height) {
        return static_cast<int>((place / (std::tan(0.45f) * (4 - height)) * 0.5f + 0.5f) * size.x);
    };
    for (const Image* image : {&depth, &traced}) {
        EXPECT_NEAR(image->at(pixel(0.7f, 1), 10)[0], 4, 1e-3);
        EXPECT_NEAR(image->at(pixel(-0.7f, 1), 10)[0], 4, 1e-3);
        EXPECT_NEAR(std::min(image->at(10, pixel(0.9f, 1))[0], image->at(10, pixel(-0.9f, 1))[0]), 3, 1e-3);
    }
    EXPECT_EQ(renderer_.draw_counts().draw_calls, 2u);  // one for each winding
}

// A ball that a scale of 0 flattens is a disc, lit as a plane is.
TEST_F(TransformSweep, FlattenedSurfacesAreLitAsPlanes) {
    view_ = look_at({0.03f, 3, 0.01f}, {0.02f, 0, 0}, 0.4f, 0.1f, 1);  // within the disc; no ray along an edge
    const glm::quat lean = glm::normalize(glm::quat(1, 0.3f, -0.5f, 0.2f));
    const glm::quat back = glm::angleAxis(-pi / 2, glm::vec3(1, 0, 0));
    const Chain chains[] = {{{.scale = {1, 0, 1}}},
                            {{.scale = {-1, 0, 1}}},
                            {{.rotation = back, .scale = {1, 1, 0}}},
                            {{.scale = {1, 0, 1}}, {.rotation = lean}},
                            {{.scale = {1, 0, -2}}, {.rotation = lean, .scale = {1, -1, 1}}},
                            {{.scale = {1, 1e-20f, 1}}}};
    double worst = 0;
    for (const Lit kind : lights) {
        test::SceneBuilder plane, ball;
        plane.ground({0, 0, 0}, 4);
        ball.sphere({0, 0, 0}, 1);
        Scene expected = std::move(plane.finish()), scene = std::move(ball.finish());
        set_light(expected, kind, plain_light());
        expected.lights[0].shadow = false;
        renderer_.prepare(expected);
        const Image wanted = draw(expected), truth = trace(expected);
        for (const Chain& chain : chains) {
            Scene flat = scene;
            flat.nodes.clear();
            flat.nodes[static_cast<std::size_t>(place(flat, chain))].meshes = {0};
            set_light(flat, kind, plain_light());
            flat.lights[0].shadow = false;
            renderer_.prepare(flat);
            const double drawn = worst_error(draw(flat), wanted), traced = worst_error(trace(flat), truth);
            EXPECT_LT(std::max(drawn, traced), 0.02) << "light " << int(kind) << " chain " << &chain - chains
                                                     << " drawn " << drawn << " traced " << traced;
            worst = std::max({worst, drawn, traced});
        }
    }
    std::printf("worst error of flattened surfaces: %.4f\n", worst);
}

/// Where -Z of the innermost node points, a scale of 0 being the limit of small ones.
dvec3 shines_along(Chain chain) {
    for (Step& step : chain)
        for (int axis = 0; axis < 3; ++axis)
            if (step.scale[axis] == 0) step.scale[axis] = 1e-4f;
    return glm::normalize(dmat3(matrix(chain)) * dvec3(0, 0, -1));
}

TEST_F(TransformSweep, LightsShineAsTheirTransformTurnsThem) {
    std::vector<Chain> chains = transforms();
    const glm::quat lean = glm::angleAxis(0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    const glm::quat down = glm::angleAxis(-pi / 2, glm::vec3(1, 0, 0));
    for (const glm::vec3 flat : {glm::vec3(0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 1), glm::vec3(1, 0, 1),
                                 glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(-2, 0, 0.5f)}) {
        chains.push_back({{.scale = flat}});
        chains.push_back({{.rotation = lean, .scale = flat}, {.scale = {1, -1, 1}}});
        chains.push_back({{.scale = flat}, {.rotation = down}});
    }
    chains.push_back({{.scale = glm::vec3(1e-30f)}});
    chains.push_back({{.scale = {1e-15f, 1e15f, -1}}});
    double worst_drawn = 0, worst_traced = 0;
    for (const Lit kind : lights) {
        Scene expected = empty_stage();
        set_light(expected, kind, plain_light());
        renderer_.prepare(expected);
        const Image wanted = draw(expected), truth = trace(expected);
        for (std::size_t i = 0; i < chains.size(); ++i) {
            const glm::vec3 at = plain_light().front().translation;
            Chain chain = chains[i];
            chain.insert(chain.begin(),
                         {.translation = at,
                          .rotation = glm::quat(glm::rotation(shines_along(chain), glm::normalize(-dvec3(at))))});
            Scene scene = empty_stage();
            set_light(scene, kind, chain);
            renderer_.prepare(scene);
            const double drawn = worst_error(draw(scene), wanted), traced = worst_error(trace(scene), truth);
            EXPECT_LT(std::max(drawn, traced), 0.02) << "light " << int(kind) << " chain " << i;
            worst_drawn = std::max(worst_drawn, drawn);
            worst_traced = std::max(worst_traced, traced);
        }
    }
    std::printf("worst error of lights: drawn %.4f, traced %.4f\n", worst_drawn, worst_traced);
}

}  // namespace
}  // namespace tyndall
