// Counts what hosts, programs and faults exercise of the devices: registers, bits, functions, commands,
// instructions, faults. It looks on: nothing in the world depends on it, and no snapshot brings a count back.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "emulator/world/coverage/touched.h"

namespace understudy::emulator::world {

class World;

class ControllerCoverage {
 public:
  /// Counts from this moment on. The world must outlive it.
  explicit ControllerCoverage(World& world);
  ~ControllerCoverage();
  ControllerCoverage(const ControllerCoverage&) = delete;
  ControllerCoverage& operator=(const ControllerCoverage&) = delete;

  /// Returns the counts by model. Devices of one model are added up.
  TouchedReport report() const;
  /// The world was put into another state: incomplete messages on the lines are void.
  void world_restored();

 private:
  class Counting;
  std::unique_ptr<Counting> counting_;
};

}  // namespace understudy::emulator::world
