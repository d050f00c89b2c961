#include "frame.h"

#include <algorithm>
#include <cmath>

#include "draw_scene.h"
#include "moderate.h"
#include "settings_draw.h"

namespace tyndall::stress {
namespace {

// Programs are compiled once for each structure, so there are few of them; another run of them begins every
// `epoch` frames.
constexpr int structures = 2 * moderate_turns, epoch = 2000;

/// Segments of rays (pixels, steps, lamps) that a frame may cost: some 20 ms on two cores.
constexpr double work_budget = 1.0e6;

SizeKind draw_size_kind(Random& random) {
    const double u = random.unit();
    if (u < 0.7) return SizeKind::small;
    return static_cast<SizeKind>(2 + random.below(5));
}

Structure draw_structure(int index, Random& random) {
    Structure s;
    s.size = draw_size_kind(random);
    s.world = random.pick({World::nothing, World::standing, World::moving, World::moving});
    s.sun = random.chance(0.55);
    s.lamps = random.chance(0.65);
    s.homogeneous = random.chance(0.45);
    s.heights = random.pick({0, 0, 1, 1, 3});
    s.local = random.chance(0.5);
    s.local_emission = random.chance(0.4);
    s.chromatic = random.chance(0.5);
    if (!s.homogeneous && s.heights == 0 && !s.local && random.chance(0.9)) s.homogeneous = true;
    draw_settings(render_settings_table(), &s.options.render, SettingEffect::permutation, random);
    draw_settings(volumetrics::settings_table(), &s.options.volumetrics, SettingEffect::permutation, random);
    // The march is what extremes are about; a technique that the table gets later is drawn now and then.
    if (random.chance(0.7)) s.options.volumetrics.technique = "ray_march";
    if (index % 2 == 1) moderate_structure(s, index / 2, random);
    return s;
}

// llvmpipe compiles a shader anew for textures whose sides are powers of two: what need not be one is odd.
int odd(double v) {
    return static_cast<int>(v) | 1;
}

glm::ivec2 draw_size(SizeKind kind, Random& random) {
    const int length = odd(random.logarithmic(3, 256));
    switch (kind) {
        case SizeKind::one_pixel:
            return {1, 1};
        case SizeKind::column:
            return {1, length};
        case SizeKind::row:
            return {length, 1};
        case SizeKind::wide:
            return {1 << (6 + random.below(7)), 16};
        case SizeKind::tall:
            return {16, 1 << (6 + random.below(7))};
        case SizeKind::thumbnail:
            return {odd(random.logarithmic(9, 33)), odd(random.logarithmic(9, 33))};
        case SizeKind::small:
            break;
    }
    const int height = odd(random.logarithmic(3, 128));
    return {odd(random.logarithmic(3, 128)), height};
}

/// Lowers steps, then the size, until the frame is cheap.
void limit_work(StressFrame& frame) {
    volumetrics::Settings& v = frame.options.volumetrics;
    if (frame.options.volumetrics.technique == "reference") {
        frame.size = glm::min(frame.size, glm::ivec2(9));
        v.reference.steps = std::min(v.reference.steps, 512);
        if (!frame.comparable) v.reference.light_steps = std::min(v.reference.light_steps, 4);
    }
    const double pixels = static_cast<double>(frame.size.x) * frame.size.y;
    const double weight = (1 + 2.0 * static_cast<double>(frame.lights.size())) * pixels;
    v.march.steps = std::clamp(v.march.steps, 1, std::max(1, static_cast<int>(work_budget / weight)));
}

}  // namespace

StressFrame make_frame(std::uint64_t seed, int number) {
    const auto k = static_cast<std::uint64_t>(number);
    const std::uint64_t sequence = k / sequence_length;
    const int index = static_cast<int>(sequence % structures);
    Random of_structure{seed, 1, k / epoch, sequence % structures};
    Random of_sequence{seed, 2, sequence};
    Random random{seed, 3, k};

    const int visit = static_cast<int>(sequence / structures);
    Structure structure = draw_structure(index, of_structure);
    if (structure.comparable) moderate_visit(structure, visit);
    StressFrame frame;
    frame.world = structure.world;
    frame.comparable = structure.comparable;
    frame.options = structure.options;
    frame.size = draw_size(structure.size, of_sequence);
    for (const SettingEffect effect : {SettingEffect::resource, SettingEffect::uniform}) {
        Random& from = effect == SettingEffect::resource ? of_sequence : random;
        draw_settings(render_settings_table(), &frame.options.render, effect, from);
        draw_settings(volumetrics::settings_table(), &frame.options.volumetrics, effect, from);
    }
    // The ground truth of a sky takes long to set up: once a sequence.
    if (structure.comparable && number % sequence_length != 0) frame.options.render.ambient = 0;
    limit_resources(frame.options);
    draw_world(frame, structure, of_sequence, random);
    if (structure.comparable) moderate_frame(frame, visit, of_sequence, random);
    limit_work(frame);

    frame.options.layer = "scattering";
    frame.options.more_layers = {"transmittance", "depth"};
    frame.options.frame_index = static_cast<std::uint32_t>(number);
    frame.options.time = random.pick({0.0, 1e-3 * number, 1e6});
    frame.exposure_ev100 = static_cast<float>(of_sequence.linear(-30, 40));
    frame.cut = number % sequence_length == 0 || random.chance(0.2);
    return frame;
}

Scene pose_scene(const Scene& world, const StressFrame& frame) {
    Scene scene = world;
    for (std::size_t i = 0; i < std::min(frame.objects.size(), scene.nodes.size()); ++i)
        scene.nodes[i].world = frame.objects[i] * scene.nodes[i].world;
    for (const auto& [light, pose] : frame.lights) {
        Node node;
        node.world = pose;
        node.light = static_cast<int>(scene.lights.size());
        scene.lights.push_back(light);
        scene.lights.back().node = static_cast<int>(scene.nodes.size());
        scene.nodes.push_back(node);
    }
    scene.media = frame.media;
    scene.exposure_ev100 = frame.exposure_ev100;
    if (!frame.comparable) return scene;
    // Drawn for an exposure of 0; see draw_lights.cpp and draw_media.cpp.
    for (Light& light : scene.lights) light.intensity *= scene.light_unit();
    for (Medium& medium : scene.media) medium.emission *= scene.light_unit();
    return scene;
}

}  // namespace tyndall::stress
