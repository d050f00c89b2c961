#include "engine/core/files.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/output_files.h"
#include "engine/scene/data_root.h"

namespace tyndall {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Files : public testing::Test {
  protected:
    Files() : folder_(fs::temp_directory_path() / ("tyndall_files_test." + std::to_string(::getpid()))) {
        fs::create_directories(folder_ / "scene/textures");
    }
    ~Files() override { fs::remove_all(folder_); }

    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }
    fs::path folder_;
};

TEST_F(Files, TextAndBytesRoundTrip) {
    const std::string text("a\0b\r\n\xff", 6);
    write_text(folder_ / "a.bin", text);
    EXPECT_EQ(read_text(folder_ / "a.bin"), text);
    const auto bytes = read_bytes(folder_ / "a.bin");
    EXPECT_EQ(std::string(bytes.begin(), bytes.end()), text);
    const std::string large(200'001, 'x');
    write_text(folder_ / "a.bin", large);
    EXPECT_EQ(read_text(folder_ / "a.bin"), large);
}

TEST_F(Files, MissingFileAndFolderNamePathAndReason) {
    EXPECT_THAT([&] { (void)read_text(folder_ / "none.txt"); },
                ThrowsMessage<Error>(AllOf(HasSubstr((folder_ / "none.txt").string()), HasSubstr("No such file"))));
    EXPECT_THAT([&] { (void)read_bytes(folder_); }, ThrowsMessage<Error>(HasSubstr("folder")));
}

TEST_F(Files, JsonErrorHasPathLineAndColumn) {
    write_text(folder_ / "bad.json", "{\n  \"a\": 1,\n  \"b\": oops\n}");
    EXPECT_THAT([&] { (void)read_json(folder_ / "bad.json"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("bad.json"), HasSubstr("line 3"), HasSubstr("column"),
                                           testing::Not(HasSubstr("\n")))));
    for (const char bracket : {'[', '{'}) {
        write_text(folder_ / "deep.json", std::string(100'000, bracket));
        EXPECT_THAT([&] { (void)read_json(folder_ / "deep.json"); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("deep.json: "), HasSubstr("nested deeper than 100"))));
    }
    write_text(folder_ / "good.json", R"({"a": [1, 2]})");
    EXPECT_EQ(read_json(folder_ / "good.json").at("a").at(1), 2);
}

TEST_F(Files, SeveralAppearTogether) {
    OutputFiles files;
    files.add(folder_ / "a.txt", "new");
    EXPECT_FALSE(fs::exists(folder_ / "a.txt"));
    files.add(folder_ / "b.txt", "");
    files.commit();
    EXPECT_EQ(read_text(folder_ / "a.txt"), "new");
    EXPECT_EQ(read_text(folder_ / "b.txt"), "");
}

TEST_F(Files, OneThatCannotBeWrittenLeavesTheOldOnesAndNothingElse) {
    write_text(folder_ / "out.txt", "old");
    const std::size_t before = entries();
    {
        OutputFiles files;
        files.add(folder_ / "out.txt", "new");
        EXPECT_THROW(files.add(folder_ / "none/stats.json", "x"), Error);
    }
    EXPECT_EQ(read_text(folder_ / "out.txt"), "old");
    EXPECT_EQ(entries(), before);
}

TEST_F(Files, ASignalWhileWritingLeavesNothing) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        const std::size_t before = entries();
        const pid_t child = ::fork();
        if (child == 0) {
            OutputFiles files;
            for (const char* name : {"a.png", "a.json", "long_enough_to_be_on_the_heap.json"})
                files.add(folder_ / name, "x");
            if (entries() == before + 3) ::raise(signal);
            ::_exit(0);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
        EXPECT_EQ(entries(), before) << signal;
    }
}

TEST_F(Files, ASignalThatIsIgnoredStaysSo) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGHUP, SIG_IGN);  // as nohup has it
        OutputFiles files;
        files.add(folder_ / "a.txt", "x");
        ::raise(SIGHUP);
        files.commit();
        ::_exit(fs::exists(folder_ / "a.txt") ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST_F(Files, UnwritableTargetsNameThePath) {
    EXPECT_THAT([&] { write_text(folder_ / "none/out.txt", "x"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("none/out.txt"), HasSubstr("No such file"))));
    EXPECT_THROW(write_text(folder_ / "scene", "x"), Error);
    EXPECT_TRUE(fs::is_directory(folder_ / "scene"));
    EXPECT_THROW(write_text("/dev/null", "x"), Error);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, WritingThroughALinkKeepsTheLink) {
    write_text(folder_ / "real.txt", "old");
    fs::create_symlink(folder_ / "real.txt", folder_ / "link.txt");
    write_text(folder_ / "link.txt", "new");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
    EXPECT_EQ(read_text(folder_ / "real.txt"), "new");
}

TEST_F(Files, WritingThroughALinkToNothingMakesWhatItLeadsTo) {
    fs::create_symlink("second.txt", folder_ / "first.txt");
    fs::create_symlink(folder_ / "scene/real.txt", folder_ / "second.txt");
    write_text(folder_ / "first.txt", "new");
    EXPECT_TRUE(fs::is_symlink(folder_ / "first.txt"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "second.txt"));
    EXPECT_EQ(read_text(folder_ / "scene/real.txt"), "new");
    fs::create_symlink("loop.txt", folder_ / "loop.txt");
    EXPECT_THROW(write_text(folder_ / "loop.txt", "x"), Error);
    EXPECT_TRUE(fs::is_symlink(folder_ / "loop.txt"));
    fs::create_symlink(folder_ / "none/real.txt", folder_ / "lost.txt");
    EXPECT_THAT([&] { write_text(folder_ / "lost.txt", "x"); }, ThrowsMessage<Error>(HasSubstr("lost.txt")));
}

TEST_F(Files, OutputsAreCheckedBeforeTheWork) {
    const auto check = [&](const fs::path& a, const fs::path& b) {
        check_outputs(std::array{NamedFile{"--output", a}, NamedFile{"--stats", b}},
                      std::array{NamedFile{"SCENE", folder_ / "scene/a.gltf"}});
    };
    EXPECT_NO_THROW(check(folder_ / "a.png", folder_ / "a.json"));
    EXPECT_NO_THROW(check("a.png", "a.json"));
    EXPECT_THROW(check(folder_ / "a.png", folder_ / "none/a.json"), Error);
    EXPECT_THROW(check(folder_ / "scene", folder_ / "a.json"), Error);
    EXPECT_THROW(check("/dev/null", folder_ / "a.json"), Error);
    for (const fs::path& same : {folder_ / "a.png", folder_ / "scene/../a.png"})
        EXPECT_THAT([&] { check(folder_ / "a.png", same); },
                    ThrowsMessage<UsageError>(AllOf(HasSubstr("--stats"), HasSubstr("--output"))));
    fs::create_symlink("a.png", folder_ / "link.json");
    EXPECT_THROW(check(folder_ / "a.png", folder_ / "link.json"), UsageError);
    EXPECT_THAT([&] { check(folder_ / "a.png", folder_ / "scene/a.gltf"); },
                ThrowsMessage<UsageError>(AllOf(HasSubstr("--stats"), HasSubstr("SCENE"))));
}

TEST_F(Files, ResolveInsideAcceptsPathsOfTheFolder) {
    const fs::path scene = fs::canonical(folder_ / "scene");
    EXPECT_EQ(resolve_inside(scene, "textures/a b.png"), scene / "textures/a b.png");
    EXPECT_EQ(resolve_inside(scene, "./textures/../c.bin"), scene / "c.bin");
    EXPECT_EQ(resolve_inside(scene, "..hidden"), scene / "..hidden");
}

TEST_F(Files, ResolveInsideRejectsEverythingElse) {
    const fs::path scene = folder_ / "scene";
    write_text(folder_ / "secret.txt", "x");
    fs::create_directory(folder_ / "scene_2");
    fs::create_symlink(folder_ / "secret.txt", scene / "link.txt");
    fs::create_directory_symlink(folder_, scene / "up");
    for (const std::string& uri :
         {std::string("../secret.txt"), std::string("textures/../../secret.txt"), std::string("../scene_2/a"),
          std::string(".."), std::string("/etc/passwd"), std::string("file:///etc/passwd"),
          std::string("http://example.org/a.png"), std::string("data:text/plain,x"), std::string("link.txt"),
          std::string("up/secret.txt"), std::string("up/none.txt"), std::string(), std::string("a\0b", 3)}) {
        EXPECT_THROW((void)resolve_inside(scene, uri), Error) << uri;
    }
    EXPECT_THAT([&] { (void)resolve_inside(scene, "../secret.txt"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("../secret.txt"), HasSubstr("leaves the folder"))));
}

TEST_F(Files, DataRootHoldsTheShaders) {
    EXPECT_TRUE(fs::is_directory(data_root() / "shaders"));
    ASSERT_EQ(::setenv("TYNDALL_DATA", folder_.c_str(), 1), 0);
    EXPECT_THAT([] { (void)data_root(); }, ThrowsMessage<Error>(HasSubstr(folder_.string())));
    fs::create_directory(folder_ / "shaders");
    EXPECT_EQ(data_root(), folder_);
    ::unsetenv("TYNDALL_DATA");
}

}  // namespace
}  // namespace tyndall
