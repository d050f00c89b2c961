#include "bench/html_report.h"

#include <fmt/format.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/files.h"
#include "engine/scene/data_root.h"

namespace tyndall::bench {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* chart_library = "/usr/share/javascript/chart.js/chart.min.js";

std::string data_uri(const fs::path& path) {
    using namespace boost::archive::iterators;
    using Base64 = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
    const std::string bytes = read_text(path);
    return "data:image/jpeg;base64," + std::string(Base64(bytes.begin()), Base64(bytes.end())) +
           std::string((3 - bytes.size() % 3) % 3, '=');
}

/// Results of one folder; its pictures go into `pictures`, by name, each once.
json read_run(const fs::path& folder, json& pictures) {
    const fs::path path = folder / "results.json";
    try {
        json run = json::parse(read_text(path));
        (void)run.at("title").get<std::string>();
        (void)run.at("conditions").at("driver");
        (void)run.at("families").items();
        for (const json& row : run.at("rows").get<std::vector<json>>())
            for (const char* kind : {"picture", "error_picture", "truth_picture"}) {
                if (!row.contains(kind)) continue;
                const auto name = row.at(kind).get<std::string>();
                if (!pictures.contains(name)) pictures[name] = data_uri(folder / name);
            }
        return run;
    } catch (const json::exception& e) {
        throw Error(
            fmt::format("{}: results of a suite of points expected (tyndall bench): {}", path.string(), e.what()));
    }
}

void put(std::string& page, const std::string& mark, const std::string& text) {
    page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string html_report(const std::vector<fs::path>& folders) {
    if (!fs::exists(chart_library))
        throw Error(fmt::format("{}: not found; Debian's package libjs-chart.js has it", chart_library));
    json data{{"runs", json::array()}, {"pictures", json::object()}};
    for (const fs::path& folder : folders) data["runs"].push_back(read_run(folder, data["pictures"]));
    std::string text = data.dump();
    for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.insert(at + 1, "\\");
    const fs::path parts = data_root() / "assets/report";
    std::string page = read_text(parts / "page.html");
    put(page, "/* page.css */", read_text(parts / "page.css"));
    put(page, "/* chart.js */", read_text(chart_library));
    put(page, "/* results */", text);
    put(page, "/* page.js */", read_text(parts / "page.js"));
    return page;
}

}  // namespace tyndall::bench
