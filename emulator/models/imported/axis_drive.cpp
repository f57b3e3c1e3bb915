#include "emulator/models/imported/axis_drive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/imported/description.h"
#include "motion/axis.h"
#include "motion/homing_tables.h"
#include "motion/move.h"
#include "motion/ramp.h"

namespace understudy::emulator::models::imported {

namespace {

constexpr double kSteepest_pps2 = 1e12;
constexpr double kFarthest_pulses = 4e15;  // a double still resolves half a pulse here

using enum Answer;

/// The transition table of activities and commands. `forward` and `backward` are levels, which steer()
/// handles.
constexpr std::array<std::array<Answer, kActivities>, kCommands> kAnswers{{
    // rests    moves      runs       homes     stops
    {{nothing, halt, halt, halt, halt}},                    // stop_at_once
    {{nothing, slow_down, slow_down, slow_down, nothing}},  // stop
    {{nothing, halt, halt, halt, halt}},                    // enable, when it is no longer active
    {{begin, nothing, nothing, nothing, nothing}},          // home
    {{begin, join, join, nothing, join}},                   // start
    {{begin, join, join, nothing, join}},                   // start_relative
    {{nothing, nothing, nothing, nothing, nothing}},        // forward
    {{nothing, nothing, nothing, nothing, nothing}},        // backward
}};

}  // namespace

Activity activity_of(const AxisState& axis) {
  const motion::Axis& motor = axis.motor;
  if (motor.homing.active()) return Activity::homes;
  if (motor.task == motion::Task::none) return Activity::rests;
  if (motor.slowing && !motor.comes_back) return Activity::stops;
  return motor.task == motion::Task::endless ? Activity::runs : Activity::moves;
}

Answer answer_to(Command command, Activity activity, WhileBusy while_busy) {
  const Answer answer = kAnswers[static_cast<std::size_t>(command)][static_cast<std::size_t>(activity)];
  return answer == join && while_busy != WhileBusy::replace ? nothing : answer;
}

std::optional<double> AxisNumbers::counts(Number which) const {
  const auto& quantity = binding_.number(which);
  if (!quantity) return std::nullopt;
  return counts_of_(*quantity) * quantity->unit;
}

std::optional<double> AxisNumbers::pps(Number which) const {
  const auto given = counts(which);
  if (!given) return std::nullopt;
  return *given * binding_.pps_per_count;
}

std::int64_t AxisNumbers::pulses(double counts) const {
  const double exact = counts * static_cast<double>(binding_.pulses_per_count.multiplier) /
                       static_cast<double>(binding_.pulses_per_count.divider);
  return static_cast<std::int64_t>(std::round(std::clamp(exact, -kFarthest_pulses, kFarthest_pulses)));
}

double AxisNumbers::slope(Number acceleration, Number time, Number other_time, double top_pps) const {
  double slope = kSteepest_pps2;
  if (const auto given = pps(acceleration)) {
    slope = *given;
  } else {
    auto seconds = counts(time);
    if (!seconds) seconds = counts(other_time);
    if (seconds && *seconds > 0) slope = pps(Number::rated_speed).value_or(top_pps) / *seconds;
  }
  return slope > 0 && slope < kSteepest_pps2 ? slope : kSteepest_pps2;
}

motion::SpeedLaw AxisNumbers::law(double top_pps) const {
  const double up =
      slope(Number::acceleration, Number::acceleration_time, Number::acceleration_time, top_pps);
  const bool has_own = binding_.number(Number::deceleration) || binding_.number(Number::deceleration_time);
  const double down =
      has_own ? slope(Number::deceleration, Number::deceleration_time, Number::acceleration_time, top_pps)
              : up;
  return {.start_speed_u_s = std::clamp(pps(Number::start_speed).value_or(0), 0.0, top_pps),
          .top_speed_u_s = top_pps,
          .up = motion::RampLaw::by_slope(up),
          .down = motion::RampLaw::by_slope(down)};
}

namespace {

void go(AxisState& axis, std::int64_t distance_pulses, bool joins, const AxisNumbers& numbers, Tick now) {
  const double top = std::abs(numbers.speed_pps());
  if (top == 0) return;  // a speed of 0 does not start the axis
  const motion::SpeedLaw law = numbers.law(top);
  const motion::Cause why_not = joins ? axis.motor.move_on(speed_pps(axis, now), distance_pulses, law, now)
                                      : axis.motor.move(distance_pulses, law, now);
  if (why_not != motion::Cause::none) return;
  axis.arrived = distance_pulses == 0;
}

void go_home(AxisState& axis, const AxisBinding& binding, const AxisNumbers& numbers, Tick now) {
  const double top = std::abs(numbers.pps(Number::home_speed).value_or(numbers.speed_pps()));
  if (top == 0) return;
  motion::Simple2Homing how;
  how.direction = binding.home_direction;
  how.speed = numbers.law(top);
  if (axis.motor.home(motion::simple2_homing(how), now) != motion::Cause::none) return;
  axis.arrived = false;
  axis.homed = false;
}

}  // namespace

void execute(AxisState& axis, const AxisBinding& binding, Command command, const AxisNumbers& numbers,
             Tick now) {
  const Answer answer = answer_to(command, activity_of(axis), binding.while_busy);
  const bool is_stop = command == Command::stop || command == Command::stop_at_once;
  if (is_stop) axis.direction_is_spent = true;
  switch (answer) {
    case nothing: return;
    case slow_down: axis.motor.slow_down(now); return;
    case halt: axis.motor.stop(); return;
    case begin:
    case join: break;
  }
  axis.direction_is_spent = true;  // a host must release its command and issue it again
  if (command == Command::home) return go_home(axis, binding, numbers, now);
  std::int64_t distance = 0;
  if (command == Command::start) {
    const std::int64_t target = numbers.pulses(numbers.counts(Number::target).value_or(0));
    distance = target - axis.counter.at(axis.motor.travel_pulses);
  } else {
    distance = numbers.pulses(numbers.counts(Number::distance).value_or(0));
  }
  go(axis, distance, answer == join, numbers, now);
}

void steer(AxisState& axis, int direction, const AxisNumbers& numbers, Tick now) {
  if (direction != axis.wanted_direction) axis.direction_is_spent = false;
  axis.wanted_direction = static_cast<std::int8_t>(direction);
  const double speed = numbers.speed_pps();
  const double top = std::abs(speed);
  int wanted = axis.direction_is_spent || top == 0 ? 0 : direction;
  if (speed < 0) wanted = -wanted;
  const Activity activity = activity_of(axis);
  if (activity == Activity::rests) {
    if (wanted == 0) return;
    axis.arrived = false;
    axis.run_pps = top;
    // Otherwise, a limit or a missing enable would refuse the motion in every tick.
    axis.direction_is_spent = axis.motor.run(wanted, numbers.law(top), now) != motion::Cause::none;
    return;
  }
  if (axis.motor.task != motion::Task::endless || activity == Activity::homes) return;
  // The axis starts in the other direction once it has stopped.
  if (wanted != axis.motor.drive.direction) return axis.motor.slow_down(now);
  if (activity == Activity::stops) {
    if (axis.motor.resume(numbers.law(top), now)) axis.run_pps = top;
  } else if (top != axis.run_pps) {
    axis.motor.change_speed(numbers.law(top), now);
    axis.run_pps = top;
  }
}

void enable(AxisState& axis, const AxisBinding& binding, bool on) {
  const bool is_on = on || !binding.command(Command::enable);
  if (axis.motor.servo_on == is_on) return;
  axis.motor.switch_servo(is_on);
  if (is_on) axis.direction_is_spent = false;  // commands that hosts still hold count from now on
}

bool note_events(AxisState& axis, const AxisBinding& binding) {
  const motion::Events events = axis.motor.events;
  if (events == 0) return false;
  if ((events & motion::bit(motion::Event::homed)) != 0) {
    axis.homed = true;
    set_position(axis, binding, binding.home_position);
  }
  const bool has_ended = (events & motion::bit(motion::Event::ended)) != 0;
  if (has_ended && axis.motor.task == motion::Task::none) {  // no other motion has begun in the meantime
    const motion::Cause cause = axis.motor.cause;
    if (cause == motion::Cause::arrived) axis.arrived = true;
    // The host must issue its command again, unless the axis stopped to reverse.
    if (cause != motion::Cause::arrived && cause != motion::Cause::stopped) axis.direction_is_spent = true;
  }
  return has_ended || (events & motion::bit(motion::Event::homed)) != 0;
}

double speed_pps(const AxisState& axis, Tick now) {
  if (!axis.motor.moving()) return 0;
  return axis.motor.sample(now).speed_u_s * static_cast<double>(axis.motor.drive.direction) + 0.0;
}

std::int64_t position_counts(const AxisState& axis, const AxisBinding& binding) {
  return binding.pulses_per_count.to_units(axis.counter.at(axis.motor.travel_pulses)).value_or(0);
}

void set_position(AxisState& axis, const AxisBinding& binding, Value counts) {
  const auto pulses = binding.pulses_per_count.to_pulses(counts);
  if (pulses) axis.counter.set(*pulses, axis.motor.travel_pulses);
}

}  // namespace understudy::emulator::models::imported
