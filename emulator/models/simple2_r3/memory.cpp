#include "emulator/models/simple2_r3/memory.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "base/simulated_time.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/model.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/slots.h"
#include "emulator/models/simple2_r3/state.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr Firmware kFirstWithPassword = 151;

/// Returns true for registers whose factory value is not in the manual and which need more than the minimum
/// to be useful.
bool is_useful_guess(const RegisterRow& row) {
  constexpr std::string_view kStated[] = {"HW_Code", "Aaxis_Resoultion", "Baxis_Resoultion"};
  const bool is_stated = std::find(std::begin(kStated), std::end(kStated), row.name) != std::end(kStated);
  return row.persistent && row.ranged && !is_stated;
}

bool password_fits(const State& state, const Setup& setup) {
  return setup.device.firmware() < kFirstWithPassword || state.image[slot("PWD_Input")] == state.password;
}

}  // namespace

std::uint32_t factory_bits(const Setup& setup, const RegisterRow& row) {
  if (setup.chose(option("first_password", "65535")) && row.name == "NEW_PWD") return 65535;
  if (setup.adc_10_bits && row.name.starts_with("ADC_1")) return static_cast<std::uint32_t>(row.factory / 4);
  if (setup.chose(option("factory_values", "least")) && is_useful_guess(row))
    return static_cast<std::uint32_t>(std::max<Value>(row.min, 0));
  return static_cast<std::uint32_t>(row.factory);
}

Eeprom factory_memory(const Setup& setup) {
  std::array<std::uint32_t, kSlotCount> factory{};
  std::array<bool, kSlotCount> is_persistent{};
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    factory[slot] = factory_bits(setup, row);
    is_persistent[slot] = setup.keeps(row);
  });
  return Eeprom(factory, is_persistent);
}

void Memory::save(const RegisterRow& row, std::size_t slot, std::optional<bool>& was_saving) {
  if (!setup_.keeps(row)) return;
  if (!was_saving) was_saving = state_.eeprom.writing();
  if (*was_saving && setup_.chose(option("write_while_saving", "not_saved"))) return;
  const Tick ticks_per_word = setup_.chose(option("eeprom_time", "1ms_a_word")) ? 1 : 5;
  state_.eeprom.write(slot, state_.image[slot], ticks_per_word * (is_32_bit(row.type) ? 2 : 1), setup_.now(),
                      setup_.chose(option("eeprom_same_value", "saved_again")));
}

void Memory::take_password() {
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
}

void Memory::judge_lock() { state_.unlocked = password_fits(state_, setup_); }

bool is_unlocked(const State& state, const Setup& setup) {
  return setup.chose(option("lock_judged", "always")) ? password_fits(state, setup) : state.unlocked;
}

void Memory::change_password(std::uint16_t password) {
  if (is_unlocked(state_, setup_)) {
    state_.password = password;
  } else {
    state_.image[kPassword] = state_.password;
  }
}

}  // namespace understudy::emulator::models::simple2_r3
