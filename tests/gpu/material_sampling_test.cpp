// Vertex colours and the sampling of pictures, drawn and traced.
#include <gtest/gtest.h>

#include "engine/render/renderer.h"
#include "reference/reference.h"
#include "reference/surface.h"
#include "support/gl_test.h"
#include "support/picture_error.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

class MaterialSampling : public GlTest {
  protected:
    MaterialSampling() {
        options_.render.ambient = 0;
        options_.render.cascade_size = options_.render.static_shadow_size = 1024;
        builder_.ground({0, 0, 0}, 4, builder_.material(glm::vec3(1)));
    }
    [[nodiscard]] Scene& scene() { return builder_.scene; }
    Image draw(const std::string& layer) {
        options_.layer = layer;
        renderer_.prepare(scene(), 1);  // llvmpipe blurs magnified pictures with anisotropy
        renderer_.render(scene(), view_, size, options_);
        return renderer_.read_layer();
    }
    /// Of a pixel's ray from above.
    [[nodiscard]] glm::dvec3 traced_albedo(const reference::Geometry& geometry, int x, int y) const {
        const glm::dvec3 eye(view_.eye);
        const glm::dvec3 at(2.0 * ((x + 0.5) / size.x * 2 - 1), 0, 2.0 * ((y + 0.5) / size.y * 2 - 1));
        const glm::dvec3 d = glm::normalize(at - eye);
        const auto hit = geometry.closest_hit(eye, d, 0);
        return hit ? reference::surface_at(scene_, geometry, *hit, eye, d).base_color : glm::dvec3(0);
    }

    static constexpr glm::ivec2 size{40, 40};
    test::SceneBuilder builder_;
    const Scene& scene_ = builder_.scene;
    /// From 2 m above, so that the picture is 4 m wide on the ground.
    View view_ = look_at({0, 2, 0}, {0, 0, 0}, 1.5707964f, 0.1f, 1);
    FrameOptions options_;
    Renderer renderer_{shared_shaders()};
};

TEST_F(MaterialSampling, PicturesAreReadAsTheirSamplersSay) {
    Picture picture{"p", {4, 4}, {}, {}};
    for (int i = 0; i < 16; ++i)
        for (const int v : {i * 16, 255 - i * 13, i % 3 * 100, 255})
            picture.rgba.push_back(static_cast<std::uint8_t>(v));
    scene().pictures.push_back(picture);
    scene().materials.back().base_color_picture = 0;
    for (Vertex& v : scene().meshes[0].vertices) v.uv = v.uv * 5.0f - glm::vec2(1.6f, 2.2f);
    std::vector<Sampling> ways;
    for (const auto& [u, v] :
         {std::pair(Wrap::repeat, Wrap::mirror), {Wrap::clamp, Wrap::repeat}, {Wrap::mirror, Wrap::clamp}})
        for (const bool nearest : {false, true}) ways.push_back({.u = u, .v = v, .nearest = nearest});
    ways.push_back({.minification = GL_NEAREST});
    ways.push_back({.nearest = true, .minification = GL_LINEAR_MIPMAP_NEAREST});
    double worst = 0;
    for (const Sampling& way : ways) {
        scene().pictures[0].sampling = way;
        const Image drawn = draw("albedo");
        const reference::Geometry geometry(scene_, true);
        Image traced(size, 3);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                for (int c = 0; c < 3; ++c)
                    traced.at(x, y)[c] = static_cast<float>(traced_albedo(geometry, x, y)[c]);
        const double error = test::worst_error(drawn, traced);
        EXPECT_LT(error, 0.03) << int(way.u) << " " << int(way.v) << " " << way.nearest << " " << way.minification;
        worst = std::max(worst, error);
    }
    std::printf("worst error of sampled pictures: %.4f\n", worst);
}

TEST_F(MaterialSampling, VertexColoursMultiplyTheBaseColour) {
    scene().materials.back().base_color = {0.5f, 1, 0.8f, 1};
    std::vector<Vertex>& vertices = scene().meshes[0].vertices;
    for (Vertex& v : vertices) v.color = {1, 0.25f, 0.5f, 1};
    const Image drawn = draw("albedo");
    for (const auto& [channel, wanted] : {std::pair(0, 0.5), {1, 0.25}, {2, 0.4}})
        EXPECT_NEAR(drawn.at(20, 20)[channel], wanted, 0.005);
    // Linear between vertices, which lie at -4 and 4: 0 to 1 along x over the ground, of which half is seen.
    for (Vertex& v : vertices) v.color = {v.uv.x, 1, 1, 1};
    const Image ramp = draw("albedo");
    for (int x = 0; x < size.x; ++x)
        EXPECT_NEAR(ramp.at(x, 20)[0], 0.5 * (0.25 + 0.5 * (x + 0.5) / size.x), 0.005) << x;
}

// A masked pane, half of which its vertices' alpha cuts away, hides the ground and shades it.
TEST_F(MaterialSampling, VertexAlphaCutsMasksAndTheirShadows) {
    const int cut = builder_.material({0.2f, 0.4f, 0.8f});
    Material& material = scene().materials[static_cast<std::size_t>(cut)];
    material.alpha_mask = true;
    material.double_sided = true;
    builder_.ground({0, 0.5f, 0}, 0.8f, cut);
    for (Vertex& v : scene().meshes.back().vertices) v.color.a = v.uv.x;
    builder_.sun({-1, -1, 0}, glm::vec3(3));
    const Image drawn = draw("color");
    const reference::Reference truth(scene(), {.ambient = 0});
    const Image traced = reference::render(truth, view_, size, 1, 2).color;
    const double error = test::worst_error(drawn, traced);
    std::printf("worst error of a mask by vertex alpha: %.4f\n", error);
    EXPECT_LT(error, 0.02);
    // At 0.5 m the pane's right half, x from 0 to 0.8 m, is seen up to 0.8 * 2 / 1.5 = 1.07 m; its shadow reaches
    // from -0.5 to 0.3 m.
    const auto pixel = [&](double x) { return static_cast<int>((x / 4 + 0.5) * size.x); };
    EXPECT_GT(drawn.at(pixel(-0.8), 20)[0], 0.5f);
    EXPECT_LT(drawn.at(pixel(-0.3), 20)[0], 0.01f);
    EXPECT_GT(drawn.at(pixel(0.5), 20)[2], 2 * drawn.at(pixel(0.5), 20)[0]);
}

}  // namespace
}  // namespace tyndall
