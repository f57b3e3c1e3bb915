// Simple2-R3's memory: what it keeps, the DIP switches, the program's cells, the password.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/language.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/slots.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr Firmware kFirstWithPassword = 151;
constexpr std::uint16_t kProgramAddress = 0x4000;

/// Registers whose factory value the manual does not state, and which need more than the least to be of use.
bool is_useful_guess(const RegisterRow& row) {
  constexpr std::string_view kStated[] = {"HW_Code", "Aaxis_Resoultion", "Baxis_Resoultion"};
  const bool is_stated = std::find(std::begin(kStated), std::end(kStated), row.name) != std::end(kStated);
  return row.persistent && row.ranged && !is_stated;
}

}  // namespace

std::uint32_t Simple2R3::factory_bits(const RegisterRow& row) const {
  if (chose(option("first_password", "65535")) && row.name == "NEW_PWD") return 65535;
  if (adc_10_bits_ && row.name.starts_with("ADC_1")) return static_cast<std::uint32_t>(row.factory / 4);
  if (chose(option("factory_values", "least")) && is_useful_guess(row))
    return static_cast<std::uint32_t>(std::max<Value>(row.min, 0));
  return static_cast<std::uint32_t>(row.factory);
}

bool Simple2R3::keeps(const RegisterRow& row) const {
  // No star is printed at NEW_PWD.
  return row.persistent || (chose(option("password_kept", "yes")) && row.name == "NEW_PWD");
}

Eeprom Simple2R3::factory_memory() const {
  std::array<std::uint32_t, kSlotCount> factory{};
  std::array<bool, kSlotCount> is_kept{};
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    factory[slot] = factory_bits(row);
    is_kept[slot] = keeps(row);
  });
  return Eeprom(factory, is_kept);
}

void Simple2R3::register_written(const RegisterRow& row, std::size_t slot) {
  if (!keeps(row)) return;
  if (!was_saving_) was_saving_ = state_.eeprom.writing();
  if (*was_saving_ && chose(option("write_while_saving", "not_saved"))) return;
  const Tick ticks_per_word = chose(option("eeprom_time", "1ms_a_word")) ? 1 : 5;
  state_.eeprom.write(slot, state_.image[slot], ticks_per_word * (is_32_bit(row.type) ? 2 : 1), now(),
                      chose(option("eeprom_same_value", "saved_again")));
}

std::function<void(NvImage&)> Simple2R3::memory_writer() const {
  return registers_writer(*this, state_.eeprom.kept());
}

void Simple2R3::read_memory(const NvImage& image) {
  const auto values = read_registers(*this, image, Device::model().firmwares.back());
  for (std::size_t slot = 0; slot < values.size(); ++slot) state_.eeprom.put(slot, values[slot]);
}

std::uint8_t Simple2R3::switch_levels() const {
  std::uint8_t levels = 0;
  for (int i = 0; i < kSwitchCount; ++i) levels |= static_cast<std::uint8_t>(input(kFirstSwitch + i) << i);
  return levels;
}

void Simple2R3::find_flags_if_told() {
  using Found = interpreter::simple2::FlagRules::Found;
  if (state_.program.flag_rules().found == Found::when_told) state_.program.find_flags();
}

bool Simple2R3::dip_switch(int number) const {
  const std::uint8_t levels = chose(option("switches_sampled", "always")) ? switch_levels() : state_.switches;
  return ((levels >> number) & 1) != 0;
}

// --- the program -----------------------------------------------------------------------------------

void Simple2R3::reload_program() {
  for (std::size_t line = 0; line < 256; ++line) {
    for (std::size_t column = 0; column < 4; ++column) {
      const auto cell = static_cast<std::uint8_t>(state_.image[kColumns[column] + line]);
      const auto number = static_cast<int>(4 * line + column);
      if (state_.program.cell(number) != cell) state_.program.set_cell(number, cell);
    }
  }
}

void Simple2R3::load_program(std::string_view listing) {
  const auto assembly = interpreter::simple2::assemble(listing);
  if (!assembly.lines) throw ProgramError(mistakes_of(assembly));
  auto address = kProgramAddress;
  for (const auto& line : *assembly.lines) {
    const std::array<std::uint16_t, 4> words{line.command, line.data1, line.data2, line.flag};
    write_words(*this, Table::holding, address, words);
    address = static_cast<std::uint16_t>(address + words.size());
  }
}

std::string Simple2R3::program_text() const { return disassemble(state_.program.lines()); }

// --- the password ----------------------------------------------------------------------------------

void Simple2R3::judge_lock() {
  state_.unlocked = firmware() < kFirstWithPassword || state_.image[slot("PWD_Input")] == state_.password;
}

bool Simple2R3::unlocked() const {
  if (!chose(option("lock_judged", "always"))) return state_.unlocked;
  return firmware() < kFirstWithPassword || state_.image[slot("PWD_Input")] == state_.password;
}

void Simple2R3::change_password(std::uint16_t password) {
  if (unlocked()) {
    state_.password = password;
  } else {
    state_.image[kPassword] = state_.password;
  }
}

}  // namespace understudy::emulator::models::simple2_r3
