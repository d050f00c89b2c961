#include "bench/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>
#include <vector>

#include "engine/core/files.h"
#include "engine/scene/data_root.h"

namespace tyndall::bench {

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    std::string name = "unknown processor";
    for (std::string line; std::getline(info, line);) {
        if (!line.starts_with("model name")) continue;
        name = line.substr(std::min(line.size(), line.find(": ") + 2));
        break;
    }
    return fmt::format("{}, {} logical processors", name, std::thread::hardware_concurrency());
}

std::string date_today() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday);
}

std::string program_version() {
    static const std::string version = [] {
        Digest digest;
        digest.add_file("/proc/self/exe");
        std::vector<std::filesystem::path> shaders;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(data_root() / "shaders"))
            if (entry.is_regular_file()) shaders.push_back(entry.path());
        std::ranges::sort(shaders);
        for (const std::filesystem::path& shader : shaders) digest.add_file(shader);
        return std::string(TYNDALL_VERSION) + "-" + digest.hex().substr(0, 12);
    }();
    return version;
}

void Digest::add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ bytes[i]) * 0x100000001b3u;
}

void Digest::add_file(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_bytes(path);
    add(bytes.data(), bytes.size());
}

std::string Digest::hex() const {
    return fmt::format("{:016x}", state_);
}

}  // namespace tyndall::bench
