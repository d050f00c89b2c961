// The renderer's slot for modules, by modules that paint.
#include "engine/render/frame_module.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/render/renderer.h"
#include "engine/scene/data_root.h"
#include "support/gl_test.h"
#include "support/test_scene.h"

namespace tyndall {
namespace {

/// Paints the whole of the picture, and of a layer of its own.
class Painter : public FrameModule {
  public:
    Painter(std::string name, float value) : name_(std::move(name)), value_(value) {}

    [[nodiscard]] bool wants_motion(const FrameContext&) const override { return motion; }
    void add_before_lighting(FrameContext& frame, const GBuffer& gbuffer, std::span<const Aabb> transparents,
                             LightSources& lights) override {
        motion_made = static_cast<bool>(gbuffer.motion);
        saw_transparents = !transparents.empty();
        asked = std::ranges::count(frame.layers, name_) > 0;
        if (!casts_shadow) return;
        lights.bind = [this, bind = lights.bind] {
            bind();
            ++bound;
        };
    }
    [[nodiscard]] TextureRef add_after_lighting(FrameContext& frame, TextureRef color) override {
        layer_ = {};
        if (paints_layer)
            layer_ = paint(frame, frame.passes.create(name_, {.format = GL_RGBA16F, .size = {frame.size, 1}}));
        return paint(frame, color);
    }
    [[nodiscard]] TextureRef add_display(FrameContext& frame, TextureRef display) override {
        return shows ? paint(frame, display) : TextureRef();
    }
    [[nodiscard]] std::vector<Layer> layers() const override {
        return {{.name = name_, .texture = layer_, .absent = 7}};
    }
    void forget_history() override { ++cuts; }

    bool motion = false, casts_shadow = false, paints_layer = true, shows = false;
    bool motion_made = false, saw_transparents = false, asked = false;
    int bound = 0, cuts = 0;

  private:
    TextureRef paint(FrameContext& frame, TextureRef target) const {
        frame.passes.add(
            name_, [&](PassBuilder& pass) { target = pass.attach_color(target); },
            [value = value_](const PassContext& pass) {
                pass.bind_framebuffer();
                const float colour[4] = {value, value, value, 1};
                glClearBufferfv(GL_COLOR, 0, colour);
            });
        return target;
    }
    std::string name_;
    float value_;
    TextureRef layer_;
};

class FrameModules : public GlTest {
  protected:
    FrameModules() {
        builder_.ground({0, 0, 0}, 20);
        builder_.box({0, 1, -2}, {1, 1, 1});
        builder_.scene.nodes[1].dynamic = true;
        builder_.sun({-1, -2, -1}, glm::vec3(10000));
        renderer_.prepare(builder_.finish());
    }
    void draw() {
        renderer_.render(builder_.scene, look_at({0, 2, 8}, {0, 1, 0}, 1.0F, 0.1F, 1.5F), {24, 16}, options_);
    }
    static bool is(const Image& image, float value) {
        return std::ranges::all_of(image.pixels, [&](float v) { return v == value; });
    }
    [[nodiscard]] bool runs(const std::string& pass) const {
        return std::ranges::count(renderer_.passes().live_pass_names(), pass) > 0;
    }

    test::SceneBuilder builder_;
    FrameOptions options_;
    ShaderLibrary shaders_{data_root()};
    Painter first_{"first", 0.25F}, second_{"second", 0.5F};
    Renderer renderer_{shaders_, {&first_, &second_}};
};

TEST_F(FrameModules, PaintOverTheLitSurfacesInTheirOrder) {
    draw();
    EXPECT_TRUE(is(renderer_.read_layer(), 0.5F));
    EXPECT_TRUE(runs("lighting") && runs("tonemap"));
}

TEST_F(FrameModules, HaveLayersThatReadAsAbsentWhereTheFrameHasNone) {
    options_.layer = "first";
    options_.more_layers = {"second", "depth"};
    second_.paints_layer = false;
    draw();
    EXPECT_TRUE(first_.asked && second_.asked);
    EXPECT_TRUE(is(renderer_.read_layer(), 0.25F));
    EXPECT_TRUE(is(renderer_.read_layer("second"), 7));
    EXPECT_EQ(renderer_.read_layer("depth").channels, 1);
    options_ = {};
    draw();
    EXPECT_FALSE(first_.asked);
}

TEST_F(FrameModules, LayersOfNoModuleAreRefused) {
    options_.layer = "third";
    EXPECT_THROW(draw(), UsageError);
    EXPECT_EQ(Renderer::layer_names({}),
              (std::vector<std::string>{"color", "depth", "albedo", "normal", "emissive"}));
}

TEST_F(FrameModules, MayTakeTheTonemapsPlace) {
    first_.shows = true;
    draw();
    EXPECT_FALSE(runs("tonemap"));
    EXPECT_NEAR(renderer_.read_display().at(3, 3)[0], 0.25F, 0.5F / 255);
}

TEST_F(FrameModules, BindWhatSurfacesReadOfThem) {
    draw();
    EXPECT_EQ(first_.bound, 0);
    first_.casts_shadow = true;
    draw();
    EXPECT_EQ(first_.bound, 1) << "by the pass lighting";
}

TEST_F(FrameModules, GetMotionWhereOneWantsItAndSomethingMoves) {
    const auto moved = [&] {
        builder_.scene.nodes[1].world[3].x += 0.1F;
        draw();
        return first_.motion_made;
    };
    draw();
    EXPECT_FALSE(moved());
    second_.motion = true;
    EXPECT_TRUE(moved());
    draw();
    EXPECT_FALSE(first_.motion_made) << "nothing moves";
}

TEST_F(FrameModules, KnowOfTransparentSurfacesAndOfCuts) {
    draw();
    EXPECT_FALSE(first_.saw_transparents);
    const int glass = builder_.material(glm::vec3(1), 1);
    builder_.scene.materials[static_cast<std::size_t>(glass)].alpha_blend = true;
    builder_.box({0, 1, 2}, {1, 1, 0.1F}, glass);
    renderer_.prepare(builder_.finish());
    draw();
    EXPECT_TRUE(first_.saw_transparents);
    EXPECT_EQ(second_.cuts, 0);
    renderer_.invalidate_history();
    EXPECT_EQ(second_.cuts, 1);
}

}  // namespace
}  // namespace tyndall
