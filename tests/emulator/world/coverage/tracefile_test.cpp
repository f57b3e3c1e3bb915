// Tracefiles: what was written is read back, and anything else is refused.
#include "emulator/world/coverage/tracefile.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "base/files/file_error.h"
#include "emulator/world/coverage/coverage_report.h"

namespace understudy::emulator::world {
namespace tracefile_test {

CoverageReport random_report(std::mt19937& random) {
  CoverageReport report;
  const auto count = [&] { return static_cast<std::int64_t>(random() % 3); };
  for (int i = 0; i < 30; ++i) {
    const std::string path = "p" + std::to_string(random() % 3) + ".lst";
    CoveredLine& line = report.files[path].lines[1 + static_cast<int>(random() % 9)];
    line.add({.runs = count(), .decides = line.decides || random() % 2 == 0});
    if (line.decides) line.add({.runs = 0, .decides = true, .yes = count(), .no = count()});
  }
  return report;
}

TEST(Tracefile, IsReadBackAsItWasWritten) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const CoverageReport report = random_report(random);
    EXPECT_EQ(read_tracefile(lcov_text(report), "c.info"), report) << lcov_text(report);
  }
}

TEST(Tracefile, OfASumIsTheSumOfTracefiles) {
  std::mt19937 random(4);
  const CoverageReport one = random_report(random);
  const CoverageReport other = random_report(random);
  CoverageReport sum = one;
  sum.add(other);
  // A file may also appear twice.
  EXPECT_EQ(read_tracefile(lcov_text(one) + lcov_text(other), "c.info"), sum);
}

TEST(Tracefile, ThatIsWrongIsRefusedWithItsLine) {
  struct Case {
    const char* text;
    const char* message;
  };
  constexpr Case kCases[] = {
      {"hello\n",
       "c.info:1: 'hello' is not understood; expected a line of a tracefile that --coverage has written"},
      {"DA:1,2\n", "c.info:1: '1,2' is not understood; expected SF: with a path before it"},
      {"SF:\n", "c.info:1: 'SF:' is not understood; expected a path after it"},
      {"SF:a\nSF:b\n", "c.info:2: 'SF:' is not understood; expected end_of_record before the next file"},
      {"TN:\nSF:a\nDA:0,2\n", "c.info:3: '0,2' is not understood; expected a line's number"},
      {"SF:a\nDA:1,-2\n", "c.info:2: '1,-2' is not understood; expected a count"},
      {"SF:a\nDA:1\n", "c.info:2: '1' is not understood; expected DA:LINE,COUNT"},
      {"SF:a\nBRDA:1,0,2,1\n",
       "c.info:2: '1,0,2,1' is not understood; expected BRDA:LINE,0,BRANCH,COUNT with branch 0 or 1"},
      {"SF:a\nDA:1,1\n", "c.info:2: the file ends too early; expected end_of_record"},
      {"end_of_record\n", "c.info:1: 'end_of_record' is not understood; expected SF: with a path before it"},
  };
  for (const Case& one : kCases) {
    try {
      read_tracefile(one.text, "c.info");
      ADD_FAILURE() << one.text;
    } catch (const FileError& error) {
      EXPECT_STREQ(error.what(), one.message);
    }
  }
}

}  // namespace tracefile_test
}  // namespace understudy::emulator::world
