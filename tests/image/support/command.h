#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyndall::test {

struct CommandResult {
    int exit_code = -1;  ///< -1: killed by a signal, or ran out of time
    std::string out, err;
};
/// Runs the built `tyndall` with `arguments`, without a shell. `environment` entries are NAME=VALUE; "NAME"
/// removes.
[[nodiscard]] CommandResult run_tyndall(const std::vector<std::string>& arguments,
                                        const std::vector<std::string>& environment = {},
                                        int timeout_seconds = 120);

/// A fresh folder that goes with the object.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    [[nodiscard]] std::filesystem::path path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  private:
    std::filesystem::path path_;
};

/// The level, and a small scene for tests that need no level.
[[nodiscard]] std::string level();

}  // namespace tyndall::test
