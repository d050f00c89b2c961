#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>

#include "bench/bench.h"
#include "bench/ground_truth.h"
#include "bench/scene_edit.h"
#include "bench/store.h"
#include "bench/ticker.h"

namespace tyndall::bench {

/// Draws what a suite asks for and is not in the store. Within a group all errors come first, which warms every
/// shader variant up; then the points take turns at being timed, so that a machine that slows down slows all of
/// them.
class Runner {
  public:
    Runner(const BenchOptions& options, const Suite& suite, Store& store, std::unique_ptr<Session>& session);
    /// `done` is called after each group.
    void run(const std::function<void()>& done);

  private:
    void run_group(const Group& group);
    void open(const Group& group);
    /// Sets the session to the point: scene, size, settings.
    View show(const Point& point);
    void measure(const Point& point, bool motion);
    void time_turn(const Point& point);
    [[nodiscard]] bool timed_enough(const Point& point) const;
    [[nodiscard]] int frames_left(const Point& point) const;
    [[nodiscard]] bool beyond_driver(const Group& group, const Point& point) const;

    const BenchOptions& options_;
    const Suite& suite_;
    Store& store_;
    std::unique_ptr<Session>& session_;
    std::unique_ptr<SceneEditor> editor_;
    GroundTruths truths_;
    std::string truth_subject_;  ///< of truth_
    GroundTruth truth_;
    std::set<std::string> warm_;  ///< keys of points that this session has drawn
    Ticker ticker_;
};

/// A session with the point's scene, without settings.
[[nodiscard]] std::unique_ptr<Session> open_session(const BenchOptions& options, const Place& place);

}  // namespace tyndall::bench
