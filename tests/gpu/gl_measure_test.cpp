
#include <chrono>

#include "engine/core/files.h"
#include "engine/gl/framebuffer.h"
#include "engine/gl/query.h"
#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "engine/gl/work_counters.h"
#include "engine/scene/data_root.h"
#include "engine/shader/shader_library.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/support/temp_root.h"

namespace tyndall {
namespace {

using gl::TimerMode;
using gl::Work;

/// Draws into a 64 x 32 target with the engine's own fullscreen.vert and work.glsl.
class GlMeasure : public GlTest {
  protected:
    static constexpr int width = 64, height = 32;

    GlMeasure() {
        for (const char* path :
             {"shaders/lib/fullscreen.vert", "shaders/lib/work.glsl", "shaders/shared/bindings.h"}) {
            std::filesystem::create_directories((root_.path() / path).parent_path());
            root_.write(path, read_text(data_root() / path));
        }
    }
    void draw(int count_work) {
        framebuffer_.bind();
        gl::apply({});
        library_.get(desc_, {{"COUNT_WORK", count_work}}).use();
        gl::draw_fullscreen();
    }

    TempRoot root_;
    ShaderLibrary library_{root_.path()};
    ProgramDesc desc_{"counted",
                      {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"}, {GL_FRAGMENT_SHADER, "shaders/a.frag"}},
                      {{"COUNT_WORK", {0, 1}}},
                      {}};
    gl::Texture target_{{gl::TextureKind::d2, GL_R32F, {width, height, 1}, 1}, "target"};
    gl::Attachment attachment_{target_};
    gl::Framebuffer framebuffer_{{&attachment_, 1}, nullptr, "target"};
};

TEST_F(GlMeasure, WorkIsCountedExactly) {
    root_.write("shaders/a.frag",
                "#include \"shaders/lib/work.glsl\"\n"
                "out float color;\n"
                "void main() {\n"
                "    for (int i = 0; i < 3; ++i) count_work(WORK_MEDIUM_SAMPLES, 1u);\n"
                "    if (gl_FragCoord.x < 16.0) count_work(WORK_LIGHT_EVALUATIONS, 5u);\n"
                "    count_work(WORK_TEXTURE_FETCHES, 3000000u);\n"
                "    color = 1.0;\n"
                "    flush_work();\n"
                "}\n");
    gl::WorkCounters counters;
    for (int frame = 0; frame < 2; ++frame) {  // the second frame starts at zero again
        counters.begin_frame();
        counters.begin_pass("uncounted");
        draw(0);
        counters.begin_pass("once");
        draw(1);
        counters.begin_pass("twice");
        draw(1);
        draw(1);
    }
    const auto counts = counters.read();
    ASSERT_EQ(counts.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::uint64_t pixels = static_cast<std::uint64_t>(width) * height * (i + 1);
        EXPECT_EQ(counts[i].first, i == 0 ? "once" : "twice");
        const auto count = [&](Work work) { return counts[i].second[static_cast<std::size_t>(work)]; };
        EXPECT_EQ(count(Work::medium_samples), 3 * pixels);
        EXPECT_EQ(count(Work::shadow_lookups), 0U);
        EXPECT_EQ(count(Work::light_evaluations), 5 * pixels / 4);
        EXPECT_EQ(count(Work::texture_fetches), 3000000 * pixels) << "more than 32 bits hold";
    }
}

// The uncounted text must hold no storage block, or a pass without counters bound would fault.
TEST_F(GlMeasure, UncountedShadersHaveNoCounters) {
    root_.write("shaders/a.frag",
                "#include \"shaders/lib/work.glsl\"\n"
                "out float color;\n"
                "void main() { count_work(WORK_SHADOW_LOOKUPS, 1u); color = 1.0; flush_work(); }\n");
    for (int count_work : {0, 1}) {
        GLint blocks = -1;
        glGetProgramInterfaceiv(library_.get(desc_, {{"COUNT_WORK", count_work}}).id(), GL_SHADER_STORAGE_BLOCK,
                                GL_ACTIVE_RESOURCES, &blocks);
        EXPECT_EQ(blocks, count_work);
    }
}

class GlTimer : public GlMeasure {
  protected:
    GlTimer() {
        root_.write("shaders/a.frag",
                    "out float color;\n"
                    "void main() { float x = gl_FragCoord.x; for (int i = 0; i < 200; ++i) x = sin(x) + 1.0; "
                    "color = x; }\n");
        draw(0);  // compiled before it is timed
    }
    void frame(gl::GpuTimer& timer) {
        timer.begin_frame();
        timer.begin("light");
        draw(0);
        timer.end();
        timer.begin("heavy");
        for (int i = 0; i < 20; ++i) draw(0);
        timer.end();
    }
};

TEST_F(GlTimer, FinishModeMeasuresTheWallClock) {
    gl::GpuTimer timer(TimerMode::finish);
    frame(timer);
    glFinish();
    const auto before = std::chrono::steady_clock::now();
    frame(timer);
    glFinish();
    const double whole =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count();
    timer.begin_frame();
    ASSERT_EQ(timer.results().size(), 2U);
    const auto &light = timer.results()[0], &heavy = timer.results()[1];
    EXPECT_EQ(light.name, "light");
    EXPECT_EQ(heavy.name, "heavy");
    EXPECT_GT(light.gpu_ms, 0);
    EXPECT_GT(heavy.gpu_ms, light.gpu_ms) << "20 draws against one";
    EXPECT_LE(light.gpu_ms + heavy.gpu_ms, whole);
    EXPECT_GT(light.gpu_ms + heavy.gpu_ms, 0.5 * whole) << "waits for the work, not only for its submission";
    EXPECT_GE(heavy.gpu_ms, heavy.cpu_ms);
}

TEST_F(GlTimer, QueriesArriveWithoutWaiting) {
    gl::GpuTimer timer(TimerMode::query);
    for (int i = 0; i < 8; ++i) frame(timer);
    glFinish();
    timer.begin_frame();
    ASSERT_EQ(timer.results().size(), 2U);
    EXPECT_EQ(timer.results()[1].name, "heavy");
    for (const auto& scope : timer.results()) {
        EXPECT_GE(scope.gpu_ms, 0);
        EXPECT_LT(scope.gpu_ms, 60e3);
    }
}

TEST_F(GlTimer, OffMeasuresNothingAndModesChangeBetweenFrames) {
    gl::GpuTimer timer(TimerMode::off);
    frame(timer);
    timer.set_mode(TimerMode::finish);
    frame(timer);
    EXPECT_TRUE(timer.results().empty());
    timer.set_mode(TimerMode::off);
    frame(timer);
    EXPECT_EQ(timer.results().size(), 2U) << "the frame that was measured";
    frame(timer);
    EXPECT_TRUE(timer.results().empty());
}

}  // namespace
}  // namespace tyndall
