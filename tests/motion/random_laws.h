// Random laws and distances: usual, round, equal, extreme, and exactly where a law changes its form.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "motion/move.h"

namespace understudy::motion {

/// Returns a number as code, exact to the last bit.
inline std::string code(double value) {
  if (std::isinf(value)) return value < 0 ? "-INFINITY" : "INFINITY";
  if (std::isnan(value)) return "NAN";
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", value);
  return digits;
}

inline std::string code(const RampLaw& law) {
  constexpr std::array<const char*, 4> kKinds{"slope", "time", "jerk", "sections"};
  return std::string("{RampLaw::Kind::") + kKinds[static_cast<std::size_t>(law.kind)] + ", " +
         code(law.acceleration_u_s2) + ", " + code(law.jerk_u_s3) + ", " + code(law.section_u_s) + ", " +
         code(law.duration_s) + "}";
}

inline std::string code(const SpeedLaw& law) {
  constexpr std::array<const char*, 3> kShorts{"lower_top", "keep_half", "cut_ramp"};
  std::string out = "const SpeedLaw law{.start_speed_u_s = " + code(law.start_speed_u_s) +
                    ", .top_speed_u_s = " + code(law.top_speed_u_s) + ", .up = " + code(law.up) +
                    ", .down = " + code(law.down) +
                    ", .when_short = Short::" + kShorts[static_cast<std::size_t>(law.when_short)];
  if (law.slow_down_reckoned_by) {
    out += ", .slow_down_reckoned_by = RampLaw" + code(*law.slow_down_reckoned_by);
  }
  if (law.slow_down_at_u) out += ", .slow_down_at_u = " + code(*law.slow_down_at_u);
  return out + ", .slow_down_offset_u = " + code(law.slow_down_offset_u) + "};";
}

inline std::string code(const Sample& s) {
  return "const Sample now{" + code(s.position_u) + ", " + code(s.speed_u_s) + ", " +
         code(s.acceleration_u_s2) + ", " + code(s.jerk_u_s3) + "};";
}

class RandomLaws {
 public:
  explicit RandomLaws(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t end) { return random_() % end; }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  double of_any_size(double low, double high) { return std::exp2(between(std::log2(low), std::log2(high))); }

  /// Draws a number above 0. One in eight is extreme, one in four is round.
  double number() {
    constexpr std::array<double, 8> kRound{1, 2, 10, 100, 1000, 0.5, 4096, 1e6};
    switch (below(8)) {
      case 0: return of_any_size(1e-12, 1e12);
      case 1:
      case 2: return kRound[below(kRound.size())];
      default: return of_any_size(1e-2, 1e6);
    }
  }
  /// Draws a number above 0 in the range that controllers use.
  double usual_number() {
    return below(4) == 0 ? 100.0 * static_cast<double>(1 + below(10)) : of_any_size(10, 1e5);
  }

  RampLaw slope(bool extreme = true) { return RampLaw::by_slope(extreme ? number() : 10 * usual_number()); }
  RampLaw time() { return RampLaw::by_time(of_any_size(1e-3, 100)); }
  /// Draws a law with jerk. Half of them have a bound near the one that a speed change of `dv` just reaches.
  RampLaw jerk(double dv, bool extreme = true) {
    const double jerk = extreme ? number() : 100 * usual_number();
    if (below(2) == 0) return RampLaw::by_jerk(jerk);
    const double bound = std::sqrt(jerk * std::max(dv, 1e-12));
    return RampLaw::by_jerk(jerk, below(8) == 0 ? bound : bound * of_any_size(0.01, 4));
  }
  RampLaw sections(double dv, bool extreme = true) {
    const double acceleration = extreme ? number() : 10 * usual_number();
    switch (below(6)) {
      case 0: return RampLaw::by_sections(acceleration, 0);
      case 1: return RampLaw::by_sections(acceleration, std::max(0.0, dv) / 2);
      default: return RampLaw::by_sections(acceleration, std::max(0.0, dv) * of_any_size(1e-4, 2));
    }
  }
  RampLaw any_ramp(double dv, bool extreme = true) {
    switch (below(4)) {
      case 0: return slope(extreme);
      case 1: return time();
      case 2: return jerk(dv, extreme);
      default: return sections(dv, extreme);
    }
  }

  double start_speed(double top) {
    switch (below(5)) {
      case 0:
      case 1: return 0;
      case 2: return below(4) == 0 ? top : top * 2;
      default: return top * between(0, 1);
    }
  }

  /// Draws a distance for a law whose ramps to and from the top speed together need `ramps_u`.
  double distance(double ramps_u) {
    constexpr std::array<double, 6> kGiven{0, 1, 2, 3, 1000, 2147483647};
    double distance = ramps_u;
    switch (below(6)) {
      case 0: return kGiven[below(kGiven.size())];
      case 1: break;
      case 2: distance = below(2) == 0 ? std::nextafter(ramps_u, 0) : ramps_u * (1 + 4e-16); break;
      case 3: distance = ramps_u * of_any_size(1e-3, 1e3); break;
      case 4: return std::floor(of_any_size(1, 2147483647));
      default: return of_any_size(1e-12, 1e12);
    }
    return distance > 1e-12 && distance < 1e15 ? distance : 1;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace understudy::motion
