#include "emulator/world/plant/plant.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "base/simulated_time.h"
#include "base/state/state_error.h"

namespace understudy::emulator::world {

namespace {

/// Used as the stops of a machine that has none. A century of pulses cannot reach it.
constexpr std::int64_t kFarthest_pulses = 1'000'000'000'000'000;

PulseSpan wider(PulseSpan span, std::int64_t pulses) { return {span.first - pulses, span.last + pulses}; }

bool holds(PulseSpan span, std::int64_t at) { return at >= span.first && at <= span.last; }

/// Returns the positions in which a switch is on, given its current state.
PulseSpan span_of(const SwitchSetup& setup, bool is_on) {
  return wider(setup.on, is_on ? setup.hysteresis_pulses : 0);
}

/// Returns the distance from the beginning of the previous index pulse.
std::int64_t index_phase(const IndexSetup& index, std::int64_t at) {
  const std::int64_t phase = (at - index.at) % index.period;
  return phase < 0 ? phase + index.period : phase;
}

/// Returns how many counts of its turn the wheel has completed. The counts are spread evenly over all ticks.
std::int64_t turned(const PlantAxis::State& state) {
  __extension__ using Wide = __int128;
  if (state.turn_ticks == 0) return 0;
  const Wide gone = state.turn_ticks - state.ticks_to_turn;
  return static_cast<std::int64_t>(Wide{state.turn_counts} * gone / state.turn_ticks);
}

}  // namespace

void PlantAxis::step(Tick tick, std::int64_t pulses, DriveInputs inputs) {
  if (state_.faults.slipped_pulses != 0) {
    shift(state_.faults.slipped_pulses);
    state_.faults.slipped_pulses = 0;
  }
  turn_wheel();
  // The state of the drive at the beginning of the tick decides which pulses move the machine.
  const std::int64_t steps = pulses_that_step(pulses);
  state_.lost_pulses += std::abs(pulses - steps);
  if (steps != 0) move(steps);
  step_drive(tick, inputs);
  find_quiet_places();
}

/// Finds the positions between which no contact changes. With a drive, there are none, because a drive runs
/// in every tick: its controller's outputs may have changed.
void PlantAxis::find_quiet_places() {
  disturb();
  if (setup_.drive) return;
  const PulseSpan alike = places_alike();
  quiet_from_ = alike.first;
  quiet_to_ = alike.last;
}

PulseSpan PlantAxis::places_alike() const {
  constexpr PulseSpan kNone{1, 0};
  const bool is_broken = state_.faults != MachineFaults{} || state_.loses_one_in != 0;
  if (setup_.has_wheel || state_.ticks_to_turn != 0 || is_broken || !steps_all()) return kNone;
  const std::int64_t at = state_.position_pulses;
  const PulseSpan stops = setup_.travel.value_or(PulseSpan{-kFarthest_pulses, kFarthest_pulses});
  std::int64_t from = stops.first;
  std::int64_t to = stops.last;
  // Narrows the span to the range in which a switch does not change.
  const auto stay = [&](bool is_on, PulseSpan on) {
    if (is_on) {
      from = std::max(from, on.first);
      to = std::min(to, on.last);
    } else if (at < on.first) {
      to = std::min(to, on.first - 1);
    } else {
      from = std::max(from, on.last + 1);
    }
  };
  if (setup_.home) stay(state_.at_home, home_span());
  if (setup_.near_home) stay(state_.at_near_home, span_of(*setup_.near_home, state_.at_near_home));
  if (setup_.mark) stay(state_.at_mark, span_of(*setup_.mark, state_.at_mark));
  if (setup_.index) {
    const std::int64_t begin = at - index_phase(*setup_.index, at);
    const std::int64_t end = begin + setup_.index->width - 1;
    stay(at <= end, at <= end ? PulseSpan{begin, end} : PulseSpan{begin + setup_.index->period, to});
    if (at > end) from = std::max(from, end + 1);
  }
  if (setup_.lower_limit) stay(state_.at_lower_limit, {-kFarthest_pulses, lower_limit_end()});
  if (setup_.upper_limit) stay(state_.at_upper_limit, {upper_limit_end(), kFarthest_pulses});
  return {from, to};
}

std::int64_t PlantAxis::pulses_that_step(std::int64_t pulses) {
  if (state_.loses_one_in != state_.faults.loses_one_in) {
    state_.loses_one_in = state_.faults.loses_one_in;
    state_.pulses_to_lose = 0;
  }
  if (pulses == 0) return 0;
  if (state_.faults.stalled || in_alarm()) return 0;
  if (setup_.drive && !state_.ready) return 0;
  const std::int64_t one_in = state_.faults.loses_one_in;
  if (one_in == 0) return pulses;
  const std::int64_t made = state_.pulses_to_lose + std::abs(pulses);
  state_.pulses_to_lose = made % one_in;
  const std::int64_t left = std::abs(pulses) - made / one_in;
  return pulses < 0 ? -left : left;
}

void PlantAxis::step_drive(Tick tick, DriveInputs inputs) {
  if (!setup_.drive) return;
  state_.seen = inputs;
  const bool is_disabled = (inputs.servo || state_.wired.servo) != setup_.drive->enabled_by;
  const bool clears = inputs.alarm_clear || state_.wired.alarm_clear || (clears_by_disabling_ && is_disabled);
  state_.alarm_latched = state_.faults.alarm || (state_.alarm_latched && !clears);
  const bool enabled = !is_disabled && !in_alarm();
  if (!enabled) {
    state_.enabled_at = kNever;
  } else if (state_.enabled_at == kNever) {
    state_.enabled_at = tick;
  }
  state_.ready = enabled && tick - state_.enabled_at >= setup_.drive->ready_after;
}

bool PlantAxis::set_wired(DriveInput which, bool is_on) {
  if (state_.wired[which] == is_on) return false;
  disturb();
  state_.wired[which] = is_on;
  return true;
}

Tick PlantAxis::next_active_tick(Tick done) const {
  if (state_.faults.slipped_pulses != 0 || state_.ticks_to_turn != 0) return done + 1;
  if (setup_.drive && state_.enabled_at != kNever && !state_.ready) {
    return std::max(done + 1, state_.enabled_at + setup_.drive->ready_after);
  }
  return kNever;
}

void PlantAxis::turn(std::int64_t counts, Tick ticks) {
  disturb();
  // The rest of the previous turn is added to the new turn.
  state_.turn_counts = state_.turn_counts - turned(state_) + counts;
  state_.turn_ticks = state_.ticks_to_turn = std::max<Tick>({state_.ticks_to_turn, ticks, 1});
}

void PlantAxis::turn_wheel() {
  if (state_.ticks_to_turn == 0) return;
  const std::int64_t before = turned(state_);
  --state_.ticks_to_turn;
  state_.wheel_counts += turned(state_) - before;
  if (state_.ticks_to_turn == 0) state_.turn_counts = state_.turn_ticks = 0;
}

bool PlantAxis::has_contact(Contact which) const {
  switch (which) {
    case Contact::home: return setup_.home.has_value();
    case Contact::lower_limit: return setup_.lower_limit.has_value();
    case Contact::upper_limit: return setup_.upper_limit.has_value();
    case Contact::alarm:
    case Contact::ready: return setup_.drive.has_value();
    case Contact::near_home: return setup_.near_home.has_value();
    case Contact::mark: return setup_.mark.has_value();
    case Contact::index: return setup_.index.has_value();
  }
  return false;
}

bool PlantAxis::at_index() const {
  return setup_.index && index_phase(*setup_.index, state_.position_pulses) < setup_.index->width;
}

std::optional<SwitchSetup> PlantAxis::switch_of(Contact which) const {
  if (!has_contact(which)) return std::nullopt;
  SwitchSetup found;
  bool is_on = false;
  switch (which) {
    case Contact::home:
      found = home_switch();
      is_on = state_.at_home;
      break;
    case Contact::near_home:
      found = *setup_.near_home;
      is_on = state_.at_near_home;
      break;
    case Contact::mark:
      found = *setup_.mark;
      is_on = state_.at_mark;
      break;
    case Contact::lower_limit:
      found = {{-kFarthest_pulses, *setup_.lower_limit}, setup_.limit_hysteresis_pulses, setup_.limits_open};
      is_on = state_.at_lower_limit;
      break;
    case Contact::upper_limit:
      found = {{*setup_.upper_limit, kFarthest_pulses}, setup_.limit_hysteresis_pulses, setup_.limits_open};
      is_on = state_.at_upper_limit;
      break;
    default: return std::nullopt;
  }
  // A switch that is on outside its span releases at the end of its hysteresis.
  if (is_on && !holds(found.on, state_.position_pulses)) {
    found.on = wider(found.on, found.hysteresis_pulses);
    found.hysteresis_pulses = 0;
  }
  // A switch that is on at a stop never releases there, because the machine cannot pass its stops.
  const PulseSpan stops = setup_.travel.value_or(PulseSpan{-kFarthest_pulses, kFarthest_pulses});
  if (found.on.last < stops.first || found.on.first > stops.last) return std::nullopt;
  if (found.on.first <= stops.first) found.on.first = -kFarthest_pulses;
  if (found.on.last >= stops.last) found.on.last = kFarthest_pulses;
  return found;
}

bool PlantAxis::contact(Contact which) const {
  if (which == Contact::alarm) return in_alarm() != (setup_.drive && setup_.drive->alarm_opens);
  if (!has_contact(which)) return false;
  switch (which) {
    case Contact::home: return at_home() != setup_.home_opens;
    case Contact::lower_limit: return at_lower_limit() != setup_.limits_open;
    case Contact::upper_limit: return at_upper_limit() != setup_.limits_open;
    case Contact::near_home: return at_near_home() != setup_.near_home->opens;
    case Contact::mark: return at_mark() != setup_.mark->opens;
    case Contact::index: return at_index();
    default: return ready();
  }
}

void PlantAxis::move(std::int64_t steps) {
  disturb();
  state_.lost_pulses += std::abs(steps - shift(steps));
}

std::int64_t PlantAxis::shift(std::int64_t steps) {
  const PulseSpan stops = setup_.travel.value_or(PulseSpan{-kFarthest_pulses, kFarthest_pulses});
  const std::int64_t before = state_.position_pulses;
  state_.position_pulses = std::clamp(before + steps, stops.first, stops.last);
  move_switches(before);
  return state_.position_pulses - before;
}

void PlantAxis::move_switches(std::int64_t from) {
  const std::int64_t at = state_.position_pulses;
  // The positions that can affect a switch: the whole travel, or only its end.
  const PulseSpan swept =
      checks_between_ ? PulseSpan{std::min(from, at), std::max(from, at)} : PulseSpan{at, at};
  const auto move = [&](const SwitchSetup& setup, bool& is_on) {
    is_on = is_on || (swept.first <= setup.on.last && swept.last >= setup.on.first);
    is_on = holds(span_of(setup, is_on), at);
  };
  if (setup_.home) move(home_switch(), state_.at_home);
  if (setup_.near_home) move(*setup_.near_home, state_.at_near_home);
  if (setup_.mark) move(*setup_.mark, state_.at_mark);
  if (setup_.lower_limit) {
    state_.at_lower_limit = state_.at_lower_limit || swept.first <= *setup_.lower_limit;
    state_.at_lower_limit = at <= lower_limit_end();
  }
  if (setup_.upper_limit) {
    state_.at_upper_limit = state_.at_upper_limit || swept.last >= *setup_.upper_limit;
    state_.at_upper_limit = at >= upper_limit_end();
  }
}

PulseSpan PlantAxis::home_span() const { return span_of(home_switch(), state_.at_home); }

std::int64_t PlantAxis::lower_limit_end() const {
  return *setup_.lower_limit + (state_.at_lower_limit ? setup_.limit_hysteresis_pulses : 0);
}

std::int64_t PlantAxis::upper_limit_end() const {
  return *setup_.upper_limit - (state_.at_upper_limit ? setup_.limit_hysteresis_pulses : 0);
}

void PlantAxis::check(const State& state) {
  require_within(state.position_pulses, -kFarthest_pulses, kFarthest_pulses);
  for (const std::int64_t pulses :
       {state.lost_pulses, state.pulses_to_lose, state.loses_one_in, state.faults.loses_one_in}) {
    require_state(pulses >= 0, "a machine has lost a negative number of pulses");
    require_reach(pulses);
  }
  require_reach(state.faults.slipped_pulses);
  require_reach(state.wheel_counts);
  require_reach(state.turn_counts);
  require_reach(state.turn_ticks);
  require_state(state.ticks_to_turn >= 0, "a wheel's time to turn is negative");
  require_state(state.ticks_to_turn <= state.turn_ticks, "a wheel has more time left than its turn takes");
  require_reach(state.faults.encoder_noise_counts);
  if (state.enabled_at != kNever) require_reach(state.enabled_at);
}

void PlantAxis::restore(const State& state) {
  check(state);
  state_ = state;
  disturb();
}

std::uint64_t PlantAxis::Encoder::wide_counts_at(std::int64_t position_pulses) const {
  // Whole revolutions and the remainder are calculated separately, so that only the count itself can
  // overflow.
  const std::int64_t at = position_pulses - pulses_at_0;
  const std::int64_t per_revolution = pulses_per_revolution;
  const std::int64_t revolutions = at / per_revolution - (at % per_revolution < 0 ? 1 : 0);
  const std::int64_t rest = at - revolutions * per_revolution;
  const auto counts_each = static_cast<std::uint64_t>(counts_per_revolution);
  const std::uint64_t counts =
      static_cast<std::uint64_t>(revolutions) * counts_each +
      static_cast<std::uint64_t>(rest) * counts_each / static_cast<std::uint64_t>(per_revolution);
  return reversed ? 0 - counts : counts;
}

std::int64_t PlantAxis::encoder_counts() const {
  if (!has_encoder()) return 0;  // without an encoder, a revolution may have no pulses
  std::uint64_t counts = encoder_.wide_counts_at(state_.position_pulses);
  if (setup_.has_wheel) {
    counts = static_cast<std::uint64_t>(state_.wheel_counts);
    if (encoder_.reversed) counts = 0 - counts;
  }
  return Encoder::in_62_bits(counts + static_cast<std::uint64_t>(state_.faults.encoder_noise_counts));
}

}  // namespace understudy::emulator::world
