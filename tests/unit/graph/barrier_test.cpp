#include <gtest/gtest.h>

#include "engine/graph/pass_list.h"

namespace tyndall {
namespace {

const gl::TextureDesc small{gl::TextureKind::d2, GL_RGBA16F, {8, 8, 1}, 2};
const auto nothing = [](const PassContext&) {};
using Setup = std::function<TextureRef(PassBuilder&, TextureRef)>;

/// Runs the setups as passes on one imported texture and gives each pass's barrier.
std::vector<GLbitfield> barriers(const std::vector<Setup>& setups) {
    PassList list;
    TextureRef texture = list.import("texture", gl::TextureView(1, small));
    for (const Setup& setup : setups) {
        list.add(
            "pass",
            [&](PassBuilder& b) {
                texture = setup(b, texture);
                b.keep();
            },
            nothing);
    }
    list.compile();
    std::vector<GLbitfield> result;
    for (const PassList::PassInfo& info : list.passes()) result.push_back(info.barrier);
    return result;
}

const Setup store = [](PassBuilder& b, TextureRef t) { return b.storage_write(t); };
const Setup update = [](PassBuilder& b, TextureRef t) { return b.storage_read_write(t); };
const Setup sample = [](PassBuilder& b, TextureRef t) { return b.sample(t); };
const Setup draw = [](PassBuilder& b, TextureRef t) { return b.attach_color(t); };
constexpr GLbitfield fetch = GL_TEXTURE_FETCH_BARRIER_BIT, image = GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
                     framebuffer = GL_FRAMEBUFFER_BARRIER_BIT;

TEST(Barriers, FollowFromTheWriteAndTheUse) {
    EXPECT_EQ(barriers({store, sample}), (std::vector<GLbitfield>{0, fetch}));
    EXPECT_EQ(barriers({store, update}), (std::vector<GLbitfield>{0, image}));
    EXPECT_EQ(barriers({store, store}), (std::vector<GLbitfield>{0, image}));
    EXPECT_EQ(barriers({store, draw}), (std::vector<GLbitfield>{0, framebuffer}));
}

TEST(Barriers, AttachmentsNeedNone) {
    EXPECT_EQ(barriers({draw, sample, draw, sample}), (std::vector<GLbitfield>{0, 0, 0, 0}));
}

TEST(Barriers, OneIsEnoughUntilTheNextWrite) {
    EXPECT_EQ(barriers({store, sample, sample}), (std::vector<GLbitfield>{0, fetch, 0}));
    EXPECT_EQ(barriers({store, sample, store, sample}), (std::vector<GLbitfield>{0, fetch, image, fetch}));
}

// GL 4.5 section 7.12.2: stores after the barrier wait for all accesses before it, fetches included.
TEST(Barriers, AStoreWaitsForEarlierReads) {
    EXPECT_EQ(barriers({sample, store}), (std::vector<GLbitfield>{0, image}));
    EXPECT_EQ(barriers({draw, store}), (std::vector<GLbitfield>{0, image}));
}

TEST(Barriers, OfBuffers) {
    const std::pair<Access, GLbitfield> table[] = {
        {Access::storage_read, GL_SHADER_STORAGE_BARRIER_BIT},
        {Access::indirect, GL_COMMAND_BARRIER_BIT},
        {Access::vertex, GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT},
        {Access::uniform, GL_UNIFORM_BARRIER_BIT},
        {Access::sample, GL_TEXTURE_FETCH_BARRIER_BIT},
        {Access::copy, GL_BUFFER_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT},
    };
    for (const auto& [access, expected] : table) {
        PassList list;
        BufferRef buffer = list.import_buffer("buffer", 1);
        list.add(
            "write", [&](PassBuilder& b) { buffer = b.write(buffer); }, nothing);
        list.add(
            "use",
            [&, a = access](PassBuilder& b) {
                b.read(buffer, a);
                b.keep();
            },
            nothing);
        list.compile();
        EXPECT_EQ(list.passes()[0].barrier, 0U);
        EXPECT_EQ(list.passes()[1].barrier, expected) << static_cast<int>(access);
    }
}

TEST(Barriers, CulledPassesCauseNone) {
    PassList list;
    TextureRef a = list.import("a", gl::TextureView(1, small));
    TextureRef b = list.import("b", gl::TextureView(2, small));
    list.add(
        "live", [&](PassBuilder& p) { b = p.storage_write(b); }, nothing);
    list.export_texture(b);
    list.add(
        "culled", [&](PassBuilder& p) { a = p.storage_write(a); }, nothing);
    list.add(
        "last",
        [&](PassBuilder& p) {
            p.sample(b);
            p.keep();
        },
        nothing);
    list.compile();
    EXPECT_EQ(list.passes()[1].barrier, 0U);
    EXPECT_EQ(list.passes()[2].barrier, fetch);
}

// "second" takes the texture of "first": its store must wait for the fetches of "first", another resource.
TEST(Barriers, FollowATextureToItsNextTransient) {
    const gl::TextureDesc other{gl::TextureKind::d2, GL_R32F, {4, 4, 1}, 1};
    PassList list;
    TextureRef first = list.create("first", small), out = list.create("out", other);
    list.add(
        "draw", [&](PassBuilder& b) { first = b.attach_color(first); }, nothing);
    list.add(
        "reduce",
        [&](PassBuilder& b) {
            b.sample(first);
            out = b.attach_color(out);
        },
        nothing);
    TextureRef second = list.create("second", small);
    list.add(
        "store", [&](PassBuilder& b) { second = b.storage_write(second); }, nothing);
    list.export_texture(out);
    list.export_texture(second);
    list.compile();
    ASSERT_EQ(list.textures()[0].slot, list.textures()[2].slot);
    EXPECT_EQ(list.passes()[2].barrier, image);
}

}  // namespace
}  // namespace tyndall
