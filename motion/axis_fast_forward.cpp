#include <algorithm>
#include <cstdint>

#include "motion/axis.h"
#include "motion/environment.h"
#include "motion/pulse_drive.h"
#include "motion/tick.h"

// Runs many ticks in one step, while an axis only continues along its plan.
namespace understudy::motion {

Tick Axis::quiet_until(Tick next, Tick limit, const Environment& environment, TravelRange range) const {
  const Tick none = next - 1;
  if (must_recheck || environment.version != seen_version || task == Task::coordinated) return none;
  const std::int64_t low = std::max(range.low, watch_low);
  const std::int64_t high = std::min(range.high, watch_high);
  const Tick last = std::min(limit, drive.next_check - 1);
  if (last < next || travel_pulses < low || travel_pulses > high) return none;
  if (drive.drive != Drive::running) return last;
  // A segment has one direction, but rounding may send a pulse a tick early. So the last pulse before a
  // possible event is left to single ticks. If that pulse is inside the range, all pulses before it also are.
  const bool upwards = drive.direction > 0;
  const auto is_inside = [&](Tick tick) {
    const std::int64_t travel = travel_ahead(tick);
    return upwards ? travel >= low && travel < high : travel > low && travel <= high;
  };
  if (is_inside(last)) return last;
  Tick inside = none;
  Tick outside = last;
  while (outside - inside > 1) {
    const Tick middle = inside + (outside - inside) / 2;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

std::int64_t Axis::fast_forward_to(Tick tick) {
  const std::int64_t travel = travel_ahead(tick);
  const std::int64_t pulses = travel - travel_pulses;
  drive.sent_pulses = drive.pulses_of_segment(tick);
  travel_pulses = travel;
  events = 0;
  return inverted ? -pulses : pulses;
}

}  // namespace understudy::motion
