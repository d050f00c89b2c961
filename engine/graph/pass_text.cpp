#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/graph/pass_list.h"

namespace tyndall {
namespace {

std::string list_of(const std::vector<std::string>& names) {
    return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

std::string barrier_names(GLbitfield bits) {
    constexpr std::pair<GLbitfield, const char*> names[] = {
        {GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT, "vertex_attrib_array"},
        {GL_ELEMENT_ARRAY_BARRIER_BIT, "element_array"},
        {GL_UNIFORM_BARRIER_BIT, "uniform"},
        {GL_TEXTURE_FETCH_BARRIER_BIT, "texture_fetch"},
        {GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, "shader_image_access"},
        {GL_COMMAND_BARRIER_BIT, "command"},
        {GL_PIXEL_BUFFER_BARRIER_BIT, "pixel_buffer"},
        {GL_TEXTURE_UPDATE_BARRIER_BIT, "texture_update"},
        {GL_BUFFER_UPDATE_BARRIER_BIT, "buffer_update"},
        {GL_FRAMEBUFFER_BARRIER_BIT, "framebuffer"},
        {GL_SHADER_STORAGE_BARRIER_BIT, "shader_storage"},
    };
    std::vector<std::string> set;
    for (const auto& [bit, name] : names)
        if ((bits & bit) != 0) set.emplace_back(name);
    return fmt::format("{}", fmt::join(set, "|"));
}

/// Rows of cells as aligned columns; the last column ends the line unpadded.
std::string aligned(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (widths.size() <= c) widths.push_back(0);
            widths[c] = std::max(widths[c], row[c].size());
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t c = 0; c < row.size(); ++c) line += fmt::format("{:<{}}  ", row[c], widths[c]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + '\n';
    }
    return text;
}

/// In a double-quoted Graphviz string.
std::string quoted(const std::string& name) {
    std::string text = "\"";
    for (char c : name) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text + '"';
}

}  // namespace

std::string PassList::to_text() const {
    std::vector<const Pass*> added(infos_.size());
    for (const Pass& pass : passes_) added[pass.info] = &pass;

    std::vector<std::vector<std::string>> rows;
    for (std::size_t i = 0; i < infos_.size(); ++i) {
        const PassInfo& info = infos_[i];
        std::string note = info.reason;
        if (info.barrier != 0) note = "after barrier " + barrier_names(info.barrier);
        const char* state = info.live ? "live" : (added[i] != nullptr ? "culled" : "skipped");
        rows.push_back({info.name, state, list_of(info.reads) + " -> " + list_of(info.writes), note});
        if (added[i] == nullptr) rows.back()[2] = "";
    }
    std::string text = "passes\n" + aligned(rows);

    rows.clear();
    for (const TextureInfo& t : textures()) {
        std::string lifetime = "not used";
        if (t.live)
            lifetime = fmt::format("{} .. {}", infos_[static_cast<std::size_t>(t.first_pass)].name,
                                   infos_[static_cast<std::size_t>(t.last_pass)].name);
        rows.push_back({t.name, fmt::format("{}x{}x{}", t.desc.size.x, t.desc.size.y, t.desc.size.z),
                        fmt::format("{:.2f} MiB", static_cast<double>(gl::byte_size(t.desc)) / (1 << 20)),
                        !t.transient ? "imported" : (t.slot >= 0 ? fmt::format("slot {}", t.slot) : "no slot"),
                        lifetime});
    }
    return text + "textures\n" + aligned(rows);
}

std::string PassList::to_dot() const {
    std::string text = "digraph passes {\n  rankdir=LR;\n";
    std::vector<int> version(resources_.size());
    const auto node = [&](std::uint32_t r) {
        return quoted(fmt::format("{} v{}", resources_[r].name, version[r]));
    };
    for (const Pass& pass : passes_) {
        const PassInfo& info = infos_[pass.info];
        const std::string box = quoted("pass " + std::to_string(pass.info) + ": " + info.name);
        text += fmt::format("  {} [shape=box, style={}];\n", box, info.live ? "solid" : "dashed");
        for (const Use& use : pass.uses) {
            if (use.reads) text += fmt::format("  {} -> {};\n", node(use.resource), box);
            if (use.writes) {
                ++version[use.resource];
                text += fmt::format("  {} -> {};\n", box, node(use.resource));
            }
        }
    }
    for (std::size_t r = 0; r < resources_.size(); ++r)
        if (resources_[r].exported)
            text += fmt::format("  {} [style=bold];\n", node(static_cast<std::uint32_t>(r)));
    return text + "}\n";
}

}  // namespace tyndall
