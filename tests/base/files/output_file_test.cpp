// Which files may be written, and when their previous contents are lost.
#include "base/files/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/ordinary_user.h"
#include "tests/pty/pcapng_reader.h"
#include "tests/pty/pty_host.h"

namespace understudy {
namespace output_file_test {

namespace fs = std::filesystem;

std::string refusal(const std::string& path) {
  try {
    OutputFile file(path, ContentKind::other);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

class OutputFileTest : public testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  pty::ScratchDirectory folder_;
};

TEST_F(OutputFileTest, KeepsWhatIsThereUntilItBegins) {
  const std::string path = put("a", "before");
  { const OutputFile opened(path, ContentKind::other); }
  EXPECT_EQ(pty::contents_of(path), "before");
  OutputFile file(path, ContentKind::other);
  file.begin("head");
  EXPECT_EQ(file.write(" and more"), 0);
  EXPECT_EQ(pty::contents_of(path), "head and more");
  file.begin("again");
  EXPECT_EQ(pty::contents_of(path), "again");
}

TEST_F(OutputFileTest, IsOnesOwn) {
  const std::string path = folder_ / "a";
  {
    OutputFile first(path, ContentKind::other);
    first.begin("mine");
    EXPECT_EQ(refusal(path), "another program is writing it; expected another path");
  }
  EXPECT_EQ(refusal(path), "");
  EXPECT_EQ(pty::contents_of(path), "mine");
}

TEST_F(OutputFileTest, FollowsLinksAndLeavesThem) {
  fs::create_directory(folder_ / "inner");
  fs::create_symlink("inner/real", folder_ / "link");
  fs::create_symlink(folder_ / "link", folder_ / "link to a link");
  OutputFile file(folder_ / "link to a link", ContentKind::other);
  file.begin("text");
  EXPECT_EQ(fs::canonical(file.target()), fs::canonical(folder_ / "inner/real"));
  EXPECT_EQ(pty::contents_of(folder_ / "inner/real"), "text");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  fs::create_symlink("loop", folder_ / "loop");
  EXPECT_EQ(refusal(folder_ / "loop"), "Too many levels of symbolic links");
}

TEST_F(OutputFileTest, IsARegularOne) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const std::string expected = "; expected a regular file, or a free path";
  EXPECT_EQ(refusal(folder_ / "pipe"), "it is a pipe" + expected);
  EXPECT_EQ(refusal(folder_ / ""), "it is a directory" + expected);
  EXPECT_EQ(refusal("/dev/null"), "it is a device" + expected);
  EXPECT_EQ(refusal(folder_ / "none/a"), "No such file or directory");
}

TEST_F(OutputFileTest, OfAnotherKindStays) {
  const std::string path = put("r.jsonl", R"({"understudy":1,"kind":"recording"})");
  try {
    OutputFile file(path, ContentKind::results);
    ADD_FAILURE() << "taken";
  } catch (const OutputError& error) {
    EXPECT_STREQ(error.what(), "it is a recording; expected a results file to replace, or a free path");
  }
  EXPECT_EQ(pty::contents_of(path), R"({"understudy":1,"kind":"recording"})");
  OutputFile(path, ContentKind::recording).begin("new");
  EXPECT_EQ(pty::contents_of(path), "new");
}

// As Linux forbids it with fs.protected_regular, whatever the setting is here.
TEST_F(OutputFileTest, IsNoStrangersFileInAnOpenFolder) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make another user's file";
  const std::string open_folder = folder_ / "tmp";
  fs::create_directory(open_folder);
  const std::string file = open_folder + "/file";
  std::ofstream(file) << "before";
  ASSERT_EQ(::chmod(file.c_str(), 0666), 0);
  ASSERT_EQ(::chown(file.c_str(), 12345, 12345), 0);
  const std::string expected =
      "it is another user's file in a folder that everyone can write to; expected a path of your own";
  {
    const OrdinaryUser user(folder_ / "");
    EXPECT_EQ(refusal(file), "") << "the folder is not open to all";
  }
  ASSERT_EQ(::chmod(open_folder.c_str(), 01777), 0);
  EXPECT_EQ(refusal(file), expected);
  {
    const OrdinaryUser user(folder_ / "");
    EXPECT_EQ(refusal(file), expected);
    const std::string own = open_folder + "/own";
    std::ofstream(own) << "before";
    EXPECT_EQ(refusal(own), "");
  }
  std::string kept;
  std::ifstream(file) >> kept;
  EXPECT_EQ(kept, "before");
}

TEST_F(OutputFileTest, IsNotReachedByAStrangersLinkInAnOpenFolder) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can make another user's link";
  const std::string precious = put("precious", "before");
  const std::string open_folder = folder_ / "tmp";
  fs::create_directory(open_folder);
  const std::string link = open_folder + "/link";
  fs::create_symlink(precious, link);
  ASSERT_EQ(::lchown(link.c_str(), 12345, 12345), 0);
  EXPECT_EQ(refusal(link), "") << "the folder is not open to all";
  ASSERT_EQ(::chmod(open_folder.c_str(), 01777), 0);
  EXPECT_EQ(refusal(link),
            "it is another user's link in a folder that everyone can write to; expected a path of your own");
  ASSERT_EQ(::lchown(link.c_str(), ::geteuid(), 0), 0);
  EXPECT_EQ(refusal(link), "");
  // The same through a folder in the path.
  const std::string way = open_folder + "/way";
  fs::create_directory_symlink(fs::path(precious).parent_path(), way);
  EXPECT_EQ(refusal(way + "/precious"), "");
  ASSERT_EQ(::lchown(way.c_str(), 12345, 12345), 0);
  EXPECT_EQ(
      refusal(way + "/precious"),
      way +
          ": it is another user's link in a folder that everyone can write to; expected a path of your own");
}

}  // namespace output_file_test
}  // namespace understudy
