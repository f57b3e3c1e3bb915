#include "docs/motion/homing_samples.h"

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/homing.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/ramp.h"
#include "motion/tick.h"

namespace understudy::docs {

namespace {

using namespace understudy::motion;

constexpr std::int64_t kHomeFrom = 6000;
constexpr std::int64_t kHomeTo = 9000;
constexpr std::int64_t kLimit = 15000;

SpeedLaw speed(double top_pps) {
  return {.start_speed_u_s = 100,
          .top_speed_u_s = top_pps,
          .up = RampLaw::by_slope(100000),
          .down = RampLaw::by_slope(100000)};
}

/// A machine with a home switch, a limit beyond it on both sides, and an index each 2000 pulses.
Environment machine() {
  Environment environment;
  environment.add(Signal::near_home, 4000, 9000);
  environment.add(Signal::home, kHomeFrom, kHomeTo);
  environment.add(Signal::limit_plus, kLimit, 100000);
  environment.add(Signal::limit_minus, -100000, -4000);
  environment.index_period = 2000;
  environment.index_at = 500;
  return environment;
}

/// time s, travel, phase; every other tick until it stops.
void trace(std::ofstream& file, const HomingProgram& program) {
  const Environment environment = machine();
  Axis axis;
  AxisSettings settings;
  settings.needs_servo = false;
  settings.at_limit_plus = settings.at_limit_minus = Reaction::slow_down;
  axis.set(settings);
  axis.step(0, environment);
  axis.home(program, 0);
  for (Tick tick = 1; axis.moving() && tick < 20000; ++tick) {
    if (tick % 4 == 1) {
      file << static_cast<double>(tick) / kTicksPerSecond << ' ' << axis.travel_pulses << ' '
           << static_cast<int>(axis.homing.phase) << '\n';
    }
    axis.step(tick, environment);
  }
  file << "\n\n";
}

}  // namespace

void write_homing_samples(const std::filesystem::path& folder) {
  std::ofstream super(folder / "homing_super40nc.dat");
  for (int mode = 0; mode <= 12; ++mode) {
    trace(super, super40nc_homing({.mode = mode,
                                   .direction = +1,
                                   .fast = speed(12000),
                                   .creep = speed(3000),
                                   .index_count = 2,
                                   .offset_pulses = 0}));
  }
  std::ofstream others(folder / "homing_others.dat");
  trace(others, rsm8194h_homing({.directions = {+1, +1, -1, +1},
                                 .drive = speed(12000),
                                 .home = speed(3000),
                                 .offset_pulses = 1500}));
  trace(others, simple2_homing({.direction = +1, .speed = speed(12000)}));
  trace(others, simple2_homing({.direction = -1, .speed = speed(12000)}));
  trace(others, slim_homing({.direction = +1, .jog = speed(12000)}));
}

}  // namespace understudy::docs
