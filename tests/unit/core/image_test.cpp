#include "engine/core/image.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;
using testing::ThrowsMessage;

class ImageFiles : public testing::Test {
  protected:
    ImageFiles() : folder_(fs::temp_directory_path() / ("tyndall_image_test." + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~ImageFiles() override { fs::remove_all(folder_); }
    fs::path folder_;
};

Image picture(int channels) {
    Image image({5, 3}, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i) * 0.375f - 1.0f;
    return image;
}

TEST_F(ImageFiles, ExrKeepsEveryBit) {
    for (int channels : {1, 3, 4}) {
        Image image = picture(channels);
        image.pixels[0] = 1e-30f;
        image.pixels[1] = 3e38f;
        image.pixels[2] = std::numeric_limits<float>::infinity();
        write_image(folder_ / "a.exr", image);
        const Image back = read_image(folder_ / "a.exr");
        EXPECT_EQ(back.size, image.size);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.pixels, image.pixels);
    }
}

TEST_F(ImageFiles, PngClampsAndRounds) {
    Image image({7, 1}, 3);
    const float values[] = {-1, 0.2f / 255, 0.6f / 255, 127.4f / 255, 1, 2, std::nanf("")};
    const int expected[] = {0, 0, 1, 127, 255, 255, 0};
    for (int x = 0; x < 7; ++x) image.at(x, 0)[1] = values[x];
    write_image(folder_ / "a.png", image);
    const Image back = read_image(folder_ / "a.png");
    for (int x = 0; x < 7; ++x) EXPECT_FLOAT_EQ(back.at(x, 0)[1], float(expected[x]) / 255) << x;
}

TEST_F(ImageFiles, PngHoldsEveryByteAndStraightAlpha) {
    Image image({256, 2}, 4);
    for (int x = 0; x < 256; ++x) {
        for (int c = 0; c < 3; ++c) image.at(x, 1)[c] = float(x) / 255;
        image.at(x, 1)[3] = float(255 - x) / 255;
    }
    write_image(folder_ / "a.png", image);
    const Image back = read_image(folder_ / "a.png");
    EXPECT_EQ(back.channels, 4);
    for (int x = 0; x < 256; ++x) {
        EXPECT_FLOAT_EQ(back.at(x, 1)[0], float(x) / 255);
        EXPECT_FLOAT_EQ(back.at(x, 1)[3], float(255 - x) / 255);
    }
}

TEST_F(ImageFiles, FirstRowIsTheTop) {
    // 2 x 2 grey, stored without compression, scan lines 255 255 and 0 51; PNG, section 7.2: the first one is the
    // top.
    const std::uint8_t png[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
        0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x00, 0x00, 0x00, 0x00, 0x57, 0xdd, 0x52, 0xf8, 0x00, 0x00, 0x00,
        0x03, 0x74, 0x45, 0x58, 0x74, 0x61, 0x00, 0x62, 0xdc, 0x49, 0xa2, 0x3b, 0x00, 0x00, 0x00, 0x11, 0x49, 0x44,
        0x41, 0x54, 0x78, 0x01, 0x01, 0x06, 0x00, 0xf9, 0xff, 0x00, 0xff, 0xff, 0x00, 0x00, 0x33, 0x09, 0x30, 0x02,
        0x32, 0xf5, 0x59, 0x48, 0x3d, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    const Image image = decode_image(png, "by hand", 1);
    EXPECT_THAT(image.pixels, Pointwise(FloatEq(), {1.0f, 1.0f, 0.0f, 0.2f}));
    write_image(folder_ / "a.png", image);
    EXPECT_EQ(read_image(folder_ / "a.png").pixels, image.pixels);
}

TEST_F(ImageFiles, SamePictureGivesTheSameBytes) {
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(folder_ / name, picture(3));
        const auto first = read_bytes(folder_ / name);
        write_image(folder_ / name, picture(3));
        EXPECT_EQ(read_bytes(folder_ / name), first) << name;
    }
}

TEST_F(ImageFiles, ChannelsAreFilled) {
    Image rgb({1, 1}, 3);
    rgb.pixels = {1, 0, 1};
    write_image(folder_ / "rgb.png", rgb);
    EXPECT_THAT(read_image(folder_ / "rgb.png", 4).pixels, ElementsAre(1, 0, 1, 1));
    EXPECT_THAT(read_image(folder_ / "rgb.png", 1).pixels, ElementsAre(1));

    Image grey({1, 1}, 1);
    grey.pixels = {0.2f};
    write_image(folder_ / "grey.png", grey);
    EXPECT_THAT(read_image(folder_ / "grey.png", 4).pixels, Pointwise(FloatEq(), {0.2f, 0.2f, 0.2f, 1.0f}));

    Image grey_alpha({1, 1}, 2);
    grey_alpha.pixels = {0.2f, 0.4f};
    write_image(folder_ / "grey_alpha.png", grey_alpha);
    EXPECT_THAT(read_image(folder_ / "grey_alpha.png", 4).pixels, Pointwise(FloatEq(), {0.2f, 0.2f, 0.2f, 0.4f}));
}

TEST_F(ImageFiles, DecodesFromMemory) {
    write_image(folder_ / "a.png", picture(3));
    const auto bytes = read_bytes(folder_ / "a.png");
    EXPECT_EQ(decode_image(bytes, "embedded", 3).pixels, read_image(folder_ / "a.png").pixels);
    EXPECT_THAT([] { (void)decode_image({}, "image 3 of a.glb"); },
                ThrowsMessage<Error>(HasSubstr("image 3 of a.glb")));
}

TEST_F(ImageFiles, DamagedFilesNameThePath) {
    Image image({64, 64}, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float((i * 2654435761u) % 251) / 250;
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(folder_ / name, image);
        const std::string whole = read_text(folder_ / name);
        for (const std::size_t size : {std::size_t(0), std::size_t(4), std::size_t(20), whole.size() / 2}) {
            write_text(folder_ / name, whole.substr(0, size));
            EXPECT_THAT([&] { (void)read_image(folder_ / name); },
                        ThrowsMessage<Error>(AllOf(HasSubstr((folder_ / name).string()), Not(HasSubstr("\n")))))
                << name << " cut to " << size;
        }
    }
    write_text(folder_ / "text.png", "this is no picture");
    EXPECT_THROW((void)read_image(folder_ / "text.png"), Error);
    EXPECT_THROW((void)read_image(folder_ / "none.png"), Error);
}

TEST_F(ImageFiles, HugeHeaderIsRejected) {
    write_image(folder_ / "a.png", picture(3));
    std::string file = read_text(folder_ / "a.png");
    // IHDR: width 100,000, then the checksum of its 17 bytes (zlib's crc32 gave it).
    file.replace(16, 4, std::string("\x00\x01\x86\xa0", 4));
    file.replace(29, 4, std::string("\x9f\xd4\x20\x89", 4));
    write_text(folder_ / "a.png", file);
    EXPECT_THAT([&] { (void)read_image(folder_ / "a.png"); }, ThrowsMessage<Error>(HasSubstr("100000 x 3")));
}

TEST_F(ImageFiles, FlippedBitsInAPngAreFound) {
    write_image(folder_ / "a.png", picture(3));
    const std::string file = read_text(folder_ / "a.png");
    for (const std::size_t at : {std::size_t(18), file.find("IDAT") + 8, file.size() - 2}) {
        std::string damaged = file;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        write_text(folder_ / "a.png", damaged);
        testing::internal::CaptureStderr();
        EXPECT_THROW((void)read_image(folder_ / "a.png"), Error) << at;
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the error is the only line a person sees";
    }
}

/// ISO 3309 CRC-32, bit by bit.
std::uint32_t checksum(const std::string& bytes) {
    std::uint32_t c = ~0u;
    for (const char byte : bytes) {
        c ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1) != 0 ? 0xEDB88320u : 0u);
    }
    return ~c;
}

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
    return bytes;
}

std::string png_file(const std::vector<std::pair<std::string, std::string>>& chunks) {
    std::string file("\x89PNG\r\n\x1a\n");
    for (const auto& [type, data] : chunks)
        file +=
            big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(checksum(type + data));
    return file;
}

std::string header(int width, int height, char bits, char color, char interlace = 0) {
    return big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height)) + bits +
           color + '\0' + '\0' + interlace;
}

/// A zlib stream of one stored block. RFC 1950, 1951.
std::string stored(const std::string& data) {
    std::uint32_t a = 1, b = 0;
    for (const char byte : data) b = (b + (a = (a + static_cast<std::uint8_t>(byte)) % 65521)) % 65521;
    const auto size = static_cast<std::uint16_t>(data.size());
    std::string stream("\x78\x01\x01");
    for (const std::uint16_t n : {size, static_cast<std::uint16_t>(~size)})
        stream += std::string{static_cast<char>(n & 0xFF), static_cast<char>(n >> 8)};
    return stream + data + big_endian(b << 16 | a);
}

TEST_F(ImageFiles, ADamagedPngIsOneErrorAndNothingOnStderr) {
    const std::string row("\0\xff", 2), good = stored(row);
    std::string broken_stream = good;
    broken_stream[2] = 7;  // there is no such kind of block
    const std::pair<const char*, std::string> cases[] = {
        {"zlib data", png_file({{"IHDR", header(1, 1, 8, 0)}, {"IDAT", broken_stream}, {"IEND", ""}})},
        {"too little data", png_file({{"IHDR", header(1, 9, 8, 0)}, {"IDAT", good}, {"IEND", ""}})},
        {"three bits", png_file({{"IHDR", header(1, 1, 3, 0)}, {"IDAT", good}, {"IEND", ""}})},
        {"no width", png_file({{"IHDR", header(0, 1, 8, 0)}, {"IDAT", good}, {"IEND", ""}})},
        {"no palette", png_file({{"IHDR", header(1, 1, 8, 3)}, {"IDAT", good}, {"IEND", ""}})},
        {"no pixels", png_file({{"IHDR", header(1, 1, 8, 0)}, {"IEND", ""}})},
        {"unknown critical chunk",
         png_file({{"IHDR", header(1, 1, 8, 0)}, {"ABCD", "x"}, {"IDAT", good}, {"IEND", ""}})},
        {"no end", png_file({{"IHDR", header(1, 1, 8, 0)}, {"IDAT", good}})}};
    for (const auto& [what, file] : cases) {
        write_text(folder_ / "a.png", file);
        testing::internal::CaptureStderr();
        EXPECT_THAT(
            [&] { (void)read_image(folder_ / "a.png"); },
            ThrowsMessage<Error>(AllOf(HasSubstr("a.png: cannot read the picture: "), Not(HasSubstr("\n")))))
            << what;
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << what;
    }
}

TEST_F(ImageFiles, PngOfEveryKindGivesItsValues) {
    const auto read = [&](const std::vector<std::pair<std::string, std::string>>& chunks) {
        write_text(folder_ / "a.png", png_file(chunks));
        testing::internal::CaptureStderr();
        const Image image = read_image(folder_ / "a.png");
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
        return image.pixels;
    };
    const auto close = [](std::vector<float> values) { return Pointwise(FloatEq(), values); };
    const std::string end;
    // 16 bits, big endian: 0x1234 of 65535.
    EXPECT_THAT(
        read({{"IHDR", header(1, 1, 16, 0)}, {"IDAT", stored(std::string("\0\x12\x34", 3))}, {"IEND", end}}),
        close({4660.0f / 65535}));
    // 2 bits: 0 1 2 3 of 3.
    EXPECT_THAT(read({{"IHDR", header(4, 1, 2, 0)}, {"IDAT", stored(std::string("\0\x1b", 2))}, {"IEND", end}}),
                close({0, 1.0f / 3, 2.0f / 3, 1}));
    // A palette of two colours, the first half transparent.
    EXPECT_THAT(read({{"IHDR", header(2, 1, 8, 3)},
                      {"PLTE", "\xff\x33" + std::string("\0\0\xff\0", 4)},
                      {"tRNS", "\x66"},
                      {"IDAT", stored(std::string("\0\0\1", 3))},
                      {"IEND", end}}),
                close({1, 0.2f, 0, 0.4f, 0, 1, 0, 1}));
    // gAMA and a damaged text chunk change nothing and say nothing.
    EXPECT_THAT(read({{"IHDR", header(1, 1, 8, 0)},
                      {"gAMA", big_endian(100000)},
                      {"tEXt", ""},
                      {"IDAT", stored(std::string("\0\x33", 2))},
                      {"IEND", end}}),
                close({0.2f}));
}

TEST_F(ImageFiles, ReadsTheOtherFormats) {
    // A 1 x 1 Radiance picture, uncompressed RGBE: mantissas 128, 64, 32 and exponent 129 are 1, 0.5 and 0.25.
    const std::string hdr("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x81");
    write_text(folder_ / "a.hdr", hdr);
    const Image image = read_image(folder_ / "a.hdr");
    EXPECT_EQ(image.size, glm::ivec2(1, 1));
    EXPECT_THAT(image.pixels, ElementsAre(testing::FloatNear(1, 0.01f), testing::FloatNear(0.5f, 0.01f),
                                          testing::FloatNear(0.25f, 0.01f)));
}

TEST_F(ImageFiles, UnwritableAndUnknownNamesThePath) {
    EXPECT_THAT([&] { write_image(folder_ / "a.gif", picture(3)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("a.gif"), HasSubstr(".png, .jpg or .exr"))));
    EXPECT_THAT([&] { write_image(folder_ / "none/a.png", picture(3)); },
                ThrowsMessage<Error>(HasSubstr("none/a.png")));
    EXPECT_TRUE(fs::is_empty(folder_));
}

Image pixels(std::vector<float> values) {
    Image image({int(values.size()) / 3, 1}, 3);
    image.pixels = std::move(values);
    return image;
}

TEST(ImageMetrics, MatchHandComputedValues) {
    const Image a = pixels({0.5f, 0.0f, 1.0f, 0.25f, 0.0f, 0.0f});
    const Image b = pixels({0.0f, 0.0f, 0.5f, 0.25f, 0.0f, 1.0f});
    // Differences 0.5, 0, 0.5, 0, 0, -1: squares sum to 1.5 over 6 values.
    const ImageDifference d = compare_images(a, b);
    EXPECT_NEAR(d.rmse, 0.5, 1e-12);
    // 0.25/0.01 + 0.25/(0.25+0.01) + 1/(1+0.01) over 6.
    EXPECT_NEAR(d.relmse, (25 + 0.961538461538 + 0.990099009901) / 6, 1e-9);
    EXPECT_NEAR(d.psnr, 6.02059991328, 1e-9);  // 20 log10(1 / 0.5)
    EXPECT_NEAR(d.max, 1.0, 1e-12);
    EXPECT_NEAR(compare_images(a, b, 50).psnr, 40.0, 1e-9);  // 20 log10(50 / 0.5)
}

TEST(ImageMetrics, EqualPicturesHaveInfinitePsnr) {
    Image a = pixels({0.5f, std::numeric_limits<float>::infinity(), 1.0f});
    const ImageDifference d = compare_images(a, a);
    EXPECT_EQ(d.rmse, 0);
    EXPECT_EQ(d.max, 0);
    EXPECT_EQ(d.psnr, std::numeric_limits<double>::infinity());
}

TEST(ImageMetrics, AlphaDoesNotCount) {
    Image a({1, 1}, 4);
    Image b({1, 1}, 3);
    a.pixels = {0.5f, 0.5f, 0.5f, 0.0f};
    b.pixels = {0.5f, 0.5f, 0.5f};
    EXPECT_EQ(compare_images(a, b).rmse, 0);
}

TEST(ImageMetrics, NotANumberIsNotLost) {
    const Image a = pixels({0.5f, std::nanf(""), 1.0f});
    const Image b = pixels({0.0f, 0.0f, 0.0f});
    EXPECT_TRUE(std::isnan(compare_images(a, b).rmse));
    EXPECT_TRUE(std::isnan(compare_images(a, b).max));
}

TEST(ImageMetrics, DifferentSizesAreAnError) {
    EXPECT_THAT(
        [] {
            (void)compare_images(Image({2, 1}, 3), Image({1, 2}, 3));
        },
        ThrowsMessage<Error>(AllOf(HasSubstr("2 x 1"), HasSubstr("1 x 2"))));
    EXPECT_THROW((void)difference_heatmap(Image({1, 1}, 3), Image({1, 1}, 1), 1), Error);
    EXPECT_THROW((void)compare_images(Image(), Image()), Error);
}

TEST(ImageMetrics, HeatmapGoesFromBlackOverRedAndYellowToWhite) {
    const Image zero({5, 1}, 1);
    Image a({5, 1}, 1);
    a.pixels = {0.0f, 1.0f, 2.0f, -3.0f, 9.0f};  // white at 3
    EXPECT_THAT(difference_heatmap(a, zero, 3).pixels, ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 1, 1, 1, 1));
}

}  // namespace
}  // namespace tyndall
