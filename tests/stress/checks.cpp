#include "checks.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <cmath>
#include <utility>

#include "engine/gl/readback.h"
#include "engine/platform/gl_context.h"

namespace tyndall::stress {
namespace {

void check_layer(const char* name, const Image& image, float most, Findings& findings) {
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            for (int c = 0; c < image.channels; ++c) {
                const float value = image.at(x, y)[c];
                if (value >= 0 && value <= most && std::isfinite(value)) continue;
                findings.push_back(fmt::format("{} at pixel ({}, {}) channel {} is {}; 0 to {} expected", name, x,
                                               y, c, value, most));
                return;
            }
}

}  // namespace

Layers read_layers(const Renderer& renderer, const Scene& scene) {
    Image scattering = renderer.read_layer("scattering");
    for (float& value : scattering.pixels) value /= scene.light_unit();
    return {std::move(scattering), renderer.read_layer("transmittance"), gl::read_texture(renderer.color()),
            renderer.read_layer("depth")};
}

float most_light(const StressFrame& frame) {
    return frame.options.volumetrics.technique == "reference" ? std::numeric_limits<float>::max() : half_max;
}

void check_values(const Layers& layers, float most, Findings& findings) {
    check_layer("scattering", layers.scattering, most, findings);
    check_layer("transmittance", layers.transmittance, 1, findings);
    check_layer("color", layers.color, half_max, findings);
    check_layer("depth", layers.depth, 3e38f, findings);
}

void check_gl(Findings& findings) {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError())
        findings.push_back(fmt::format("GL error 0x{:x}", error));
    if (debug_messages().count == 0) return;
    findings.push_back("GL debug message: " + debug_messages().last);
    reset_debug_messages();
}

int check_monotonic(const Layers& with, const Layers& without, int steps, Findings& findings) {
    const float relative = 1e-3f + 2e-7f * static_cast<float>(steps), absolute = 1e-5f;
    int compared = 0;
    for (int y = 0; y < with.depth.size.y; ++y)
        for (int x = 0; x < with.depth.size.x; ++x) {
            if (with.depth.at(x, y)[0] == 0) continue;
            ++compared;
            for (int c = 0; c < 3; ++c) {
                const float near = with.transmittance.at(x, y)[c], far = without.transmittance.at(x, y)[c];
                if (far <= near * (1 + relative) + absolute) continue;
                findings.push_back(fmt::format(
                    "transmittance at pixel ({}, {}) channel {} is {} to a surface at {} m and {} behind it", x, y,
                    c, near, with.depth.at(x, y)[0], far));
                return compared;
            }
        }
    return compared;
}

}  // namespace tyndall::stress
