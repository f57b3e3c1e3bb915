// Simple2-R3's memory: what power-up finds and power-off loses, the program's cells, the password.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#include "base/simulated_time.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/memory/register_memory.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/simple2_r3/axis_drive.h"
#include "emulator/models/simple2_r3/axis_slots.h"
#include "emulator/models/simple2_r3/device.h"
#include "emulator/models/simple2_r3/language.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/registers.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"
#include "motion/axis.h"
#include "motion/environment.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr Firmware kFirstWithPassword = 151;
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

/// Erase_ALL, Factory_Reset.
Tick rewrite_ticks(const Simple2R3& device) {
  return device.chose(option("eeprom_erasure", "100ms")) ? 100 : 500;
}

interpreter::simple2::FlagRules flag_rules_of(const Simple2R3& device) {
  using Rules = interpreter::simple2::FlagRules;
  Rules rules;
  if (device.chose(option("same_flag_twice", "last_written"))) rules.several = Rules::Several::last_written;
  if (device.chose(option("flags_after_end", "does_not_count")))
    rules.after_end = Rules::AfterEnd::do_not_count;
  if (device.chose(option("flags_found", "at_start"))) rules.found = Rules::Found::when_told;
  return rules;
}

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

void Simple2R3::blank_state() {
  State blank;
  blank.eeprom = std::move(state_.eeprom);
  for (std::size_t i = 0; i < blank.axes.size(); ++i) {
    blank.axes[i].encoder_raw = state_.axes[i].encoder_raw;
  }
  state_ = std::move(blank);
}

void Simple2R3::power_down() {
  const bool ends_first = state_.eeprom.writing() && chose(option("power_cut", "new_value"));
  if (ends_first) state_.eeprom.step(state_.eeprom.next_active_tick(), state_.image);
  state_.eeprom.lose_power();
  const std::uint8_t switches = state_.switches;
  blank_state();
  state_.switches = switches;  // the line keeps its speed meanwhile
}

void Simple2R3::power_up() {
  blank_state();
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    state_.image[slot] = keeps(row) ? state_.eeprom.kept()[slot] : factory_bits(row);
  });
  for (std::size_t i = 0; i < kAssignmentCount; ++i) {
    if (state_.image[kFirstAssignment + i] != 0) state_.assignments |= static_cast<std::uint16_t>(1U << i);
  }
  state_.first_tick = now() + 1 + boot_ticks_;
  state_.switches = switch_levels();
  reset_timers();
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  state_.program = interpreter::simple2::Program({}, flag_rules_of(*this));
  reload_program();
  find_flags_if_told();

  motion::AxisSettings motor;
  const auto reaction_to = [&](motion::Signal signal) {
    return ignores(signal) ? motion::Reaction::ignore : motion::Reaction::stop_at_once;
  };
  motor.at_limit_plus = motor.at_limit_minus = reaction_to(motion::Signal::limit_plus);
  motor.at_alarm = reaction_to(motion::Signal::alarm);
  for (int i = 0; i < 2; ++i) {
    AxisState& axis = state_.axes[static_cast<std::size_t>(i)];
    motor.needs_servo = servo_matters(i);
    axis.motor.set(motor);
    axis.motor.servo_on = chose(option("servo_at_power_up", "on"));
  }
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

void Simple2R3::reset_timers() {
  for (Timer& timer : state_.timers) {
    timer = {};
    if (chose(option("timers_at_power_up", "running"))) run_timer(timer, true);
  }
}

bool Simple2R3::dip_switch(int number) const {
  const std::uint8_t levels = chose(option("switches_sampled", "always")) ? switch_levels() : state_.switches;
  return ((levels >> number) & 1) != 0;
}

// --- factory reset, erasure ------------------------------------------------------------------------

void Simple2R3::reset_to_factory() {
  if (!unlocked() && chose(option("locked_reset", "ignored"))) return;
  const bool volatile_stays = chose(option("factory_reset_of_volatile", "kept"));
  constexpr std::size_t kFirstSurvivor = slot("ADC_10V_A");
  constexpr std::size_t kLastSurvivor = slot("ADC_1V_B");
  for_each_slot([&](std::size_t slot, const RegisterRow& row) {
    const bool stays = volatile_stays && !keeps(row);
    if (stays || (slot >= kFirstSurvivor && slot <= kLastSurvivor)) return;
    state_.image[slot] = factory_bits(row);
  });
  state_.password = static_cast<std::uint16_t>(state_.image[kPassword]);
  judge_lock();
  stop_program();
  reload_program();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(*this), now());
  for (int axis = 0; axis < 2; ++axis) {
    if (!chose(option("factory_reset_motion", "goes_on"))) switch_servo(axis, false);
    state_.axes[static_cast<std::size_t>(axis)].homed = false;
  }
  if (volatile_stays) return;
  state_.written_outputs = 0;
  reset_timers();
  for (AxisState& axis : state_.axes) axis.alarm_clear_until = 0;
}

void Simple2R3::erase_program() {
  if (!chose(option("erase_while_running", "goes_on"))) stop_program();
  for (const std::size_t column : kColumns) {
    std::fill_n(state_.image.begin() + static_cast<std::ptrdiff_t>(column), interpreter::simple2::kLineCount,
                0U);
  }
  reload_program();
  state_.eeprom.rewrite(state_.image, rewrite_ticks(*this), now());
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
