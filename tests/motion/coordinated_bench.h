// Four axes on a bench that are carried along paths, and the shapes with which they are compared.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "motion/coordinated.h"
#include "tests/motion/path_shapes.h"

namespace understudy::motion {

struct Bench {
  static constexpr std::size_t kAxes = 4;

  std::array<Axis, kAxes> axes{};
  std::array<Environment, kAxes> environment{};
  std::array<std::int64_t, kAxes> pulses{};  // the pulses of the last tick
  std::array<std::int64_t, kAxes> sent{};    // all so far, as they were sent
  std::array<Events, kAxes> events{};        // all so far
  Coordinated group;
  Tick tick = 0;

  explicit Bench(const SpeedLaw& law = by_slope(100'000, 1'000'000)) {
    for (Axis& axis : axes) axis.switch_servo(true);
    group.axis_of = {0, 1, 2, 3};
    group.run.set_speed(law, 0);
  }

  void add(const Path& path, Joint joint = {}) { group.run.append(path, joint, tick); }
  Cause begin(const Point& from = Point::Zero()) { return group.begin(from, axes, tick); }

  void step(bool stays_engaged = false) {
    ++tick;
    pulses = {};
    std::array<bool, kAxes> taken{};
    for (std::size_t i = 0; i < kAxes; ++i) taken[i] = group.takes(i);
    group.step(tick, axes, environment, pulses, stays_engaged);
    for (std::size_t i = 0; i < kAxes; ++i) {
      if (!taken[i]) pulses[i] = axes[i].step(tick, environment[i]);
      sent[i] += pulses[i];
      events[i] = static_cast<Events>(events[i] | axes[i].events);
    }
  }
  void steps(int count) {
    for (; count > 0; --count) step();
  }
  /// Runs until the group releases the axes. Returns that tick, or -1 if it does not.
  Tick to_the_end(Tick max = 1'000'000) {
    for (const Tick last = tick + max; tick < last;) {
      step();
      if (!group.engaged) return tick;
    }
    return -1;
  }
  std::array<std::int64_t, kAxes> travels() const {
    std::array<std::int64_t, kAxes> all{};
    for (std::size_t i = 0; i < kAxes; ++i) all[i] = axes[i].travel_pulses;
    return all;
  }
};

using Travels = std::array<std::int64_t, Bench::kAxes>;

/// Returns the position on a symmetric trapezoid after t seconds, from its law alone.
inline double trapezoid_at(double t_s, double length_u, double top_u_s, double slope_u_s2) {
  const double peak = std::min(top_u_s, std::sqrt(length_u * slope_u_s2));
  const double ramp_s = peak / slope_u_s2;
  const double whole_s = trapezoid_s(length_u, top_u_s, slope_u_s2);
  if (t_s <= 0) return 0;
  if (t_s >= whole_s) return length_u;
  if (t_s < ramp_s) return 0.5 * slope_u_s2 * t_s * t_s;
  if (t_s > whole_s - ramp_s) return length_u - 0.5 * slope_u_s2 * (whole_s - t_s) * (whole_s - t_s);
  return 0.5 * peak * ramp_s + peak * (t_s - ramp_s);
}

}  // namespace understudy::motion
