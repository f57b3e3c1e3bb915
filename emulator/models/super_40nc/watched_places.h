// Working values of a tick; none of them is state.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "interpreter/super_40nc/ladder.h"

namespace understudy::emulator::models::super_40nc {

/// A scan keeps the ladder that it began with, even if the device's ladder is replaced meanwhile.
using SharedLadder = std::shared_ptr<const interpreter::super_40nc::Ladder>;

/// What the PLC's ladder reads and others write without notice.
struct WatchedPlaces {
  std::vector<Place> places;
  bool some_move = false;   // some places change with an axis's pulses
  std::vector<Value> seen;  // values that the PLC saw in the current tick
};

/// What has been counted of an axis so far in the current tick.
struct CountedSoFar {
  std::int64_t travel = 0;  // travel up to which it has been counted
  std::int64_t wheel = 0;   // wheel counts so far
};

}  // namespace understudy::emulator::models::super_40nc
