#include "emulator/models/super_40nc/device.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/model.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "emulator/models/super_40nc/programs/program_machine.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/terminals.h"
#include "emulator/models/super_40nc/wire.h"
#include "motion/axis.h"

namespace understudy::emulator::models::super_40nc {

Super40nc::Super40nc(const DeviceSettings& given)
    : StatefulDevice(super_40nc::model(), given),
      RegisterBankOf(*this, *Device::model().registers, given.firmware),
      PersistentMemory(Device::model().name, given.firmware) {
  map_policy_ = chosen_map_policy(*this, map().policy());
  state_.eeprom = parts_.ground.factory_memory();
  state_.blocks = TextBlocks(block_kinds());
  set_input(kRunSwitch, 1);
}

// ---- the tick

void Super40nc::check_inputs() {
  parts_.axes.inputs.await_no_edges();
  for (int i = 0; i < kInputCount; ++i) {
    state_.image[kFirstX.slot + static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(input(i));
  }
  for (int i = 0; i < kAnalogInCount; ++i) {
    state_.analog[static_cast<std::size_t>(i)] = analog_counts(i);
  }
  state_.emergency = input(kEmergencyTerminal) != 0;
  for (int number = 0; number < kAxisCount; ++number) parts_.axes.inputs.update_environment(number);
  parts_.axes.pins.see_pins();
  parts_.axes.inputs.see_first_signals();
  const bool runs = input(kRunSwitch) != 0;
  if (runs != state_.run_switch) {
    state_.run_switch = runs;
    state_.logo_at = runs && !state_.logo_over ? now() + state_.logo_ms : kNever;
    runs ? parts_.programs.plc_to_run() : parts_.programs.plc_to_stop();
  }
}

void Super40nc::sample_inputs(Tick tick) {
  if (state_.plc_quiet_scans > 0 && !parts_.programs.scans_in(tick)) parts_.programs.note_what_plc_sees();
  if (!take_inputs_changed()) return;
  const bool was_emergency = state_.emergency;
  check_inputs();
  // A contact that is ON before the first scan does not count as an edge, even if a listing was loaded before
  // the inputs were read.
  parts_.programs.begin_first_scan();
  if (was_emergency != state_.emergency) state_.touched = true;
}

/// Runs the PLC, keys, contacts and step programs in this order; the last write takes effect.
void Super40nc::run_interpreters(Tick tick) {
  Programs& programs = parts_.programs;
  if (!programs.scans_in(tick)) return;
  const bool contacts_first = chose(option("scan_order", "contacts_before_the_plc"));
  if (contacts_first) parts_.commands.check_contacts();
  programs.run_plc();
  parts_.commands.forget_errors_of_a_scan();
  if (!contacts_first) parts_.commands.check_contacts();
  programs.run_steps();
  programs.leave_table();
}

void Super40nc::step_motion(Tick tick) {
  state_.has_ticked = true;
  const auto turned = static_cast<std::int32_t>(static_cast<std::uint32_t>(input(kWheelTerminal)) -
                                                static_cast<std::uint32_t>(state_.wheel_edges));
  state_.wheel_edges = input(kWheelTerminal);
  if (turned != 0 && !parts_.ground.is_on(m8::kMotionInhibit)) parts_.axes.wheel.feed_wheel(turned);
  const BeforeTick before = parts_.axes.counters.begin_tick(tick, turned);
  parts_.axes.edges.begin_tick(tick, turned != 0);
  std::array<std::int64_t, kAxisCount> sent{};
  std::array<bool, kAxisCount> was_on_path{};
  for (int number = 0; number < kAxisCount; ++number) {
    was_on_path[static_cast<std::size_t>(number)] = chips().is_on_path(number);
  }
  parts_.paths.step_axes(tick, sent);
  for (int number = 0; number < kAxisCount; ++number) {
    const auto n = static_cast<std::size_t>(number);
    AxisState& axis = state_.axes[n];
    axis.sent_pulses = axis.masked ? 0 : sent[n];
    parts_.axes.counters.end_tick(number, before);
    if (was_on_path[n] || (state_.chips[n].events & motion::bit(motion::Event::ended)) == 0) continue;
    if (const auto broken = parts_.moves.ended(number)) parts_.programs.broken(*broken);
    state_.touched = true;
  }
  if (!state_.path.engaged && std::find(was_on_path.begin(), was_on_path.end(), true) != was_on_path.end()) {
    end_path();
  }
}

void Super40nc::end_path() {
  if (const auto why = parts_.paths.path_ended()) parts_.programs.path_broken(*why);
}

/// Checks the comparators that the chip cannot evaluate, unless the tick has already checked them.
void Super40nc::stop_by_comparators(int axis) {
  for (std::size_t which = 0; which < kComparators; ++which) {
    const auto stop = parts_.axes.comparators.compare(axis, which);
    if (!stop) continue;
    state_.touched = true;
    if (!chips().is_on_path(axis)) {
      motion::Axis& chip = parts_.axes.chips.chip(axis);
      stop->by_ramp ? chip.slow_down(now(), stop->why) : chip.stop(stop->why);
    } else if (stop->by_ramp) {
      parts_.paths.slow_path_for(stop->why);
    } else {
      parts_.paths.break_off(stop->why);
      end_path();
    }
  }
}

void Super40nc::update_outputs(Tick tick) {
  for (int number = 0; number < kAxisCount; ++number) {
    const AxisState& axis = chips().axis(number);
    if (axis.clears != 0) parts_.axes.counters.clear_counters(number);
    parts_.axes.counters.latch_by_comparator(number);
    if (axis.compares_by_tick != 0) stop_by_comparators(number);
  }
  parts_.axes.pins.hold_cleared();
  parts_.ground.update_signals(tick);
  if (tick >= state_.logo_at && !state_.logo_over) {
    if (!chose(option("logo_contact", "the_panel_alone"))) parts_.ground.set_contact(m85::kLogoOver, true);
    state_.logo_over = true;
    state_.logo_at = kNever;
  }
  parts_.programs.wake_plc_by_what_changed();
}

// ---- terminals and axes

bool Super40nc::has_terminal(int terminal) const {
  if (terminal < kFirstDogTerminal) return true;
  if (terminal < kFirstVoltageIn) return chose(option("dog_inputs", "terminals_of_their_own"));
  if (terminal < kFirstServoTerminal) return has_voltage_inputs();
  if (terminal < kFirstChipPin) return chose(option("servo_on", "an_output_per_axis"));
  return parts_.axes.pins.has_chip_pins();
}

bool Super40nc::has_voltage_inputs() const { return !chose(option("analog_counts", "in_counts_only")); }

std::int32_t Super40nc::analog_counts(int number) const {
  if (!has_voltage_inputs()) return input(kFirstAnalogIn + number);
  const std::int32_t full = chose(option("analog_counts", "5_v")) ? kMaxMillivoltsIn : kMaxMillivolts;
  const std::int32_t millivolts = std::min(input(kFirstVoltageIn + number), full);
  return (millivolts * kMaxAnalogCount + full / 2) / full;
}

bool Super40nc::output(int terminal) const {
  if (terminal >= kFirstServoTerminal) {
    if (!powered() || !has_terminal(terminal)) return false;
    if (terminal < kFirstChipPin) return !parts_.keys.is_stopped_by_emergency();
    return parts_.axes.pins.gives_erc((terminal - kFirstChipPin) / kChipPinsOfAxis);
  }
  const int number = terminal - kFirstOutput;
  return powered() && number >= 0 && number < kOutputCount &&
         state_.image[kFirstY.slot + static_cast<std::size_t>(number)] != 0;
}

std::int32_t Super40nc::analog_level(int terminal) const {
  const int number = terminal - kFirstAnalogOut;
  if (!powered() || number < 0 || number >= kAnalogOutCount) return 0;
  const Value steps = parts_.ground.registers().of(number == 0 ? stored_d(d8::kVout1) : stored_d(d8::kVout2));
  return static_cast<std::int32_t>((steps * kMaxMillivolts + kVoltageSteps / 2) / kVoltageSteps);
}

}  // namespace understudy::emulator::models::super_40nc
