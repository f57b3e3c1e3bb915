// What SLIM's commands do to the chain, for typed ones and a program's alike.
#include <array>

#include "emulator/models/slim/device.h"

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

}  // namespace

Error Slim::linked(int module) const { return state_.chain.linked(module) ? Error::none : Error::not_linked; }

bool Slim::input(int number) const { return ((state_.inputs[0] >> (number - 1)) & 1) != 0; }

/// A program waits where a host is refused: for room in a buffer, and (unless chosen otherwise) for the end
/// of a pause.
lang::Outcome Slim::carry_out(const lang::Command& command) {
  switch (command.verb) {
    case Verb::wait_done:
    case Verb::axis_wait_done:
      if (const Error error = linked(module_of(command)); error != Error::none) {
        return is_silence(error) ? lang::kDone : lang::failed(error);
      }
      if (command.verb == Verb::axis_wait_done && state_.chain.assigned(letter_of(command)) == kUnassigned) {
        return lang::failed(Error::axis);
      }
      return is_done(command) ? lang::kDone : lang::kWaits;
    case Verb::print: {
      // A program is much faster than its line: it prints when there is room again.
      if (!has_room_to_speak()) return lang::kWaits;
      const lang::Operand& what = command.operands.front();
      say(what.kind == lang::Operand::Kind::text ? what.text : text_of(what));
      return lang::kDone;
    }
    default: break;
  }
  const Error error = execute(command);
  if (command.verb == Verb::stop_all) {
    return {.program =
                program_after_stop(in_event_routine(state_.execution) ? From::event_routine : From::program)};
  }
  if (is_silence(error)) return lang::kDone;
  const bool waits_for_pause = error == Error::paused && !chose(kPauseFailsMotion);
  if (error == Error::buffer_full || waits_for_pause) return lang::kWaits;
  if (error != Error::none) failed_module_ = module_of(command);
  return {.error = error};
}

/// A machine that has been stopped must not start again by itself: DN, or what an event has interrupted,
/// would go on with the next move. A line of the program's own may have more to say.
lang::Outcome::Program Slim::program_after_stop(From from) const {
  using Program = lang::Outcome::Program;
  if (chose(kStopEndsAnyProgram)) return Program::ends;
  if (chose(kStopLeavesProgram)) return Program::goes_on;
  switch (outcome_of(Doing::program_runs, Meeting::stop, from)) {
    case Outcome::ends: return Program::ends;
    case Outcome::ends_after_routine: return Program::forgets_what_it_interrupted;
    default: return Program::goes_on;
  }
}

bool Slim::is_done(const lang::Command& command) const {
  const Chain& chain = state_.chain;
  if (command.verb == Verb::axis_wait_done) return chain.done(chain.assigned(letter_of(command)));
  if (command.module >= 0) return chain.done(command.module);
  for (int m = 0; m < kModules; ++m) {
    if (chain.linked(m) && !chain.done(m)) return false;
  }
  return true;
}

/// Whether it is a move of a module that is busy. What is refused for another reason is none.
bool Slim::would_wait(const lang::Command& command) const {
  const Chain& chain = state_.chain;
  if (chain.paused()) return false;
  const auto letter_is_busy = [&](Letter letter) {
    const int module = chain.assigned(letter);
    return module != kUnassigned && chain.busy(module);
  };
  std::size_t letters = 2;
  switch (command.verb) {
    case Verb::move_absolute:
    case Verb::move_relative:
    case Verb::home: return chain.linked(module_of(command)) && chain.busy(module_of(command));
    case Verb::axis_move_absolute:
    case Verb::axis_move_relative: return letter_is_busy(letter_of(command));
    case Verb::line_absolute:
    case Verb::line_relative: letters = command.operands.size(); break;
    case Verb::helix_absolute:
    case Verb::helix_relative: letters = 3; break;
    case Verb::arc_absolute:
    case Verb::arc_relative:
    case Verb::spiral: break;
    default: return false;
  }
  bool busy = false;
  for (std::size_t i = 0; i < letters; ++i) {
    if (chain.assigned(static_cast<Letter>(i)) == kUnassigned) return false;
    busy = busy || letter_is_busy(static_cast<Letter>(i));
  }
  return busy;
}

Error Slim::execute(const lang::Command& command) {
  const int module = module_of(command);
  if (const Error error = linked(module); error != Error::none) return error;
  switch (command.verb) {
    case Verb::move_absolute:
    case Verb::move_relative:
    case Verb::jog_forward:
    case Verb::jog_reverse:
    case Verb::jog_stop:
    case Verb::thrust:
    case Verb::home:
    case Verb::set_coordinate:
    case Verb::servo_on:
    case Verb::servo_off:
    case Verb::servo_on_now:
    case Verb::servo_off_now:
    case Verb::reset:
    case Verb::analog_speed: return move_one(command, module);

    case Verb::set_port:
    case Verb::clear_port:
    case Verb::toggle_port:
    case Verb::pulse_port:
    case Verb::set_all_ports:
    case Verb::set_port_now:
    case Verb::clear_port_now:
    case Verb::pwm:
    case Verb::set_port_at:
    case Verb::clear_port_at: return switch_outputs(command, module);

    case Verb::map_axis:
    case Verb::line_absolute:
    case Verb::line_relative:
    case Verb::arc_absolute:
    case Verb::arc_relative:
    case Verb::helix_absolute:
    case Verb::helix_relative:
    case Verb::spiral:
    case Verb::axis_move_absolute:
    case Verb::axis_move_relative:
    case Verb::continuous_path: return move_several(command);

    case Verb::pause:
    case Verb::redo:
    case Verb::clear_buffer:
    case Verb::pause_all:
    case Verb::resume_all:
    case Verb::abandon_all:
    case Verb::stop_all: return control_all(command);

    case Verb::set_variable: {
      const lang::Operand& variable = command.operands[0];
      return set_variable(variable, amount(command, 1));
    }
    case Verb::set_parameter:
      if (command.name == "TM" && chose(kVariableReceivesClock) && is_variable(command.operands[0].kind)) {
        return set_variable(command.operands[0], static_cast<double>(clock_s()));
      }
      return set_parameter(module, command.name, amount(command, 0));
    case Verb::set_path_speed: return set_parameter(0, "TVM", amount(command, 0));
    case Verb::default_parameters: return restore_factory_parameters();
    case Verb::save_data: keep_data(); return Error::none;
    case Verb::save_parameters: keep_parameters(); return Error::none;
    case Verb::save_program: keep_program(); return Error::none;
    case Verb::list_parameters:
      for (const std::string& line : parameter_list()) say(line);
      return Error::none;
    case Verb::reboot: reboot(); return Error::none;
    default: return Error::not_allowed;
  }
}

Error Slim::move_one(const lang::Command& command, int module) {
  Chain& chain = state_.chain;
  switch (command.verb) {
    case Verb::move_absolute: return chain.move(module, true, amount(command, 0));
    case Verb::move_relative: return chain.move(module, false, amount(command, 0));
    case Verb::jog_forward: return chain.jog(module, +1);
    case Verb::jog_reverse: return chain.jog(module, -1);
    case Verb::jog_stop: return chain.jog(module, 0);
    case Verb::thrust:
      mention_unmodelled("FT", "it pushes without a load");
      return chain.thrust(module, static_cast<std::int32_t>(amount(command, 0)));
    case Verb::home: return chain.home(module);
    case Verb::set_coordinate: return chain.set_coordinate(module, amount(command, 0));
    case Verb::servo_on: return chain.set_servo(module, true);
    case Verb::servo_off: return chain.set_servo(module, false);
    case Verb::servo_on_now: return chain.set_servo_at_once(module, true);
    case Verb::servo_off_now: return chain.set_servo_at_once(module, false);
    case Verb::analog_speed: return chain.set_analog_speed(module);
    default: break;
  }
  const Error error = chain.reset(module);  // RESET
  if (error == Error::none) state_.errors[static_cast<std::size_t>(module)].present = Error::none;
  return error;
}

Error Slim::switch_outputs(const lang::Command& command, int module) {
  Chain& chain = state_.chain;
  const auto port = [&] { return command.operands.front().index; };
  switch (command.verb) {
    case Verb::set_port: return chain.set_output(module, port(), true);
    case Verb::clear_port: return chain.set_output(module, port(), false);
    case Verb::toggle_port: return chain.toggle_output(module, port());
    case Verb::set_port_now: return chain.set_output_at_once(module, port(), true);
    case Verb::clear_port_now: return chain.set_output_at_once(module, port(), false);
    case Verb::pulse_port:
      return chain.pulse_output(module, port(), static_cast<std::int32_t>(amount(command, 1)));
    case Verb::pwm: {
      const double unit_hz = chose(kPwmInKilohertz) ? 1000 : 1;
      return chain.pwm(module, port(), amount(command, 1) * unit_hz, amount(command, 2));
    }
    case Verb::set_all_ports: return chain.set_outputs(module, static_cast<int>(amount(command, 0)));
    default: break;
  }
  return chain.arm(module, variant_of(command), port(), command.verb == Verb::set_port_at,
                   amount(command, 1));
}

Error Slim::move_several(const lang::Command& command) {
  Chain& chain = state_.chain;
  const auto arc = [&](bool absolute, bool rises) {
    ArcOrder order{.absolute = absolute,
                   .centre_x_units = amount(command, 0),
                   .centre_y_units = amount(command, 1),
                   .sweep_deg = amount(command, 2)};
    if (rises) order.height_units = amount(command, 3);
    if (absolute && !rises && chose(kArcsByRadius)) order.radius_units = amount(command, 2);
    return chain.arc(order);
  };
  switch (command.verb) {
    case Verb::map_axis: {
      const Error error = assign_axis(letter_of(command), static_cast<int>(amount(command, 0)));
      if (error == Error::none && chose(kMapIsPn37)) keep_axis_map();
      return error;
    }
    case Verb::line_absolute:
    case Verb::line_relative: {
      std::array<double, kLetters> units{};
      const std::size_t count = command.operands.size();
      for (std::size_t i = 0; i < count; ++i) units[i] = amount(command, i);
      return chain.line(std::span(units).first(count), command.verb == Verb::line_absolute);
    }
    case Verb::arc_absolute: return arc(true, false);
    case Verb::arc_relative: return arc(false, false);
    case Verb::helix_absolute: return arc(true, true);
    case Verb::helix_relative: return arc(false, true);
    case Verb::spiral:
      return chain.spiral(amount(command, 0), amount(command, 1), amount(command, 2), amount(command, 3));
    case Verb::axis_move_absolute: return chain.move_axis(letter_of(command), true, amount(command, 0));
    case Verb::axis_move_relative: return chain.move_axis(letter_of(command), false, amount(command, 0));
    default: break;
  }
  return chain.set_continuous_path(variant_of(command));
}

/// TX= ..., and what PN37 says at power-up.
Error Slim::assign_axis(Letter letter, int module) {
  for (const Letter other : {Letter::x, Letter::y, Letter::z, Letter::w}) {
    const bool has_it = module != kUnassigned && state_.chain.assigned(other) == module;
    if (chose(kModuleTakenFromLetter) && has_it) state_.chain.assign(other, kUnassigned);
  }
  return state_.chain.assign(letter, module);
}

Error Slim::control_all(const lang::Command& command) {
  Chain& chain = state_.chain;
  switch (command.verb) {
    case Verb::pause: return chain.pause_queues();
    case Verb::redo: return chain.resume_queues();
    case Verb::clear_buffer: return chain.clear_queues();
    case Verb::pause_all: return chain.pause();
    case Verb::resume_all: return chain.resume();
    case Verb::abandon_all: return chain.discard();
    default: return chain.emergency_stop();
  }
}

}  // namespace understudy::emulator::models::slim
