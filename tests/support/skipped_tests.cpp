// Tells of each skipped test and its reason, which gtest's brief output leaves out: on stdout, and at the end of
// the file that $TYNDALL_SKIPPED_TESTS names.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

namespace tyndall::test {
namespace {

class TellOfSkippedTests : public ::testing::EmptyTestEventListener {
    void OnTestEnd(const ::testing::TestInfo& test) override {
        if (!test.result()->Skipped()) return;
        std::string line = std::string("skipped ") + test.test_suite_name() + "." + test.name() + ":";
        for (int i = 0; i < test.result()->total_part_count(); ++i)
            if (const ::testing::TestPartResult& part = test.result()->GetTestPartResult(i); part.skipped())
                line += std::string(" ") + part.message();
        std::ranges::replace(line, '\n', ' ');
        std::cout << line << '\n';
        if (const char* path = std::getenv("TYNDALL_SKIPPED_TESTS"))
            std::ofstream(path, std::ios::app) << line << '\n';
    }
};

[[maybe_unused]] const bool listening = [] {
    ::testing::UnitTest::GetInstance()->listeners().Append(new TellOfSkippedTests);
    return true;
}();

}  // namespace
}  // namespace tyndall::test
