#pragma once

#include <stdexcept>
#include <string>

namespace tyndall {

/// A failure of the outside world: a file, a shader, a context, a value a person gave.
/// `what()` is one line that says what failed, where, and what was expected; `tyndall` prints it and exits with 1.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A command line that does not parse or names something that does not exist: exit code 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

}  // namespace tyndall
