#include "bench/pictures.h"

#include <algorithm>
#include <glm/glm.hpp>

#include "bench/machine.h"
#include "engine/core/image_metrics.h"
#include "shaders/lib/glm_subset.h"

TYNDALL_GLSL_BEGIN
#include "shaders/lib/tonemap.glsl"
TYNDALL_GLSL_END

namespace tyndall::bench {
namespace {

/// That brings what only one pixel of twenty exceeds to where the curve begins to bend.
float exposure_of(const Image& truth) {
    constexpr double part = 0.95;
    constexpr float level = 0.5F;
    std::vector<float> sorted = truth.pixels;
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at > 0 ? level / *at : 1;
}

Image shown(const Image& light, float exposure) {
    Image picture(light.size, 3);
    for (std::size_t i = 0; i < picture.pixels.size() / 3; ++i) {
        const float* from = &light.pixels[i * static_cast<std::size_t>(light.channels)];
        const glm::vec3 display = glsl::tonemap(exposure * glm::vec3(from[0], from[1], from[2]));
        for (int c = 0; c < 3; ++c) picture.pixels[3 * i + std::size_t(c)] = glsl::srgb_encode(display[c]);
    }
    return picture;
}

std::string hex_of(const std::string& text) {
    Digest digest;
    digest.add(text);
    return digest.hex();
}

}  // namespace

PictureNames picture_names(const std::string& key, const std::string& subject) {
    const std::string point = "pictures/" + hex_of(key);
    return {point + ".jpg", point + "-error.jpg", "pictures/" + hex_of(subject) + "-truth.jpg"};
}

void write_pictures(const std::filesystem::path& folder, const PictureNames& names, const Image& scattering,
                    const Image& truth, const std::vector<bool>& same) {
    std::filesystem::create_directories(folder / "pictures");
    const float exposure = exposure_of(truth);
    write_image(folder / names.light, shown(scattering, exposure));
    write_image(folder / names.truth, shown(truth, exposure));
    Image error = difference_heatmap(scattering, truth, static_cast<float>(0.5 * mean_value(truth)));
    for (std::size_t i = 0; i < same.size(); ++i)
        if (!same[i])
            std::fill_n(error.at(0, 0) + i * static_cast<std::size_t>(error.channels), error.channels, 0.0F);
    write_image(folder / names.error, error);
}

}  // namespace tyndall::bench
