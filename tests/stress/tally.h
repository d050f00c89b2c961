#pragma once

#include <map>
#include <string>

#include "checks.h"

namespace tyndall::stress {

/// How much was compared, by technique and by what of it.
class Tally {
  public:
    struct Row {
        int frames = 0;
        long long pixels = 0;
        double worst = 0;  ///< largest error over its bound
    };
    /// `worst` over `pixels` pixels of a frame.
    void add(const std::string& technique, const std::string& what, int pixels, double worst);
    /// Pixels that a rule leaves out of a comparison.
    void leave_out(const std::string& rule, int pixels) { left_out_[rule] += pixels; }
    [[nodiscard]] std::string table() const;
    [[nodiscard]] long long pixels() const;

  private:
    std::map<std::pair<std::string, std::string>, Row> rows_;
    std::map<std::string, long long> left_out_;
};

}  // namespace tyndall::stress
