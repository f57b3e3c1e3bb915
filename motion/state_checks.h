// Checks of restored values, for state_fields.h. Saved bytes may be arbitrary, and some types have more bit
// patterns than valid values. The checks ensure that later ticks neither index beyond a table nor run
// forever.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/state/state_error.h"
#include "motion/axis.h"
#include "motion/bad_motion.h"
#include "motion/coordinated.h"
#include "motion/external_drive.h"
#include "motion/synchronous.h"

namespace understudy::motion {

/// Checks pulses and ticks: their sums with what a drive can send must still fit in 64 bits.
inline void require_reach(std::int64_t value) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 56;
  require_within(value, -kFarthest, kFarthest);
}

template <class... Doubles>
void require_all_finite(Doubles... values) {
  require_state((std::isfinite(values) && ...), "a quantity must be finite");
}

/// Converts a BadMotion from the types' own checks into a refusal of the state.
void require_accepted(auto check) {
  try {
    check();
  } catch (const BadMotion& bad) {
    throw StateError(bad.what());
  }
}

/// Types without checks: all bits are valid.
template <class T>
void check_restored(const T&) {}

inline void check_restored(const Instant& at) {
  require_reach(at.tick);
  require_state(at.after_s >= 0 && at.after_s <= 1.001 / kTicksPerSecond, "a moment must be within its tick");
}

inline void check_restored(const Segment& s) {
  require_all_finite(s.begin_s, s.position_u, s.speed_u_s, s.acceleration_u_s2, s.jerk_u_s3);
}

inline void check_restored(const Profile& profile) {
  require_within(profile.segment_count, 0, static_cast<std::int64_t>(Profile::kMaxSegments));
  require_state(profile.duration_s >= 0 && !std::isnan(profile.end_position_u), "a profile must have an end");
  require_state(profile.endless() || std::isfinite(profile.end_position_u), "a profile must have an end");
}

inline void check_restored(const TickSegment& s) {
  require_all_finite(s.begin_ticks, s.place, s.first, s.second, s.third);
}

inline void check_restored(const PulseDrive& drive) {
  check_restored(drive.beginning());
  require_within(drive.direction, -1, +1);
  require_reach(drive.sent_pulses);
  require_state(drive.tolerance >= 0 && drive.tolerance < 1e6, "a tolerance must be small");
}

inline void check_restored(const Counter& counter) {
  if (counter.range == Counter::Range::ring) require_within(counter.ring_top, 0, INT64_MAX - 1);
}

inline void check_restored(const Comparator& comparator) {
  require_within(comparator.value, INT64_MIN + 1, INT64_MAX - 1);
}

inline void check_restored(const Environment::Zone& zone) { require_within(zone.slack, 0, INT64_MAX / 2); }

inline void check_restored(const EncoderLine& line) {
  for (const std::int64_t value : {line.counts, line.factor, line.pulses, line.divider}) {
    require_within(value, 0, INT32_MAX);
  }
  require_state(line.pulses > 0 && line.factor > 0 && line.divider > 0, "an encoder must have a scale");
  for (const std::int64_t value : {line.origin, line.surplus, line.zero})
    require_within(value, INT64_MIN / 2, INT64_MAX / 2);
  require_within(line.first, INT64_MIN, line.last);
}

inline void check_restored(const Environment& environment) {
  require_within(environment.zone_count, 0, static_cast<std::int64_t>(Environment::kMaxZones));
  require_within(environment.index_period, INT64_MIN, INT64_MAX / 2);
  require_within(environment.index_from, INT64_MIN, environment.index_to);
}

inline void check_restored(const Follower& follower) {
  require_accepted([&] { follower.check(); });
  constexpr std::int64_t kMax = INT64_MAX / 2;  // Follower limits its own numbers to half of this
  for (const std::int64_t value : {follower.gathered, follower.behind_pulses, follower.period_pulses}) {
    require_within(value, -kMax, kMax);
  }
  require_within(follower.left_over, 0, follower.denominator - 1);
  require_within(follower.phase, 0, follower.period_ticks - 1);
  require_within(follower.speed_left_over, 0, 999);
}

inline void check_restored(const ExternalDrive& drive) {
  require_reach(drive.pulses);
  require_within(drive.running, -1, +1);
}

inline void check_restored(const Homing& homing) {
  require_accepted([&] { check(homing.program); });
  require_within(homing.phase, -1, homing.program.phase_count - 1);
  require_within(homing.counted, 0, INT32_MAX - 1);
  require_reach(homing.reference_pulses);
  require_reach(homing.began_pulses);
}

inline void check_restored(const AxisSettings& settings) {
  require_accepted([&] { check(settings); });
  require_within(settings.backlash_pulses, 0, std::int64_t{1} << 53);
}

inline void check_restored(const Axis& axis) {
  for (const std::int64_t pulses :
       {axis.travel_pulses, axis.base_pulses, axis.backlash_sent, axis.target_pulses}) {
    require_reach(pulses);
  }
  // Plan with the law now, as a later tick will: a command must be able to accept it.
  const bool has_law = axis.task == Task::move || axis.task == Task::endless;
  if (has_law) {
    require_accepted([&] {
      (void)slow_to_stop({.speed_u_s = axis.law.top_speed_u_s}, axis.law);
      const auto target = static_cast<double>(axis.target_pulses);
      const bool begins = axis.in_backlash && axis.task == Task::move && !axis.homing.active();
      if (begins) (void)plan(std::abs(target), axis.law);
      if (axis.comes_back) {
        (void)plan(std::abs(std::floor(axis.drive.profile.end_position_u) - target), axis.law);
      }
    });
  }
  require_within(axis.last_direction, -1, +1);
  require_state(axis.constant_pps >= 0 && std::isfinite(axis.constant_pps), "a speed must not be negative");
}

inline void check_restored(const UnitScale& scale) {
  require_accepted([&] { UnitScale::of(scale.multiplier, scale.divider); });
}

inline void check_restored(const Path& path) {
  for (const Point* point :
       {&path.begin, &path.end, &path.centre, &path.abscissa, &path.ordinate, &path.rise}) {
    for (const double coordinate : *point) {
      require_state(std::abs(coordinate) <= 1e15, "a path must be within +-1e15");
    }
  }
  require_state(path.length_u >= 0 && path.length_u <= 1e24, "a path's length must be from 0 to 1e24");
  require_state(std::abs(path.begin_angle_rad) <= 7 && std::abs(path.sweep_rad) <= 1.001e6,
                "an arc's angles must be within 1e6 rad");
  require_state(path.begin_radius_u >= 0 && path.begin_radius_u <= 1e15, "an arc must have a radius");
  require_all_finite(path.radius_slope_u_rad);
  require_state(path.kind == Path::Kind::line || path.measure == Measure::vector ||
                    path.length_u <= 2e6 * path.begin_radius_u,
                "an arc's length must be that of its sweep");
}

inline void check_restored(const PathRun& run) {
  require_accepted([&] { run.check_queue(); });
}

inline void check_restored(const Coordinated& group) {
  std::array<bool, INT8_MAX + 1> is_taken{};
  for (const std::int8_t axis : group.axis_of) {
    require_within(axis, Coordinated::kNone, INT8_MAX);
    if (axis == Coordinated::kNone) continue;
    require_state(!std::exchange(is_taken[static_cast<std::size_t>(axis)], true), "a path has an axis twice");
  }
  for (const std::int64_t zero : group.zero_pulses) require_reach(zero);
}

inline void check_restored(const SyncAction& action) { require_reach(action.preset_value); }

inline void check_restored(const SyncTable& table) {
  for (const std::int64_t distance : table.distance_pulses) require_reach(distance);
}

}  // namespace understudy::motion
