#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/graph/pass_list.h"

namespace tyndall {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const gl::TextureDesc small{gl::TextureKind::d2, GL_RGBA16F, {8, 8, 1}, 1};
const auto nothing = [](const PassContext&) {};

/// Adds a pass that samples `inputs` and draws into a new texture of its own name.
TextureRef draw(PassList& list, const std::string& name, const std::vector<TextureRef>& inputs) {
    TextureRef out = list.create(name + "_out", small);
    list.add(
        name,
        [&](PassBuilder& b) {
            for (TextureRef ref : inputs) b.sample(ref);
            out = b.attach_color(out);
        },
        nothing);
    return out;
}

TEST(Cull, KeepsTheChainThatLeadsToAnExport) {
    PassList list;
    const TextureRef a = draw(list, "a", {});
    const TextureRef b = draw(list, "b", {a});
    draw(list, "side", {a});
    list.export_texture(draw(list, "c", {b}));
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("a", "b", "c"));
    EXPECT_EQ(list.passes()[2].reason, "nothing uses side_out");
}

TEST(Cull, TakesAWholeChainThatNobodyNeeds) {
    PassList list;
    draw(list, "c", {draw(list, "b", {draw(list, "a", {})})});
    list.export_texture(draw(list, "other", {}));
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("other"));
}

TEST(Cull, AListThatExportsNothingIsAnError) {
    PassList list;
    draw(list, "a", {});
    EXPECT_THAT([&] { list.compile(); }, testing::ThrowsMessage<Error>(testing::HasSubstr("none of its 1 passes")));
    PassList without_passes, kept;
    EXPECT_NO_THROW(without_passes.compile());
    kept.add(
        "present", [](PassBuilder& b) { b.keep(); }, nothing);
    EXPECT_NO_THROW(kept.compile());
}

TEST(Cull, KeepsBothSidesOfADiamond) {
    PassList list;
    const TextureRef top = draw(list, "top", {});
    const TextureRef left = draw(list, "left", {top});
    const TextureRef right = draw(list, "right", {top});
    list.export_texture(draw(list, "bottom", {left, right}));
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("top", "left", "right", "bottom"));
}

TEST(Cull, AWriteKeepsEarlierWritesOfTheSameTexture) {
    PassList list;
    TextureRef color = draw(list, "opaque", {});
    list.add(
        "transparent", [&](PassBuilder& b) { color = b.attach_color(color); }, nothing);
    list.export_texture(color);
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("opaque", "transparent"));
}

TEST(Cull, AWriteAfterTheLastNeededUseIsCulled) {
    PassList list;
    TextureRef shared = draw(list, "first", {});
    const TextureRef out = draw(list, "reader", {shared});
    list.add(
        "second", [&](PassBuilder& b) { shared = b.storage_write(shared); }, nothing);
    list.export_texture(out);
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("first", "reader"));
}

TEST(Cull, KeepIsAnEffectOfItsOwn) {
    PassList list;
    const TextureRef a = draw(list, "a", {});
    list.add(
        "read_back",
        [&](PassBuilder& b) {
            b.sample(a);
            b.keep();
        },
        nothing);
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("a", "read_back"));
}

TEST(Cull, WritingAnImportedTextureCountsOnlyIfExported) {
    for (bool exported : {false, true}) {
        PassList list;
        TextureRef target = list.import("target", gl::TextureView(7, small));
        list.add(
            "draw", [&](PassBuilder& b) { target = b.attach_color(target); }, nothing);
        list.export_texture(exported ? target : list.import("other", gl::TextureView(8, small)));
        list.compile();
        EXPECT_EQ(list.live_pass_names().size(), exported ? 1U : 0U);
    }
}

TEST(Cull, BuffersCarryNeedToo) {
    PassList list;
    BufferRef lights = list.import_buffer("lights", 3);
    list.add(
        "cluster", [&](PassBuilder& b) { lights = b.write(lights); }, nothing);
    TextureRef out = list.create("out", small);
    list.add(
        "light",
        [&](PassBuilder& b) {
            b.read(lights);
            out = b.attach_color(out);
        },
        nothing);
    list.export_texture(out);
    list.compile();
    EXPECT_THAT(list.live_pass_names(), ElementsAre("cluster", "light"));
}

TEST(Cull, SkippedPassesKeepTheirPlaceAndReason) {
    PassList list;
    draw(list, "a", {});
    list.skip("fog", "no medium in the scene");
    list.export_texture(draw(list, "b", {}));
    list.compile();
    ASSERT_EQ(list.passes().size(), 3U);
    EXPECT_EQ(list.passes()[1].name, "fog");
    EXPECT_FALSE(list.passes()[1].live);
    EXPECT_EQ(list.passes()[1].reason, "no medium in the scene");
    EXPECT_TRUE(list.passes()[2].live);
}

TEST(Cull, EmptyRefsAreIgnored) {
    PassList list;
    TextureRef out = list.create("out", small);
    list.add(
        "draw",
        [&](PassBuilder& b) {
            EXPECT_FALSE(b.sample(TextureRef{}));
            EXPECT_FALSE(b.read(BufferRef{}));
            out = b.attach_color(out);
        },
        nothing);
    list.export_texture(out);
    list.compile();
    EXPECT_THAT(list.passes()[0].reads, IsEmpty());
    EXPECT_THAT(list.passes()[0].writes, ElementsAre("out"));
}

TEST(PassText, SaysStateReasonAndBarrier) {
    PassList list;
    TextureRef image = list.create("image", small);
    list.add(
        "fill", [&](PassBuilder& b) { image = b.storage_write(image); }, nothing);
    list.skip("fog", "no medium in the scene");
    draw(list, "unused", {image});
    list.export_texture(draw(list, "show", {image}));
    list.compile();
    const std::string text = list.to_text();
    EXPECT_THAT(text, testing::ContainsRegex("fill +live +- -> image"));
    EXPECT_THAT(text, testing::ContainsRegex("fog +skipped +no medium in the scene"));
    EXPECT_THAT(text, testing::ContainsRegex("unused +culled +image -> unused_out +nothing uses unused_out"));
    EXPECT_THAT(text, testing::ContainsRegex("show +live +image -> show_out +after barrier texture_fetch\n"));
    EXPECT_THAT(text, testing::ContainsRegex("image +8x8x1 +0.00 MiB +slot 0 +fill .. show"));
    EXPECT_THAT(text, testing::ContainsRegex("unused_out +8x8x1 +0.00 MiB +no slot +not used"));

    const std::string dot = list.to_dot();
    EXPECT_THAT(dot, HasSubstr("\"pass 0: fill\" -> \"image v1\";"));
    EXPECT_THAT(dot, HasSubstr("\"image v1\" -> \"pass 3: show\";"));
    EXPECT_THAT(dot, HasSubstr("\"pass 2: unused\" [shape=box, style=dashed];"));
}

}  // namespace
}  // namespace tyndall
