#include <gtest/gtest.h>

#include "engine/graph/pass_list.h"

namespace tyndall {
namespace {

const gl::TextureDesc mipped{gl::TextureKind::d2, GL_R32F, {8, 8, 1}, 0};
const auto nothing = [](const PassContext&) {};

class PassListMisuse : public testing::Test {
  protected:
    PassListMisuse() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
    void add(const std::function<void(PassBuilder&)>& setup) { list_.add("pass_x", setup, nothing); }
    PassList list_;
    TextureRef texture_ = list_.create("depth_pyramid", mipped);
};

TEST_F(PassListMisuse, StaleVersionIsNamed) {
    add([&](PassBuilder& b) { b.attach_color(texture_); });
    EXPECT_DEATH(add([&](PassBuilder& b) { b.sample(texture_); }), "depth_pyramid");
    EXPECT_DEATH(list_.export_texture(texture_), "depth_pyramid");
}

TEST_F(PassListMisuse, StaleBufferIsNamed) {
    const BufferRef buffer = list_.import_buffer("cluster_list", 1);
    add([&](PassBuilder& b) { b.write(buffer); });
    EXPECT_DEATH(add([&](PassBuilder& b) { b.read(buffer); }), "cluster_list");
}

TEST_F(PassListMisuse, ReadingWhatNothingWrote) {
    add([&](PassBuilder& b) { b.sample(texture_); });
    EXPECT_DEATH(list_.compile(), "pass_x.*depth_pyramid");
}

TEST_F(PassListMisuse, UpdatingWhatNothingWrote) {
    add([&](PassBuilder& b) { b.storage_read_write(texture_); });
    EXPECT_DEATH(list_.compile(), "depth_pyramid");
}

TEST_F(PassListMisuse, TestingDepthThatNothingWrote) {
    add([&](PassBuilder& b) { b.attach_depth_read_only(texture_); });
    EXPECT_DEATH(list_.compile(), "depth_pyramid");
}

TEST_F(PassListMisuse, ExportingWhatNothingWrote) {
    list_.export_texture(texture_);
    EXPECT_DEATH(list_.compile(), "depth_pyramid");
}

TEST_F(PassListMisuse, WritingAfterExport) {
    add([&](PassBuilder& b) { texture_ = b.attach_color(texture_); });
    list_.export_texture(texture_);
    EXPECT_DEATH(add([&](PassBuilder& b) { b.attach_color(texture_); }), "depth_pyramid");
}

TEST_F(PassListMisuse, WritingAnEmptyRef) {
    EXPECT_DEATH(add([&](PassBuilder& b) { b.attach_color(TextureRef{}); }), "resources_");
}

TEST_F(PassListMisuse, FeedbackLoop) {
    add([&](PassBuilder& b) { texture_ = b.attach_color(texture_); });
    add([&](PassBuilder& b) {
        b.sample(texture_);
        b.attach_color(texture_, 1);
    });
    EXPECT_DEATH(list_.compile(), "pass_x.*depth_pyramid");
}

TEST_F(PassListMisuse, FeedbackLoopOfOneLevel) {
    add([&](PassBuilder& b) { texture_ = b.attach_color(texture_); });
    add([&](PassBuilder& b) {
        b.sample(texture_, 1);
        b.attach_color(texture_, 1);
    });
    EXPECT_DEATH(list_.compile(), "depth_pyramid");
}

TEST_F(PassListMisuse, SamplingAnotherLevelOrReadOnlyDepthIsFine) {
    add([&](PassBuilder& b) { texture_ = b.attach_color(texture_); });
    add([&](PassBuilder& b) {
        b.sample(texture_, 0);
        texture_ = b.attach_color(texture_, 1);
    });
    add([&](PassBuilder& b) {
        b.sample(texture_);
        b.attach_depth_read_only(texture_);
        b.keep();
    });
    list_.compile();
    EXPECT_EQ(list_.live_pass_names().size(), 3U);
}

TEST_F(PassListMisuse, AddingAfterCompile) {
    list_.compile();
    EXPECT_DEATH(add([](PassBuilder&) {}), "pass_x");
}

}  // namespace
}  // namespace tyndall
