#include "engine/core/image_png.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "engine/core/error.h"

namespace tyndall {
namespace {

/// ISO 3309 CRC-32, reflected polynomial 0xEDB88320: PNG specification, annex D.
constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t c = i;
        for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) != 0 ? 0xEDB88320u : 0u);
        table[i] = c;
    }
    return table;
}();

std::uint32_t crc(std::span<const std::uint8_t> bytes) {
    std::uint32_t c = ~0u;
    for (const std::uint8_t byte : bytes) c = crc_table[(c ^ byte) & 0xFF] ^ (c >> 8);
    return ~c;
}

std::uint32_t big_endian(std::span<const std::uint8_t> b) {
    return std::uint32_t(b[0]) << 24 | std::uint32_t(b[1]) << 16 | std::uint32_t(b[2]) << 8 | b[3];
}

}  // namespace

std::vector<std::uint8_t> critical_png_chunks(std::span<const std::uint8_t> png, const std::string& name) {
    constexpr std::size_t signature = 8;
    constexpr std::size_t frame = 12;  // length, type, checksum
    constexpr std::string_view needed[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    std::vector<std::uint8_t> kept(png.begin(), png.begin() + signature);
    std::string_view type;
    for (auto rest = png.subspan(signature); type != "IEND";) {
        if (rest.size() < frame || big_endian(rest) > rest.size() - frame) {
            throw Error(fmt::format("{}: cannot read the picture: the PNG file ends early", name));
        }
        const std::size_t length = big_endian(rest);
        type = {reinterpret_cast<const char*>(rest.data()) + 4, 4};
        if (std::ranges::find(needed, type) != std::end(needed)) {
            if (crc(rest.subspan(4, length + 4)) != big_endian(rest.subspan(length + 8))) {
                throw Error(fmt::format("{}: cannot read the picture: wrong checksum of PNG chunk {}", name, type));
            }
            kept.insert(kept.end(), rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(length + frame));
        }
        rest = rest.subspan(length + frame);
    }
    return kept;
}

}  // namespace tyndall
