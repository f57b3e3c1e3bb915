#include "motion/following.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "motion/bad_motion.h"

namespace understudy::motion {

namespace {

__extension__ using Wide = __int128;

std::int64_t floor_divide(std::int64_t value, std::int64_t by) {
  const std::int64_t quotient = value / by;
  return value % by < 0 ? quotient - 1 : quotient;
}

std::int64_t saturated(Wide value) {
  return static_cast<std::int64_t>(std::clamp<Wide>(value, INT64_MIN / 4, INT64_MAX / 4));
}

/// Returns the maximum number of pulses to catch up in this period, if each following period catches up
/// `change` fewer and the sum must not exceed `missing`.
std::int64_t stoppable(std::int64_t missing, std::int64_t change) {
  const Wide size = missing < 0 ? -Wide{missing} : Wide{missing};
  const auto sum_of = [&](Wide steps) { return change * steps * (steps + 1) / 2; };
  auto steps = static_cast<Wide>(std::sqrt(2.0 * static_cast<double>(size) / static_cast<double>(change)));
  while (sum_of(steps) > size) --steps;
  while (sum_of(steps + 1) <= size) ++steps;
  const auto max = static_cast<std::int64_t>(steps * change + (size - sum_of(steps)) / (steps + 1));
  return missing < 0 ? -max : max;
}

}  // namespace

void Follower::check() const {
  const auto require = [](bool met, const char* what) {
    if (!met) throw BadMotion(Refusal::out_of_range, "following", what);
  };
  require(denominator >= 1 && denominator <= INT32_MAX, "denominator must be 1 to 2147483647");
  require(numerator >= -INT32_MAX && numerator <= INT32_MAX, "numerator must be -2147483647 to 2147483647");
  require(period_ticks >= 1 && period_ticks <= 1000, "period must be 1 to 1000 ticks");
  require(top_speed_pps >= 0 && top_speed_pps <= INT32_MAX, "top speed must be 0 to 2147483647");
  require(slope_pps >= 0 && slope_pps <= INT32_MAX, "slope must be 0 to 2147483647");
}

std::int64_t Follower::step() {
  if (phase == 0) {
    // The pulses of the gathered counts, with the remainder of earlier divisions.
    const Wide scaled = Wide{gathered} * numerator + left_over;
    Wide whole = scaled / denominator;
    if (scaled % denominator < 0) --whole;
    left_over = static_cast<std::int64_t>(scaled - whole * denominator);
    gathered = 0;
    const std::int64_t asked = saturated(whole + (catches_up ? behind_pulses : 0));
    std::int64_t wanted = asked;
    const auto in_a_period = [&](std::int64_t pps) { return pps * period_ticks / 1000; };
    if (slope_pps > 0) {
      const std::int64_t change = std::max<std::int64_t>(in_a_period(slope_pps), 1);
      if (catches_up) wanted = saturated(whole + stoppable(behind_pulses, change));
      wanted = std::clamp(wanted, period_pulses - change, period_pulses + change);
    }
    if (top_speed_pps > 0) {
      // The limit is met on average: its remainder in thousandths is carried into the next period.
      const std::int64_t milli = top_speed_pps * period_ticks + speed_left_over;
      const std::int64_t bound = milli / 1000;
      speed_left_over = milli % 1000;
      wanted = std::clamp(wanted, -bound, bound);
    }
    behind_pulses = catches_up ? asked - wanted : 0;
    period_pulses = wanted;
  }
  const std::int64_t each_tick = floor_divide(period_pulses, period_ticks);
  const std::int64_t rest = period_pulses - each_tick * period_ticks;
  const std::int64_t rest_before = rest * phase / period_ticks;
  const std::int64_t done = phase + 1;
  phase = static_cast<std::int32_t>(done % period_ticks);
  return each_tick + rest * done / period_ticks - rest_before;
}

bool Follower::quiet() const {
  return gathered == 0 && behind_pulses == 0 && period_pulses == 0 && phase == 0;
}

}  // namespace understudy::motion
