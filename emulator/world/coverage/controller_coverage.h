// Counts what hosts, programs and faults exercise of the devices: registers, bits, functions, commands,
// instructions, faults, cells of transition tables,
// choices. It only observes: nothing in the world depends on it, and a restored snapshot does
// not restore the counts.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::world {

class World;

class ControllerCoverage {
 public:
  /// Counts from now on. The world must outlive it.
  explicit ControllerCoverage(World& world);
  ~ControllerCoverage();
  ControllerCoverage(const ControllerCoverage&) = delete;
  ControllerCoverage& operator=(const ControllerCoverage&) = delete;

  /// Returns the counts by model. Devices of one model are added up.
  TouchedReport report() const;
  /// Called after the world has been put into another state. Drops incomplete messages on the lines.
  void world_restored();

 private:
  class Counting;
  std::unique_ptr<Counting> counting_;
};

}  // namespace understudy::emulator::world
