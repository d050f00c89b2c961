#pragma once

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace tyndall {

/// A time of day: where the sun stands and what it gives.
struct DayTime {
    std::string name;
    float elevation;  ///< degrees above the horizon
    float azimuth;    ///< degrees turned from the level's own sun about +Y
    glm::vec3 color;
    float illuminance;  ///< lux
    float exposure_ev100;
};

/// How much of the level's own fog there is, and what is added.
struct FogPreset {
    std::string name;
    float factor;            ///< on all coefficients of the level's media; 0 removes them
    float air = 0;           ///< 0: none; else clear air, of a world that is so many times larger
    std::string added = {};  ///< media file, of the data folder, whose media are added
};

/// Changes a level's sun and media, always starting from how it was loaded.
class LevelLogic {
  public:
    explicit LevelLogic(const Scene& scene);
    /// Index 0 is the level as loaded.
    void set_day_time(Scene& scene, std::size_t index);
    void set_fog(Scene& scene, std::size_t index);  ///< throws Error: what it adds cannot be read
    [[nodiscard]] const std::vector<DayTime>& day_times() const { return day_times_; }
    [[nodiscard]] const std::vector<FogPreset>& fogs() const { return fogs_; }
    [[nodiscard]] std::size_t day_time() const { return day_time_; }
    [[nodiscard]] std::size_t fog() const { return fog_; }

  private:
    std::vector<DayTime> day_times_;
    std::vector<FogPreset> fogs_;
    std::vector<Medium> media_;
    std::optional<std::size_t> sun_index_;
    Light sun_;
    glm::quat sun_rotation_{1, 0, 0, 0};
    float exposure_ = 0;
    std::size_t day_time_ = 0, fog_ = 0;
};

}  // namespace tyndall
