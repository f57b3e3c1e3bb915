// Automatic homing: from before, on and after each switch to the same pulse, and how it fails (6, 4.8).
#include <gtest/gtest.h>

#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace homing_test {

/// The home switch from -200 to 200, near home up to 1500, limits at -5000 and 5000, an index each 2000.
struct HomingRsm : OneRsm {
  explicit HomingRsm(std::int64_t from) : OneRsm({.plant = {{0, machine(from)}}}) {
    send({"RSM_SET_SV X 100", "RSM_SET_V X 10000", "RSM_SET_A X 100000", "RSM_SET_HV X 500",
          "RSM_SET_AO X 0"});
    run(5);
  }
  static world::PlantSetup machine(std::int64_t from) {
    world::PlantSetup plant;
    plant.position_pulses = from;
    plant.home = world::PulseSpan{-200, 200};
    plant.near_home = world::SwitchSetup{.on = {-3000, 1500}};
    plant.lower_limit = -5000;
    plant.upper_limit = 5000;
    plant.index = world::IndexSetup{.at = 700, .width = 20, .period = 2000};
    return plant;
  }
  std::int64_t place() { return world().plant(0, 0).save().position_pulses; }
  /// Homes, and returns the states that were shown, in order.
  std::vector<Value> home() {
    std::vector<Value> states;
    send("RSM_HOME_START X");
    for (int i = 0; i < 100000; ++i) {
      const Value now = get("HOME_STATE_X");
      if (states.empty() || states.back() != now) states.push_back(now);
      if (get("DRIVING_AXIS") == 0) break;
      run(1);
    }
    run(2);
    return states;
  }
};

TEST(RsM8194hHoming, EndsAtOnePulseFromWhereverItBegins) {
  // The example 2,2,1,1;3500: near home and home to the left, the index and the offset to the right.
  std::int64_t end = 0;
  for (const std::int64_t from : {4000, 1400, 250, 200, 0, -200, -250, -2900, -4000, -5000}) {
    HomingRsm rsm(from);
    rsm.send("RSM_SET_HOME_MODE X 2 2 1 1 3500");
    const std::vector<Value> states = rsm.home();
    EXPECT_EQ(rsm.get("INT_HMEND"), 1) << from;
    EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0) << from;
    if (from == 4000) {
      end = rsm.place();
      EXPECT_EQ(states, (std::vector<Value>{3, 15, 20, 25, 0}));
    }
    EXPECT_EQ(rsm.place(), end) << from;
  }
  EXPECT_EQ(end, 700 + 3500);
}

TEST(RsM8194hHoming, StepsThatAreLeftOutTakeNoTime) {
  HomingRsm rsm(0);
  rsm.send("RSM_HOME_START X");
  rsm.run(2);
  EXPECT_EQ(rsm.get("INT_HMEND"), 1);
  EXPECT_EQ(rsm.get("LP_X"), 0);
}

TEST(RsM8194hHoming, AnIndexThatIsOnAlreadyFailsWithBit7) {
  HomingRsm rsm(710);
  rsm.send("RSM_SET_HOME_MODE X 0 0 1 1 100");
  rsm.home();
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x80);
  EXPECT_EQ(rsm.get("INT_HMEND"), 0);
  EXPECT_EQ(rsm.place(), 710);
}

TEST(RsM8194hHoming, ALimitInStep4FailsWithItsBit) {
  HomingRsm rsm(4000);
  rsm.send("RSM_SET_HOME_MODE X 0 0 0 1 3500");
  rsm.home();
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 4);
  EXPECT_EQ(rsm.get("INT_HMEND"), 0);
  EXPECT_EQ(rsm.place(), 5000);
}

TEST(RsM8194hHoming, TheLimitMayBeTheHomeSwitch) {
  HomingRsm rsm(1000);
  rsm.send({"RSM_HOME_LIMIT X 1", "RSM_SET_HOME_MODE X 0 1 0 2 1000"});
  rsm.home();
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0);
  EXPECT_EQ(rsm.place(), 4000);
}

TEST(RsM8194hHoming, NewSpeedsCountFromTheNextPhaseOn) {
  HomingRsm rsm(4000);
  rsm.send({"RSM_SET_HOME_MODE X 2 2 1 1 3500", "RSM_HOME_START X"});
  rsm.run(250);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 3);
  rsm.send({"RSM_SET_V X 2000", "RSM_SET_HV X 250"});
  EXPECT_GT(rsm.get("CV_X"), 9000);
  while (rsm.get("HOME_STATE_X") == 3) rsm.run(1);
  rsm.run(100);
  EXPECT_EQ(rsm.get("CV_X"), 250);
}

TEST(RsM8194hHoming, AStopLeavesItsLockAndNoHome) {
  HomingRsm rsm(4000);
  rsm.send({"RSM_SET_HOME_MODE X 2 2 1 1 3500", "RSM_HOME_START X"});
  rsm.run(100);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 3);
  rsm.send("RSM_STOP_SLOWLY X");
  rsm.run(300);
  EXPECT_EQ(rsm.get("HOME_STATE_X"), 0);
  EXPECT_EQ(rsm.get("ERROR_CODE_X"), 0x100);
  EXPECT_EQ(rsm.get("INT_HMEND"), 0);
}

}  // namespace homing_test
}  // namespace understudy::emulator::models::rs_m8194h
