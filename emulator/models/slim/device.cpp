#include "emulator/models/slim/device.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/simulated_time.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/memory/persistent_memory.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/device/stateful_device.h"
#include "emulator/models/slim/actions.h"
#include "emulator/models/slim/by_name.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/dialogue.h"
#include "emulator/models/slim/error_log.h"
#include "emulator/models/slim/error_words.h"
#include "emulator/models/slim/model.h"
#include "emulator/models/slim/output.h"
#include "emulator/models/slim/parameters_set.h"
#include "emulator/models/slim/power.h"
#include "emulator/models/slim/program_text.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "emulator/models/slim/setup.h"
#include "emulator/models/slim/state.h"
#include "emulator/models/slim/variables.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/machine.h"
#include "interpreter/slim/options.h"

namespace understudy::emulator::models::slim {

Slim::Slim(const DeviceSettings& settings)
    : StatefulDevice(slim::model(), settings),
      PersistentMemory(slim::model().name, settings.firmware),
      setup_(*this) {
  state_.kept = setup_.factory();
  state_.ram = state_.kept;
  state_.chain.set_options(setup_.options);
}

void Slim::wake() {
  state_.chain.skip_to(now());
  state_.touched = true;
}

// --- the dialogue ----------------------------------------------------------------------------------

TextRules Slim::text_rules() const { return slim::text_rules(setup_); }

void Slim::receive_line(std::string_view line) {
  wake();
  slim::receive_line(state_, setup_, *this, line);
}

std::string_view Slim::meaning_of(std::string_view line) const { return meaning_of_reply(setup_, line); }

void Slim::receive_overlong() {
  wake();
  slim::receive_overlong(state_, setup_);
}

DeviceAnswer Slim::take_command(std::string_view line) {
  wake();
  return slim::take_command(state_, setup_, *this, line);
}

void Slim::receive_escape() {
  wake();
  state_.editor = {};
}

std::optional<double> Slim::value_named(std::string_view name) const {
  return queries_.value(state_, setup_, *this, name);
}

std::optional<std::string> Slim::assign(std::string_view name, double value) {
  if (!powered()) return "it has no power";
  wake();
  return assign_by_name(state_, setup_, *this, name, value);
}

// --- memory and program ----------------------------------------------------------------------------

/// Saves all values, because some may have been set when the device was created.
void Slim::settle_memory() {
  state_.kept = state_.ram;
  keep_program(state_);
}

void Slim::load_program(std::string_view text) {
  ReadProgram read = read_program(setup_, text);
  if (!read.mistakes.empty()) throw ProgramError(std::move(read.mistakes));
  wake();
  stop(state_.execution);
  state_.program = std::move(read.program);
}

std::string Slim::program_text() const {
  std::string text;
  for (const std::string& line : state_.program.texts()) text += line + "\n";
  return text;
}

std::vector<ProgramLocation> Slim::program_locations() const {
  return slim::program_locations(state_, setup_);
}

std::vector<ProgramMistake> Slim::mistakes_in(std::string_view text) const {
  return read_program(setup_, text).mistakes;
}

std::vector<ProgramPart> Slim::parts_of(std::string_view text) const {
  const ReadProgram read = read_program(setup_, text);
  return read.mistakes.empty() ? std::vector{part_of(read)} : std::vector<ProgramPart>{};
}

double Slim::value(const lang::Operand& operand) const {
  if (operand.kind == lang::Operand::Kind::quantity) return value_named(operand.text).value_or(0);
  return value_of(state_, setup_, operand);
}

lang::Outcome Slim::carry_out(const lang::Command& command) {
  Order order = order_of(state_, setup_, *this, command);
  const lang::Outcome outcome = perform_stored(order);
  if (outcome.error != Error::none) failed_module_ = order.module;
  return outcome;
}

// --- a tick ----------------------------------------------------------------------------------------

void Slim::sample_inputs(Tick tick) { slim::sample_inputs(state_, setup_, tick); }

void Slim::run_interpreters(Tick tick) {
  if (program_is_held(state_, setup_)) return;
  failed_module_ = 0;
  if (watch() != nullptr) watch()->program_loaded(mark_of(state_.program));
  const Error error = step(state_.execution, tick, state_.program, setup_.language, *this);
  if (error == Error::none) return;
  // A program that fails repeatedly is faster than its line. If there is no room on the line for an error,
  // the error is only stored.
  const bool is_said =
      chose(option("unasked_text", "errors_of_a_program_too")) && has_room_to_print(state_, setup_);
  const int module = is_said ? fail(state_, setup_, failed_module_, error)
                             : remember_error(state_, setup_, failed_module_, error);
  // A host that asks T0 why its program ended receives the error even if it belonged to another motor.
  if (module != 0 && !state_.execution.running) note_error(state_, setup_, 0, error);
}

void Slim::update_outputs(Tick) { remember_late_errors(state_, setup_); }

Tick Slim::next_active_tick(Tick done) const {
  if (state_.touched || sees_something_new(state_, setup_)) return done + 1;
  if (program_is_held(state_, setup_)) return state_.chain.next_active_tick(done);
  // A program that waits for the chain checks it in every tick.
  if (state_.execution.running && state_.execution.hold == lang::Hold::machine) return done + 1;
  return std::min(state_.chain.next_active_tick(done),
                  next_active_ms(state_.execution, done, state_.program, setup_.language, *this));
}

Tick Slim::next_event_tick(Tick done, Tick limit, const ClearTravel& ahead) const {
  // Values that a program and its events read change during motion.
  const bool is_looked_at = state_.execution.running || !lang::events_need_program(setup_.language);
  if (state_.touched || (is_looked_at && !program_is_held(state_, setup_))) return done + 1;
  const Tick next = state_.chain.next_event_tick(done, limit, ahead);
  return next > done + 1 && sees_something_new(state_, setup_) ? done + 1 : next;
}

void Slim::fast_forward_to(Tick, Tick tick, const ClearTravel&, std::span<std::int64_t> pulses) {
  state_.chain.fast_forward_to(tick, pulses);
}

State Slim::settled() const {
  State state = state_;
  state.chain.skip_to(now());
  return state;
}

// --- terminals and axes ----------------------------------------------------------------------------

bool Slim::output(int terminal) const {
  const int module = terminal / kTerminalsOfModule;
  const int which = terminal % kTerminalsOfModule;
  return which >= kFirstOutput && state_.chain.output(module, which - kFirstOutput + 1);
}

void Slim::set_encoder(int, std::int64_t) {
}  // the servo closes its own loop; see the model's known limitations

}  // namespace understudy::emulator::models::slim
