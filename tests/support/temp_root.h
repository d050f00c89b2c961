#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tyndall {

/// A folder of shader files that lives as long as the test.
class TempRoot {
  public:
    TempRoot() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::temp_directory_path() /
                ("tyndall_" + std::string(info->test_suite_name()) + "_" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_ / "shaders");
    }
    ~TempRoot() { std::filesystem::remove_all(path_); }
    TempRoot(const TempRoot&) = delete;
    TempRoot& operator=(const TempRoot&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

  private:
    std::filesystem::path path_;
};

}  // namespace tyndall
