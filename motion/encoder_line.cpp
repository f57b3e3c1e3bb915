#include "motion/encoder_line.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace understudy::motion {

namespace {

__extension__ using Wide = __int128;

/// No axis moves further than this, and no count beyond it is searched for.
constexpr std::int64_t kFarthestCount = std::int64_t{1} << 56;

Wide floor_quotient(Wide value, std::int64_t by) {
  const Wide quotient = value / by;
  return value % by < 0 ? quotient - 1 : quotient;
}

std::int64_t bounded(Wide value) {
  return static_cast<std::int64_t>(std::clamp<Wide>(value, INT64_MIN / 4, INT64_MAX / 4));
}

}  // namespace

std::int64_t EncoderLine::at(std::int64_t travel) const {
  const Wide from_origin = Wide{std::clamp(travel, first, last)} - origin;
  const Wide place = mirrored ? -from_origin : from_origin;
  const Wide whole = floor_quotient(place * counts, pulses);
  const Wide shown = floor_quotient(((reversed ? -whole : whole) + surplus) * factor - zero, divider);
  return bounded(turned ? -shown : shown);
}

std::optional<std::int64_t> EncoderLine::steps_until(std::int64_t travel, int direction,
                                                     std::int64_t count_steps) const {
  // Beyond a stop of the machine, nothing moves until the axis is back at the stop.
  if (direction > 0 ? travel < first : travel > last) {
    const std::int64_t stop = direction > 0 ? first : last;
    const auto steps = steps_until(stop, direction, count_steps);
    return steps ? std::optional(*steps + std::abs(stop - travel)) : std::nullopt;
  }
  const std::int64_t before = at(travel);
  const auto is_present = [&](std::int64_t steps) {
    return std::abs(at(travel + direction * steps) - before) >= count_steps;
  };
  // The slope alone determines the number of pulses to within a few pulses.
  const std::int64_t about =
      bounded(Wide{std::min(count_steps, kFarthestCount)} * divider * pulses / (Wide{counts} * factor));
  const std::int64_t leeway = pulses / counts + bounded(Wide{divider} * pulses / (Wide{counts} * factor)) + 2;
  if (about > kFarthestCount || leeway > kFarthestCount) return std::nullopt;
  std::int64_t outside = std::max<std::int64_t>(about - leeway, 0);
  std::int64_t inside = about + leeway;
  if (outside > 0 && is_present(outside)) outside = 0;
  if (!is_present(inside)) return std::nullopt;  // the machine reaches a stop before that
  while (inside - outside > 1) {
    const std::int64_t middle = outside + (inside - outside) / 2;
    (is_present(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace understudy::motion
