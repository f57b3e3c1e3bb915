// Homing and moves on machines whose switches have broken wires. The switches themselves work.
//
//   lower limit (DIN_3)      start     home (DIN_4)     upper limit (DIN_2)     stop
//   -200                     0         100 to 119       200                     300
//
// One pulse per millisecond, ramps of 10 ms: n pulses take n + 5 ms from the first tick, and a switch is read
// in the tick after the axis reaches it.
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace broken_switch_test {

constexpr int kUpperLimit = 2;
constexpr int kLowerLimit = 3;
constexpr int kHome = 4;

class Machine : public ReadySimple2 {
 public:
  Machine() : ReadySimple2({.plant = {{0, plant()}}}) {
    for (const char* name : {"DIN2_Aaxis_UP_Limit", "DIN3_Aaxis_DN_Limit", "DIN4_Aaxis_Home"}) set(name, 1);
    set("Axis_GoHome_DIR", 1);
    set("Aaxis_Home_Speed", 20);
    set("Aaxis_Home_AccTime", 1);
    set("Aaxis_Resoultion", 3000);
    run_to(20);
  }
  std::size_t stick(int input, int level) {
    const std::size_t number =
        world().inject({.kind = world::Fault::Kind::stuck, .device = 0, .place = input, .amount = level});
    run_to(30);
    return number;
  }
  std::int64_t place() { return world().plant(0, 0).position_pulses(); }
  bool homed() const { return bit("STATUS.8"); }
  /// Returns how long homing took; -1 if it continues.
  Tick go_home(Tick at_most = 3000) {
    set("Aaxis_GoHome", 1);
    const Tick begin = now() + 1;
    run_while_moving('A', at_most);
    return bit("STATUS.6") ? -1 : now() - begin;
  }

 private:
  static world::PlantSetup plant() {
    world::PlantSetup plant;
    plant.travel = world::PulseSpan{-300, 300};
    plant.home = world::PulseSpan{100, 119};
    plant.lower_limit = -200;
    plant.upper_limit = 200;
    return plant;
  }
};

TEST(BrokenSwitch, HomingGivesUpAtTheSecondLimitIfHomeNeverComesOn) {
  Machine machine;
  const std::size_t stuck = machine.stick(kHome, 0);
  EXPECT_EQ(machine.go_home(), 205 + 405 + 1);
  EXPECT_FALSE(machine.homed());
  EXPECT_EQ(machine.place(), -200);

  // After the repair it is found: the edge at 100, and back to it.
  ASSERT_TRUE(machine.world().clear_fault(stuck));
  EXPECT_GT(machine.go_home(), 0);
  EXPECT_TRUE(machine.homed());
  EXPECT_EQ(machine.place(), 100);
  EXPECT_EQ(machine.coordinate('A'), 0);
}

TEST(BrokenSwitch, HomingGivesUpAtTheLimitIfHomeIsAlwaysOn) {
  Machine machine;
  machine.stick(kHome, 1);
  EXPECT_EQ(machine.go_home(), 205 + 1);
  EXPECT_FALSE(machine.homed());
  EXPECT_EQ(machine.place(), -200);
}

TEST(BrokenSwitch, ALimitThatIsAlwaysOnTurnsHomingAround) {
  Machine machine;
  machine.stick(kUpperLimit, 1);
  EXPECT_EQ(machine.go_home(), 205 + 1);  // the home switch is in the other direction
  EXPECT_FALSE(machine.homed());
  EXPECT_EQ(machine.place(), -200);
}

TEST(BrokenSwitch, WithoutHomeAndLimitHomingRunsOnAgainstTheStop) {
  Machine machine;
  machine.stick(kHome, 0);
  machine.stick(kUpperLimit, 0);
  EXPECT_EQ(machine.go_home(2000), -1);
  EXPECT_EQ(machine.place(), 300);
  EXPECT_EQ(machine.coordinate('A'), machine.place() + machine.world().plant(0, 0).lost_pulses());
  EXPECT_GT(machine.world().plant(0, 0).lost_pulses(), 1000);
  machine.set("Aaxis_STOP", 1);
  EXPECT_FALSE(machine.bit("STATUS.6"));
  EXPECT_FALSE(machine.homed());
}

TEST(BrokenSwitch, ALimitThatBreaksInTheMiddleOfAMoveStopsIt) {
  Machine machine;
  machine.set_one_pulse_a_tick('A', 150);
  machine.set("Aaxis_Move_INC", 1);
  machine.run_to(20 + 51);
  EXPECT_EQ(machine.coordinate('A'), 45);  // t = 50 ms
  const std::size_t broken = machine.world().inject(
      {.kind = world::Fault::Kind::stuck, .device = 0, .place = kUpperLimit, .amount = 1});
  machine.run(1);  // an input is read when the tick begins
  EXPECT_FALSE(machine.moving('A'));
  EXPECT_EQ(machine.coordinate('A'), 45);
  machine.set("Aaxis_Move_INC", 1);
  EXPECT_FALSE(machine.moving('A')) << "that direction is blocked";
  machine.world().clear_fault(broken);
  machine.run(1);
  machine.set("Aaxis_Move_INC", 1);
  EXPECT_TRUE(machine.moving('A'));
}

TEST(BrokenSwitch, ALimitThatNeverComesOnLetsAMoveRunIntoTheStop) {
  Machine machine;
  machine.stick(kLowerLimit, 0);
  machine.set_one_pulse_a_tick('A', -500);
  machine.set("Aaxis_Move_INC", 1);
  machine.run_while_moving('A');
  EXPECT_EQ(machine.coordinate('A'), -500);
  EXPECT_EQ(machine.place(), -300);
  EXPECT_EQ(machine.world().plant(0, 0).lost_pulses(), 200);
  EXPECT_TRUE(machine.world().plant(0, 0).at_lower_limit());
  EXPECT_FALSE(machine.bit("STATUS.14"));
}

}  // namespace broken_switch_test
}  // namespace understudy::emulator::models::simple2_r3
