#include "engine/core/isolated.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <numeric>

#include "engine/core/error.h"

namespace tyndall {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Send = IsolatedWork::Send;

void expect_error(const std::function<void(const Send&)>& work, const std::string& because,
                  const IsolationLimits& limits = {}) {
    EXPECT_THAT([&] { (void)IsolatedWork(work, limits).receive<char>(); },
                ThrowsMessage<Error>(HasSubstr(because)));
}

TEST(IsolatedWork, SendsMoreThanAPipeHolds) {
    std::vector<int> numbers(1'000'000);
    std::iota(numbers.begin(), numbers.end(), 0);
    IsolatedWork work([&](const Send& send) { send(numbers.data(), numbers.size() * sizeof(int)); });
    std::vector<int> received(numbers.size());
    work.receive(received.data(), 4);
    work.receive(received.data() + 1, (received.size() - 1) * sizeof(int));
    EXPECT_EQ(received, numbers);
}

TEST(IsolatedWork, WhatBecameOfItIsAnError) {
    expect_error([](const Send&) { throw std::runtime_error("no\nluck\n"); }, "no luck");
    expect_error([](const Send&) { throw 3; }, "cannot be read");
    expect_error([](const Send&) {}, "ended too early");
    expect_error([](const Send&) { std::raise(SIGSEGV); }, "crashed (signal 11)");
    expect_error([](const Send&) { std::abort(); }, "crashed (signal 6)");
    expect_error([](const Send&) { ::_exit(0); }, "ended too early");
}

TEST(IsolatedWork, TimeIsLimited) {
    const auto began = std::chrono::steady_clock::now();
    expect_error([](const Send&) { ::sleep(60); }, "takes more than 0.3 s", {.seconds = 0.3});
    expect_error(
        [](const Send&) {
            for (std::atomic<int> i = 0;; ++i) {
            }
        },
        "takes more than 0.3 s", {.seconds = 0.3});
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
}

#if !defined(TYNDALL_SANITIZED)
TEST(IsolatedWork, MemoryIsLimited) {
    const auto eat = [](const Send& send) {
        std::vector<std::vector<char>> eaten;
        for (int i = 0; i < 4096; ++i) eaten.emplace_back(1U << 20U, 'x');
        send("y", 1);
    };
    expect_error(eat, "more than 64 MiB of memory", {.memory = std::size_t{64} << 20U});
}
#endif

TEST(IsolatedWork, NobodyWaitsForAChildThatIsNotNeeded) {
    const auto began = std::chrono::steady_clock::now();
    {
        IsolatedWork work([](const Send&) { ::sleep(60); });
    }
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
}

}  // namespace
}  // namespace tyndall
