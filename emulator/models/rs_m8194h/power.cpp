// Power, RESET_CARD and LOAD_INITIAL: what is as before behind each of them (3.2.1, 8).
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "emulator/models/rs_m8194h/axis_unit.h"
#include "emulator/models/rs_m8194h/memory.h"
#include "emulator/models/rs_m8194h/module.h"
#include "emulator/models/rs_m8194h/options.h"
#include "emulator/models/rs_m8194h/registers.h"
#include "emulator/models/rs_m8194h/state.h"
#include "emulator/models/rs_m8194h/terminals.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/external_drive.h"

namespace understudy::emulator::models::rs_m8194h {

namespace {

/// Of EXP+ and EXP-, as they are: a line is low while it conducts, which is after each odd edge.
void set_external_levels(AxisUnit& unit) {
  unit.external.plus_high = (unit.external_seen[0] & 1U) == 0;
  unit.external.minus_high = (unit.external_seen[1] & 1U) == 0;
}

}  // namespace

void Module::blank_module() {
  constexpr std::uint32_t kUsualPps = 1000;
  const bool has_usual_speeds = chose(option("power_on_values", "1000_pps"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    // The motor stands where it is, and the bench's encoder too.
    const motion::Axis before = state_.motors[a];
    const AxisUnit unit = state_.units[a];
    motion::Axis& motor = state_.motors[a] = motion::Axis{};
    motor.travel_pulses = motor.base_pulses = before.travel_pulses;
    motor.watch_low = motor.watch_high = before.travel_pulses;
    AxisUnit& blank = state_.units[a] = AxisUnit{};
    blank.has_encoder = unit.has_encoder || chose(option("ep_without_encoder", "stands_still"));
    blank.encoder_raw = blank.encoder_zero = unit.encoder_raw;
    blank.pins = unit.pins;
    blank.emergency = unit.emergency;
    blank.external_seen = unit.external_seen;
    set_external_levels(blank);
    blank.out.pulses = unit.out.pulses;
    blank.logic.range = blank.absolute.range = blank.encoder.range = motion::Counter::Range::bits32;
    set_logic_position(blank, motor, 0, true);
    set_absolute_position(blank, motor, 0, true);
    set_encoder_position(blank, motor, 0, true);
    apply_basic(blank, motor, state_.initial_table[a], machine_.axis);
    if (has_usual_speeds) blank.speed.start_pps = blank.speed.drive_pps = blank.homing.home_pps = kUsualPps;
  }
  state_.sync = {};
  state_.paths = {};
  if (has_usual_speeds) state_.paths.vector.start_pps = state_.paths.vector.drive_pps = kUsualPps;
  state_.scans = {};
  state_.scanning = 0;
  state_.fifo = {};
  state_.held_paths.clear();
  state_.loaded.clear();
  state_.emergency_state = false;
  state_.rint = 0;
  state_.interrupts = false;
  state_.factor_axes = {};
  state_.marks.clear();
  state_.enabled.clear();
  state_.execution = {};
  state_.paused = false;
  state_.paused_by = 0;
  state_.queued_triggers.clear();
  state_.trigger_holds = {};
  for (std::size_t a = 0; a < kAxes; ++a) rearm(a);
}

void Module::blank() {
  State made;
  made.initial_table = initial_table_of(state_.blocks, factory_settings());
  made.eeprom = std::move(state_.eeprom);
  made.blocks = std::move(state_.blocks);
  for (std::size_t a = 0; a < kAxes; ++a) {
    made.units[a].has_encoder = state_.units[a].has_encoder;
    made.units[a].encoder_raw = state_.units[a].encoder_raw;
    made.units[a].out.pulses = state_.units[a].out.pulses;
  }
  made.image.resize(kSlotCount);
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    if (row.is_view) continue;
    const bool is_kept = keeps(row);
    for (int i = 0; i < row.count; ++i, ++next) {
      made.image[next] = is_kept && next < made.eeprom.kept().size()
                             ? made.eeprom.kept()[next]
                             : static_cast<std::uint32_t>(row.factory);
    }
  }
  state_ = std::move(made);
  blank_module();
}

void Module::power_up() {
  blank();
  state_.powered_at = now();
  state_.at_init = input(kInitSwitch) != 0;
  pass_state(kInitialised);
  state_.steps_left = options_.steps_a_tick;
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    for (int i = 0; i < 2; ++i) {
      const Pin pin = i == 0 ? Pin::external_plus : Pin::external_minus;
      unit.external_seen[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(input(terminal(a, pin)));
    }
    set_external_levels(unit);
  }
  pass_pins(now());
  for (AxisUnit& unit : state_.units) {
    unit.pins.passed = unit.pins.raw;
    unit.emergency = state_.emergency_input;
  }
  state_.holds_back = false;
  state_.unscanned = true;
  scan_frnet();
  check_triggers(state_.inputs, true);
  for (std::size_t a = 0; a < kAxes; ++a) {
    rearm(a);
    motion::Axis& motor = state_.motors[a];
    // What is there at power-up is not an edge.
    motor.signals = state_.environment[a].at(motor.travel_pulses);
  }
}

void Module::power_down() {
  state_.eeprom.lose_power();
  blank();
}

BasicSettings Module::factory_settings() const {
  // Figure 3's soft limits and ring are switched off.
  if (!chose(option("factory_values", "of_figure_3"))) return {};
  return {.max_v = 8'000, .filtered = 1, .filter_time = 2};
}

void Module::pass_state(std::uint8_t finished) {
  if (!machine_.finished_states_show) return;
  state_.finished = finished;
  state_.finished_at = now();
}

void Module::reset_card() {
  const auto units = state_.units;
  std::array<std::array<std::int32_t, 3>, kAxes> counts{};
  for (std::size_t a = 0; a < kAxes; ++a) {
    const motion::Axis& motor = state_.motors[a];
    counts[a] = {logic_count(units[a], motor), encoder_count(units[a], motor),
                 absolute_count(units[a], motor)};
  }
  const Paths paths = state_.paths;
  const motion::SyncTable sync = state_.sync;
  const bool interrupts = state_.interrupts;
  const auto enabled = state_.enabled;
  blank_module();
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    motion::Axis& motor = state_.motors[a];
    if (chose(option("reset_card_counters", "kept"))) {
      set_logic_position(unit, motor, counts[a][0], machine_.axis.ring_folds);
      set_encoder_position(unit, motor, counts[a][1], machine_.axis.ring_folds);
      set_absolute_position(unit, motor, counts[a][2], machine_.axis.ring_folds);
      unit.latched = units[a].latched;
    }
    if (chose(option("reset_card_settings", "kept"))) {
      unit.speed = units[a].speed;
      unit.homing = units[a].homing;
      unit.compare = units[a].compare;
      unit.factors = units[a].factors;
      unit.isr_of = units[a].isr_of;
      unit.action_isr = units[a].action_isr;
      unit.out.level = units[a].out.level;
      unit.out.width_code = units[a].out.width_code;
    }
  }
  if (chose(option("reset_card_settings", "kept"))) {
    state_.paths.assigned = paths.assigned;
    state_.paths.vector = paths.vector;
    state_.paths.streams = paths.streams;
    state_.sync.triggers = sync.triggers;
    state_.sync.actions = sync.actions;
    state_.interrupts = interrupts;
    state_.enabled = enabled;
  }
  for (std::size_t a = 0; a < kAxes; ++a) rearm(a);
  constexpr Tick kBooting = 100;
  if (chose(option("reset_card_time", "100ms"))) state_.resetting_until = now() + kBooting;
  const auto clear = [&](std::size_t first, std::size_t count) {
    for (std::size_t slot = first; slot < first + count; ++slot) put(slot, 0);
  };
  if (chose(option("reset_card_variables", "cleared"))) {
    clear(kFirstBvarSlot, kBvars);
    clear(kFirstVarSlot, kVars);
  }
  if (chose(option("reset_card_do", "off"))) state_.outputs.fill(0);
  if (chose(option("reset_card_own_words", "as_at_power_on"))) {
    clear(kCallMpSlot, 1);
    if (!chose(option("word_order_kept", "kept"))) clear(kWordOrderSlot, 1);
    state_.illegal_reason = 0;
    state_.downloaded = {};
    state_.execution_fault = {};
  }
}

void Module::load_initial() {
  for (std::size_t a = 0; a < kAxes; ++a) {
    apply_basic(state_.units[a], state_.motors[a], state_.initial_table[a], machine_.axis);
    set_external(a, motion::ExternalDrive::Mode::off, 0);
    rearm(a);
  }
}

}  // namespace understudy::emulator::models::rs_m8194h
