// One axis of a described controller: what it does when hosts tell it something, and what it shows.
//
// What comes of a command depends on what the axis is doing: kAnswers in axis_drive.cpp has a row for each
// command and a column for each doing. docs/import.md shows it to users.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

#include "base/simulated_time.h"
#include "emulator/models/imported/description.h"
#include "motion/axis.h"
#include "motion/counter.h"
#include "motion/surroundings.h"

namespace understudy::emulator::models::imported {

struct AxisState {
  motion::Axis motor{};
  motion::Surroundings here{};
  motion::Counter counter{};     // the position, in pulses
  std::int64_t sent_pulses = 0;  // in the last tick, in the motor's sense
  std::int64_t encoder_counts = 0;
  double run_pps = 0;          // that it runs forward or backward with
  std::int8_t wanted_way = 0;  // that hosts hold: +1 forward, -1 backward, 0 neither or both
  bool way_is_spent = false;   // something else came since: it runs again when it is told anew
  bool arrived = false;        // the last move has reached its target
  bool homed = false;

  bool operator==(const AxisState&) const = default;
};

enum class Doing : std::uint8_t { rests, moves, runs, homes, stops };
inline constexpr std::size_t kDoings = 5;
enum class Answer : std::uint8_t {
  nothing,
  begin,  // from standstill
  join,   // go on to the new target from the speed that there is
  slow_down,
  halt,  // at once
};
Doing doing_of(const AxisState& axis);
/// Of a command that comes at a moment, and of `enable` when it no longer holds.
Answer answer_to(Command command, Doing doing, WhileBusy while_busy);

/// Gives the number that a quantity stands for at this moment, in counts.
using CountsOf = std::function<double(const Quantity& quantity)>;
/// Gives the present number of an axis's quantity, in its unit (seconds, pulses a second); nothing where none
/// is given.
class AxisNumbers {
 public:
  AxisNumbers(const AxisBinding& binding, const CountsOf& counts_of)
      : binding_(binding), counts_of_(counts_of) {}
  std::optional<double> counts(Number which) const;
  /// Pulses a second, for speeds and accelerations.
  std::optional<double> pps(Number which) const;
  double speed_pps() const { return pps(Number::speed).value_or(0); }
  /// The pulses that a count of positions stands for, rounded.
  std::int64_t pulses(double counts) const;
  /// The ramps are steep where no time is given: within a millionth of a second.
  motion::SpeedLaw law(double top_pps) const;

 private:
  double slope(Number acceleration, Number time, Number other_time, double top_pps) const;
  const AxisBinding& binding_;
  const CountsOf& counts_of_;
};

/// A command at a moment. `now` is the last tick that is over. Throws motion::BadMotion for numbers that no
/// motion can have; then nothing has changed.
void obey(AxisState& axis, const AxisBinding& binding, Command command, const AxisNumbers& numbers, Tick now);
/// Brings the axis to run as hosts hold it now: +1, -1 or 0. Throws like obey().
void steer(AxisState& axis, int way, const AxisNumbers& numbers, Tick now);
/// It is enabled, or no longer; always where it has no such command.
void enable(AxisState& axis, const AxisBinding& binding, bool on);
/// What has come of the tick that was stepped. Whether it has ended something.
bool note_events(AxisState& axis, const AxisBinding& binding);

/// The signed speed, in the motor's sense.
double speed_pps(const AxisState& axis, Tick now);
/// Counts of position where the axis is.
std::int64_t position_counts(const AxisState& axis, const AxisBinding& binding);
void set_position(AxisState& axis, const AxisBinding& binding, Value counts);

}  // namespace understudy::emulator::models::imported
