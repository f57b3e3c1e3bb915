// Machines with a home switch between two limit switches, and the courses that homing takes on them.
//
//   behind                 home                  ahead       Places are counted along the direction of
//   ═════╗                ╔════╗                ╔═════       GoHome_DIR: for GoHome_DIR 0 it is the picture's
//      -200       0      100  120              200           mirror image that is built.
//
// A course is worked out by hand as legs of motion, each with a closed form over time, in pulses and
// milliseconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "tests/emulator/models/simple2_r3/one_simple2.h"

namespace understudy::emulator::models::simple2_r3 {

/// The settings of these tests: one pulse per millisecond, reached in 10 ms.
struct HomingPace {
  double pulses_a_ms = 1;
  double ramp_ms = 10;
};

/// One leg, which begins at `at` ms, `gone` pulses after its `from`.
struct HomingLeg {
  enum class Does : std::uint8_t { run, slow, back, stand };

  Tick at = 0;
  Does does = Does::run;
  int direction = +1;
  std::int64_t from = 0;      // where the axis was last at rest
  double gone_pulses = 0;     // for Does::slow: the distance from there to where slowing down began
  double pulses_a_ms = 0;     // for Does::slow: the speed there
  std::int64_t distance = 0;  // for Does::back

  double gone_after(double ms, const HomingPace& pace) const {
    const double ramp = pace.ramp_ms;
    switch (does) {
      case Does::run:
        if (ms < ramp) return pace.pulses_a_ms * ms * ms / (2 * ramp);
        return pace.pulses_a_ms * (ms - ramp / 2);
      case Does::slow: {
        const double u = std::min(ms, ramp);  // a ramp takes the same time from any speed
        return gone_pulses + pulses_a_ms * (u - u * u / (2 * ramp));
      }
      case Does::back: {  // appendix A, too short for the speed: a triangle of both ramps
        const auto whole = static_cast<double>(distance);
        const double left = std::max(2 * ramp - ms, 0.0);
        return ms < ramp ? whole * ms * ms / (2 * ramp * ramp)
                         : whole - whole * left * left / (2 * ramp * ramp);
      }
      case Does::stand: break;
    }
    return 0;
  }
  std::int64_t place_at(Tick ms, const HomingPace& pace) const {
    const double gone = gone_after(static_cast<double>(ms - at), pace);
    return from + direction * static_cast<std::int64_t>(std::floor(gone + 1e-6));
  }
};

/// Starts from standstill at `from`, along the direction of homing (+1) or against it.
inline HomingLeg run_leg(Tick at, int direction, std::int64_t from) {
  return {.at = at, .direction = direction, .from = from};
}
/// Makes the leg in which this run slows down, from `gone` pulses after `from` on.
inline HomingLeg slow_leg(Tick at, int direction, std::int64_t from, double gone, double pulses_a_ms = 1) {
  return {.at = at,
          .does = HomingLeg::Does::slow,
          .direction = direction,
          .from = from,
          .gone_pulses = gone,
          .pulses_a_ms = pulses_a_ms};
}
/// Makes the leg against the direction, back to the edge.
inline HomingLeg back_leg(Tick at, std::int64_t from, std::int64_t distance) {
  return {.at = at, .does = HomingLeg::Does::back, .direction = -1, .from = from, .distance = distance};
}
/// Makes a leg at standstill.
inline HomingLeg stand_leg(Tick at, std::int64_t place) {
  return {.at = at, .does = HomingLeg::Does::stand, .from = place};
}

struct HomingCourse {
  std::vector<HomingLeg> legs;
  Tick end = 0;  // the first millisecond after the course
  bool found = true;
  HomingPace pace{};

  std::int64_t place_at(Tick ms) const {
    const HomingLeg* leg = &legs.front();
    for (const HomingLeg& next : legs) {
      if (next.at <= ms) leg = &next;
    }
    return leg->place_at(std::min(ms, end), pace);
  }
};

struct HomingAxis {
  char axis = 'A';
  int direction = +1;     // GoHome_DIR: +1 is 1, -1 is 0
  bool reversed = false;  // DIR_Polarity, and the limit switches wired to match
  std::int64_t start = 0;
  std::optional<world::PulseSpan> home = world::PulseSpan{100, 120};
  std::optional<std::int64_t> behind = -200;
  std::optional<std::int64_t> ahead = 200;
  Value speed_rpm = 20;  // one pulse per millisecond, at 3000 pulses per revolution
  Value time_10ms = 1;
  Value resolution = 3000;
  bool home_assigned = true;
  bool limits_assigned = true;

  int number() const { return axis == 'A' ? 0 : 1; }
  int sign() const { return reversed ? -direction : direction; }  // the sign of the plant's positions
  int input_of(int din_of_a) const { return din_of_a + 5 * number(); }
  int ahead_input() const { return input_of(direction > 0 ? 2 : 3); }
  int behind_input() const { return input_of(direction > 0 ? 3 : 2); }
};

/// A device at rest with its servos on, at tick 20.
class HomingSimple2 : public ReadySimple2 {
 public:
  explicit HomingSimple2(const std::vector<HomingAxis>& axes, Given given = {})
      : ReadySimple2(with_plant(std::move(given), axes)), axes_(axes) {
    for (const HomingAxis& a : axes_) {
      const std::string din = a.axis == 'A' ? "" : "B";
      set(name(a.axis, "Resoultion"), a.resolution);
      set(name(a.axis, "Home_Speed"), a.speed_rpm);
      set(name(a.axis, "Home_AccTime"), a.time_10ms);
      set(name(a.axis, "DIR_Polarity"), a.reversed);
      set(direction_name(a.axis), a.direction > 0);
      set(a.axis == 'A' ? "DIN4_Aaxis_Home" : "DIN9_Baxis_Home", a.home_assigned);
      set(a.axis == 'A' ? "DIN2_Aaxis_UP_Limit" : "DIN7_Baxis_UP_Limit", a.limits_assigned);
      set(a.axis == 'A' ? "DIN3_Aaxis_DN_Limit" : "DIN8_Baxis_DN_Limit", a.limits_assigned);
    }
    wire_reversed_limits();
    run_to(20);
  }

  static std::string direction_name(char axis) {
    return axis == 'A' ? "Axis_GoHome_DIR" : "Baxis_GoHome_DIR";
  }

  const HomingAxis& axis(std::size_t i = 0) const { return axes_[i]; }
  std::int64_t place(std::size_t i = 0) {
    const HomingAxis& a = axes_[i];
    return a.start + a.sign() * world().plant(0, a.number()).position_pulses();
  }
  void go_home(std::size_t i = 0) { set(name(axes_[i].axis, "GoHome"), 1); }
  bool homing(std::size_t i = 0) const { return (status() >> (6 + axes_[i].number()) & 1) != 0; }
  bool homed(std::size_t i = 0) const { return (status() >> (8 + axes_[i].number()) & 1) != 0; }
  bool is_moving(std::size_t i = 0) const { return moving(axes_[i].axis); }
  Value status() const { return get("STATUS"); }

  void step() {
    run(1);
    wire_reversed_limits();
  }
  void step_by(Tick ticks) {
    for (Tick i = 0; i < ticks; ++i) step();
  }
  /// Returns the milliseconds from the command that was just given to the end of its motion; -1 if it does
  /// not end in time.
  Tick milliseconds_to_end(std::size_t i = 0, Tick at_most = 5000) {
    const Tick begin = now() + 1;
    while (is_moving(i)) {
      if (now() - begin > at_most) return -1;
      step();
    }
    return now() - begin;
  }

 private:
  static Given with_plant(Given given, const std::vector<HomingAxis>& axes) {
    for (const HomingAxis& a : axes) {
      const auto in_plant = [&](std::int64_t place) { return a.sign() * (place - a.start); };
      world::PlantSetup plant;
      if (a.home) {
        plant.home = a.sign() > 0 ? world::PulseSpan{in_plant(a.home->first), in_plant(a.home->last)}
                                  : world::PulseSpan{in_plant(a.home->last), in_plant(a.home->first)};
      }
      if (!a.reversed) {
        auto& ahead = a.direction > 0 ? plant.upper_limit : plant.lower_limit;
        auto& behind = a.direction > 0 ? plant.lower_limit : plant.upper_limit;
        if (a.ahead) ahead = in_plant(*a.ahead);
        if (a.behind) behind = in_plant(*a.behind);
      }
      given.plant[a.number()] = plant;
    }
    return given;
  }

  // A reversed motor runs towards the plant's lower switch when it is commanded to go up. A machine's builder
  // would swap the two switches, and so does this test.
  void wire_reversed_limits() {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      const HomingAxis& a = axes_[i];
      if (!a.reversed) continue;
      if (a.ahead) input(a.ahead_input(), place(i) >= *a.ahead);
      if (a.behind) input(a.behind_input(), place(i) <= *a.behind);
    }
  }

  std::vector<HomingAxis> axes_;
};

/// The bits of STATUS that belong to an axis.
inline Value status_of(Value status, int number) { return status & (number == 0 ? 0x5555 : 0xAAAA); }

/// Compares the machine with courses, one for each axis, from the command that was just given to 30 ms after
/// the last end. It checks the position, the coordinate, the trigger and all bits of STATUS in every
/// millisecond.
inline void expect_courses(HomingSimple2& machine, const std::vector<HomingCourse>& courses) {
  Tick last = 0;
  for (const HomingCourse& course : courses) last = std::max(last, course.end);
  const Tick begin = machine.now() + 1;
  std::vector<Value> coordinate_before;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const HomingAxis& a = machine.axis(i);
    coordinate_before.push_back(machine.coordinate(a.axis) - a.direction * machine.place(i));
  }
  for (Tick ms = -1; ms <= last + 30; ++ms) {  // -1: the request is answered, and no tick has passed
    if (ms >= 0) machine.step();
    ASSERT_EQ(machine.now(), begin + ms);
    for (std::size_t i = 0; i < courses.size(); ++i) {
      const HomingCourse& course = courses[i];
      const HomingAxis& a = machine.axis(i);
      const bool over = ms >= course.end;
      const std::int64_t place = course.place_at(std::max<Tick>(ms, 0));
      ASSERT_EQ(machine.place(i), place) << a.axis << " at " << ms << " ms";
      ASSERT_EQ(machine.coordinate(a.axis),
                over && course.found ? 0 : coordinate_before[i] + a.direction * place)
          << a.axis << " at " << ms << " ms";
      ASSERT_EQ(machine.get(machine.name(a.axis, "GoHome")), !over) << a.axis << " at " << ms << " ms";

      // A switch is sampled when a tick begins.
      const std::int64_t seen = course.place_at(std::max<Tick>(ms - 1, 0));
      Value bits = over ? 0 : 1 << 4 | 1 << 6;
      if (over && course.found) bits |= 1 << 8;
      bits |= 1 << 10;
      if (a.limits_assigned && a.ahead && seen >= *a.ahead) bits |= a.direction > 0 ? 1 << 12 : 1 << 14;
      if (a.limits_assigned && a.behind && seen <= *a.behind) bits |= a.direction > 0 ? 1 << 14 : 1 << 12;
      ASSERT_EQ(status_of(machine.status(), a.number()), bits << a.number())
          << a.axis << " at " << ms << " ms";
    }
  }
}

/// Returns all variants of the machine: both axes, both directions, both senses of the motor.
inline std::vector<HomingAxis> every_build_of(HomingAxis machine) {
  std::vector<HomingAxis> builds;
  for (const char axis : {'A', 'B'}) {
    for (const int direction : {+1, -1}) {
      for (const bool reversed : {false, true}) {
        machine.axis = axis;
        machine.direction = direction;
        machine.reversed = reversed;
        builds.push_back(machine);
      }
    }
  }
  return builds;
}

inline std::string text_of(const HomingAxis& a) {
  return std::string(1, a.axis) + (a.direction > 0 ? " +" : " -") + (a.reversed ? " reversed" : "") +
         " from " + std::to_string(a.start);
}

}  // namespace understudy::emulator::models::simple2_r3
