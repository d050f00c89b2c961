// Light that local media scatter, against integration in double precision over the shapes of the ground truth: all
// shapes, thin and dense, under a sun, point lamps beside and inside, and a spot.

#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "adapter/volumetrics_adapter.h"
#include "reference/media_shape.h"
#include "tests/gpu/support/gl_test.h"
#include "tests/gpu/support/volumetrics_host.h"
#include "tests/unit/shader_lib/quadrature.h"

namespace tyndall::test {
namespace {

enum class Light { sun, lamp_beside, lamp_inside, spot };

class VolumetricsLitMedia : public GlTest {
  protected:
    VolumetricsLitMedia() {
        host.size = {8, 6};
        host.vertical_fov = 0.5F;
        host.view_depth = [](int, int) { return 30.0F; };
        host.sun_direction = glm::normalize(glm::vec3(0.3F, -1, -0.4F));
        host.sun_illuminance = glm::vec3(100);
    }
    StubHost host;
    Medium medium;

    void set_light(Light light) {
        host.has_sun = light == Light::sun;
        host.lights.clear();
        if (light == Light::lamp_beside) host.lights = {point_light({2.2F, 0.4F, -9.5F}, 100)};
        if (light == Light::lamp_inside) host.lights = {point_light({0.2F, 0.1F, -10.1F}, 100)};
        if (light == Light::spot)
            host.lights = {spot_light({-1, 4, -9}, glm::normalize(glm::vec3(1, -4, -1)), 100, 0.98F, 0.9F)};
    }
    void set_medium(Medium::Shape shape, float softness, float sigma_s) {
        medium = {};
        medium.shape = shape;
        medium.center = {0, 0, -10};
        medium.half_extent = {1.2F, 1, 0.9F};
        medium.softness = softness;
        medium.sigma_s = glm::vec3(sigma_s);
        medium.sigma_a = glm::vec3(0.1F * sigma_s);
        medium.anisotropy = 0.4F;
        host.local = {local_medium(medium)};
    }

    [[nodiscard]] double optical_depth(glm::dvec3 from, glm::dvec3 to) const {
        const double length = glm::distance(from, to);
        const auto path = shape_->path(from, (to - from) / std::max(length, 1e-9));
        if (!path) return 0;
        const double begin = std::max(path->inside.begin, 0.0), end = std::min(path->inside.end, length);
        return begin < end ? shape_->density_length(*path, begin, end, 1e-5) * sigma_t() : 0;
    }
    [[nodiscard]] double sigma_t() const { return double(medium.sigma_s.x) + double(medium.sigma_a.x); }

    /// What arrives at a point times phase: per sigma_s.
    [[nodiscard]] double arriving(glm::dvec3 point, glm::dvec3 direction) const {
        const double g = medium.anisotropy;
        if (host.has_sun) {
            const glm::dvec3 travel(host.sun_direction);
            return double(host.sun_illuminance.r) * phase_hg(g, -glm::dot(travel, direction)) *
                   std::exp(-optical_depth(point, point - travel * 100.0));
        }
        const shared::GpuLight& light = host.lights[0];
        const glm::dvec3 position(light.position_range);
        const double d = glm::distance(point, position), radius = light.intensity_radius.w;
        const glm::dvec3 travel = (point - position) / std::max(d, 1e-9);
        double value = light.intensity_radius.r / std::max(d * d, radius * radius);
        if (light.direction_type.w == LIGHT_SPOT) {
            const double s = std::clamp(
                glm::dot(travel, glm::dvec3(light.direction_type)) * light.cone_shadow.x + light.cone_shadow.y, 0.0,
                1.0);
            value *= s * s;
        }
        return value * phase_hg(g, -glm::dot(travel, direction)) * std::exp(-optical_depth(position, point));
    }
    [[nodiscard]] double expected(int x, int y) const {
        const glm::dvec3 d = glm::normalize(glm::dvec3(host.ray(x, y))), eye(host.eye);
        const auto path = shape_->path(eye, d);
        if (!path) return 0;
        double sum = 0;
        constexpr int panels = 24;
        const double length = path->inside.end - path->inside.begin;
        // Denser where a lamp is nearest.
        const double nearest = host.lights.empty()
                                   ? path->inside.begin
                                   : std::clamp(glm::dot(glm::dvec3(host.lights[0].position_range) - eye, d),
                                                path->inside.begin, path->inside.end);
        for (const double side : {path->inside.begin, path->inside.end})
            for (int i = 0; i < panels && length > 0; ++i) {
                const auto at = [&](double u) { return nearest + (side - nearest) * u * u; };
                sum += std::abs(gauss_legendre(
                    [&](double t) {
                        const glm::dvec3 point = eye + d * t;
                        return path->density(t) * std::exp(-optical_depth(eye, point)) * arriving(point, d);
                    },
                    at(double(i) / panels), at(double(i + 1) / panels)));
            }
        return double(medium.sigma_s.x) * sum;
    }

    struct Error {
        double mean = 0, worst = 0;  ///< of the picture's mean; of a pixel, relative to the brightest
    };
    Error error(const Settings& settings, const std::vector<double>& truth) {
        const Frame frame = host.render(settings);
        double sum = 0, brightest = 0, true_sum = 0, worst = 0;
        for (const double value : truth) {
            true_sum += value;
            brightest = std::max(brightest, value);
        }
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double value = frame.scattering.pixels[4 * i];
            sum += value;
            worst = std::max(worst, std::abs(value - truth[i]) / brightest);
        }
        return {std::abs(sum / true_sum - 1), worst};
    }

    /// Prints the worst errors of each technique; those of `tolerances` are asserted.
    void sweep(Light light, const std::map<std::string, Error>& tolerances) {
        set_light(light);
        std::map<std::string, Error> worst;
        for (const Medium::Shape shape : {Medium::Shape::box, Medium::Shape::ellipsoid})
            for (const float softness : {0.0F, 0.5F})
                for (const float sigma_s : {0.1F, 0.8F, 4.0F}) {
                    set_medium(shape, softness, sigma_s);
                    const reference::MediumShape truth_shape(medium);
                    shape_ = &truth_shape;
                    std::vector<double> truth;
                    for (int y = host.size.y - 1; y >= 0; --y)
                        for (int x = 0; x < host.size.x; ++x) truth.push_back(expected(x, y));
                    for (const auto& [technique, tolerance] : tolerances) {
                        // Slices and particles as long as a mean free path hold no more than its mean; and in so
                        // dense a medium the volume of a spot's 24 by 24 directions is coarser than what it lights.
                        if (sigma_s > 1 && (technique == "froxel" || technique == "particles" ||
                                            (light == Light::spot && technique != "reference")))
                            continue;
                        if (technique == "froxel" && softness > 0) continue;  // it is dear
                        Settings settings = plain_settings(8);
                        settings.technique = technique;
                        settings.billboards.fade = 0;
                        settings.froxels.x = 64;
                        settings.froxels.y = 48;
                        settings.froxels.z = 128;
                        settings.particles.local_count = 8192;
                        settings.froxels.far = 32;
                        settings.froxels.distribution = volumetrics::DepthDistribution::linear;
                        const Error e = error(settings, truth);
                        EXPECT_LE(e.mean, tolerance.mean) << technique << ' ' << name_of(shape) << " softness "
                                                          << softness << " sigma_s " << sigma_s;
                        EXPECT_LE(e.worst, tolerance.worst) << technique << ' ' << name_of(shape) << " softness "
                                                            << softness << " sigma_s " << sigma_s;
                        worst[technique].mean = std::max(worst[technique].mean, e.mean);
                        worst[technique].worst = std::max(worst[technique].worst, e.worst);
                    }
                }
        for (const auto& [technique, e] : worst)
            std::cout << fmt::format("{}: mean {:.1f}%, a pixel {:.1f}% of the brightest\n", technique,
                                     100 * e.mean, 100 * e.worst);
    }

  private:
    const reference::MediumShape* shape_ = nullptr;
};

TEST_F(VolumetricsLitMedia, SunThroughTheMedium) {
    sweep(Light::sun, {{"ray_march", {0.03, 0.05}},
                       {"froxel", {0.05, 0.1}},
                       {"billboards", {0.1, 0.08}},
                       {"particles", {0.03, 0.06}},
                       {"reference", {0.01, 0.01}}});
}
TEST_F(VolumetricsLitMedia, LampBesideTheMedium) {
    sweep(Light::lamp_beside, {{"ray_march", {0.05, 0.06}},
                               {"froxel", {0.15, 0.25}},
                               {"billboards", {0.06, 0.08}},
                               {"particles", {0.1, 0.15}},
                               {"reference", {0.01, 0.01}}});
}
TEST_F(VolumetricsLitMedia, LampInTheMedium) {
    sweep(Light::lamp_inside, {{"ray_march", {0.02, 0.02}},
                               {"froxel", {0.03, 0.04}},
                               {"billboards", {0.03, 0.03}},
                               {"particles", {0.15, 0.15}},
                               {"reference", {0.01, 0.01}}});
}
TEST_F(VolumetricsLitMedia, SpotIntoTheMedium) {
    sweep(Light::spot, {{"ray_march", {0.05, 0.05}},
                        {"froxel", {0.09, 0.07}},
                        {"billboards", {0.05, 0.05}},
                        {"particles", {0.2, 0.2}},
                        {"reference", {0.01, 0.01}}});
}

}  // namespace
}  // namespace tyndall::test
