#include "emulator/world/view/bench_inventory.h"
#include <cstddef>
#include <memory>
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/plant/plant.h"

namespace understudy::emulator::world {

BenchInventory::BenchInventory(const Bench& bench)
    : bench_(bench), known_(known_devices_of(bench)), devices_(bench.devices.size()) {}

const Device& BenchInventory::device(std::size_t number) const {
  std::unique_ptr<Device>& device = devices_[number];
  const DeviceSetup& setup = bench_.devices[number];
  if (device == nullptr) device = make_device(*setup.model, setup.settings);
  return *device;
}

const PlantSetup& BenchInventory::machine(std::size_t device, int axis) const {
  static const PlantSetup kBare;
  for (const MachineSetup& machine : bench_.machines) {
    if (machine.device == device && machine.axis == axis) return machine.plant;
  }
  return kBare;
}

}  // namespace understudy::emulator::world
