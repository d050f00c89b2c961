#include "engine/gl/query.h"

#include <array>
#include <chrono>

#include "engine/core/check.h"
#include "engine/gl/debug_scope.h"

namespace tyndall::gl {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t frames_in_flight = 4;

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

struct QueryTraits {
    static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};
using Query = Handle<QueryTraits>;

Query make_timestamp() {
    GLuint id = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &id);
    label(GL_QUERY, id, "pass timer");
    return Query(id);
}

GLuint64 timestamp(const Query& query) {
    GLuint64 value = 0;
    glGetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &value);
    return value;
}

}  // namespace

/// The scopes of one frame. Query objects outlive their scopes and are used again when the ring comes round.
struct GpuTimer::Frame {
    std::vector<Scope> scopes;
    std::vector<std::array<Query, 2>> queries;
    TimerMode mode = TimerMode::off;
    bool open = false;  ///< between begin and end
    Clock::time_point began;

    [[nodiscard]] bool arrived() const {
        if (mode != TimerMode::query) return true;
        GLint available = GL_FALSE;
        glGetQueryObjectiv(queries[scopes.size() - 1][1].id(), GL_QUERY_RESULT_AVAILABLE, &available);
        return available != GL_FALSE;
    }
    void resolve() {
        if (mode != TimerMode::query) return;
        for (std::size_t i = 0; i < scopes.size(); ++i)
            scopes[i].gpu_ms = static_cast<double>(timestamp(queries[i][1]) - timestamp(queries[i][0])) * 1e-6;
    }
};

GpuTimer::GpuTimer(TimerMode mode) : mode_(mode), frames_(frames_in_flight) {}
GpuTimer::~GpuTimer() = default;

void GpuTimer::begin_frame() {
    TYNDALL_CHECK(!frames_[current_].open);
    if (mode_ == TimerMode::off) results_.clear();
    current_ = (current_ + 1) % frames_.size();
    for (std::size_t age = 0; age < frames_.size(); ++age) {  // oldest first
        Frame& frame = frames_[(current_ + age) % frames_.size()];
        if (frame.scopes.empty() || !frame.arrived()) continue;
        frame.resolve();
        results_ = std::exchange(frame.scopes, {});
    }
    // Results that took longer than the whole ring are given up: waiting for them would stall.
    frames_[current_].scopes.clear();
    frames_[current_].mode = mode_;
}

const std::vector<GpuTimer::Scope>& GpuTimer::wait() {
    Frame& frame = frames_[current_];
    TYNDALL_CHECK(!frame.open);
    frame.resolve();
    return results_ = std::exchange(frame.scopes, {});
}

void GpuTimer::begin(const std::string& name) {
    Frame& frame = frames_[current_];
    if (frame.mode == TimerMode::off) return;
    TYNDALL_CHECK(!frame.open);
    frame.open = true;
    frame.scopes.push_back({name});
    if (frame.mode == TimerMode::finish) {
        glFinish();
    } else {
        const std::size_t i = frame.scopes.size() - 1;
        if (frame.queries.size() == i) frame.queries.push_back({make_timestamp(), make_timestamp()});
        glQueryCounter(frame.queries[i][0].id(), GL_TIMESTAMP);
    }
    frame.began = Clock::now();
}

void GpuTimer::end() {
    Frame& frame = frames_[current_];
    if (frame.mode == TimerMode::off) return;
    TYNDALL_CHECK(frame.open);
    frame.open = false;
    Scope& scope = frame.scopes.back();
    scope.cpu_ms = milliseconds(Clock::now() - frame.began);
    if (frame.mode == TimerMode::finish) {
        glFinish();
        scope.gpu_ms = milliseconds(Clock::now() - frame.began);
    } else {
        glQueryCounter(frame.queries[frame.scopes.size() - 1][1].id(), GL_TIMESTAMP);
    }
}

}  // namespace tyndall::gl
