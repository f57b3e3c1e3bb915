// Files that are read and replaced as a whole: reading something that is not a regular file does not block.
#include "base/files/text_file.h"
#include "emulator/models/models.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "base/files/content_kind.h"
#include "base/files/descriptor.h"
#include "emulator/device/memory/nv_file.h"
#include "emulator/play/plot/trace_table.h"
#include "emulator/play/reading/scenario_file.h"
#include "emulator/world/bench_file/bench_file.h"

namespace understudy::emulator {
namespace text_file_test {

namespace fs = std::filesystem;

class TextFile : public testing::Test {
 protected:
  TextFile() {
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
    EXPECT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    fs::create_symlink(path("pipe"), path("link"));
  }
  ~TextFile() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  static std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::string folder_ = "/tmp/understudy-text-XXXXXX";
};

TEST_F(TextFile, IsReadByteForByte) {
  for (const std::string& text : {std::string(), std::string("a\0b\r\n\xFF", 6), std::string(200'001, 'x')}) {
    const FileText read = read_text_file(put("file", text));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, text);
    EXPECT_EQ(why_not_readable(path("file")), "");
  }
}

TEST_F(TextFile, IsReadWithoutAByteOrderMark) {
  EXPECT_EQ(*read_text_file(put("file", "\xEF\xBB\xBFMA 7\n")), "MA 7\n");
  EXPECT_EQ(*read_text_file(put("file", "MA\xEF\xBB\xBF")), "MA\xEF\xBB\xBF");
  EXPECT_EQ(*read_text_file(put("file", "\xEF\xBB\xBF")), "");
  EXPECT_EQ(content_of("\xEF\xBB\xBF# simulated seconds, in (from the host) or out, line"),
            ContentKind::capture);
}

TEST_F(TextFile, WhatIsNoRegularFileIsRefusedAtOnce) {
  // Nothing writes to the pipe, and /dev/zero has no end: reading either would never end.
  for (const std::string& file : {path("pipe"), path("link"), path(""), std::string("/dev/zero"),
                                  std::string("/dev/null"), std::string("/dev/tty0")}) {
    if (!fs::exists(file)) continue;
    const FileText read = read_text_file(file);
    EXPECT_FALSE(read) << file;
    // We may not have permission to open a terminal.
    if (file != "/dev/tty0") {
      EXPECT_EQ(read.why, "is not a regular file") << file;
    }
    EXPECT_EQ(why_not_readable(file), read.why) << file;
  }
  for (const std::string& file : {path("none"), path("none/file"), std::string()}) {
    EXPECT_FALSE(read_text_file(file)) << file;
    EXPECT_EQ(read_text_file(file).why, "cannot be read (No such file or directory)") << file;
    EXPECT_EQ(why_not_readable(file), "cannot be read (No such file or directory)") << file;
  }
}

TEST_F(TextFile, IsReadUpToTheLimitAndNotBeyond) {
  const std::string file = put("large", "");
  fs::resize_file(file, kMaxTextBytes);  // with a hole: it takes no space on the disk
  EXPECT_EQ(read_text_file(file).value_or("").size(), kMaxTextBytes);
  fs::resize_file(file, kMaxTextBytes + 1);
  EXPECT_FALSE(read_text_file(file));
  EXPECT_EQ(read_text_file(file).why, "is larger than 64 MiB");
  EXPECT_EQ(why_not_readable(file), "") << "a file that is read in pieces can have any length";
}

TEST_F(TextFile, WhoeverReadsOneSaysWhatIsWrongWithIt) {
  const auto diagnostic = [](const auto& read) -> std::string {
    try {
      read();
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  const std::string pipe = path("pipe");
  const std::string csv = path("pipe.csv");
  ASSERT_EQ(mkfifo(csv.c_str(), 0600), 0);
  EXPECT_EQ(diagnostic([&] { world::load_bench(models::all_models(), pipe); }),
            pipe + ": bench: is not a regular file; expected a bench file");
  EXPECT_EQ(diagnostic([&] { play::load_scenarios(models::all_models(), pipe); }),
            pipe + ": scenario: is not a regular file; expected a scenario file");
  EXPECT_EQ(diagnostic([&] { play::kind_of_file(pipe); }),
            pipe + ": file: is not a regular file; expected a bench or a scenario");
  EXPECT_EQ(diagnostic([&] { read_nv_file(pipe); }),
            pipe + ": file: is not a regular file; expected an NV image");
  EXPECT_EQ(diagnostic([&] { play::read_trace(csv); }), csv + ": is not a regular file; expected a trace");
  // A bench's listing, a scenario's and what it includes.
  const std::string bench =
      "understudy: 1\nlines:\n  rs485:\n    stations:\n      - { name: feeder, model: simple2-r3 }\n";
  EXPECT_EQ(diagnostic([&] {
              world::load_bench(models::all_models(),
                                put("b.yaml", bench.substr(0, bench.rfind(" }")) + ", program: pipe }\n"));
            }),
            path("b.yaml") + ":5:53: lines.rs485.stations[0].program: " + pipe +
                " is not a regular file; expected a listing");
  put("feeder.yaml", bench);
  for (const auto& [step, why] : std::vector<std::pair<std::string, std::string>>{
           {"program: { feeder: pipe }",
            "24: steps[0].program.feeder: " + pipe + " is not a regular file; expected a listing"},
           {"include: pipe",
            "14: steps[0].include: " + pipe + " is not a regular file; expected a file of steps"}}) {
    const std::string file = put("s.yaml", "understudy: 1\nbench: feeder.yaml\nsteps:\n  - " + step + "\n");
    EXPECT_EQ(diagnostic([&] { play::load_scenarios(models::all_models(), file); }), file + ":4:" + why);
  }
}

TEST_F(TextFile, IsReplacedAsAWholeAndTouchesNoNeighbour) {
  put("file", "old");
  put("file.new", "precious");
  put("file.new-2", "too");
  EXPECT_EQ(replace_text_file(path("file"), "new", ContentKind::other), "");
  EXPECT_EQ(content(path("file")), "new");
  EXPECT_EQ(content(path("file.new")), "precious");
  EXPECT_EQ(content(path("file.new-2")), "too");
  EXPECT_FALSE(fs::exists(path("file.new-3")));
  EXPECT_EQ(replace_text_file(path("none/file"), "new", ContentKind::other), "No such file or directory");
}

TEST_F(TextFile, WhatReplacesAFileHasItsMode) {
  for (const auto mode : {fs::perms(0600), fs::perms(0640), fs::perms(0444), fs::perms(0666)}) {
    const std::string file = put("file", "old");
    fs::permissions(file, mode);
    EXPECT_EQ(replace_text_file(file, "new", ContentKind::other), "");
    EXPECT_EQ(content(file), "new");
    EXPECT_EQ(fs::status(file).permissions(), mode);
    fs::remove(file);
  }
  const mode_t before = umask(022);
  EXPECT_EQ(replace_text_file(path("free"), "new", ContentKind::other), "");
  umask(before);
  EXPECT_EQ(fs::status(path("free")).permissions(), fs::perms(0644));
}

TEST_F(TextFile, WhatReplacesAFileHasItsOwner) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const std::string file = put("file", "old");
  ASSERT_EQ(chown(file.c_str(), 12345, 23456), 0);
  EXPECT_EQ(replace_text_file(file, "new", ContentKind::other), "");
  struct stat status = {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 12345U);
  EXPECT_EQ(status.st_gid, 23456U);
}

// Files next to a memory may belong to someone: only a writer's leftovers are removed, and nothing that is
// being written.
TEST_F(TextFile, WhatAKilledWriterHasLeftIsRemoved) {
  const std::string image = R"({"understudy":1,"kind":"nv-image","model":"slim"})";
  put("c.json", image);
  const std::vector<std::pair<std::string, std::string>> stay = {
      {"c.json.new-3", "precious"},
      {"c.json.new-x", image},
      {"c.json.newer", image},
      {"c.json.new-1", image},
      {"d.json.new", image},
      {"c.json.old", image},
      {"c.json.new-4", "understudy: 1\nlines: {}\n"}};
  const std::vector<std::pair<std::string, std::string>> go = {
      {"c.json.new", ""}, {"c.json.new-2", image}, {"c.json.new-35", "{\n  \"understudy\": 1,\n  \"ki"}};
  for (const auto& [name, text] : stay) put(name, text);
  for (const auto& [name, text] : go) put(name, text);
  fs::create_directory(path("c.json.new-7"));
  put("c.json.new-8", image);
  const Descriptor being_written(open(path("c.json.new-8").c_str(), O_WRONLY | O_CLOEXEC));
  ASSERT_EQ(flock(being_written.get(), LOCK_EX), 0);
  remove_left_beside(path("c.json"), ContentKind::nv_image);
  for (const auto& [name, text] : stay) EXPECT_EQ(content(path(name)), text) << name;
  for (const auto& [name, text] : go) EXPECT_FALSE(fs::exists(path(name))) << name;
  EXPECT_TRUE(fs::exists(path("c.json.new-7")));
  EXPECT_TRUE(fs::exists(path("c.json.new-8")));
  EXPECT_EQ(content(path("c.json")), image);
}

TEST_F(TextFile, OfAnotherKindIsNeverReplaced) {
  const std::string bench = "understudy: 1\nlines: { a: { stations: [ { name: x, model: slim } ] } }\n";
  put("bench", bench);
  EXPECT_EQ(replace_text_file(path("bench"), "{}", ContentKind::snapshot),
            "it is a bench; expected a snapshot to replace, or a free path");
  EXPECT_EQ(content(path("bench")), bench);
  EXPECT_FALSE(fs::exists(path("bench.new")));
}

TEST_F(TextFile, WhatIsNotARegularFileIsNeverReplaced) {
  fs::create_directory(path("folder"));
  const std::string expected = "; expected a regular file, or a free path";
  EXPECT_EQ(replace_text_file(path("pipe"), "new", ContentKind::other), "it is a pipe" + expected);
  EXPECT_EQ(replace_text_file(path("link"), "new", ContentKind::other), "it is a pipe" + expected)
      << "a link to it";
  EXPECT_EQ(replace_text_file(path("folder"), "new", ContentKind::other), "it is a directory" + expected);
  EXPECT_EQ(replace_text_file("/dev/null", "new", ContentKind::other), "it is a device" + expected);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
  EXPECT_TRUE(fs::is_symlink(path("link")));
}

TEST_F(TextFile, ALinkStaysAndWhatItLeadsToIsReplaced) {
  fs::create_directory(path("folder"));
  put("folder/real", "old");
  fs::create_symlink("folder/real", path("to it"));
  fs::create_symlink("folder/free", path("to nothing"));
  EXPECT_EQ(replace_text_file(path("to it"), "new", ContentKind::other), "");
  EXPECT_EQ(replace_text_file(path("to nothing"), "made", ContentKind::other), "");
  EXPECT_TRUE(fs::is_symlink(path("to it")));
  EXPECT_TRUE(fs::is_symlink(path("to nothing")));
  EXPECT_EQ(content(path("folder/real")), "new");
  EXPECT_EQ(content(path("folder/free")), "made");
}

}  // namespace text_file_test
}  // namespace understudy::emulator
