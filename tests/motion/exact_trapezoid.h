// A trapezoid given by times, in exact rational arithmetic, from the law alone (Simple2-R3 manual, appendix
// A, read consistently). Times are whole milliseconds, speeds ratios of pulses per millisecond.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "motion/move.h"
#include "motion/pulse_drive.h"

namespace understudy::motion {

/// Returns the whole pulses that a drive has sent `elapsed` ticks after the beginning of `profile`.
inline std::int64_t pulses_at(const Profile& profile, Tick elapsed) {
  if (elapsed < 0) return 0;
  PulseDrive drive;
  drive.start(profile, +1, 0);
  return drive.pulses_at(elapsed);
}

/// Returns the first tick, counted from the beginning, at which `profile` has ended.
inline Tick end_tick(const Profile& profile) {
  return static_cast<Tick>(std::ceil(profile.duration_s * kTicksPerSecond - kTickTolerance));
}

__extension__ using Int128 = __int128;

/// num / den, den > 0.
struct Ratio {
  Int128 num = 0;
  Int128 den = 1;

  std::int64_t floor() const {
    const Int128 quotient = num / den;
    return static_cast<std::int64_t>(num % den < 0 ? quotient - 1 : quotient);
  }
  std::int64_t ceil() const { return -Ratio{-num, den}.floor(); }
  double value() const { return static_cast<double>(num) / static_cast<double>(den); }
  /// Adds this many millionths.
  Ratio plus_millionths(int millionths) const {
    return {num * 1'000'000 + den * millionths, den * 1'000'000};
  }
  Ratio plus_billionths(int billionths) const {
    return {num * 1'000'000'000 + den * billionths, den * 1'000'000'000};
  }
};

/// A move as the registers of a controller describe it.
struct RegisterMove {
  std::int64_t distance_pulses = 0;
  std::int64_t speed_rpm = 0;
  std::int64_t resolution = 0;  // pulses per revolution
  std::int64_t acceleration_10ms = 0;
  std::int64_t deceleration_10ms = 0;

  std::int64_t acceleration_ms() const { return 10 * acceleration_10ms; }
  std::int64_t deceleration_ms() const { return 10 * deceleration_10ms; }
  std::int64_t ramps_ms() const { return acceleration_ms() + deceleration_ms(); }

  /// Returns the speed limit in pulses per millisecond: speed * resolution / 60000, at most 100 (100 kHz).
  Ratio limit() const {
    const Int128 pulses_per_minute = Int128{speed_rpm} * resolution;
    return pulses_per_minute > 6'000'000 ? Ratio{100, 1} : Ratio{pulses_per_minute, 60'000};
  }
  double limit_pps() const {
    const double pps = static_cast<double>(speed_rpm) * static_cast<double>(resolution) / 60.0;
    return pps > 100'000 ? 100'000 : pps;
  }

  /// Returns true if 2P / (TA+TD) reaches V.
  bool reaches_limit() const { return Int128{2} * distance_pulses * limit().den >= limit().num * ramps_ms(); }
  Ratio top() const { return reaches_limit() ? limit() : Ratio{Int128{2} * distance_pulses, ramps_ms()}; }

  /// Returns the total time TT in milliseconds.
  Ratio total_ms() const {
    const Ratio r = top();  // (TA+TD)/2 + P/R
    return {Int128{ramps_ms()} * r.num + Int128{2} * distance_pulses * r.den, 2 * r.num};
  }

  /// s(t): pulses, for 0 <= t <= TT.
  Ratio position(std::int64_t t_ms) const {
    const Ratio r = top();
    if (t_ms <= acceleration_ms()) return {r.num * t_ms * t_ms, r.den * 2 * acceleration_ms()};
    // u = TT - t, as a ratio of 2 * r.num
    const Int128 u = (Int128{ramps_ms()} - Int128{2} * t_ms) * r.num + Int128{2} * distance_pulses * r.den;
    if (u >= Int128{2} * r.num * deceleration_ms()) {
      return {r.num * (Int128{2} * t_ms - acceleration_ms()), 2 * r.den};
    }
    const Int128 den = Int128{8} * r.num * r.den * deceleration_ms();
    return {distance_pulses * den - u * u, den};
  }

  SpeedLaw law() const {
    return {.top_speed_u_s = limit_pps(),
            .up = RampLaw::by_time(static_cast<double>(acceleration_10ms) / 100.0),
            .down = RampLaw::by_time(static_cast<double>(deceleration_10ms) / 100.0)};
  }
  Profile plan() const { return motion::plan(static_cast<double>(distance_pulses), law()); }

  /// Returns code to paste into a test.
  std::string code() const {
    return "const RegisterMove move{" + std::to_string(distance_pulses) + ", " + std::to_string(speed_rpm) +
           ", " + std::to_string(resolution) + ", " + std::to_string(acceleration_10ms) + ", " +
           std::to_string(deceleration_10ms) + "};";
  }
};

}  // namespace understudy::motion
