#include "emulator/models/slim/device.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "base/simulated_time.h"
#include "base/text/most_mistakes.h"
#include "emulator/device/clear_travel.h"
#include "emulator/device/device.h"
#include "emulator/device/device_of.h"
#include "emulator/device/memory/kept_memory.h"
#include "emulator/device/memory/nv_entry_error.h"
#include "emulator/device/memory/nv_image.h"
#include "emulator/device/model.h"
#include "emulator/device/program_error.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/memory.h"
#include "emulator/models/slim/model.h"
#include "emulator/models/slim/motor/jobs.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/parameters.h"
#include "emulator/models/slim/rules/chain_options.h"
#include "emulator/models/slim/rules/errors.h"
#include "emulator/models/slim/rules/options.h"
#include "interpreter/slim/command.h"
#include "interpreter/slim/flow.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/program.h"
#include "interpreter/slim/unknown_line.h"

namespace understudy::emulator::models::slim {

Slim::Slim(const DeviceSettings& settings)
    : DeviceOf(slim::model(), settings),
      KeptMemory(slim::model().name, settings.firmware),
      modules_(std::max(settings.modules, 1)) {
  flow_options_ = flow_options();
  state_.kept = factory();
  state_.ram = state_.kept;
  state_.chain.set_options(chain_options());
}

/// Each row's option in force, as the device has it.
ChainOptions Slim::chain_options() const {
  ChainOptions options;
  for (std::size_t row = 0; row < options.numbers.size(); ++row) options.numbers[row] = choice(row);
  return options;
}

lang::ProgramOptions Slim::program_options() const {
  using Options = lang::ProgramOptions;
  Options options;
  lang::Dialect& dialect = options.dialect;
  dialect.event_count = chosen_number(numbers("events"));
  dialect.longest_line = static_cast<std::size_t>(chosen_number(numbers("longest_line")));
  if (chose(option("helix_variables", "four_variables"))) dialect.helix_constants = false;
  if (chose(option("functions", "what_queries_show_too"))) dialect.quantities = true;
  if (chose(option("integer_range", "from_minus_32766"))) dialect.integer_least = -32766;
  if (chose(option("while_program_runs", "external_column_only")))
    options.columns.external = lang::Columns::External::strict;
  if (chose(option("while_program_runs", "reset_too")))
    options.columns.external = lang::Columns::External::with_reset;
  if (chose(option("immediate_column", "taken")))
    options.columns.variable_forms = lang::Columns::VariableForms::typed_too;
  if (chose(option("first_list_columns", "saves_in_programs_too")))
    options.columns.saves = lang::Columns::Saves::stored_too;
  options.capacity = chosen_number(numbers("program_size"));
  if (chose(option("addresses", "line_number_from_1"))) options.first_number = 1;
  if (chose(option("program_check", "when_it_runs"))) options.check = Options::Check::as_run;
  if (chose(option("edit_end", "exit_or_esc"))) options.empty_line = Options::EmptyLine::is_ignored;
  if (chose(option("refused_line", "ends_editing")))
    options.refused_line = Options::RefusedLine::ends_pe_and_pi;
  options.check_command =
      takes_letters_away()
          ? [](const lang::Command& command) { return check_parameter_line(command, true); }
          : [](const lang::Command& command) { return check_parameter_line(command, false); };
  if (chose(option("same_label", "the_first_counts"))) options.same_label = Options::SameLabel::first_counts;
  if (chose(option("listing", "text"))) options.listing = Options::Listing::bare;
  return options;
}

lang::FlowOptions Slim::flow_options() const {
  lang::FlowOptions options{.program = program_options()};
  if (chose(option("lines_a_tick", "four_a_millisecond"))) options.lines_per_tick = 4;
  if (chose(option("lines_a_tick", "one_in_4_milliseconds"))) options.lines_every_ms = 4;
  if (chose(option("time_unit", "4_milliseconds"))) options.window_unit_ms = 4;
  options.call_depth = chosen_number(numbers("call_depth"));
  if (chose(option("bare_number", "into_n0_or_r0")))
    options.bare_number = lang::FlowOptions::BareNumber::into_n0_or_r0;
  if (chose(option("events_without_program", "run_their_routine"))) options.events_need_program = false;
  if (chose(option("event_check", "each_4_milliseconds"))) options.events.look_every_ms = 4;
  if (chose(option("failed_line", "is_passed_over")))
    options.failed_line = lang::FlowOptions::FailedLine::is_passed;
  if (chose(option("interrupted_wait", "have_gone_on")))
    options.interrupted_timer = lang::FlowOptions::InterruptedTimer::goes_on;
  if (chose(option("event_at_arming", "waits_for_a_change")))
    options.events.at_arming = lang::EventOptions::AtArming::waits_for_change;
  if (chose(option("held_event", "is_dropped"))) options.events.held = lang::EventOptions::Held::is_dropped;
  return options;
}

MemoryForm Slim::memory_form() const {
  return {.speed_names = chose(option("speed_parameters", "pn14_is_vm")) ? SpeedNames::pn14_is_vm
                                                                         : SpeedNames::pn10_is_vm,
          .integer_least = of_programs().dialect.integer_least};
}

Memory Slim::factory() const {
  return factory_memory(chose(option("linked_from_factory", "t0_alone")) ? 1 : modules_);
}

namespace {

std::string history_name(int module, std::size_t number) {
  return (module == 0 ? "" : "T" + std::to_string(module)) + "ERC(" + std::to_string(number) + ")";
}

/// The errors of each module, the last one first: ERC(0), ERC(1) ..., T1ERC(0) ...
void write_history(const std::array<Errors, kModules>& errors, NvImage& image) {
  for (int m = 0; m < kModules; ++m) {
    const auto& history = errors[static_cast<std::size_t>(m)].history;
    for (std::size_t i = 0; i < history.size(); ++i) {
      image.registers.emplace_back(history_name(m, i), history[i]);
    }
  }
}

}  // namespace

// --- power and memory ------------------------------------------------------------------------------

void Slim::power_up() {
  state_.ram = state_.kept;
  state_.chain = Chain(chain_options());
  state_.chain.skip_to(now());
  state_.program.clear();
  state_.program.set_texts(state_.kept_program, of_programs());
  state_.powered_at = now();
  state_.clock_zero = now();
  state_.touched = true;
  for (int m = 0; m < kModules; ++m) state_.inputs[static_cast<std::size_t>(m)] = input_levels(m);
  for (int m = 0; m < kModules; ++m) {
    state_.chain.settings().set_pulses_per_revolution(m, chosen_number(numbers("pulses_per_revolution")));
  }
  apply_all_parameters();
  const int map = static_cast<int>(state_.ram.parameters[0][parameter("PN37")]);
  for (int letter = 0; letter < kLetters; ++letter) {
    assign_axis(static_cast<Letter>(letter), (map >> (4 * letter)) & 0xF);
  }
}

void Slim::power_down() {
  State blank;
  blank.kept = std::move(state_.kept);
  blank.ram = blank.kept;
  blank.kept_program = std::move(state_.kept_program);
  blank.kept_revision = state_.kept_revision;
  blank.chain.set_options(chain_options());
  blank.chain.skip_to(now());
  if (history_is_kept()) {
    for (std::size_t m = 0; m < blank.errors.size(); ++m) {
      blank.errors[m].history = std::move(state_.errors[m].history);
    }
  }
  state_ = std::move(blank);
}

/// RESET H.
void Slim::reboot() {
  power_down();
  power_up();
}

/// What was set when the device was made is kept, as if saved.
void Slim::settle_memory() {
  state_.kept = state_.ram;
  keep_program();
}

std::function<void(NvImage&)> Slim::memory_writer() const {
  return [kept = state_.kept, factory = factory(), form = memory_form(),
          errors = history_is_kept() ? std::optional(state_.errors) : std::nullopt,
          program = state_.kept_program](NvImage& image) {
    write_image(kept, factory, form, image);
    if (errors) write_history(*errors, image);
    image.program = program;
  };
}

/// Takes them out of the image.
std::array<Errors, kModules> Slim::read_history(NvImage& image) const {
  std::array<Errors, kModules> errors{};
  if (!history_is_kept()) return errors;
  for (int m = 0; m < kModules; ++m) {
    for (std::size_t i = 0; i < history_length(); ++i) {
      const auto found = std::ranges::find(image.registers, history_name(m, i),
                                           [](const auto& entry) { return std::string_view(entry.first); });
      if (found == image.registers.end()) break;
      constexpr auto kMax = static_cast<std::int64_t>(Error::address);
      if (found->second < 1 || found->second > kMax) {
        throw refused_value(NvEntryError::List::registers, history_name(m, i),
                            history_name(m, i) + ": " + std::to_string(found->second) +
                                " is not an error; expected 1 to " + std::to_string(kMax));
      }
      errors[static_cast<std::size_t>(m)].history.push_back(static_cast<std::uint8_t>(found->second));
      image.registers.erase(found);
    }
  }
  return errors;
}

void Slim::read_memory(const NvImage& given) {
  NvImage image = given;
  const std::array<Errors, kModules> errors = read_history(image);
  Memory memory = read_image(image, factory(), memory_form());
  const auto capacity = static_cast<std::size_t>(of_programs().capacity);
  if (image.program.size() > capacity) {
    throw NvError("program: has " + std::to_string(image.program.size()) + " lines; expected at most " +
                  std::to_string(capacity));
  }
  lang::Program program;
  if (!program.set_texts(image.program, of_programs())) {
    throw NvError(
        "program: holds a line that is not a command of a program; expected lines as ULP shows them");
  }
  state_.kept = std::move(memory);
  if (history_is_kept()) state_.errors = errors;
  state_.kept_program = image.program;
  ++state_.kept_revision;
}

Slim::ReadProgram Slim::read_program(std::string_view text) const {
  ReadProgram read;
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::size_t first = line.find_first_not_of(" \t");
    // What a file has for people: empty lines and remarks.
    if (first == std::string::npos || line[first] == ';' || line[first] == '#') continue;
    const Error error = read.program.insert(read.program.size(), line, of_programs());
    if (error == Error::none) continue;
    const std::string lines_that_fit = std::to_string(of_programs().capacity);
    const std::string what =
        error == Error::buffer_full   ? "the program is full; expected at most " + lines_that_fit + " lines"
        : error == Error::range       ? "has a value out of range"
        : error == Error::not_allowed ? "is not allowed in a program"
        : error == Error::address     ? "begins with a label that another line has"
                                      : lang::why_not_command(std::string_view(line).substr(first));
    read.mistakes.push_back({number, static_cast<int>(first) + 1, what});
    if (error == Error::buffer_full) break;  // for all that follow as well
    if (read.mistakes.size() >= kMaxMistakes) break;
  }
  return read;
}

void Slim::load_program(std::string_view text) {
  ReadProgram read = read_program(text);
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

// --- a tick ----------------------------------------------------------------------------------------

std::uint8_t Slim::input_levels(int module) const {
  unsigned levels = 0;
  for (int i = 0; i < kInputs; ++i) levels |= (level(module, i) ? 1U : 0U) << i;
  return static_cast<std::uint8_t>(levels);
}

void Slim::sample_inputs(Tick tick) {
  state_.chain.skip_to(tick - 1);
  for (int m = 0; m < kModules; ++m) {
    state_.inputs[static_cast<std::size_t>(m)] = input_levels(m);
    state_.chain.set_horg(m, level(m, kHorg));
    state_.chain.set_analog(m, Device::input(terminal(m, kAnalog)));
  }
  state_.touched = false;
}

void Slim::run_interpreters(Tick tick) {
  if (program_is_held()) return;
  failed_module_ = 0;
  const Error error = step(state_.execution, tick, state_.program, flow_options_, *this);
  if (error == Error::none) return;
  // A program that goes on failing is faster than its line: what has no room is remembered only.
  const bool is_said = chose(option("unasked_text", "errors_of_a_program_too")) && has_room_to_speak();
  const int module = is_said ? fail(failed_module_, error) : remember(failed_module_, error);
  // Whoever asks T0 why its program has ended is told, although the motor was another one's.
  if (module != 0 && !state_.execution.running) note_error(0, error);
}

void Slim::step_motion(Tick tick) { state_.chain.step(tick); }

void Slim::update_outputs(Tick) {
  for (int m = 0; m < kModules; ++m) {
    const Error late = state_.chain.take_late_error(m);
    if (late != Error::none) note_error(errors_are_of_t0() ? 0 : m, late);
  }
}

/// Whether an input is not as it was when a tick last looked.
bool Slim::sees_something_new() const {
  for (int m = 0; m < kModules; ++m) {
    if (input_levels(m) != state_.inputs[static_cast<std::size_t>(m)]) return true;
    const bool sees_horg = level(m, kHorg) == state_.chain.horg(m);
    if (!sees_horg || Device::input(terminal(m, kAnalog)) != state_.chain.module_at(m).analog) return true;
  }
  return false;
}

Tick Slim::next_active_tick(Tick done) const {
  if (state_.touched || sees_something_new()) return done + 1;
  if (program_is_held()) return state_.chain.next_active_tick(done);
  // A program that waits for the chain asks in every tick.
  if (state_.execution.running && state_.execution.hold == lang::Hold::machine) return done + 1;
  return std::min(state_.chain.next_active_tick(done),
                  next_active_ms(state_.execution, done, state_.program, flow_options_, *this));
}

Tick Slim::next_event_tick(Tick done, Tick most, const ClearTravel& ahead) const {
  // What a program and its events look at moves.
  const bool is_looked_at = state_.execution.running || !flow_options_.events_need_program;
  if (state_.touched || (is_looked_at && !program_is_held())) return done + 1;
  const Tick next = state_.chain.next_event_tick(done, most, ahead);
  return next > done + 1 && sees_something_new() ? done + 1 : next;
}

void Slim::fast_forward_to(Tick, Tick tick, const ClearTravel&, std::span<std::int64_t> pulses) {
  state_.chain.fast_forward_to(tick, pulses);
}

State Slim::settled() const {
  State state = state_;
  state.chain.skip_to(now());
  return state;
}

bool Slim::same_state(const Device& other) const {
  const auto* that = dynamic_cast<const Slim*>(&other);
  return that != nullptr && that->now() == now() && that->settled() == settled();
}

// --- terminals and axes ----------------------------------------------------------------------------

bool Slim::output(int terminal) const {
  const int module = terminal / kTerminalsOfModule;
  const int which = terminal % kTerminalsOfModule;
  return which >= kFirstOutput && state_.chain.output(module, which - kFirstOutput + 1);
}

void Slim::set_encoder(int, std::int64_t) {}  // its loop is closed inside; see the model's gaps

}  // namespace understudy::emulator::models::slim
