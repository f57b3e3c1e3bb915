// The data that a debugger stores for each breakpoint, device and step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/program_watch.h"
#include "emulator/device/device.h"
#include "emulator/device/model.h"
#include "emulator/device/program_language.h"
#include "emulator/device/user_program.h"
#include "emulator/world/debug/debugger.h"
#include "emulator/world/expression/number.h"

namespace understudy::emulator::world {

struct Debugger::Point {
  /// A piece of a log text: either text or an expression.
  using Piece = std::variant<std::string, Expression>;

  Breakpoint breakpoint{};
  Expression condition{};
  std::vector<Piece> log{};
  std::vector<ProgramLines::Instruction> places{};  // for a line or an instruction
  std::uint64_t ran = 0;                            // how often these instructions began in this tick
  std::optional<ProgramLines::Instruction> ran_last{};
  std::size_t depth = 0;          // the number of callers at the hit
  bool was_true = false;          // for a condition
  std::string written{};          // for a write: the name of the register in events
  std::int32_t handle = 0;        // for a write: the register's value
  std::optional<Number> value{};  // the value at the end of the last tick
  std::string who{};              // what happened at the last hit of a write or an event
  std::string no_result{};        // why the condition has no result; empty if it has one
  bool is_of(std::size_t device) const {
    return (breakpoint.setup.kind == BreakpointSetup::Kind::line ||
            breakpoint.setup.kind == BreakpointSetup::Kind::instruction) &&
           breakpoint.setup.device == device;
  }
};

struct Debugger::Step {
  StepKind kind = StepKind::instruction;
  std::size_t device = 0;
  std::optional<int> part{};  // the part that is stepped; no value: any part
  std::string program{};      // the name of that part
  int line = 0;               // the line where the step began; 0 if it is unknown
  std::size_t depth = 0;      // the number of callers when the step begins; afterwards, when it ends
  std::optional<ProgramLines::Instruction> end{};  // the instruction at which the step ends

  /// In a program whose scan begins at its first line in each tick: the instruction where the program has
  /// stopped. The step continues after this instruction in the next scan.
  std::optional<ProgramLines::Instruction> after{};
  int scanned = -1;  // the last instruction that the step has seen, before it passed `after`
  /// Returns true for the instruction where the program has stopped, and for all instructions before it.
  bool is_passed_over(const ProgramLines::Instruction& instruction) {
    if (!after || instruction.part != after->part) return false;
    const bool is_next_scan = instruction.number <= scanned;
    scanned = instruction.number;
    if (!is_next_scan && instruction.number < after->number) return true;
    const bool is_itself = !is_next_scan && instruction == *after;
    after.reset();
    return is_itself;
  }
};

/// Watches a device's program for breakpoints and steps.
class Debugger::DeviceWatch final : public ProgramWatch {
 public:
  DeviceWatch(Debugger& debugger, std::size_t number) : debugger_(debugger), number_(number) {
    device().user_program()->add_watch(*this);
    find_lines();
  }
  ~DeviceWatch() override { device().user_program()->remove_watch(*this); }
  DeviceWatch(const DeviceWatch&) = delete;
  DeviceWatch& operator=(const DeviceWatch&) = delete;

  void program_loaded(std::uint64_t mark) override {
    if (mark_ == mark) return;
    mark_ = mark;
    check_program();
  }
  /// Looks up the lines again if the device has a different program.
  void check_program() {
    if (device().user_program()->program_text() == text_) return;
    has_changed = true;
    find_lines();
    for (const auto& point : debugger_.points_) {
      if (point->is_of(number_)) debugger_.locate(*point);
    }
  }
  void runs(int part, int line, std::int64_t times) override {
    const ProgramLines::Instruction instruction{part, line};
    last = instruction;
    for (const auto& point : debugger_.points_) {
      if (!point->is_of(number_)) continue;
      if (std::find(point->places.begin(), point->places.end(), instruction) == point->places.end()) continue;
      point->ran += static_cast<std::uint64_t>(times);
      point->ran_last = instruction;
      point->depth = depth_at(part);
    }
    Step* const step = debugger_.step_.get();
    if (step == nullptr || step->device != number_ || (step->part && *step->part != part)) return;
    if (step->end || step->is_passed_over(instruction)) return;
    const auto place = lines->place(instruction);
    if (step->kind == StepKind::line && place && place->line == step->line) return;
    const std::size_t depth = depth_at(part);
    if (step->kind == StepKind::over && depth > step->depth) return;
    if (step->kind == StepKind::out && depth >= step->depth) return;
    step->end = instruction;
    step->depth = depth;
  }
  void decides(int /*part*/, int /*line*/, bool /*outcome*/, std::int64_t /*times*/) override {}

  void find_lines() {
    text_ = device().user_program()->program_text();
    lines.emplace(device());
  }
  /// Returns the number of callers of the program that is running this part.
  std::size_t depth_at(int part) const {
    const bool is_one_of_many = device().model().language->parts_run_at_once();
    const auto first = is_one_of_many ? lines->place({part, 0}) : std::nullopt;
    const auto place = debugger_.location_of(number_, first ? first->program : std::string());
    return place ? place->callers.size() : 0;
  }

  std::optional<ProgramLines> lines{};
  std::optional<ProgramLines::Instruction> last{};
  bool has_changed = false;  // the program of the device has changed since the last tick

 private:
  Device& device() const { return debugger_.world_.device(number_); }

  Debugger& debugger_;
  std::size_t number_;
  std::optional<std::uint64_t> mark_{};
  std::string text_{};  // the text of the program to which `lines` belong
};

}  // namespace understudy::emulator::world
