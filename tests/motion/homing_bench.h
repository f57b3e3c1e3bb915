// A bench for homing: an axis, the switches along its travel, and the trace of its motion there.
//
// Tables are written for the home direction +; mirrored() reverses a bench or a trace, so that each test also
// runs for the direction -.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/homing_tables.h"

namespace understudy::motion {

inline constexpr std::int64_t kFar = 1'000'000'000;
/// Marks the end of a leg that did not come to rest, because the next leg began during motion.
inline constexpr std::int64_t kRunsOn = INT64_MIN;

/// A leg: a row of the homing table, in a direction, until it comes to rest.
struct Leg {
  int row = 0;
  int direction = +1;
  std::int64_t stood_at = 0;

  bool operator==(const Leg&) const = default;
};
using Trace = std::vector<Leg>;

inline std::ostream& operator<<(std::ostream& out, const Leg& leg) {
  out << "row " << leg.row << (leg.direction > 0 ? " +" : " -");
  return leg.stood_at == kRunsOn ? out << " runs on" : out << " to " << leg.stood_at;
}

inline Trace mirrored(Trace trace) {
  for (Leg& leg : trace) {
    leg.direction = -leg.direction;
    if (leg.stood_at != kRunsOn) leg.stood_at = -leg.stood_at;
  }
  return trace;
}

inline Signal mirrored(Signal signal) {
  if (signal == Signal::limit_plus) return Signal::limit_minus;
  return signal == Signal::limit_minus ? Signal::limit_plus : signal;
}

inline Cause mirrored(Cause cause) {
  switch (cause) {
    case Cause::limit_plus: return Cause::limit_minus;
    case Cause::limit_minus: return Cause::limit_plus;
    case Cause::soft_limit_plus: return Cause::soft_limit_minus;
    case Cause::soft_limit_minus: return Cause::soft_limit_plus;
    default: return cause;
  }
}

inline Environment mirrored(Environment environment) {
  for (std::size_t i = 0; i < environment.zone_count; ++i) {
    Environment::Zone& zone = environment.zones[i];
    zone = {.signal = mirrored(zone.signal), .from = -zone.to, .to = -zone.from};
  }
  environment.index_at = -environment.index_at - (environment.index_width - 1);
  return environment;
}

struct HomingBench {
  Axis axis;
  Environment environment;
  Tick now = 0;
  std::int64_t pulses_out = 0;
  Events seen = 0;
  Trace trace;

  /// An axis at `start` that has sampled its switches once.
  HomingBench(const Environment& machine, std::int64_t start) : environment(machine) {
    axis.travel_pulses = axis.base_pulses = start;
    axis.servo_on = true;
    step();
  }

  Cause home(const HomingProgram& program) {
    const Cause refused = axis.home(program, now);
    if (axis.homing.active()) runs_ = leg_now();
    return refused;
  }

  void step() {
    const std::int64_t drop_before = axis.backlash_sent + axis.travel_pulses;
    const std::int64_t out = axis.step(++now, environment);
    ASSERT_EQ(out, axis.backlash_sent + axis.travel_pulses - drop_before);
    pulses_out += out;
    seen |= axis.events;
    const bool active = axis.homing.active();
    const Running is = active ? leg_now() : Running{};
    if (runs_.row >= 0 && is != runs_) {
      const std::int64_t stood_at = active ? axis.base_pulses : axis.travel_pulses;
      const bool ran_on = active && is.began_at == runs_.began_at && is.direction == runs_.direction;
      trace.push_back(
          {.row = runs_.row, .direction = runs_.direction, .stood_at = ran_on ? kRunsOn : stood_at});
    }
    runs_ = is;
  }

  /// Runs until homing has ended, or until the tick `until`. Returns true if homing has ended.
  bool run(Tick until = 200'000) {
    while (axis.homing.active() && now < until) step();
    return !axis.homing.active();
  }
  bool run_until_row(int row, Tick until = 200'000) {
    while (axis.homing.active() && axis.homing.phase != row && now < until) step();
    return axis.homing.phase == row;
  }
  void run_ticks(Tick ticks) {
    for (Tick i = 0; i < ticks; ++i) step();
  }

 private:
  /// A leg starts where its drive's coordinate is 0.
  struct Running {
    int row = -1;
    int direction = 0;
    std::int64_t began_at = 0;
    bool operator==(const Running&) const = default;
  };
  Running leg_now() const {
    return {.row = axis.homing.phase,
            .direction = axis.drive.direction < 0 ? -1 : +1,
            .began_at = axis.base_pulses};
  }
  Running runs_;
};

/// The expected end of a homing.
struct Ending {
  Cause by = Cause::arrived;
  int in_row = -1;  // -1: does not matter
};

inline void expect_ended(const HomingBench& bench, const Ending& ending) {
  EXPECT_FALSE(bench.axis.homing.active());
  EXPECT_FALSE(bench.axis.moving());
  EXPECT_EQ(bench.axis.homing.ended_by, ending.by);
  if (ending.in_row >= 0) {
    EXPECT_EQ(bench.axis.homing.ended_in, ending.in_row);
  }
  const bool found = ending.by == Cause::arrived;
  const bool commanded = ending.by == Cause::stopped;
  EXPECT_EQ(bench.axis.cause, found || commanded ? ending.by : Cause::homing_failed);
  EXPECT_EQ((bench.seen & bit(Event::homed)) != 0, found);
  EXPECT_NE(bench.seen & bit(Event::ended), 0);
}

// ---- Closed forms for a ramp of constant slope from standstill, in pulses and seconds.

inline double brake_pulses(double speed_pps, double slope) { return speed_pps * speed_pps / (2 * slope); }

/// Returns the duration from rest over `pulses`, without decelerating.
inline double time_to_reach_s(double pulses, double speed_pps, double slope) {
  if (pulses < brake_pulses(speed_pps, slope)) return std::sqrt(2 * pulses / slope);
  return pulses / speed_pps + speed_pps / (2 * slope);
}

/// Returns the duration from rest to rest, with equal ramps.
inline double time_of_move_s(double pulses, double speed_pps, double slope) {
  if (pulses < 2 * brake_pulses(speed_pps, slope)) return 2 * std::sqrt(pulses / slope);
  return pulses / speed_pps + speed_pps / slope;
}

inline SpeedLaw slope_law(double top_pps, double slope, double start_pps = 0) {
  return {.start_speed_u_s = start_pps,
          .top_speed_u_s = top_pps,
          .up = RampLaw::by_slope(slope),
          .down = RampLaw::by_slope(slope)};
}

}  // namespace understudy::motion
