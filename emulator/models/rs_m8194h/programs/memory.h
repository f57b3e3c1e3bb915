// RS-M8194H: the non-volatile memory, except the registers: macros and triggers as text, and the Initial
// Table by the names of its settings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "emulator/device/memory/eeprom.h"
#include "emulator/device/memory/text_blocks.h"
#include "emulator/device/register_map/row.h"
#include "emulator/models/rs_m8194h/rows/axis_settings.h"
#include "emulator/models/rs_m8194h/rows/ground.h"
#include "emulator/models/rs_m8194h/rows/registers.h"
#include "interpreter/rs_m8194h/command.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

inline constexpr std::string_view kMpBlocks = "mp";
inline constexpr std::string_view kIsrBlocks = "isr";
inline constexpr std::string_view kTriggerBlocks = "triggers";

inline constexpr std::string_view kInitialBlocks = "initial";

/// The names of macros are their numbers, those of triggers are their channels ("8.0"), and those of the
/// Initial Table are its axes.
std::span<const BlockKind> block_kinds();

using InitialTable = std::array<BasicSettings, kAxes>;
/// Stores the Initial Table as the commands that create it from the factory settings.
void keep_initial_table(TextBlocks& blocks, const InitialTable& table, const BasicSettings& factory);
InitialTable initial_table_of(const TextBlocks& blocks, const BasicSettings& factory);

/// Everything that survives power-off, and the register image.
struct MemoryState {
  InitialTable initial_table{};
  TextBlocks blocks{};  // macros, triggers and the Initial Table, as text
  Eeprom eeprom{};
  std::vector<std::uint32_t> image{};

  bool operator==(const MemoryState&) const = default;
};

class Memory final : public Part {
 public:
  Memory(const Ground& ground, MemoryState& state) : Part(ground), state_(state) {}

  MemoryState& state() { return state_; }
  const MemoryState& state() const { return state_; }
  std::uint32_t value(std::size_t slot) const { return state_.image[slot]; }
  bool low_word_first() const { return state_.image[kWordOrderSlot] == 1; }
  bool are_triggers_enabled() const { return state_.image[kEventSlot] != 0; }

  /// Returns true if a register survives power-off.
  bool keeps(const RegisterRow& row) const;
  Eeprom factory_memory() const;
  std::vector<std::uint32_t> image_at_power_up() const;
  /// Sets a register, and stores it if it is retentive.
  void put(std::size_t slot, std::uint32_t bits);
  void clear(std::size_t first, std::size_t count);
  /// These access VAR0 to VAR511 and bVAR0 to bVAR127.
  std::int32_t variable(std::size_t number) const {
    return static_cast<std::int32_t>(state_.image[kFirstVarSlot + number]);
  }
  void set_variable(std::size_t number, std::int32_t value) {
    put(kFirstVarSlot + number, static_cast<std::uint32_t>(value));
  }
  std::uint8_t byte_variable(std::size_t number) const {
    return static_cast<std::uint8_t>(state_.image[kFirstBvarSlot + number]);
  }
  /// Stores a register that a request has written.
  void register_written(const RegisterRow& row, std::size_t slot);

  /// Returns the settings of a new device.
  BasicSettings factory_settings() const;
  void keep_initial_table();

 private:
  MemoryState& state_;
};

/// Returns a parameter as a byte.
inline std::uint8_t byte_at(const lang::Command& command, std::size_t i) {
  return static_cast<std::uint8_t>(command.values[i]);
}

/// Applies a command of section 3 to the settings. Other commands have no effect.
void apply_setting(BasicSettings& settings, const lang::Command& command);

}  // namespace understudy::emulator::models::rs_m8194h
