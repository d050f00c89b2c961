#include "engine/scene/volume_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image.h"
#include "engine/scene/density_grid_builder.h"
#include "engine/scene/json_field.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

struct Header {
    fs::path image;
    glm::ivec3 size{0};
    std::string_view type;  ///< of raw numbers
    double voxel_size = 1;
    glm::dvec3 origin{0};

    [[nodiscard]] std::size_t count() const { return std::size_t(size.x) * size.y * size.z; }
};

glm::ivec3 parse_size(const JsonField& field) {
    constexpr int longest = DensityGridBuilder::longest_side;
    if (!field.json.is_array() || field.json.size() != 3) field.fail("a list of 3 integers");
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis) {
        const nlohmann::json& value = field.json[static_cast<std::size_t>(axis)];
        if (!value.is_number_integer() || value < 1 || value > longest)
            field.fail(fmt::format("integers from 1 to {}", longest));
        size[axis] = value.get<int>();
    }
    constexpr std::size_t most = DensityGridBuilder::most_bricks * DensityGrid::brick_size;
    if (std::size_t(size.x) * size.y * size.z > most) field.fail(fmt::format("at most {} voxels", most));
    return size;
}

Header parse_header(const fs::path& path) {
    const nlohmann::json json = read_json(path);
    const JsonField field{json, path.string()};
    field.require_object({"image", "size", "type", "voxel_size", "origin"});
    Header header;
    const JsonField image = field.at("image");
    header.image = image.file_in(path.parent_path());
    header.size = parse_size(field.at("size"));
    const std::string extension = header.image.extension().string();
    if (extension != ".raw" && extension != ".png" && extension != ".exr")
        image.fail("a name that ends in .raw, .png or .exr");
    if (extension == ".raw") {
        static const std::vector<std::string_view> types{"u8", "u16", "f16", "f32"};
        header.type = types[field.at("type").choice(types)];
    } else if (field.has("type")) {
        throw Error(path.string() + ".type: only raw images have one");
    }
    header.voxel_size = field.at("voxel_size").size();
    if (field.has("origin")) header.origin = field.at("origin").vector<3>(&JsonField::place);
    return header;
}

template <class T>
std::vector<float> converted(const std::vector<std::uint8_t>& bytes, auto convert) {
    std::vector<float> values(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) {
        T value;
        std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
        values[i] = convert(value);
    }
    return values;
}

std::vector<float> read_raw(const Header& header) {
    const std::size_t each = header.type == "u8" ? 1 : header.type == "f32" ? 4 : 2;
    std::error_code error;
    const std::uintmax_t size = fs::is_regular_file(header.image) ? fs::file_size(header.image, error) : 0;
    if (error || size != header.count() * each)
        throw Error(fmt::format("{} bytes, {} expected", size, header.count() * each));
    const std::vector<std::uint8_t> bytes = read_bytes(header.image);
    if (bytes.size() != header.count() * each) throw Error("it changes while it is read");
    if (header.type == "u8")
        return converted<std::uint8_t>(bytes, [](std::uint8_t v) { return float(v) / 255.0F; });
    if (header.type == "u16")
        return converted<std::uint16_t>(bytes, [](std::uint16_t v) { return float(v) / 65535.0F; });
    if (header.type == "f16")
        return converted<std::uint16_t>(bytes, [](std::uint16_t v) { return glm::unpackHalf1x16(v); });
    return converted<float>(bytes, [](float v) { return v; });
}

std::vector<float> read_strip(const Header& header) {
    Image image = read_image(header.image, 1);
    const std::int64_t height = std::int64_t{header.size.y} * header.size.z;
    if (image.size.x != header.size.x || image.size.y != height)
        throw Error(
            fmt::format("it is {} x {}, {} x {} expected", image.size.x, image.size.y, header.size.x, height));
    return std::move(image.pixels);
}

void send_bricks(const Header& header, const std::vector<float>& values, grids::GridSink& sink) {
    constexpr int side = DensityGrid::side;
    const glm::ivec3 size = header.size;
    for (int z = 0; z < size.z; z += side)
        for (int y = 0; y < size.y; y += side)
            for (int x = 0; x < size.x; x += side) {
                grids::BrickValues brick{};
                const int columns = std::min(side, size.x - x);
                for (int dz = 0; dz < std::min(side, size.z - z); ++dz)
                    for (int dy = 0; dy < std::min(side, size.y - y); ++dy) {
                        const std::size_t row = (std::size_t(z + dz) * size.y + (y + dy)) * size.x + x;
                        std::copy_n(values.data() + row, columns, brick.data() + (dz * side + dy) * side);
                    }
                sink.brick({x, y, z}, brick);
            }
}

}  // namespace

void read_volume_texture(const fs::path& path, grids::GridSink& sink) {
    const Header header = parse_header(path);
    std::vector<float> values;
    try {
        values = header.type.empty() ? read_strip(header) : read_raw(header);
    } catch (const Error& e) {
        const std::string message = e.what(), image = header.image.string();
        throw Error(
            fmt::format("{}: {}{}", path.string(), message.starts_with(image) ? "" : image + ": ", message));
    }
    glm::dmat4 index_to_grid(glm::dmat3(header.voxel_size));
    index_to_grid[3] = glm::dvec4(header.origin + 0.5 * header.voxel_size, 1);
    sink.transform(index_to_grid);
    send_bricks(header, values, sink);
}

}  // namespace tyndall
