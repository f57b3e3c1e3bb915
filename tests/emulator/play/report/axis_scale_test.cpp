#include "emulator/play/report/axis_scale.h"

#include <gtest/gtest.h>

namespace understudy::emulator::play {
namespace axis_scale_test {

std::string marks_of(const AxisScale& scale) {
  std::string text;
  for (const double mark : scale.marks)
    text += (text.empty() ? "" : " ") + fixed_number(mark, scale.decimals);
  return text;
}

TEST(AxisScale, HasRoundMarksThatAreFewEnough) {
  struct Case {
    double low;
    double high;
    int max;
    const char* marks;
  };
  for (const Case& c : {
           Case{0, 10, 10, "0 1 2 3 4 5 6 7 8 9 10"},
           Case{0, 10, 5, "0 2 4 6 8 10"},
           Case{0, 4.2, 10, "0.0 0.5 1.0 1.5 2.0 2.5 3.0 3.5 4.0"},
           Case{-20000, 34000, 6, "-20000 -10000 0 10000 20000 30000"},
           Case{0, 10667, 4, "0 5000 10000"},
           Case{3.1, 3.2, 4, "3.10 3.15 3.20"},
           Case{0, 0.001, 2, "0.0000 0.0005 0.0010"},
           Case{999999998, 1000000002, 4, "999999998 999999999 1000000000 1000000001 1000000002"},
       }) {
    EXPECT_EQ(marks_of(exact_scale_for(c.low, c.high, c.max)), c.marks) << c.low << " to " << c.high;
  }
}

TEST(AxisScale, LeavesALittleRoomAndPutsWhatStaysInTheMiddle) {
  const AxisScale scale = scale_for(0, 100, 5);
  EXPECT_EQ(scale.low, -5);
  EXPECT_EQ(scale.high, 105);
  const AxisScale still = scale_for(7, 7, 5);
  EXPECT_EQ(still.low, 6);
  EXPECT_EQ(still.high, 8);
  EXPECT_EQ(marks_of(still), "6 7 8");
}

TEST(AxisScale, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(plain_number(32000), "32000");
  EXPECT_EQ(plain_number(-0.0), "0");
  EXPECT_EQ(plain_number(2147483648.0), "2147483648");
  EXPECT_EQ(plain_number(10666.666666), "10666.67");
  EXPECT_EQ(plain_number(0.012781), "0.012781");
  EXPECT_EQ(fixed_number(2.5, 2), "2.50");
  EXPECT_EQ(fixed_number(-0.001, 2), "0.00");
  EXPECT_EQ(fixed_number(-0.006, 2), "-0.01");
}

}  // namespace axis_scale_test
}  // namespace understudy::emulator::play
