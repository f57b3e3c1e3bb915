#include "emulator/models/slim/setup.h"

#include <algorithm>
#include <cstddef>

#include "emulator/device/device.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/availability.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/program.h"

namespace understudy::emulator::models::slim {

namespace {

/// Returns the chosen option of each row, from the device.
ChainOptions options_of(const Device& device) {
  decltype(ChainOptions::numbers) numbers{};
  for (std::size_t row = 0; row < numbers.size(); ++row) numbers[row] = device.choice(row);
  return {.numbers = numbers, .noted = NotedDecisions(&device.decisions())};
}

lang::ProgramOptions program_options(const ChainOptions& chosen) {
  using Options = lang::ProgramOptions;
  Options options;
  lang::Dialect& dialect = options.dialect;
  dialect.event_count = chosen.number(numbers("events"));
  dialect.longest_line = static_cast<std::size_t>(chosen.number(numbers("longest_line")));
  if (chosen.chose(option("helix_variables", "four_variables"))) dialect.helix_constants = false;
  if (chosen.chose(option("functions", "what_queries_show_too"))) dialect.quantities = true;
  if (chosen.chose(option("integer_range", "from_minus_32766"))) dialect.integer_min = -32766;
  if (chosen.chose(option("while_program_runs", "external_column_only")))
    options.columns.external = lang::Columns::External::strict;
  if (chosen.chose(option("while_program_runs", "reset_too")))
    options.columns.external = lang::Columns::External::with_reset;
  if (chosen.chose(option("immediate_column", "taken")))
    options.columns.variable_forms = lang::Columns::VariableForms::typed_too;
  if (chosen.chose(option("first_list_columns", "saves_in_programs_too")))
    options.columns.saves = lang::Columns::Saves::stored_too;
  options.capacity = chosen.number(numbers("program_size"));
  if (chosen.chose(option("addresses", "line_number_from_1"))) options.first_number = 1;
  if (chosen.chose(option("program_check", "when_it_runs"))) options.check = Options::Check::as_run;
  if (chosen.chose(option("edit_end", "exit_or_esc"))) options.empty_line = Options::EmptyLine::is_ignored;
  if (chosen.chose(option("refused_line", "ends_editing")))
    options.refused_line = Options::RefusedLine::ends_pe_and_pi;
  options.check_command =
      Setup::takes_letters_away(chosen)
          ? [](const lang::Command& command) { return check_parameter_line(command, true); }
          : [](const lang::Command& command) { return check_parameter_line(command, false); };
  if (chosen.chose(option("same_label", "the_first_counts")))
    options.same_label = Options::SameLabel::first_counts;
  if (chosen.chose(option("listing", "text"))) options.listing = Options::Listing::bare;
  return options;
}

lang::FlowOptions flow_options(const ChainOptions& chosen) {
  lang::FlowOptions options{.program = program_options(chosen)};
  if (chosen.chose(option("lines_a_tick", "four_a_millisecond"))) options.lines_per_tick = 4;
  if (chosen.chose(option("lines_a_tick", "one_in_4_milliseconds"))) options.lines_every_ms = 4;
  if (chosen.chose(option("time_unit", "4_milliseconds"))) options.window_unit_ms = 4;
  options.call_depth = chosen.number(numbers("call_depth"));
  if (chosen.chose(option("bare_number", "into_n0_or_r0")))
    options.bare_number = lang::FlowOptions::BareNumber::into_n0_or_r0;
  if (chosen.chose(option("events_without_program", "run_their_routine")))
    options.events_need_program = false;
  if (chosen.chose(option("event_check", "each_4_milliseconds"))) options.events.check_interval_ms = 4;
  if (chosen.chose(option("failed_line", "is_passed_over")))
    options.failed_line = lang::FlowOptions::FailedLine::is_passed;
  if (chosen.chose(option("interrupted_wait", "have_gone_on")))
    options.interrupted_timer = lang::FlowOptions::InterruptedTimer::continues;
  if (chosen.chose(option("event_at_arming", "waits_for_a_change")))
    options.events.at_arming = lang::EventOptions::AtArming::waits_for_change;
  if (chosen.chose(option("held_event", "is_dropped")))
    options.events.held = lang::EventOptions::Held::is_dropped;
  return options;
}

}  // namespace

Setup::Setup(const Device& of)
    : device(of),
      modules(std::max(of.settings().modules, 1)),
      options(options_of(of)),
      flow(flow_options(options)) {}

MemoryForm Setup::memory_form() const {
  return {.speed_names = chose(option("speed_parameters", "pn14_is_vm")) ? SpeedNames::pn14_is_vm
                                                                         : SpeedNames::pn10_is_vm,
          .integer_min = of_programs().dialect.integer_min};
}

Memory Setup::factory() const {
  return factory_memory(chose(option("linked_from_factory", "t0_alone")) ? 1 : modules);
}

}  // namespace understudy::emulator::models::slim
