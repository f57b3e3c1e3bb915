// The effects of SLIM's commands on the chain, both for typed commands and for those of a program.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/complete_table.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/numbers.h"
#include "emulator/models/slim/output.h"
#include "emulator/models/slim/parameters_set.h"
#include "emulator/models/slim/power.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/rules/transitions.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "emulator/models/slim/transition_tables.h"
#include "emulator/models/slim/variables.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/command_row.h"
#include "interpreter/slim/commands.h"
#include "interpreter/slim/editor.h"
#include "interpreter/slim/events.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/verbs.h"

namespace understudy::emulator::models::slim {

using lang::Verb;

namespace {

Letter letter_of(const lang::Command& command) {
  return static_cast<Letter>(lang::kCommands[static_cast<std::size_t>(command.row)].variant);
}

int variant_of(const lang::Command& command) {
  return lang::kCommands[static_cast<std::size_t>(command.row)].variant;
}

int module_of(const lang::Command& command) { return command.module < 0 ? 0 : command.module; }

// --- how a row is written --------------------------------------------------------------------------

constexpr VerbActions always(Action action, Moves moves = Moves::nothing) { return {action, action, moves}; }
constexpr VerbActions each(Action stored, Action typed) { return {stored, typed}; }
constexpr VerbActions typed_only(Action typed) { return {is_refused, typed}; }
constexpr VerbActions stored_only(Action stored) { return {stored, is_refused}; }

using ActionRow = HandlerRow<Verb, VerbActions>;

/// Program flow commands reach this code only if they are typed and allowed.
constexpr ActionRow of_flow(Verb verb, Action typed = is_refused) {
  if (!lang::is_one_of(lang::kFlowVerbs, verb)) throw "the flow of a program does not carry it out";
  return {verb, typed_only(typed)};
}
constexpr ActionRow of_editor(Verb verb, Action typed) {
  if (!lang::is_one_of(lang::kEditingVerbs, verb)) throw "the editor does not begin with it";
  return {verb, typed_only(typed)};
}

constexpr std::array kCommandVerbs = [] {
  std::array<Verb, lang::kCommands.size()> verbs{};
  std::size_t count = 0;
  // Queries are replaced by a command, which is possible because a key may occur twice.
  for (const lang::CommandRow& row : lang::kCommands) verbs[count++] = row.is_query() ? Verb::home : row.verb;
  return verbs;
}();

/// After a stop, the machine must not start again automatically. Otherwise, DN, or a command that an event
/// has interrupted, would continue with the next move. A line of the program itself may have more to do.
lang::Outcome::Program program_after_stop(const Setup& setup, From from) {
  using Program = lang::Outcome::Program;
  if (setup.chose(option("emergency_stop_program", "ends_also_by_its_own_line"))) return Program::ends;
  if (setup.chose(option("emergency_stop_program", "goes_on"))) return Program::continues;
  switch (outcome_of(ActiveTask::program_runs, Event::stop, from)) {
    case Outcome::ends: return Program::ends;
    case Outcome::ends_after_routine: return Program::forgets_what_it_interrupted;
    case Outcome::decelerates:
    case Outcome::continues_as_before:
    case Outcome::is_dropped:
    case Outcome::stops_at_once:
    case Outcome::continues:
    case Outcome::cannot_be: break;
  }
  return Program::continues;
}

/// Evaluates DN, TpDN and XDN.
bool is_done(const Chain& chain, const lang::Command& command) {
  if (command.verb == Verb::axis_wait_done) return chain.done(chain.assigned(letter_of(command)));
  if (command.module >= 0) return chain.done(command.module);
  for (int m = 0; m < kModules; ++m) {
    if (chain.linked(m) && !chain.done(m)) return false;
  }
  return true;
}

}  // namespace

Error is_refused(Order&) { return Error::not_allowed; }

struct Actions {
  static double amount(const Order& order, std::size_t operand) {
    return order.machine.value(order.command.operands[operand]);
  }
  static std::int32_t whole(const Order& order, std::size_t operand) {
    return static_cast<std::int32_t>(amount(order, operand));
  }
  static int port(const Order& order) { return order.command.operands.front().index; }

  // --- one motor ---

  static Error thrust(Order& order) {
    order.setup.device.warn_not_implemented("FT", "it has no load to push");
    return order.chain.thrust(order.module, whole(order, 0));
  }

  static Error reset(Order& order) {
    const Error error = order.chain.reset(order.module);
    if (error == Error::none)
      order.state.errors[static_cast<std::size_t>(order.module)].present = Error::none;
    return error;
  }

  static constexpr ActionRow kOneMotor[] = {
      {Verb::move_absolute,
       always([](Order& o) { return o.chain.move(o.module, true, amount(o, 0)); }, Moves::its_module)},
      {Verb::move_relative,
       always([](Order& o) { return o.chain.move(o.module, false, amount(o, 0)); }, Moves::its_module)},
      {Verb::jog_forward, always([](Order& o) { return o.chain.jog(o.module, +1); })},
      {Verb::jog_reverse, always([](Order& o) { return o.chain.jog(o.module, -1); })},
      {Verb::jog_stop, always([](Order& o) { return o.chain.jog(o.module, 0); })},
      {Verb::thrust, always(thrust)},
      {Verb::home, always([](Order& o) { return o.chain.home(o.module); }, Moves::its_module)},
      {Verb::set_coordinate, always([](Order& o) { return o.chain.set_coordinate(o.module, amount(o, 0)); })},
      {Verb::servo_on, always([](Order& o) { return o.chain.set_servo(o.module, true); })},
      {Verb::servo_off, always([](Order& o) { return o.chain.set_servo(o.module, false); })},
      {Verb::servo_on_now, always([](Order& o) { return o.chain.set_servo_at_once(o.module, true); })},
      {Verb::servo_off_now, always([](Order& o) { return o.chain.set_servo_at_once(o.module, false); })},
      {Verb::reset, always(reset)},
      {Verb::analog_speed, always([](Order& o) { return o.chain.set_analog_speed(o.module); })},
  };

  // --- outputs ---

  static Error pwm(Order& order) {
    const double unit_hz = order.setup.chose(option("pwm_units", "khz_and_percent")) ? 1000 : 1;
    return order.chain.pwm(order.module, port(order), amount(order, 1) * unit_hz, amount(order, 2));
  }
  template <bool sets>
  static Error arm(Order& order) {
    return order.chain.arm(order.module, variant_of(order.command), port(order), sets, amount(order, 1));
  }

  static constexpr ActionRow kOutputs[] = {
      {Verb::set_port, always([](Order& o) { return o.chain.set_output(o.module, port(o), true); })},
      {Verb::clear_port, always([](Order& o) { return o.chain.set_output(o.module, port(o), false); })},
      {Verb::toggle_port, always([](Order& o) { return o.chain.toggle_output(o.module, port(o)); })},
      {Verb::set_port_now,
       always([](Order& o) { return o.chain.set_output_at_once(o.module, port(o), true); })},
      {Verb::clear_port_now,
       always([](Order& o) { return o.chain.set_output_at_once(o.module, port(o), false); })},
      {Verb::pulse_port,
       always([](Order& o) { return o.chain.pulse_output(o.module, port(o), whole(o, 1)); })},
      {Verb::pwm, always(pwm)},
      {Verb::set_all_ports, always([](Order& o) { return o.chain.set_outputs(o.module, whole(o, 0)); })},
      {Verb::set_port_at, always(arm<true>)},
      {Verb::clear_port_at, always(arm<false>)},
  };

  // --- several motors ---

  static Error map_axis(Order& order) {
    const Error error = assign_axis(order.state, order.setup, letter_of(order.command), whole(order, 0));
    if (error == Error::none && order.setup.chose(option("axis_map_kept", "yes"))) keep_axis_map(order.state);
    return error;
  }
  template <bool absolute>
  static Error line(Order& order) {
    std::array<double, kLetters> units{};
    const std::size_t count = order.command.operands.size();
    for (std::size_t i = 0; i < count; ++i) units[i] = amount(order, i);
    return order.chain.line(std::span(units).first(count), absolute);
  }
  template <bool absolute, bool rises>
  static Error arc(Order& order) {
    ArcOrder what{.absolute = absolute,
                  .centre_x_units = amount(order, 0),
                  .centre_y_units = amount(order, 1),
                  .sweep_deg = amount(order, 2)};
    if (rises) what.height_units = amount(order, 3);
    if (absolute && !rises && order.setup.chose(option("arc", "end_point_and_radius")))
      what.radius_units = amount(order, 2);
    return order.chain.arc(what);
  }
  static Error spiral(Order& order) {
    return order.chain.spiral(amount(order, 0), amount(order, 1), amount(order, 2), amount(order, 3));
  }
  template <bool absolute>
  static Error move_axis(Order& order) {
    return order.chain.move_axis(letter_of(order.command), absolute, amount(order, 0));
  }

  static constexpr ActionRow kSeveralMotors[] = {
      {Verb::map_axis, always(map_axis)},
      {Verb::line_absolute, always(line<true>, Moves::a_letter_each)},
      {Verb::line_relative, always(line<false>, Moves::a_letter_each)},
      {Verb::arc_absolute, always(arc<true, false>, Moves::x_and_y)},
      {Verb::arc_relative, always(arc<false, false>, Moves::x_and_y)},
      {Verb::helix_absolute, always(arc<true, true>, Moves::x_y_and_z)},
      {Verb::helix_relative, always(arc<false, true>, Moves::x_y_and_z)},
      {Verb::spiral, always(spiral, Moves::x_and_y)},
      {Verb::axis_move_absolute, always(move_axis<true>, Moves::its_letter)},
      {Verb::axis_move_relative, always(move_axis<false>, Moves::its_letter)},
      {Verb::continuous_path,
       always([](Order& o) { return o.chain.set_continuous_path(variant_of(o.command)); })},
  };

  // --- the whole chain ---

  static Error stop_from_program(Order& order) {
    note_tasks(order.state, Event::stop);
    const bool in_routine = in_event_routine(order.state.execution);
    order.outcome.program = program_after_stop(order.setup, in_routine ? From::event_routine : From::program);
    order.chain.emergency_stop();
    return Error::none;
  }
  static Error stop_from_host(Order& order) {
    note_tasks(order.state, Event::stop);
    const bool ends = program_after_stop(order.setup, From::host) == lang::Outcome::Program::ends;
    if (ends) stop(order.state.execution);
    return order.chain.emergency_stop();
  }

  static constexpr ActionRow kWholeChain[] = {
      {Verb::pause, always([](Order& o) {
         note_tasks(o.state, Event::pause_q);
         return o.chain.pause_queues();
       })},
      {Verb::redo, always([](Order& o) {
         if (o.chain.queues_paused()) note_tasks(o.state, Event::resume_q);
         return o.chain.resume_queues();
       })},
      {Verb::clear_buffer, always([](Order& o) { return o.chain.clear_queues(); })},
      {Verb::pause_all, always([](Order& o) {
         note_tasks(o.state, Event::pause);
         return o.chain.pause();
       })},
      {Verb::resume_all, always([](Order& o) {
         if (o.chain.paused()) note_tasks(o.state, Event::resume);
         return o.chain.resume();
       })},
      {Verb::abandon_all, always([](Order& o) {
         if (o.chain.paused()) note_tasks(o.state, Event::give_up);
         return o.chain.discard();
       })},
      {Verb::stop_all, each(stop_from_program, stop_from_host)},
  };

  // --- numbers, parameters, memory ---

  static Error set_parameter(Order& order) {
    const lang::Command& command = order.command;
    if (command.name == "TM" && order.setup.chose(option("clock_assignment", "the_variable")) &&
        is_variable(command.operands[0].kind)) {
      return set_variable(order.state, order.setup, command.operands[0],
                          static_cast<double>(clock_s(order.state, order.setup)));
    }
    return slim::set_parameter(order.state, order.setup, order.module, command.name, amount(order, 0));
  }
  static std::string printed(const Order& order) {
    const lang::Operand& what = order.command.operands.front();
    if (what.kind == lang::Operand::Kind::text) return what.text;
    const double value = order.machine.value(what);
    const bool is_integer = holds_integer(what.kind) || what.kind == lang::Operand::Kind::integer;
    return is_integer ? text_of_integer(value) : text_of_real(value, order.setup.real_form());
  }
  /// A program is much faster than its line, so it waits until there is room.
  static Error print_from_program(Order& order) {
    order.outcome.waits = !has_room_to_print(order.state, order.setup);
    if (!order.outcome.waits) send_line(order.state, order.setup, printed(order));
    return Error::none;
  }
  static Error print_from_host(Order& order) {
    order.lines.push_back(printed(order));
    return Error::none;
  }
  static Error list_from_program(Order& order) {
    for (const std::string& line : parameter_list(order.state, order.setup)) {
      send_line(order.state, order.setup, line);
    }
    return Error::none;
  }
  static Error list_from_host(Order& order) {
    order.lines = parameter_list(order.state, order.setup);
    return Error::none;
  }
  template <void (*does)(State&)>
  static Error done(Order& order) {
    does(order.state);
    return Error::none;
  }
  static Error reboot(Order& order) {
    slim::reboot(order.state, order.setup);
    return Error::none;
  }

  static constexpr ActionRow kMemory[] = {
      {Verb::set_variable,
       always([](Order& o) { return set_variable(o.state, o.setup, o.command.operands[0], amount(o, 1)); })},
      {Verb::set_parameter, always(set_parameter)},
      {Verb::set_path_speed,
       always([](Order& o) { return slim::set_parameter(o.state, o.setup, 0, "TVM", amount(o, 0)); })},
      {Verb::default_parameters,
       always([](Order& o) { return restore_factory_parameters(o.state, o.setup); })},
      {Verb::save_data, always(done<keep_data>)},
      {Verb::save_parameters, always(done<keep_parameters>)},
      {Verb::save_program, always(done<keep_program>)},
      {Verb::reboot, always(reboot)},
      {Verb::list_parameters, each(list_from_program, list_from_host)},
      {Verb::print, each(print_from_program, print_from_host)},
  };

  // --- programs ---

  static Error wait_done(Order& order) {
    order.outcome.waits = !is_done(order.chain, order.command);
    return Error::none;
  }
  static Error wait_axis_done(Order& order) {
    if (order.chain.assigned(letter_of(order.command)) == kUnassigned) return Error::axis;
    return wait_done(order);
  }
  static Error run(Order& order) {
    State& state = order.state;
    const auto& operands = order.command.operands;
    return start(state.execution, state.program, operands.empty() ? nullptr : operands.data(),
                 order.setup.language);
  }
  static Error define(Order& order) {
    define_event(order.state.execution.events, order.command, order.setup.language);
    return Error::none;
  }
  static Error edit(Order& order) {
    State& state = order.state;
    return begin_edit(state.editor, state.program, order.command, order.setup.language);
  }

  static constexpr ActionRow kPrograms[] = {
      {Verb::wait_done, stored_only(wait_done)},
      {Verb::axis_wait_done, stored_only(wait_axis_done)},
      {Verb::run, typed_only(run)},
      {Verb::exit, typed_only([](Order& o) {
         stop(o.state.execution);
         return Error::none;
       })},
      {Verb::program_list, typed_only([](Order& o) {
         o.lines = o.state.program.listing(o.setup.language);
         return Error::none;
       })},
      {Verb::upload, typed_only([](Order& o) {
         o.lines = o.state.program.upload();
         return Error::none;
       })},
      of_editor(Verb::program_new, edit),
      of_editor(Verb::program_append, edit),
      of_editor(Verb::program_edit, edit),
      of_editor(Verb::program_insert, edit),
      of_editor(Verb::program_delete, edit),
      of_editor(Verb::download, edit),
      of_flow(Verb::set_event, define),
      of_flow(Verb::on_event, define),
      of_flow(Verb::jump),
      of_flow(Verb::jump_if),
      of_flow(Verb::jump_if_within),
      of_flow(Verb::call),
      of_flow(Verb::return_),
      of_flow(Verb::wait_input),
      of_flow(Verb::wait_time),
      of_flow(Verb::get_integer),
      of_flow(Verb::get_real),
  };

  static const CompleteTable<Verb, VerbActions> kTable;
};

constexpr CompleteTable<Verb, VerbActions> Actions::kTable(kCommandVerbs, kOneMotor, kOutputs, kSeveralMotors,
                                                           kWholeChain, kMemory, kPrograms);

const VerbActions& actions_of(Verb verb) { return Actions::kTable[verb]; }

Order order_of(State& state, const Setup& setup, const lang::Machine& machine, const lang::Command& command) {
  return {.state = state,
          .setup = setup,
          .machine = machine,
          .chain = state.chain,
          .command = command,
          .module = module_of(command)};
}

Error perform(Order& order, Action action) {
  const Error error = linked(order.state, order.module);
  return error == Error::none ? action(order) : error;
}

lang::Outcome perform_stored(Order& order) {
  const Error error = perform(order, actions_of(order.command.verb).stored);
  if (order.setup.is_silence(error)) return lang::kDone;
  const bool waits_for_pause =
      error == Error::paused && !order.setup.chose(option("pause_in_program", "error_6"));
  if (error == Error::buffer_full || waits_for_pause) return lang::kWaits;
  return error == Error::none ? order.outcome : lang::failed(error);
}

bool would_wait(const State& state, const lang::Command& command) {
  const Chain& chain = state.chain;
  if (chain.paused()) return false;
  const auto letter_is_busy = [&](Letter letter) {
    const int module = chain.assigned(letter);
    return module != kUnassigned && chain.busy(module);
  };
  std::size_t letters = 0;
  switch (actions_of(command.verb).moves) {
    case Moves::nothing: return false;
    case Moves::its_module: return chain.linked(module_of(command)) && chain.busy(module_of(command));
    case Moves::its_letter: return letter_is_busy(letter_of(command));
    case Moves::x_and_y: letters = 2; break;
    case Moves::x_y_and_z: letters = 3; break;
    case Moves::a_letter_each: letters = command.operands.size(); break;
  }
  bool busy = false;
  for (std::size_t i = 0; i < letters; ++i) {
    if (chain.assigned(static_cast<Letter>(i)) == kUnassigned) return false;
    busy = busy || letter_is_busy(static_cast<Letter>(i));
  }
  return busy;
}

}  // namespace understudy::emulator::models::slim
