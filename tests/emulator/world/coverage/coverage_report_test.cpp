// Reports of coverage as files, and their sums.
#include "emulator/world/coverage/coverage_report.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "emulator/device/user_program.h"
#include "emulator/models/models.h"
#include "emulator/world/bench_file/bench_file.h"
#include "emulator/world/coverage/program_coverage.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {
namespace coverage_report_test {

CoverageReport small_report() {
  CoverageReport report;
  report.files["cell/a&b.lst"].lines = {{2, {.runs = 3, .decides = true, .yes = 0, .no = 3}},
                                        {5, {.runs = 0}}};
  report.files["z.lst"].lines = {{1, {.runs = 0, .decides = true}}};
  return report;
}

TEST(CoverageReport, IsATracefileOfLcov) {
  EXPECT_EQ(lcov_text(small_report()),
            "TN:\nSF:cell/a&b.lst\nBRDA:2,0,0,0\nBRDA:2,0,1,3\nBRF:2\nBRH:1\nDA:2,3\nDA:5,0\nLF:2\nLH:1\n"
            "end_of_record\n"
            "TN:\nSF:z.lst\nBRDA:1,0,0,-\nBRDA:1,0,1,-\nBRF:2\nBRH:0\nDA:1,0\nLF:1\nLH:0\nend_of_record\n");
}

TEST(CoverageReport, IsXmlOfCobertura) {
  const std::string text = cobertura_text(small_report());
  for (const char* piece :
       {"<coverage line-rate=\"0.3333\" branch-rate=\"0.2500\" complexity=\"0\" lines-covered=\"1\" "
        "lines-valid=\"3\" branches-covered=\"1\" branches-valid=\"4\"",
        "filename=\"cell/a&amp;b.lst\" line-rate=\"0.5000\" branch-rate=\"0.5000\"",
        "<line number=\"2\" hits=\"3\" branch=\"true\" condition-coverage=\"50% (1/2)\"/>",
        "<line number=\"5\" hits=\"0\" branch=\"false\"/>",
        "<line number=\"1\" hits=\"0\" branch=\"true\" condition-coverage=\"0% (0/2)\"/>"}) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  }
}

TEST(CoverageReport, AddsUpInAnyOrder) {
  std::mt19937 random(7);
  CoverageReport parts[3];
  for (CoverageReport& part : parts) {
    for (int i = 0; i < 40; ++i) {
      CoveredLine& line =
          part.files["p" + std::to_string(random() % 3)].lines[static_cast<int>(random() % 9)];
      line.runs += static_cast<std::int64_t>(random() % 3);
      line.yes += static_cast<std::int64_t>(random() % 2);
    }
  }
  CoverageReport one;
  for (const int i : {0, 1, 2}) one.add(parts[i]);
  CoverageReport other;
  for (const int i : {2, 0, 1}) other.add(parts[i]);
  EXPECT_EQ(one, other);
  std::int64_t runs = 0;
  for (const CoverageReport& part : parts) {
    for (const auto& [path, file] : part.files) {
      for (const auto& [number, line] : file.lines) runs += line.runs;
    }
  }
  for (const auto& [path, file] : one.files) {
    for (const auto& [number, line] : file.lines) runs -= line.runs;
  }
  EXPECT_EQ(runs, 0);
}

/// A device that runs the same instructions as a file, however else the file looks.
TEST(ProgramCoverage, CountsForTheFileWithTheSameInstructions) {
  const std::string bench =
      "understudy: 1\nlines: { a: { stations: [ { name: m, model: simple2-r3, set: { AutoStart_MainProg: 1 "
      "}, "
      "program: \"again:  Out DOUT_1 ON\\nJump_IN_ON again DIN_3\\nEND\\nNOP\\n\" } ] } }\n";
  World world(parse_bench(models::all_models(), bench, "cell.yaml", "."), {}, {});
  ProgramCoverage coverage(world);
  world.switch_power(0, false);
  world.switch_power(0, true);
  world.advance_to(std::chrono::seconds(1));
  const ProgramSource same{"cell/feed.lst",
                           "; feeds\nJMP1: out dout_1, on\n\n    jump_in_on JMP1 din_3\n    END\n"};
  const ProgramSource other{"cell/other.lst", "JMP1: Out DOUT_2 ON\nJump_IN_ON JMP1 DIN_3\nEND\n"};
  const CoverageReport report = coverage.report({other, same});
  ASSERT_EQ(report.files.size(), 1U) << lcov_text(report);
  EXPECT_EQ(report.files.begin()->first, "cell/feed.lst");
  EXPECT_EQ(report.files.begin()->second.lines,
            (CoveredLines{{2, {.runs = 1}}, {4, {.runs = 1, .decides = true, .no = 1}}, {5, {.runs = 1}}}));

  const ProgramSource twin{"cell/twin.lst", same.text};
  EXPECT_EQ(coverage.report({same, twin}).files.size(), 1U) << "the device has run only one of them";

  const CoverageReport alone = coverage.report();
  ASSERT_EQ(alone.files.size(), 1U);
  EXPECT_TRUE(alone.files.begin()->first.starts_with("simple2-r3-"));
  EXPECT_EQ(alone.files.begin()->second.listing, world.device(0).user_program()->program_text());
  EXPECT_EQ(alone.totals(), report.totals());
}

}  // namespace coverage_report_test
}  // namespace understudy::emulator::world
