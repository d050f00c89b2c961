#pragma once

#include <deque>
#include <filesystem>
#include <span>
#include <string>

namespace tyndall {

/// Files that appear together or not at all. Each is written beside its target, as .NAME.partialPID, and renamed in
/// commit(). What was not committed is removed by the destructor and by the signals INT, TERM and HUP, unless the
/// program handles or ignores these itself. A link is written through, also one whose target is not there yet.
class OutputFiles {
  public:
    OutputFiles() = default;
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    /// Throws Error with the path and the system's reason.
    void add(const std::filesystem::path& path, const std::string& content);
    void commit();

  private:
    struct Staged {
        std::filesystem::path path, target;
        std::string partial;
    };
    std::deque<Staged> staged_;  // signals know the strings by address
};

/// A file that a command was told to read or write, and by which option.
struct NamedFile {
    std::string option;
    std::filesystem::path path;
};
/// Before long work, not after: throws Error where a file cannot be written (no such folder, no right to write, not
/// a regular file), and UsageError where two outputs are one file, or an output is an input.
void check_outputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs = {});

}  // namespace tyndall
