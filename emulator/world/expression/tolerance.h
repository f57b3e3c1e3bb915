// Parses the expected values of `expect` and `takes`: a value, a value with a tolerance, or a range.
//   32000     0xC001     on     3050ms +- 2ms     32000 +- 1%     100..200     ..4s     3 * 3200 +- 2
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "emulator/world/expression/number.h"
#include "emulator/world/expression/tokens.h"

namespace understudy::emulator::world {

struct Tolerance {
  std::optional<Number> low;  // both limits are included; no value: no limit
  std::optional<Number> high;
  std::string text;  // as written

  bool holds(Number value) const { return (!low || value >= *low) && (!high || value <= *high); }
};

/// The values are expressions without names, in this unit. Throws ExpressionError.
Tolerance parse_tolerance(std::string_view text, Unit unit = Unit::none);

}  // namespace understudy::emulator::world
