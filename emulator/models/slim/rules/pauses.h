// The transition table of pauses: the effect of each command during each pause.
//
//   PZ   is ended by REDO, which continues, and by CLR BUF, which abandons
//   TAPZ is ended by TAREDO, which continues, and by TAUPZ, which abandons
//   TASTOP ends both
//
// Both pauses can be in effect; motion continues when both have ended. Each cell contains the outcome, the
// remaining pause, the source (a line of the command list, or a row of choices.h), and the results with other
// options. chain/stops.cpp and chain/refusals.cpp use the table, and pauses_test.cpp checks every cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>

#include "emulator/models/slim/rules/chain_options.h"

namespace understudy::emulator::models::slim {

enum class Pauses : std::uint8_t { none, pz, tapz, both };
inline constexpr std::size_t kPauses = 4;

constexpr bool has_pz(Pauses pauses) { return pauses == Pauses::pz || pauses == Pauses::both; }
constexpr bool has_tapz(Pauses pauses) { return pauses == Pauses::tapz || pauses == Pauses::both; }
constexpr Pauses pauses_of(bool pz, bool tapz) {
  if (pz) return tapz ? Pauses::both : Pauses::pz;
  return tapz ? Pauses::tapz : Pauses::none;
}

enum class InPause : std::uint8_t {
  pz,
  redo,
  clear_buffer,
  tapz,
  taredo,
  taupz,
  tastop,
  reset,   // a RESET of T0; a RESET of another module concerns only that module
  motion,  // a motion that can wait in the buffer: MA, H, 2MA ...
  jog,     // a motion that cannot wait: JGF, JGR, FT
};
inline constexpr std::size_t kInPause = 10;

enum class PauseOutcome : std::uint8_t {
  slows_down,  // held motion slows down on its path without losing any of it
  continues,   // motion that is no longer held continues
  gives_up,    // the unfinished command and the waiting commands are discarded
  clears,      // waiting commands are discarded; the unfinished one is completed, now or after the pause
  stops,       // no further pulses, and no command remains
  resets,      // like stops, for one module
  in_vain,     // no effect, or error 3 (choice `ineffective_pause`)
  is_taken,    // accepted; begins when it reaches the head
  waits,       // accepted; begins when the pause is over
  is_refused,  // error 6; in a program, it waits
};

struct PauseResult {
  Pauses left = Pauses::none;
  PauseOutcome outcome = PauseOutcome::in_vain;

  bool operator==(const PauseResult&) const = default;
};

/// The result of a cell if another option is selected.
struct OtherPauseResult {
  std::optional<Option> chosen{};
  PauseResult result{};
};

struct PauseRow {
  Pauses pauses;
  InPause what;
  PauseResult result;
  std::string_view by;
  OtherPauseResult other{}, another{};  // the first one whose option is selected applies
};

namespace pauses {

using enum PauseOutcome;
using P = Pauses;
using W = InPause;

inline constexpr Option kOnePause = option("pauses", "one_pause");
inline constexpr Option kOnlyWhatWaits = option("clear_buffer_in_pause", "what_waits");
inline constexpr Option kEndsPause = option("reset", "pause_too");

// clang-format off
inline constexpr PauseRow kRows[] = {
    {P::none, W::pz,           {P::pz, slows_down},   "list, PZ", {kOnePause, {P::tapz, slows_down}}},
    {P::none, W::redo,         {P::none, in_vain},    "ineffective_pause"},
    {P::none, W::clear_buffer, {P::none, clears},     "list, CLR BUF"},
    {P::none, W::tapz,         {P::tapz, slows_down}, "list, TAPZ"},
    {P::none, W::taredo,       {P::none, in_vain},    "ineffective_pause"},
    {P::none, W::taupz,        {P::none, in_vain},    "ineffective_pause"},
    {P::none, W::tastop,       {P::none, stops},      "list, TASTOP"},
    {P::none, W::reset,        {P::none, resets},     "list, RESET"},
    {P::none, W::motion,       {P::none, is_taken},   "busy"},
    {P::none, W::jog,          {P::none, is_taken},   "list, JGF"},

    {P::pz, W::pz,             {P::pz, slows_down},   "list, PZ"},
    {P::pz, W::redo,           {P::none, continues},  "list, REDO"},
    {P::pz, W::clear_buffer,   {P::none, gives_up},   "clear_buffer_in_pause", {kOnlyWhatWaits, {P::pz, clears}}},
    {P::pz, W::tapz,           {P::both, slows_down}, "pauses"},
    {P::pz, W::taredo,         {P::pz, in_vain},      "pauses"},
    {P::pz, W::taupz,          {P::pz, in_vain},      "pauses"},
    {P::pz, W::tastop,         {P::none, stops},      "emergency_stop"},
    {P::pz, W::reset,          {P::pz, resets},       "reset", {kEndsPause, {P::none, gives_up}}},
    {P::pz, W::motion,         {P::pz, waits},        "pauses"},
    {P::pz, W::jog,            {P::pz, is_refused},   "pauses"},

    {P::tapz, W::pz,           {P::both, slows_down}, "pauses", {kOnePause, {P::tapz, slows_down}}},
    {P::tapz, W::redo,         {P::tapz, in_vain},    "pauses", {kOnePause, {P::none, continues}}},
    {P::tapz, W::clear_buffer, {P::tapz, gives_up},   "clear_buffer_in_pause", {kOnlyWhatWaits, {P::tapz, clears}}, {kOnePause, {P::none, gives_up}}},
    {P::tapz, W::tapz,         {P::tapz, slows_down}, "list, TAPZ"},
    {P::tapz, W::taredo,       {P::none, continues},  "list, TAREDO"},
    {P::tapz, W::taupz,        {P::none, gives_up},   "list, TAUPZ"},
    {P::tapz, W::tastop,       {P::none, stops},      "emergency_stop"},
    {P::tapz, W::reset,        {P::tapz, resets},     "reset", {kEndsPause, {P::none, gives_up}}},
    {P::tapz, W::motion,       {P::tapz, is_refused}, "list, TAPZ"},
    {P::tapz, W::jog,          {P::tapz, is_refused}, "list, TAPZ"},

    {P::both, W::pz,           {P::both, slows_down}, "pauses"},
    {P::both, W::redo,         {P::tapz, continues},  "pauses"},
    {P::both, W::clear_buffer, {P::tapz, gives_up},   "clear_buffer_in_pause", {kOnlyWhatWaits, {P::both, clears}}},
    {P::both, W::tapz,         {P::both, slows_down}, "pauses"},
    {P::both, W::taredo,       {P::pz, continues},    "pauses"},
    {P::both, W::taupz,        {P::pz, gives_up},     "pauses"},
    {P::both, W::tastop,       {P::none, stops},      "emergency_stop"},
    {P::both, W::reset,        {P::both, resets},     "reset", {kEndsPause, {P::none, gives_up}}},
    {P::both, W::motion,       {P::both, is_refused}, "list, TAPZ"},
    {P::both, W::jog,          {P::both, is_refused}, "list, TAPZ"},
};
// clang-format on

inline constexpr auto kRowOfCell = [] {
  std::array<std::array<std::uint8_t, kInPause>, kPauses> cells{};
  for (auto& cells_of_one : cells) cells_of_one.fill(255);
  for (std::size_t i = 0; i < std::size(pauses::kRows); ++i) {
    std::uint8_t& cell = cells[static_cast<std::size_t>(pauses::kRows[i].pauses)]
                              [static_cast<std::size_t>(pauses::kRows[i].what)];
    if (cell != 255) throw "a cell has two rows";
    cell = static_cast<std::uint8_t>(i);
  }
  for (const auto& cells_of_one : cells) {
    for (const std::uint8_t cell : cells_of_one) {
      if (cell == 255) throw "a cell has no row";
    }
  }
  return cells;
}();

}  // namespace pauses

/// The number of this table in transition_tables.h.
inline constexpr std::size_t kPauseTable = 1;

constexpr const PauseRow& pause_row(Pauses now, InPause what) {
  return pauses::kRows[pauses::kRowOfCell[static_cast<std::size_t>(now)][static_cast<std::size_t>(what)]];
}

constexpr PauseResult pause_result(const ChainOptions& options, Pauses now, InPause what) {
  options.noted.meet(kPauseTable, static_cast<std::size_t>(now), static_cast<std::size_t>(what));
  const PauseRow& row = pause_row(now, what);
  for (const OtherPauseResult& other : {row.other, row.another}) {
    if (other.chosen && options.chose(*other.chosen)) return other.result;
  }
  return row.result;
}

}  // namespace understudy::emulator::models::slim
