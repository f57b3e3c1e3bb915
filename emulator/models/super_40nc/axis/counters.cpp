#include "emulator/models/super_40nc/axis/counters.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/shared_tick.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// The sources of the counters, as D9x23 to D9x25 number them.
struct CountedThisTick {
  std::int64_t pulses = 0;
  std::int64_t backlash = 0;
  std::int64_t wheel = 0;
};

/// Returns the counts of half the chip's clock of 19.6608 MHz in a number of ticks.
std::int64_t clock_counts(Tick ticks) { return ticks * 49'152 / 5; }

}  // namespace

BeforeTick Counters::begin_tick(std::int32_t wheel_counts) {
  BeforeTick before;
  wheel_of_tick_ = wheel_counts;
  for (std::size_t n = 0; n < kAxisCount; ++n) {
    before.travel[n] = axes_.chips[n].travel_pulses;
    before.phase[n] = axes_.chips[n].homing.phase;
    counted_[n] = {.travel = before.travel[n]};
  }
  return before;
}

void Counters::end_tick(int axis_number, const BeforeTick& before) {
  const auto n = static_cast<std::size_t>(axis_number);
  axis(axis_number).followed_pulses = chip(axis_number).travel_pulses - before.travel[n];
  count_index(axis_number, before.phase[n]);
  count(axis_number, counted_[n].travel, wheel_of_tick_ - counted_[n].wheel);
  latch_by_comparator(axis_number);
}

/// Adds to one of COUNTER2 to COUNTER4.
void Counters::add_to_counter(const Settings& settings, int axis_number, int which, std::int64_t counts) {
  constexpr int kDeviation = 2;
  if (counts == 0 || is_bit(settings.raw(kept_x(d9x::kDisableC2ToC4), axis_number), which - 1)) return;
  std::int32_t& its_count = axis(axis_number).counts[static_cast<std::size_t>(which - 1)];
  its_count = wrapped(its_count + counts);
  if (which == kDeviation) its_count = static_cast<std::int16_t>(its_count);  // 16 bits on the chip
}

/// Returns true if COUNTER4 counts now; it may count only while the axis moves.
bool Counters::counts_now(const Settings& settings, int axis_number) const {
  const AxisState& state = axis(axis_number);
  return !settings.is_on(kept_x(d9x::kC4Enable), axis_number) || state.moves() || state.followed_pulses != 0;
}

bool Counters::counts_a_clock(int axis) const {
  return chose(option("counter4_clock", "9_8304_mhz")) && registers().of(kept_x(d9x::kC4Source), axis) == 3;
}

bool Counters::is_quiet(int axis_number) const {
  const motion::Axis& motor = chip(axis_number);
  const AxisState& state = axis(axis_number);
  return !motor.moving() && !motor.must_recheck && motor.events == 0 && motor.events_between == 0 &&
         !counts_a_clock(axis_number) && state.sent_pulses == 0 && state.followed_pulses == 0 &&
         environment(axis_number).version == motor.seen_version;
}

bool Counters::acts_each_tick(int axis) const {
  return counts_a_clock(axis) || registers().of(kept_x(d9x::kLatchOfCounters), axis) >= 2;
}

void Counters::set_encoder(int axis_number, std::int64_t counts) {
  count_encoder(axis_number, counts);
  chip(axis_number)
      .set_encoder(registers().is_on(kept_x(d9x::kEncoderDirection), axis_number) ? -counts : counts);
}

void Counters::count_encoder(int axis_number, std::int64_t counts) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  const std::int64_t turned = counts - state.encoder_counts;
  state.encoder_counts = counts;
  if (turned == 0 || !ground_.powered() || settings.is_on(kept_x(d9x::kEncoderDisable), axis_number)) return;
  const std::int64_t counted = settings.is_on(kept_x(d9x::kEncoderDirection), axis_number) ? -turned : turned;
  if (settings.of(kept_x(d9x::kC2Source), axis_number) == 0)
    add_to_counter(settings, axis_number, 1, counted);
  const Value deviation = settings.of(kept_x(d9x::kC3Source), axis_number);
  if (deviation == 0) add_to_counter(settings, axis_number, 2, -counted);
  if (deviation == 2) add_to_counter(settings, axis_number, 2, counted);
  if (settings.of(kept_x(d9x::kC4Source), axis_number) == 1 && counts_now(settings, axis_number))
    add_to_counter(settings, axis_number, 3, counted);
}

void Counters::clear_counters(int axis_number) {
  const std::uint8_t cleared = std::exchange(axis(axis_number).clears, std::uint8_t{0});
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) parameters_.set_counter(axis_number, which, 0);
  }
}

void Counters::count(int axis_number, std::int64_t travel_before, std::int64_t wheel_counts,
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
    parameters_.apply_axis_parameters(axis_number, 0);
  }
  const bool is_beside_travel = extra != 0;
  const auto pulses_for = [&](int counter) {
    return now_counted.pulses + (is_bit(with_backlash, counter) ? now_counted.backlash : 0);
  };
  const auto add = [&](int counter, std::int64_t counts) {
    add_to_counter(settings, axis_number, counter, counts);
  };
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
  if (counts_now(settings, axis_number)) {
    switch (settings.of(kept_x(d9x::kC4Source), axis_number)) {
      case 0: add(3, pulses_for(3)); break;
      case 2: add(3, now_counted.wheel); break;
      case 3:
        add(3, counts_a_clock(axis_number) ? clock_counts(now()) - clock_counts(now() - clock_ticks) : 0);
        break;
      default: break;  // the encoder's
    }
  }
  if (is_beside_travel)
    comparators_.set_comparators(axis_number);  // the comparators by travel would not notice it
}

/// D8x71: counts edges of C in the row of the search that counts them.
void Counters::count_index(int axis_number, std::int8_t phase_before) {
  const motion::Homing& homing = chip(axis_number).homing;
  if (phase_before < 0) return;
  const motion::HomingPhase& row = homing.program.phases[static_cast<std::size_t>(phase_before)];
  if (row.until != motion::Signal::index) return;
  const bool is_over = homing.phase != phase_before;
  const bool has_met = !is_over || homing.reference_known;
  if (has_met) axis(axis_number).index_count = is_over ? row.count : homing.counted;
}

/// Counts up to this moment of a tick; the rest of the tick is counted afterwards.
void Counters::count_until(const motion::SharedTick& tick, int axis_number) {
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
void Counters::at_edge(motion::SharedTick& tick, std::size_t axis, motion::Events events) {
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
void Counters::latch_by_comparator(int axis_number) {
  AxisState& state = axis(axis_number);
  const Value by = registers().of(kept_x(d9x::kLatchOfCounters), axis_number);
  const bool is_on = by == 2 ? comparators_.comparator_holds(axis_number, 3)
                             : by == 3 && comparators_.comparator_holds(axis_number, 4);
  const bool comes = is_on && !state.latch_was_on && state.latching == 0;
  state.latch_was_on = is_on;
  if (comes) take_latch(axis_number, chip(axis_number).travel_pulses);
}

void Counters::take_latch(int axis_number, std::int64_t travel) {
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
    parameters_.apply_axis_parameters(axis_number, 0);
  }
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) parameters_.set_counter(axis_number, which, 0);
  }
}

}  // namespace understudy::emulator::models::super_40nc
