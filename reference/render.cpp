#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "reference/reference.h"

namespace tyndall::reference {
namespace {

/// Rays through points of the picture, (0, 0) its upper left corner and (1, 1) the lower right one.
class Camera {
  public:
    explicit Camera(const View& view) : eye_(view.eye), near_(view.znear) {
        const glm::dmat3 to_world = glm::inverse(glm::dmat3(view.view));
        right_ = glm::normalize(to_world[0]);
        up_ = glm::normalize(to_world[1]);
        forward_ = -glm::normalize(to_world[2]);
        half_height_ = std::tan(0.5 * static_cast<double>(view.yfov));
        half_width_ = half_height_ * static_cast<double>(view.aspect);
    }
    struct Ray {
        dvec3 origin, direction;
        double begin;    ///< of the near plane
        double forward;  ///< cosine with the view axis
    };
    [[nodiscard]] Ray through(dvec2 p) const {
        const dvec3 towards = forward_ + (2 * p.x - 1) * half_width_ * right_ + (1 - 2 * p.y) * half_height_ * up_;
        const double forward = 1 / glm::length(towards);
        return {eye_, forward * towards, near_ / forward, forward};
    }

  private:
    dvec3 eye_, right_, up_, forward_;
    double near_, half_height_, half_width_;
};

void store(float* to, dvec3 v) {
    for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(v[i]);
}

class Frame {
  public:
    Frame(const Reference& reference, const View& view, glm::ivec2 size, int samples)
        : reference_(reference), camera_(view), size_(size), samples_(samples) {
        for (Image* image : {&picture.color, &picture.scattering, &picture.transmittance}) *image = Image(size, 3);
        for (Image* image : {&picture.depth, &picture.error}) *image = Image(size, 1);
    }
    void draw_row(int y) {
        for (int x = 0; x < size_.x; ++x) draw({x, y});
    }
    Picture picture;

  private:
    void draw(glm::ivec2 pixel) {
        dvec3 color(0), scattering(0), transmittance(0);
        double error = 0;
        for (int k = 0; k < samples_ * samples_; ++k) {
            const dvec2 within = (dvec2(k % samples_, k / samples_) + 0.5) / static_cast<double>(samples_);
            const Camera::Ray ray = camera_.through((dvec2(pixel) + within) / dvec2(size_));
            const Reference::Ray traced = reference_.trace(ray.origin, ray.direction, ray.begin);
            color += traced.color();
            scattering += traced.scattering;
            transmittance += traced.transmittance;
            error += traced.error;
        }
        const double share = 1.0 / (samples_ * samples_);
        store(picture.color.at(pixel.x, pixel.y), share * color);
        store(picture.scattering.at(pixel.x, pixel.y), share * scattering);
        store(picture.transmittance.at(pixel.x, pixel.y), share * transmittance);
        *picture.error.at(pixel.x, pixel.y) = static_cast<float>(share * error);
        const Camera::Ray center = camera_.through((dvec2(pixel) + 0.5) / dvec2(size_));
        const double distance = reference_.visible_distance(center.origin, center.direction, center.begin);
        *picture.depth.at(pixel.x, pixel.y) =
            std::isfinite(distance) ? static_cast<float>(distance * center.forward) : 0.0f;
    }
    const Reference& reference_;
    Camera camera_;
    glm::ivec2 size_;
    int samples_;
};

}  // namespace

Picture render(const Reference& reference, const View& view, glm::ivec2 size, int samples, int threads,
               const std::function<void(int, int)>& progress) {
    Frame frame(reference, view, size, samples);
    std::atomic<int> next = 0;
    std::mutex mutex;  // of what follows
    int done = 0;
    std::exception_ptr failure;
    const auto work = [&] {
        try {
            for (int y = next++; y < size.y; y = next++) {
                frame.draw_row(y);
                const std::lock_guard lock(mutex);
                ++done;
                if (progress) progress(done, size.y);
            }
        } catch (...) {
            const std::lock_guard lock(mutex);
            failure = std::current_exception();
            next = size.y;
        }
    };
    const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    std::vector<std::jthread> pool;
    for (int i = 1; i < std::min(threads > 0 ? threads : all, size.y); ++i) pool.emplace_back(work);
    work();
    pool.clear();
    if (failure) std::rethrow_exception(failure);
    return std::move(frame.picture);
}

}  // namespace tyndall::reference
