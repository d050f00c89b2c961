#include "reference/sky_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/brdf.h"
#include "reference/cube_quadrature.h"

namespace tyndall::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double sum_of(const dvec3& v) {
    return v.x + v.y + v.z;
}

/// Distances along a ray, drawn about in proportion to what the media there scatter towards the eye.
class Distances {
  public:
    explicit Distances(const MediaRay& ray) {
        constexpr int cells = 16;         // between two knots
        constexpr double anywhere = 0.1;  // of a cell's share: as if all were alike, for what its three points miss
        const std::vector<double>& knots = ray.knots();
        for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
            const double width = (knots[k + 1] - knots[k]) / cells;
            std::array<double, cells> shares{};
            double all = 0;
            for (std::size_t i = 0; i < cells; ++i) {
                for (const double part : {1.0 / 6, 0.5, 5.0 / 6}) {
                    const double t = knots[k] + (static_cast<double>(i) + part) * width;
                    shares[i] += width / 3 * sum_of(ray.at(t).sigma_s * glm::exp(-ray.depth(t)));
                }
                all += shares[i];
            }
            for (std::size_t i = 0; i < cells; ++i)
                add(knots[k] + static_cast<double>(i) * width, width,
                    (1 - anywhere) * shares[i] + anywhere / cells * all);
        }
    }
    [[nodiscard]] bool empty() const { return cells_.empty(); }
    struct Sample {
        double t, density;  ///< m, 1/m
    };
    [[nodiscard]] Sample at(double u) const {
        const double target = u * cells_.back().up_to;
        const auto after = std::upper_bound(cells_.begin(), cells_.end() - 1, target,
                                            [](double value, const Cell& c) { return value < c.up_to; });
        const double before = after == cells_.begin() ? 0 : std::prev(after)->up_to, share = after->up_to - before;
        return {after->begin + after->width * (target - before) / share,
                share / (cells_.back().up_to * after->width)};
    }

  private:
    struct Cell {
        double begin, width, up_to;
    };
    void add(double begin, double width, double share) {
        const double before = empty() ? 0 : cells_.back().up_to;
        if (before + share > before) cells_.push_back({begin, width, before + share});
    }
    std::vector<Cell> cells_;
};

/// What a ray's media scatter towards the eye, by the cosine, averaged over the ray: only for drawing directions.
class MeanLobe {
  public:
    MeanLobe(const InScattering& scattering, const MediaRay& ray, const Distances& distances) {
        constexpr int points = 16;
        for (int p = 0; p < points; ++p) {
            const MediumPoint m = ray.at(distances.at((p + 0.5) / points).t);
            const double all = sum_of(m.sigma_s);
            if (!(all > 0)) continue;
            for (std::size_t i = 0; i < table_.size(); ++i) {
                const double sine = static_cast<double>(i) / last;
                table_[i] += sum_of(scattering.scattered(m, 1 - 2 * sine * sine)) / all;
            }
        }
    }
    [[nodiscard]] double operator()(double cos_theta) const {
        const double x = last * std::sqrt(std::clamp(0.5 - 0.5 * cos_theta, 0.0, 1.0));
        const auto i = std::min(static_cast<std::size_t>(x), table_.size() - 2);
        return std::lerp(table_[i], table_[i + 1], x - static_cast<double>(i));
    }

  private:
    static constexpr double last = 512;
    std::array<double, 513> table_{};  ///< by the sine of half the angle
};

}  // namespace

SkyLight::SkyLight(const SkyTable& sky, const Geometry& geometry, const InScattering& scattering,
                   const Settings& settings)
    : sky_(sky), geometry_(geometry), scattering_(scattering), settings_(settings) {}

InScattering::Result SkyLight::along(const MediaRay& ray, dvec3 origin, dvec3 unit_direction) const {
    const Distances distances(ray);
    if (distances.empty()) return {};
    const MeanLobe lobe(scattering_, ray, distances);
    const SkySampler directions(sky_, [&](dvec3 d) { return lobe(glm::dot(d, unit_direction)); });
    const auto at = [&](dvec3 u) {
        const auto [t, density] = distances.at(u.x);
        const auto [to_sky, radiance] = directions.at(u.y, u.z);
        const dvec3 point = origin + t * unit_direction;
        if (geometry_.occluded(point, to_sky, infinity, 0)) return dvec3(0);
        return radiance * scattering_.scattered(ray.at(t), glm::dot(to_sky, unit_direction)) *
               glm::exp(-ray.depth(t)) / density * geometry_.tint(point, to_sky, infinity, 0) *
               scattering_.towards_sun(point, to_sky, scattering_.averaged());
    };
    const CubeIntegral sum = integrate_cube(at, 8, settings_.sky_samples, unit_direction);
    return {settings_.ambient * sum.value, settings_.ambient * std::max({sum.error.x, sum.error.y, sum.error.z})};
}

dvec3 SkyLight::reaching(const Surface& surface, dvec3 to_sky) const {
    const dvec3 left = visible(geometry_, surface, to_sky, infinity);
    if (left == dvec3(0)) return left;
    return left * scattering_.towards_sun(surface.position, to_sky, scattering_.averaged());
}

dvec3 SkyLight::diffuse(const Surface& surface, dvec3 to_eye) const {
    constexpr double edge = 0.01;  // cells whose middle is below the horizon may reach above it
    if (surface.metallic >= 1) return dvec3(0);
    const Brdf brdf(surface, to_eye);
    const SkySampler directions(sky_, [&](dvec3 d) { return std::max(glm::dot(surface.normal, d), 0.0) + edge; });
    const auto at = [&](dvec3 u) {
        const auto [to_sky, radiance] = directions.at(u.y, u.z);
        const double cosine = glm::dot(surface.normal, to_sky);
        if (cosine <= 0) return dvec3(0);
        return radiance * cosine * brdf.diffuse(to_sky) * reaching(surface, to_sky);
    };
    return integrate_cube(at, 1, settings_.sky_samples / 4, surface.position).value;
}

dvec3 SkyLight::specular(const Surface& surface, dvec3 to_eye) const {
    const Brdf brdf(surface, to_eye);
    const auto at = [&](dvec3 u) {
        const double azimuth = 2 * std::numbers::pi * u.z;
        const auto [to_sky, weight] = brdf.sample(u.y, std::cos(azimuth), std::sin(azimuth));
        if (weight == dvec3(0)) return weight;
        return weight * sky_.at(to_sky) * reaching(surface, to_sky);
    };
    return integrate_cube(at, 1, settings_.sky_samples / 4, surface.position).value;
}

dvec3 SkyLight::reflected(const Surface& surface, dvec3 to_eye) const {
    return settings_.ambient * surface.occlusion * (diffuse(surface, to_eye) + specular(surface, to_eye));
}

}  // namespace tyndall::reference
