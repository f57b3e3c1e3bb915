#include "interpreter/slim/flow.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/complete_table.h"
#include "base/program_watch.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/program.h"
#include "interpreter/slim/verbs.h"
#include "interpreter/slim/words.h"

namespace understudy::interpreter::slim {
namespace {

using Kind = Operand::Kind;

void finish(Execution& execution, Ending ending, Error error = Error::none) {
  Events events = std::move(execution.events);
  execution = {.ending = ending, .error = error, .line = execution.line, .events = std::move(events)};
}

/// Returns which of GETI and GETR the line contains, if any.
std::optional<Kind> asked_of_host(const Command& command) {
  if (command.verb == Verb::get_integer) return Kind::get_integer;
  if (command.verb == Verb::get_real) return Kind::get_real;
  const auto asking =
      std::ranges::find_if(command.operands, [](const Operand& operand) { return asks_host(operand.kind); });
  if (asking == command.operands.end()) return std::nullopt;
  return asking->kind;
}

/// Returns how many lines run in a tick. A line that waits or fails ends the tick.
int lines_a_tick(const Options& options) {
  return options.chose(option("lines_a_tick", "four_a_millisecond")) ? 4 : 1;
}

/// Returns the unit of tm in JTI and JNTI, in milliseconds.
int window_unit_ms(const Options& options) {
  return options.chose(option("time_unit", "4_milliseconds")) ? 4 : 1;
}

/// Returns the first multiple of `every_ms` that is not before `ms`.
std::int64_t moment_from(std::int64_t ms, int every_ms) {
  const std::int64_t past_ms = ms % every_ms;
  return past_ms == 0 ? ms : ms + (every_ms - past_ms);
}

/// Executes one line in a tick.
class LineRun {
 public:
  LineRun(Execution& execution, std::int64_t now_ms, const Program& program, const Options& options,
          Machine& machine)
      : execution_(execution), now_ms_(now_ms), program_(program), options_(options), machine_(machine) {}

  Error run() {
    if (execution_.line >= program_.size()) return end(Ending::past_last_line);
    const StoredLine& line = program_.line(execution_.line);
    if (machine_.watch() != nullptr) begin();
    if (line.error != Error::none) return fail(line.error);
    const std::optional<Command>& command = line.parsed.command;
    if (!command) return next_line();
    const bool has_to_change = asked_of_host(*command) || has_variable_index(*command);
    const Error error = has_to_change ? run_changed(*command) : run_command(*command);
    return error == Error::none ? error : fail(error);
  }

  Error fail(Error error) {
    execution_.has_number = false;
    if (options_.chose(option("failed_line", "is_passed_over"))) {
      next_line();
    } else {
      finish(execution_, Ending::failed, error);
    }
    return error;
  }

  Error next_line() { return go_to(execution_.line + 1); }

 private:
  /// Notifies the observer that the line begins, unless the line was already waiting.
  void begin() {
    begins_ = execution_.hold == Hold::nothing;
    if (begins_) machine_.watch()->runs(0, execution_.line, 1);
  }
  bool decide(bool outcome) const {
    if (ProgramWatch* const watch = machine_.watch()) watch->decides(0, execution_.line, outcome, 1);
    return outcome;
  }
  /// Reports the decision of a wait when the wait begins.
  bool decide_wait(bool is_over) const { return begins_ ? decide(is_over) : is_over; }

  static bool has_variable_index(const Command& command) {
    return std::ranges::any_of(command.operands, &Operand::index_is_variable);
  }

  /// Executes the command after replacing GETI and GETR with the host's number, and variable indices with
  /// their values.
  Error run_changed(const Command& asking) {
    const std::optional<Kind> asked = asked_of_host(asking);
    if (asked && !execution_.has_number) return hold(Hold::number);
    Command command = asking;
    for (Operand& operand : command.operands) {
      if (!asks_host(operand.kind)) continue;
      const bool is_integer = operand.kind == Kind::get_integer;
      operand = {.kind = is_integer ? Kind::integer : Kind::real, .number = execution_.number};
    }
    if (const Error error = resolve_indices(command, machine_); error != Error::none) return error;
    const Error error = run_command(command);
    if (execution_.hold != Hold::machine) execution_.has_number = false;
    return error;
  }

  Error run_command(const Command& command) {
    if (kActions.has(command.verb)) return (this->*kActions[command.verb])(command);
    const Outcome outcome = machine_.carry_out(command);
    if (outcome.error != Error::none) return outcome.error;
    if (command.verb == Verb::wait_done) decide_wait(!outcome.waits);
    if (outcome.program == Outcome::Program::ends) return end(Ending::exited);
    if (outcome.program == Outcome::Program::forgets_what_it_interrupted) forget_what_was_interrupted();
    return outcome.waits ? hold(Hold::machine) : next_line();
  }

  /// The routine of an event continues to its RET, where the program ends.
  void forget_what_was_interrupted() {
    for (Frame& frame : execution_.stack) {
      if (frame.of_event) frame = {.line = program_.size(), .of_event = true};
    }
  }

  Error take_bare_number(const Command& asking) {
    const bool is_integer = asking.verb == Verb::get_integer;
    if (!options_.chose(option("bare_number", "into_n0_or_r0"))) return next_line();
    Command command{.verb = Verb::set_variable, .row = is_integer ? row_of("N#=data") : row_of("R#=data")};
    command.operands.push_back({.kind = is_integer ? Kind::integer_variable : Kind::real_variable});
    command.operands.push_back(
        {.kind = is_integer ? Kind::integer : Kind::real, .number = execution_.number});
    return run_command(command);
  }

  /// Returns the line as written. An event keeps a variable index, which is read again at every check.
  const Command& original() const { return *program_.line(execution_.line).parsed.command; }

  Condition condition_of(const Command& command) const {
    return static_cast<Condition>(kCommands[static_cast<std::size_t>(command.row)].variant);
  }

  Error jump_to(const Operand& address) {
    const std::optional<int> line = program_.find(address, options_);
    return line ? go_to(*line) : Error::address;
  }

  Error jump(const Command& command) { return jump_to(command.operands[0]); }

  Error jump_if(const Command& command) {
    bool holds = false;
    const Error error = test_condition(condition_of(command), command.operands, machine_, holds);
    if (error != Error::none) return error;
    return decide(holds) ? jump_to(command.operands.back()) : next_line();
  }

  Error jump_if_within(const Command& command) {
    bool holds = false;
    const Error error = test_condition(condition_of(command), command.operands, machine_, holds);
    if (error != Error::none) return error;
    if (holds && decide(true)) return jump_to(command.operands.back());
    const auto window_ms = static_cast<std::int64_t>(command.operands[1].number) * window_unit_ms(options_);
    const std::int64_t until_ms = execution_.hold == Hold::window ? execution_.until_ms : now_ms_ + window_ms;
    if (now_ms_ < until_ms) return hold(Hold::window, until_ms);
    decide(false);
    return next_line();
  }

  Error call(const Command& command) {
    const auto calls = std::ranges::count(execution_.stack, false, &Frame::of_event);
    const std::optional<int> line = program_.find(command.operands[0], options_);
    if (!line || calls >= options_.number(numbers("call_depth"))) return Error::address;
    execution_.stack.push_back({.line = execution_.line + 1});
    return go_to(*line);
  }

  Error give_back(const Command&) {
    if (execution_.stack.empty()) return end(Ending::returned);
    const Frame frame = execution_.stack.back();
    execution_.stack.pop_back();
    go_to(frame.line);
    const bool is_timed = frame.hold == Hold::timer || frame.hold == Hold::window;
    if (is_timed && options_.chose(option("interrupted_wait", "have_gone_on"))) {
      hold(frame.hold, frame.until_ms);
    }
    return Error::none;
  }

  Error wait_input(const Command& command) {
    bool holds = false;
    const Error error = test_condition(condition_of(command), command.operands, machine_, holds);
    if (error != Error::none) return error;
    return decide_wait(holds) ? next_line() : hold(Hold::input);
  }

  Error wait_time(const Command& command) {
    const double time_ms = command.operands[0].number;
    if (time_ms == 0) return next_line();
    return hold(Hold::timer, now_ms_ + static_cast<std::int64_t>(time_ms));
  }

  Error define(const Command&) {
    define_event(execution_.events, original(), options_);
    return next_line();
  }

  Error hold(Hold what, std::int64_t until_ms = 0) {
    execution_.hold = what;
    execution_.until_ms = until_ms;
    return Error::none;
  }

  /// Continues at a line. After the last line, the program ends at once.
  Error go_to(int line) {
    hold(Hold::nothing);
    if (line >= program_.size()) return end(Ending::past_last_line);
    execution_.line = line;
    return Error::none;
  }

  Error end(Ending ending) {
    finish(execution_, ending);
    return Error::none;
  }

  /// The commands that the interpreter executes itself.
  using Action = Error (LineRun::*)(const Command&);
  static const CompleteTable<Verb, Action> kActions;

  Execution& execution_;
  std::int64_t now_ms_;
  const Program& program_;
  const Options& options_;
  Machine& machine_;
  bool begins_ = false;  // set only if there is an observer
};

constexpr CompleteTable<Verb, LineRun::Action> LineRun::kActions(
    kFlowVerbs, std::to_array<HandlerRow<Verb, LineRun::Action>>({
                    {Verb::jump, &LineRun::jump},
                    {Verb::jump_if, &LineRun::jump_if},
                    {Verb::jump_if_within, &LineRun::jump_if_within},
                    {Verb::call, &LineRun::call},
                    {Verb::return_, &LineRun::give_back},
                    {Verb::wait_input, &LineRun::wait_input},
                    {Verb::wait_time, &LineRun::wait_time},
                    {Verb::set_event, &LineRun::define},
                    {Verb::on_event, &LineRun::define},
                    {Verb::get_integer, &LineRun::take_bare_number},
                    {Verb::get_real, &LineRun::take_bare_number},
                }));

/// Enters the routine of the next pending event, if there is one.
Error serve_events(Execution& execution, const Program& program, const Options& options) {
  // A line that has received its number from the host runs first. Otherwise, the routine would consume the
  // number.
  if (in_event_routine(execution) || execution.has_number) return Error::none;
  const std::optional<Operand> address = take_event(execution.events);
  if (!address) return Error::none;
  const std::optional<int> line = program.find(*address, options);
  if (!line) return Error::address;
  execution.stack.push_back(
      {.line = execution.line, .of_event = true, .hold = execution.hold, .until_ms = execution.until_ms});
  execution.line = *line;
  execution.hold = Hold::nothing;
  execution.until_ms = 0;
  return Error::none;
}

/// Reads a number that has the form and range for GETI or GETR.
Error read_number(std::string_view text, Kind asked, const Options& options, double& number) {
  const std::optional<Operand> read = parse_number(text);
  if (!read) return Error::syntax;
  number = read->number;
  if (asked == Kind::get_integer) {
    if (read->kind != Kind::integer) return Error::syntax;
    return number >= integer_min(options) && number <= kIntegerMax ? Error::none : Error::range;
  }
  constexpr double kMax = std::numeric_limits<float>::max();
  number = rounded_real(number);
  return number >= -kMax && number <= kMax ? Error::none : Error::range;
}

/// Returns the first tick after `done_ms` in which a line may do anything or the next event is due.
std::int64_t next_line_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                          const Options& options, const Machine& machine) {
  const std::int64_t next_ms = moment_from(done_ms + 1, line_interval_ms(options));
  const bool is_pending = std::ranges::any_of(execution.events, &Event::pending);
  if (is_pending && !in_event_routine(execution)) return next_ms;

  bool input_holds = false;
  if (execution.hold == Hold::input || execution.hold == Hold::window) {
    if (execution.line >= program.size()) return next_ms;
    const std::optional<Command>& command = program.line(execution.line).parsed.command;
    if (!command) return next_ms;
    const auto condition = static_cast<Condition>(kCommands[static_cast<std::size_t>(command->row)].variant);
    if (test_condition(condition, command->operands, machine, input_holds) != Error::none) return next_ms;
  }
  const auto timed_ms = [&] {
    return moment_from(std::max(execution.until_ms, next_ms), line_interval_ms(options));
  };
  switch (execution.hold) {
    case Hold::nothing: return next_ms;
    case Hold::timer: return timed_ms();
    case Hold::window: return input_holds ? next_ms : timed_ms();
    case Hold::input: return input_holds ? next_ms : kNever;
    case Hold::machine: return kNever;
    case Hold::number: return execution.has_number ? next_ms : kNever;
  }
  return next_ms;
}

/// Starts the routine of an event while no program is running. From the next tick on, the routine is the
/// program.
Error run_lonely_event(Execution& execution, std::int64_t now_ms, const Program& program,
                       const Options& options, const Machine& machine) {
  if (events_need_program(options)) return Error::none;
  if (now_ms % check_interval_ms(options) == 0) {
    const Error error = check_events(execution.events, options, machine);
    if (error != Error::none) return error;
  }
  const std::optional<Operand> address = take_event(execution.events);
  if (!address) return Error::none;
  const std::optional<int> line = program.find(*address, options);
  if (!line) return Error::address;
  Events events = std::move(execution.events);
  execution = {.running = true, .line = *line, .events = std::move(events)};
  return Error::none;
}

}  // namespace

bool in_event_routine(const Execution& execution) {
  return std::ranges::any_of(execution.stack, &Frame::of_event);
}

Error start(Execution& execution, const Program& program, const Operand* address, const Options& options) {
  const Operand first{.kind = Kind::integer, .number = static_cast<double>(first_number(options))};
  const std::optional<int> line = program.find(address == nullptr ? first : *address, options);
  if (!line) return Error::address;
  Events events = std::move(execution.events);
  arm_events(events, options);
  execution = {.running = true, .line = *line, .events = std::move(events)};
  return Error::none;
}

void stop(Execution& execution) {
  if (execution.running) finish(execution, Ending::exited);
}

Error give_number(Execution& execution, const Program& program, std::string_view text,
                  const Options& options) {
  if (!wants_number(execution) || execution.line >= program.size()) return Error::not_allowed;
  const std::optional<Command>& command = program.line(execution.line).parsed.command;
  const std::optional<Kind> asked = command ? asked_of_host(*command) : std::nullopt;
  if (!asked) return Error::not_allowed;
  double number = 0;
  if (const Error error = read_number(text, *asked, options, number); error != Error::none) return error;
  execution.has_number = true;
  execution.number = number;
  return Error::none;
}

Error step(Execution& execution, std::int64_t now_ms, const Program& program, const Options& options,
           Machine& machine) {
  if (!execution.running) return run_lonely_event(execution, now_ms, program, options, machine);
  LineRun line(execution, now_ms, program, options, machine);
  const bool is_lines_turn = now_ms % line_interval_ms(options) == 0;
  // A wait whose time is over ends before an event can restart it.
  if (is_lines_turn && execution.hold == Hold::timer && now_ms >= execution.until_ms) line.next_line();
  if (!execution.running) return Error::none;
  Error event_error = Error::none;
  if (now_ms % check_interval_ms(options) == 0) {
    event_error = check_events(execution.events, options, machine);
  }
  if (is_lines_turn && event_error == Error::none) event_error = serve_events(execution, program, options);
  if (event_error != Error::none && !options.chose(option("failed_line", "is_passed_over"))) {
    return line.fail(event_error);
  }
  if (!is_lines_turn) return event_error;
  for (int i = 0; i < lines_a_tick(options) && execution.running; ++i) {
    if (execution.hold == Hold::timer) break;
    const Error error = line.run();
    if (error != Error::none) return error;
    if (execution.hold != Hold::nothing) break;
  }
  return event_error;
}

std::int64_t next_active_ms(const Execution& execution, std::int64_t done_ms, const Program& program,
                            const Options& options, const Machine& machine) {
  if (!execution.running && events_need_program(options)) return kNever;
  const bool sees_event = would_change(execution.events, machine);
  const std::int64_t check_ms = sees_event ? moment_from(done_ms + 1, check_interval_ms(options)) : kNever;
  if (!execution.running) {
    const bool is_pending = std::ranges::any_of(execution.events, &Event::pending);
    return is_pending ? done_ms + 1 : check_ms;
  }
  return std::min(check_ms, next_line_ms(execution, done_ms, program, options, machine));
}

}  // namespace understudy::interpreter::slim
