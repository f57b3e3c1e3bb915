#include "emulator/plant/plant.h"

#include <algorithm>
#include <cstdlib>

namespace understudy::emulator {

void PlantAxis::move(std::int64_t pulses) {
  const std::int64_t wanted = position_pulses_ + pulses;
  position_pulses_ = setup_.travel ? std::clamp(wanted, setup_.travel->first, setup_.travel->last) : wanted;
  lost_pulses_ += std::abs(wanted - position_pulses_);
}

bool PlantAxis::at_home() const {
  return setup_.home && position_pulses_ >= setup_.home->first && position_pulses_ <= setup_.home->last;
}

bool PlantAxis::at_lower_limit() const {
  return setup_.lower_limit && position_pulses_ <= *setup_.lower_limit;
}

bool PlantAxis::at_upper_limit() const {
  return setup_.upper_limit && position_pulses_ >= *setup_.upper_limit;
}

std::int64_t PlantAxis::encoder_counts() const {
  const std::int64_t scaled = position_pulses_ * setup_.encoder_counts_per_revolution;
  const std::int64_t divisor = setup_.pulses_per_revolution;
  const std::int64_t quotient = scaled / divisor;
  return scaled % divisor < 0 ? quotient - 1 : quotient;
}

}  // namespace understudy::emulator
