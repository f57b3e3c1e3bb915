#include "emulator/models/super_40nc/axis/counters.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/axis/axis_state.h"
#include "emulator/models/super_40nc/axis/comparator_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "motion/axis.h"
#include "motion/axis_tick.h"
#include "motion/encoder_line.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/tick.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Returns the counts up to a moment of a tick. They are spread evenly over the tick, the last one at its
/// end.
std::int64_t spread(std::int64_t counts, double at_s) {
  const double part = at_s * motion::kTicksPerSecond;
  const auto come = static_cast<std::int64_t>(part * static_cast<double>(std::abs(counts)) + 1e-9);
  return counts < 0 ? -come : come;
}

/// Returns how often half the chip's clock of 19.6608 MHz counts in a number of ticks.
std::int64_t clock_counts(Tick ticks) { return ticks * 49'152 / 5; }

std::int64_t clock_until(Tick tick, double at_s) {
  constexpr std::int64_t kFifths = 49'152;
  const auto in_it = static_cast<std::int64_t>(at_s * motion::kTicksPerSecond * kFifths + 1e-6);
  return ((tick - 1) * kFifths + in_it) / 5 - clock_counts(tick - 1);
}

}  // namespace

std::int64_t counts_of(const Settings& settings, int axis, int counter, const Counted& counted) {
  const bool with_backlash = is_bit(settings.raw(stored_x(d9x::kCountCorrect), axis), counter);
  const std::int64_t pulses = counted.pulses + (with_backlash ? counted.backlash : 0);
  const std::int64_t encoder = settings.is_on(stored_x(d9x::kEncoderDisable), axis) ? 0 : counted.encoder;
  const auto pick = [](Value source, auto... of) {
    const std::array all{of...};
    return all[static_cast<std::size_t>(source)];
  };
  switch (counter) {
    case kCounter2: return pick(settings.of(stored_x(d9x::kC2Source), axis), encoder, pulses, counted.wheel);
    case kCounter3:
      return pick(settings.of(stored_x(d9x::kC3Source), axis), pulses - encoder, pulses - counted.wheel,
                  encoder - counted.wheel);
    default:
      return pick(settings.of(stored_x(d9x::kC4Source), axis), pulses, encoder, counted.wheel, counted.clock);
  }
}

BeforeTick Counters::begin_tick(Tick tick, std::int32_t wheel_counts) {
  BeforeTick before;
  tick_ = tick;
  wheel_of_tick_ = wheel_counts;
  for (std::size_t n = 0; n < kAxisCount; ++n) {
    before.travel[n] = axes_.chips[n].travel_pulses;
    before.phase[n] = axes_.chips[n].homing.phase;
    so_far_[n] = {.travel = before.travel[n]};
  }
  return before;
}

void Counters::end_tick(int axis_number, const BeforeTick& before) {
  const auto n = static_cast<std::size_t>(axis_number);
  axis(axis_number).followed_pulses = chip(axis_number).travel_pulses - before.travel[n];
  count_index(axis_number, before.phase[n]);
  count_without_encoder(axis_number, 1 / motion::kTicksPerSecond);
}

/// Adds counts to COUNTER2, COUNTER3 and COUNTER4.
void Counters::add_to_counters(int axis_number, const Counted& counted) {
  const Settings settings = registers();
  for (int which = kCounter2; which <= kCounter4; ++which) {
    const std::int64_t counts = counts_of(settings, axis_number, which, counted);
    if (counts == 0 || !counts_now(axis_number, which)) continue;
    std::int32_t& its_count = axis(axis_number).counts[static_cast<std::size_t>(which - 1)];
    its_count = wrapped(its_count + counts);
    if (which == kCounter3) its_count = static_cast<std::int16_t>(its_count);  // 16 bits on the chip
  }
}

bool Counters::counts_now(int axis_number, int which) const {
  const Settings settings = registers();
  if (is_bit(settings.raw(stored_x(d9x::kDisableC2ToC4), axis_number), which - 1) ||
      is_held_cleared(axis_number, which)) {
    return false;
  }
  const AxisState& state = axis(axis_number);
  return which != kCounter4 || !settings.is_on(stored_x(d9x::kC4Enable), axis_number) || state.moves() ||
         state.followed_pulses != 0;
}

bool Counters::counts_a_clock(int axis) const {
  return has_clock_ && registers().of(stored_x(d9x::kC4Source), axis) == 3;
}

bool Counters::is_quiet(int axis_number) const {
  const motion::Axis& motor = chip(axis_number);
  const AxisState& state = axis(axis_number);
  return !motor.moving() && !motor.must_recheck && motor.events == 0 && motor.events_between == 0 &&
         !counts_a_clock(axis_number) && state.sent_pulses == 0 && state.followed_pulses == 0 &&
         environment(axis_number).version == motor.seen_version;
}

bool Counters::acts_each_tick(int axis) const {
  return counts_a_clock(axis) || registers().of(stored_x(d9x::kLatchOfCounters), axis) >= 2;
}

void Counters::set_encoder(int axis_number, std::int64_t counts) {
  count_encoder(axis_number, counts);
  chip(axis_number)
      .set_encoder(registers().is_on(stored_x(d9x::kEncoderDirection), axis_number) ? -counts : counts);
}

void Counters::count_encoder(int axis_number, std::int64_t counts) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  const std::int64_t turned = counts - state.encoder_counts;
  state.encoder_counts = counts;
  if (turned == 0 || !ground_.powered()) return;
  const bool is_reversed = settings.is_on(stored_x(d9x::kEncoderDirection), axis_number);
  add_to_counters(axis_number, {.encoder = is_reversed ? -turned : turned});
}

void Counters::clear_counters(int axis_number) {
  const std::uint8_t cleared = std::exchange(axis(axis_number).clears, std::uint8_t{0});
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) parameters_.set_counter(axis_number, which, 0);
  }
}

void Counters::count(int axis_number, const Counted& counted) {
  AxisState& state = axis(axis_number);
  state.backlash_seen += counted.backlash;
  const bool is_beside_travel = counted.backlash != 0;
  if (is_beside_travel && is_bit(registers().raw(stored_x(d9x::kCountCorrect), axis_number), 0)) {
    state.command.set(machine_pulses(axis_number) + counted.backlash, chip(axis_number).travel_pulses);
    parameters_.apply_axis_parameters(axis_number, 0);
  }
  add_to_counters(axis_number, counted);
  if (is_beside_travel)
    comparators_.set_comparators(axis_number);  // the comparators that follow the travel would not notice it
}

/// D8x71: counts the edges of C in the homing row that searches for them.
void Counters::count_index(int axis_number, std::int8_t phase_before) {
  const motion::Homing& homing = chip(axis_number).homing;
  if (phase_before < 0) return;
  const motion::HomingPhase& row = homing.program.phases[static_cast<std::size_t>(phase_before)];
  if (row.until != motion::Signal::index) return;
  const bool is_over = homing.phase != phase_before;
  const bool has_met = !is_over || homing.reference_known;
  if (has_met) axis(axis_number).index_count = is_over ? row.count : homing.counted;
}

Counted Counters::counted_until(int axis_number, double at_s, const motion::AxisPlace& place) const {
  const AxisState& state = axis(axis_number);
  const CountedSoFar& so_far = so_far_[static_cast<std::size_t>(axis_number)];
  Counted counted{.pulses = place.travel_pulses - so_far.travel,
                  .backlash = place.backlash_sent - state.backlash_seen,
                  .wheel = spread(wheel_of_tick_, at_s) - so_far.wheel};
  if (counts_a_clock(axis_number)) counted.clock = clock_until(tick_, at_s) - so_far.clock;
  const motion::EncoderLine& encoder = environment(axis_number).encoder;
  if (encoder.is_known()) {
    counted.encoder =
        encoder.at(place.travel_pulses) - (encoder.turned ? -state.encoder_counts : state.encoder_counts);
  }
  return counted;
}

/// Counts the pulses of an axis up to a moment, at its present position.
void Counters::count_without_encoder(int axis_number, double at_s) {
  const motion::Axis& motor = chip(axis_number);
  Counted counted = counted_until(
      axis_number, at_s, {.travel_pulses = motor.travel_pulses, .backlash_sent = motor.backlash_sent});
  counted.encoder = 0;
  CountedSoFar& so_far = so_far_[static_cast<std::size_t>(axis_number)];
  so_far = {.travel = motor.travel_pulses,
            .wheel = so_far.wheel + counted.wheel,
            .clock = so_far.clock + counted.clock};
  count(axis_number, counted);
}

void Counters::count_until(int axis_number, double at_s) {
  count_without_encoder(axis_number, at_s);
  const motion::EncoderLine& encoder = environment(axis_number).encoder;
  if (!encoder.is_known()) return;
  const std::int64_t counts = encoder.at(chip(axis_number).travel_pulses);
  count_encoder(axis_number, encoder.turned ? -counts : counts);
}

void Counters::latch_by_comparator(int axis_number) {
  AxisState& state = axis(axis_number);
  const Value by = registers().of(stored_x(d9x::kLatchOfCounters), axis_number);
  const bool is_on = by == 2 ? comparators_.comparator_holds(axis_number, 3)
                             : by == 3 && comparators_.comparator_holds(axis_number, 4);
  const bool comes = is_on && !state.latch_was_on && state.latching == 0;
  state.latch_was_on = is_on;
  if (comes) take_latch(axis_number, chip(axis_number).travel_pulses, chip_speed(axis_number));
}

void Counters::take_latch(int axis_number, std::int64_t travel, std::int64_t speed) {
  AxisState& state = axis(axis_number);
  const Settings settings = registers();
  if (settings.is_on(stored_x(d9x::kStopLatch), axis_number)) return;
  state.latched[0] = is_held_cleared(axis_number, kCounter1) ? 0 : wrapped(state.command.at(travel));
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    state.latched[static_cast<std::size_t>(which)] = counter(axis_number, which);
  }
  if (settings.is_on(stored_x(d9x::kC3LatchSpeed), axis_number)) state.latched[2] = wrapped(speed);
  const std::int32_t cleared = settings.raw(stored_x(d9x::kLatchResetC), axis_number);
  if (is_bit(cleared, 0)) {
    state.command.set(0, travel);
    parameters_.apply_axis_parameters(axis_number, 0);
  }
  for (int which = 1; which < static_cast<int>(kCounters); ++which) {
    if (is_bit(cleared, which)) parameters_.set_counter(axis_number, which, 0);
  }
}

}  // namespace understudy::emulator::models::super_40nc
