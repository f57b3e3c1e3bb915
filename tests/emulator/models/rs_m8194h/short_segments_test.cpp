// Streams whose segments are shorter than a millisecond of travel: they never stop while they get segments,
// and are never more than half a pulse off their path (7.4.3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace short_segments_test {

struct Zigzag {
  int across;  // pulses of each segment in X; Y moves the same distance up and down
  int pps;     // along the path
};
const Zigzag kZigzags[] = {{1, 1000},    {3, 10000},   {3, 20000},   {7, 50000},
                           {20, 100000}, {40, 100000}, {200, 100000}};

/// The value of the zigzag at a place in X.
double height(const Zigzag& shape, double x) {
  const double in_round = std::fmod(x, 2.0 * shape.across);
  return std::min(in_round, 2.0 * shape.across - in_round);
}

TEST(RsM8194hShortSegments, AreJoinedWithoutAStop) {
  for (const Zigzag& shape : kZigzags) {
    SCOPED_TRACE(std::to_string(shape.across) + " at " + std::to_string(shape.pps));
    constexpr int kRounds = 100;
    const std::string side = std::to_string(shape.across);
    OneRsm rsm(
        {.program = "MP 156\nRSM_MACRO_SET_MAX_V XY 800000\nRSM_MACRO_MIX_2D_INITIAL X Y 0 " +
                    std::to_string(shape.pps) + " " + std::to_string(shape.pps) + " 1000000\nRSM_MACRO_FOR " +
                    std::to_string(kRounds) + "\nRSM_MACRO_MIX_2D_CONTINUE 0 1 0 0 " + side + " " + side +
                    "\nRSM_MACRO_MIX_2D_CONTINUE 0 1 0 0 " + side + " -" + side +
                    "\nRSM_MACRO_NEXT\nRSM_MACRO_MIX_2D_CONTINUE 1 1 0 0 " + side + " " + side + "\nEND\n"});
    rsm.set("CALL_MP", 156);
    while (rsm.get("DRIVING_AXIS") == 0 && rsm.now() < 100) rsm.run(1);
    const Tick begin = rsm.now();
    while (rsm.get("DRIVING_AXIS") != 0 && rsm.now() < begin + 100'000) {
      const auto x = static_cast<double>(rsm.get("LP_X"));
      const auto y = static_cast<double>(rsm.get("LP_Y"));
      // Within half a pulse, in each coordinate, of some point of the path.
      double off = 1e9;
      for (int step = -10; step <= 10; ++step) {
        off = std::min(off, std::abs(y - height(shape, std::max(x + 0.05 * step, 0.0))));
      }
      constexpr double kOfTheSteps = 0.03;
      ASSERT_LE(off, 0.5 + kOfTheSteps) << x << " " << y;
      rsm.run(1);
    }
    const double length = (2.0 * kRounds + 1) * shape.across * std::sqrt(2.0);
    EXPECT_EQ(rsm.now() - begin, static_cast<Tick>(std::ceil(length * 1000 / shape.pps - 1e-6)) + 1);
    EXPECT_EQ(rsm.get("LP_X"), (2 * kRounds + 1) * shape.across);
    EXPECT_EQ(rsm.get("LP_Y"), shape.across);
    EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 0);
  }
}

TEST(RsM8194hShortSegments, StarveWhenNobodyFeedsThem) {
  OneRsm rsm;
  rsm.send({"RSM_LINE_2D_INITIAL X Y 20000 20000 100000"});
  for (int i = 0; i < 6; ++i) rsm.send("RSM_LINE_2D_CONTINUE 0 5 0");
  rsm.run(100);
  EXPECT_EQ(rsm.get("LP_X"), 30);
  EXPECT_EQ(rsm.get("Continuous_Inp_Interrupt"), 1);
  EXPECT_EQ(rsm.get("InterpolationRdyFlag"), 1);
}

}  // namespace short_segments_test
}  // namespace understudy::emulator::models::rs_m8194h
