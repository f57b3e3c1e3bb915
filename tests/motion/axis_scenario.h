// Random acts on an axis: commands, numbers, switches that turn on and off.
#pragma once

#include <functional>
#include <string>

#include "motion/bad_motion.h"
#include "tests/motion/axis_course.h"
#include "tests/motion/random_laws.h"
#include "tests/motion/random_moves.h"

namespace understudy::motion {

class AxisScenario {
 public:
  explicit AxisScenario(std::uint64_t seed) : random_(seed), laws_(seed), seed_(seed) {}

  /// Returns code to paste into a test.
  std::string code() const { return "AxisScenario scenario(" + std::to_string(seed_) + ");"; }

  AxisCourse course() {
    AxisCourse course;
    const std::int64_t zones = between(0, 6);
    for (std::int64_t i = 0; i < zones; ++i) {
      const std::int64_t from = place();
      const std::int64_t to = between(0, 5) == 0 ? INT64_MAX : from + random_.of_any_size(1, 5'000) - 1;
      course.environment.add(static_cast<Signal>(between(0, kSignals - 1)), from, to);
    }
    course.environment.index_period = between(0, 1) == 0 ? 0 : random_.of_any_size(2, 20'000);
    course.environment.index_width = random_.of_any_size(1, 30);
    course.axis.set(settings());
    course.axis.inverted = between(0, 1) == 0;
    return course;
  }

  /// Returns the act before the next tick, which is mostly none. The axis may refuse it, with an exception or
  /// a cause.
  std::function<void(AxisCourse&)> next() {
    const SpeedLaw law = speed_law();
    const int direction = between(0, 1) == 0 ? +1 : -1;
    const std::int64_t distance = direction * random_.of_any_size(1, 50'000);
    const auto signal = static_cast<Signal>(between(0, kSignals - 1));
    const bool on = between(0, 3) == 0;
    const auto number = static_cast<std::size_t>(between(0, 3));
    const Comparator comparator = any_comparator();
    const AxisSettings changed = settings();
    const Follower follower{.numerator = between(-5, 5),
                            .denominator = between(1, 5),
                            .period_ticks = static_cast<std::int32_t>(between(1, 5))};
    if (between(0, 9) != 0) return [](AxisCourse&) {};
    switch (between(0, 18)) {
      case 0:
      case 1:
      case 2: return [=](AxisCourse& c) { c.axis.move(distance, law, c.now); };
      case 3:
      case 4: return [=](AxisCourse& c) { c.axis.run(direction, law, c.now); };
      case 5:
      case 6: return [=](AxisCourse& c) { c.axis.change_speed(law, c.now); };
      case 7:
      case 8: return [=](AxisCourse& c) { c.axis.change_distance(std::abs(distance), on, c.now); };
      case 9: return [=](AxisCourse& c) { c.axis.change_distance(-distance / 100, on, c.now); };
      case 10: return [=](AxisCourse& c) { c.axis.slow_down(c.now); };
      case 11: return [=](AxisCourse& c) { number == 0 ? c.axis.stop() : c.axis.slow_down(c.now); };
      case 12: return [=](AxisCourse& c) { c.environment.set_steady(signal, on); };
      case 13: return [=](AxisCourse& c) { c.axis.set_comparator(number, comparator); };
      case 14: return [=](AxisCourse& c) { c.axis.set_encoder(distance); };
      case 15: return [=](AxisCourse& c) { c.axis.switch_servo(number != 0); };
      case 16: return [=](AxisCourse& c) { number == 0 ? c.axis.set(changed) : c.axis.set(c.axis.settings); };
      case 17: return [=](AxisCourse& c) { c.axis.follow(follower); };
      default: return [=](AxisCourse& c) { c.axis.take_part(); };
    }
  }

  /// Returns the external counts for the next tick.
  std::int64_t counts() { return between(0, 3) == 0 ? 0 : between(-40, 60); }

  std::int64_t between(std::int64_t low, std::int64_t high) { return random_.between(low, high); }

 private:
  std::int64_t place() { return (between(0, 1) == 0 ? 1 : -1) * random_.of_any_size(1, 60'000); }

  SpeedLaw speed_law() {
    const double top = laws_.of_any_size(1e3, 2e6);
    const double slope = laws_.of_any_size(1e4, 1e8);
    SpeedLaw law = trapezoid(top, slope);
    switch (between(0, 3)) {
      case 0: law.start_speed_u_s = top * laws_.between(0, 1); break;
      case 1: law.up = RampLaw::by_jerk(slope * 100, slope); break;
      case 2: law.down = RampLaw::by_time(laws_.between(0.001, 0.3)); break;
      default: break;
    }
    return law;
  }

  AxisSettings settings() {
    const auto reaction = [&] { return static_cast<Reaction>(between(0, 2)); };
    AxisSettings settings{.at_limit_plus = reaction(),
                          .at_limit_minus = reaction(),
                          .at_soft_limit = reaction(),
                          .at_alarm = reaction(),
                          .at_emergency = reaction(),
                          .needs_servo = between(0, 1) == 0,
                          .waits_for_in_position = between(0, 4) == 0};
    if (between(0, 2) == 0) settings.soft_limit_plus = place();
    if (between(0, 2) == 0) settings.soft_limit_minus = place();
    if (between(0, 2) == 0) {
      settings.backlash_pulses = between(1, 100);
      settings.backlash_speed_pps = laws_.of_any_size(1e3, 1e5);
    }
    return settings;
  }

  Comparator any_comparator() {
    Comparator mine{.relation = static_cast<Comparator::Relation>(between(0, 5)),
                    .count = static_cast<Count>(between(0, 1)),
                    .reaction = between(0, 2) == 0 ? static_cast<Reaction>(between(0, 2)) : Reaction::ignore,
                    .value = place()};
    mine.counter.range = static_cast<Counter::Range>(between(0, 3));
    mine.counter.ring_top = random_.of_any_size(1, 20'000);
    mine.counter.offset = place();
    return mine;
  }

  RandomMoves random_;
  RandomLaws laws_;
  std::uint64_t seed_;
};

/// Applies an act; a refused act changes nothing.
inline void act(const std::function<void(AxisCourse&)>& command, AxisCourse& course) {
  try {
    command(course);
  } catch (const BadMotion&) {
  }
}

/// Runs one tick, with the counts or pulses for an axis that follows or is carried. Returns its pulses.
inline std::int64_t step(AxisCourse& course, std::int64_t counts) {
  course.axis.feed(counts);
  return course.axis.task == Task::coordinated ? course.carry(counts) : course.step();
}

}  // namespace understudy::motion
