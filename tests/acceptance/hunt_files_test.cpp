// The files of a hunt are safe: what cannot be written is reported before the first course, a corpus may be
// shared, and what people have edited stays.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "tests/acceptance/page_blocks.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace hunt_files_test {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class HuntFiles : public testing::Test {
 protected:
  HuntFiles() : press_(folder_.write("press.yaml", page_blocks("hunt.md", "yaml").at(0))) {}

  /// Hunts until the contact that bounces is found.
  Finished hunted(Words more = {}) const {
    Words words{"hunt", press_, "--courses", "20", "--found", folder_ / "found"};
    words.insert(words.end(), more.begin(), more.end());
    return understudy(words);
  }

  PrivateFolder folder_;
  std::string press_;
};

TEST_F(HuntFiles, WhatIsWrongIsReportedBeforeTheFirstCourse) {
  folder_.write("plays.yaml", R"(understudy: 1
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
plays:
  - { name: one, steps: [ advance: 1ms ] }
  - { name: two, steps: [ advance: 1ms ], hunt: { may: [ inject: { drop: feeder } ] } }
)");
  folder_.write("-x.yaml", "understudy: 1\n");
  const struct {
    Words words;
    int exit_code;
    std::string message;
  } kCases[] = {
      {{"press.yaml", "--courses", "-1"}, 2, "--courses: -1 is too few; expected 1 or more"},
      {{"press.yaml", "--courses", "0"}, 2, "--courses: 0 is too few; expected 1 or more"},
      {{"press.yaml", "--courses", "99999999999999999999"},
       2,
       "--courses: '99999999999999999999' is not a number of courses; expected a whole number, up to "
       "9223372036854775807"},
      {{"press.yaml", "--courses", "9", "--corpus", "/proc/x"}, 3, "--corpus: /proc/x cannot be written: "},
      {{"press.yaml", "--courses", "9", "--corpus", "none/x"}, 3, "--corpus: none/x cannot be written: "},
      {{"press.yaml", "--courses", "9", "--found", "/proc/x"}, 3, "--found: /proc/x cannot be written: "},
      {{"plays.yaml", "--courses", "9"},
       2,
       "plays.yaml: hunt: is missing in the play 'one'; expected it in each play, or once for the whole "
       "file"},
      {{"-x.yaml"}, 2, "'-x.yaml' is not a flag here; expected ./-x.yaml for the file of that name"},
      {{"--", "-x.yaml"},
       2,
       "hunt: SCENARIO is missing; expected a scenario file with a `hunt` section; `-- COMMAND` comes after "
       "it"},
  };
  for (const auto& one : kCases) {
    Words words{"env", "-C", folder_.path(), UNDERSTUDY_BINARY, "hunt"};
    words.insert(words.end(), one.words.begin(), one.words.end());
    const Finished finished = run(words);
    EXPECT_EQ(finished.exit_code, one.exit_code) << one.message << finished.errors;
    EXPECT_EQ(finished.output, "") << one.message;
    EXPECT_NE(finished.errors.find(one.message), std::string::npos) << finished.errors;
  }
}

TEST_F(HuntFiles, AFolderThatWasMadeForNothingIsRemoved) {
  const Finished finished = understudy({"hunt", press_, "--courses", "1", "--found", folder_ / "a/b"});
  EXPECT_EQ(finished.exit_code, 0) << finished.output;
  EXPECT_FALSE(fs::exists(folder_ / "a"));
}

TEST_F(HuntFiles, AnyNumberOfJobsIsPossible) {
  EXPECT_EQ(hunted({"--jobs", "100000"}).output, hunted({"--jobs", "1"}).output);
}

TEST_F(HuntFiles, TwoHuntsCanShareACorpus) {
  const std::string corpus = folder_ / "press.corpus";
  Process longer({UNDERSTUDY_BINARY, "hunt", press_, "--for", "1h", "--corpus", corpus, "--seed", "1",
                  "--found", folder_ / "a"});
  ASSERT_TRUE(eventually([&] { return fs::exists(corpus); }));
  const Finished shorter = understudy(
      {"hunt", press_, "--courses", "300", "--corpus", corpus, "--seed", "2", "--found", folder_ / "b"});
  EXPECT_EQ(shorter.exit_code, 1) << shorter.errors;
  std::set<std::string> of_shorter;
  for (const std::string& line : lines_of(text_of(corpus)))
    if (line.find("\"disturbances\"") != std::string::npos) of_shorter.insert(line);
  EXPECT_GT(of_shorter.size(), 3U);
  longer.send(SIGINT);
  EXPECT_EQ(longer.wait(kPatience), 1) << longer.errors();
  const std::string both = text_of(corpus);
  for (const std::string& line : of_shorter) EXPECT_NE(both.find(line), std::string::npos) << line;
  EXPECT_NE(both.find("{\"next\":300,\"seed\":2}"), std::string::npos) << both;
  EXPECT_NE(both.find("\"seed\":1}"), std::string::npos) << both;
}

TEST_F(HuntFiles, ACorpusKeepsTheCoursesForWhichThereWasNoTime) {
  const std::string corpus = folder_ / "press.corpus";
  ASSERT_EQ(hunted({"--corpus", corpus}).exit_code, 1);
  // The scenario now fails by itself, so no course is played.
  std::string broken = text_of(press_);
  broken.replace(broken.find("Counter1_Value: 1"), 17, "Counter1_Value: 9");
  folder_.write("press.yaml", broken);
  const std::size_t lines = lines_of(text_of(corpus)).size();
  EXPECT_GT(lines, 3U);
  EXPECT_EQ(hunted({"--corpus", corpus}).exit_code, 1);
  EXPECT_EQ(lines_of(text_of(corpus)).size(), lines) << text_of(corpus);
}

TEST_F(HuntFiles, AnEditedFindingStays) {
  ASSERT_EQ(hunted().exit_code, 1);
  const std::string found = folder_ / "found/press-438cd470.yaml";
  const std::string text = text_of(found);
  ASSERT_EQ(hunted({"--seed", "4"}).exit_code, 1);
  EXPECT_FALSE(fs::exists(folder_ / "found/press-438cd470-2.yaml"));  // nobody had edited it
  EXPECT_NE(text_of(found).find("--seed 4"), std::string::npos) << text_of(found);
  const std::string edited = text + "  - say: what I know about it\n";
  folder_.write("found/press-438cd470.yaml", edited);
  const Finished again = hunted();
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(text_of(found), edited);
  EXPECT_EQ(text_of(folder_ / "found/press-438cd470-2.yaml"), text);
  EXPECT_NE(again.output.find("found/press-438cd470-2.yaml: Counter1_Value is 2"), std::string::npos)
      << again.output;
}

TEST_F(HuntFiles, WhatWasNotReachedHasItsNearestCourse) {
  folder_.write("press.yaml", R"(understudy: 1
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
steps:
  - program:
      feeder: |
        again:  Wait_IO DIN_10 ON
                Wait_IO DIN_9 ON
                Wait_IO DIN_8 ON
                Counter_Increase 1
                Jump again
  - write: { PROG_MAIN_RunTime_START: 0 }
  - advance: 300ms
hunt:
  may:
    - inject: { stuck: feeder.DIN_10, level: on, for: 4ms }
    - inject: { stuck: feeder.DIN_7, level: on, for: 4ms }
)");
  const Finished finished = understudy({"hunt", press_, "--courses", "100", "--found", folder_ / "found"});
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  // Line 2 is reached through DIN_10 alone, and nothing presses DIN_9.
  const std::size_t begin = finished.output.find(".lst:2: Wait_IO DIN_9 ON: its decision was never yes\n");
  ASSERT_NE(begin, std::string::npos) << finished.output;
  const auto lines = lines_of(finished.output.substr(begin));
  ASSERT_GE(lines.size(), 5U);
  EXPECT_NE(lines[1].find(".lst:3: Wait_IO DIN_8 ON: never ran"), std::string::npos) << lines[1];
  const std::string nearest =
      "    nearest: line 2 ran with inject: { stuck: feeder.DIN_10, level: on, for: 4ms, ";
  EXPECT_EQ(lines[4].substr(0, nearest.size()), nearest);
  EXPECT_EQ(lines[4].find("DIN_7"), std::string::npos) << lines[4];  // it has the fewest disturbances
}

TEST(RunOfCases, TheLineThatRunsACaseAloneHasTheSeed) {
  const PrivateFolder folder;
  const std::string path = folder.write("drawn.yaml", R"(understudy: 1
bench: { lines: { rs485: { stations: [ { name: feeder, model: simple2-r3 } ] } } }
vary: { length: { between: [ 1ms, 500ms ], samples: 3 } }
steps:
  - advance: ${length}
  - assert: feeder.A.pulses == 1
)");
  const Finished finished = understudy({"run", path, "--seed", "5"});
  const std::string alone = "understudy run " + path + " --seed 5 --filter ";
  const std::size_t at = finished.output.find(alone);
  ASSERT_NE(at, std::string::npos) << finished.output;
  const std::string id = finished.output.substr(at + alone.size(), 16);
  const Finished again = understudy({"run", path, "--seed", "5", "--filter", id});
  EXPECT_NE(again.output.find("0 passed, 1 failed"), std::string::npos) << again.output << again.errors;
}

}  // namespace hunt_files_test
}  // namespace understudy::acceptance
