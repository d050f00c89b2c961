#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/roots.h"
#include "engine/gl/program.h"

namespace tyndall {

/// One axis of a shader's permutations: a define and the values it may take. A define removes work; a uniform
/// changes a number.
struct PermutationAxis {
    std::string define;
    std::vector<int> values;
};
using Permutation = std::map<std::string, int>;

/// A program as declared in code: its stages and every permutation it can have.
struct ProgramDesc {
    struct Stage {
        GLenum stage;      ///< GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_COMPUTE_SHADER …
        std::string path;  ///< relative to the shader roots' parent: "shaders/engine/lighting.frag"
    };
    std::string name;
    std::vector<Stage> stages;
    std::vector<PermutationAxis> axes;
    /// Combinations that make sense; empty accepts all.
    std::function<bool(const Permutation&)> valid;
};

/// All valid combinations of the axes' values.
[[nodiscard]] std::vector<Permutation> all_permutations(const ProgramDesc& desc);

/// The text of `path` with its `#include "shaders/…"` lines resolved against `roots` (each file once, whether or
/// not an #if surrounds it; so there are no cycles). Other #include lines stay. Directives `#line N F` let the
/// compiler's messages name a file: F is its index in `files`, to which every file asked for is appended. Throws
/// Error for a missing file, naming the includer and its line.
[[nodiscard]] std::string resolve_includes(const Roots& roots, const std::string& path,
                                           std::vector<std::filesystem::path>* files = nullptr);

/// Compiles programs on first use and keeps them. A declared program is found by reference: the desc must outlive
/// the library's use of it (they are static constants beside the pass that uses them).
class ShaderLibrary {
  public:
    /// `roots` are the folders that contain shaders/, a host's own first.
    explicit ShaderLibrary(Roots roots);

    /// Every axis of `desc` must be given a declared value, and no other define may be (failed check otherwise).
    /// Throws Error with the compiler's message on the first failure to build.
    [[nodiscard]] const gl::Program& get(const ProgramDesc& desc, const Permutation& permutation = {});

    /// Rebuilds the programs whose files changed on disk. One that fails keeps its old program and has a line in
    /// `errors()` until it builds again. Returns how many were rebuilt. Looks at the disk at most every 0.5 s.
    int reload_changed();
    [[nodiscard]] const std::vector<std::string>& errors() const { return errors_; }
    [[nodiscard]] std::size_t program_count() const;
    [[nodiscard]] const Roots& roots() const { return roots_; }

  private:
    struct Entry;
    Roots roots_;
    std::map<std::string, std::unique_ptr<Entry>> entries_;
    std::vector<std::string> errors_;
    double last_look_ = 0;

  public:
    ~ShaderLibrary();
};

/// Every ProgramDesc registers itself here so that a test can compile all permutations.
class ProgramRegistry {
  public:
    static const std::vector<const ProgramDesc*>& all();
    struct Registration {
        explicit Registration(const ProgramDesc& desc);
    };
};

}  // namespace tyndall
