// The retentive memory of a SUPER-40NC: latched contacts and registers, recipes; also power-up and M8008.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/data_rows.h"
#include "emulator/models/super_40nc/device.h"
#include "emulator/models/super_40nc/files.h"
#include "emulator/models/super_40nc/names.h"
#include "emulator/models/super_40nc/options.h"
#include "emulator/models/super_40nc/registers.h"
#include "emulator/models/super_40nc/row_words.h"
#include "emulator/models/super_40nc/settings.h"
#include "emulator/models/super_40nc/terminals.h"

namespace understudy::emulator::models::super_40nc {

namespace {

/// Calls visit(slot, row) for every register with a slot.
template <typename Visit>
void for_each_kept_slot(Visit visit) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count && !row.is_view; ++i) visit(next++, row);
  }
}

bool is_parameter(const RegisterRow& row) {
  return row.table == Table::holding && row.address >= data_address(d9::kStation);
}

}  // namespace

/// The panel's parameters have other factory values where its chapter and the table of D9 differ (3 of them
/// in every axis, the decimals, the logo).
std::uint32_t Super40nc::factory_bits(const RegisterRow& row) const {
  struct Panel {
    int number;
    std::int32_t value;
  };
  static constexpr Panel kPanels[] = {{d9::kLogoTime, 2000},
                                      {of_x(d9x::kDotPosition), 2},
                                      {of_x(d9x::kDefaultSpeed), 500},
                                      {of_x(d9x::kHomeDirection), 1},
                                      {of_x(d9x::kHomeOffset), 1000}};
  for (const Panel& panel : kPanels) {
    if (row.table == Table::holding && row.address == data_address(panel.number) &&
        chose(option("factory_values", "panels"))) {
      const bool is_one_lu =
          panel.number == of_x(d9x::kHomeOffset) && chose(option("x30_unit", "0_001_mm_with_panel_values"));
      return is_one_lu ? 1 : static_cast<std::uint32_t>(panel.value);
    }
  }
  constexpr std::uint32_t kPrintedWithD9 = 5000;
  const bool is_feed = row.table == Table::holding && row.address == data_address(d9::kSystemSpeed);
  if (is_feed && chose(option("d9004_factory", "5_mm_s"))) return kPrintedWithD9;
  return static_cast<std::uint32_t>(row.factory);
}

bool Super40nc::keeps(const RegisterRow& row) const {
  const bool is_of_timer_or_counter =
      row.table == Table::coil && row.address >= kFirstTimerContact && row.address < relay_address(0);
  const bool is_of_user_buffer = row.table == Table::holding && row.address >= kFirstUserAddress &&
                                 row.address < kFirstUserAddress + 2 * kUserRegisters;
  if (is_of_user_buffer) return chose(option("user_buffer", "is_kept"));
  return row.persistent && !(is_of_timer_or_counter && chose(option("latched_contacts", "values_alone")));
}

Eeprom Super40nc::factory_memory() const {
  std::array<std::uint32_t, kSlotCount> factory{};
  std::array<bool, kSlotCount> is_kept{};
  for_each_kept_slot([&](std::size_t slot, const RegisterRow& row) {
    factory[slot] = factory_bits(row);
    is_kept[slot] = keeps(row);
  });
  return Eeprom(factory, is_kept, is_kept);
}

void Super40nc::put(Kept kept, std::int32_t value, int axis) {
  const std::size_t slot = kept.slot + static_cast<std::size_t>(axis);
  state_.image[slot] = static_cast<std::uint32_t>(value);
  keep_slot(slot);
  if (slot >= kFirstParameterSlot && !state_.parameters_in_force.empty()) {
    state_.parameters_in_force[slot - kFirstParameterSlot] = static_cast<std::uint32_t>(value);
  }
}

/// Puts written parameters into force that had to wait.
void Super40nc::take_parameters() {
  if (!parameters_wait_) return;
  state_.parameters_in_force.assign(state_.image.begin() + static_cast<std::ptrdiff_t>(kFirstParameterSlot),
                                    state_.image.end());
}

/// Puts X14 and C0 into force as they are at power-up.
void Super40nc::take_power_up_parameters() {
  const Settings settings = registers();
  state_.logo_ms = static_cast<std::int32_t>(settings.of(kept_d(d9::kLogoTime)));
  for (int number = 0; number < kAxisCount; ++number) {
    state_.rpm_at_power_up[static_cast<std::size_t>(number)] =
        static_cast<std::int32_t>(settings.of(kept_x(d9x::kDefaultSpeed), number));
  }
}

void Super40nc::set_contact(int number, bool on) {
  const std::size_t slot = relay_slot(number);
  state_.image[slot] = on ? 1 : 0;
}

void Super40nc::register_written(const RegisterRow& row, std::size_t slot) {
  if (kIsUnlisted[slot] && !keeps_unlisted()) {
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
  return registers_writer(*this, state_.eeprom.kept());
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
  for_each_kept_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = keeps(row) ? state_.eeprom.kept()[slot] : static_cast<std::uint32_t>(row.factory);
  });
  take_parameters();
  const Settings settings = registers();
  put(kept_d(d8::kFeed), settings.raw(kept_d(d9::kSystemSpeed)));
  put(kept_d(d8::kPlane), settings.raw(kept_d(d9::kArcPlane)));
  state_.station = settings.raw(kept_d(d9::kStation));
  if (chose(option("version_number", "0"))) put(kept_d(d8::kVersion), 0);
  if (chose(option("override_at_power_up", "0"))) put(kept_d(d8::kFeedPercentage), 0);
  state_.file = settings.raw(kept_d(d9::kFileNumber));
  state_.recipe = settings.raw(kept_d(d9::kRecipeNumber));
  state_.wheel_edges = input(kWheelTerminal);
  take_power_up_parameters();
  if (chose(option("power_up_files", "read_from_file_and_recipe_again"))) read_files_again();
  apply_all_axis_parameters();
  make_programs_ready();
  const bool has_c = state_.blocks.find(kPrograms, "C") != nullptr;
  state_.file_is_left_out = !has_c && is_too_long(kFiles, std::to_string(state_.file));
  look_at_inputs();
}

/// M8008. File and recipe change as if they had been written.
void Super40nc::reset_parameters() {
  const bool leaves_some = chose(option("m8008_scope", "but_for_d9000_and_d9026"));
  const auto stays = [&](const RegisterRow& row) {
    return leaves_some &&
           (row.address == data_address(d9::kStation) || row.address == data_address(d9::kPassword));
  };
  for_each_kept_slot([&](std::size_t slot, const RegisterRow& row) {
    if (is_parameter(row) && !stays(row)) put({.slot = slot}, static_cast<std::int32_t>(factory_bits(row)));
  });
  change_file(0);
  change_recipe(0);
  show_line_counts();
  apply_all_axis_parameters();
}

}  // namespace understudy::emulator::models::super_40nc
