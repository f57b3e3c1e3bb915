#include "motion/unit_scale.h"

#include <cstdint>
#include <optional>

#include "motion/bad_motion.h"

namespace understudy::motion {

namespace {

__extension__ using Wide = __int128;

std::optional<std::int64_t> rounded_quotient(std::int64_t value, std::int64_t by, std::int64_t over) {
  const Wide product = Wide{value} * by;
  const Wide half = Wide{over} / 2;
  const Wide quotient = (product < 0 ? product - half : product + half) / over;
  const auto result = static_cast<std::int64_t>(quotient);
  return Wide{result} == quotient ? std::optional(result) : std::nullopt;
}

}  // namespace

UnitScale UnitScale::of(std::int64_t multiplier, std::int64_t divider) {
  for (const std::int64_t factor : {multiplier, divider}) {
    if (factor < 1 || factor > INT32_MAX) {
      throw BadMotion(Refusal::out_of_range, "unit scale", "multiplier and divider must be 1 to 2147483647");
    }
  }
  return {.multiplier = multiplier, .divider = divider};
}

std::optional<std::int64_t> UnitScale::to_pulses(std::int64_t units) const {
  if (!truncates) return rounded_quotient(units, multiplier, divider);
  const Wide quotient = Wide{units} * multiplier / divider;
  const auto result = static_cast<std::int64_t>(quotient);
  return Wide{result} == quotient ? std::optional(result) : std::nullopt;
}

std::optional<std::int64_t> UnitScale::to_units(std::int64_t pulses) const {
  return rounded_quotient(pulses, divider, multiplier);
}

}  // namespace understudy::motion
