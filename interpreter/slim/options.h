// The selected options for lines and programs. The language looks them up through this header.
#pragma once

#include <cstddef>
#include <string_view>

#include "base/choices.h"
#include "interpreter/slim/choices.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/error.h"

namespace understudy::interpreter::slim {

struct Options : OptionsOf<kChoices> {
  using OptionsOf::OptionsOf;

  /// Performs the machine's checks of a command that do not depend on state, such as whether a parameter
  /// exists. Null: no check.
  Error (*check_command)(const Command& command) = nullptr;
};

consteval Options::Named option(std::string_view id, std::string_view name) {
  return Options::named(id, name);
}
/// Returns a row whose options are numbers: `options.number(numbers("program_size"))`.
consteval Options::Numbers numbers(std::string_view id) { return Options::numbers(id); }

/// Accepts every line that any option accepts, for text that was accepted before.
inline constexpr Options kWidestDialect{option("longest_line", "255_characters_then_error_1"),
                                        option("functions", "what_queries_show_too")};

constexpr std::size_t longest_line(const Options& options) {
  return static_cast<std::size_t>(options.number(numbers("longest_line")));
}

/// Returns the smallest value of integer variables.
constexpr int integer_min(const Options& options) {
  return options.chose(option("integer_range", "from_minus_32766")) ? -32766 : kIntegerMin;
}

/// Returns the number of a program's first line in addresses and in PE, PI, PD and PL.
constexpr int first_number(const Options& options) {
  return options.chose(option("addresses", "line_number_from_1")) ? 1 : 0;
}

/// Returns true if a line that no program can execute is refused when it runs, rather than when it is
/// entered.
constexpr bool checks_as_run(const Options& options) {
  return options.chose(option("program_check", "when_it_runs"));
}

/// Returns the interval between lines. Lines run at its multiples.
constexpr int line_interval_ms(const Options& options) {
  return options.chose(option("lines_a_tick", "one_in_4_milliseconds")) ? 4 : 1;
}

/// Returns the interval between checks of event conditions. The checks run at its multiples; changes in
/// between are not noticed.
constexpr int check_interval_ms(const Options& options) {
  return options.chose(option("event_check", "each_4_milliseconds")) ? 4 : 1;
}

/// Returns false if events call their routines even while no program is running.
constexpr bool events_need_program(const Options& options) {
  return !options.chose(option("events_without_program", "run_their_routine"));
}

}  // namespace understudy::interpreter::slim
