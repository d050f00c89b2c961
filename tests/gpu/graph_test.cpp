#include <gmock/gmock.h>

#include "engine/gl/readback.h"
#include "engine/gl/state.h"
#include "engine/gl/vertex_array.h"
#include "engine/graph/history.h"
#include "engine/graph/pass_list.h"
#include "engine/shader/shader_library.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/support/temp_root.h"

namespace tyndall {
namespace {

using testing::Each;
using testing::ElementsAre;

constexpr int side = 16;
const gl::TextureDesc square{gl::TextureKind::d2, GL_R32F, {side, side, 1}, 1};

class Graph : public GlTest {
  protected:
    Graph() {
        root_.write(
            "shaders/full.vert",
            "void main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0, "
            "1); }\n");
        root_.write("shaders/store.comp",
                    "layout(local_size_x = 8, local_size_y = 8) in;\n"
                    "layout(r32f, binding = 0) writeonly uniform image2D image;\n"
                    "uniform float scale;\n"
                    "void main() {\n"
                    "    ivec2 p = ivec2(gl_GlobalInvocationID.xy);\n"
                    "    imageStore(image, p, vec4(scale * float(p.x + 100 * p.y)));\n"
                    "}\n");
        root_.write("shaders/add.frag",
                    "layout(binding = 0) uniform sampler2D source;\n"
                    "out float color;\n"
                    "void main() { color = texelFetch(source, ivec2(gl_FragCoord.xy), 0).r + 1.0; }\n");
    }

    TextureRef store(PassList& list, TextureRef out, float scale) {
        list.add(
            "store", [&](PassBuilder& b) { out = b.storage_write(out); },
            [this, out, scale](const PassContext& context) {
                const gl::Program& program = library_.get(store_);
                program.use();
                program.set("scale", scale);
                glBindImageTexture(0, context.texture(out).id, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
                glDispatchCompute(side / 8, side / 8, 1);
            });
        return out;
    }
    TextureRef add_one(PassList& list, const std::string& name, TextureRef in, TextureRef out) {
        list.add(
            name,
            [&](PassBuilder& b) {
                b.sample(in);
                out = b.attach_color(out);
            },
            [this, in](const PassContext& context) {
                context.bind_framebuffer();
                gl::apply({});
                library_.get(add_).use();
                glBindTextureUnit(0, context.texture(in).id);
                gl::draw_fullscreen();
            });
        return out;
    }
    static gl::TextureView view(const PassList& list, const std::string& name) {
        for (const auto& info : list.textures())
            if (info.name == name) return {info.id, info.desc};
        return {};
    }
    void expect_store_plus(const gl::TextureView& texture, float scale, float added) const {
        const Image image = gl::read_texture(texture);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                ASSERT_EQ(image.at(x, side - 1 - y)[0], scale * static_cast<float>(x + 100 * y) + added)
                    << x << ' ' << y;
    }

    TempRoot root_;
    ShaderLibrary library_{root_.path()};
    ProgramDesc store_{"store", {{GL_COMPUTE_SHADER, "shaders/store.comp"}}, {}, {}};
    ProgramDesc add_{
        "add", {{GL_VERTEX_SHADER, "shaders/full.vert"}, {GL_FRAGMENT_SHADER, "shaders/add.frag"}}, {}, {}};
    TransientPool pool_;
};

TEST_F(Graph, StoresAreSeenByLaterPassesEveryFrame) {
    for (int frame = 1; frame <= 5; ++frame) {
        const auto scale = static_cast<float>(frame);
        PassList list;
        const TextureRef stored = store(list, list.create("stored", square), scale);
        const TextureRef once = add_one(list, "once", stored, list.create("once", square));
        const TextureRef twice = add_one(list, "twice", once, list.create("twice", square));
        const TextureRef last = add_one(list, "last", twice, list.create("last", square));
        list.export_texture(last);
        list.compile();
        list.execute(pool_);
        expect_store_plus(view(list, "last"), scale, 3);
        EXPECT_EQ(pool_.texture_count(), 2U) << "four transients take turns in two textures";
        EXPECT_EQ(pool_.bytes(), 2U * side * side * 4);
    }
}

TEST_F(Graph, AStoreIntoAReusedTextureKeepsTheEarlierResult) {
    PassList list;
    const TextureRef first = store(list, list.create("first", square), 1);
    const TextureRef sum = add_one(list, "sum", first, list.create("sum", square));
    const TextureRef kept = add_one(list, "keep", sum, list.create("kept", square));
    const TextureRef second = store(list, list.create("second", square), 7);
    list.export_texture(kept);
    list.export_texture(second);
    list.compile();
    list.execute(pool_);
    expect_store_plus(view(list, "kept"), 1, 2);
    expect_store_plus(view(list, "second"), 7, 0);
    EXPECT_EQ(pool_.texture_count(), 2U);
}

TEST_F(Graph, DrawsIntoImportedTexturesThatChange) {
    for (int frame = 0; frame < 3; ++frame) {  // each deletes its target: the driver may reuse the name
        const gl::Texture target(square, "target");
        PassList list;
        const TextureRef stored = store(list, list.create("stored", square), 1);
        list.export_texture(add_one(list, "add", stored, list.import("target", target)));
        list.compile();
        list.execute(pool_);
        expect_store_plus(target, 1, 1);
    }
}

TEST_F(Graph, CulledPassesRunNothingAndAllocateNothing) {
    PassList list;
    bool ran = false;
    TextureRef unused = list.create("unused", square);
    list.add(
        "culled", [&](PassBuilder& b) { unused = b.attach_color(unused); },
        [&](const PassContext&) { ran = true; });
    list.export_texture(list.import("other", gl::Texture(square, "other")));
    list.compile();
    list.execute(pool_);
    EXPECT_FALSE(ran);
    EXPECT_EQ(pool_.texture_count(), 0U);
}

TEST_F(Graph, TransientsCarryTheirNames) {
    PassList list;
    std::string label(64, ' ');
    TextureRef fog = list.create("fog volume", square);
    list.add(
        "draw", [&](PassBuilder& b) { fog = b.storage_write(fog); },
        [&](const PassContext& context) {
            GLsizei length = 0;
            glGetObjectLabel(GL_TEXTURE, context.texture(fog).id, 64, &length, label.data());
            label.resize(static_cast<std::size_t>(length));
        });
    list.export_texture(fog);
    list.compile();
    list.execute(pool_);
    EXPECT_EQ(label, "fog volume");
}

TEST_F(Graph, UnusedTexturesAreFreedAfterAWhile) {
    const auto run = [&](bool used) {
        PassList list;
        if (used) list.export_texture(store(list, list.create("stored", square), 1));
        list.compile();
        list.execute(pool_);
    };
    run(true);
    for (int i = 0; i < TransientPool::keep_frames; ++i) run(false);
    EXPECT_EQ(pool_.texture_count(), 1U);
    run(false);
    EXPECT_EQ(pool_.texture_count(), 0U);
}

TEST_F(Graph, PassesAreTimedAndCountedByName) {
    gl::GpuTimer timer(gl::TimerMode::finish);
    gl::WorkCounters counters;
    timer.begin_frame();
    counters.begin_frame();
    PassList list;
    const TextureRef stored = store(list, list.create("stored", square), 1);
    list.export_texture(add_one(list, "add", stored, list.create("out", square)));
    list.compile();
    list.execute(pool_, &timer, &counters);
    timer.begin_frame();
    ASSERT_EQ(timer.results().size(), 2U);
    EXPECT_EQ(timer.results()[0].name, "store");
    EXPECT_EQ(timer.results()[1].name, "add");
    EXPECT_THAT(counters.read(), testing::IsEmpty()) << "nothing was compiled to count";
}

TEST_F(Graph, UndeclaredUseIsAFailedCheck) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    PassList list;
    TextureRef mine = list.create("mine", square);
    const TextureRef other = list.create("other", square);
    list.add(
        "draw", [&](PassBuilder& b) { mine = b.storage_write(mine); },
        [&](const PassContext& context) { (void)context.texture(other); });
    list.export_texture(mine);
    list.compile();
    EXPECT_DEATH(list.execute(pool_), "draw.*other");
}

TEST_F(Graph, HistoryIsValidAfterAFrameAndInvalidAfterAChange) {
    History history;
    const auto frame = [&](const gl::TextureDesc& desc) {
        history.begin_frame(desc, "taa");
        const bool valid = history.valid();
        const GLuint current = history.current().id();
        history.end_frame();
        EXPECT_EQ(history.previous().id(), current);
        return valid;
    };
    EXPECT_FALSE(frame(square));
    EXPECT_TRUE(frame(square));
    gl::TextureDesc larger = square;
    larger.size.x = 32;
    larger.levels = 0;
    EXPECT_FALSE(frame(larger));
    EXPECT_TRUE(frame(larger)) << "a full chain is the same chain next frame";
    history.invalidate();
    EXPECT_FALSE(frame(larger));
    EXPECT_TRUE(frame(larger));
    history.begin_frame(larger, "taa");  // begun, never written
    EXPECT_FALSE(frame(larger));
    history.release();
    EXPECT_FALSE(history.valid());
    EXPECT_FALSE(history.previous());
    EXPECT_FALSE(frame(larger));
}

TEST_F(Graph, AHistoryInTheListEndsItsFrameWhenItsPassesRan) {
    History history;
    const auto frame = [&](bool wanted) {
        history.begin_frame(square, "taa");
        PassList list;
        auto [before, now] = list.import_history("taa", history);
        EXPECT_EQ(static_cast<bool>(before), history.valid());
        for (const char* name : {"draw", "more"})
            list.add(
                name,
                [&](PassBuilder& b) {
                    b.sample(before);
                    now = b.storage_write(now);
                },
                [](const PassContext&) {});
        list.export_texture(wanted ? now : list.import("other", gl::Texture(square, "other")));
        list.compile();
        const GLuint current = history.current().id();
        list.execute(pool_);
        return history.previous().id() == current;
    };
    EXPECT_TRUE(frame(true));
    EXPECT_TRUE(history.valid());
    EXPECT_TRUE(frame(true));
    EXPECT_FALSE(frame(false)) << "culled: not drawn";
    EXPECT_TRUE(frame(true));
    history.begin_frame(square, "taa");
    EXPECT_TRUE(history.valid());
}

}  // namespace
}  // namespace tyndall
