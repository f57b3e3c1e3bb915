// Saves what a described controller retains without power, and its state as bytes.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/state/state_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/device/stateful_device_bytes.h"
#include "emulator/models/imported/axis_drive.h"
#include "emulator/models/imported/description.h"
#include "emulator/models/imported/device.h"
#include "emulator/models/imported/state_fields.h"
#include "motion/axis.h"

namespace understudy::emulator::models::imported {

void ImportedDevice::check_restored(State& restored) const {
  require_state(restored.held.size() == state_.held.size(), "its commands are different");
  require_state(restored.axes.size() == state_.axes.size(), "its axes are different");
  require_state(restored.followed.size() == state_.followed.size(), "its followers are different");
  for (const double value : restored.followed) require_state(std::isfinite(value), "a value is not a number");
  for (const AxisState& axis : restored.axes) {
    require_state(std::isfinite(axis.run_pps) && axis.run_pps >= 0,
                  "a speed is not a number, or is negative");
    require_state(axis.wanted_direction >= -1 && axis.wanted_direction <= 1,
                  "a direction is not forward, backward or none");
  }
  restored.eeprom.check_restored(state_.eeprom);
  check_restored_registers(*this, restored.image, restored.eeprom.content());
}

void ImportedDevice::take_over(const State& restored) {
  state_ = restored;
  is_restored_.assign(is_restored_.size(), 1);
}

std::function<void(NvImage&)> ImportedDevice::memory_writer() const {
  return registers_writer(*this, state_.eeprom.content());
}

void ImportedDevice::read_memory(const NvImage& image) {
  const std::vector<std::uint32_t> values = read_registers(*this, image, firmware());
  for (std::size_t slot = 0; slot < values.size(); ++slot) state_.eeprom.put(slot, values[slot]);
}

State ImportedDevice::state_at_power_up() const {
  State made;
  made.eeprom = state_.eeprom;
  std::size_t slot = 0;
  for (const RegisterRow& row : map().rows()) {
    if (row.is_view) continue;
    made.image.push_back(row.persistent ? made.eeprom.content()[slot]
                                        : static_cast<std::uint32_t>(row.factory));
    ++slot;
  }
  made.held.assign(description().axes.size() * kCommands, 0);
  made.axes.resize(description().axes.size());
  for (std::size_t i = 0; i < made.axes.size(); ++i) {
    motion::Axis& motor = made.axes[i].motor;
    motor.settings.needs_servo = description().axes[i].command(Command::enable).has_value();
    motor.servo_on = !motor.settings.needs_servo;
    if (i < state_.axes.size())
      made.axes[i].encoder_counts = state_.axes[i].encoder_counts;  // encoders belong to the machine
  }
  for (const Following& following : description().followings) {
    const ListedRegister& listed = description().registers[following.spot.number];
    made.followed.push_back(listed.type == Type::f32
                                ? double{real_of(listed.factory)}
                                : static_cast<double>(meaning_of(listed, listed.factory)));
  }
  return made;
}

void ImportedDevice::power_up() {
  state_ = state_at_power_up();
  check_commands();
}

void ImportedDevice::power_down() {
  state_.eeprom.lose_power();
  state_ = state_at_power_up();
}

}  // namespace understudy::emulator::models::imported

template class understudy::emulator::StatefulDevice<understudy::emulator::models::imported::ImportedDevice,
                                                    understudy::emulator::models::imported::State>;
