#include "engine/core/files.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"

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

TEST_F(Files, FailedWriteLeavesTheOldFileAndNothingElse) {
    write_text(folder_ / "out.txt", "old");
    const std::size_t before = entries();
    EXPECT_THROW(write_atomically(folder_ / "out.txt",
                                  [](const fs::path& partial) {
                                      std::ofstream(partial) << "half";
                                      throw Error("disk on fire");
                                  }),
                 Error);
    EXPECT_EQ(read_text(folder_ / "out.txt"), "old");
    EXPECT_EQ(entries(), before);
}

TEST_F(Files, WriterThatWritesNothingIsAnError) {
    EXPECT_THROW(write_atomically(folder_ / "out.txt", [](const fs::path&) {}), Error);
    EXPECT_FALSE(fs::exists(folder_ / "out.txt"));
}

TEST_F(Files, PartialFileIsBesideTheTargetWithItsExtension) {
    write_atomically(folder_ / "out.exr", [&](const fs::path& partial) {
        EXPECT_EQ(partial.parent_path(), folder_);
        EXPECT_EQ(partial.extension(), ".exr");
        EXPECT_NE(partial.filename(), "out.exr");
        std::ofstream(partial) << "new";
    });
    EXPECT_EQ(read_text(folder_ / "out.exr"), "new");
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
