// RS-M8194H: the non-volatile memory, other than registers: macros and triggers as text, the Initial Table by
// the names of its settings.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "emulator/device/memory/text_blocks.h"
#include "emulator/models/rs_m8194h/axis_settings.h"
#include "interpreter/rs_m8194h/command.h"

namespace understudy::emulator::models::rs_m8194h {

namespace lang = interpreter::rs_m8194h;

inline constexpr std::string_view kMpBlocks = "mp";
inline constexpr std::string_view kIsrBlocks = "isr";
inline constexpr std::string_view kTriggerBlocks = "triggers";

inline constexpr std::string_view kInitialBlocks = "initial";

/// Macros are named by their number, triggers by their channel ("8.0"), the Initial Table by its axes.
std::span<const BlockKind> block_kinds();

using InitialTable = std::array<BasicSettings, kAxes>;
/// Stores the Initial Table as the commands that produce it from the factory settings.
void keep_initial_table(TextBlocks& blocks, const InitialTable& table, const BasicSettings& factory);
InitialTable initial_table_of(const TextBlocks& blocks, const BasicSettings& factory);

/// Returns a parameter of one register.
inline std::uint8_t byte_at(const lang::Command& command, std::size_t i) {
  return static_cast<std::uint8_t>(command.values[i]);
}

/// Applies a command of section 3 to settings; other commands have no effect.
void apply_setting(BasicSettings& settings, const lang::Command& command);

}  // namespace understudy::emulator::models::rs_m8194h
