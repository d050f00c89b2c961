#include "engine/core/isolated.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>

#include "engine/core/error.h"

namespace tyndall {
namespace {

constexpr std::size_t frame_size = 1U << 16U;
constexpr std::uint32_t failure_bit = 1U << 31U;  ///< of a frame's length: the frame is a message

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// --- in the child
// -------------------------------------------------------------------------------------------------

void write_all(int pipe, const void* bytes, std::size_t size) {
    const char* next = static_cast<const char*>(bytes);
    while (size > 0) {
        const ssize_t written = ::write(pipe, next, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) ::_exit(1);
        next += written;
        size -= static_cast<std::size_t>(written);
    }
}

void write_frame(int pipe, std::uint32_t flags, const void* bytes, std::size_t size) {
    const std::uint32_t length = flags | static_cast<std::uint32_t>(size);
    write_all(pipe, &length, sizeof length);
    write_all(pipe, bytes, size);
}

void limit(__rlimit_resource resource, std::size_t most) {
    const rlimit both{most, most};
    ::setrlimit(resource, &both);
}

// The address sanitizer reserves terabytes of addresses for itself, and takes more whenever it likes: under it only
// time is limited.
void limit_memory([[maybe_unused]] std::size_t more) {
#if !defined(TYNDALL_SANITIZED)
    std::size_t pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%zu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    if (pages > 0) limit(RLIMIT_AS, pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + more);
#endif
}

/// Leaves nothing of this process that a child of it must not use, and ends with its parent.
void become_child(const IsolationLimits& limits) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU})
        std::signal(signal, SIG_DFL);
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<std::size_t>(std::ceil(limits.seconds)));
    limit_memory(limits.memory);
}

[[noreturn]] void run_in_child(int pipe, const std::function<void(const IsolatedWork::Send&)>& work,
                               const IsolationLimits& limits) {
    std::string failure;
    try {
        become_child(limits);
        std::vector<char> waiting;
        waiting.reserve(frame_size);
        const auto flush = [&] {
            if (!waiting.empty()) write_frame(pipe, 0, waiting.data(), waiting.size());
            waiting.clear();
        };
        work([&](const void* bytes, std::size_t size) {
            const char* next = static_cast<const char*>(bytes);
            while (size > 0) {
                const std::size_t part = std::min(size, frame_size - waiting.size());
                waiting.insert(waiting.end(), next, next + part);
                next += part;
                size -= part;
                if (waiting.size() == frame_size) flush();
            }
        });
        flush();
        ::_exit(0);
    } catch (const std::bad_alloc&) {
        failure = fmt::format("it needs more than {} MiB of memory to be read", limits.memory >> 20U);
    } catch (const std::exception& e) {
        failure = e.what();
    } catch (...) {
        failure = "it cannot be read";
    }
    failure.resize(std::min(failure.size(), frame_size));
    write_frame(pipe, failure_bit, failure.data(), failure.size());
    ::_exit(0);
}

// --- in the parent
// ------------------------------------------------------------------------------------------------

/// Printable, without line breaks, and short enough for a message.
std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
        if (!control || (!line.empty() && line.back() != ' ')) line += control ? ' ' : c;
    }
    while (line.ends_with(' ')) line.pop_back();
    constexpr std::size_t longest = 400;
    if (line.size() > longest) line = line.substr(0, longest - 3) + "...";
    return line.empty() ? "it cannot be read" : line;
}

}  // namespace

IsolatedWork::IsolatedWork(const std::function<void(const Send&)>& work, const IsolationLimits& limits)
    : limits_(limits), deadline_(now() + limits.seconds) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(fmt::format("no pipe: {}", std::strerror(errno)));
    child_ = ::fork();
    if (child_ == 0) {
        ::close(ends[0]);
        run_in_child(ends[1], work, limits);
    }
    const int error = errno;
    ::close(ends[1]);
    pipe_ = ends[0];
    if (child_ < 0) {
        ::close(pipe_);
        throw Error(fmt::format("no process to read it in: {}", std::strerror(error)));
    }
}

IsolatedWork::~IsolatedWork() {
    ::close(pipe_);
    if (child_ < 0) return;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void IsolatedWork::fail_as_child_ended() {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        throw Error(fmt::format("reading it was ended after {:g} s of the processor", limits_.seconds));
    if (WIFSIGNALED(status)) throw Error(fmt::format("damaged: its reader crashed (signal {})", WTERMSIG(status)));
    throw Error("damaged: its reader ended too early");
}

void IsolatedWork::read(void* to, std::size_t size) {
    char* next = static_cast<char*>(to);
    while (size > 0) {
        const double left = deadline_ - now();
        pollfd ready{pipe_, POLLIN, 0};
        const int count = left > 0 ? ::poll(&ready, 1, static_cast<int>(std::ceil(left * 1000))) : 0;
        if (count < 0 && errno == EINTR) continue;
        if (count == 0) throw Error(fmt::format("reading it takes more than {:g} s", limits_.seconds));
        const ssize_t got = ::read(pipe_, next, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) fail_as_child_ended();
        next += got;
        size -= static_cast<std::size_t>(got);
    }
}

void IsolatedWork::next_frame() {
    std::uint32_t length = 0;
    read(&length, sizeof length);
    const bool failed = (length & failure_bit) != 0;
    length &= ~failure_bit;
    if (length > frame_size) throw Error("damaged: its reader sent garbage");
    frame_.resize(length);
    taken_ = 0;
    read(frame_.data(), length);
    if (failed) throw Error(one_line({reinterpret_cast<const char*>(frame_.data()), frame_.size()}));
}

void IsolatedWork::receive(void* to, std::size_t size) {
    std::byte* next = static_cast<std::byte*>(to);
    while (size > 0) {
        if (taken_ == frame_.size()) next_frame();
        const std::size_t part = std::min(size, frame_.size() - taken_);
        std::memcpy(next, frame_.data() + taken_, part);
        taken_ += part;
        next += part;
        size -= part;
    }
}

}  // namespace tyndall
