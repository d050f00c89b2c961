// The reference of settings is made from the tables; this finds the copy in the repository out of date.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "engine/scene/data_root.h"
#include "support/command.h"

namespace tyndall::test {
namespace {

TEST(SettingsDocument, IsWhatTheProgramPrints) {
    const CommandResult result = run_tyndall({"list", "settings", "--markdown"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    std::ifstream file(data_root() / "docs/settings.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find(result.out), std::string::npos)
        << "docs/settings.md is old: replace its tables by `tyndall list settings --markdown`";
}

}  // namespace
}  // namespace tyndall::test
