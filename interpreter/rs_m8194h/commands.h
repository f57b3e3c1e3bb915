// The RS-M8194H's 229 command codes as data. The window, the macros, their text and `describe` read these
// rows.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/rows_of_axes.h"
#include "interpreter/rs_m8194h/rows_of_counters.h"
#include "interpreter/rs_m8194h/rows_of_events.h"
#include "interpreter/rs_m8194h/rows_of_macros.h"
#include "interpreter/rs_m8194h/rows_of_paths.h"
#include "interpreter/rs_m8194h/rows_of_settings.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {

inline constexpr std::size_t kFunctionCount = rows::kSettings.size() + rows::kCounters.size() +
                                              rows::kAxes.size() + rows::kPaths.size() +
                                              rows::kEvents.size() + rows::kMacros.size();

/// All functions, in the manual's order.
inline constexpr std::array<CommandRow, kFunctionCount> kCommands = [] {
  std::array<CommandRow, kFunctionCount> all{};
  auto end = all.begin();
  const auto append = [&end](const auto& some) { end = std::ranges::copy(some, end).out; };
  append(rows::kSettings);
  append(rows::kCounters);
  append(rows::kAxes);
  append(rows::kPaths);
  append(rows::kEvents);
  append(rows::kMacros);
  return all;
}();

/// The two halves of the code space: real-time commands, and lines of a macro.
inline constexpr std::uint16_t kRealTime = 0x0A00;
inline constexpr std::uint16_t kMacroLine = 0x0C00;

constexpr std::uint16_t real_time_code(Verb verb) {
  return static_cast<std::uint16_t>(kRealTime + static_cast<std::uint16_t>(verb));
}
constexpr std::uint16_t macro_code(Verb verb) {
  return static_cast<std::uint16_t>(kMacroLine + static_cast<std::uint16_t>(verb));
}
constexpr bool is_macro_code(std::uint16_t code) { return (code & 0xFF00U) == kMacroLine; }
constexpr Verb verb_of(std::uint16_t code) { return static_cast<Verb>(code & 0xFFU); }

namespace commands_detail {
/// The index of the function for each low byte; -1: none.
inline constexpr std::array<std::int16_t, 256> kPlaces = [] {
  std::array<std::int16_t, 256> places{};
  places.fill(-1);
  for (std::size_t i = 0; i < kCommands.size(); ++i) {
    std::int16_t& place = places[static_cast<std::size_t>(kCommands[i].verb)];
    if (place >= 0) throw "two functions have one code";
    place = static_cast<std::int16_t>(i);
  }
  return places;
}();
}  // namespace commands_detail

constexpr const CommandRow& row_of(Verb verb) {
  return kCommands[static_cast<std::size_t>(commands_detail::kPlaces[static_cast<std::size_t>(verb)])];
}

/// Returns the function of a code; null if the code is undefined.
constexpr const CommandRow* find_code(std::uint16_t code) {
  const std::int16_t place = commands_detail::kPlaces[code & 0xFFU];
  if (place < 0) return nullptr;
  const CommandRow& row = kCommands[static_cast<std::size_t>(place)];
  const std::string_view name = is_macro_code(code)             ? row.macro_name
                                : (code & 0xFF00U) == kRealTime ? row.real_time_name
                                                                : std::string_view{};
  return name.empty() ? nullptr : &row;
}

constexpr std::string_view name_of(std::uint16_t code) {
  const CommandRow& row = row_of(verb_of(code));
  return is_macro_code(code) ? row.macro_name : row.real_time_name;
}

/// The verbs that open or close a download.
inline constexpr std::array kDownloadVerbs = {Verb::mp_create, Verb::mp_close, Verb::isr_create,
                                              Verb::isr_close};

/// Macro lines that the interpreter executes itself. Some also have a real-time code.
inline constexpr std::array kFlowVerbs = {
    Verb::set_var, Verb::set_rvar,  Verb::var_calculate, Verb::for_,       Verb::next,        Verb::exit_for,
    Verb::if_,     Verb::else_,     Verb::end_if,        Verb::goto_,      Verb::label,       Verb::timer,
    Verb::mp_call, Verb::stop_wait, Verb::exit_macro,    Verb::frnet_wait, Verb::mp_terminate};

/// Macro lines that read a value into the return register.
inline constexpr std::array kReadVerbs = {
    Verb::get_lp,     Verb::get_ep,         Verb::abs_get_position,  Verb::get_di,
    Verb::get_di_all, Verb::get_di_signal,  Verb::get_di_signal_all, Verb::get_home_search_state,
    Verb::get_error,  Verb::get_error_code, Verb::frnet_in,          Verb::frnet_read,
    Verb::get_latch};

/// Macro lines that decide something, for observers: a block is entered, repeated or skipped, or a wait ends
/// at once.
inline constexpr std::array kDecidingVerbs = {Verb::for_, Verb::next, Verb::if_, Verb::stop_wait,
                                              Verb::frnet_wait};

constexpr bool is_one_of(Verb verb, const auto& verbs) {
  return std::ranges::find(verbs, verb) != verbs.end();
}

namespace commands_detail {
/// Returns true for a real-time command, or for a macro line that is neither a read nor program flow.
constexpr bool is_of_device(const CommandRow& row) {
  if (is_one_of(row.verb, kDownloadVerbs)) return false;
  return !row.real_time_name.empty() ||
         (!is_one_of(row.verb, kFlowVerbs) && !is_one_of(row.verb, kReadVerbs));
}
}  // namespace commands_detail

/// The verbs that a device executes: the keys of its handler table.
inline constexpr auto kDeviceVerbs = [] {
  std::array<Verb, std::ranges::count_if(kCommands, commands_detail::is_of_device)> verbs{};
  std::size_t count = 0;
  for (const CommandRow& row : kCommands) {
    if (commands_detail::is_of_device(row)) verbs[count++] = row.verb;
  }
  return verbs;
}();

static_assert(kCommands.size() == 139);
static_assert(std::ranges::count_if(kCommands,
                                    [](const CommandRow& row) { return !row.real_time_name.empty(); }) +
                  std::ranges::count_if(kCommands,
                                        [](const CommandRow& row) { return !row.macro_name.empty(); }) ==
              229);

}  // namespace understudy::interpreter::rs_m8194h
