#include "sample_game/stats_json.h"

#include <nlohmann/json.hpp>

#include "session/session.h"

namespace tyndall {

using nlohmann::json;

json stats_json(Session& session) {
    const Renderer& renderer = *session.renderer;
    const Capabilities& driver = session.context->capabilities();
    json passes = json::array();
    for (const PassList::PassInfo& info : renderer.passes().passes()) {
        json pass{{"name", info.name}, {"live", info.live}};
        if (!info.live) pass["reason"] = info.reason;
        passes.push_back(std::move(pass));
    }
    json times = json::object();
    for (const gl::GpuTimer::Scope& scope : session.timer->wait())
        times[scope.name] = {{"gpu_ms", scope.gpu_ms}, {"cpu_ms", scope.cpu_ms}};
    json work = json::object();
    if (session.options.count_work)
        for (const auto& [pass, counts] : renderer.work())
            for (int i = 0; i < static_cast<int>(gl::Work::count); ++i)
                work[pass][gl::to_string(static_cast<gl::Work>(i))] = counts[i];
    json stages = json::array();
    for (const StartupStage& stage : session.startup.stages())
        stages.push_back({{"stage", stage.name}, {"ms", stage.ms}});
    const FrameFacts& facts = renderer.facts();
    const Renderer::DrawCounts draws = renderer.draw_counts();
    return {{"driver", {{"vendor", driver.vendor}, {"renderer", driver.renderer}, {"version", driver.version}}},
            {"context", to_string(session.context->kind())},
            {"size", {session.size.x, session.size.y}},
            {"startup", {{"total_ms", session.startup.total_ms()}, {"stages", stages}}},
            {"timer", session.timer->mode() == gl::TimerMode::query ? "query" : "finish"},
            {"facts",
             {{"has_sun", facts.has_sun},
              {"has_global_medium", facts.has_global_medium},
              {"has_local_media", facts.has_local_media},
              {"local_lights_in_view", facts.local_lights_in_view}}},
            {"passes", passes},
            {"times_ms", times},
            {"work", work},
            {"draws",
             {{"instances", draws.instances}, {"triangles", draws.triangles}, {"draw_calls", draws.draw_calls}}},
            {"memory",
             {{"textures", renderer.texture_bytes()},
              {"volumetrics_persistent", session.volumetrics.persistent_bytes()}}},
            {"settings", session.settings.to_json()}};
}

}  // namespace tyndall
