// The page on coverage, and the page on what was touched.
#include "emulator/play/report/coverage_page.h"

#include <gtest/gtest.h>

#include <string>

#include "emulator/play/report/touched_page.h"
#include "emulator/world/coverage/coverage_report.h"
#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::play {
namespace coverage_page_test {

TEST(CoveragePage, ShowsEachLineWithItsCounts) {
  world::CoverageReport report;
  world::CoveredFile& file = report.files["m-1.lst"];
  file.listing = "; <feeds>\nWait_IO DIN_3 ON\nOut DOUT_1 ON\n";
  file.lines = {{2, {.runs = 3, .decides = true, .yes = 0, .no = 3}}, {3, {.runs = 0}}, {9, {.runs = 7}}};
  report.files["a.lst"].lines = {{1, {.runs = 1}}};
  const std::string page = coverage_page(report, "1.2");
  for (const char* piece :
       {"Programs: 3 of 4 lines (75.0 %), 1 of 2 branches (50.0 %)", "<code>; &lt;feeds&gt;</code>",
        "<td class=\"time\">3</td><td class=\"outcomes\"><span class=\"bad\">yes 0</span>, <span>no 3</span>",
        "<tr class=\"missed\"><td class=\"time dim\">3</td><td class=\"time\">0</td>",
        // The text of the file is shorter than its counts.
        "<td class=\"time dim\">9</td><td class=\"time\">7</td>", "understudy 1.2"}) {
    EXPECT_NE(page.find(piece), std::string::npos) << piece << "\n" << page;
  }
  EXPECT_LT(page.find(">m-1.lst<"), page.find(">a.lst<")) << "the program with more left comes first";
}

TEST(CoveragePage, SaysThatThereIsNoProgram) {
  EXPECT_NE(coverage_section({}).find("No device has a program."), std::string::npos);
}

TEST(TouchedPage, BeginsWithWhatWasNeverTouched) {
  world::TouchedReport report;
  report.models["m"] = {{.name = "registers",
                         .columns = {"read", "written"},
                         .rows = {{"<A>", {4, world::kCannotBe}}, {"B", {0, 2}}}}};
  const std::string page = touched_page(report, "1.2");
  EXPECT_NE(page.find("<code>B</code></td><td>never read</td>"), std::string::npos) << page;
  EXPECT_NE(page.find("<code>&lt;A&gt;</code></td><td class=\"time\">4</td><td></td>"), std::string::npos)
      << page;
  EXPECT_EQ(touched_text(report), "coverage of m: registers 2 of 3\n  m: registers: B: never read\n");
  report.models["m"][0].rows[1].counts[0] = 1;
  EXPECT_NE(touched_page(report, "1.2").find("Everything has been used."), std::string::npos);
}

}  // namespace coverage_page_test
}  // namespace understudy::emulator::play
