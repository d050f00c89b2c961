#include "engine/core/output_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>

#include "engine/core/error.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, std::string_view reason) {
    throw Error(fmt::format("{}: cannot write: {}", path.string(), reason));
}

/// Where a path leads through links, whether or not a file is there.
fs::path target_of(const fs::path& path) {
    constexpr int most_links = 40;  // as Linux has it
    std::error_code error;
    fs::path target = path;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
        if (links == most_links) fail(path, "too many links");
        target = target.parent_path() / fs::read_symlink(target, error);
        if (error) fail(path, error.message());
    }
    return target;
}

/// The folder that a file lies in.
fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Partial files of this process; null where there is none. The handler reads it at any moment.
std::array<std::atomic<const char*>, 16> partials;
static_assert(std::atomic<const char*>::is_always_lock_free);

void remove_partials(int signal) {
    for (const auto& partial : partials)
        if (const char* path = partial.load()) ::unlink(path);
    ::raise(signal);  // again, by default: SA_RESETHAND
}

void handle_signals() {
    static std::once_flag once;
    std::call_once(once, [] {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            struct sigaction action {};
            if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
            action.sa_handler = remove_partials;
            action.sa_flags = static_cast<int>(SA_RESETHAND);
            ::sigaction(signal, &action, nullptr);
        }
    });
}

void remember(const char* partial) {
    handle_signals();
    for (auto& slot : partials)
        if (const char* none = nullptr; slot.compare_exchange_strong(none, partial)) return;
}

void forget(const char* partial) {
    for (auto& slot : partials)
        if (const char* found = partial; slot.compare_exchange_strong(found, nullptr)) return;
}

void write_all(const fs::path& path, const std::string& partial, const std::string& content) {
    using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
    File file(std::fopen(partial.c_str(), "wb"), std::fclose);
    if (!file) fail(path, std::strerror(errno));
    const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
    if (std::fclose(file.release()) != 0 || !written) fail(path, std::strerror(errno));
}

}  // namespace

OutputFiles::~OutputFiles() {
    for (const Staged& file : staged_) {
        ::unlink(file.partial.c_str());  // gone if it was renamed
        forget(file.partial.c_str());
    }
}

void OutputFiles::add(const fs::path& path, const std::string& content) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "it is not a regular file");
    const fs::path target = target_of(path);
    staged_.push_back(
        {path, target,
         (folder_of(target) / fmt::format(".{}.partial{}", target.filename().string(), ::getpid())).string()});
    const std::string& partial = staged_.back().partial;
    remember(partial.c_str());
    write_all(path, partial, content);
}

void OutputFiles::commit() {
    std::error_code error;
    for (const Staged& file : staged_) {
        fs::rename(file.partial, file.target, error);
        if (error) fail(file.path, error.message());
    }
}

void check_outputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
    const auto resolved = [](const fs::path& path) {
        std::error_code error;
        return fs::weakly_canonical(fs::absolute(target_of(path)), error);
    };
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto refuse_same = [&](const NamedFile& other) {
            if (resolved(outputs[i].path) == resolved(other.path))
                throw UsageError(fmt::format("{} {}: another file expected, this is that of {}", outputs[i].option,
                                             outputs[i].path.string(), other.option));
        };
        for (const NamedFile& other : outputs.first(i)) refuse_same(other);
        for (const NamedFile& input : inputs) refuse_same(input);
        const fs::path folder = folder_of(target_of(outputs[i].path));
        std::error_code error;
        const fs::file_status status = fs::status(outputs[i].path, error);
        if (fs::exists(status) && !fs::is_regular_file(status)) fail(outputs[i].path, "it is not a regular file");
        if (!fs::is_directory(folder, error)) fail(outputs[i].path, "No such file or directory");
        if (::access(folder.c_str(), W_OK) != 0) fail(outputs[i].path, std::strerror(errno));
    }
}

}  // namespace tyndall
