// --coverage: the files that `run`, `serve` and `exec` write, read by lcov and genhtml.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace coverage_test {

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A bench with a program, and two scenarios that run different lines of it.
class Project {
 public:
  Project() {
    folder.write(
        "feed.lst",
        "wait:   Wait_IO DIN_3 ON\n        Jump_IN_ON twice DIN_4\n        Out DOUT_1 ON\n        END\n"
        "twice:  Out DOUT_2 ON\n        END\n");
    folder.write(
        "bench.yaml",
        "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3, program: feed.lst } "
        "] } }\n");
    scenario("one.yaml", "");
    scenario("two.yaml", "  - input: { feeder.DIN_4: on }\n");
  }

  Finished sh(const std::string& script) const {
    return run({"sh", "-c", "cd " + folder.path() + "\n" + script}, {{"UNDERSTUDY", UNDERSTUDY_BINARY}});
  }
  std::string file(const std::string& name) const { return text_of(folder / name); }

  PrivateFolder folder;

 private:
  void scenario(const std::string& name, const std::string& step) const {
    folder.write(name, "understudy: 1\nbench: bench.yaml\nsteps:\n" + step +
                           "  - write: { feeder.PROG_MAIN_RunTime_START: 0 }\n  - advance: 100ms\n"
                           "  - input: { feeder.DIN_3: on }\n  - advance: 100ms\n");
  }
};

TEST(Coverage, NamesTheLinesThatHaveRun) {
  const Project project;
  const Finished finished = project.sh("$UNDERSTUDY run one.yaml --coverage c.info");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("coverage of programs: 4 of 6 lines (66.7 %), 2 of 4 branches (50.0 %)\n"),
            std::string::npos)
      << finished.output;
  EXPECT_EQ(project.file("c.info"),
            "TN:\nSF:feed.lst\nBRDA:1,0,0,0\nBRDA:1,0,1,1\nBRDA:2,0,0,0\nBRDA:2,0,1,1\nBRF:4\nBRH:2\n"
            "DA:1,1\nDA:2,1\nDA:3,1\nDA:4,1\nDA:5,0\nDA:6,0\nLF:6\nLH:4\nend_of_record\n");
}

TEST(Coverage, AddsUpWhoeverRunsTheScenarios) {
  const Project project;
  EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml two.yaml --jobs 1 --coverage one_job.xml").exit_code, 0);
  EXPECT_EQ(project.sh("$UNDERSTUDY run two.yaml one.yaml --jobs 4 --coverage jobs.xml").exit_code, 0);
  EXPECT_EQ(project.file("one_job.xml"), project.file("jobs.xml"));
  EXPECT_NE(project.file("jobs.xml").find("lines-covered=\"6\" lines-valid=\"6\" branches-covered=\"3\""),
            std::string::npos)
      << project.file("jobs.xml");
}

TEST(Coverage, LessThanTheMinimumFails) {
  const Project project;
  EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml --coverage-min 66").exit_code, 0);
  const Finished finished = project.sh("$UNDERSTUDY run one.yaml --coverage-min 67");
  EXPECT_EQ(finished.exit_code, 1);
  EXPECT_NE(finished.output.find("; expected at least 67 % of the lines\n"), std::string::npos)
      << finished.output;
  for (const char* wrong : {"--coverage c.txt", "--coverage-min 101", "--coverage feed.lst",
                            "--coverage c.info --results r.jsonl --resume"}) {
    EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml " + std::string(wrong)).exit_code, 2) << wrong;
  }
}

TEST(Coverage, AProgramWithoutAFileIsListedBesideTheReport) {
  const Project project;
  const std::string inline_program = project.file("bench.yaml");
  project.folder.write("bench.yaml",
                       "understudy: 1\nlines: { a: { stations: [ { name: feeder, model: simple2-r3, "
                       "program: \"NOP\\nOut DOUT_1 ON\\nEND\\n\" } ] } }\n");
  EXPECT_EQ(project.sh("mkdir out; $UNDERSTUDY run one.yaml --coverage out/c.info").exit_code, 0);
  const std::string report = project.file("out/c.info");
  const std::size_t begin = report.find("SF:") + 3;
  const std::string name = report.substr(begin, report.find('\n', begin) - begin);
  EXPECT_TRUE(name.starts_with("out/simple2-r3-")) << report;
  EXPECT_NE(project.file(name).find("Out DOUT_1 ON"), std::string::npos) << name;
}

TEST(Coverage, ExecWritesItAtItsEnd) {
  const Project project;
  const Finished finished = project.sh(
      "$UNDERSTUDY exec bench.yaml --speed manual --coverage c.info -- "
      "sh -c '$UNDERSTUDY ctl set feeder.PROG_MAIN_RunTime_START=0 && $UNDERSTUDY ctl advance 50ms'");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(project.file("c.info").find("DA:1,1\nDA:2,0\n"), std::string::npos) << project.file("c.info");
}

TEST(Coverage, LcovAddsShardsToWhatOneRunSays) {
  if (run({"lcov", "--version"}).exit_code != 0) GTEST_SKIP() << "lcov is not installed";
  const Project project;
  const Finished finished = project.sh(
      "set -e\n"
      "$UNDERSTUDY run one.yaml two.yaml --coverage all.info\n"
      "$UNDERSTUDY run one.yaml two.yaml --shard 1/2 --coverage a.info\n"
      "$UNDERSTUDY run one.yaml two.yaml --shard 2/2 --coverage b.info\n"
      "lcov --rc lcov_branch_coverage=1 -a all.info -o one.info\n"
      "lcov --rc lcov_branch_coverage=1 -a a.info -a b.info -o sum.info\n"
      "genhtml --branch-coverage -o page all.info\n");
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(project.file("sum.info"), project.file("one.info"));
  EXPECT_NE(project.file("sum.info").find("DA:1,2\n"), std::string::npos) << project.file("sum.info");
  EXPECT_NE(finished.output.find("lines......: 100.0% (6 of 6 lines)"), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find("branches...: 75.0% (3 of 4 branches)"), std::string::npos)
      << finished.output;
}

TEST(Coverage, OwnSumIsWhatOneRunSays) {
  const Project project;
  const Finished finished = project.sh(
      "set -e\n"
      "$UNDERSTUDY run one.yaml two.yaml --coverage all.info\n"
      "$UNDERSTUDY run one.yaml two.yaml --shard 1/2 --coverage a.info\n"
      "$UNDERSTUDY run one.yaml two.yaml --shard 2/2 --coverage b.info\n"
      "$UNDERSTUDY coverage a.info b.info --output sum.info\n"
      "$UNDERSTUDY coverage a.info b.info --output sum.html --coverage-min 100\n");
  EXPECT_EQ(finished.exit_code, 0) << finished.output << finished.errors;
  EXPECT_EQ(project.file("sum.info"), project.file("all.info"));
  EXPECT_NE(project.file("sum.html").find("6 of 6 lines (100.0 %), 3 of 4 branches (75.0 %)"),
            std::string::npos);
  EXPECT_EQ(project.sh("$UNDERSTUDY coverage a.info --coverage-min 90").exit_code, 1);
}

TEST(Coverage, SumOfWhatIsNoTracefileIsRefused) {
  const Project project;
  project.folder.write("broken.info", "TN:\nSF:feed.lst\nDA:one,1\n");
  struct Case {
    const char* words;
    const char* errors;
  };
  constexpr Case kCases[] = {
      {"broken.info", "broken.info:3: 'one,1' is not understood; expected a line's number\n"},
      {"bench.yaml", "bench.yaml: is a bench; expected a coverage file\n"},
      {"bench.yaml -o unwritten.info", "bench.yaml: is a bench; expected a coverage file\n"},
      {"broken.info --coverage-min most",
       "understudy: --coverage-min: 'most' is not a number; expected a number\n"},
      {"none.info",
       "none.info: cannot be read (No such file or directory); expected a tracefile (FILE.info)\n"},
      {"broken.info -o broken.info",
       "understudy: --output: broken.info: is a file to add; expected another path\n"},
      {"broken.info -o sum.txt",
       "understudy: --output: sum.txt has an unknown format; expected FILE.info (lcov), FILE.xml "
       "(Cobertura) or FILE.html (a page)\n"},
  };
  for (const Case& one : kCases) {
    const Finished finished = project.sh("$UNDERSTUDY coverage " + std::string(one.words));
    EXPECT_EQ(finished.exit_code, 2) << one.words;
    EXPECT_EQ(finished.errors, one.errors) << one.words;
  }
  EXPECT_EQ(project.sh("test -e unwritten.info").exit_code, 1) << "a refused sum leaves no file";
}

TEST(Coverage, IsPartOfTheReportPage) {
  const Project project;
  EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml --report r.html --coverage c.html").exit_code, 0);
  for (const char* page : {"r.html", "c.html"}) {
    EXPECT_NE(project.file(page).find("<tr class=\"missed\"><td class=\"time dim\">5</td>"),
              std::string::npos)
        << page;
  }
}

TEST(Coverage, OfARunningServeIsShownAndWritten) {
  const Project project;
  const Finished finished = project.sh(
      "$UNDERSTUDY exec bench.yaml --speed manual -- sh -ec '"
      "$UNDERSTUDY ctl coverage\n"
      "$UNDERSTUDY ctl set feeder.PROG_MAIN_RunTime_START=0\n$UNDERSTUDY ctl advance 50ms\n"
      "$UNDERSTUDY ctl coverage feeder --output c.info\n"
      "$UNDERSTUDY ctl coverage\n$UNDERSTUDY ctl coverage again'");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  const auto line = [](int lines, const char* percent, int branches, const char* of, const char* left) {
    return "feed.lst: " + std::to_string(lines) + " of 6 lines (" + percent + " %), " +
           std::to_string(branches) + " of 4 branches (" + of + " %); not run: " + left + "\n";
  };
  EXPECT_NE(finished.output.find(line(0, "0.0", 0, "0.0", "1-6")), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find(line(1, "16.7", 1, "25.0", "2-6")), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find("since 50ms: 0 of 6 lines"), std::string::npos) << finished.output;
  EXPECT_NE(project.file("c.info").find("DA:1,1\nDA:2,0\n"), std::string::npos) << project.file("c.info");
}

TEST(DeviceCoverage, TellsWhatNoTestHasTouched) {
  const Project project;
  const Finished finished = project.sh("$UNDERSTUDY run one.yaml two.yaml --device-coverage d.json");
  EXPECT_EQ(finished.exit_code, 0) << finished.errors;
  EXPECT_NE(finished.output.find("\ncoverage of simple2-r3: bits "), std::string::npos) << finished.output;
  EXPECT_NE(finished.output.find("\n  simple2-r3: bits: STATUS.A_alarm: never read as 1\n"),
            std::string::npos)
      << finished.output;
  EXPECT_NE(project.file("d.json").find("\"kind\": \"device-coverage\""), std::string::npos);
  // The file can be written again, and it is the same, no matter what runs the cases.
  const std::string first = project.file("d.json");
  EXPECT_EQ(project.sh("$UNDERSTUDY run two.yaml one.yaml --jobs 3 --device-coverage d.json").exit_code, 0);
  EXPECT_EQ(project.file("d.json"), first);
  EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml --device-coverage d.html").exit_code, 0);
  EXPECT_NE(project.file("d.html").find("Never used, largest gaps first"), std::string::npos);
  EXPECT_EQ(project.sh("$UNDERSTUDY run one.yaml --device-coverage d.info").exit_code, 2);
}

}  // namespace coverage_test
}  // namespace understudy::acceptance
