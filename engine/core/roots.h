#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace tyndall {

/// Folders that hold shaders/ and assets/. A file is that of the first of them that has it: so a host's folder,
/// given first, takes the place of single files of the others.
class Roots {
  public:
    Roots(std::filesystem::path root) : folders_{std::move(root)} {}  // NOLINT: implicit, the usual case
    Roots(std::initializer_list<std::filesystem::path> folders) : folders_(folders) {}

    /// An absolute path stands for itself. Throws Error that names all folders where no file of that name is there.
    [[nodiscard]] std::filesystem::path find(const std::filesystem::path& path) const;
    /// Where `find` would have it first.
    [[nodiscard]] std::filesystem::path first(const std::filesystem::path& path) const;
    /// `file`, which `find` found, relative to its folder.
    [[nodiscard]] std::string name_of(const std::filesystem::path& file) const;

  private:
    std::vector<std::filesystem::path> folders_;
};

}  // namespace tyndall
