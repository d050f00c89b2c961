#include <gmock/gmock.h>

#include "engine/core/error.h"
#include "engine/shader/shader_library.h"
#include "tests/support/temp_root.h"

namespace tyndall {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Includes, ResolveNestedOnesInPlace) {
    TempRoot root;
    root.write("shaders/main.frag", "a\n#include \"shaders/outer.glsl\"\nb\n");
    root.write("shaders/outer.glsl", "o1\n  #  include \"shaders/inner.glsl\" // why\no3\n");
    root.write("shaders/inner.glsl", "i1\n");
    std::vector<std::filesystem::path> files;
    EXPECT_EQ(resolve_includes(root.path(), "shaders/main.frag", &files),
              "#line 1 0\na\n#line 1 1\no1\n#line 1 2\ni1\n#line 3 1\no3\n#line 3 0\nb\n");
    EXPECT_THAT(files, ElementsAre(root.path() / "shaders/main.frag", root.path() / "shaders/outer.glsl",
                                   root.path() / "shaders/inner.glsl"));
}

TEST(Includes, ReadEachFileOnceAndKeepLineNumbers) {
    TempRoot root;
    root.write("shaders/a.glsl", "#include \"shaders/b.glsl\"\n#include \"shaders/b.glsl\"\nend\n");
    root.write("shaders/b.glsl", "#include \"shaders/a.glsl\"\nonce\n");
    EXPECT_EQ(resolve_includes(root.path(), "shaders/a.glsl"), "#line 1 0\n#line 1 1\n\nonce\n#line 2 0\n\nend\n");
}

TEST(Includes, LeaveTheOtherLanguagesIncludes) {
    TempRoot root;
    root.write("shaders/a.h", "#include <glm/glm.hpp>\n#include \"engine/x.h\"\n");
    EXPECT_EQ(resolve_includes(root.path(), "shaders/a.h"),
              "#line 1 0\n#include <glm/glm.hpp>\n#include \"engine/x.h\"\n");
}

TEST(Includes, NumberFilesOnAcrossStages) {
    TempRoot root;
    root.write("shaders/a.vert", "v\n");
    root.write("shaders/a.frag", "f\n");
    std::vector<std::filesystem::path> files;
    (void)resolve_includes(root.path(), "shaders/a.vert", &files);
    EXPECT_EQ(resolve_includes(root.path(), "shaders/a.frag", &files), "#line 1 1\nf\n");
}

TEST(Includes, AMissingFileNamesItsIncluderAndLine) {
    TempRoot root;
    root.write("shaders/a.frag", "\n\n#include \"shaders/gone.glsl\"\n");
    try {
        (void)resolve_includes(root.path(), "shaders/a.frag");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("shaders/a.frag:3:"), HasSubstr("shaders/gone.glsl")));
    }
}

TEST(Includes, AMissingStageNamesItself) {
    TempRoot root;
    EXPECT_THROW((void)resolve_includes(root.path(), "shaders/none.frag"), Error);
}

}  // namespace
}  // namespace tyndall
