#include <cstdint>
#include <cstdlib>
#include <optional>

#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/move.h"
#include "motion/profile.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

// Runs a homing table. Phases begin and end within ticks, at the edges that separate them.
namespace understudy::motion {

namespace {

/// The limit of a move, as in motion/axis.h.
constexpr std::int64_t kFarthestPlace_pulses = std::int64_t{1} << 53;

void require(bool holds, const char* what) {
  if (!holds) throw BadMotion(Refusal::out_of_range, "homing table", what);
}

/// Returns the row number to which `where` refers in row `phase`.
std::int8_t row_number(const Homing& homing, std::int8_t where) {
  if (where == HomingPhase::kNext) where = homing.row().next;
  return where == HomingPhase::kRowBelow ? static_cast<std::int8_t>(homing.phase + 1) : where;
}

bool as_sought(const HomingPhase& row, Signals signals) {
  return ((signals & bit(row.until)) != 0) == row.until_on;
}

/// Returns true if a row can continue after this limit.
bool is_limit(const HomingProgram& program, Cause why) {
  if (why == Cause::soft_limit_plus || why == Cause::soft_limit_minus) return program.soft_limits_lead_on;
  return why == Cause::limit_plus || why == Cause::limit_minus;
}

}  // namespace

void HomingProgram::add(const HomingPhase& phase) {
  if (static_cast<std::size_t>(phase_count) == kMaxPhases) {
    throw BadMotion(Refusal::no_room, "homing table", "at most 8 phases");
  }
  phases[static_cast<std::size_t>(phase_count++)] = phase;
}

void check(const HomingProgram& program) {
  require(
      program.phase_count >= 0 && static_cast<std::size_t>(program.phase_count) <= HomingProgram::kMaxPhases,
      "phases must be 0 to 8");
  const auto is_row = [&](std::int8_t where) {
    return where <= program.phase_count && where >= HomingPhase::kFail;  // one past the last row: found
  };
  for (std::int8_t i = 0; i < program.phase_count; ++i) {
    const HomingPhase& row = program.phases[static_cast<std::size_t>(i)];
    require(is_row(row.next), "the next phase must be in the table");
    require(is_row(row.if_limit), "the phase after a limit must be in the table");
    require(is_row(row.if_gone) || row.if_gone == HomingPhase::kNext,
            "the phase after a signal that has ended must be in the table");
    require(is_row(row.if_already) || row.if_already == HomingPhase::kAwait ||
                (row.if_already == HomingPhase::kNext && row.count == 1),
            "a signal to be counted must be awaited");
    require(row.direction == +1 || row.direction == -1, "direction must be +1 or -1");
    require(row.count >= 1, "count must be at least 1");
    require(row.distance_pulses >= -kFarthestPlace_pulses && row.distance_pulses <= kFarthestPlace_pulses,
            "distance must be within 2^53 pulses");
    require(row.again_while == 0 || row.distance_pulses != 0, "a distance to be repeated must not be 0");
    require(row.within_pulses >= 0 && row.within_pulses <= kFarthestPlace_pulses,
            "a search must be within 2^53 pulses");
    require(is_row(row.if_far), "the phase after a search that went too far must be in the table");
    require(row.speed >= 0 && static_cast<std::size_t>(row.speed) < HomingProgram::kMaxSpeeds,
            "speed must be in the table");
    if (row.does == HomingPhase::Does::move_at_zero_speed) continue;
    const SpeedLaw& speed = program.speeds[static_cast<std::size_t>(row.speed)];
    check(speed);
    if (row.does == HomingPhase::Does::go) {
      (void)plan(static_cast<double>(std::abs(row.distance_pulses)), speed);
    }
  }
}

Cause Axis::home(const HomingProgram& program, Tick now) {
  check(program);
  if (settings.needs_servo && !servo_on) return Cause::servo_off;
  const Homing before = homing;
  homing = Homing{.program = program};
  Cause refused = Cause::none;
  try {
    refused = enter_phase(0, {.tick = now + 1}, false);
  } catch (const BadMotion&) {
    homing = before;
    throw;
  }
  if (refused != Cause::none) {
    homing = before;
    return refused;
  }
  events_between |= bit(Event::started);
  return Cause::none;
}

const SpeedLaw* Homing::runs_on_by() const {
  if (!active()) return nullptr;
  const HomingPhase& mine = row();
  const std::int8_t number = row_number(*this, mine.next);
  const bool runs_on = mine.does == HomingPhase::Does::go && mine.then == HomingPhase::Then::run_on &&
                       mine.distance_pulses != 0 && number >= 0 && number < program.phase_count;
  if (!runs_on) return nullptr;
  const HomingPhase& next = program.phases[static_cast<std::size_t>(number)];
  const bool same_direction = (mine.distance_pulses < 0) == (next.direction < 0);
  if (next.does != HomingPhase::Does::search || !same_direction) return nullptr;
  return &program.speeds[static_cast<std::size_t>(next.speed)];
}

Profile Homing::plan_to_run_on() const {
  return plan_passing(static_cast<double>(std::abs(row().distance_pulses)), runs_on_by()->top_speed_u_s,
                      program.speeds[static_cast<std::size_t>(row().speed)]);
}

bool Axis::homing_takes(Signal signal) const {
  if (!homing.active()) return false;
  const HomingPhase& row = homing.row();
  return (row.ignores & bit(signal)) != 0 || (row.does == HomingPhase::Does::search && row.until == signal);
}

std::optional<std::int64_t> Axis::homing_place() const {
  if (!homing.active() || slowing || in_backlash) return std::nullopt;
  const HomingPhase& row = homing.row();
  if (homing.runs_on_by() != nullptr) return homing.began_pulses + row.distance_pulses;
  const bool is_bounded = row.does == HomingPhase::Does::search && row.within_pulses > 0;
  return is_bounded ? std::optional(homing.began_pulses + row.direction * row.within_pulses) : std::nullopt;
}

void Axis::homing_comes_to_its_place(Instant at) {
  const auto place = homing_place();
  if (!place || (travel_pulses - *place) * drive.direction < 0) return;
  const HomingPhase& row = homing.row();
  if (row.does == HomingPhase::Does::search) {
    drop(at);
    go_to_phase(row_number(homing, row.if_far), at, false);
  } else {
    go_to_phase(row_number(homing, row.next), at, true);
  }
}

void Axis::homing_sees(Signals changed, Instant at) {
  const HomingPhase& row = homing.row();
  const bool looks = row.does == HomingPhase::Does::search && !slowing;
  if (!looks || (changed & bit(row.until)) == 0 || !as_sought(row, signals)) return;
  if (++homing.counted < row.count) return;
  homing.met = true;
  if (row.marks) mark_reference();
  switch (row.then) {
    case HomingPhase::Then::stop_at_once: end(Cause::arrived, at); break;
    case HomingPhase::Then::slow_down: slow(at, Cause::arrived); break;
    case HomingPhase::Then::run_on: go_to_phase(row_number(homing, row.next), at, true); break;
  }
}

void Axis::mark_reference() {
  homing.reference_known = true;
  homing.reference_pulses = travel_pulses;
}

/// A stop in progress may get a more serious cause: a limit, or a stop command while the axis decelerates for
/// home.
void Axis::homing_slows(Cause why) {
  const bool continues =
      why == Cause::arrived || (is_limit(homing.program, why) && homing.row().if_limit != HomingPhase::kFail);
  if (!continues && homing.ended_by == Cause::none) homing.ended_by = why;
}

void Axis::homing_stands(Cause why, Instant at) {
  const HomingPhase& row = homing.row();
  const bool limit_is_harmless = is_limit(homing.program, why) && row.if_limit != HomingPhase::kFail;
  if (homing.ended_by != Cause::none) {
    end_homing(homing.ended_by, at);
  } else if (why != Cause::arrived && !limit_is_harmless) {
    end_homing(why, at);
  } else if (limit_is_harmless && !homing.met) {
    go_to_phase(row_number(homing, row.if_limit), at, false);
  } else if (row.does == HomingPhase::Does::go && (signals & row.again_while) != 0) {
    go_to_phase(homing.phase, at, false);
  } else if (row.does == HomingPhase::Does::search && !as_sought(row, signals)) {
    go_to_phase(row_number(homing, row.if_gone), at, false);
  } else {
    go_to_phase(row_number(homing, row.next), at, false);
  }
}

void Axis::go_to_phase(std::int8_t number, Instant at, bool running) {
  Cause failed = Cause::homing_failed;
  try {
    failed = enter_phase(number, at, running);
  } catch (const BadMotion&) {
    // The speed law cannot plan the return. This is detected only here, and a tick must not throw.
  }
  if (failed != Cause::none) end_homing(failed, at);
}

/// Begins phase `number`, or the first phase after it that has anything to do. Returns none if the phase runs
/// or home is found. `running`: the axis continues to move.
Cause Axis::enter_phase(std::int8_t number, Instant at, bool running) {
  // A table may contain a cycle of phases that have nothing to do, so the number of phases entered is
  // limited.
  for (std::size_t entered = 0; entered <= HomingProgram::kMaxPhases; ++entered) {
    if (number < 0) return Cause::homing_failed;  // kFail
    if (number >= homing.program.phase_count) {
      end_homing(Cause::arrived, at);
      return Cause::none;
    }
    homing.phase = number;
    homing.met = false;
    homing.counted = 0;
    homing.began_pulses = travel_pulses;
    const HomingPhase& row = homing.row();
    const std::int8_t next = row_number(homing, row.next);
    if (row.does == HomingPhase::Does::search) {
      if (as_sought(row, signals) && row.if_already != HomingPhase::kAwait) {
        if (row.marks && row.if_already == HomingPhase::kNext) mark_reference();
        number = row_number(homing, row.if_already);
        continue;
      }
      if (running && drive.direction == row.direction) {
        const SpeedLaw& speed = homing.program.speeds[static_cast<std::size_t>(row.speed)];
        if (speed != law) go_on_by(speed, at);
        return Cause::none;
      }
    } else if (row.does == HomingPhase::Does::go) {
      const bool needless = row.again_while != 0 && (signals & row.again_while) == 0;
      if (needless || row.distance_pulses == 0) {
        number = next;
        continue;
      }
    } else if (row.does == HomingPhase::Does::go_back && homing.reference_pulses == travel_pulses) {
      number = next;
      continue;
    }
    const Cause refused = begin_phase(at);
    if (!is_limit(homing.program, refused) || row.if_limit == HomingPhase::kFail) return refused;
    number = row_number(homing, row.if_limit);
  }
  return Cause::homing_failed;
}

Cause Axis::begin_phase(Instant at) {
  const HomingPhase& row = homing.row();
  const SpeedLaw& speed = homing.program.speeds[static_cast<std::size_t>(row.speed)];
  const auto go = [&](std::int64_t distance_pulses) {
    return begin(Task::move, distance_pulses < 0 ? -1 : +1, distance_pulses, speed, at, true);
  };
  switch (row.does) {
    case HomingPhase::Does::search: return begin(Task::endless, row.direction, 0, speed, at, true);
    case HomingPhase::Does::go:
      if (homing.runs_on_by() == nullptr) return go(row.distance_pulses);
      return begin(Task::endless, row.distance_pulses < 0 ? -1 : +1, 0, speed, at, true);
    case HomingPhase::Does::go_back: return go(homing.reference_pulses - travel_pulses);
    case HomingPhase::Does::move_at_zero_speed: break;
  }
  if (const Cause why_not = forbidden(row.direction); why_not != Cause::none) return why_not;
  drop();
  task = Task::hanging;
  cause = Cause::none;
  drive.move_at_zero_speed(row.direction);
  return Cause::none;
}

void Axis::end_homing(Cause why, Instant at) {
  drop();
  homing.ended_in = homing.phase;
  homing.ended_by = why;
  homing.phase = -1;
  homing.met = false;
  raise(Event::ended, at);
  if (why == Cause::arrived) {
    raise(Event::homed, at);
    if (!homing.reference_known) homing.reference_pulses = travel_pulses;
  }
  cause = why == Cause::arrived || why == Cause::stopped ? why : Cause::homing_failed;
}

}  // namespace understudy::motion
