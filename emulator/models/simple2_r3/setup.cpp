#include "emulator/models/simple2_r3/setup.h"

#include <algorithm>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/terminals.h"
#include "interpreter/simple2/dialect.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

using interpreter::simple2::Dialect;

Dialect dialect_of(const Device& device) {
  Dialect dialect = interpreter::simple2::dialect_of_firmware(device.firmware());
  if (device.chose(option("wait_move_b_139", "waits"))) dialect.quirk_wait_move_b_is_move_inc_b_wait = false;
  if (device.chose(option("loop_count", "further_passes")))
    dialect.loop_count = Dialect::LoopCount::further_passes;
  if (device.chose(option("loop_left", "remembered"))) dialect.loop_left = Dialect::LoopLeft::remembered;
  if (device.chose(option("loop_nesting", "when_outer_starts")))
    dialect.loop_nesting = Dialect::LoopNesting::when_outer_starts;
  if (device.chose(option("unknown_command", "ends")))
    dialect.unknown_command = Dialect::UnknownCommand::ends;
  if (device.chose(option("undefined_operand", "ends")))
    dialect.undefined_operand = Dialect::UndefinedOperand::ends;
  if (device.chose(option("undefined_parameter", "ends")))
    dialect.undefined_parameter = Dialect::UndefinedParameter::ends;
  if (device.chose(option("read_only_parameter", "ends")))
    dialect.read_only_parameter = Dialect::ReadOnlyParameter::ends;
  if (device.chose(option("logic_operand", "lowest_bit"))) dialect.logic = Dialect::Logic::lowest_bit;
  if (device.chose(option("value_out_of_range", "low_16_bits")))
    dialect.value_out_of_range = Dialect::ValueOutOfRange::low_16_bits;
  if (device.chose(option("after_last_line", "goes_on_at_0")))
    dialect.after_last_line = Dialect::AfterLastLine::goes_on_at_0;
  if (device.chose(option("delay_counts", "before_next_slot")))
    dialect.delay_counts = Dialect::DelayCounts::before_next_slot;
  if (device.chose(option("wait_slot", "in_the_same_slot")))
    dialect.wait_slot = Dialect::WaitSlot::next_line_runs_in_it;
  if (device.chose(option("timer1_defect", "always_jumps")))
    dialect.timer1_defect = Dialect::Timer1Defect::always_jumps;
  if (device.chose(option("arithmetic", "saturates"))) dialect.overflow = Dialect::Overflow::saturates;
  if (device.chose(option("division", "downwards"))) dialect.division = Dialect::Division::downwards;
  if (device.chose(option("counter_overflow", "saturates")))
    dialect.counter_overflow = Dialect::CounterOverflow::saturates;
  if (device.chose(option("undefined_flag", "line_void")))
    dialect.undefined_flag = Dialect::UndefinedFlag::line_void;
  if (device.chose(option("timer_compare", "with_sign")))
    dialect.timer_compare = Dialect::TimerCompare::with_sign;
  if (device.chose(option("wait_cut_short", "waits_on")))
    dialect.wait_cut_short = Dialect::WaitCutShort::waits_on;
  if (device.chose(option("rewritten_line", "waits_on")))
    dialect.rewritten_line = Dialect::RewrittenLine::waits_on;
  if (device.chose(option("wait_cut_short", "program_ends")))
    dialect.wait_cut_short = Dialect::WaitCutShort::program_ends;
  return dialect;
}

}  // namespace

Setup::Setup(const Device& of)
    : device(of),
      dialect(dialect_of(of)),
      assigned_at_power_up(chose(option("assignment_effect", "at_power_up"))),
      adc_10_bits(chose(option("adc_width", "10_bits_100_a_volt"))),
      motion_first(chose(option("tick_order", "motion"))),
      limits_physical(chose(option("limit_sense", "physical"))),
      alarm_latches(chose(option("alarm_latch", "latched"))),
      alarm_takes_servo(chose(option("alarm_reaction", "stops_and_servo_off"))),
      coordinate_saturates(chose(option("coordinate_overflow", "saturates"))),
      velocity_pulses_first(chose(option("velocity_step", "pulses"))),
      velocity_settings_latched(chose(option("velocity_settings", "next_command"))),
      stops_with_encoder(chose(option("sync_slope_end", "stops"))),
      sync_follows_other(chose(option("sync_encoder", "other"))),
      quirk_coordinate_counts_physical_sense(of.firmware() <= 140),
      timers_stay(chose(option("timer_overflow", "stays"))),
      velocity_unit_urpm(chose(option("velocity_unit", "two_rpm_per_second")) ? 1000 : 1),
      timer_unit(chose(option("timer_unit", "10ms"))    ? 10
                 : chose(option("timer_unit", "100ms")) ? 100
                                                        : 1),
      boot_ticks(chose(option("boot_time", "100ms")) ? 100
                 : chose(option("boot_time", "1s"))  ? 1000
                                                     : 0) {}

std::uint16_t Setup::input_levels() const {
  std::uint32_t levels = 0;
  for (int i = 0; i < kInputCount; ++i) levels |= static_cast<std::uint32_t>(device.input(i)) << i;
  return static_cast<std::uint16_t>(levels);
}

std::uint8_t Setup::switch_levels() const {
  std::uint8_t levels = 0;
  for (int i = 0; i < kSwitchCount; ++i) {
    levels |= static_cast<std::uint8_t>(device.input(kFirstSwitch + i) << i);
  }
  return levels;
}

std::uint16_t Setup::adc(int number) const {
  // The level is in millivolts. With the factory calibration, the value for 10 V is 4000, or 1000 with 10
  // bits.
  const std::int32_t level = device.input(kFirstAnalog + number);
  const std::int32_t adc = adc_10_bits ? std::min(level / 10, 1023) : std::min(level * 2 / 5, 4095);
  return static_cast<std::uint16_t>(std::max(adc, 0));
}

std::string choice_words(const Setup& setup, std::size_t choice) {
  const ChoiceRow& row = setup.device.model().choices[choice];
  return "choice " + std::string(row.id) + " = " + std::string(options_of(row)[setup.device.choice(choice)]);
}

MapPolicy map_policy_of(const Setup& setup) {
  MapPolicy policy = setup.device.model().registers->policy();
  if (setup.chose(option("unmapped_addresses", "zero_and_ignored")))
    policy.unmapped = MapPolicy::Unmapped::reads_zero;
  if (setup.chose(option("write_to_read_only", "ignored")))
    policy.read_only = MapPolicy::ReadOnly::ignores_writes;
  if (setup.chose(option("read_of_write_only", "exception_02")))
    policy.write_only = MapPolicy::WriteOnly::refused;
  if (setup.chose(option("half_writes", "judged_with_other_half")))
    policy.halves = MapPolicy::Halves::judged_with_the_other;
  if (setup.chose(option("write_out_of_range", "clamped")))
    policy.out_of_range = MapPolicy::OutOfRange::clamped;
  if (setup.chose(option("request_with_bad_value", "those_before_stored")))
    policy.partly = MapPolicy::Partly::up_to_the_refused;
  if (setup.chose(option("request_effects", "each_in_its_turn")))
    policy.effects = MapPolicy::Effects::one_by_one;
  return policy;
}

}  // namespace understudy::emulator::models::simple2_r3
