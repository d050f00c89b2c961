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

const std::string volumetrics = "volumetrics/";

/// A row of the frame breakdown, and the prefixes of the passes that it sums.
struct Part {
    std::string name;
    std::vector<std::string> passes;
    [[nodiscard]] bool has(const std::string& pass) const {
        return std::ranges::any_of(passes, [&](const std::string& prefix) { return pass.starts_with(prefix); });
    }
};
/// A pass belongs to the first that has it.
const std::vector<Part> volumetric_parts{
    {"Media injection", {"volumetrics/inject_media"}},
    {"Ray march", {"volumetrics/march"}},
    {"Epipolar", {"volumetrics/epipolar"}},
    {"Froxels",
     {"volumetrics/froxel", "volumetrics/transparent_columns", "volumetrics/many_lamps", "volumetrics/lamp_cores"}},
    {"Filter", {"volumetrics/filter"}},
    {"Composite", {"volumetrics/composite"}},
    {"Other volumetrics", {volumetrics}}};
const std::vector<Part> frame_parts{{"Volumetrics", {volumetrics}},
                                    {"Shadows", {"shadow_"}},
                                    {"Surfaces", {"gbuffer", "lighting", "transparent"}},
                                    {"Everything else", {""}}};

struct FrameTimes {
    double time = 0;
    std::string place;
    std::map<std::string, double> pass_ms;

    /// Of the passes for which `wanted` holds.
    template <class Wanted>
    [[nodiscard]] double sum(Wanted wanted) const {
        double ms = 0;
        for (const auto& [pass, value] : pass_ms)
            if (wanted(pass)) ms += value;
        return ms;
    }
    [[nodiscard]] double of(const std::vector<Part>& parts, const Part& part) const {
        return sum([&](const std::string& pass) {
            const auto first = std::ranges::find_if(parts, [&](const Part& p) { return p.has(pass); });
            return first != parts.end() && first->name == part.name;
        });
    }
    [[nodiscard]] double total() const {
        return sum([](const std::string&) { return true; });
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

void draw_at(Session& session, const Animation& path, double time) {
    animate(session.scene, time);
    session.draw(path_view(session, path, time), time);
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
    const auto row = [&](const std::string& name, const std::string& title, auto value) {
        std::vector<double> values;
        for (const FrameTimes& f : frames) values.push_back(value(f));
        const Statistics s = statistics(values);
        csv += fmt::format("{},{},{:.4f},{:.4f},{:.4f}\n", name, s.count, s.mean, s.deviation, s.variance);
        md += fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", title, s.count, s.mean, s.deviation,
                          s.variance);
    };
    for (const Part& part : frame_parts) {
        row(part.name, part.name, [&](const FrameTimes& f) { return f.of(frame_parts, part); });
        if (part.passes.front() != volumetrics) continue;
        for (const Part& p : volumetric_parts)
            row(p.name, "– " + p.name, [&](const FrameTimes& f) { return f.of(volumetric_parts, p); });
    }
    row("Whole frame", "Whole frame: all passes", [](const FrameTimes& f) { return f.total(); });
    md += "\n| place | volumetrics, mean (ms) |\n|---|---|\n";
    std::map<std::string, std::vector<double>> by_place;
    for (const FrameTimes& f : frames) by_place[f.place].push_back(f.of(frame_parts, frame_parts.front()));
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

    std::vector<FrameTimes> frames;
    {
        Progress progress("frame", count, options.lines);
        auto place = path.places.begin();
        const auto next_still = [&] {
            session.timer->set_mode(gl::TimerMode::off);
            draw_at(session, path, place->time);
            const std::filesystem::path file = options.out / (place->name + ".png");
            write_image(file, session.renderer->read_display());
            progress.note(file.string());
            ++place;
        };
        // The first frames build shaders and shadow maps: there is something to see before anything is timed.
        if (place != path.places.end()) next_still();
        session.renderer->invalidate_history();  // the view jumps
        for (int i = 0; i < 2; ++i) draw_at(session, path, 0);
        progress.begin();
        for (int i = 0; i < count; ++i, progress.step()) {
            FrameTimes frame;
            frame.time = i / options.frames_per_second;
            while (place != path.places.end() && place->time <= frame.time) next_still();
            frame.place = place_at(path, frame.time);
            session.timer->set_mode(session.timer_mode());
            draw_at(session, path, frame.time);
            for (const gl::GpuTimer::Scope& scope : session.timer->wait()) frame.pass_ms[scope.name] = scope.gpu_ms;
            frames.push_back(std::move(frame));
        }
        while (place != path.places.end()) {
            session.renderer->invalidate_history();
            next_still();
        }
    }
    session.timer->set_mode(session.timer_mode());  // for the summary
    write_text(options.out / "frames.csv", frames_csv(frames));
    write_summary(options.out, session, frames);
}

}  // namespace tyndall
