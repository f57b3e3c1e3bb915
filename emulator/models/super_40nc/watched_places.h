// What a tick works with and does not keep: none of it is state.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "interpreter/super_40nc/ladder.h"

namespace understudy::emulator::models::super_40nc {

/// A scan keeps the ladder that it began with, whoever replaces the device's meanwhile.
using SharedLadder = std::shared_ptr<const interpreter::super_40nc::Ladder>;

/// What the PLC's ladder reads and others write without telling it.
struct WatchedPlaces {
  std::vector<Place> places;
  bool some_move = false;   // with the pulses of an axis
  std::vector<Value> seen;  // by the PLC in the present tick
};

/// Of the tick that is stepped: what has been counted of an axis so far.
struct CountedSoFar {
  std::int64_t travel = 0;  // up to there
  std::int64_t wheel = 0;   // so many counts
};

}  // namespace understudy::emulator::models::super_40nc
