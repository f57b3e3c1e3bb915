#include "emulator/models/rs_m8194h/chip/chip.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/simulated_time.h"
#include "emulator/models/rs_m8194h/chip/axis_unit.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/options.h"
#include "emulator/models/rs_m8194h/rows/terminals.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/environment.h"
#include "motion/move.h"

namespace understudy::emulator::models::rs_m8194h {

Activity Chip::activity(std::size_t axis) const {
  const motion::Axis& motor = state_.motors[axis];
  if (motor.homing.active()) return Activity::homing;
  if (state_.paths.together.takes(axis)) return Activity::path;
  return motor.moving() ? Activity::single : Activity::idle;
}

AxisMask Chip::driving() const {
  AxisMask mask = 0;
  for (std::size_t a = 0; a < kAxes; ++a) mask |= is_driving(a) ? mask_of(a) : AxisMask{0};
  return mask;
}

double Chip::speed_pps(std::size_t axis) const {
  if (state_.paths.together.takes(axis)) return state_.paths.together.speed_pps(axis, now());
  const motion::Axis& motor = state_.motors[axis];
  return motor.moving() ? motor.sample(now()).speed_u_s * static_cast<double>(motor.drive.direction) : 0;
}

motion::SpeedLaw Chip::law_of(std::size_t axis) const {
  return rs_m8194h::law_of(state_.units[axis], machine_options().speed);
}

bool Chip::is_active(std::size_t axis, motion::Signal signal) const {
  return (state_.environment[axis].at(state_.motors[axis].travel_pulses, state_.motors[axis].signals) &
          motion::bit(signal)) != 0;
}

void Chip::add_errors(std::size_t axis, std::uint16_t bits) {
  for (std::size_t bit = 0; bit < kErrors; ++bit) {
    if ((bits >> bit & 1) != 0) decisions().meet(kErrorTable, bit, 0);
  }
  state_.units[axis].error_code |= bits;
}

std::uint16_t Chip::error_code(std::size_t axis) const {
  std::uint16_t code = state_.units[axis].error_code;
  if (!chose(option("error_bits", "also_by_active_inputs"))) return code;
  constexpr struct {
    motion::Signal signal;
    ErrorBit bit;
  } kInputs[] = {{motion::Signal::limit_plus, ErrorBit::limit_plus},
                 {motion::Signal::limit_minus, ErrorBit::limit_minus},
                 {motion::Signal::alarm, ErrorBit::alarm},
                 {motion::Signal::emergency, ErrorBit::emergency}};
  for (const auto& each : kInputs) {
    if (is_active(axis, each.signal)) code |= bit_of(each.bit);
  }
  return code;
}

void Chip::connect_encoder(std::size_t axis, std::int64_t counts) {
  AxisUnit& unit = state_.units[axis];
  unit.encoder_raw = counts * machine_options().edges_per_encoder_count;  // EP counts from this value
  if (unit.has_encoder) unit.encoder_zero = unit.encoder_raw;
  set_encoder(axis, counts);
}

void Chip::set_encoder(std::size_t axis, std::int64_t counts) {
  const bool is_first = !state_.units[axis].has_encoder;
  update_encoder(state_.units[axis], state_.motors[axis], counts * machine_options().edges_per_encoder_count);
  if (is_first) rearm(axis);
}

void Chip::give_pulse(std::size_t axis, Tick tick, std::int64_t pulses) {
  // SET_OUT supports only X and Y (7.3.9).
  if (axis >= static_cast<std::size_t>(kOuts)) return;
  // The pulse widths in whole ticks. Shorter pulses are only counted.
  static constexpr std::array<Tick, 8> kWidths{0, 0, 0, 0, 1, 2, 10, 20};
  OutSettings& out = state_.units[axis].out;
  out.pulses += pulses;
  out.pulse_until = tick + kWidths[out.width_code % kWidths.size()];
}

// --- power and RESET_CARD ---------------------------------------------------------------------------------

void Chip::blank_axis(std::size_t axis, const BasicSettings& basic) {
  // The motor and the bench's encoder keep their positions.
  motion::Axis& motor = state_.motors[axis];
  const std::int64_t travel_pulses = motor.travel_pulses;
  const AxisUnit before = state_.units[axis];
  motor = motion::Axis{};
  motor.travel_pulses = motor.base_pulses = travel_pulses;
  motor.watch_low = motor.watch_high = travel_pulses;
  AxisUnit& blank = state_.units[axis] = AxisUnit{};
  blank.has_encoder = before.has_encoder || chose(option("ep_without_encoder", "stands_still"));
  blank.encoder_raw = blank.encoder_zero = before.encoder_raw;
  blank.pins = before.pins;
  blank.emergency = before.emergency;
  blank.external_seen = before.external_seen;
  set_external_levels(blank);
  blank.out.pulses = before.out.pulses;
  blank.logic.range = blank.absolute.range = blank.encoder.range = motion::Counter::Range::bits32;
  set_logic_position(blank, motor, 0, true);
  set_absolute_position(blank, motor, 0, true);
  set_encoder_position(blank, motor, 0, true);
  apply_basic(blank, motor, basic, machine_options().axis);
}

void Chip::blank(const std::array<BasicSettings, kAxes>& basic) {
  constexpr std::uint32_t kUsualPps = 1000;
  const bool has_usual_speeds = chose(option("power_on_values", "1000_pps"));
  for (std::size_t a = 0; a < kAxes; ++a) {
    blank_axis(a, basic[a]);
    AxisUnit& unit = state_.units[a];
    if (has_usual_speeds) unit.speed.start_pps = unit.speed.drive_pps = unit.homing.home_pps = kUsualPps;
  }
  state_.sync = {};
  state_.paths = {};
  if (has_usual_speeds) state_.paths.vector.start_pps = state_.paths.vector.drive_pps = kUsualPps;
  state_.scans = {};
  state_.scanning = 0;
}

void Chip::keep_counters_of(const ChipState& before) {
  const bool ring_folds = machine_options().axis.ring_folds;
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    motion::Axis& motor = state_.motors[a];
    const AxisUnit& was = before.units[a];
    set_logic_position(unit, motor, logic_count(was, before.motors[a]), ring_folds);
    set_encoder_position(unit, motor, encoder_count(was, before.motors[a]), ring_folds);
    set_absolute_position(unit, motor, absolute_count(was, before.motors[a]), ring_folds);
    unit.latched = was.latched;
  }
}

void Chip::keep_settings_of(const ChipState& before) {
  for (std::size_t a = 0; a < kAxes; ++a) {
    AxisUnit& unit = state_.units[a];
    const AxisUnit& was = before.units[a];
    unit.speed = was.speed;
    unit.homing = was.homing;
    unit.compare = was.compare;
    unit.factors = was.factors;
    unit.isr_of = was.isr_of;
    unit.action_isr = was.action_isr;
    unit.out.level = was.out.level;
    unit.out.width_code = was.out.width_code;
  }
  state_.paths.assigned = before.paths.assigned;
  state_.paths.vector = before.paths.vector;
  state_.paths.streams = before.paths.streams;
  state_.sync.triggers = before.sync.triggers;
  state_.sync.actions = before.sync.actions;
}

}  // namespace understudy::emulator::models::rs_m8194h
