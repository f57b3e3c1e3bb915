// Measures motion: planning a move, an axis's tick, compared with the bare arithmetic of a tick, and a
// coordinated path.
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

#include "benchmarks/figures.h"
#include "benchmarks/processor_clock.h"
#include "motion/axis.h"
#include "motion/coordinated.h"
#include "motion/move.h"

namespace understudy::benchmarks {

namespace {

using namespace understudy::motion;

constexpr int kRounds = 15;

/// Keeps the compiler from optimizing away the computation of a result.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

double seconds_of(const std::function<void()>& work) {
  const auto start = processor_time_here();
  work();
  return std::chrono::duration<double>(processor_time_here() - start).count();
}

/// Returns the nanoseconds per repetition, if `work` does `count` repetitions.
double nanoseconds_each(double count, const std::function<void()>& work) {
  return seconds_of(work) * 1e9 / count;
}

// ---- The bare tick, which is the unit of the other results

/// The minimum work of an axis's tick: a cubic, two comparisons with limits, one counter.
struct Bare {
  double p, v, a, j, low, high;
  std::int64_t count;
};

constexpr Tick kTicks = 4000;

double bare_tick(std::size_t axes) {
  std::vector<Bare> all(axes);
  for (std::size_t i = 0; i < axes; ++i) all[i] = {0, 1000 + static_cast<double>(i), 20, 0.1, -1e9, 1e9, 0};
  const std::size_t ticks = static_cast<std::size_t>(kTicks) * (axes < 64 ? 64 / axes : 1);
  return nanoseconds_each(static_cast<double>(ticks * axes), [&] {
    for (std::size_t tick = 1; tick <= ticks; ++tick) {
      const double t = static_cast<double>(tick) / 1000.0;
      for (Bare& axis : all) {
        const double position = axis.p + t * (axis.v + t * (0.5 * axis.a + t * (axis.j * (1.0 / 6.0))));
        if (position >= axis.low && position <= axis.high) axis.count = static_cast<std::int64_t>(position);
      }
      // Steps one axis after another, as devices do, instead of many at once in wide registers.
      asm volatile("" ::: "memory");
    }
    keep(all);
  });
}

// ---- Planning

constexpr std::size_t kBareAxes = 4;
constexpr double kTrapezoidBar = 70;
constexpr double kSCurveBar = 175;

struct Family {
  const char* name;
  SpeedLaw law;
  double bar;  // bare ticks
};

std::vector<Family> families() {
  const auto slope = RampLaw::by_slope;
  const auto jerk = [](double k) { return RampLaw::by_jerk(k); };
  return {
      {"trapezoid, rest to rest",
       {.top_speed_u_s = 40000, .up = slope(125000), .down = slope(125000)},
       kTrapezoidBar},
      {"trapezoid, start speed, a and d",
       {.start_speed_u_s = 1000, .top_speed_u_s = 40000, .up = slope(125000), .down = slope(80000)},
       kTrapezoidBar},
      {"trapezoid by times",
       {.top_speed_u_s = 40000, .up = RampLaw::by_time(0.05), .down = RampLaw::by_time(0.08)},
       kTrapezoidBar},
      {"S-curve by jerk, symmetric",
       {.start_speed_u_s = 1000, .top_speed_u_s = 40000, .up = jerk(619000), .down = jerk(619000)},
       kSCurveBar},
      {"S-curve by jerk, asymmetric",
       {.start_speed_u_s = 1000, .top_speed_u_s = 40000, .up = jerk(619000), .down = jerk(250000)},
       kSCurveBar},
      {"S-curve, jerk and acceleration",
       {.start_speed_u_s = 1000,
        .top_speed_u_s = 40000,
        .up = RampLaw::by_jerk(619000, 100000),
        .down = RampLaw::by_jerk(250000, 60000)},
       kSCurveBar},
      {"S-curve with linear middle",
       {.start_speed_u_s = 200,
        .top_speed_u_s = 33333,
        .up = RampLaw::by_sections(666667, 4000),
        .down = RampLaw::by_sections(333333, 6000)},
       kSCurveBar},
  };
}

void planning(bool short_moves) {
  std::printf("\nplanning a move, %s; nanoseconds, median of %d rounds\n",
              short_moves ? "too short for its top speed" : "with a cruise", kRounds);
  constexpr int kMoves = 20000;
  for (const Family& family : families()) {
    std::vector<double> samples;
    std::vector<double> ratios;
    for (int round = 0; round < kRounds; ++round) {
      const double bare_ns = bare_tick(kBareAxes);
      samples.push_back(nanoseconds_each(kMoves, [&] {
        double distance = short_moves ? 300 : 1e6;
        for (int i = 0; i < kMoves; ++i) {
          const Profile profile = plan(distance, family.law);
          keep(profile);
          distance += short_moves ? 0.0125 : 7.0;
        }
      }));
      ratios.push_back(samples.back() / bare_ns);
    }
    std::printf("%-36s %10.1f\n", family.name, median(samples));
    print_verdict("  relative to a bare tick", median(ratios), family.bar);
  }
}

// ---- The tick

SpeedLaw long_s_curve() {
  return {.start_speed_u_s = 100,
          .top_speed_u_s = 40000,
          .up = RampLaw::by_jerk(20000),
          .down = RampLaw::by_jerk(20000)};
}

double axis_tick(std::size_t axes, bool watched) {
  std::vector<Axis> all(axes);
  Environment environment;
  if (watched) {
    environment.add(Signal::limit_plus, 1'000'000'000, 2'000'000'000);
    environment.index_period = 4000;
  }
  AxisSettings settings{.needs_servo = false};
  if (watched) settings.soft_limit_plus = 900'000'000;
  for (Axis& axis : all) {
    axis.set(settings);
    axis.move(100'000'000, long_s_curve(), 0);
  }
  const auto ticks = static_cast<Tick>(static_cast<std::size_t>(kTicks) * (axes < 64 ? 64 / axes : 1));
  std::int64_t pulses = 0;
  const double each_ns = nanoseconds_each(static_cast<double>(ticks) * static_cast<double>(axes), [&] {
    for (Tick tick = 1; tick <= ticks; ++tick) {
      for (Axis& axis : all) pulses += axis.step(tick, environment);
    }
  });
  keep(pulses);
  return each_ns;
}

void ticking() {
  std::printf("\nan axis's tick, moving along an S-curve; nanoseconds, median of %d rounds\n", kRounds);
  std::printf("%8s %12s %12s %24s\n", "axes", "bare", "axis", "axis, limits and index");
  for (const std::size_t axes : {std::size_t{4}, std::size_t{64}, std::size_t{1024}}) {
    std::vector<double> bare;
    std::vector<double> ours;
    std::vector<double> watched;
    std::vector<double> ratios;
    for (int round = 0; round < kRounds; ++round) {
      bare.push_back(bare_tick(axes));
      ours.push_back(axis_tick(axes, false));
      watched.push_back(axis_tick(axes, true));
      ratios.push_back(ours.back() / bare.back());
    }
    std::printf("%8zu %12.2f %12.2f %24.2f\n", axes, median(bare), median(ours), median(watched));
    print_verdict("  an axis's tick, relative to a bare tick", median(ratios), 3);
  }
}

// ---- Coordinated motion

double coordinated_tick(const std::function<void(PathRun&)>& fill, Tick ticks) {
  std::vector<Axis> axes(4);
  for (Axis& axis : axes) axis.set({.needs_servo = false});
  const std::vector<Environment> environment(4);
  std::vector<std::int64_t> pulses(4);
  const auto group = std::make_unique<Coordinated>();
  group->axis_of = {0, 1, 2, 3};
  group->run.set_speed(
      {.top_speed_u_s = 40000, .up = RampLaw::by_slope(125000), .down = RampLaw::by_slope(125000)}, 0);
  fill(group->run);
  group->begin(Point::Zero(), axes, 0);
  const double each_ns = nanoseconds_each(static_cast<double>(ticks), [&] {
    for (Tick tick = 1; tick <= ticks; ++tick) group->step(tick, axes, environment, pulses);
  });
  keep(pulses);
  return each_ns;
}

void coordinated() {
  struct Shape {
    const char* name;
    std::function<void(PathRun&)> fill;
  };
  const Point origin = Point::Zero();
  const Shape shapes[] = {
      {"line in four axes",
       [&](PathRun& run) { run.append(line(origin, Point(4e6, 3e6, -2e6, 1e6)), {}, 0); }},
      {"helix: a circle in two axes, the others rise",
       [&](PathRun& run) {
         run.append(
             arc_by_sweep(origin, Point(50000, 0, 0, 0), 12 * 3.14159265358979, Point(0, 0, 20000, 5000)), {},
             0);
       }},
      {"spiral",
       [&](PathRun& run) {
         run.append(spiral(origin, Point(50000, 0, 0, 0), 12 * 3.14159265358979, 5000), {}, 0);
       }},
  };
  std::printf("\na coordinated path's tick, four axes together; nanoseconds, median of %d rounds\n", kRounds);
  for (const Shape& shape : shapes) {
    std::vector<double> samples;
    for (int round = 0; round < kRounds; ++round) samples.push_back(coordinated_tick(shape.fill, 20000));
    std::printf("%-46s %10.1f\n", shape.name, median(samples));
  }
}

// ---- All together

void simulated_time() {
  // Four axes that always move back and forth, with limits and an index to watch.
  std::vector<Axis> axes(4);
  Environment environment;
  environment.add(Signal::limit_plus, 1'000'000, 2'000'000);
  environment.index_period = 4000;
  for (Axis& axis : axes) axis.set({.needs_servo = false});
  constexpr Tick kSimulated = 2'000'000;
  std::int64_t pulses = 0;
  const double wall_s = seconds_of([&] {
    for (Tick tick = 1; tick <= kSimulated; ++tick) {
      for (Axis& axis : axes) {
        if (!axis.moving()) axis.move(axis.travel_pulses > 0 ? -50000 : 50000, long_s_curve(), tick - 1);
        pulses += axis.step(tick, environment);
      }
    }
  });
  keep(pulses);
  std::printf("\nfour axes back and forth: %.0f simulated seconds per second\n",
              static_cast<double>(kSimulated) / kTicksPerSecond / wall_s);
}

}  // namespace

}  // namespace understudy::benchmarks

int main() {
  using namespace understudy::benchmarks;
  planning(false);
  planning(true);
  ticking();
  coordinated();
  simulated_time();
}
