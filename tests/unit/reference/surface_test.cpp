#include "reference/surface.h"

#include <gtest/gtest.h>

#include "reference/surface_texture.h"
#include "support/scene_of_triangles.h"

namespace tyndall::reference {
namespace {

using test::SceneOfTriangles;

void expect_near(dvec3 found, dvec3 expected, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], tolerance) << c;
}

TEST(SurfaceTexture, IsBilinearAndRepeats) {
    const Picture picture{"p", {2, 2}, {0, 0, 0, 0, 255, 0, 0, 255, 0, 255, 0, 51, 255, 255, 255, 255}};
    expect_near(sample(picture, {0.25, 0.25}, false), {0, 0, 0}, 1e-12);
    expect_near(sample(picture, {0.75, 0.25}, false), {1, 0, 0}, 1e-12);
    expect_near(sample(picture, {0.5, 0.25}, false), {0.5, 0, 0}, 1e-12);
    expect_near(sample(picture, {0.35, 0.65}, false), {0.2, 0.8, 0.16}, 1e-12);
    // Half a texel beyond the last one the first is met again.
    expect_near(sample(picture, {1.0, 0.25}, false), {0.5, 0, 0}, 1e-12);
    for (const dvec2 shift : {dvec2(1, 0), dvec2(-3, 7), dvec2(1000, -1000)})
        expect_near(sample(picture, dvec2(0.35, 0.65) + shift, false), {0.2, 0.8, 0.16}, 1e-9);
    EXPECT_NEAR(sample(picture, {0.25, 0.75}, false).a, 0.2, 1e-12);
    EXPECT_TRUE(std::isfinite(sample(picture, {1e30, -1e30}, false).r));
}

TEST(SurfaceTexture, GoesOnBeyondItsEdgesAsItsSamplingSays) {
    Picture picture{"p", {4, 1}, {}};
    for (const int v : {0, 51, 102, 153}) picture.rgba.insert(picture.rgba.end(), 4, static_cast<std::uint8_t>(v));
    picture.sampling.nearest = true;
    // Texels by place: -5 to 9.
    const std::pair<Wrap, std::vector<int>> rows[] = {{Wrap::repeat, {3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1}},
                                                      {Wrap::mirror, {3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0, 1}},
                                                      {Wrap::clamp, {0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3, 3}}};
    for (const auto& [wrap, texels] : rows)
        for (int i = 0; i < 15; ++i) {
            picture.sampling.u = wrap;
            for (const double within : {0.01, 0.5, 0.99})
                EXPECT_NEAR(sample(picture, {(i - 5 + within) / 4, 0}, false).r,
                            texels[static_cast<std::size_t>(i)] / 5.0, 1e-12)
                    << int(wrap) << " " << i;
        }
    picture.sampling = {.u = Wrap::clamp};
    EXPECT_NEAR(sample(picture, {0.25, 0}, false).r, 0.1, 1e-12);
    EXPECT_NEAR(sample(picture, {0.01, 0}, false).r, 0, 1e-12);
}

TEST(SurfaceTexture, DecodesColourBeforeItFilters) {
    const Picture picture{"p", {2, 1}, {0, 0, 0, 0, 188, 10, 255, 188}};
    // IEC 61966-2-1: 188 is 0.5029, 10 lies on the linear part.
    const dvec4 texel = sample(picture, {0.75, 0.5}, true), half = sample(picture, {0.5, 0.5}, true);
    expect_near(texel, {0.50289, 10 / 255.0 / 12.92, 1}, 1e-5);
    EXPECT_NEAR(texel.a, 188 / 255.0, 1e-12);
    expect_near(half, 0.5 * dvec3(texel), 1e-12);
}

/// A square of 4 m in the plane y = 0, facing +Y, u along +X and v along +Z (so that the bitangent, for a tangent
/// of positive sign, points along -Z).
class SurfaceAt : public testing::Test {
  protected:
    SurfaceAt() {
        SceneOfTriangles::quad(built_.mesh(), {-2, 0, -2}, {4, 0, 0}, {0, 0, 4});
        for (Vertex& vertex : mesh().vertices) vertex.normal = {0, 1, 0};
        std::swap(mesh().indices[1], mesh().indices[2]);
        std::swap(mesh().indices[4], mesh().indices[5]);
    }
    Mesh& mesh() { return built_.scene.meshes[0]; }
    Material& material() { return built_.scene.materials[0]; }
    int picture(std::vector<std::uint8_t> rgba) {
        built_.scene.pictures.push_back({"p", {1, 1}, std::move(rgba), {}});
        return static_cast<int>(built_.scene.pictures.size()) - 1;
    }
    [[nodiscard]] Surface seen_from(dvec3 eye, dvec3 at = {0.3, 0, 0.4}) const {
        const Geometry geometry(built_.scene, true);
        const dvec3 d = glm::normalize(at - eye);
        const auto hit = geometry.closest_hit(eye, d, 0);
        EXPECT_TRUE(hit);
        return surface_at(built_.scene, geometry, hit.value(), eye, d);
    }
    SceneOfTriangles built_;
};

TEST_F(SurfaceAt, FactorsAndTexturesMultiply) {
    Material& m = material();
    m.base_color = {0.5f, 0.25f, 1, 1};
    m.roughness = 0.5f;
    m.metallic = 0.25f;
    m.emissive = {100, 200, 400};
    m.occlusion_strength = 0.5f;
    m.dielectric_f0 = 0.07f;
    Surface plain = seen_from({0, 3, 0});
    expect_near(plain.position, {0.3, 0, 0.4}, 1e-12);
    expect_near(plain.base_color, {0.5, 0.25, 1}, 1e-7);
    EXPECT_NEAR(plain.occlusion, 1, 1e-12);
    EXPECT_NEAR(plain.dielectric_f0, 0.07, 1e-7);

    for (Vertex& vertex : mesh().vertices) vertex.color = {0.5f, 1, 0.25f, 1};
    expect_near(seen_from({0, 3, 0}).base_color, {0.25, 0.25, 0.25}, 1e-7);
    for (Vertex& vertex : mesh().vertices) vertex.color = glm::vec4(1);
    m.base_color_picture = m.emissive_picture = picture({255, 188, 0, 255});
    m.metallic_roughness_picture = m.occlusion_picture = picture({51, 102, 204, 0});
    const Surface s = seen_from({0, 3, 0});
    expect_near(s.base_color, {0.5, 0.25 * 0.50289, 0}, 1e-5);
    expect_near(s.emissive, {100, 200 * 0.50289, 0}, 1e-2);
    EXPECT_NEAR(s.roughness, 0.5 * 0.4, 1e-6);
    EXPECT_NEAR(s.metallic, 0.25 * 0.8, 1e-6);
    EXPECT_NEAR(s.occlusion, 1 + 0.5 * (0.2 - 1), 1e-6);
}

TEST_F(SurfaceAt, NormalsFollowTheMapAndTheSide) {
    expect_near(seen_from({0, 3, 0}).normal, {0, 1, 0}, 1e-12);
    // The back shows the normal reversed.
    expect_near(seen_from({0, -3, 0}).normal, {0, -1, 0}, 1e-12);
    expect_near(seen_from({0, -3, 0}).geometric_normal, {0, -1, 0}, 1e-12);

    material().normal_picture = picture({128, 128, 255, 255});
    expect_near(seen_from({0, 3, 0}).normal, {0, 1, 0}, 1e-12);  // 128 is flat, exactly
    material().normal_picture = picture({128 + 60, 128, 128 + 80, 255});
    expect_near(seen_from({0, 3, 0}).normal, {0.6, 0.8, 0}, 1e-7);
    expect_near(seen_from({0, -3, 0}).normal, {-0.6, -0.8, 0}, 1e-7);
    expect_near(seen_from({0, 3, 0}).geometric_normal, {0, 1, 0}, 1e-12);
    // The bitangent is the normal crossed with the tangent.
    material().normal_picture = picture({128, 128 + 60, 128 + 80, 255});
    expect_near(seen_from({0, 3, 0}).normal, {0, 0.8, -0.6}, 1e-7);
    for (Vertex& vertex : mesh().vertices) vertex.tangent.w = -1;
    expect_near(seen_from({0, 3, 0}).normal, {0, 0.8, 0.6}, 1e-7);
    material().normal_scale = 0;
    expect_near(seen_from({0, 3, 0}).normal, {0, 1, 0}, 1e-12);
}

TEST_F(SurfaceAt, TransformsCarryNormals) {
    // Stretching x by 2 tilts a normal of (1, 1, 0) to (1/2, 1, 0).
    for (Vertex& vertex : mesh().vertices) vertex.normal = glm::normalize(glm::vec3(1, 1, 0));
    built_.scene.nodes[0].world[0] *= 2.0f;
    expect_near(seen_from({0, 3, 0}).normal, glm::normalize(dvec3(0.5, 1, 0)), 1e-6);
    // A mirror turns x around and leaves the side that is seen.
    built_.scene.nodes[0].world[0] *= -1.0f;
    const Surface mirrored = seen_from({0, 3, 0});
    expect_near(mirrored.normal, glm::normalize(dvec3(-0.5, 1, 0)), 1e-6);
    expect_near(mirrored.geometric_normal, {0, 1, 0}, 1e-12);
    // Of a mirrored relief the bump follows the mirrored tangent.
    for (Vertex& vertex : mesh().vertices) vertex.normal = {0, 1, 0};
    material().normal_picture = picture({128 + 60, 128, 128 + 80, 255});
    expect_near(seen_from({0, 3, 0}).normal, {-0.6, 0.8, 0}, 1e-7);
    material().normal_picture = picture({128, 128 + 60, 128 + 80, 255});
    expect_near(seen_from({0, 3, 0}).normal, {0, 0.8, -0.6}, 1e-7);
}

TEST_F(SurfaceAt, NormalsAreInterpolated) {
    // Normals lean outwards along x at the two ends: 0 in the middle, and linear before they are normalised.
    for (Vertex& vertex : mesh().vertices) vertex.normal = {vertex.position.x, 2, 0};
    expect_near(seen_from({0, 3, 0}, {0.5, 0, -1}).normal, glm::normalize(dvec3(0.5, 2, 0)), 1e-7);
    expect_near(seen_from({0, 3, 0}, {-1.5, 0, 1.2}).normal, glm::normalize(dvec3(-1.5, 2, 0)), 1e-7);
}

}  // namespace
}  // namespace tyndall::reference
