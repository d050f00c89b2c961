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

TEST(Includes, AMissingStageNamesItselfAndAllRoots) {
    TempRoot root;
    const std::filesystem::path own = root.path() / "own", others = root.path() / "others";
    try {
        (void)resolve_includes({own, others}, "shaders/none.frag");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(),
                    AllOf(HasSubstr("shaders/none.frag"), HasSubstr(own.string()), HasSubstr(others.string())));
    }
}

TEST(Includes, AreTakenFromTheFirstRootThatHasThem) {
    TempRoot root;
    const std::filesystem::path own = root.path() / "own", others = root.path() / "others";
    for (const auto& folder : {own, others}) std::filesystem::create_directories(folder / "shaders");
    root.write("own/shaders/lights.glsl", "mine\n#include \"shaders/phase.glsl\"\n");
    root.write("others/shaders/lights.glsl", "theirs\n");
    root.write("others/shaders/phase.glsl", "phase\n");
    const Roots roots{own, others};
    std::vector<std::filesystem::path> files;
    EXPECT_EQ(resolve_includes(roots, "shaders/lights.glsl", &files),
              "#line 1 0\nmine\n#line 1 1\nphase\n#line 3 0\n");
    EXPECT_THAT(files, ElementsAre(own / "shaders/lights.glsl", others / "shaders/phase.glsl"));
    EXPECT_EQ(roots.name_of(files[1]), "shaders/phase.glsl");
}

}  // namespace
}  // namespace tyndall
