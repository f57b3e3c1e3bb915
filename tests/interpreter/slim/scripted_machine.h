// A machine for programs under test: tests set inputs and variables, and the actions of a program are
// recorded with their times.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "interpreter/slim/flow.h"
#include "interpreter/slim/parse.h"
#include "interpreter/slim/text_of.h"

namespace understudy::interpreter::slim {

class ScriptedMachine : public Machine {
 public:
  bool input(int number) const override { return inputs.contains(number); }

  double value(const Operand& operand) const override {
    EXPECT_FALSE(operand.index_is_variable);
    switch (operand.kind) {
      case Operand::Kind::analog: return analog;
      case Operand::Kind::clock: return clock;
      default: break;
    }
    EXPECT_TRUE(is_variable(operand.kind)) << text_of(operand);
    const auto found = variables.find(text_of(operand));
    return found == variables.end() ? 0 : found->second;
  }

  Outcome carry_out(const Command& command) override {
    const std::string text = text_of(command);
    for (const Operand& operand : command.operands) {
      EXPECT_NE(operand.kind, Operand::Kind::get_integer) << text;
      EXPECT_NE(operand.kind, Operand::Kind::get_real) << text;
    }
    if (refusals.contains(text)) return failed(refusals.at(text));
    if (waiting.contains(text)) return kWaits;
    log.push_back(std::to_string(now_ms) + " " + text);
    if (command.verb == Verb::set_variable) {
      const Operand& data = command.operands[1];
      const bool is_constant = data.kind == Operand::Kind::integer || data.kind == Operand::Kind::real;
      variables[text_of(command.operands[0])] = is_constant ? data.number : value(data);
    }
    if (endings.contains(text)) return {.program = endings.at(text)};
    return kDone;
  }

  std::set<int> inputs;  // those that are On
  std::map<std::string, double> variables;
  double analog = 0;
  double clock = 0;
  std::set<std::string> waiting;  // commands that the machine has not executed yet
  std::map<std::string, Error> refusals;
  std::map<std::string, Outcome::Program> endings;  // the effect of commands on the program
  std::int64_t now_ms = 0;
  std::vector<std::string> log;  // "time command"
};

using Log = std::vector<std::string>;

/// A program with its machine, from `G` at time 0: the first line runs at 1 ms.
struct ProgramRun {
  explicit ProgramRun(const std::vector<std::string>& lines, const Options& chosen = {}) : options(chosen) {
    for (const std::string& line : lines) {
      EXPECT_EQ(program.insert(program.size(), line, options), Error::none) << line;
    }
  }

  Error begin(std::string_view address = "0") {
    const ParseResult go = parse_line("G " + std::string(address));
    EXPECT_EQ(go.error, Error::none);
    return start(execution, program, go.line.command->operands.data(), options);
  }

  /// Runs all ticks up to and including `ms`. Skips the ticks that next_active_ms() allows it to skip, and
  /// checks that they would not have changed anything.
  void until(std::int64_t ms) {
    while (machine.now_ms < ms) {
      // Only the machine determines when the program's wait ends.
      const bool is_released = execution.hold == Hold::machine && machine.waiting.empty();
      const bool is_quiet = !is_released && next_active_ms(execution, machine.now_ms, program, options,
                                                           machine) > machine.now_ms + 1;
      const Execution before = execution;
      const std::size_t done_before = machine.log.size();
      ++machine.now_ms;
      const Error error = step(execution, machine.now_ms, program, options, machine);
      if (error != Error::none) errors.push_back(error);
      EXPECT_TRUE(is_sound(execution, program, options)) << "at " << machine.now_ms;
      if (!is_quiet) continue;
      EXPECT_TRUE(execution == before) << "at " << machine.now_ms;
      EXPECT_EQ(machine.log.size(), done_before) << "at " << machine.now_ms;
    }
  }

  Options options;
  Program program;
  Execution execution;
  ScriptedMachine machine;
  std::vector<Error> errors;
};

}  // namespace understudy::interpreter::slim
