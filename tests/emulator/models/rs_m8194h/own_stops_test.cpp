// Stops of an axis by its own synchronous action, at full speed: exact to the pulse, and for a path as a
// whole.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace own_stops_test {

/// 4,000 pulses per millisecond.
struct FastRsm : OneRsm {
  explicit FastRsm(const GivenRsm& given = {}) : OneRsm(given) {
    send({"RSM_SET_MAX_V XYZU 4000000", "RSM_SET_SV XYZU 4000000", "RSM_SET_V XYZU 4000000"});
    run(3);
  }
};

TEST(RsM8194hOwnStops, ByAComparatorStopAPathAtItsPulse) {
  for (const Value stop : {1, 2001, 4001, 5001, 17777}) {
    FastRsm rsm;
    rsm.send({"RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VV 2828000"});
    rsm.send("RSM_SET_COMPARE X 0 0 " + std::to_string(stop));
    rsm.send({"RSM_SYNC_ACTION X X 1 6 0 0 0 0 0 0 0 0", "RSM_LINE_2D 40000 20000"});
    rsm.run(50);
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0) << stop;
    EXPECT_EQ(rsm.get("LP_X"), stop);
    // The partner is where the path is: within half a pulse.
    EXPECT_NEAR(static_cast<double>(rsm.get("LP_Y")), static_cast<double>(stop) / 2, 1) << stop;
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  }
}

TEST(RsM8194hOwnStops, ByIn3StopAtItsPulse) {
  // On is the low level: the contact closes with the falling edge, 0x80, and opens with the rising one.
  for (const std::int64_t at : {1, 777, 4000, 9999}) {
    for (const bool rises : {false, true}) {
      world::PlantSetup plant;
      plant.mark = world::SwitchSetup{.on = {at, at + 500}};
      FastRsm rsm({.plant = {{0, plant}}});
      rsm.send(rises ? "RSM_SYNC_ACTION X X 0x40 6 0 0 0 0 0 0 0 0"
                     : "RSM_SYNC_ACTION X X 0x80 6 0 0 0 0 0 0 0 0");
      rsm.send("RSM_FIXED_MOVE X 40000");
      rsm.run(50);
      EXPECT_EQ(rsm.get("LP_X"), rises ? at + 501 : at) << at;
      EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
    }
  }
}

struct Against {
  const char* path;
  std::size_t axis;
  Pin pin;
  int error_x, error_y;  // both 0: it starts
};
const Against kAgainst[] = {
    {"RSM_LINE_2D 100 100", 0, Pin::limit_plus, 4, 0},
    {"RSM_LINE_2D 100 100", 1, Pin::limit_plus, 0, 4},
    {"RSM_LINE_2D -100 100", 0, Pin::limit_plus, 0, 0},
    {"RSM_LINE_2D -100 100", 0, Pin::limit_minus, 8, 0},
    {"RSM_LINE_2D 0 100", 0, Pin::limit_plus, 0, 0},
    {"RSM_CIRCLE_CCW -100 0", 1, Pin::limit_plus, 0, 4},
    {"RSM_CIRCLE_CW -100 0", 1, Pin::limit_plus, 0, 0},
    {"RSM_ARC_CCW 0 100 100 100", 0, Pin::limit_plus, 4, 0},
    {"RSM_ARC_CW 0 100 -100 100", 0, Pin::limit_plus, 0, 0},
};

TEST(RsM8194hOwnStops, APathDoesNotBeginAgainstALimit) {
  for (const Against& each : kAgainst) {
    SCOPED_TRACE(each.path);
    OneRsm rsm;
    rsm.send({"RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VV 10000"});
    rsm.pin(each.axis, each.pin, true);
    rsm.run(5);
    rsm.send(each.path);
    const bool begins = each.error_x == 0 && each.error_y == 0;
    EXPECT_EQ(rsm.get("DRIVING_AXIS"), begins ? 3 : 0);
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), each.error_x);
    EXPECT_EQ(rsm.get("ERROR_CODE_Y"), each.error_y);
    rsm.run(1);
    const bool stands = rsm.positions() == std::vector<Value>{0, 0, 0, 0};
    EXPECT_TRUE(begins || stands);
  }
}

TEST(RsM8194hOwnStops, ASoftLimitOnAnEncoderStopsAPathToo) {
  world::PlantSetup plant;
  plant.encoder_counts_per_revolution = plant.pulses_per_revolution = 100;
  OneRsm rsm({.plant = {{0, plant}}});
  rsm.send({"RSM_SET_SLMT X 500 -1000 1", "RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VV 1000",
            "RSM_LINE_2D 2000 2000"});
  rsm.run(3000);
  EXPECT_EQ(rsm.get("DRIVING_AXIS"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 1);
  EXPECT_EQ(rsm.get("ERROR_CODE_Y"), 0);
  EXPECT_NEAR(static_cast<double>(rsm.get("LP_X")), 501, 2);
  EXPECT_EQ(rsm.get("LP_Y"), rsm.get("LP_X"));
}

TEST(RsM8194hOwnStops, ASoftLimitThatIsJustReachedIsNotWhatStops) {
  struct Case {
    const char* x;
    const char* y;
    const char* path;
    Value error_x, error_y;
  };
  // One pulse beyond X's limit a path ends, without ramps; there Y is at its own limit, or beyond it as well.
  constexpr Case kCases[] = {
      {"RSM_SET_SLMT X 500 -2000 0", "RSM_SET_SLMT Y 501 -2000 0", "RSM_LINE_2D 1000 1000", 1, 0},
      {"RSM_SET_SLMT X 500 -2000 0", "RSM_SET_SLMT Y 500 -2000 0", "RSM_LINE_2D 1000 1000", 1, 1},
      {"RSM_SET_SLMT X 2000 -500 0", "RSM_SET_SLMT Y 2000 -501 0", "RSM_LINE_2D -1000 -1000", 2, 0},
      {"RSM_SET_SLMT X 2000 -500 0", "RSM_SET_SLMT Y 2000 -500 0", "RSM_LINE_2D -1000 -1000", 2, 2},
  };
  for (const Case& each : kCases) {
    OneRsm rsm;
    rsm.send({each.x, each.y, "RSM_AXIS_ASSIGN X Y 0", "RSM_VECTOR_SPEED 0", "RSM_SET_VV 1000", each.path});
    rsm.run(2000);
    EXPECT_EQ(std::abs(rsm.get("LP_X")), 501) << each.path;
    EXPECT_EQ(std::abs(rsm.get("LP_Y")), 501) << each.path;
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), each.error_x) << each.path;
    EXPECT_EQ(rsm.get("ERROR_CODE_Y"), each.error_y) << each.path;
  }
}

}  // namespace own_stops_test
}  // namespace understudy::emulator::models::rs_m8194h
