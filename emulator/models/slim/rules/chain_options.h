// The selected options that affect modules and motion, for the chain.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "base/choices.h"
#include "emulator/device/decisions.h"
#include "emulator/models/slim/rules/choices.h"
#include "emulator/models/slim/rules/options.h"

namespace understudy::emulator::models::slim {

/// A pointer to a device's decisions. It is stored within the device's state but is not part of the state, so
/// all such pointers compare equal. A copy of the state may outlive the device or belong to another device,
/// so a copy has no pointer, and assignment keeps the target's own pointer.
struct NotedDecisions {
  Decisions* decisions = nullptr;

  constexpr NotedDecisions() = default;
  constexpr explicit NotedDecisions(Decisions* of_device) : decisions(of_device) {}
  constexpr NotedDecisions(const NotedDecisions& /*other*/) {}
  constexpr NotedDecisions& operator=(const NotedDecisions& /*other*/) { return *this; }

  constexpr void ask(std::size_t choice) const {
    if (decisions != nullptr) decisions->ask(choice);
  }
  constexpr void meet(std::size_t table, std::size_t state, std::size_t event) const {
    if (decisions != nullptr) decisions->meet(table, state, event);
  }
  constexpr bool operator==(const NotedDecisions& /*other*/) const { return true; }
};

/// The selected option of each row, by default the first one.
struct ChainOptions {
  std::array<std::uint8_t, std::size(kChoices)> numbers{};  // the selected option of each row
  NotedDecisions noted{};

  constexpr bool chose(const Option& option) const {
    noted.ask(option.choice);
    return numbers[option.choice] == option.number;
  }
  constexpr void choose(const Option& option) { numbers[option.choice] = option.number; }
  /// Returns the number of the selected option, for a row whose options are numbers.
  constexpr int number(std::size_t row) const {
    noted.ask(row);
    return number_of(kChoices[row], numbers[row]);
  }

  bool operator==(const ChainOptions&) const = default;

  // Options that several parts look up.
  constexpr bool has_servo_at_power_up() const { return !chose(option("power_up_servo", "off")); }
  constexpr bool reserves_moves_only() const { return chose(option("reserved_module", "moves_by_number")); }
  constexpr bool thrust_runs() const { return chose(option("thrust", "runs_at_vj")); }
  constexpr bool new_speed_counts_at_once() const { return chose(option("new_speed", "at_once")); }
  constexpr bool speeds_are_of_t0() const { return chose(option("unequal_speeds", "as_t0_has_them")); }
  constexpr bool acceleration_may_change() const {
    return chose(option("acceleration_in_motion", "next_command"));
  }
  /// Lines of two axes use PR4, not PR3.
  constexpr bool lines_have_own_speed() const { return chose(option("line_speed", "pr4_of_its_own")); }
  constexpr bool triggers_stay() const {
    return chose(option("position_outputs", "each_time_from_either_side_on_the_commanded_position"));
  }
};

}  // namespace understudy::emulator::models::slim
