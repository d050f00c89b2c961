#include "sample_game/walk/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace tyndall {
namespace {

constexpr double line_seconds = 7;     // that a line stays
constexpr double evening_seconds = 9;  // in which the light follows a place that was lit
constexpr double hint_seconds = 14, hint_every = 30;
constexpr double shortest_ending = 2;  // before which it cannot be ended by a key

/// The line that is shown at `time`; none after the last.
std::string line_at(const std::vector<std::string>& lines, double time) {
    const auto i = static_cast<std::size_t>(time / line_seconds);
    return i < lines.size() ? lines[i] : std::string();
}

double seconds_of(const std::vector<std::string>& lines) {
    return line_seconds * static_cast<double>(lines.size());
}

}  // namespace

Walk::Walk(const WalkScript& script) : script_(&script), burning_(script.places.size()) {}

void Walk::update(const Player& player, double dt) {
    player_ = player;
    time_ += dt;
    since_lit_ += dt;
    for (std::optional<double>& seconds : burning_)
        if (seconds) *seconds += dt;
    if (ending_) {
        *ending_ += dt;
        over_ = over_ || *ending_ > seconds_of(script_->end_words) || (player.use && *ending_ > shortest_ending);
        return;
    }
    if (player.lantern) {
        lantern_ = !lantern_;
        has_used_lantern_ = true;
    }
    if (const auto here = dark_place_here(); player.use && lantern_ && here) {
        burning_[*here] = 0;
        since_lit_ = 0;
        last_lit_ = here;
    }
    if (lit() == burning_.size() && since_lit_ > std::max(line_seconds, evening_seconds)) ending_ = 0;
}

std::size_t Walk::lit() const {
    return static_cast<std::size_t>(std::ranges::count_if(burning_, [](const auto& s) { return s.has_value(); }));
}

float Walk::evening() const {
    float sum = 0;
    for (const std::optional<double>& seconds : burning_)
        sum += smooth_share(seconds.value_or(0) / evening_seconds);
    return sum / static_cast<float>(burning_.size());
}

bool Walk::is_lost() const {
    return lit() < burning_.size() && since_lit_ > static_cast<double>(script_->hint_after);
}

std::optional<std::size_t> Walk::dark_place_here() const {
    for (std::size_t i = 0; i < burning_.size(); ++i) {
        const WalkScript::Place& place = script_->places[i];
        if (!burning_[i] && glm::distance(player_.eye, place.at) < place.reach) return i;
    }
    return std::nullopt;
}

std::string Walk::words() const {
    if (ending_) return line_at(script_->end_words, *ending_);
    if (!last_lit_) return line_at(script_->beginning, time_);
    return since_lit_ < line_seconds ? script_->places[*last_lit_].words : std::string();
}

std::string Walk::prompt() const {
    if (ending_) return {};
    if (const auto here = dark_place_here())
        return lantern_ ? "{use}: light " + script_->places[*here].name : "{lantern}: light your lantern first";
    if (!last_lit_ && time_ > seconds_of(script_->beginning))
        return has_used_lantern_ ? hint() : "{lantern}: light your lantern";
    const double lost = since_lit_ - static_cast<double>(script_->hint_after);
    return is_lost() && std::fmod(lost, hint_every) < hint_seconds ? hint() : std::string();
}

/// To the first dark place in the script's order.
std::string Walk::hint() const {
    const auto dark = std::ranges::find_if(burning_, [](const auto& s) { return !s.has_value(); });
    if (dark == burning_.end()) return {};
    const WalkScript::Place& place = script_->places[static_cast<std::size_t>(dark - burning_.begin())];
    const glm::vec3 way = place.at - player_.eye;
    return fmt::format("{}  ({:.0f} m {})", place.hint, glm::length(way), direction_words(player_.direction, way));
}

float smooth_share(double x) {
    const auto t = static_cast<float>(std::clamp(x, 0.0, 1.0));
    return t * t * (3 - 2 * t);
}

std::string direction_words(glm::vec3 direction, glm::vec3 way) {
    const float turn = std::remainder(std::atan2(way.x, -way.z) - std::atan2(direction.x, -direction.z),
                                      glm::two_pi<float>());  // to the right
    const float size = std::abs(turn);
    if (size < glm::radians(30.0f)) return "ahead";
    if (size > glm::radians(135.0f)) return "behind you";
    return turn > 0 ? "to the right" : "to the left";
}

}  // namespace tyndall
