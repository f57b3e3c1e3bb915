// Connects the drives of a world's machines to their controllers and to wires.
#include <algorithm>
#include <cstddef>

#include "emulator/device/axes.h"
#include "emulator/device/model.h"
#include "emulator/device/terminals.h"
#include "emulator/world/bench/bench.h"
#include "emulator/world/plant/plant.h"
#include "emulator/world/world.h"

namespace understudy::emulator::world {

/// Adds a drive. If neither its controller nor a wire can clear its alarm, disabling the drive clears it.
void World::connect_drive(const MachineSetup& machine) {
  if (!machine.plant.drive) return;
  driven_axes_[machine.device].push_back(static_cast<std::size_t>(machine.axis));
  const auto leads_there = [&](const WireSetup& wire) {
    return wire.to_device == machine.device && wire.to_axis == machine.axis &&
           wire.to_input == DriveInput::alarm_clear;
  };
  const auto axis = static_cast<std::size_t>(machine.axis);
  const bool has_output = devices_[machine.device]->model().axes[axis].alarm_clear_output >= 0;
  if (has_output || std::any_of(wires_.begin(), wires_.end(), leads_there)) return;
  plants_[machine.device][axis].clear_alarm_by_disabling();
}

/// Returns the levels that a controller sets at the drive of an axis. Without a servo output, the axis itself
/// reports whether the servo is on.
DriveInputs World::drive_inputs(std::size_t number, std::size_t axis) const {
  const Device& device = *devices_[number];
  const AxisRow& row = device.model().axes[axis];
  const auto driven = [&](int terminal) { return terminal >= 0 && device.terminals()->output(terminal); };
  const bool has_output = row.servo_output >= 0;
  return {.servo = has_output ? driven(row.servo_output)
                              : axes_[number]->servo_on(static_cast<int>(axis)).value_or(false),
          .alarm_clear = driven(row.alarm_clear_output)};
}

/// Latches the wires to an input of a drive. The drive reads their level in the next tick.
void World::latch_drive(const WireSetup& wire) {
  const bool is_on = std::any_of(wires_.begin(), wires_.end(), [&](const WireSetup& other) {
    return other.to_device == wire.to_device && other.to_axis == wire.to_axis &&
           other.to_input == wire.to_input && level_of(other);
  });
  PlantAxis& plant = plants_[wire.to_device][static_cast<std::size_t>(wire.to_axis)];
  if (plant.set_wired(wire.to_input, is_on)) disturbed_ = true;
}

}  // namespace understudy::emulator::world
