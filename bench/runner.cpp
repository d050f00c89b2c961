#include "bench/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "bench/errors.h"
#include "bench/pictures.h"
#include "engine/scene/data_root.h"

namespace tyndall::bench {
namespace {

constexpr double time_budget = 5'000;  ///< ms of timed frames, after which two samples are enough
constexpr double slow_frame = 250;     ///< ms; a frame that takes longer needs no other before it
constexpr double loop_limit = 65'535;  ///< iterations, after which llvmpipe ends a shader's loops

double total(const PassTimes& times) {
    return std::accumulate(times.begin(), times.end(), 0.0,
                           [](double sum, const auto& t) { return sum + t.second; });
}

/// Relative cost of one frame of a point, for the time left.
double cost(const Group& group, const Point& point) {
    const int lamps = point.edit.lamps >= 0 ? point.edit.lamps : group.facts.lamps_in_view;
    const double pixels = static_cast<double>(point.size.x) * point.size.y;
    return pixels * point.configuration.weight * (1 + lamps / 8.0);
}

}  // namespace

std::unique_ptr<Session> open_session(const BenchOptions& options, const Place& place) {
    DrawOptions draw;
    draw.scene = (data_root() / place.scene).string();
    draw.size = options.size;
    draw.context = options.context;
    return std::make_unique<Session>(draw, false);
}

Runner::Runner(const BenchOptions& options, const Suite& suite, Store& store, std::unique_ptr<Session>& session)
    : options_(options),
      suite_(suite),
      store_(store),
      session_(session),
      editor_(std::make_unique<SceneEditor>(session->scene)),
      truths_(options.references.value_or(options.out / "references"), truth_kind(options.reference)) {}

void Runner::run(const std::function<void()>& done) {
    int frames = 0, points = 0;
    for (const Group& group : suite_.groups)
        for (const Point& point : group.points) {
            ++points;
            frames += frames_left(point);
            ticker_.plan(frames_left(point) * cost(group, point));
        }
    fmt::print(stderr, "{}: {} groups, {} configurations, {} frames to draw\n", suite_.name, suite_.groups.size(),
               points, frames);
    int number = 0;
    for (const Group& group : suite_.groups) {
        ticker_.group(group.name, ++number, static_cast<int>(suite_.groups.size()));
        run_group(group);
        done();
    }
}

int Runner::frames_left(const Point& point) const {
    const Measured& m = store_.at(point.key());
    const int history = point.configuration.history_frames;
    int frames = 0;
    if (suite_.errors && !m.errors) frames += 1 + history;
    if (!suite_.times) return frames;
    if (!m.work) ++frames;
    const int missing = std::max(0, options_.repeats - static_cast<int>(m.times.size()));
    return frames + missing * (history > 0 ? 3 : 2);
}

bool Runner::timed_enough(const Point& point) const {
    const std::vector<PassTimes>& times = store_.at(point.key()).times;
    if (static_cast<int>(times.size()) >= options_.repeats) return true;
    double spent = 0;
    for (const PassTimes& t : times) spent += total(t);
    return times.size() >= 2 && spent > time_budget;
}

bool Runner::beyond_driver(const Group& group, const Point& point) const {
    return session_->context->capabilities().software && session_->volumetrics.settings.technique == "ray_march" &&
           static_cast<double>(session_->volumetrics.settings.march.steps) * group.facts.lamps_in_view >
               loop_limit &&
           point.edit.lamps < 0;
}

void Runner::open(const Group& group) {
    const Place& place = *group.points.front().place;
    if (session_->scene.path == data_root() / place.scene) return;
    editor_.reset();
    session_.reset();  // its context goes before the next one comes
    session_ = open_session(options_, place);
    editor_ = std::make_unique<SceneEditor>(session_->scene);
    warm_.clear();
}

View Runner::show(const Point& point) {
    session_->settings.reset_to_defaults();
    if (options_.reference == "march")
        for (const std::string& assignment : few_froxels()) session_->settings.set(assignment);
    for (const std::string& assignment : point.configuration.settings) session_->settings.set(assignment);
    if (!point.light_transmittance) session_->settings.set("light_transmittance", "false");
    session_->size = point.size;
    animate(session_->scene, point.place->time);
    const View view = camera_view(session_->scene, point.place->camera,
                                  static_cast<float>(point.size.x) / static_cast<float>(point.size.y));
    editor_->apply(session_->scene, view, point.edit);
    return view;
}

void Runner::run_group(const Group& group) {
    open(group);
    std::vector<const Point*> active;
    for (const Point& point : group.points) {
        const double planned = frames_left(point) * cost(group, point);
        show(point);
        if (beyond_driver(group, point)) {
            ticker_.drop(planned);
            continue;
        }
        measure(point, active.empty() || point.configuration.history_frames > 0);
        active.push_back(&point);
        ticker_.tick(planned - frames_left(point) * cost(group, point));
        const auto error = [&](const Point& p) { return store_.at(p.key()).errors->scattering; };
        if (group.stop_below_first && active.size() > 1 && error(point) < error(group.points.front())) break;
    }
    while (suite_.times) {
        bool all_done = true;
        for (const Point* point : active) {
            if (timed_enough(*point)) continue;
            const double planned = frames_left(*point) * cost(group, *point);
            time_turn(*point);
            ticker_.tick(planned - frames_left(*point) * cost(group, *point));
            all_done = false;
        }
        if (all_done) break;
    }
}

/// Errors, motion and work counts, as far as they are not known.
void Runner::measure(const Point& point, bool motion) {
    const std::string key = point.key();
    const bool errors = suite_.errors && !store_.at(key).errors;
    motion = motion && suite_.errors && suite_.display && !store_.at(key).motion;
    const bool work = suite_.times && !store_.at(key).work;
    if (!errors && !motion && !work) return;
    View view = show(point);
    if (errors && truth_subject_ != point.subject()) {
        truth_ = truths_.get(*session_, view, point);
        truth_subject_ = point.subject();
        view = show(point);
    }
    if (errors) {
        const Comparison found = measure_errors(*session_, view, point, truth_, suite_.display);
        write_pictures(options_.out, picture_names(key, point.subject()), found.scattering, truth_.scattering,
                       found.same);
        store_.add_errors(key, found.errors);
        warm_.insert(key);
    }
    if (motion) store_.add_motion(key, measure_motion(*session_, view, point));
    if (work) store_.add_work(key, measure_work(*session_, view, point));
}

/// First one frame (two with a history) that nobody times: others drew before.
void Runner::time_turn(const Point& point) {
    const View view = show(point);
    const std::vector<PassTimes>& known = store_.at(point.key()).times;
    int settle = !known.empty() && total(known.back()) > slow_frame ? 0 : 1;
    if (warm_.insert(point.key()).second) settle = 3;
    // What a history holds changes no cost, but the first frame makes it.
    if (point.configuration.history_frames > 0) settle = std::max(settle, 2);
    for (int i = 0; i < settle; ++i) session_->draw(view, point.place->time);
    session_->timer->set_mode(session_->timer_mode());
    session_->draw(view, point.place->time);
    PassTimes times;
    for (const gl::GpuTimer::Scope& scope : session_->timer->wait()) times.emplace_back(scope.name, scope.gpu_ms);
    store_.add_time(point.key(), times);
    session_->timer->set_mode(gl::TimerMode::off);
}

}  // namespace tyndall::bench
