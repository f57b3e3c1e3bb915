// An axis of a described controller: how it executes commands from hosts, and what it shows.
//
// The effect of a command depends on the axis's activity: kAnswers in axis_drive.cpp has a row for each
// command and a column for each activity. docs/import.md shows this table to users.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/models/imported/description.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/environment.h"

namespace understudy::emulator::models::imported {

struct AxisState {
  motion::Axis motor{};
  motion::Environment environment{};
  motion::Counter counter{};     // the position, in pulses
  std::int64_t sent_pulses = 0;  // pulses of the last tick, in the motor's direction
  std::int64_t encoder_counts = 0;
  double run_pps = 0;                // speed for running forward or backward
  std::int8_t wanted_direction = 0;  // requested by hosts: +1 forward, -1 backward, 0 neither or both
  // The request no longer counts. The axis runs again only on a new request.
  bool direction_is_spent = false;
  bool arrived = false;  // the last move has reached its target
  bool homed = false;

  bool operator==(const AxisState&) const = default;
};

enum class Activity : std::uint8_t { rests, moves, runs, homes, stops };
inline constexpr std::size_t kActivities = 5;
enum class Answer : std::uint8_t {
  nothing,
  begin,  // begins from standstill
  join,   // continues to the new target from the present speed
  slow_down,
  halt,  // stops at once
};
Activity activity_of(const AxisState& axis);
/// Returns the answer to a one-shot command, or to the loss of `enable`.
Answer answer_to(Command command, Activity activity, WhileBusy while_busy);

/// Returns the current value of a quantity, in counts.
using CountsOf = std::function<double(const Quantity& quantity)>;
/// Returns the present numbers of an axis, in their units (seconds, pulses per second). The result is empty
/// for a number that is not bound to anything.
class AxisNumbers {
 public:
  AxisNumbers(const AxisBinding& binding, const CountsOf& counts_of)
      : binding_(binding), counts_of_(counts_of) {}
  std::optional<double> counts(Number which) const;
  /// Returns a speed or acceleration in pulses per second.
  std::optional<double> pps(Number which) const;
  double speed_pps() const { return pps(Number::speed).value_or(0); }
  /// Converts a position count to pulses, rounded.
  std::int64_t pulses(double counts) const;
  /// Returns the speed law of a move. If no ramp time is bound, ramps take a millionth of a second.
  motion::SpeedLaw law(double top_pps) const;

 private:
  double slope(Number acceleration, Number time, Number other_time, double top_pps) const;
  const AxisBinding& binding_;
  const CountsOf& counts_of_;
};

/// Executes a one-shot command. `now` is the last completed tick. Throws motion::BadMotion for numbers that
/// are impossible for a motion; in that case, nothing changes.
void execute(AxisState& axis, const AxisBinding& binding, Command command, const AxisNumbers& numbers,
             Tick now);
/// Runs the axis in the direction that hosts request now: +1, -1 or 0. Throws the same errors as execute().
void steer(AxisState& axis, int direction, const AxisNumbers& numbers, Tick now);
/// Enables or disables the axis. An axis without that command is always enabled.
void enable(AxisState& axis, const AxisBinding& binding, bool on);
/// Handles the events of the last tick. Returns true if a motion has ended.
bool note_events(AxisState& axis, const AxisBinding& binding);

/// Returns the speed, with the sign of the motor's direction.
double speed_pps(const AxisState& axis, Tick now);
/// Returns the axis's position in counts.
std::int64_t position_counts(const AxisState& axis, const AxisBinding& binding);
void set_position(AxisState& axis, const AxisBinding& binding, Value counts);

}  // namespace understudy::emulator::models::imported
