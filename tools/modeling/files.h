#pragma once

#include <optional>
#include <string>

namespace tyndall::modeling {

// Through a temporary name, so that a failure leaves nothing partial behind. False: it could not be written.
bool write_file(const std::string& path, const std::string& bytes);
// Empty: it could not be read.
std::optional<std::string> read_file(const std::string& path);

}  // namespace tyndall::modeling
