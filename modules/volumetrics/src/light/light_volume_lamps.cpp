#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "light/light_volume.h"
#include "media/shape.h"

namespace tyndall::volumetrics {
namespace {

constexpr int tiles_across = 16, border = 1;

/// FNV-1a (Fowler, Noll, Vo).
class Hash {
  public:
    template <class T>
    void add(const T& value) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        for (std::size_t i = 0; i < sizeof value; ++i) state_ = (state_ ^ bytes[i]) * 0x100000001b3U;
    }
    [[nodiscard]] std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325U;
};

/// Directions round an axis.
struct Cone {
    glm::vec3 axis{0};
    float angle = glm::pi<float>();  ///< half the opening

    /// The directions of this or the other, round the axis of this.
    void add(const Cone& other) {
        const float between = std::acos(std::clamp(glm::dot(axis, other.axis), -1.0F, 1.0F));
        angle = std::min(std::max(angle, between + other.angle), glm::pi<float>());
    }
};

Cone cone_of(const LocalMedium& medium, glm::vec3 lamp) {
    const float radius = bounding_radius(medium);
    const glm::vec3 to = medium.center - lamp;
    const float distance = glm::length(to);
    return distance <= radius ? Cone() : Cone{to / distance, std::asin(radius / distance)};
}

/// In perspective where that is finer than the octahedral map: up to a tangent of 1.5. The window is a texel wider
/// than the cone on each side.
glm::vec4 window_round(const Cone& cone, int directions) {
    if (cone.angle > 1.5F) return glm::vec4(0);
    const float tangent = std::max(std::tan(cone.angle), 1e-3F) * (1 + 2 / static_cast<float>(directions));
    return tangent > 1.5F ? glm::vec4(0) : glm::vec4(cone.axis, 1 / tangent);
}

/// Of the directions that a lamp shines in and those of the media, whichever are fewer.
glm::vec4 window_of(const Lamp& lamp, const std::vector<Cone>& media, int directions) {
    glm::vec3 sum(0);
    for (const Cone& cone : media) sum += cone.axis;
    Cone all{.axis = glm::length(sum) > 1e-3F ? glm::normalize(sum) : glm::vec3(0, 1, 0), .angle = 0};
    for (const Cone& cone : media) all.add(cone);
    const Cone lit{lamp.axis, std::acos(std::clamp(lamp.cos_outer, -1.0F, 1.0F))};
    return window_round(lit.angle < all.angle ? lit : all, directions);
}

}  // namespace

struct LampVolumes::Wanted {
    Lamp lamp;
    float begin = std::numeric_limits<float>::max(), end = 0;  ///< m from it, where there are media
    glm::vec4 window{0};
    std::uint64_t key = 0;
    float eye_distance = 0;  ///< m from the eye to where its range ends; negative inside
};

void LampVolumes::allocate(std::size_t count, int directions, bool chromatic) {
    const int side = directions + 2 * border;
    const auto rows = static_cast<int>(std::bit_ceil((count + tiles_across - 1) / tiles_across));
    const glm::ivec3 size{tiles_across * side, rows * side, directions};
    const bool fits = texture_ && texture_.desc().size.x == size.x && texture_.desc().size.y >= size.y &&
                      (texture_.desc().format == GL_RGBA16F) == chromatic;
    if (fits) return;
    texture_ = light_volume_texture(size, chromatic, "volumetrics lamp volumes");
    slots_.assign(static_cast<std::size_t>(rows) * tiles_across, {});
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const int tile = static_cast<int>(i);
        slots_[i].rays.origin = {tile % tiles_across * side, tile / tiles_across * side, 0};
        slots_[i].rays.size = {side, side, directions};
    }
}

/// The slot that holds this volume already, else one that this frame does not use.
LampVolumes::Slot& LampVolumes::slot_for(const Wanted& wanted) {
    const auto kept = std::ranges::find(slots_, wanted.key, &Slot::key);
    if (kept != slots_.end()) return *kept;
    Slot& slot = *std::ranges::find(slots_, false, &Slot::used);
    slot.key = wanted.key;
    slot.rays.lamp = wanted.lamp.position;
    slot.rays.window = wanted.window;
    slot.rays.begin = wanted.begin;
    slot.rays.end = wanted.end;
    slot.stale = true;
    return slot;
}

void LampVolumes::prepare(const Inputs& inputs, const Settings& settings, FrameMedia& media) {
    std::vector<Wanted> all;
    for (const Lamp& lamp : inputs.has_lamps ? inputs.lamps : std::vector<Lamp>()) {
        if (is_sun(lamp, inputs.eye)) continue;  // from there all media lie in one direction
        const float range = lamp.range > 0 ? lamp.range : std::numeric_limits<float>::max();
        Wanted wanted{.lamp = lamp};
        Hash hash;
        hash.add(lamp.position);
        std::vector<Cone> cones;
        for (const AttenuatingMedium& medium : media.attenuating) {
            const glm::vec2 at = distances(medium.medium, lamp.position);
            if (at.x >= range) continue;
            wanted.begin = std::min(wanted.begin, at.x);
            wanted.end = std::max(wanted.end, std::min(at.y, range));
            cones.push_back(cone_of(medium.medium, lamp.position));
            hash.add(medium.packed);
        }
        wanted.window = window_of(lamp, cones, settings.light_volumes.lamp_size);
        hash.add(wanted.end);
        hash.add(wanted.window);
        wanted.key = hash.value();
        wanted.eye_distance = glm::distance(inputs.eye, lamp.position) - range;
        if (wanted.end > wanted.begin) all.push_back(wanted);
    }
    if (all.empty()) return release();
    media_count_ = static_cast<std::uint32_t>(media.attenuating.size());
    std::ranges::stable_sort(all, {}, &Wanted::eye_distance);
    const auto limit = static_cast<std::size_t>(settings.light_volumes.lamp_count);
    left_out_ = all.size() - std::min(all.size(), limit);
    all.resize(all.size() - left_out_);
    allocate(all.size(), settings.light_volumes.lamp_size, media.chromatic);

    for (Slot& slot : slots_) slot.used = std::ranges::find(all, slot.key, &Wanted::key) != all.end();
    const auto last = std::ranges::max(all, {}, [](const Wanted& w) { return w.lamp.index; }).lamp.index;
    std::vector<glm::vec4> entries(2 * (std::size_t{last} + 1), glm::vec4(-1));
    for (const Wanted& wanted : all) {
        Slot& slot = slot_for(wanted);
        slot.used = true;
        entries[2 * wanted.lamp.index] = {slot.rays.origin.x + border, slot.rays.origin.y + border, wanted.begin,
                                          1 / (wanted.end - wanted.begin)};
        entries[2 * wanted.lamp.index + 1] = slot.rays.window;
    }
    // The buffer never shrinks: what the shaders see of it must not be of an earlier frame.
    if (entries.size() < entries_.size()) entries.resize(entries_.size(), glm::vec4(-1));
    if (entries != entries_) table_.assign(std::span<const glm::vec4>(entries), "volumetrics lamp volume table");
    entries_ = entries;
    const glm::vec2 atlas = texture_.size();
    media.data.lamp_volumes = {settings.light_volumes.lamp_size, settings.light_volumes.lamp_size, 1.0F / atlas};
}

bool LampVolumes::stale() const {
    return std::ranges::any_of(slots_, [](const Slot& slot) { return slot.used && slot.stale; });
}

void LampVolumes::fill(ShaderLibrary& shaders, bool count_work, const DimmingMedia& media) {
    std::vector<LightRays> rays;
    for (Slot& slot : slots_) {
        if (!slot.used || !slot.stale) continue;
        slot.rays.media_count = media_count_;
        rays.push_back(slot.rays);
        slot.stale = false;
    }
    fill_light_volume(shaders, count_work, texture_, media, rays);
}

}  // namespace tyndall::volumetrics
