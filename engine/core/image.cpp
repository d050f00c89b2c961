#include "engine/core/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image_encode.h"
#include "engine/core/image_png.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

constexpr int max_side = 16384;
constexpr std::size_t max_values = std::size_t(1) << 29;  // 2 GiB of floats

[[noreturn]] void fail(const std::string& name, std::string_view action, std::string reason) {
    std::ranges::replace(reason, '\n', ' ');
    throw Error(
        fmt::format("{}: cannot {} the picture: {}", name, action, reason.empty() ? "damaged file" : reason));
}

/// The file name extension of the format the bytes are in, from their first bytes; empty if none of ours.
std::string_view sniff(std::span<const std::uint8_t> bytes) {
    using namespace std::string_view_literals;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return "png";
    if (text.starts_with("\xff\xd8\xff"sv)) return "jpg";
    if (text.starts_with("\x76\x2f\x31\x01"sv)) return "exr";
    if (text.starts_with("#?"sv)) return "hdr";
    return "";
}

/// Spreads `from` channels over `image`: grey fills red, green and blue; other missing channels are 0, alpha 1.
Image convert_channels(const Image& from, int alpha_channel, int channels) {
    Image to(from.size, channels);
    const int colors = alpha_channel >= 0 ? from.channels - 1 : from.channels;
    for (int y = 0; y < to.size.y; ++y) {
        for (int x = 0; x < to.size.x; ++x) {
            const float* in = from.at(x, y);
            float* out = to.at(x, y);
            for (int c = 0; c < channels; ++c) {
                if (c == 3) {
                    out[c] = alpha_channel >= 0 ? in[alpha_channel] : 1.0f;
                } else {
                    out[c] = colors == 1 ? in[0] : c < colors ? in[c] : 0.0f;
                }
            }
        }
    }
    return to;
}

}  // namespace

Image decode_image(std::span<const std::uint8_t> bytes, const std::string& name, int channels) {
    const std::string_view format = sniff(bytes);
    if (format.empty()) fail(name, "read", "PNG, JPEG, EXR or HDR expected");
    if (format == "png") {
        Image image = decode_png(bytes, name, max_side);
        if (channels == 0 || channels == image.channels) return image;
        return convert_channels(image, image.channels % 2 == 0 ? image.channels - 1 : -1, channels);
    }
    OIIO::Filesystem::IOMemReader reader(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    const auto input = OIIO::ImageInput::create("memory." + std::string(format), false, nullptr, &reader);
    if (!input) fail(name, "read", OIIO::geterror());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;  // straight alpha, as glTF has it
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&reader) || !input->open("memory." + std::string(format), spec, config)) {
        fail(name, "read", input->geterror());
    }
    const std::size_t values = std::size_t(spec.width) * spec.height * spec.nchannels;
    if (spec.width < 1 || spec.height < 1 || spec.width > max_side || spec.height > max_side ||
        values > max_values) {
        fail(name, "read",
             fmt::format("it is {} x {}, at most {} a side expected", spec.width, spec.height, max_side));
    }
    Image image({spec.width, spec.height}, spec.nchannels);
    const bool read = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
    if (!read || input->has_error()) {  // a JPEG file that ends early is read, with an error
        fail(name, "read", input->geterror());
    }
    if (channels == 0 || channels == image.channels) return image;
    return convert_channels(image, spec.alpha_channel, channels);
}

Image read_image(const fs::path& path, int channels) {
    return decode_image(read_bytes(path), path.string(), channels);
}

std::string encode_image(const fs::path& path, const Image& image) {
    const std::string extension = path.extension().string();
    const bool png = extension == ".png", whole = png || extension == ".jpg";
    if (!whole && extension != ".exr")
        fail(path.string(), "write", "a name that ends in .png, .jpg or .exr expected");

    OIIO::ImageSpec spec(image.size.x, image.size.y, image.channels,
                         whole ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    std::vector<std::uint8_t> quantised;
    const void* data = image.pixels.data();
    if (png) spec["oiio:UnassociatedAlpha"] = 1;
    if (extension == ".jpg") spec["Compression"] = "jpeg:88";
    if (whole) {
        quantised.resize(image.pixels.size());
        std::ranges::transform(image.pixels, quantised.begin(), [](float v) {
            return static_cast<std::uint8_t>(v > 0 ? std::lround(std::min(v, 1.0f) * 255.0f) : 0);
        });
        data = quantised.data();
    }
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput writer(file);
    const auto output = OIIO::ImageOutput::create("memory" + extension, &writer);
    if (!output) fail(path.string(), "write", OIIO::geterror());
    if (!output->open("memory" + extension, spec) || !output->write_image(spec.format, data) || !output->close()) {
        fail(path.string(), "write", output->geterror());
    }
    return {file.begin(), file.end()};
}

void write_image(const fs::path& path, const Image& image) {
    write_text(path, encode_image(path, image));
}

}  // namespace tyndall
