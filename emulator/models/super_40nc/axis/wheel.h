// The hand wheel, which all axes share. Each axis decodes and scales its counts with its own parameters
// (《X40.》 to 《X44.》).
#pragma once

#include <cstdint>

#include "emulator/models/super_40nc/axis/chips.h"
#include "emulator/models/super_40nc/axis/starts.h"

namespace understudy::emulator::models::super_40nc {

class Wheel : protected Chips {
 public:
  Wheel(const Chips& chips, Starts& starts) : Chips(chips), starts_(starts) {}

  void start_wheel(int axis_number, WheelSource source);
  /// Passes the edges to each axis, which decodes them with its own parameters.
  void feed_wheel(std::int32_t edges);
  void wheel_ended(int axis);

 private:
  std::int64_t wheel_lu_per_count(int axis_number) const;
  void follow_ratio(int axis);

  Starts& starts_;
};

}  // namespace understudy::emulator::models::super_40nc
