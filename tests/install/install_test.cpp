// The module as a package: installed into a folder that is then moved, found there by examples/host, a renderer
// that knows nothing else of this repository, and seen in its picture.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <set>
#include <sstream>

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct Result {
    int exit_code;
    std::string output;  ///< of both streams
};

/// By the shell.
Result run(const std::string& command) {
    Result result{-1, ""};
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) result.output += buffer.data();
    const int status = pclose(pipe);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

template <class... Arguments>
void must_run(fmt::format_string<const Arguments&...> format, const Arguments&... arguments) {
    const std::string command = fmt::format(format, arguments...);
    const Result done = run(command);
    EXPECT_EQ(done.exit_code, 0) << command << '\n' << done.output;
}

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// What the host saw: its tone curve undone. The camera is that of examples/host.
class Picture {
  public:
    explicit Picture(const fs::path& path) : bytes_(text_of(path)) {
        std::istringstream header(bytes_);
        std::string kind;
        int white = 0;
        header >> kind >> size_.x >> size_.y >> white;
        first_ = static_cast<std::size_t>(header.tellg()) + 1;
    }
    [[nodiscard]] bool whole() const {
        return size_.x > 0 && bytes_.size() == first_ + std::size_t(3 * size_.x * size_.y);
    }
    /// Mean radiance of 3 x 3 pixels round a place in the world.
    [[nodiscard]] double at(double x, double y, double z) const {
        const double distance = 7 - z, scale = size_.y / (2 * std::tan(glm::radians(18.0)) * distance);
        const glm::ivec2 pixel(size_.x / 2 + x * scale, size_.y / 2 - (y - 1.6) * scale);
        double sum = 0;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) sum += radiance(pixel + glm::ivec2(dx, dy));
        return sum / 9;
    }

  private:
    [[nodiscard]] double radiance(glm::ivec2 pixel) const {
        double sum = 0;
        for (int c = 0; c < 3; ++c) {
            const auto byte = static_cast<unsigned char>(
                bytes_.at(first_ + static_cast<std::size_t>(3 * (pixel.y * size_.x + pixel.x) + c)));
            sum -= std::log(1 - std::pow(std::min(byte / 255.0, 0.999), 2.2));
        }
        return sum / 3;
    }
    std::string bytes_;
    glm::ivec2 size_{0};
    std::size_t first_ = 0;
};

class Install : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        std::string pattern = (fs::temp_directory_path() / "tyndall-install-XXXXXX").string();
        folder = mkdtemp(pattern.data());
        prefix = folder / "moved";
        must_run("{} --install {} --prefix {}", CMAKE_COMMAND, TYNDALL_BINARY_DIR, (folder / "prefix").string());
        fs::rename(folder / "prefix", prefix);
        fs::copy(fs::path(TYNDALL_SOURCE_DIR) / "examples/host", folder / "host", fs::copy_options::recursive);
    }
    static void TearDownTestSuite() { fs::remove_all(folder); }

    static std::string path(const char* name) { return (folder / name).string(); }
    static void build_host() {
        if (fs::exists(folder / "build/host")) return;
        must_run("{} -S {} -B {} -G Ninja -DCMAKE_PREFIX_PATH={} -DCMAKE_CXX_FLAGS='-Wall -Wextra -Werror'",
                 CMAKE_COMMAND, path("host"), path("build"), prefix.string());
        must_run("{} --build {}", CMAKE_COMMAND, path("build"));
    }

    static inline fs::path folder, prefix;
};

TEST_F(Install, TheExampleHostShowsShaftsTheirShadowsAndTheGlowOfItsLamp) {
    build_host();
    must_run("{} --out {}", path("build/host"), path("fog.ppm"));
    must_run("{} --out {} --technique off", path("build/host"), path("clear.ppm"));
    const Picture fog(folder / "fog.ppm"), clear(folder / "clear.ppm");
    ASSERT_TRUE(fog.whole());
    ASSERT_TRUE(clear.whole());
    // Sunlight through the middle of each opening of the roof: half as far along x as it falls.
    for (const double opening : {-3.0, -0.5, 2.0}) {
        const double y = 2.6, x = opening + 0.5 * (4.1 - y), z = -1.5;
        const auto over_neighbours = [&](const Picture& picture) {
            return 2 * picture.at(x, y, z) / (picture.at(x - 0.9, y, z) + picture.at(x + 0.9, y, z));
        };
        EXPECT_GT(over_neighbours(fog), 1.4) << opening;
        EXPECT_NEAR(over_neighbours(clear), 1, 0.2) << opening;
    }
    // The box stands in the middle shaft, which goes on to its right were it not there.
    const double y = 0.5, z = -0.6;
    EXPECT_GT(fog.at(-3 + 1.8, y, z), 1.25 * fog.at(-3 + 2.6, y, z));
    EXPECT_NEAR(fog.at(1.42, y, z) / fog.at(2.1, y, z), 1, 0.08);
    EXPECT_GT(fog.at(-3.4, 1.4, -3), 1.5 * fog.at(-3.4, 2.4, -3));
    EXPECT_GT(fog.at(-3.4, 2.4, -3), 0.02);
}

TEST_F(Install, PkgConfigBuildsTheSameHost) {
    build_host();
    must_run(R"sh(export PKG_CONFIG_PATH={0}/moved/lib/pkgconfig
data=$(pkg-config --variable=datadir tyndall-volumetrics)
c++ -std=c++20 -DHOST_DIR='"{0}/host"' -DTYNDALL_DATA_DIR="\"$data\"" {0}/host/main.cpp -o {0}/host_of_pkg_config \
    $(pkg-config --cflags --libs tyndall-volumetrics egl))sh",
             folder.string());
    for (const char* host : {"build/host", "host_of_pkg_config"})
        must_run("{} --out {}.ppm --technique analytic_fog", path(host), path(host));
    EXPECT_EQ(text_of(folder / "build/host.ppm"), text_of(folder / "host_of_pkg_config.ppm"));
}

TEST_F(Install, AMissingDataFolderIsOneLineThatNamesIt) {
    build_host();
    const fs::path data = prefix / "share/tyndall";
    fs::rename(data, folder / "data");
    const Result result = run(path("build/host"));
    fs::rename(folder / "data", data);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.output, HasSubstr(data.string()));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
}

TEST_F(Install, NothingThatHostsReadNamesTheTreeItWasBuiltIn) {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(prefix)) {
        if (!entry.is_regular_file() || entry.path().extension() == ".a" || entry.path().extension() == ".raw")
            continue;
        EXPECT_THAT(text_of(entry.path()), Not(HasSubstr(TYNDALL_SOURCE_DIR))) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 50);
}

TEST_F(Install, DebianPackagesHoldTheSame) {
    must_run("cd {} && cpack --config {}/CPackConfig.cmake -B {}", folder.string(), TYNDALL_BINARY_DIR,
             path("packages"));
    must_run("for package in {0}/*.deb; do dpkg -x $package {0}/root; done", path("packages"));
    const auto files = [](const fs::path& root) {
        std::set<std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(root))
            all.insert(entry.path().lexically_relative(root).string());
        return all;
    };
    EXPECT_EQ(files(folder / "packages/root/usr"), files(prefix));
}

TEST_F(Install, TheModuleAloneAsksForNoLibraryOfTheGame) {
    must_run("{} -S {} -B {} -G Ninja -DTYNDALL_GAME=OFF", CMAKE_COMMAND, TYNDALL_SOURCE_DIR, path("module"));
    const std::string cache = text_of(folder / "module/CMakeCache.txt");
    EXPECT_THAT(cache, HasSubstr("glm_DIR"));
    for (const char* library :
         {"BULLET", "embree", "OpenImageIO", "GTest", "IMGUI", "glfw", "OPENVDB", "TinyGLTF", "CLI11"})
        EXPECT_THAT(cache, Not(HasSubstr(library)));
}

}  // namespace
}  // namespace tyndall
