#include "engine/shader/shader_library.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <regex>
#include <sstream>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/shader/build_time.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A file that is not there (an editor may be replacing it) has a time of its own: its return is a change.
fs::file_time_type time_of(const fs::path& path) {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(path, error);
    return error ? fs::file_time_type::min() : time;
}

std::string key_of(const ProgramDesc& desc, const Permutation& permutation) {
    std::string key = desc.name;
    for (const auto& [define, value] : permutation) key += fmt::format(" {}={}", define, value);
    return key;
}

void check_permutation(const ProgramDesc& desc, const Permutation& permutation) {
    const auto require = [&](bool ok, const char* expected) {
        if (!ok) detail::check_failed(expected, key_of(desc, permutation), __FILE__, __LINE__);
    };
    require(permutation.size() == desc.axes.size(), "a permutation gives one value for each axis");
    for (const PermutationAxis& axis : desc.axes) {
        const auto found = permutation.find(axis.define);
        require(found != permutation.end() && std::ranges::count(axis.values, found->second) > 0,
                "a permutation gives each axis one of its declared values");
    }
    require(!desc.valid || desc.valid(permutation), "a permutation is one that the program's desc calls valid");
}

// Mesa often reports source-string number 0, whatever #line said; so the number of the file goes into the line
// number, too: line 37 of file 2 is 30037.
constexpr unsigned long lines_per_file = 10000;

std::string line_directive(const std::string& directive) {
    unsigned long line = 0, file = 0;
    TYNDALL_CHECK(std::sscanf(directive.c_str(), "#line %lu %lu", &line, &file) == 2);
    return fmt::format("#line {} {}", (file + 1) * lines_per_file + line, file);
}

/// `#extension` must stand before anything else: those lines move up, and leave an empty line behind.
std::string complete_source(const std::string& resolved, const Permutation& permutation) {
    std::string head = "#version 450 core\n", body, line;
    std::istringstream lines(resolved);
    while (std::getline(lines, line)) {
        const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
        if (line.compare(start, 10, "#extension") == 0)
            head += std::exchange(line, "") + '\n';
        else if (line.starts_with("#line "))
            line = line_directive(line);
        body += line + '\n';
    }
    head += "#define TYNDALL_GLSL 1\n";
    for (const auto& [define, value] : permutation) head += fmt::format("#define {} {}\n", define, value);
    return head + body;
}

/// Turns "0:30037(12): error" (Mesa), "2(30037) : error" (NVIDIA) and "ERROR: 2:30037:" (AMD, Intel) into
/// "path:37: error".
std::string with_file_names(const std::string& log, const std::vector<fs::path>& files, const Roots& roots) {
    static const std::regex place(R"(^(?:ERROR: |WARNING: )?\d+[:(](\d{1,9})\)?(?:\(\d+\))?\s*:\s*(.*)$)");
    std::istringstream lines(log);
    std::string result, line;
    while (std::getline(lines, line)) {
        std::smatch match;
        if (std::regex_match(line, match, place)) {
            const unsigned long number = std::stoul(match[1]), file = number / lines_per_file;
            if (file >= 1 && file <= files.size())
                line = fmt::format("{}:{}: {}", roots.name_of(files[file - 1]), number % lines_per_file,
                                   match[2].str());
        }
        result += (result.empty() ? "" : "\n") + line;
    }
    return result;
}

/// An error is one line: the summary and the first message that is an error. The whole log goes to the logger.
std::string one_line(const std::string& message) {
    std::istringstream lines(message);
    std::string summary, first, line;
    std::getline(lines, summary);
    while (std::getline(lines, line)) {
        if (first.empty() || (line.find("error") != std::string::npos && first.find("error") == std::string::npos))
            first = line;
    }
    if (first.empty()) return summary;
    spdlog::debug("{}", message);
    return summary + ": " + first;
}

double build_seconds = 0;

/// Adds its own lifetime.
struct BuildTimer {
    double begin = seconds_now();
    ~BuildTimer() { build_seconds += seconds_now() - begin; }
};

}  // namespace

double seconds_building_shaders() {
    return build_seconds;
}

struct ShaderLibrary::Entry {
    const ProgramDesc& desc;
    Permutation permutation;
    gl::Program program;
    std::map<fs::path, fs::file_time_type> files;  ///< every file the program was made from
    std::string error;                             ///< of the last rebuild, empty when it worked

    [[nodiscard]] bool changed() const {
        return std::ranges::any_of(files, [](const auto& file) { return time_of(file.first) != file.second; });
    }

    void build(const Roots& roots) {
        const BuildTimer timer;
        std::vector<fs::path> read;
        const auto watch = [&] {
            for (const fs::path& path : read) files[path] = time_of(path);
        };
        std::vector<gl::ShaderSource> sources;
        try {
            for (const ProgramDesc::Stage& stage : desc.stages)
                sources.push_back(
                    {stage.stage, complete_source(resolve_includes(roots, stage.path, &read), permutation)});
        } catch (const Error&) {
            watch();  // the file that is missing, too
            throw;
        }
        watch();
        try {
            program = gl::Program(sources, key_of(desc, permutation));
        } catch (const Error& failure) {
            throw Error(one_line(with_file_names(failure.what(), read, roots)));
        }
    }
};

ShaderLibrary::ShaderLibrary(Roots roots) : roots_(std::move(roots)) {}
ShaderLibrary::~ShaderLibrary() = default;
std::size_t ShaderLibrary::program_count() const {
    return entries_.size();
}

const gl::Program& ShaderLibrary::get(const ProgramDesc& desc, const Permutation& permutation) {
    const std::string key = key_of(desc, permutation);
    if (const auto found = entries_.find(key); found != entries_.end()) {
        TYNDALL_CHECK(&found->second->desc == &desc);  // two descs of one name
        return found->second->program;
    }
    check_permutation(desc, permutation);
    auto entry = std::unique_ptr<Entry>(new Entry{desc, permutation, {}, {}, {}});
    entry->build(roots_);
    return entries_.emplace(key, std::move(entry)).first->second->program;
}

int ShaderLibrary::reload_changed() {
    constexpr double interval = 0.5;
    const double now = seconds_now();
    if (now - last_look_ < interval) return 0;
    last_look_ = now;

    int rebuilt = 0;
    for (const auto& [key, entry] : entries_) {
        if (!entry->changed()) continue;
        try {
            entry->build(roots_);
            entry->error.clear();
            ++rebuilt;
        } catch (const Error& failure) {
            entry->error = failure.what();
        }
    }
    errors_.clear();
    for (const auto& [key, entry] : entries_)
        if (!entry->error.empty()) errors_.push_back(entry->error);
    return rebuilt;
}

}  // namespace tyndall
