#include "bench/sequence_runner.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <set>

#include "bench/conditions.h"
#include "bench/errors.h"
#include "bench/runner.h"
#include "bench/sequence_reports.h"
#include "engine/core/files.h"
#include "engine/core/image_metrics.h"
#include "engine/scene/data_root.h"

namespace tyndall::bench {
namespace {

constexpr int limit_frames = 128;

class SequenceRunner {
  public:
    SequenceRunner(const BenchOptions& options, const SequenceSuite& suite, Store& store,
                   std::unique_ptr<Session>& session)
        : options_(options),
          suite_(suite),
          store_(store),
          session_(session),
          truths_(options.references.value_or(options.out / "references"), truth_kind(options.reference)) {}

    void run(const std::function<void()>& place_done) {
        Ticker ticker;
        const auto missing = [&](const Sequence& s) { return store_.at(s.key()).frames.empty(); };
        for (const Sequence& s : suite_.sequences)
            if (missing(s)) ticker.plan(static_cast<double>(s.poses.size()));
        const Place* last = nullptr;
        for (const Sequence& s : suite_.sequences) {
            if (last != nullptr && last != s.place) place_done();
            last = s.place;
            if (!missing(s)) continue;
            open(*s.place);
            ticker.group(s.key(), static_cast<int>(&s - suite_.sequences.data()) + 1,
                         static_cast<int>(suite_.sequences.size()));
            measure(s);
            ticker.tick(static_cast<double>(s.poses.size()));
        }
        place_done();
    }

  private:
    void open(const Place& place) {
        if (place_ == &place) return;
        if (session_->scene.path != data_root() / place.scene) {
            session_.reset();
            session_ = open_session(options_, place);
        }
        place_ = &place;
        truth_.clear();
        limit_ = {};
    }

    void begin(const std::vector<std::string>& settings, glm::ivec2 size) {
        session_->settings.reset_to_defaults();
        for (const std::string& assignment : few_froxels()) session_->settings.set(assignment);
        for (const std::string& assignment : settings) session_->settings.set(assignment);
        session_->size = size;
        session_->options.frame_index = 0;
        session_->renderer->invalidate_history();
    }

    /// Before the frames, as it draws others.
    void make_truths(const Sequence& s) {
        for (const Pose& p : s.poses) {
            if (truth_.contains(p.name())) continue;
            Point point;
            point.place = s.place;
            point.size = s.size;
            point.pose = p;
            truth_[p.name()] = truths_.get(*session_, pose(session_->scene, *s.place, s.size, p), point).scattering;
        }
        if (!limit_.pixels.empty()) return;
        std::vector<std::string> settings = suite_.limit;
        settings.insert(settings.end(),
                        {"noise=bayer", "noise_size=16", "noise_time=golden_ratio", "filter=none", "temporal=off"});
        begin(settings, s.size);
        const View view = pose(session_->scene, *s.place, s.size, {});
        limit_ = mean_of_frames(*session_, view, s.place->time, {"scattering"}, limit_frames).front();
        // Against itself and the truth: what no number of frames takes away.
        store_.add_frames(limit_key(s),
                          {{relative_rmse(limit_, truth_[""]), dim_relative_rmse(limit_, truth_[""], 0.98), 0}});
    }

    void measure(const Sequence& s) {
        make_truths(s);
        begin(s.settings, s.size);
        std::vector<FrameErrors> frames;
        for (const Pose& p : s.poses) {
            const View view = pose(session_->scene, *s.place, s.size, p);
            const Image drawn = draw_layers(*session_, view, s.place->time, {"scattering"}).front();
            const Image& truth = truth_.at(p.name());
            frames.push_back({relative_rmse(drawn, truth), dim_relative_rmse(drawn, truth, 0.98),
                              p == Pose{} && !limit_.pixels.empty() ? relative_rmse(drawn, limit_) : 0});
        }
        store_.add_frames(s.key(), frames);
    }

    const BenchOptions& options_;
    const SequenceSuite& suite_;
    Store& store_;
    std::unique_ptr<Session>& session_;
    GroundTruths truths_;
    const Place* place_ = nullptr;
    std::map<std::string, Image> truth_;  ///< scattering, by the pose's name
    Image limit_;
};

void write_reports(const BenchOptions& options, const SequenceSuite& suite, const Store& store,
                   const nlohmann::json& conditions) {
    const std::map<std::string, std::string> plots = sequence_plots(suite, store, machine_text(conditions));
    std::filesystem::create_directories(options.out / "plots");
    for (const auto& [name, svg] : plots) write_text(options.out / "plots" / (name + ".svg"), svg);
    write_text(options.out / "results.csv", sequence_csv(suite, store));
    write_text(options.out / "summary.md", report_head(suite.title, told(conditions, options)) +
                                               ground_truth_row(conditions) +
                                               sequence_summary(suite, store, plots));
}

}  // namespace

void run_sequences(const BenchOptions& options) {
    DrawOptions size;
    size.size = options.size;
    const SequenceSuite suite =
        make_sequence_suite({options.suite, size.pixels(), options.places, options.reference == "gpu"});
    std::set<std::string> scenes;
    for (const Sequence& s : suite.sequences) scenes.insert(s.place->scene);
    std::unique_ptr<Session> session = open_session(options, *suite.sequences.front().place);
    const nlohmann::json conditions = conditions_of(options, scenes, *session);
    Store store(options.out, conditions, options.resume);
    SequenceRunner(options, suite, store, session).run([&] { write_reports(options, suite, store, conditions); });
    fmt::print("{}\n", (options.out / "summary.md").string());
}

}  // namespace tyndall::bench
