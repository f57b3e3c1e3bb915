#include "emulator/models/simple2_r3/programs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/program_watch.h"
#include "base/simulated_time.h"
#include "base/state/state_bytes.h"
#include "emulator/device/program_error.h"
#include "emulator/device/register_map/access.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/models/simple2_r3/language.h"
#include "emulator/models/simple2_r3/options.h"
#include "emulator/models/simple2_r3/program_machine.h"
#include "emulator/models/simple2_r3/reactions.h"
#include "emulator/models/simple2_r3/registers.h"
#include "emulator/models/simple2_r3/setup.h"
#include "emulator/models/simple2_r3/slots.h"
#include "emulator/models/simple2_r3/state.h"
#include "interpreter/simple2/execution/execution.h"
#include "interpreter/simple2/listing.h"
#include "interpreter/simple2/program.h"

namespace understudy::emulator::models::simple2_r3 {

namespace {

constexpr std::uint16_t kProgramAddress = 0x4000;

interpreter::simple2::FlagRules flag_rules_of(const Setup& setup) {
  using Rules = interpreter::simple2::FlagRules;
  Rules rules;
  if (setup.chose(option("same_flag_twice", "last_written"))) rules.several = Rules::Several::last_written;
  if (setup.chose(option("flags_after_end", "does_not_count")))
    rules.after_end = Rules::AfterEnd::do_not_count;
  if (setup.chose(option("flags_found", "at_start"))) rules.found = Rules::Found::on_request;
  return rules;
}

}  // namespace

// --- its cells -------------------------------------------------------------------------------------

void Programs::power_up() {
  reset_timers();
  state_.program = interpreter::simple2::Program({}, flag_rules_of(setup_));
  reload();
  find_flags_if_requested();
}

void Programs::reload() {
  for (std::size_t line = 0; line < 256; ++line) {
    for (std::size_t column = 0; column < 4; ++column) {
      const auto cell = static_cast<std::uint8_t>(state_.image[kColumns[column] + line]);
      const auto number = static_cast<int>(4 * line + column);
      if (state_.program.cell(number) != cell) state_.program.set_cell(number, cell);
    }
  }
}

void Programs::load(std::string_view listing) {
  const auto assembly = interpreter::simple2::assemble(listing);
  if (!assembly.lines) throw ProgramError(mistakes_of(assembly));
  auto address = kProgramAddress;
  for (const auto& line : *assembly.lines) {
    const std::array<std::uint16_t, 4> words{line.command, line.data1, line.data2, line.flag};
    write_words(bank_, Table::holding, address, words);
    address = static_cast<std::uint16_t>(address + words.size());
  }
}

void Programs::clear() {
  for (const std::size_t column : kColumns) {
    std::fill_n(state_.image.begin() + static_cast<std::ptrdiff_t>(column), interpreter::simple2::kLineCount,
                0U);
  }
  reload();
}

void Programs::find_flags_if_requested() {
  using Found = interpreter::simple2::FlagRules::Found;
  if (state_.program.flag_rules().found == Found::on_request) state_.program.find_flags();
}

// --- its run ---------------------------------------------------------------------------------------

void Programs::start(std::uint8_t line) {
  interpreter::simple2::Execution& execution = state_.execution;
  if (execution.running && setup_.chose(option("start_while_running", "ignored"))) return;
  const interpreter::simple2::LoopState loop = execution.loop;
  interpreter::simple2::start(execution, line);
  if (setup_.chose(option("start_while_running", "jumps")))
    execution.loop = loop;  // there is no loop if the program was not running
  find_flags_if_requested();
  if (!setup_.chose(option("program_start", "clears_them"))) return;
  for (Timer& timer : state_.timers) timer = {};
  constexpr std::array kValues{slot("CalcREG"), slot("Counter1_Value"), slot("Counter2_Value")};
  for (const std::size_t value : kValues) state_.image[value] = 0;
  std::fill_n(state_.image.begin() + slot("PROG_VAR{}"), 32, 0U);
}

void Programs::stop() {
  if (!state_.execution.running) return;
  interpreter::simple2::stop(state_.execution);
  has_ended();
}

void Programs::run(Tick tick, ProgramWatch* watch) {
  if (tick == state_.first_tick && starts_by_itself(state_)) start(0);
  if (!state_.execution.running || tick % interpreter::simple2::kSlotMs != 0) return;
  ProgramMachine machine(state_, setup_, bank_);
  if (watch != nullptr) {
    watch->program_loaded(hash_of(std::as_bytes(std::span(state_.program.lines()))));
    machine.set_watch(watch);
  }
  interpreter::simple2::step(state_.execution, tick, state_.program, setup_.dialect, machine);
  if (!state_.execution.running) has_ended();
}

void Programs::has_ended() {
  for (int axis = 0; axis < 2 && setup_.chose(option("program_end", "stops")); ++axis) {
    AxisReactions(state_, setup_, axis).stop();
  }
  for (Timer& timer : state_.timers) {
    if (setup_.chose(option("timers_at_end", "stop"))) {
      timer.run(false, setup_.timer_time(), setup_.timers_stay);
    }
  }
}

void Programs::reset_timers() {
  for (Timer& timer : state_.timers) {
    timer = {};
    if (setup_.chose(option("timers_at_power_up", "running"))) {
      timer.run(true, setup_.timer_time(), setup_.timers_stay);
    }
  }
}

Tick next_slot(const State& state, const Setup& setup, const RegisterBank& bank, Tick done) {
  // A waiting program runs only until it is clear that it will continue to wait. After that, its condition
  // determines the next tick.
  if (state.execution.held.command == 0) {
    return done + interpreter::simple2::kSlotMs - done % interpreter::simple2::kSlotMs;
  }
  const ProgramView machine(state, setup, bank);
  return interpreter::simple2::next_active_slot_ms(state.execution, done, state.program, setup.dialect,
                                                   machine);
}

}  // namespace understudy::emulator::models::simple2_r3
