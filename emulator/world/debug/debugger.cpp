#include "emulator/world/debug/debugger.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text/one_line.h"
#include "base/text/suggestion.h"
#include "emulator/device/axes.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/register_map/register_bank.h"
#include "emulator/device/register_map/register_map.h"
#include "emulator/device/user_program.h"
#include "emulator/world/debug/breakpoint.h"
#include "emulator/world/debug/debugger_parts.h"
#include "emulator/world/expression/expression.h"
#include "emulator/world/names/names.h"

namespace understudy::emulator::world {

namespace {

/// The words of the event log, and words for what devices and machines report.
const std::vector<std::string> kEvents{"exception", "ignored", "dropped", "fault",         "power", "program",
                                       "command",   "input",   "alarm",   "program-error", "limit"};
const std::vector<std::string> kAuthors{"host", "control", "page", "device"};

void require_word(const std::string& word, const std::vector<std::string>& known, const char* field) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  throw BreakpointError(std::string(field) + ": " + understudy::quoted(word) + " is unknown" +
                        suggestion(word, known));
}

void require_program(const Device& device) {
  if (!device.powered()) throw BreakpointError(device.name() + " has no power; expected it to be on");
  if (device.user_program() == nullptr || device.model().language == nullptr)
    throw BreakpointError(device.name() + " runs no programs; expected a device that does");
}

BreakpointError unknown_program(const std::string& name, const ProgramLines& lines) {
  return BreakpointError("program: " + understudy::quoted(name) + " is unknown" +
                         suggestion(name, lines.part_names()));
}

}  // namespace

Debugger::Debugger(World& world, EventLog& events) : world_(world), events_(events), probes_(world) {}

Debugger::~Debugger() {
  points_.clear();
  step_.reset();
  settle();
}

const Breakpoint& Debugger::add(const BreakpointSetup& setup) {
  if (points_.size() == kMaxBreakpoints)
    throw BreakpointError("there are " + std::to_string(kMaxBreakpoints) +
                          " breakpoints already; expected one of them to be deleted first");
  auto point = std::make_unique<Point>();
  point->breakpoint.setup = setup;
  if (!setup.condition.empty()) {
    point->condition = parse_expression(setup.condition, probes_);
    require_values(point->condition);
  }
  parse_log(*point);
  switch (setup.kind) {
    case BreakpointSetup::Kind::line:
    case BreakpointSetup::Kind::instruction:
      require_program(world_.device(setup.device));
      if (const auto watch = watches_.find(setup.device); watch != watches_.end())
        watch->second->check_program();
      locate(*point);
      require_place(*point);
      break;
    case BreakpointSetup::Kind::condition: point->was_true = holds(*point, probes_); break;
    case BreakpointSetup::Kind::write:
      begin_events();
      if (!setup.by.empty()) require_word(setup.by, kAuthors, "by");
      find_write(*point);
      break;
    case BreakpointSetup::Kind::event:
      require_word(setup.name, kEvents, "on");
      begin_events();
      break;
  }
  point->breakpoint.number = ++last_number_;
  points_.push_back(std::move(point));
  settle();
  return points_.back()->breakpoint;
}

bool Debugger::remove(int number) {
  const auto is_it = [&](const auto& point) { return point->breakpoint.number == number; };
  const bool removed = std::erase_if(points_, is_it) > 0;
  settle();
  return removed;
}

void Debugger::remove_all() {
  points_.clear();
  settle();
}

std::vector<Breakpoint> Debugger::breakpoints() {
  for (auto& [number, watch] : watches_) watch->check_program();
  std::vector<Breakpoint> all;
  for (const auto& point : points_) all.push_back(point->breakpoint);
  return all;
}

/// Throws NameError if a name has a value only in scenarios, so that ticks need not check this.
void Debugger::require_values(const Expression& expression) const {
  for (const std::int32_t handle : names_in(expression)) static_cast<void>(probes_.value(handle));
}

/// Splits a log text at its braces: "at {feeder.Cord_A}".
void Debugger::parse_log(Point& point) const {
  std::string_view rest = point.breakpoint.setup.log;
  while (!rest.empty()) {
    const std::size_t open = rest.find('{');
    if (open != 0) point.log.emplace_back(std::string(rest.substr(0, open)));
    if (open == std::string_view::npos) return;
    const std::size_t close = rest.find('}', open);
    if (close == std::string_view::npos)
      throw BreakpointError("log: '{' is not closed; expected '}' after it");
    Expression piece = parse_expression(rest.substr(open + 1, close - open - 1), probes_);
    require_values(piece);
    point.log.emplace_back(std::move(piece));
    rest.remove_prefix(close + 1);
  }
}

void Debugger::locate(Point& point) {
  const BreakpointSetup& setup = point.breakpoint.setup;
  const Device& device = world_.device(setup.device);
  point.places.clear();
  point.breakpoint.line = 0;
  const auto watch = watches_.find(setup.device);
  const ProgramLines lines = watch != watches_.end() ? *watch->second->lines : ProgramLines(device);
  if (setup.kind == BreakpointSetup::Kind::line) {
    point.breakpoint.line = lines.line_from(setup.line);
    if (point.breakpoint.line != 0) point.places = lines.at(point.breakpoint.line);
    return;
  }
  const ProgramPart* const part = lines.find_part(setup.program);
  if (part == nullptr) return;
  const ProgramLines::Instruction instruction{part->number, setup.line};
  const auto place = lines.place(instruction);
  if (!place) return;
  point.places = {instruction};
  point.breakpoint.line = place->line;
}

void Debugger::require_place(const Point& point) const {
  if (!point.places.empty()) return;
  const BreakpointSetup& setup = point.breakpoint.setup;
  const ProgramLines lines(world_.device(setup.device));
  if (lines.last_line() == 0)
    throw BreakpointError(world_.device(setup.device).name() + " has no program; expected one to be loaded");
  if (setup.kind == BreakpointSetup::Kind::line) {
    throw BreakpointError("line: there is no instruction on line " + std::to_string(setup.line) +
                          " or after it; expected at most " + std::to_string(lines.last_line()));
  }
  const ProgramPart* const part = lines.find_part(setup.program);
  if (part == nullptr) {
    if (setup.program.empty()) throw BreakpointError("'program' is missing; expected one of its programs");
    throw unknown_program(setup.program, lines);
  }
  throw BreakpointError("instruction: there is no instruction " + std::to_string(setup.line) +
                        "; expected 0 to " + std::to_string(part->lines.size() - 1));
}

void Debugger::find_write(Point& point) {
  const std::string& name = point.breakpoint.setup.name;
  if (const auto value = find_value(world_.known(), name)) {
    point.written = world_.known()[value->device].name + "." + value->name;
  } else {
    const RegisterName found = find_register(world_.known(), name);
    const RegisterBank& bank = *world_.device(found.device).register_bank();
    point.written = world_.known()[found.device].name + "." +
                    bank.map().unique_name(*found.place.place.row, found.place.place.index);
  }
  point.handle = probes_.resolve(point.written).handle;
  point.value = probes_.value(point.handle);
}

/// Marks the events so far as seen, because they do not count as hits.
void Debugger::begin_events() {
  next_event_ = events_.next_number();
  signs_ = signs_of_machines();
}

bool Debugger::needs(std::size_t device) const {
  if (step_ && step_->device == device && step_->kind != StepKind::stand) return true;
  return std::any_of(points_.begin(), points_.end(), [&](const auto& point) { return point->is_of(device); });
}

/// Watches programs only if breakpoints or steps need it, and watches ticks only if there are breakpoints or
/// steps.
void Debugger::settle() {
  for (std::size_t d = 0; d < world_.device_count(); ++d) {
    if (needs(d) == watches_.contains(d)) continue;
    if (watches_.contains(d)) {
      watches_.erase(d);
    } else {
      watches_.emplace(d, std::make_unique<DeviceWatch>(*this, d));
    }
  }
  world_.set_bulk_ticks(watches_.empty());
  const bool must_watch = !points_.empty() || step_ != nullptr;
  if (must_watch == is_watching_) return;
  is_watching_ = must_watch;
  if (must_watch) {
    world_.add_watcher(*this);
  } else {
    world_.remove_watcher(*this);
  }
}

void Debugger::begin_step(StepKind kind, std::size_t number, const std::string& program) {
  const Device& device = world_.device(number);
  if (!device.powered()) throw BreakpointError(device.name() + " has no power; expected it to be on");
  auto step = std::make_unique<Step>(Step{.kind = kind, .device = number});
  if (kind != StepKind::stand) {
    begin_at(*step, program);
  } else if (device.axes() == nullptr) {
    throw BreakpointError(device.name() + " has no axes; expected a device with axes");
  }
  step_ = std::move(step);
  settle();
}

/// Determines where a step of a program starts: at the instruction where it stopped, or at the program's
/// current line.
void Debugger::begin_at(Step& step, const std::string& program) const {
  const Device& device = world_.device(step.device);
  require_program(device);
  const ProgramLines lines(device);
  const DebugStop* const at = stop();
  const bool has_stopped = at != nullptr && at->device == device.name() && !at->place.text.empty();
  const bool is_here = has_stopped && (program.empty() || program == at->place.program);
  const std::string name = is_here ? at->place.program : program;
  const bool is_one_of_many = device.model().language->parts_run_at_once();
  if (!name.empty()) {
    const ProgramPart* const part = lines.find_part(name);
    if (part == nullptr) throw unknown_program(name, lines);
    if (is_one_of_many) {
      step.part = part->number;
      step.program = name;
    }
  }
  if (is_here) {
    step.line = at->place.line;
    step.depth = at->depth;
    const auto place = location_of(step.device, name);
    const bool is_scanned = place && place->state == ProgramLocation::State::running && place->line == 0;
    const ProgramPart* const part = lines.find_part(name);
    if (is_scanned && part != nullptr) step.after = {part->number, at->place.number};
  } else {
    const auto place = location_of(step.device, step.program);
    step.line = place ? lines.source_line(place->line) : 0;
    step.depth = place ? place->callers.size() : 0;
  }
  if (step.kind == StepKind::out && step.depth == 0)
    throw BreakpointError("no routine is running; expected a step within a called routine");
}

void Debugger::end_step() {
  step_.reset();
  settle();
}

const DebugStop* Debugger::stop() const { return stop_ && stop_->time == world_.now() ? &*stop_ : nullptr; }

bool Debugger::take_stop() { return std::exchange(is_fresh_, false); }

void Debugger::wake(std::optional<DebugStop> stop) {
  sleeps_ = false;
  restart();
  stop_ = std::move(stop);
}

void Debugger::restart() {
  stop_.reset();
  is_fresh_ = false;
  step_.reset();
  begin_events();
  for (auto& [number, watch] : watches_) watch->last.reset();
  for (const auto& point : points_) {
    point->ran = 0;
    if (point->breakpoint.setup.kind == BreakpointSetup::Kind::condition)
      point->was_true = holds(*point, probes_);
    if (point->breakpoint.setup.kind == BreakpointSetup::Kind::write)
      point->value = probes_.value(point->handle);
  }
  settle();
}

}  // namespace understudy::emulator::world
