#include "sample_game/flythrough.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/core/image.h"
#include "sample_game/statistics.h"
#include "session/progress.h"

namespace tyndall {
namespace {

/// The rows of the paper's frame breakdown and the passes they sum (by prefix).
const std::vector<std::pair<std::string, std::vector<std::string>>> breakdown{
    {"Volumetrics, total", {"volumetrics/"}}, {"Media injection", {"volumetrics/inject_media"}},
    {"Ray march", {"volumetrics/march"}},     {"Filter", {"volumetrics/filter"}},
    {"Composite", {"volumetrics/composite"}}, {"Whole frame", {""}}};

struct FrameTimes {
    double time = 0;
    std::string place;
    std::map<std::string, double> pass_ms;

    [[nodiscard]] double sum(const std::vector<std::string>& prefixes) const {
        double ms = 0;
        for (const auto& [pass, value] : pass_ms)
            for (const std::string& prefix : prefixes)
                if (pass.starts_with(prefix)) ms += value;
        return ms;
    }
};

/// The place whose time on the path is nearest.
std::string place_at(const Animation& path, double time) {
    const auto nearest = std::min_element(
        path.places.begin(), path.places.end(),
        [&](const auto& a, const auto& b) { return std::abs(a.time - time) < std::abs(b.time - time); });
    return nearest == path.places.end() ? std::string{} : nearest->name;
}

View path_view(Session& session, const Animation& path, double time) {
    animate_one(session.scene, path, time);
    return camera_view(session.scene, "flythrough",
                       static_cast<float>(session.size.x) / static_cast<float>(session.size.y));
}

std::string frames_csv(const std::vector<FrameTimes>& frames) {
    std::vector<std::string> passes;
    for (const FrameTimes& f : frames)
        for (const auto& [pass, ms] : f.pass_ms)
            if (std::find(passes.begin(), passes.end(), pass) == passes.end()) passes.push_back(pass);
    std::sort(passes.begin(), passes.end());
    std::string csv = fmt::format("frame,time_s,place,{}\n", fmt::join(passes, ","));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        csv += fmt::format("{},{:.4f},{}", i, frames[i].time, frames[i].place);
        for (const std::string& pass : passes) {
            const auto found = frames[i].pass_ms.find(pass);
            csv += found == frames[i].pass_ms.end() ? "," : fmt::format(",{:.4f}", found->second);
        }
        csv += "\n";
    }
    return csv;
}

void write_summary(const std::filesystem::path& out, const Session& session,
                   const std::vector<FrameTimes>& frames) {
    std::string csv = "part,frames,mean_ms,deviation_ms,variance_ms2\n";
    std::string md = fmt::format(
        "# Fly-through of {}\n\n{} frames of {}x{}, technique {}, {} steps. Driver: {}, {}. Times: {}.\n\n"
        "| part | frames | mean (ms) | standard deviation (ms) | variance (ms²) |\n|---|---|---|---|---|\n",
        session.scene.path.filename().string(), frames.size(), session.size.x, session.size.y,
        session.settings.get("technique"), session.settings.get("steps"), session.context->capabilities().renderer,
        session.context->capabilities().version,
        session.timer->mode() == gl::TimerMode::query ? "GPU timer queries"
                                                      : "wall clock from finish to finish (software driver)");
    for (const auto& [part, prefixes] : breakdown) {
        std::vector<double> values;
        for (const FrameTimes& f : frames) values.push_back(f.sum(prefixes));
        const Statistics s = statistics(values);
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f}\n", part == "Volumetrics, total" ? "Volumetrics" : part,
                           s.count, s.mean, s.deviation, s.variance);
        md +=
            fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", part, s.count, s.mean, s.deviation, s.variance);
    }
    md += "\n| place | volumetrics, mean (ms) |\n|---|---|\n";
    std::map<std::string, std::vector<double>> by_place;
    for (const FrameTimes& f : frames) by_place[f.place].push_back(f.sum({"volumetrics/"}));
    for (const auto& [place, values] : by_place)
        md += fmt::format("| {} | {:.2f} |\n", place, statistics(values).mean);
    write_text(out / "summary.csv", csv);
    write_text(out / "summary.md", md);
}

}  // namespace

void fly_through(Session& session, const FlythroughOptions& options) {
    const Animation* found = session.scene.find_animation("flythrough");
    if (found == nullptr || found->duration <= 0)
        throw Error(
            fmt::format("{}: no animation named flythrough, a camera path is needed", session.scene.path.string()));
    const Animation path = *found;
    std::error_code failure;
    std::filesystem::create_directories(options.out, failure);
    if (failure)
        throw Error(fmt::format("{}: cannot make the folder, {}", options.out.string(), failure.message()));

    const double duration =
        options.duration > 0 ? std::min<double>(options.duration, path.duration) : path.duration;
    const int count = std::max(1, static_cast<int>(std::floor(duration * options.frames_per_second)) + 1);

    // The first frames build shaders and shadow maps: drawn twice before anything is timed.
    for (int i = 0; i < 2; ++i) session.draw(path_view(session, path, 0), 0);

    session.timer->set_mode(session.timer_mode());
    std::vector<FrameTimes> frames;
    {
        Progress progress("frame", count);
        for (int i = 0; i < count; ++i, progress.step()) {
            FrameTimes frame;
            frame.time = i / options.frames_per_second;
            frame.place = place_at(path, frame.time);
            animate(session.scene, frame.time);
            session.draw(path_view(session, path, frame.time), frame.time);
            for (const gl::GpuTimer::Scope& scope : session.timer->wait()) frame.pass_ms[scope.name] = scope.gpu_ms;
            frames.push_back(std::move(frame));
        }
    }
    session.timer->set_mode(gl::TimerMode::off);
    for (const Animation::Place& place : path.places) {
        animate(session.scene, place.time);
        session.renderer->invalidate_history();  // the view jumps
        session.draw(path_view(session, path, place.time), place.time);
        write_image(options.out / (place.name + ".png"), session.renderer->read_display());
    }
    session.timer->set_mode(session.timer_mode());
    write_text(options.out / "frames.csv", frames_csv(frames));
    write_summary(options.out, session, frames);
}

}  // namespace tyndall
