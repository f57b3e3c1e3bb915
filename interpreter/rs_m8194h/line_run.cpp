#include "interpreter/rs_m8194h/line_run.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/complete_table.h"
#include "base/program_watch.h"
#include "interpreter/rs_m8194h/command.h"
#include "interpreter/rs_m8194h/command_row.h"
#include "interpreter/rs_m8194h/commands.h"
#include "interpreter/rs_m8194h/faults.h"
#include "interpreter/rs_m8194h/machine.h"
#include "interpreter/rs_m8194h/macro.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/resolve.h"
#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/verbs.h"

namespace understudy::interpreter::rs_m8194h {
namespace {

/// Packs the input and level that FRNET_WAIT awaits into one number.
constexpr std::uint32_t packed(std::uint32_t group, std::uint32_t channel, std::uint32_t level) {
  return (level << 16U) | (group << 8U) | channel;
}

/// Executes one line of a run.
class LineRun {
 public:
  LineRun(Execution& execution, Run& run, std::int64_t now_ms, const Options& options, Machine& machine)
      : execution_(execution), run_(run), now_ms_(now_ms), options_(options), machine_(machine) {}

  Ran run() {
    const Macro& macro = *machine_.macro(name_of_level(run_, level()));
    const Command& command = macro.lines[level().line];
    leads_to_ = macro.leads_to[level().line];
    if (machine_.watch() != nullptr) begin();
    run_.hold = Hold::nothing;
    const Action action = kActions[command.verb()];
    return action != nullptr ? (this->*action)(command) : carry_out(command);
  }

 private:
  Level& level() { return run_.levels.back(); }
  /// Notifies the observer that the line begins, unless the line is being repeated because the machine made
  /// it wait.
  void begin() {
    watched_part_ = part_of(name_of_level(run_, level()));
    watched_line_ = level().line;
    if (run_.hold != Hold::machine) machine_.watch()->runs(watched_part_, watched_line_, 1);
  }
  bool decide(bool outcome) const {
    if (ProgramWatch* const watch = machine_.watch()) {
      watch->decides(watched_part_, watched_line_, outcome, 1);
    }
    return outcome;
  }
  Ran go_to(std::size_t line) {
    level().line = static_cast<std::uint16_t>(line);
    return Ran::on;
  }
  Ran next_line() { return go_to(level().line + std::size_t{1}); }
  /// Completes the line. From now on, the run checks whether the wait has ended.
  Ran wait(Hold what, std::int64_t until_ms, std::uint32_t awaited = 0) {
    next_line();
    hold(run_, what, until_ms, awaited);
    const bool is_over_at_once = is_over(run_, now_ms_, options_, machine_);
    if (what != Hold::timer) decide(is_over_at_once);
    if (!is_over_at_once) return Ran::waits;
    run_.hold = Hold::nothing;
    return Ran::on;
  }
  Ran fail(const Command& command, Fault fault) {
    machine_.report({name_of_level(run_, level()), command.code, level().line, fault});
    return next_line();
  }
  std::int32_t value(std::uint32_t operand) const { return value_of(operand, machine_); }
  ReturnRegister& return_register() {
    return run_.is_isr && !options_.chose(option("return_registers", "one_for_both")) ? execution_.isr_return
                                                                                      : execution_.mp_return;
  }

  // --- numbers ---------------------------------------------------------------------------------

  Ran set_var(const Command& command) {
    machine_.set_variable(variable_number(command.values[0]), value(command.values[1]));
    return next_line();
  }

  Ran set_rvar(const Command& command) {
    ReturnRegister& returned = return_register();
    if (options_.chose(option("return_register_keeps", "execution_error")) && !returned.is_full)
      return fail(command, Fault::operand);
    machine_.set_variable(variable_number(command.values[0]), returned.value);
    if (options_.chose(option("return_register_keeps", "execution_error"))) returned = {};
    return next_line();
  }

  Ran var_calculate(const Command& command) {
    const auto arithmetic = static_cast<char>(command.values[1]);
    const std::int32_t right = value(command.values[2]);
    const std::size_t result = variable_number(command.values[3]);
    const bool is_defined = arithmetic != '/' || right != 0;
    if (is_defined) {
      const std::int64_t exact = calculate_exactly(arithmetic, value(command.values[0]), right);
      machine_.set_variable(result, options_.chose(option("calculation_overflow", "stays_at_the_end"))
                                        ? nearest_of_32_bits(exact)
                                        : static_cast<std::int32_t>(exact));
      return next_line();
    }
    if (!options_.chose(option("division_by_zero", "stays_as_it_was"))) machine_.set_variable(result, 0);
    return fail(command, Fault::operand);
  }

  Ran read(const Command& command) {
    Command resolved = command;
    if (resolve(resolved, machine_, options_) != Fault::none) return fail(command, Fault::operand);
    const bool is_returned = command.verb() != Verb::get_di_signal_all ||
                             !options_.chose(option("rvar_of_di_signal_all", "is_not_stored"));
    if (is_returned) return_register() = {machine_.read(resolved), true};
    return next_line();
  }

  // --- blocks ----------------------------------------------------------------------------------

  Ran begin_for(const Command& command) {
    std::int32_t passes = value(command.values[0]);
    if (options_.chose(option("for_below_1", "one_pass"))) passes = std::max(passes, 1);
    if (!decide(passes > 0)) return go_to(leads_to_);
    level().loops.push_back({level().line, passes});
    return next_line();
  }

  std::int32_t count_down(std::size_t variable) {
    const auto left = static_cast<std::int32_t>(calculate_exactly('-', machine_.variable(variable), 1));
    machine_.set_variable(variable, left);
    return left;
  }

  Ran next(const Command&) {
    Loop& loop = level().loops.back();
    const Macro& macro = *machine_.macro(name_of_level(run_, level()));
    const std::uint32_t count = macro.lines[loop.line].values[0];
    if (is_variable(count)) {
      loop.left = count_down(variable_number(count));
    } else {
      --loop.left;
    }
    if (decide(loop.left > 0)) return go_to(leads_to_);
    level().loops.pop_back();
    return next_line();
  }

  Ran exit_for(const Command&) {
    const Macro& macro = *machine_.macro(name_of_level(run_, level()));
    const std::uint32_t count = macro.lines[level().loops.back().line].values[0];
    if (options_.chose(option("exit_for_counter", "counts_this_pass_too")) && is_variable(count))
      count_down(variable_number(count));
    level().loops.pop_back();
    return go_to(leads_to_);
  }

  Ran if_(const Command& command) {
    const ComparisonRow* row = find_comparison(command.values[1]);
    const bool is_true = holds(row->comparison, value(command.values[0]), value(command.values[2]));
    return decide(is_true) ? next_line() : go_to(leads_to_);
  }

  Ran skip(const Command&) { return go_to(leads_to_); }

  /// Labels are outside of all blocks.
  Ran go_to_label(const Command&) {
    level().loops.clear();
    return go_to(leads_to_);
  }

  // --- waits, calls, ends ----------------------------------------------------------------------

  Ran timer(const Command& command) {
    const std::int32_t time_ms = value(command.values[0]);
    if (time_ms < 0 && options_.chose(option("timer_negative", "execution_error")))
      return fail(command, Fault::operand);
    return wait(Hold::timer, now_ms_ + std::max(time_ms, 0));
  }

  Ran stop_wait(const Command& command) {
    const bool passes = run_.is_isr && options_.chose(option("isr_waits", "are_passed_over"));
    return passes && decide(true) ? next_line() : wait(Hold::axes, 0, command.values[0]);
  }

  Ran frnet_wait(const Command& command) {
    Command resolved = command;
    const bool has_variable = is_variable(command.values[3]);
    if (has_variable) {
      const std::int32_t time_ms = value(command.values[3]);
      if (time_ms < 0 && options_.chose(option("timer_negative", "execution_error")))
        return fail(command, Fault::operand);
      resolved.values[3] = static_cast<std::uint32_t>(std::max(time_ms, 0));
    }
    if (resolve(resolved, machine_, options_) != Fault::none) return fail(command, Fault::operand);
    if (run_.is_isr && options_.chose(option("isr_waits", "are_passed_over")) && decide(true))
      return next_line();
    const std::int64_t until_ms =
        resolved.values[3] == 0 ? kNever : now_ms_ + std::int64_t{resolved.values[3]};
    return wait(Hold::frnet, until_ms, packed(resolved.values[0], resolved.values[1], resolved.values[2]));
  }

  Ran call(const Command& command) {
    const int deepest = kDeepest + (options_.chose(option("call_levels", "of_calls_alone")) ? 1 : 0);
    if (run_.levels.size() == static_cast<std::size_t>(deepest)) {
      if (!options_.chose(option("call_too_deep", "ends_the_macro")))
        return fail(command, Fault::undefined_command);
      fail(command, Fault::undefined_command);
      return exit_macro(command);
    }
    if (options_.chose(option("missing_macro", "execution_error")) &&
        !has_lines({false, static_cast<int>(command.values[0])}, machine_)) {
      return fail(command, Fault::undefined_command);
    }
    next_line();
    run_.levels.push_back({.number = static_cast<std::uint8_t>(command.values[0])});
    return Ran::on;
  }

  Ran exit_macro(const Command&) {
    level().loops.clear();
    level().line = UINT16_MAX;  // beyond the end of any macro
    return Ran::on;
  }

  Ran end_all(const Command&) {
    terminate(execution_);
    machine_.terminated();
    return Ran::all_ended;
  }

  Ran carry_out(const Command& command) {
    Command resolved = command;
    if (resolve(resolved, machine_, options_) != Fault::none) return fail(command, Fault::operand);
    const bool waits = machine_.carry_out(resolved) == Took::waits;
    if (waits && !(run_.is_isr && options_.chose(option("isr_waits", "are_passed_over")))) {
      hold(run_, Hold::machine);
      return Ran::waits;
    }
    return next_line();
  }

  /// The lines that the interpreter executes itself.
  using Action = Ran (LineRun::*)(const Command&);
  static const CompleteTable<Verb, Action> kActions;

  Execution& execution_;
  Run& run_;
  std::int64_t now_ms_;
  const Options& options_;
  Machine& machine_;
  std::size_t leads_to_ = 0;
  int watched_part_ = 0;  // set only if there is an observer
  int watched_line_ = 0;
};

constexpr CompleteTable<Verb, LineRun::Action> LineRun::kActions(
    [] {
      std::array<Verb, kFlowVerbs.size() + kReadVerbs.size()> verbs{};
      std::ranges::copy(kReadVerbs, std::ranges::copy(kFlowVerbs, verbs.begin()).out);
      return verbs;
    }(),
    std::to_array<HandlerRow<Verb, LineRun::Action>>({
        {Verb::set_var, &LineRun::set_var},
        {Verb::set_rvar, &LineRun::set_rvar},
        {Verb::var_calculate, &LineRun::var_calculate},
        {Verb::for_, &LineRun::begin_for},
        {Verb::next, &LineRun::next},
        {Verb::exit_for, &LineRun::exit_for},
        {Verb::if_, &LineRun::if_},
        {Verb::else_, &LineRun::skip},
        {Verb::end_if, &LineRun::skip},
        {Verb::goto_, &LineRun::go_to_label},
        {Verb::label, &LineRun::skip},
        {Verb::timer, &LineRun::timer},
        {Verb::mp_call, &LineRun::call},
        {Verb::stop_wait, &LineRun::stop_wait},
        {Verb::exit_macro, &LineRun::exit_macro},
        {Verb::frnet_wait, &LineRun::frnet_wait},
        {Verb::mp_terminate, &LineRun::end_all},
    }),
    [] {
      std::array<HandlerRow<Verb, LineRun::Action>, kReadVerbs.size()> rows{};
      std::ranges::transform(kReadVerbs, rows.begin(), [](Verb verb) {
        return HandlerRow<Verb, LineRun::Action>{verb, &LineRun::read};
      });
      return rows;
    }());

}  // namespace

MacroName name_of_level(const Run& run, const Level& level) { return {run.is_isr, level.number}; }

void hold(Run& run, Hold what, std::int64_t until_ms, std::uint32_t awaited) {
  run.hold = what;
  run.until_ms = until_ms;
  run.awaited = awaited;
  run.saw_other_level = false;
}

bool is_over(Run& run, std::int64_t now_ms, const Options& options, Machine& machine) {
  switch (run.hold) {
    case Hold::nothing:
    case Hold::machine: return true;
    case Hold::begin:
    case Hold::timer: return now_ms >= run.until_ms;
    case Hold::axes: return machine.stand(run.awaited);
    case Hold::frnet: {
      const bool is_on = machine.frnet_input(run.awaited >> 8U & 0xFFU, run.awaited & 0xFFU);
      const bool is_present = is_on == (run.awaited >> 16U != 0);
      if (!is_present) run.saw_other_level = true;
      if (is_present &&
          (run.saw_other_level || !options.chose(option("frnet_wait_level", "waits_for_the_change"))))
        return true;
      if (run.until_ms == kNever || now_ms < run.until_ms) return false;
      if (options.chose(option("frnet_wait_timeout", "execution_error"))) {
        const Level& level = run.levels.back();  // already points to the next line
        machine.report({name_of_level(run, level), macro_code(Verb::frnet_wait),
                        static_cast<std::uint16_t>(level.line - 1), Fault::operand});
      }
      return true;
    }
  }
  return true;
}

bool is_frnet_input(std::uint32_t awaited) {
  const std::uint32_t group = awaited >> 8U & 0xFFU;
  return group >= 8 && group <= 15 && (awaited & 0xFFU) <= 15 && awaited >> 16U <= 1;
}

Ran run_next_line(Execution& execution, Run& run, std::int64_t now_ms, const Options& options,
                  Machine& machine) {
  return LineRun(execution, run, now_ms, options, machine).run();
}

}  // namespace understudy::interpreter::rs_m8194h
