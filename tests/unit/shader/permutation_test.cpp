#include <gmock/gmock.h>

#include "engine/shader/shader_library.h"

namespace tyndall {
namespace {

using testing::UnorderedElementsAre;

TEST(Permutations, WithoutAxesThereIsOne) {
    EXPECT_THAT(all_permutations({"p", {}, {}, {}}), UnorderedElementsAre(Permutation{}));
}

TEST(Permutations, AreTheProductOfTheAxes) {
    const ProgramDesc desc{"p", {}, {{"SUN", {0, 1}}, {"STEPS", {8, 16, 32}}}, {}};
    EXPECT_THAT(
        all_permutations(desc),
        UnorderedElementsAre(Permutation{{"SUN", 0}, {"STEPS", 8}}, Permutation{{"SUN", 0}, {"STEPS", 16}},
                             Permutation{{"SUN", 0}, {"STEPS", 32}}, Permutation{{"SUN", 1}, {"STEPS", 8}},
                             Permutation{{"SUN", 1}, {"STEPS", 16}}, Permutation{{"SUN", 1}, {"STEPS", 32}}));
}

TEST(Permutations, LeaveOutInvalidOnes) {
    const ProgramDesc desc{"p", {}, {{"SUN", {0, 1}}, {"LAMPS", {0, 1}}}, [](const Permutation& p) {
                               return p.at("SUN") == 1 || p.at("LAMPS") == 1;
                           }};
    EXPECT_THAT(all_permutations(desc),
                UnorderedElementsAre(Permutation{{"SUN", 1}, {"LAMPS", 0}}, Permutation{{"SUN", 0}, {"LAMPS", 1}},
                                     Permutation{{"SUN", 1}, {"LAMPS", 1}}));
}

TEST(PermutationMisuse, UndeclaredDefinesAndValuesFail) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const ProgramDesc desc{"march", {}, {{"SUN", {0, 1}}}, {}};
    ShaderLibrary library({"."});
    EXPECT_DEATH((void)library.get(desc), "march");
    EXPECT_DEATH((void)library.get(desc, {{"SUN", 2}}), "march SUN=2");
    EXPECT_DEATH((void)library.get(desc, {{"SUN", 1}, {"FOG", 1}}), "march FOG=1 SUN=1");
    EXPECT_DEATH((void)library.get(desc, {{"FOG", 1}}), "march FOG=1");
}

const ProgramDesc registered{"registered by this test", {}, {}, {}};
const ProgramRegistry::Registration registration{registered};

TEST(ProgramRegistry, ListsWhatRegisteredAtNamespaceScope) {
    EXPECT_THAT(ProgramRegistry::all(), testing::Contains(&registered));
}

}  // namespace
}  // namespace tyndall
