// Counts which parts of the devices hosts, programs and faults exercise: registers, bits, functions,
// commands, instructions, faults, cells of transition tables, choices. It only observes: nothing in the world
// depends on it, and restoring a snapshot does not restore the counts.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::world {

class World;

class ControllerCoverage {
 public:
  /// Starts counting. The world must outlive this object.
  explicit ControllerCoverage(World& world);
  ~ControllerCoverage();
  ControllerCoverage(const ControllerCoverage&) = delete;
  ControllerCoverage& operator=(const ControllerCoverage&) = delete;

  /// Returns the counts per model. Devices that have the same model are added up.
  TouchedReport report() const;
  /// Called after the world was put into another state. Drops incomplete messages on the lines.
  void world_restored();

 private:
  class Counting;
  std::unique_ptr<Counting> counting_;
};

}  // namespace understudy::emulator::world
