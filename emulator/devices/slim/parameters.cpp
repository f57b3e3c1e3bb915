#include "emulator/devices/slim/parameters.h"

#include <cmath>

namespace understudy::emulator::slim {

std::optional<double> fitted(const ParameterDefinition& row, double value) {
  if (!std::isfinite(value)) return std::nullopt;
  if (row.type == ParameterDefinition::Type::integer) {
    if (value != std::floor(value)) return std::nullopt;
  } else {
    if (std::abs(value) > kMaxReal) return std::nullopt;
    value = static_cast<float>(value);
  }
  if (value < row.lowest || value > row.highest || (row.above_lowest && value == row.lowest))
    return std::nullopt;
  return value;
}

}  // namespace understudy::emulator::slim
