#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tyndall {

/// All throw Error with the path and the system's reason.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
[[nodiscard]] std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);
/// Error has line and column. At most 100 arrays and objects inside one another: what walks JSON calls itself.
[[nodiscard]] nlohmann::json parse_json(std::string_view text);
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& path);  ///< error has line and column

/// A failure leaves neither a partial file nor a changed old one (output_files.h).
void write_text(const std::filesystem::path& path, const std::string& text);

/// `uri` (already percent-decoded) relative to `folder`; throws Error if it is absolute, has a scheme or leaves
/// the folder (also through symbolic links).
[[nodiscard]] std::filesystem::path resolve_inside(const std::filesystem::path& folder, const std::string& uri);

}  // namespace tyndall
