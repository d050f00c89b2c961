#include "reconstruction/noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <span>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "shaders/lib/glm_subset.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/volumetrics.h"
#include "volumetrics/technique.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/sampling_noise.glsl"
TYNDALL_GLSL_END

namespace tyndall::volumetrics {
namespace {

bool is_tile(Noise noise) {
    return noise == Noise::bayer || noise == Noise::white_tile;
}

/// (rank + 0.5) / n^2: the pixels of a tile together sample n^2 equal strata at their middles, and their mean is
/// 0.5. rank / n^2 would take the near end of each: a shift of 1 / (2 n^2) segments towards the eye.
std::vector<float> strata(std::size_t count) {
    std::vector<float> middles;
    for (std::size_t i = 0; i < count; ++i)
        middles.push_back((static_cast<float>(i) + 0.5F) / static_cast<float>(count));
    return middles;
}

std::vector<float> bayer_tile(unsigned side) {
    const std::vector<float> middles = strata(std::size_t(side) * side);
    std::vector<float> tile;
    for (unsigned y = 0; y < side; ++y)
        for (unsigned x = 0; x < side; ++x) tile.push_back(middles[glsl::bayer_rank({x, y}, side)]);
    return tile;
}

/// Fisher-Yates, the same on every machine: std::shuffle is not.
std::vector<float> white_tile(unsigned side) {
    constexpr unsigned seed = 1;
    std::mt19937 random(seed);
    std::vector<float> tile = strata(std::size_t(side) * side);
    for (std::size_t i = tile.size() - 1; i > 0; --i) std::swap(tile[i], tile[random() % (i + 1)]);
    return tile;
}

gl::Texture load_texture(const std::string& name, const Roots& roots) {
    const gl::TextureDesc desc{.kind = gl::TextureKind::d2_array,
                               .format = GL_R8,
                               .size = {NOISE_TEXTURE_SIDE, NOISE_TEXTURE_SIDE, NOISE_TEXTURE_SLICES}};
    const std::filesystem::path path = roots.find("assets/noise/" + name);
    const std::size_t expected = gl::byte_size(desc);
    const std::vector<std::uint8_t> bytes = read_bytes(path);
    if (bytes.size() != expected)
        throw Error(fmt::format("{}: {} bytes, {} of noise expected", path.string(), bytes.size(), expected));
    gl::Texture texture(desc, "volumetrics noise");
    texture.upload(0, GL_RED, GL_UNSIGNED_BYTE, bytes.data());
    return texture;
}

}  // namespace

std::vector<float> noise_tile(Noise noise, int size) {
    if (noise == Noise::bayer) return bayer_tile(static_cast<unsigned>(size));
    if (noise == Noise::white_tile) return white_tile(static_cast<unsigned>(size));
    return {0.5F};
}

int noise_side(const Settings& settings) {
    return is_tile(settings.noise.kind) ? settings.noise.size : 1;
}

glm::uvec4 noise_uniform(const Settings& settings, std::uint32_t frame_index) {
    NoiseTime time = settings.noise.kind == Noise::none ? NoiseTime::fixed : settings.noise.time;
    if (time == NoiseTime::own && is_tile(settings.noise.kind)) time = NoiseTime::golden_ratio;
    return {static_cast<unsigned>(settings.noise.kind), static_cast<unsigned>(time),
            time == NoiseTime::fixed ? 0U : frame_index, 0U};
}

std::string noise_texture_name(const Settings& settings) {
    constexpr const char* suffix = "_128x128x32_r8.raw";
    if (settings.noise.kind == Noise::blue) return std::string("blue") + suffix;
    if (settings.noise.kind == Noise::stbn) return std::string("stbn") + suffix;
    if (settings.noise.kind != Noise::fast) return "";
    return fmt::format("fast_{}_{}{}", temporal_kernel_names()[static_cast<std::size_t>(settings.noise.fast_time)],
                       spatial_kernel_names()[static_cast<std::size_t>(settings.noise.fast_space)], suffix);
}

void NoiseSource::prepare(const Settings& settings, const Roots& roots) {
    const bool sampled = technique(settings.technique).traits.sampling == Sampling::per_pixel;
    const std::string texture = noise_texture_name(settings);
    const std::string name =
        sampled ? fmt::format("{} {} {}", static_cast<int>(settings.noise.kind), settings.noise.size, texture) : "";
    if (name == name_) return;
    NoiseSource made;
    made.name_ = name;
    if (sampled) {
        std::vector<float> tile = noise_tile(settings.noise.kind, settings.noise.size);
        tile.resize(NOISE_TILE_OFFSETS);  // whatever the noise, the shaders' block is there and whole
        made.tile_ = gl::Buffer::of(std::span<const float>(tile), "volumetrics noise tile");
        if (!texture.empty()) made.texture_ = load_texture(texture, roots);
    }
    *this = std::move(made);
}

void NoiseSource::bind() const {
    if (tile_) tile_.bind(GL_UNIFORM_BUFFER, BINDING_NOISE);
    if (!texture_) return;
    glBindTextureUnit(UNIT_NOISE, texture_.id());
    glBindSampler(UNIT_NOISE, 0);
}

std::size_t NoiseSource::bytes() const {
    return tile_.size() + (texture_ ? gl::byte_size(texture_.desc()) : 0);
}

}  // namespace tyndall::volumetrics
