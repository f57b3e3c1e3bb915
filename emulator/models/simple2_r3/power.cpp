// What happens to all of a Simple2-R3 at once: power-up, power-down, factory reset, erasure.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/slots.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

/// Erase_ALL, Factory_Reset.
Tick rewrite_ticks(const Simple2R3& device) {
  return device.chose(option("eeprom_erasure", "100ms")) ? 100 : 500;
}

interpreter::simple2::FlagRules flag_rules_of(const Simple2R3& device) {
  using Rules = interpreter::simple2::FlagRules;
  Rules rules;
  if (device.chose(option("same_flag_twice", "last_written"))) rules.several = Rules::Several::last_written;
  if (device.chose(option("flags_after_end", "does_not_count")))
    rules.after_end = Rules::AfterEnd::do_not_count;
  if (device.chose(option("flags_found", "at_start"))) rules.found = Rules::Found::when_told;
  return rules;
}

}  // namespace

void Simple2R3::blank_state() {
  State blank;
  blank.eeprom = std::move(state_.eeprom);
  for (std::size_t i = 0; i < blank.axes.size(); ++i) {
    blank.axes[i].encoder_raw = state_.axes[i].encoder_raw;
  }
  state_ = std::move(blank);
}

void Simple2R3::power_down() {
  const bool ends_first = state_.eeprom.writing() && chose(option("power_cut", "new_value"));
  if (ends_first) state_.eeprom.step(state_.eeprom.next_active_tick(), state_.image);
  state_.eeprom.lose_power();
  const std::uint8_t switches = state_.switches;
  blank_state();
  state_.switches = switches;  // the line keeps its speed meanwhile
}

void Simple2R3::power_up() {
  blank_state();
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = keeps(row) ? state_.eeprom.kept()[slot] : factory_bits(row);
  });
  for (std::size_t i = 0; i < kAssignmentCount; ++i) {
    if (state_.image[kFirstAssignment + i] != 0) state_.assignments |= static_cast<std::uint16_t>(1U << i);
  }
  state_.first_tick = now() + 1 + boot_ticks_;
  state_.switches = switch_levels();
  reset_timers();
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  state_.program = interpreter::simple2::Program({}, flag_rules_of(*this));
  reload_program();
  find_flags_if_told();

  motion::AxisSettings motor;
  const auto reaction_to = [&](motion::Signal signal) {
    return ignores(signal) ? motion::Reaction::ignore : motion::Reaction::stop_at_once;
  };
  motor.at_limit_plus = motor.at_limit_minus = reaction_to(motion::Signal::limit_plus);
  motor.at_alarm = reaction_to(motion::Signal::alarm);
  for (int i = 0; i < 2; ++i) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(i)];
    motor.needs_servo = servo_matters(i);
    axis.motor.set(motor);
    axis.motor.servo_on = chose(option("servo_at_power_up", "on"));
  }
}

void Simple2R3::reset_timers() {
  for (Timer& timer : state_.timers) {
    timer = {};
    if (chose(option("timers_at_power_up", "running"))) run_timer(timer, true);
  }
}

// --- factory reset, erasure ------------------------------------------------------------------------

void Simple2R3::reset_to_factory() {
  if (!unlocked() && chose(option("locked_reset", "ignored"))) return;
  const bool volatile_stays = chose(option("factory_reset_of_volatile", "kept"));
  constexpr std::size_t kFirstSurvivor = slot("ADC_10V_A");
  constexpr std::size_t kLastSurvivor = slot("ADC_1V_B");
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    const bool stays = volatile_stays && !keeps(row);
    if (stays || (slot >= kFirstSurvivor && slot <= kLastSurvivor)) return;
    state_.image[slot] = factory_bits(row);
  });
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  stop_program();
  reload_program();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(*this), now());
  for (int axis = 0; axis < 2; ++axis) {
    if (!chose(option("factory_reset_motion", "goes_on"))) switch_servo(axis, false);
    state_.axes[static_cast<std::size_t>(axis)].homed = false;
  }
  if (volatile_stays) return;
  state_.written_outputs = 0;
  reset_timers();
  for (AxisState& axis : state_.axes) axis.alarm_clear_until = 0;
}

void Simple2R3::erase_program() {
  if (!chose(option("erase_while_running", "goes_on"))) stop_program();
  for (const std::size_t column : kColumns) {
    std::fill_n(state_.image.begin() + static_cast<std::ptrdiff_t>(column), interpreter::simple2::kLineCount,
                0U);
  }
  reload_program();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(*this), now());
}

}  // namespace understudy::emulator::models::simple2_r3
