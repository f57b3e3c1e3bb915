// The persistent memory of a SUPER-40NC (latched contacts and registers, recipes), power-up and M8008.
#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/programs/files.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "emulator/models/super_40nc/rows/terminals.h"

namespace understudy::emulator::models::super_40nc {

void Super40nc::register_written(const RegisterRow& row, std::size_t slot) {
  if (kIsUnlisted[slot] && !parts_.ground.keeps_unlisted()) {
    state_.image[slot] = 0;
    return;
  }
  if (keeps(row)) state_.eeprom.write(slot, state_.image[slot], 0, now());
}

void Super40nc::warn_not_implemented(const RegisterRow& row) const {
  const std::string name = RegisterMap::name_of(row, 0);
  Device::warn_not_implemented(name, row.not_implemented);
}

std::function<void(NvImage&)> Super40nc::memory_writer() const {
  return registers_writer(*this, state_.eeprom.content());
}

void Super40nc::read_memory(const NvImage& image) {
  const auto values = read_registers(*this, image, Device::model().firmwares.back());
  for (std::size_t slot = 0; slot < values.size(); ++slot) state_.eeprom.put(slot, values[slot]);
}

void Super40nc::blank_state() {
  State blank;
  blank.eeprom = std::move(state_.eeprom);
  blank.blocks = std::move(state_.blocks);
  for (std::size_t i = 0; i < blank.axes.size(); ++i) {
    blank.axes[i].encoder_counts = state_.axes[i].encoder_counts;
  }
  state_ = std::move(blank);
}

void Super40nc::power_down() {
  state_.eeprom.lose_power();
  blank_state();
}

void Super40nc::power_up() {
  blank_state();
  Ground& ground = parts_.ground;
  ground.load_image();
  ground.take_parameters();
  const Settings settings = ground.registers();
  ground.put(stored_d(d8::kFeed), settings.raw(stored_d(d9::kSystemSpeed)));
  ground.put(stored_d(d8::kPlane), settings.raw(stored_d(d9::kArcPlane)));
  state_.station = settings.raw(stored_d(d9::kStation));
  if (chose(option("version_number", "0"))) ground.put(stored_d(d8::kVersion), 0);
  if (chose(option("override_at_power_up", "0"))) ground.put(stored_d(d8::kFeedPercentage), 0);
  state_.file = settings.raw(stored_d(d9::kFileNumber));
  state_.recipe = settings.raw(stored_d(d9::kRecipeNumber));
  state_.wheel_edges = input(kWheelTerminal);
  ground.take_power_up_parameters();
  if (chose(option("power_up_files", "read_from_file_and_recipe_again")))
    parts_.programs.stored().read_files_again();
  parts_.axes.parameters.apply_all_axis_parameters();
  parts_.programs.make_programs_ready();
  const bool has_c = state_.blocks.find(kPrograms, "C") != nullptr;
  state_.file_is_left_out =
      !has_c && parts_.programs.stored().is_too_long(kFiles, std::to_string(state_.file));
  check_inputs();
}

}  // namespace understudy::emulator::models::super_40nc
