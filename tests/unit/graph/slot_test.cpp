#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "engine/graph/pass_list.h"

namespace tyndall {
namespace {

const auto nothing = [](const PassContext&) {};

gl::TextureDesc square(int size) {
    return {gl::TextureKind::d2, GL_RGBA16F, {size, size, 1}, 1};
}

/// Passes p0 … p(n-1), each drawing into "t<i>" from t<i-1>; the last one is exported.
PassList chain(int length, const std::function<gl::TextureDesc(int)>& desc) {
    PassList list;
    TextureRef previous;
    for (int i = 0; i < length; ++i) {
        TextureRef out = list.create(fmt::format("t{}", i), desc(i));
        list.add(
            fmt::format("p{}", i),
            [&](PassBuilder& b) {
                b.sample(previous);
                out = b.attach_color(out);
            },
            nothing);
        previous = out;
    }
    list.export_texture(previous);
    list.compile();
    return list;
}

std::map<std::string, PassList::TextureInfo> by_name(const PassList& list) {
    std::map<std::string, PassList::TextureInfo> result;
    for (const PassList::TextureInfo& info : list.textures()) result[info.name] = info;
    return result;
}

TEST(Slots, AChainNeedsTwoTextures) {
    const PassList list = chain(6, [](int) { return square(8); });
    const auto textures = by_name(list);
    for (int i = 0; i < 6; ++i) {
        const auto& info = textures.at(fmt::format("t{}", i));
        EXPECT_EQ(info.slot, i % 2) << i;
        EXPECT_EQ(info.first_pass, i);
        EXPECT_EQ(info.last_pass, std::min(i + 1, 5));
    }
}

TEST(Slots, OnlyEqualDescsShare) {
    const PassList list = chain(4, [](int i) { return square(8 << i); });
    std::map<int, int> users;
    for (const auto& info : list.textures()) ++users[info.slot];
    EXPECT_EQ(users.size(), 4U);
}

TEST(Slots, AnExportedTextureIsNotGivenAway) {
    PassList list;
    TextureRef first = list.create("first", square(8));
    list.add(
        "a", [&](PassBuilder& b) { first = b.attach_color(first); }, nothing);
    TextureRef second = list.create("second", square(8));
    list.add(
        "b", [&](PassBuilder& b) { second = b.attach_color(second); }, nothing);
    list.export_texture(first);
    list.export_texture(second);
    list.compile();
    EXPECT_NE(by_name(list).at("first").slot, by_name(list).at("second").slot);
}

TEST(Slots, CulledAndImportedTexturesHaveNone) {
    PassList list;
    TextureRef unused = list.create("unused", square(8));
    list.add(
        "culled", [&](PassBuilder& b) { unused = b.attach_color(unused); }, nothing);
    list.skip("skipped", "why not");
    TextureRef target = list.import("target", gl::TextureView(9, square(8)));
    list.add(
        "draw", [&](PassBuilder& b) { target = b.attach_color(target); }, nothing);
    list.export_texture(target);
    list.compile();
    EXPECT_EQ(by_name(list).at("unused").slot, -1);
    EXPECT_FALSE(by_name(list).at("unused").live);
    EXPECT_EQ(by_name(list).at("target").slot, -1);
    EXPECT_EQ(by_name(list).at("target").first_pass, 2);  // an index into passes(), which has the skipped one
    EXPECT_STREQ(list.passes()[2].name.c_str(), "draw");
}

TEST(Slots, AFullMipChainIsResolvedWhenCreated) {
    PassList list;
    const TextureRef ref = list.create("pyramid", {gl::TextureKind::d2, GL_R32F, {640, 360, 1}, 0});
    EXPECT_EQ(list.desc(ref).levels, 10);
}

}  // namespace
}  // namespace tyndall
