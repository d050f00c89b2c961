#include "engine/render/draw_list.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/gl/framebuffer.h"
#include "engine/gl/program.h"
#include "engine/gl/readback.h"
#include "engine/gl/state.h"
#include "engine/render/alpha_coverage.h"
#include "support/gl_test.h"

namespace tyndall {
namespace {

using testing::Each;
using testing::Eq;

/// A square (in x and y) of the given half size around its node.
Mesh square(float half, int material) {
    Mesh mesh;
    mesh.material = material;
    for (const glm::vec2 p : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.vertices.push_back({{p * half, 0}, {0, 0, 1}, {1, 0, 0, 1}, p});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.bounds = {{-half, -half, 0}, {half, half, 0}};
    return mesh;
}

/// Squares on an 8 x 8 grid of unit cells with the lower left corner at the origin; node i is at cell
/// (i % 8, i / 8). Meshes and materials alternate in a way that sorting must change.
Scene grid() {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[2].alpha_blend = true;
    for (const int material : {1, 0, 1, 2}) scene.meshes.push_back(square(0.3f, material));
    for (int i = 0; i < 64; ++i) {
        Node& node = scene.nodes.emplace_back();
        node.translation = {static_cast<float>(i % 8) + 0.5f, static_cast<float>(i / 8) + 0.5f, 0};
        node.meshes = {i * 7 % 4};
        node.cast_shadow = i % 3 != 0;
        node.dynamic = i % 5 == 0;
    }
    update_world_transforms(scene);
    return scene;
}

bool is_blended(const Scene& scene, int node) {
    return scene.nodes[static_cast<std::size_t>(node)].meshes[0] == 3;
}

/// What meets x, y in [min, max].
glm::mat4 window(glm::vec2 min, glm::vec2 max) {
    return glm::ortho(min.x, max.x, min.y, max.y, -1.0f, 1.0f);
}

/// Draws node indices (plus one) as colours, one pixel per cell.
class DrawListTest : public GlTest {
  protected:
    DrawListTest() {
        const std::string vertex = R"(#version 450 core
            layout(location = 0) in vec3 position;
            layout(location = 5) in mat3x4 model_rows;
            layout(location = 8) in uint drawn;
            uniform mat4 view_projection;
            flat out uint instance;
            void main() {
                instance = drawn;
                gl_Position = view_projection * vec4(vec4(position, 1) * model_rows, 1);
            })";
        const std::string fragment = R"(#version 450 core
            flat in uint instance;
            uniform int material;
            out vec4 color;
            void main() { color = vec4(float(instance) + 1, float(material), 0, 1); })";
        program_ = gl::Program({{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}, "draw list test");
        target_ = gl::Texture({gl::TextureKind::d2, GL_RGBA32F, {8, 8, 1}, 1}, "draw list target");
        const gl::Attachment color{target_};
        framebuffer_ = gl::Framebuffer(std::span(&color, 1), nullptr, "draw list target");
    }

    /// Nodes by cell (row 0 at the bottom), -1 where nothing was drawn. Checks that each was drawn with its
    /// material.
    std::vector<int> draw(const Scene& scene, const GpuScene& gpu, const DrawList& list, int view = 0) {
        framebuffer_.bind();
        target_.clear_float(0, 0, 0, 0);
        gl::apply({});
        program_.use();
        program_.set("view_projection", window({0, 0}, {8, 8}));
        list.draw(
            gpu,
            [&](DrawList::Surfaces surfaces) {
                program_.set("material", surfaces.material);
                return true;
            },
            view);
        const Image image = gl::read_texture(target_);
        std::vector<int> nodes;
        for (int i = 0; i < 64; ++i) {
            const float* pixel = image.at(i % 8, 7 - i / 8);
            if (pixel[0] == 0) {
                nodes.push_back(-1);
                continue;
            }
            const Instance& instance = gpu.instances()[static_cast<std::size_t>(pixel[0]) - 1];
            EXPECT_EQ(static_cast<int>(pixel[1]), instance.material);
            EXPECT_EQ(scene.nodes[static_cast<std::size_t>(instance.node)].meshes[0], instance.mesh);
            nodes.push_back(instance.node);
        }
        return nodes;
    }

    gl::Program program_;
    gl::Texture target_;
    gl::Framebuffer framebuffer_;
};

TEST_F(DrawListTest, DrawsEveryOpaqueInstanceInItsPlace) {
    const Scene scene = grid();
    const GpuScene gpu(scene);
    DrawList list;
    list.build(gpu, Frustum::from(window({0, 0}, {8, 8})), DrawList::Filter::all);
    const std::vector<int> nodes = draw(scene, gpu, list);
    for (int i = 0; i < 64; ++i) EXPECT_EQ(nodes[static_cast<std::size_t>(i)], is_blended(scene, i) ? -1 : i);
    EXPECT_EQ(list.instance_count(), 48u);
    EXPECT_EQ(list.triangle_count(), 96u);
    EXPECT_EQ(list.draw_call_count(), 2u);
}

TEST_F(DrawListTest, ViewsAreCulledAndDrawnApart) {
    const Scene scene = grid();
    const GpuScene gpu(scene);
    const std::pair<glm::vec2, glm::vec2> windows[] = {
        {{0, 0}, {3, 3}}, {{100, 100}, {101, 101}}, {{2.5f, 4.5f}, {7.5f, 5.5f}}};
    std::vector<Frustum> frusta;
    for (const auto& [min, max] : windows) frusta.push_back(Frustum::from(window(min, max)));
    DrawList list;
    list.build(gpu, frusta, DrawList::Filter::all);
    for (int view = 0; view < 3; ++view) {
        const auto& [min, max] = windows[view];
        const std::vector<int> nodes = draw(scene, gpu, list, view);
        std::size_t expected_count = 0;
        for (int i = 0; i < 64; ++i) {
            const glm::vec2 center(scene.nodes[static_cast<std::size_t>(i)].translation);
            const bool meets =
                glm::all(glm::greaterThan(center + 0.3f, min)) && glm::all(glm::lessThan(center - 0.3f, max));
            const bool expected = meets && !is_blended(scene, i);
            EXPECT_EQ(nodes[static_cast<std::size_t>(i)], expected ? i : -1) << view;
            expected_count += expected ? 1 : 0;
        }
        EXPECT_EQ(list.instance_count(view), expected_count);
    }
    EXPECT_EQ(list.draw_call_count(1), 0u);
}

TEST_F(DrawListTest, FiltersShadowCasters) {
    const Scene scene = grid();
    const GpuScene gpu(scene);
    const Frustum all = Frustum::from(window({0, 0}, {8, 8}));
    DrawList moving_casters, static_casters;
    moving_casters.build(gpu, all, DrawList::Filter::moving_shadow_casters);
    static_casters.build(gpu, all, DrawList::Filter::static_shadow_casters);
    const std::vector<int> moving = draw(scene, gpu, moving_casters), still = draw(scene, gpu, static_casters);
    for (int i = 0; i < 64; ++i) {
        const bool casts = i % 3 != 0 && !is_blended(scene, i);
        EXPECT_EQ(moving[static_cast<std::size_t>(i)], casts && i % 5 == 0 ? i : -1);
        EXPECT_EQ(still[static_cast<std::size_t>(i)], casts && i % 5 != 0 ? i : -1);
    }
}

TEST_F(DrawListTest, DynamicInstancesMoveAndTheirBoundsWithThem) {
    Scene scene = grid();
    GpuScene gpu(scene);
    const Frustum cell_61 = Frustum::from(window({5, 7}, {6, 8}));
    const Frustum elsewhere = Frustum::from(window({20, 20}, {21, 21}));
    ASSERT_TRUE(is_blended(scene, 61));  // nothing is drawn there yet
    EXPECT_FALSE(gpu.has_dynamic_caster(cell_61));
    scene.nodes[10].translation = scene.nodes[61].translation;
    scene.nodes[63].translation = {20.5f, 20.5f, 0};  // not declared dynamic: it stays
    update_world_transforms(scene);
    gpu.update(scene);
    EXPECT_TRUE(gpu.has_dynamic_caster(cell_61));
    EXPECT_FALSE(gpu.has_dynamic_caster(elsewhere));
    DrawList list;
    list.build(gpu, cell_61, DrawList::Filter::static_shadow_casters);
    EXPECT_EQ(list.instance_count(), 0u);
    list.build(gpu, Frustum::from(window({0, 0}, {8, 8})), DrawList::Filter::all);
    const std::vector<int> nodes = draw(scene, gpu, list);
    EXPECT_EQ(nodes[61], 10);
    EXPECT_EQ(nodes[10], -1);
    EXPECT_EQ(nodes[63], 63);
}

TEST_F(DrawListTest, CullingKeepsExactlyWhatFrustumTestsKeep) {
    Scene scene;
    scene.materials.resize(1);
    scene.meshes = {square(1, 0)};
    std::mt19937 random(3);
    std::uniform_real_distribution<float> u(-30, 30);
    for (int i = 0; i < 500; ++i) {
        Node& node = scene.nodes.emplace_back();
        node.meshes = {0};
        node.translation = {u(random), u(random), u(random)};
        node.rotation = glm::normalize(glm::quat(u(random), u(random), u(random), u(random)));
    }
    update_world_transforms(scene);
    const GpuScene gpu(scene);
    std::vector<Frustum> frusta;
    for (int i = 0; i < 40; ++i)
        frusta.push_back(Frustum::from(
            look_at({u(random), u(random), u(random)}, {u(random), u(random), u(random)}, 1, 0.1f, 1.5f)
                .view_projection));
    DrawList list;
    list.build(gpu, frusta, DrawList::Filter::all);
    for (int view = 0; view < 40; ++view) {
        const auto expected = std::ranges::count_if(gpu.instances(), [&](const Instance& instance) {
            return frusta[static_cast<std::size_t>(view)].intersects(instance.bounds);
        });
        EXPECT_EQ(list.instance_count(view), static_cast<std::size_t>(expected));
    }
}

GLint level_parameter(GLuint texture, GLenum name) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, 0, name, &value);
    return value;
}

TEST_F(DrawListTest, PicturesAreUploadedOncePerColourSpace) {
    Scene scene;
    scene.pictures = {{"p", {4, 2}, std::vector<std::uint8_t>(32, 128)}};
    scene.materials.resize(2);
    for (Material& material : scene.materials)
        material.base_color_picture = material.normal_picture = material.occlusion_picture = 0;
    scene.materials[1].alpha_mask = true;
    const GpuScene gpu(scene);
    const GpuScene::GpuMaterial &a = gpu.material(0), &b = gpu.material(1);
    EXPECT_EQ(level_parameter(a.base_color, GL_TEXTURE_INTERNAL_FORMAT), GL_SRGB8_ALPHA8);
    EXPECT_EQ(level_parameter(a.normal, GL_TEXTURE_INTERNAL_FORMAT), GL_RGBA8);
    EXPECT_EQ(a.normal, a.occlusion);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(level_parameter(a.base_color, GL_TEXTURE_WIDTH), 4);
    for (const GLuint neutral : {a.metallic_roughness, a.emissive})
        EXPECT_EQ(level_parameter(neutral, GL_TEXTURE_WIDTH), 1);
    EXPECT_LT(a.emissive_alpha_cutoff.a, 0);
    EXPECT_EQ(b.emissive_alpha_cutoff.a, 0.5f);
    GLint wrap = 0;
    glGetTextureParameteriv(a.base_color, GL_TEXTURE_WRAP_S, &wrap);
    EXPECT_EQ(wrap, GL_REPEAT);
}

TEST_F(DrawListTest, MaskedPicturesKeepTheirCoverageInTheDistance) {
    Scene scene;
    Picture leaves{"leaves", {64, 64}, std::vector<std::uint8_t>(64 * 64 * 4, 200)};
    std::mt19937 random(1);
    for (std::size_t i = 3; i < leaves.rgba.size(); i += 4) leaves.rgba[i] = random() % 4 == 0 ? 255 : 0;
    scene.pictures = {leaves};
    scene.materials.resize(2);
    scene.materials[0].base_color_picture = scene.materials[1].base_color_picture = 0;
    scene.materials[1].alpha_mask = true;
    const GpuScene gpu(scene);
    const auto level_3 = [&](int material) {
        std::vector<std::uint8_t> rgba(8 * 8 * 4);
        glGetTextureImage(gpu.material(material).base_color, 3, GL_RGBA, GL_UNSIGNED_BYTE,
                          static_cast<GLsizei>(rgba.size()), rgba.data());
        return rgba;
    };
    EXPECT_LT(alpha_coverage(level_3(0), 0.5f), 0.1f);
    EXPECT_NEAR(alpha_coverage(level_3(1), 0.5f), alpha_coverage(leaves.rgba, 0.5f), 0.05f);
    EXPECT_EQ(level_3(1)[0], 200);  // colours are stored as they were, not converted twice
}

TEST_F(DrawListTest, AnEmptySceneDrawsNothing) {
    const Scene scene;
    const GpuScene gpu(scene);
    DrawList list;
    list.build(gpu, Frustum::from(window({0, 0}, {8, 8})), DrawList::Filter::all);
    EXPECT_THAT(draw(scene, gpu, list), Each(Eq(-1)));
    EXPECT_EQ(list.instance_count() + list.triangle_count() + list.draw_call_count(), 0u);
}

}  // namespace
}  // namespace tyndall
