// What the window shows before the first frame. No display needed.
#include "sample_game/ui/loading_picture.h"

#include <gtest/gtest.h>

#include "engine/gl/readback.h"
#include "engine/scene/data_root.h"

namespace tyndall {
namespace {

/// Pixels of the rows from `top` to `bottom` that are brighter than the ground by far.
int bright_pixels(const Image& image, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y)
        for (int x = 0; x < image.size.x; ++x) count += image.at(x, y)[0] > 0.5f ? 1 : 0;
    return count;
}

TEST(LoadingPicture, HasTextAndABarThatGrows) {
    ContextRequest request;
    request.kind = ContextKind::egl;
    request.size = {320, 180};
    const auto context = create_context(request);
    ShaderLibrary shaders(data_root());
    LoadingPicture loading(*context, shaders);
    loading.show("reading abbey.glb", 0.25f);
    const Image first = gl::read_texture(loading.picture());
    ASSERT_EQ(first.size, glm::ivec2(320, 180));
    EXPECT_GT(first.at(1, 1)[0], 0.05f) << "not black";
    EXPECT_GT(bright_pixels(first, 76, 116), 200) << "the name, three times as large as other text";
    EXPECT_GT(bright_pixels(first, 117, 131), 60) << "what is being done";
    loading.show("reading abbey.glb", 0.75f);
    const Image later = gl::read_texture(loading.picture());
    EXPECT_GT(bright_pixels(later, 131, 180), 2 * bright_pixels(first, 131, 180));
    EXPECT_GT(bright_pixels(first, 131, 180), 50);
}

}  // namespace
}  // namespace tyndall
