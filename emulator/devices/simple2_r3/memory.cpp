// Simple2-R3's memory: what power-up finds and power-off loses, the program's cells, the password.
#include <algorithm>

#include "emulator/devices/simple2_r3/axis_slots.h"
#include "emulator/devices/simple2_r3/choices.h"
#include "emulator/devices/simple2_r3/device.h"
#include "emulator/register_map/access.h"
#include "interpreter/simple2/listing.h"

namespace understudy::emulator::simple2_r3 {

namespace {

constexpr Firmware kFirstWithPassword = 151;
constexpr Tick kRewriteTicks = 500;  // Erase_ALL, Factory_Reset

constexpr std::size_t kPassword = slot("NEW_PWD");
constexpr std::array<std::size_t, 4> kColumns{slot("MAIN_LINE{}_CMD"), slot("MAIN_LINE{}_DATA1"),
                                              slot("MAIN_LINE{}_DATA2"), slot("MAIN_LINE{}_JMP")};
constexpr std::uint16_t kProgramAddress = 0x4000;

/// Calls `visit(slot, row)` for every register.
template <typename Visit>
void for_each_slot(Visit visit) {
  std::size_t next = 0;
  for (const RegisterRow& row : kRegisters) {
    for (int i = 0; i < row.count; ++i) visit(next++, row);
  }
}

}  // namespace

bool Simple2R3::keeps(const RegisterRow& row) const {
  // No star is printed at NEW_PWD.
  return row.persistent || (choice(kPasswordKept) == 0 && row.name == "NEW_PWD");
}

Eeprom Simple2R3::factory_memory() const {
  std::array<std::uint32_t, kSlotCount> factory{};
  std::array<bool, kSlotCount> is_kept{};
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    factory[slot] = static_cast<std::uint32_t>(row.factory);
    is_kept[slot] = keeps(row);
  });
  return Eeprom(factory, is_kept);
}

void Simple2R3::register_written(const RegisterRow& row, std::size_t slot) {
  const Tick ticks_per_word = choice(kEepromTime) == 0 ? 5 : 1;
  state_.eeprom.write(slot, state_.image[slot], ticks_per_word * (is_32_bit(row.type) ? 2 : 1), now());
}

void Simple2R3::blank_state() {
  State blank;
  blank.eeprom = std::move(state_.eeprom);
  for (std::size_t i = 0; i < blank.axes.size(); ++i) {
    blank.axes[i].encoder_counts = state_.axes[i].encoder_counts;
  }
  state_ = std::move(blank);
}

void Simple2R3::power_down() {
  state_.eeprom.lose_power();
  blank_state();
}

void Simple2R3::power_up() {
  blank_state();
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = keeps(row) ? state_.eeprom.kept()[slot] : static_cast<std::uint32_t>(row.factory);
  });
  state_.first_tick = now() + 1;
  state_.switches = switch_levels();
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  reload_program();

  motion::AxisSettings motor;
  const auto reaction = [&](std::size_t row) {
    return choice(row) == 0 ? motion::Reaction::stop_at_once : motion::Reaction::ignore;
  };
  motor.at_limit_plus = motor.at_limit_minus = reaction(kLimitReaction);
  motor.at_alarm = reaction(kAlarmReaction);
  for (int i = 0; i < 2; ++i) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(i)];
    axis.motor.set(motor);
    axis.motor.servo_on = choice(kServoAtPowerUp) == 1;
    // The encoder counts from 0, wherever the machine stands.
    const bool reversed = state_.image[kAxisSlots[static_cast<std::size_t>(i)].encoder_polarity] != 0;
    axis.encoder_preset = reversed ? axis.encoder_counts : -axis.encoder_counts;
    axis.encoder_history.fill(axis.encoder_counts);
  }
}

std::uint8_t Simple2R3::switch_levels() const {
  std::uint8_t levels = 0;
  for (int i = 0; i < kSwitchCount; ++i) levels |= static_cast<std::uint8_t>(input(kFirstSwitch + i) << i);
  return levels;
}

bool Simple2R3::dip_switch(int number) const {
  const std::uint8_t levels = choice(kSwitchesSampled) == 0 ? state_.switches : switch_levels();
  return ((levels >> number) & 1) != 0;
}

// --- factory reset, erasure ------------------------------------------------------------------------

void Simple2R3::reset_to_factory() {
  constexpr std::size_t kFirstSurvivor = slot("ADC_10V_A");
  constexpr std::size_t kLastSurvivor = slot("ADC_1V_B");
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    const bool stays = !keeps(row) && choice(kFactoryResetVolatile) == 1;
    if (stays || (slot >= kFirstSurvivor && slot <= kLastSurvivor)) return;
    state_.image[slot] = static_cast<std::uint32_t>(row.factory);
  });
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  stop_program();
  reload_program();
  state_.eeprom.rewrite(kRewriteTicks, now());
  for (int axis = 0; axis < 2; ++axis) {
    switch_servo(axis, false);
    state_.axes[static_cast<std::size_t>(axis)].homed = false;
  }
  if (choice(kFactoryResetVolatile) == 1) return;
  state_.written_outputs = 0;
  state_.timers = {};
  for (AxisState& axis : state_.axes) axis.alarm_clear_until = 0;
}

void Simple2R3::erase_program() {
  stop_program();
  for (const std::size_t column : kColumns) {
    std::fill_n(state_.image.begin() + static_cast<std::ptrdiff_t>(column), interpreter::simple2::kLineCount,
                0U);
  }
  reload_program();
  state_.eeprom.rewrite(kRewriteTicks, now());
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
  if (!assembly.lines) {
    const auto& error = assembly.errors.front();
    throw ProgramError(error.line, error.field + ": " + error.what + "; expected " + error.expected);
  }
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
  if (choice(kLockJudged) == 0) return state_.unlocked;
  return firmware() < kFirstWithPassword || state_.image[slot("PWD_Input")] == state_.password;
}

void Simple2R3::change_password(std::uint16_t password) {
  if (unlocked()) {
    state_.password = password;
  } else {
    state_.image[kPassword] = state_.password;
  }
}

}  // namespace understudy::emulator::simple2_r3
