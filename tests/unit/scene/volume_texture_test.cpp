#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/scene/density_grid.h"
#include "tests/unit/support/scene_folder.h"

namespace tyndall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

constexpr glm::ivec3 size(9, 4, 3);

/// 0 at the origin, different everywhere, exact in 8 bits of 255.
int number_at(int x, int y, int z) {
    return x + size.x * (y + size.y * z);
}

template <class T>
std::string raw(auto convert) {
    std::string bytes;
    for (int i = 0; i < size.x * size.y * size.z; ++i) {
        const T value = convert(i);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return bytes;
}

class VolumeTexture : public SceneFolderTest {
  protected:
    static json header(const std::string& image) {
        return {{"image", image}, {"size", {size.x, size.y, size.z}}, {"voxel_size", 0.5}, {"origin", {1, 2, 3}}};
    }
    static json raw_header(const std::string& type) {
        json head = header("x.raw");
        head["type"] = type;
        return head;
    }
    std::filesystem::path save(const json& head) const { return write("grid.json", head.dump()); }

    void expect_numbers(const json& head, float unit, float tolerance = 0) const {
        const auto grid = load_density_grid(save(head), "density");
        ASSERT_EQ(grid->bricks, (std::vector<glm::ivec3>{{0, 0, 0}, {8, 0, 0}}));
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const int offset = x / 8 * 512 + x % 8 + 8 * (y + 8 * z);
                    ASSERT_NEAR(grid->values[static_cast<std::size_t>(offset)], float(number_at(x, y, z)) * unit,
                                tolerance)
                        << x << " " << y << " " << z;
                }
        EXPECT_EQ(grid->lower, glm::ivec3(0));
        EXPECT_EQ(grid->upper, size - 1);
        EXPECT_NEAR(grid->greatest, 107 * unit, tolerance);
        EXPECT_EQ(grid->index_to_grid * glm::dvec4(-0.5, -0.5, -0.5, 1), glm::dvec4(1, 2, 3, 1));
        EXPECT_EQ(grid->index_to_grid * glm::dvec4(0.5, 0, 0, 1), glm::dvec4(1.5, 2.25, 3.25, 1));
    }
    void expect_refused(const json& head, const std::string& because) const {
        const auto file = save(head);
        EXPECT_THAT([&] { (void)load_density_grid(file, "density"); },
                    ThrowsMessage<Error>(
                        AllOf(StartsWith(file.string()), HasSubstr(because), Not(HasSubstr("\n")))))
            << head;
    }
};

TEST_F(VolumeTexture, RawNumbersOfEveryType) {
    write("x.raw", raw<std::uint8_t>([](int i) { return static_cast<std::uint8_t>(i); }));
    expect_numbers(raw_header("u8"), 1.0F / 255, 1e-7F);
    write("x.raw", raw<std::uint16_t>([](int i) { return static_cast<std::uint16_t>(i * 600); }));
    expect_numbers(raw_header("u16"), 600.0F / 65535, 1e-6F);
    write("x.raw", raw<std::uint16_t>([](int i) { return glm::packHalf1x16(float(i) / 8); }));
    expect_numbers(raw_header("f16"), 0.125F);
    write("x.raw", raw<float>([](int i) { return float(i) * 0.25F; }));
    expect_numbers(raw_header("f32"), 0.25F);
}

TEST_F(VolumeTexture, PicturesAreStripsOfSlices) {
    Image strip({size.x, size.y * size.z}, 3);
    for (int y = 0; y < strip.size.y; ++y)
        for (int x = 0; x < strip.size.x; ++x) strip.at(x, y)[0] = float(x + size.x * y) / 255;
    for (const char* name : {"x.png", "x.exr"}) {
        write_image(folder / "scene" / name, strip);
        expect_numbers(header(name), 1.0F / 255, 1e-7F);
    }
}

TEST_F(VolumeTexture, EveryMistakeIsNamed) {
    write("x.raw", raw<float>([](int i) { return float(i); }));
    write_text(folder / "outside.raw", raw<float>([](int i) { return float(i); }));
    write_image(folder / "scene/x.png", Image({4, 4}, 1));
    write("not.png", "no picture");
    const auto with = [](json head, const std::string& key, const json& value) {
        head[key] = value;
        return head;
    };
    const auto without = [](json head, const std::string& key) {
        head.erase(key);
        return head;
    };
    const json good = raw_header("f32");
    for (const char* key : {"image", "size", "type", "voxel_size"})
        expect_refused(without(good, key), std::string("\"") + key + "\" is missing");
    const std::pair<json, std::string> cases[] = {
        {json(3), "an object expected"},
        {with(good, "colour", 1), "unknown key \"colour\""},
        {with(good, "image", 3), ".image: 3 given, a text expected"},
        {with(good, "image", "none.raw"), "none.raw"},
        {with(good, "image", "../outside.raw"), "a path without \"..\""},
        {with(good, "image", "x.tiff"), "ends in .raw, .png or .exr"},
        {with(good, "type", "f64"), "one of u8, u16, f16, f32"},
        {with(good, "type", "u8"), "x.raw: 432 bytes, 108 expected"},
        {with(good, "size", {9, 4}), ".size"},
        {with(good, "size", {9, 4, 0}), ".size"},
        {with(good, "size", {9, 4, 3.5}), ".size"},
        {with(good, "size", {9, 4, 40'000}), ".size"},
        {with(good, "size", {32'768, 32'768, 1}), "at most 67108864 voxels"},
        {with(good, "size", {9, 4, 4}), "432 bytes, 576 expected"},
        {with(good, "voxel_size", 0), ".voxel_size"},
        {with(good, "origin", {0, 0, 1e30}), ".origin[2]"},
        {header("x.png"), "it is 4 x 4, 9 x 12 expected"},
        {header("not.png"), "PNG, JPEG, EXR or HDR expected"},
        {with(header("x.png"), "type", "u8"), ".type: only raw images have one"},
    };
    for (const auto& [head, because] : cases) expect_refused(head, because);
    for (const float bad : {NAN, INFINITY, -1.0F, 2e6F}) {
        write("x.raw", raw<float>([&](int i) { return i == 50 ? bad : 1.0F; }));
        expect_refused(good, "a voxel is");
    }
}

}  // namespace
}  // namespace tyndall
