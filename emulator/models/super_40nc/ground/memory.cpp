// The persistent memory of a SUPER-40NC: latched contacts and registers, with their factory values.
#include <array>
#include <cstddef>
#include <cstdint>

#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/super_40nc/ground/ground.h"
#include "emulator/models/super_40nc/rows/contact_rows.h"
#include "emulator/models/super_40nc/rows/data_rows.h"
#include "emulator/models/super_40nc/rows/names.h"
#include "emulator/models/super_40nc/rows/options.h"
#include "emulator/models/super_40nc/rows/registers.h"
#include "emulator/models/super_40nc/rows/row_words.h"
#include "emulator/models/super_40nc/rows/settings.h"
#include "interpreter/super_40nc/step_programs.h"

namespace understudy::emulator::models::super_40nc {

Ground::Ground(const Device& device, GroundState& state, const StepStates& steps)
    : device_(device),
      state_(state),
      steps_(steps),
      options_(device.choices().subspan(kFirstOfLanguages), device.decisions().asked(kFirstOfLanguages)),
      readings_{.multiplies_by_x12 = chose(option("multiplier", "from_x12")),
                .limits_deceleration = chose(option("long_deceleration", "limited_to_2_x2")),
                .starts_as_fast = chose(option("slow_speeds", "the_start_speed")),
                .truncates = chose(option("rounding", "towards_0"))},
      parameters_wait_(!chose(option("parameter_moment", "by_kind"))),
      shares_signals_(chose(option("signal_outputs", "the_plc_has_them_between"))) {}

/// Some of the panel's parameters have a different factory value in the panel's chapter than in the table of
/// D9 (three parameters of every axis, the decimals, the logo).
std::uint32_t Ground::factory_bits(const RegisterRow& row) const {
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

bool Ground::keeps(const RegisterRow& row) const {
  const bool is_of_timer_or_counter =
      row.table == Table::coil && row.address >= kFirstTimerContact && row.address < relay_address(0);
  const bool is_of_user_buffer = row.table == Table::holding && row.address >= kFirstUserAddress &&
                                 row.address < kFirstUserAddress + 2 * kUserRegisters;
  if (is_of_user_buffer) return chose(option("user_buffer", "is_kept"));
  return row.persistent && !(is_of_timer_or_counter && chose(option("latched_contacts", "values_alone")));
}

Eeprom Ground::factory_memory() const {
  std::array<std::uint32_t, kSlotCount> factory{};
  std::array<bool, kSlotCount> is_persistent{};
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    factory[slot] = factory_bits(row);
    is_persistent[slot] = keeps(row);
  });
  return Eeprom(factory, is_persistent, is_persistent);
}

void Ground::put(StoredRegister kept, std::int32_t value, int axis) {
  const std::size_t slot = kept.slot + static_cast<std::size_t>(axis);
  state_.image[slot] = static_cast<std::uint32_t>(value);
  keep_slot(slot);
  if (slot >= kFirstParameterSlot && !state_.parameters_in_force.empty()) {
    state_.parameters_in_force[slot - kFirstParameterSlot] = static_cast<std::uint32_t>(value);
  }
}

/// Puts waiting written parameters into effect.
void Ground::take_parameters() {
  if (!parameters_wait_) return;
  state_.parameters_in_force.assign(state_.image.begin() + static_cast<std::ptrdiff_t>(kFirstParameterSlot),
                                    state_.image.end());
}

/// Puts X14 and C0 into effect, as at power-up.
void Ground::take_power_up_parameters() {
  const Settings settings = registers();
  state_.logo_ms = static_cast<std::int32_t>(settings.of(stored_d(d9::kLogoTime)));
  for (int number = 0; number < kAxisCount; ++number) {
    state_.rpm_at_power_up[static_cast<std::size_t>(number)] =
        static_cast<std::int32_t>(settings.of(stored_x(d9x::kDefaultSpeed), number));
  }
}

void Ground::load_image() {
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = keeps(row) ? state_.eeprom.content()[slot] : static_cast<std::uint32_t>(row.factory);
  });
}

}  // namespace understudy::emulator::models::super_40nc
