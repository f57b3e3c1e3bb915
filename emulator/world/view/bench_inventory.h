// The inventory of a bench.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "emulator/world/bench/bench.h"
#include "emulator/world/view/inventory.h"

namespace understudy::emulator::world {

class BenchInventory final : public Inventory {
 public:
  /// The bench must outlive this object, and must not contain anything that the devices' models refuse.
  explicit BenchInventory(const Bench& bench);

  std::size_t line_count() const override { return bench_.lines.size(); }
  const std::string& line_name(std::size_t number) const override { return bench_.lines[number].name; }
  const KnownDevices& known() const override { return known_; }
  /// Creates the device on first use.
  const Device& device(std::size_t number) const override;
  const PlantSetup& machine(std::size_t device, int axis) const override;

 private:
  const Bench& bench_;
  KnownDevices known_;
  mutable std::vector<std::unique_ptr<Device>> devices_;
};

}  // namespace understudy::emulator::world
