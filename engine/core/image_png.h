#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tyndall {

/// The PNG file with only the chunks that its pixels need (PNG specification, section 5), their checksums verified.
/// libpng prints to stderr about damaged and about odd ancillary chunks; this way there is nothing to print.
/// Throws Error, which begins with `name`, if the file ends early or a checksum is wrong.
[[nodiscard]] std::vector<std::uint8_t> critical_png_chunks(std::span<const std::uint8_t> png,
                                                            const std::string& name);

}  // namespace tyndall
