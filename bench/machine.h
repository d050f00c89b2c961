#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tyndall::bench {

[[nodiscard]] std::string processor_name();  ///< as the system calls it, and its logical processors
[[nodiscard]] std::string date_today();      ///< UTC, YYYY-MM-DD
[[nodiscard]] std::string
program_version();  ///< of the project, and a digest of the binary and the shaders it runs

/// FNV-1a, 64 bit: to tell files apart, not to resist anyone.
class Digest {
  public:
    void add(const void* data, std::size_t size);
    void add(const std::string& text) { add(text.data(), text.size()); }
    void add_file(const std::filesystem::path& path);  ///< throws Error
    [[nodiscard]] std::string hex() const;             ///< 16 digits

  private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace tyndall::bench
