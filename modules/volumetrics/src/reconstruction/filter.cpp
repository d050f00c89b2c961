#include <array>
#include <cmath>

#include "reconstruction/reconstruction.h"

namespace tyndall::volumetrics {
namespace {

/// In one pass of each direction; more take another.
constexpr std::size_t most_textures = 4;

const ProgramDesc program{
    .name = "volumetrics/filter",
    .stages = {{GL_VERTEX_SHADER, "shaders/lib/fullscreen.vert"},
               {GL_FRAGMENT_SHADER, "shaders/volumetrics/reconstruction/filter.frag"}},
    .axes = {{"DEPTH", {0, 1, 2}}, {"NARROWS", {0, 1}}, {"TEXTURES", {1, 2, 3, 4}}, {"COUNT_WORK", {0, 1}}},
    .valid = {}};
const ProgramRegistry::Registration registration(program);

/// One direction: 2 radius + 1 taps. Weights by distance from the centre, px, up to a common factor.
struct Kernel {
    int radius = 0;
    std::array<float, 8> weights{};
};

/// exp(-x² / (2 sigma²)).
Kernel gaussian(int radius, float sigma) {
    Kernel kernel{radius, {}};
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
        const float x = static_cast<float>(i) / sigma;
        kernel.weights[i] = std::exp(-0.5F * x * x);
    }
    return kernel;
}

Kernel kernel_of(const Settings& settings) {
    switch (settings.filter) {
        case Filter::none:
            return {0, {1}};
        case Filter::box3:
            return {1, {1, 1}};
        case Filter::box5:
            return {2, {1, 1, 1}};
        case Filter::gaussian1:
            return gaussian(3, 1);
        case Filter::binomial3:
            return {1, {2, 1}};
        case Filter::binomial5:
            return {2, {6, 4, 1}};
        case Filter::gaussian15:
            return gaussian(7, settings.filter_sigma);
        case Filter::uniform9:
            return {4, {1, 1, 1, 1, 1}};
    }
    return {0, {1}};
}

/// px².
float variance(const Kernel& kernel) {
    float sum = 0, total = kernel.weights[0];
    for (int i = 1; i <= kernel.radius; ++i) {
        const float both = 2 * kernel.weights[static_cast<std::size_t>(i)];
        sum += both * static_cast<float>(i * i);
        total += both;
    }
    return sum / total;
}

void add_direction(Frame& frame, Textures textures, TextureRef frames, const std::string& name,
                   glm::vec2 direction) {
    const Settings& settings = frame.settings;
    const bool by_depth = settings.filter_depth != FilterDepth::none;
    std::vector<Pass::Source> sources{{by_depth ? frame.depth : TextureRef{}}, {frames}};
    for (TextureRef* texture : textures) {
        sources.push_back({*texture});
        *texture = create_like(frame, name, *texture, frame.size);
    }
    // Neighbours of a checkerboard hold the nearest and the farthest depth of their blocks: a plane is one two
    // pixels apart, and what lies between is off it by as much as it changes within a block.
    const bool alternating =
        resolution_factor(settings) > 1 && settings.resolution_depth == DepthChoice::checkerboard;
    const auto set = [=, narrows = static_cast<bool>(frames), texel = 1.0F / glm::vec2(frame.size),
                      kernel = kernel_of(settings),
                      falloff = settings.filter_depth_falloff](const PassContext&, const gl::Program& shader) {
        const std::array<float, 8>& w = kernel.weights;
        shader.set("radius", kernel.radius);
        shader.set("weights_0_3", glm::vec4(w[0], w[1], w[2], w[3]));
        shader.set("weights_4_7", glm::vec4(w[4], w[5], w[6], w[7]));
        if (narrows) shader.set("kernel_variance", variance(kernel));
        shader.set("texel", texel);
        shader.set("direction", direction);
        shader.set("depth_falloff", falloff);
        shader.set("slope_stride", alternating ? 2.0F : 1.0F);
        shader.set("slope_tolerance", alternating ? 1.0F : 0.0F);
    };
    frame.add({.name = name,
               .program = frame.program(program, {{"DEPTH", static_cast<int>(settings.filter_depth)},
                                                  {"NARROWS", static_cast<bool>(frames)},
                                                  {"TEXTURES", static_cast<int>(textures.size())}}),
               .sources = sources,
               .targets = {textures.begin(), textures.end()},
               .set = set});
}

}  // namespace

void add_filter(Frame& frame, Textures textures, TextureRef frames) {
    if (textures.size() > most_textures) {
        add_filter(frame, textures.first(most_textures), frames);
        return add_filter(frame, textures.subspan(most_textures), frames);
    }
    add_direction(frame, textures, frames, "volumetrics/filter_horizontal", {1, 0});
    add_direction(frame, textures, frames, "volumetrics/filter_vertical", {0, 1});
}

}  // namespace tyndall::volumetrics
