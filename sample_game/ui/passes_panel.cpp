#include "sample_game/ui/passes_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace tyndall {
namespace {

constexpr ImGuiTableFlags table_flags =
    ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_BordersInnerV;

void times_table(const Renderer& renderer) {
    if (!ImGui::BeginTable("times", 3, table_flags)) return;
    ImGui::TableSetupColumn("pass", 0, 3);
    ImGui::TableSetupColumn("GPU ms", 0, 1);
    ImGui::TableSetupColumn("CPU ms", 0, 1);
    ImGui::TableHeadersRow();
    double gpu = 0, cpu = 0;
    for (const gl::GpuTimer::Scope& scope : renderer.timings()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(scope.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", scope.gpu_ms);
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", scope.cpu_ms);
        gpu += scope.gpu_ms;
        cpu += scope.cpu_ms;
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted("sum");
    ImGui::TableNextColumn();
    ImGui::Text("%.3f", gpu);
    ImGui::TableNextColumn();
    ImGui::Text("%.3f", cpu);
    ImGui::EndTable();
}

/// Three digits and a prefix: 12.3 M.
std::string short_count(std::uint64_t n) {
    const auto value = static_cast<double>(n);
    if (n < 10'000) return fmt::format("{}", n);
    if (n < 1'000'000) return fmt::format("{:.1f} k", value * 1e-3);
    if (n < 1'000'000'000) return fmt::format("{:.1f} M", value * 1e-6);
    return fmt::format("{:.1f} G", value * 1e-9);
}

void work_table(const Renderer& renderer) {
    constexpr int kinds = static_cast<int>(gl::Work::count);
    ImGui::TextDisabled("samples of the medium, shadow lookups,\nevaluations of lights, texture fetches");
    if (!ImGui::BeginTable("work", kinds + 1, table_flags)) return;
    ImGui::TableSetupColumn("pass", 0, 1.7f);
    for (int i = 0; i < kinds; ++i) {
        const std::string kind = gl::to_string(static_cast<gl::Work>(i));
        ImGui::TableSetupColumn(kind.substr(0, kind.find('_')).c_str());
    }
    ImGui::TableHeadersRow();
    for (const auto& [pass, counts] : renderer.work()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(pass.substr(pass.rfind('/') + 1).c_str());
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", pass.c_str());
        for (const std::uint64_t n : counts) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(short_count(n).c_str());
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%llu", static_cast<unsigned long long>(n));
        }
    }
    ImGui::EndTable();
}

void pass_table(const PassList& passes) {
    if (!ImGui::BeginTable("passes", 2, table_flags)) return;
    ImGui::TableSetupColumn("pass", 0, 2);
    ImGui::TableSetupColumn("reads -> writes", 0, 3);
    ImGui::TableHeadersRow();
    for (const PassList::PassInfo& info : passes.passes()) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (info.live)
            ImGui::TextUnformatted(info.name.c_str());
        else
            ImGui::TextDisabled("%s", info.name.c_str());
        ImGui::TableNextColumn();
        if (info.live) {
            std::string flow;
            for (const std::string& r : info.reads) flow += r + " ";
            flow += "->";
            for (const std::string& w : info.writes) flow += " " + w;
            ImGui::TextWrapped("%s", flow.c_str());
        } else {
            ImGui::PushTextWrapPos(0);
            ImGui::TextDisabled("not run: %s", info.reason.c_str());
            ImGui::PopTextWrapPos();
        }
    }
    ImGui::EndTable();
}

}  // namespace

double pass_milliseconds(const Renderer& renderer, const std::string& prefix) {
    double ms = 0;
    for (const gl::GpuTimer::Scope& scope : renderer.timings())
        if (scope.name.starts_with(prefix)) ms += scope.gpu_ms;
    return ms;
}

void passes_panel(Session& session) {
    const Renderer& renderer = *session.renderer;
    if (ImGui::CollapsingHeader("Times", ImGuiTreeNodeFlags_DefaultOpen)) {
        ImGui::TextDisabled(session.timer->mode() == gl::TimerMode::query ? "GPU timer queries"
                                                                          : "wall clock, finish to finish");
        times_table(renderer);
    }
    if (ImGui::CollapsingHeader("Work")) {
        // Counting switches to instrumented shaders, so it starts with the frame after the box is ticked.
        const bool counted = session.options.count_work;
        ImGui::Checkbox("count (slower)", &session.options.count_work);
        if (counted && session.options.count_work) work_table(renderer);
    }
    if (ImGui::CollapsingHeader("Pass list", ImGuiTreeNodeFlags_DefaultOpen)) {
        const Renderer::DrawCounts draws = renderer.draw_counts();
        ImGui::TextWrapped("%zu triangles, %zu instances, %zu draw calls, %.1f MiB of render targets",
                           draws.triangles, draws.instances, draws.draw_calls,
                           static_cast<double>(renderer.texture_bytes()) / (1 << 20));
        pass_table(renderer.passes());
    }
}

}  // namespace tyndall
