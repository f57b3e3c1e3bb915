// What a SUPER-40NC shows of its axes, and how its counters count (《M8x 特殊接點的功用(XYZU 軸用)》, 《D8x
// 特殊暫存器的功用(XYZU 軸用)》).
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis_state.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/effects.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/ownership.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/terminals.h"
#include "motion/axis.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"
#include "motion/profile.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The values of D8x64, by the chip's numbers.
enum Operation : std::int32_t {
  kStopped = 0,
  kBacklash = 7,
  kByWheel = 8,
  kAtFa = 9,
  kAtFl = 10,
  kSpeedingUp = 11,
  kAtFh = 12,
  kSlowingDown = 13,
};

/// The sources of the counters, as D9x23 to D9x25 number them.
struct CountedThisTick {
  std::int64_t pulses = 0;
  std::int64_t backlash = 0;
  std::int64_t wheel = 0;
};

bool is_bit(std::int32_t mask, int bit) { return (mask >> bit & 1) != 0; }

/// Returns the counts of half the chip's clock of 19.6608 MHz in a number of ticks.
std::int64_t clock_counts(Tick ticks) { return ticks * 49'152 / 5; }

std::int32_t wrapped(std::int64_t number) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(number));
}

}  // namespace

bool Super40nc::status(int axis_number, AxisStatus what) const {
  const AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  switch (what) {
    case SSCM: return state.holder != Activity::nobody;
    case SRUN: {
      const std::int32_t operation = operation_of(axis_number);
      return operation == kByWheel ? state.followed_pulses != 0 : operation != kStopped;
    }
    case SENI:
      return !chose(option("seni_flag", "always_0")) && state.has_ended && state.holder == Activity::nobody;
    case SEND: return state.holder == Activity::nobody;
    case SERR: return state.has_error;
    case SCP1: return comparator_holds(axis_number, 0);
    case SCP2: return comparator_holds(axis_number, 1);
    case SCP3: return comparator_holds(axis_number, 2);
    case SCP4: return comparator_holds(axis_number, 3);
    case SCP5: return comparator_holds(axis_number, 4);
    case SFU: return operation_of(axis_number) == kSpeedingUp;
    case SFD: return operation_of(axis_number) == kSlowingDown;
    case SFC: {
      const std::int32_t operation = operation_of(axis_number);
      return operation == kAtFa || operation == kAtFl || operation == kAtFh || operation == kBacklash;
    }
    case SALM: return has_signal(axis_number, motion::Signal::alarm);
    case SPEL: return has_signal(axis_number, motion::Signal::limit_plus);
    case SMEL: return has_signal(axis_number, motion::Signal::limit_minus);
    case SORG: return has_signal(axis_number, motion::Signal::home);
    case SDIR: return motor.last_direction < 0;
    case SEMG: return state_.emergency;
    case SERC: return gives_erc(axis_number);
    case SCLR: return has_chip_pins() && input(chip_pin_of(axis_number, kClearPin)) != 0;
    case SLTC: return has_chip_pins() && input(chip_pin_of(axis_number, kLatchPin)) != 0;
    case SEZ: return has_signal(axis_number, motion::Signal::index);
    case SINP: return input(pin_of(axis_number, kInPositionPin)) != 0;
    case SRDY: return input(pin_of(axis_number, kReadyPin)) != 0;
    case HOME_DONE: return state.homed;
    case ZERO_DONE: return state.zeroed;
    case HOME_RUNS: return state.holder == Activity::home && shows_running(state.mover == Mover::hand);
    case ZERO_RUNS: return state.holder == Activity::zero;
    case WHEEL_RUNS: {
      const bool is_by_contact =
          state.wheel >= WheelSource::contact_1 && state.wheel <= WheelSource::contact_100;
      return state.holder == Activity::wheel && shows_running(is_by_contact);
    }
  }
  return false;
}

bool Super40nc::shows_running(bool is_by_contact) const {
  return is_by_contact || !chose(option("motion_flags_source", "contacts_alone"));
}

std::int32_t Super40nc::operation_of(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const motion::Axis& motor = chip(axis_number);
  if (!motor.moving() || !state.moves()) return kStopped;
  if (motor.task == motion::Task::following) return kByWheel;
  if (motor.in_backlash || state.path_backlash != 0) return kBacklash;
  const motion::Sample sample = is_on_path(axis_number) ? state_.path.run.sample(now()) : motor.sample(now());
  if (!(sample.speed_u_s > 0)) return kStopped;
  if (sample.acceleration_u_s2 > 0) return kSpeedingUp;
  if (sample.acceleration_u_s2 < 0) return kSlowingDown;
  constexpr int kCreep = 1;  // index of a homing's speeds
  if (motor.homing.active() && motor.homing.row().speed == kCreep) return kAtFa;
  return sample.speed_u_s > motor.law.start_speed_u_s ? kAtFh : kAtFl;
}

std::int64_t Super40nc::remaining_pulses(int axis_number) const {
  const AxisState& state = axis(axis_number);
  const bool has_target = state.rest.kind == RestKind::path || state.holder == Activity::rest;
  return has_target ? std::abs(state.rest.travel - chip(axis_number).travel_pulses)
                    : chip(axis_number).remaining_pulses();
}

std::int32_t Super40nc::chip_speed(int axis_number) const {
  return wrapped(std::llround(std::abs(commanded_pps(axis_number)) / axis(axis_number).step_pps));
}

// ---- counters

/// Adds to one of COUNTER2 to COUNTER4.
void Super40nc::add_to_counter(int axis_number, int which, std::int64_t counts) {
  constexpr int kDeviation = 2;
  if (counts == 0 || is_bit(registers().raw(kept_x(d9x::kDisableC2ToC4), axis_number), which - 1)) return;
  std::int32_t& its_count = axis(axis_number).counts[static_cast<std::size_t>(which - 1)];
  its_count = wrapped(its_count + counts);
  if (which == kDeviation) its_count = static_cast<std::int16_t>(its_count);  // 16 bits on the chip
}

/// Returns true if COUNTER4 counts now; it may count only while the axis moves.
bool Super40nc::counts_now(int axis_number) const {
  const AxisState& state = axis(axis_number);
  return !registers().is_on(kept_x(d9x::kC4Enable), axis_number) || state.moves() ||
         state.followed_pulses != 0;
}

bool Super40nc::counts_a_clock(int axis) const {
  return chose(option("counter4_clock", "9_8304_mhz")) && registers().of(kept_x(d9x::kC4Source), axis) == 3;
}

/// Sets the machine's encoder, which has moved by the pulses of this tick.
void Super40nc::set_encoder(int axis_number, std::int64_t counts) {
  count_encoder(axis_number, counts);
  chip(axis_number)
      .set_encoder(registers().is_on(kept_x(d9x::kEncoderDirection), axis_number) ? -counts : counts);
}

void Super40nc::count_encoder(int axis_number, std::int64_t counts) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  const std::int64_t turned = counts - state.encoder_counts;
  state.encoder_counts = counts;
  if (turned == 0 || !powered() || settings.is_on(kept_x(d9x::kEncoderDisable), axis_number)) return;
  const std::int64_t counted = settings.is_on(kept_x(d9x::kEncoderDirection), axis_number) ? -turned : turned;
  if (settings.of(kept_x(d9x::kC2Source), axis_number) == 0) add_to_counter(axis_number, 1, counted);
  const Value deviation = settings.of(kept_x(d9x::kC3Source), axis_number);
  if (deviation == 0) add_to_counter(axis_number, 2, -counted);
  if (deviation == 2) add_to_counter(axis_number, 2, counted);
  if (settings.of(kept_x(d9x::kC4Source), axis_number) == 1 && counts_now(axis_number))
    add_to_counter(axis_number, 3, counted);
}

/// Clears counters at the end of a home, after the counts of its last tick.
void Super40nc::clear_counters(int axis_number) {
  const std::uint8_t cleared = std::exchange(axis(axis_number).clears, std::uint8_t{0});
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) set_counter(axis_number, which, 0);
  }
}

/// Counts the pulses of one or several ticks, and those of the wheel; set_encoder() counts the encoder.
void Super40nc::count(int axis_number, std::int64_t travel_before, std::int64_t wheel_counts,
                      Tick clock_ticks) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  const std::int64_t extra = chip(axis_number).backlash_sent - state.backlash_seen;
  state.backlash_seen = chip(axis_number).backlash_sent;
  const CountedThisTick now_counted{
      .pulses = chip(axis_number).travel_pulses - travel_before, .backlash = extra, .wheel = wheel_counts};
  const std::int32_t with_backlash = settings.raw(kept_x(d9x::kCountCorrect), axis_number);
  if (extra != 0 && is_bit(with_backlash, 0)) {
    state.command.set(machine_pulses(axis_number) + extra, chip(axis_number).travel_pulses);
    apply_axis_parameters(axis_number, 0);
  }
  const bool is_beside_travel = extra != 0;
  const auto pulses_for = [&](int counter) {
    return now_counted.pulses + (is_bit(with_backlash, counter) ? now_counted.backlash : 0);
  };
  const auto add = [&](int counter, std::int64_t counts) { add_to_counter(axis_number, counter, counts); };
  switch (settings.of(kept_x(d9x::kC2Source), axis_number)) {
    case 0: break;
    case 1: add(1, pulses_for(1)); break;
    default: add(1, now_counted.wheel); break;
  }
  switch (settings.of(kept_x(d9x::kC3Source), axis_number)) {
    case 0: add(2, pulses_for(2)); break;
    case 1: add(2, pulses_for(2) - now_counted.wheel); break;
    default: add(2, -now_counted.wheel); break;
  }
  if (counts_now(axis_number)) {
    switch (settings.of(kept_x(d9x::kC4Source), axis_number)) {
      case 0: add(3, pulses_for(3)); break;
      case 2: add(3, now_counted.wheel); break;
      case 3:
        add(3, counts_a_clock(axis_number) ? clock_counts(now()) - clock_counts(now() - clock_ticks) : 0);
        break;
      default: break;  // the encoder's
    }
  }
  if (is_beside_travel) set_comparators(axis_number);  // the comparators by travel would not notice it
}

/// D8x71: counts edges of C in the row of the search that counts them.
void Super40nc::count_index(int axis_number, std::int8_t phase_before) {
  const motion::Homing& homing = chip(axis_number).homing;
  if (phase_before < 0) return;
  const motion::HomingPhase& row = homing.program.phases[static_cast<std::size_t>(phase_before)];
  if (row.until != motion::Signal::index) return;
  const bool is_over = homing.phase != phase_before;
  const bool has_met = !is_over || homing.reference_known;
  if (has_met) axis(axis_number).index_count = is_over ? row.count : homing.counted;
}

/// Counts up to this moment of a tick; the rest of the tick is counted afterwards.
void Super40nc::count_until(const motion::SharedTick& tick, int axis_number) {
  CountedSoFar& so_far = counted_[static_cast<std::size_t>(axis_number)];
  const motion::Axis& motor = chip(axis_number);
  const double part = tick.now().tick == tick.tick() ? 1 : tick.now().after_s * motion::kTicksPerSecond;
  const auto wheel = static_cast<std::int64_t>(part * static_cast<double>(wheel_of_tick_));
  count(axis_number, so_far.travel, wheel - so_far.wheel, 0);
  so_far = {.travel = motor.travel_pulses, .wheel = wheel};
  const motion::EncoderLine& encoder = environment(axis_number).encoder;
  if (!encoder.is_known()) return;
  const std::int64_t counts = encoder.at(motor.travel_pulses);
  count_encoder(axis_number, encoder.turned ? -counts : counts);
}

/// D9x50: latches at the DOG's edge, and at the comparators 4 and 5 if the chip compares them.
void Super40nc::at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) {
  const int axis_number = static_cast<int>(axis);
  const Value by = registers().of(kept_x(d9x::kLatchOfCounters), axis_number);
  constexpr Value kDog = 1;
  const motion::Events latches =
      by == kDog ? motion::bit(motion::Event::mark_on) : this->axis(axis_number).latching;
  if ((events & latches) == 0) return;
  count_until(tick, axis_number);
  take_latch(axis_number, chip(axis_number).travel_pulses);
}

/// Latches by a comparator that the chip does not check within the tick: when it is true at the tick's end.
void Super40nc::latch_by_comparator(int axis_number) {
  AxisState& state = axis(axis_number);
  const Value by = registers().of(kept_x(d9x::kLatchOfCounters), axis_number);
  const bool is_on = by == 2 ? comparator_holds(axis_number, 3) : by == 3 && comparator_holds(axis_number, 4);
  const bool comes = is_on && !state.latch_was_on && state.latching == 0;
  state.latch_was_on = is_on;
  if (comes) take_latch(axis_number, chip(axis_number).travel_pulses);
}

void Super40nc::take_latch(int axis_number, std::int64_t travel) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  if (settings.is_on(kept_x(d9x::kStopLatch), axis_number)) return;
  state.latched[0] = wrapped(state.command.at(travel));
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    state.latched[static_cast<std::size_t>(which)] = counter(axis_number, which);
  }
  if (settings.is_on(kept_x(d9x::kC3LatchSpeed), axis_number)) state.latched[2] = chip_speed(axis_number);
  const std::int32_t cleared = settings.raw(kept_x(d9x::kLatchResetC), axis_number);
  if (is_bit(cleared, 0)) {
    state.command.set(0, travel);
    apply_axis_parameters(axis_number, 0);
  }
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) set_counter(axis_number, which, 0);
  }
}

}  // namespace understudy::emulator::models::super_40nc
