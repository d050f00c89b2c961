#pragma once
// A host of the volumetrics module without an engine: its own light lists and analytic shadows replace
// shaders/interface, and the depth buffer is given pixel by pixel.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/image.h"
#include "engine/core/roots.h"
#include "engine/gl/buffer.h"
#include "engine/gl/texture.h"
#include "engine/graph/pass_list.h"
#include "engine/scene/data_root.h"
#include "shaders/shared/lights.h"
#include "volumetrics/volumetrics.h"

namespace tyndall::test {

using volumetrics::GlobalMedium;
using volumetrics::Inputs;
using volumetrics::LocalMedium;
using volumetrics::Settings;
using volumetrics::Shape;

/// A view depth that stands for the sky.
constexpr float sky = -1;

/// A folder with this host's shaders/interface. Lives as long as the object.
class ShaderFolder {
  public:
    ShaderFolder();
    ~ShaderFolder();
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] Roots roots() const { return {path_, data_root()}; }  ///< all else is the repository's

  private:
    std::filesystem::path path_;
};

struct Frame {
    Image scattering;     ///< RGBA, row 0 at the top; a is the mean transmittance
    Image transmittance;  ///< RGB; filled from scattering.a where it is the same for all channels
    std::vector<std::string> live_passes;
    std::map<std::string, std::string> skipped;  ///< name: reason
    std::map<std::string, gl::WorkCounts> work;
    std::map<std::string, double> milliseconds;
    std::size_t persistent_bytes = 0;
};

class StubHost {
  public:
    /// A camera at `eye` that looks along -Z of `rotation`; one pixel is the centre ray.
    StubHost();

    glm::ivec2 size{1, 1};
    glm::vec3 eye{0};
    glm::mat3 rotation{1};  ///< of the camera: what its axes are in the world
    float vertical_fov = 1.0F;
    float znear = 0.1F;
    std::function<float(int x, int y)> view_depth = [](int, int) { return 10.0F; };  ///< y up; `sky` for none

    std::vector<GlobalMedium> global;
    std::vector<LocalMedium> local;
    bool has_sun = false;
    glm::vec3 sun_direction{0, -1, 0};  ///< in which its light travels
    glm::vec3 sun_illuminance{1};
    glm::vec3 ambient{0};
    std::vector<shared::GpuLight> lights;
    /// Light lists by depth slices of equal thickness; one slice lists all. A lamp is listed where `listed` says
    /// so.
    int slices = 1;
    float slice_depth = 1;
    std::function<bool(int light, int slice)> listed = [](int, int) { return true; };
    /// 0: nothing casts a shadow. 1: a fence in the plane y = 4 shadows the sun, one around each lamp the lamp. 2:
    /// the half x < 0 of the plane z = -6 shadows lamps. 3: the half x < 0 of the plane y = 4 shadows the sun. 4,
    /// of shadow maps alone: each of the sun's rays ends at a random height of 0 … 6.
    int shadows = 0;
    bool has_shadow_maps = true, sun_shadow = true;
    std::optional<glm::vec3> glass;          ///< what it leaves of the light of x < 0
    int glass_of = GLASS_SUN | GLASS_LAMPS;  ///< before which lights there is some
    std::uint32_t frame_index = 0;
    bool count_work = false;

    [[nodiscard]] glm::mat4 projection() const;
    /// World-space ray through a pixel's centre, unit.
    [[nodiscard]] glm::vec3 ray(int x, int y) const;
    [[nodiscard]] Frame render(const Settings& settings);
    [[nodiscard]] volumetrics::Volumetrics& volumetrics() { return volumetrics_; }
    [[nodiscard]] Inputs inputs(PassList& passes);

  private:
    void upload();
    volumetrics::Volumetrics volumetrics_;
    TransientPool pool_;
    gl::Texture depth_;
    gl::Buffer uniforms_, lights_, ranges_, list_;
};

/// Settings without anything stochastic or filtered: no dither, no blur.
[[nodiscard]] Settings plain_settings(int steps);
[[nodiscard]] shared::GpuLight point_light(glm::vec3 position, float intensity, float range = 1000,
                                           float radius = 0.01F);
[[nodiscard]] shared::GpuLight spot_light(glm::vec3 position, glm::vec3 direction, float intensity, float cos_inner,
                                          float cos_outer, float range = 1000);
[[nodiscard]] double phase_hg(double g, double cos_theta);

}  // namespace tyndall::test
