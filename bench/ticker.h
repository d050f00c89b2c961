#pragma once

#include <chrono>
#include <string>

namespace tyndall::bench {

/// Progress of a plan whose steps differ in cost: a line on a terminal that tells the time left, and one line for
/// each group elsewhere.
class Ticker {
  public:
    Ticker();
    ~Ticker();
    Ticker(const Ticker&) = delete;
    Ticker& operator=(const Ticker&) = delete;
    void plan(double cost) { total_ += cost; }
    void group(const std::string& name, int number, int count);
    void tick(double cost);
    /// Of what was planned, this will not be done.
    void drop(double cost) { total_ -= cost; }

  private:
    [[nodiscard]] std::string left() const;
    double total_ = 0, done_ = 0;
    bool terminal_;
    bool open_ = false;  ///< the line on the terminal is unfinished
    std::string group_;
    std::chrono::steady_clock::time_point start_, shown_;
};

}  // namespace tyndall::bench
