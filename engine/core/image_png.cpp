#include "engine/core/image_png.h"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "engine/core/error.h"

namespace tyndall {
namespace {

/// libpng leaves a call that fails by longjmp: what calls it may do so holds no object that needs a destructor.
class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, [](png_structp, png_const_charp) {});
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw Error("libpng: out of memory");
        png_set_read_fn(png_, this, on_read);
    }
    ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// False: see error().
    bool read_header() {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_info(png_, info_);
        png_set_expand(png_);  // palettes, less than 8 bits, tRNS
        if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
        png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }
    bool read_rows(std::uint8_t** rows) {
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        png_read_image(png_, rows);
        png_read_end(png_, nullptr);
        return true;
    }
    [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
    [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }
    [[nodiscard]] int channels() const { return png_get_channels(png_, info_); }
    [[nodiscard]] bool is_16_bit() const { return png_get_bit_depth(png_, info_) == 16; }
    [[nodiscard]] std::size_t row_bytes() const { return png_get_rowbytes(png_, info_); }
    [[nodiscard]] const char* error() const { return error_; }

  private:
    [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
        char* error = static_cast<Reader*>(png_get_error_ptr(png))->error_;
        std::strncpy(error, message, sizeof error_ - 1);
        png_longjmp(png, 1);
    }
    static void on_read(png_structp png, png_bytep to, std::size_t size) {
        auto& rest = static_cast<Reader*>(png_get_io_ptr(png))->rest_;
        if (size > rest.size()) png_error(png, "the file ends early");
        std::memcpy(to, rest.data(), size);
        rest = rest.subspan(size);
    }

    std::span<const std::uint8_t> rest_;
    char error_[128] = "";
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name, int max_side) {
    const auto fail = [&](const std::string& reason) {
        throw Error(fmt::format("{}: cannot read the picture: {}", name, reason));
    };
    Reader reader(bytes);
    if (!reader.read_header()) fail(reader.error());
    const auto most = static_cast<std::uint32_t>(max_side);
    if (reader.width() > most || reader.height() > most)
        fail(fmt::format("it is {} x {}, at most {} a side expected", reader.width(), reader.height(), max_side));

    std::vector<std::uint8_t> data(reader.row_bytes() * reader.height());
    std::vector<std::uint8_t*> rows(reader.height());
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = &data[y * reader.row_bytes()];
    if (!reader.read_rows(rows.data())) fail(reader.error());

    Image image({reader.width(), reader.height()}, reader.channels());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        std::uint16_t wide = 0;
        if (reader.is_16_bit()) std::memcpy(&wide, &data[2 * i], 2);
        image.pixels[i] = reader.is_16_bit() ? static_cast<float>(wide) / 65535 : static_cast<float>(data[i]) / 255;
    }
    return image;
}

}  // namespace tyndall
