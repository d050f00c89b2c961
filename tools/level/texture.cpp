#include "tools/level/texture.h"

#include <algorithm>
#include <array>

#include "tools/modeling/random.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace tyndall::level {

using glm::ivec2;
using glm::vec2;
using glm::vec3;

namespace {

unsigned char byte(float x) {
    return static_cast<unsigned char>(std::lround(glm::clamp(x, 0.0f, 1.0f) * 255.0f));
}

void append_bytes(void* context, void* data, int size) {
    auto* out = static_cast<std::vector<unsigned char>*>(context);
    const auto* p = static_cast<const unsigned char*>(data);
    out->insert(out->end(), p, p + size);
}

EncodedImage jpeg(const std::string& name, int size, const std::vector<unsigned char>& rgb, int quality) {
    EncodedImage image{name, "image/jpeg", {}};
    stbi_write_jpg_to_func(append_bytes, &image.bytes, size, size, 3, rgb.data(), quality);
    return image;
}

}  // namespace

Cell cellular(vec2 p, ivec2 period, float jitter, uint32_t seed) {
    const ivec2 base(glm::floor(p));
    Cell best{9.0f, 9.0f, 0, vec2(0.0f)};
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const int x = base.x + i, y = base.y + j, wx = wrapped(x, period.x), wy = wrapped(y, period.y);
            const vec2 feature =
                vec2(x, y) + 0.5f + (vec2(hash_float(wx, wy, seed), hash_float(wx, wy, seed + 7U)) - 0.5f) * jitter;
            const float distance = glm::length(p - feature);
            if (distance < best.first) {
                best = {distance, best.first,
                        hash(static_cast<uint32_t>(wx) * 977U + static_cast<uint32_t>(wy) + seed), p - feature};
            } else {
                best.second = std::min(best.second, distance);
            }
        }
    }
    return best;
}

Masonry::Masonry(int courses, int blocks, float unevenness, uint32_t seed) {
    Random random(seed);
    const float step = 1.0f / static_cast<float>(courses), width = 1.0f / static_cast<float>(blocks);
    for (int i = 0; i < courses; ++i) {
        course_.push_back(i == 0 ? 0.0f : step * (static_cast<float>(i) + random.range(-0.3f, 0.3f) * unevenness));
        std::vector<float> cuts;
        const float shift = (i % 2 ? 0.5f : 0.0f) * width + random.range(0.0f, 0.25f) * width;
        for (int k = 0; k < blocks; ++k) {
            const float u = shift + width * (static_cast<float>(k) + random.range(-0.3f, 0.3f) * unevenness);
            cuts.push_back(u - std::floor(u));
        }
        std::ranges::sort(cuts);
        cuts_.push_back(cuts);
    }
}

Masonry::Block Masonry::at(vec2 uv) const {
    size_t row = course_.size() - 1;
    while (row > 0 && uv.y < course_[row]) --row;
    const float low = course_[row], high = row + 1 < course_.size() ? course_[row + 1] : 1.0f;
    const auto& cuts = cuts_[row];
    size_t k = cuts.size();
    while (k > 0 && uv.x < cuts[k - 1]) --k;  // the block after joint k-1
    const float left = k > 0 ? cuts[k - 1] : cuts.back() - 1.0f, right = k < cuts.size() ? cuts[k] : cuts[0] + 1.0f;
    const auto id = hash(static_cast<uint32_t>(row * 64 + k % cuts.size()));
    return {id,
            {std::min(uv.x - left, right - uv.x), std::min(uv.y - low, high - uv.y)},
            {(uv.x - left) / (right - left), (uv.y - low) / (high - low)}};
}

Painted paint(int size, const Painter& painter) {
    Painted result{size, {}};
    result.texels.reserve(static_cast<size_t>(size) * static_cast<size_t>(size));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x)
            result.texels.push_back(painter((vec2(x, y) + 0.5f) / static_cast<float>(size)));
    }
    return result;
}

EncodedImage encode_albedo(const Painted& painted, const std::string& name, int quality) {
    std::vector<unsigned char> rgb;
    for (const Texel& t : painted.texels)
        rgb.insert(rgb.end(), {byte(t.color.r), byte(t.color.g), byte(t.color.b)});
    return jpeg(name, painted.size, rgb, quality);
}

EncodedImage encode_albedo_alpha(const Painted& painted, const std::string& name) {
    EncodedImage image{name, "image/png", {}};
    std::vector<unsigned char> rgba;
    for (const Texel& t : painted.texels) {
        // Coarse colours keep the PNG small; nobody sees 32 levels on a leaf.
        auto coarse = [](float x) { return byte(std::round(x * 31.0f) / 31.0f); };
        rgba.insert(rgba.end(), {coarse(t.color.r), coarse(t.color.g), coarse(t.color.b), byte(t.alpha)});
    }
    stbi_write_png_to_func(append_bytes, &image.bytes, painted.size, painted.size, 4, rgba.data(),
                           painted.size * 4);
    return image;
}

EncodedImage encode_normal(const Painted& painted, const std::string& name, float tile_metres, int quality) {
    const int n = painted.size;
    auto height = [&](int x, int y) {
        return painted.texels[static_cast<size_t>(wrapped(y, n) * n + wrapped(x, n))].height;
    };
    const float per_texel = static_cast<float>(n) / (2.0f * tile_metres);
    std::vector<unsigned char> rgb;
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            // Rows run down, the bitangent up.
            const float dx = (height(x + 1, y) - height(x - 1, y)) * per_texel;
            const float dy = (height(x, y - 1) - height(x, y + 1)) * per_texel;
            const vec3 normal = glm::normalize(vec3(-dx, -dy, 1.0f)) * 0.5f + 0.5f;
            rgb.insert(rgb.end(), {byte(normal.x), byte(normal.y), byte(normal.z)});
        }
    }
    return jpeg(name, n, rgb, quality);
}

EncodedImage encode_surface(const Painted& painted, const std::string& name, int quality) {
    const int n = painted.size, radius = n / 48;
    std::vector<float> rows(painted.texels.size()), mean(painted.texels.size());
    auto blur = [&](auto&& read, std::vector<float>& out, int dx, int dy) {
        for (int y = 0; y < n; ++y) {
            for (int x = 0; x < n; ++x) {
                float sum = 0.0f;
                for (int k = -radius; k <= radius; ++k) {
                    sum += read(static_cast<size_t>(wrapped(y + k * dy, n) * n + wrapped(x + k * dx, n)));
                }
                out[static_cast<size_t>(y * n + x)] = sum / static_cast<float>(2 * radius + 1);
            }
        }
    };
    blur([&](size_t i) { return painted.texels[i].height; }, rows, 1, 0);
    blur([&](size_t i) { return rows[i]; }, mean, 0, 1);
    std::vector<unsigned char> rgb;
    for (size_t i = 0; i < mean.size(); ++i) {
        const float depth = std::max(0.0f, mean[i] - painted.texels[i].height);
        const float occlusion = glm::clamp(1.0f - depth * 45.0f, 0.25f, 1.0f);
        rgb.insert(rgb.end(),
                   {byte(occlusion), byte(painted.texels[i].roughness), byte(painted.texels[i].metallic)});
    }
    return jpeg(name, n, rgb, quality);
}

}  // namespace tyndall::level
