#include "bench/store.h"

#include <fmt/format.h>

#include <limits>
#include <sstream>

#include "engine/core/error.h"
#include "engine/core/files.h"

namespace tyndall::bench {

using nlohmann::json;

namespace {

/// JSON has no infinity: null stands for an error that is not finite.
double number(const json& value) {
    return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

void check_conditions(const std::filesystem::path& path, const json& there, const json& here) {
    for (const auto& [key, value] : here.items())
        if (!there.contains(key) || there[key] != value)
            throw UsageError(fmt::format("{}: measured with {} {}, now {}; take another folder, or --no-resume",
                                         path.string(), key, there.value(key, json()).dump(), value.dump()));
}

}  // namespace

Store::Store(const std::filesystem::path& folder, const json& conditions, bool resume)
    : path_(folder / "measurements.jsonl") {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        throw Error(fmt::format("--out {}: cannot make the folder, {}", folder.string(), failure.message()));
    const std::filesystem::path conditions_path = folder / "bench.json";
    const bool known = std::filesystem::exists(conditions_path) && std::filesystem::exists(path_);
    if (known && resume) {
        check_conditions(conditions_path, read_json(conditions_path), conditions);
        load(path_);
    } else {
        write_text(conditions_path, conditions.dump(2) + "\n");
        write_text(path_, "");
    }
    log_.open(path_, std::ios::app);
    if (!log_) throw Error(fmt::format("{}: cannot be written", path_.string()));
}

/// Reads whole lines; a last one that was cut off by an interruption is dropped from the file too.
void Store::load(const std::filesystem::path& log) {
    const std::string text = read_text(log);
    const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
    std::istringstream lines(text.substr(0, whole));
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        try {
            apply(json::parse(line));
        } catch (const json::exception&) {
            throw Error(fmt::format("{}:{}: not a measurement; --no-resume begins anew", log.string(), number));
        }
    }
    if (whole != text.size()) write_text(log, text.substr(0, whole));
}

void Store::append(const json& record) {
    log_ << record.dump() << '\n' << std::flush;
    if (!log_) throw Error(fmt::format("{}: cannot be written", path_.string()));
    apply(record);
}

void Store::apply(const json& record) {
    Measured& m = measured_[record.at("key").get<std::string>()];
    if (record.contains("times")) m.times.push_back(record["times"].get<PassTimes>());
    if (record.contains("errors")) {
        const json& e = record["errors"];
        m.errors = Errors{number(e.at(0)), number(e.at(1)), number(e.at(2)), number(e.at(3)),
                          number(e.at(4)), number(e.at(5)), number(e.at(6)), number(e.at(7))};
    }
    if (record.contains("motion")) {
        const json& r = record["motion"];
        m.motion = Motion{number(r.at(0)), {number(r.at(1)), number(r.at(2)), number(r.at(3))}};
    }
    if (record.contains("frames")) {
        m.frames.clear();
        for (const json& f : record["frames"])
            m.frames.push_back({number(f.at(0)), number(f.at(1)), number(f.at(2))});
    }
    if (record.contains("work")) m.work = record["work"].get<gl::WorkCounts>();
}

const Measured& Store::at(const std::string& key) const {
    static const Measured none;
    const auto found = measured_.find(key);
    return found == measured_.end() ? none : found->second;
}

void Store::add_time(const std::string& key, const PassTimes& times) {
    append({{"key", key}, {"times", times}});
}
void Store::add_errors(const std::string& key, const Errors& e) {
    append({{"key", key},
            {"errors", {e.scattering, e.flip, e.transmittance, e.dim, e.masked, e.invalid, e.edge, e.rest}}});
}
void Store::add_motion(const std::string& key, const Motion& m) {
    append({{"key", key}, {"motion", {m.flicker, m.residual[0], m.residual[1], m.residual[2]}}});
}
void Store::add_work(const std::string& key, const gl::WorkCounts& work) {
    append({{"key", key}, {"work", work}});
}

void Store::add_frames(const std::string& key, const std::vector<FrameErrors>& frames) {
    json list = json::array();
    for (const FrameErrors& f : frames) list.push_back({f.error, f.dim, f.to_limit});
    append({{"key", key}, {"frames", list}});
}

}  // namespace tyndall::bench
