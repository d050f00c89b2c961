#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace tyndall {

struct IsolationLimits {
    double seconds = 10;                         ///< by the clock on the wall, and of the processor
    std::size_t memory = std::size_t{1} << 30U;  ///< bytes beyond those that this process has
};

/// Work for libraries that trust what they read: a forked child does it and sends its result through a pipe.
/// Whatever happens to the child (a crash, an endless loop, memory without end) is an Error here. Only the calling
/// thread lives on in the child: `work` must use no thread of this process and no GL.
class IsolatedWork {
  public:
    using Send = std::function<void(const void* bytes, std::size_t size)>;

    explicit IsolatedWork(const std::function<void(const Send&)>& work, const IsolationLimits& limits = {});
    ~IsolatedWork();
    IsolatedWork(const IsolatedWork&) = delete;
    IsolatedWork& operator=(const IsolatedWork&) = delete;

    /// The next bytes that were sent. Throws Error of one line with what `work` threw, or with what became of it.
    void receive(void* to, std::size_t size);
    template <class T>
    [[nodiscard]] T receive() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value;
        receive(&value, sizeof value);
        return value;
    }

  private:
    void read(void* to, std::size_t size);
    void next_frame();
    [[noreturn]] void fail_as_child_ended();

    IsolationLimits limits_;
    double deadline_ = 0;
    int child_ = -1, pipe_ = -1;
    std::vector<std::byte> frame_;
    std::size_t taken_ = 0;
};

}  // namespace tyndall
