// The data that a tick of a Simple2-R3 reads lies on few cache lines, and data that it skips is read when it
// has changed.
#include <gtest/gtest.h>

#include <set>

#include "emulator/models/simple2_r3/device.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {
namespace tick_memory_test {

/// How many cache lines some objects lie on, each with its last byte.
class CacheLines {
 public:
  template <typename... T>
  explicit CacheLines(const T&... objects) {
    (add(&objects, sizeof objects), ...);
  }
  std::size_t count() const { return lines_.size(); }

 private:
  void add(const void* object, std::size_t bytes) {
    constexpr std::uintptr_t kLine = 64;
    const auto first = reinterpret_cast<std::uintptr_t>(object);
    lines_.insert(first / kLine);
    lines_.insert((first + bytes - 1) / kLine);
  }

  std::set<std::uintptr_t> lines_;
};

const State& state_of(OneSimple2& one) { return static_cast<Simple2R3&>(one.device()).state(); }

TEST(Simple2TickMemory, OfTheDeviceIsOneLine) {
  OneSimple2 one;
  const State& state = state_of(one);
  const auto* const done_at = reinterpret_cast<const Tick*>(&state.eeprom);  // its first field
  EXPECT_EQ(*done_at, state.eeprom.next_active_tick());
  const CacheLines lines(state.touched, state.inputs, state.written_outputs, state.adc, state.first_tick,
                         state.execution, *done_at);
  EXPECT_EQ(lines.count(), 1u);
}

TEST(Simple2TickMemory, OfItsSetupIsOneLine) {
  OneSimple2 one;
  const auto& setup = static_cast<Simple2R3&>(one.device()).setup();
  EXPECT_EQ(CacheLines(setup.dialect, setup.motion_first, setup.timer_unit).count(), 1u);
}

TEST(Simple2TickMemory, OfAnAxisIsThreeLines) {
  OneSimple2 one;
  for (const AxisState& axis : state_of(one).axes) {
    const motion::Axis& motor = axis.motor;
    const CacheLines of_motor(motor.travel_pulses, motor.watch_low, motor.watch_high, motor.base_pulses,
                              motor.seen_version, motor.events, motor.must_recheck, motor.task,
                              motor.servo_on, motor.drive.now, motor.drive.begin_tick, motor.drive.next_check,
                              motor.drive.sent_pulses, motor.drive.direction);
    EXPECT_EQ(of_motor.count(), 2u);
    const CacheLines of_the_rest(axis.mode, axis.command, axis.coordinate_pulses, axis.pulses_this_tick,
                                 axis.alarm_clear_until, axis.encoder_raw, axis.encoder_counts,
                                 axis.encoder_changed, axis.signals.version, axis.signals.steady);
    EXPECT_EQ(of_the_rest.count(), 1u);
  }
}

TEST(Simple2TickMemory, InputsOfARestoredStateAreSeen) {
  OneSimple2 saved;
  saved.run(5);
  saved.device().set_input(10, 1);  // no tick has sampled it yet
  saved.device().set_input(kFirstAnalog, 5000);
  const auto bytes = saved.device().save_state();
  OneSimple2 other;
  other.run(5);
  other.device().restore_state(bytes);
  EXPECT_EQ(other.get("DIN_10"), 0);
  other.run(1);
  saved.run(1);
  EXPECT_EQ(other.get("DIN_10"), 1);
  EXPECT_NE(other.get("ADC_A"), 0);
  EXPECT_TRUE(same_state(other.device(), saved.device()));
}

TEST(Simple2TickMemory, InputsHeldOverPowerOffAreSeen) {
  OneSimple2 one;
  one.world().set_external_input(0, 10, 1);
  one.run(3);
  EXPECT_EQ(one.get("DIN_10"), 1);
  one.world().switch_power(0, false);
  one.run(3);
  one.world().switch_power(0, true);
  one.run(3);
  EXPECT_EQ(one.get("DIN_10"), 1);
}

}  // namespace tick_memory_test
}  // namespace understudy::emulator::models::simple2_r3
