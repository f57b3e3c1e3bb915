// Executes macros in a different way from the product: as a tree of blocks that nested calls walk through.
// Time passes when a line waits.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/rs_m8194h/run.h"
#include "interpreter/rs_m8194h/text.h"
#include "tests/interpreter/program_counts.h"

namespace understudy::interpreter::rs_m8194h::naive {

/// The world in which random macros run: all its values follow arithmetic rules over time.
inline bool axes_stand(std::uint32_t axes, std::int64_t now) { return (now + axes) % 4 != 0; }
inline bool input_is_on(std::uint32_t group, std::uint32_t channel, std::int64_t now) {
  return (now / 3 + group + 2 * channel) % 5 < 2;
}
inline bool drive_begins(std::uint32_t axes, std::int64_t now) { return (now * 7 + axes) % 3 != 0; }
inline std::int32_t reading(const std::string& text, std::int64_t now) {
  std::uint32_t sum = static_cast<std::uint32_t>(now) * 977;
  for (const char c : text) sum = sum * 31 + static_cast<unsigned char>(c);
  return static_cast<std::int32_t>(sum % 20001) - 10000;
}

/// Returns a command with numbers only, without variables.
inline std::string plain(const Command& command) {
  Command real_time = command;
  real_time.code = static_cast<std::uint16_t>((command.code & 0xFFU) | 0x0A00U);
  return text_of(real_time);
}

struct Node {
  std::size_t line = 0;
  Command command = {};
  std::vector<Node> body = {};   // the lines inside IF or FOR
  std::vector<Node> other = {};  // after ELSE
  bool has_else = false;
  std::size_t else_line = 0;
  std::size_t end_line = 0;  // END_IF, NEXT
};
using Nodes = std::vector<Node>;

/// The lines from `at` to the end of their block.
inline Nodes tree_of(const std::vector<Command>& lines, std::size_t& at) {
  Nodes nodes;
  while (at < lines.size()) {
    const Verb verb = lines[at].verb();
    if (verb == Verb::else_ || verb == Verb::end_if || verb == Verb::next) return nodes;
    Node node{.line = at, .command = lines[at]};
    ++at;
    if (verb == Verb::if_ || verb == Verb::for_) {
      node.body = tree_of(lines, at);
      if (lines[at].verb() == Verb::else_) {
        node.has_else = true;
        node.else_line = at++;
        node.other = tree_of(lines, at);
      }
      node.end_line = at++;
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

struct ExitFor {};
struct ExitMacro {};
struct Terminated {};
struct TimeIsUp {};
struct Jump {
  std::uint32_t label;
};

class Evaluator {
 public:
  Evaluator(const std::map<MacroName, Macro>& macros, const Options& options, int budget, std::int64_t end)
      : options_(options), budget_(budget), end_(end) {
    for (const auto& [name, macro] : macros) {
      std::size_t at = 0;
      trees_[name] = tree_of(macro.lines, at);
    }
  }

  std::array<std::int32_t, kVariableCount> variables{};
  std::array<std::uint8_t, kByteVariableCount> byte_variables{};
  std::vector<std::pair<std::int64_t, int>> isrs;  // the times and numbers of the ISRs
  std::vector<std::string> log;
  LineTally counts;

  void run(int number) {
    try {
      advance();
      call({false, number}, 1);
      note("end");
    } catch (const Terminated&) {
    } catch (const TimeIsUp&) {
    }
  }

 private:
  void note(const std::string& what) { log.push_back(std::to_string(now_) + " " + what); }

  // --- time ------------------------------------------------------------------------------------

  void advance() {
    if (now_ == end_) throw TimeIsUp{};
    ++now_;
    left_ = budget_;
    // A waiting MP detects its event even while an ISR runs.
    if (awaited_ && awaited_()) has_come_ = true;
    if (!in_isr_) serve();
  }

  void serve() {
    while (!isrs.empty() && isrs.front().first <= now_) {
      const int number = isrs.front().second;
      isrs.erase(isrs.begin());
      if (!options_.chose(option("return_registers", "one_for_both"))) returned_[1] = {};
      in_isr_ = true;
      call({true, number}, 1);
      in_isr_ = false;
    }
  }

  void take_step() {
    while (left_ == 0) advance();
    --left_;
  }

  LineCount& count(const MacroName& macro, std::size_t line) {
    return counts[{macro.number + (macro.is_isr ? 157 : 0), static_cast<int>(line)}];
  }
  void take_step(const MacroName& macro, std::size_t line) {
    take_step();
    ++count(macro, line).runs;
  }

  void wait_for(const Node& node, const MacroName& macro, const std::function<bool()>& condition) {
    const bool is_over = condition();
    if (node.command.verb() != Verb::timer) count(macro, node.line).decide(is_over);
    if (is_over) return;
    if (in_isr_) {
      do advance();
      while (!condition());
      return;
    }
    has_come_ = false;
    awaited_ = condition;
    while (!has_come_) advance();
    awaited_ = nullptr;
  }

  // --- values ----------------------------------------------------------------------------------

  std::int32_t value(std::uint32_t operand) const {
    const bool is_variable = operand >= 0x7FFF0000 && operand <= 0x7FFF01FF;
    return is_variable ? variables[operand - 0x7FFF0000] : static_cast<std::int32_t>(operand);
  }
  std::int32_t& variable(std::uint32_t name) { return variables[name - 0x7FFF0000]; }
  ReturnRegister& returned() {
    return returned_[in_isr_ && !options_.chose(option("return_registers", "one_for_both")) ? 1 : 0];
  }
  void fail(const Node& node, const MacroName& macro, int error) {
    note("fault " + std::to_string(error) + " " + to_string(macro) + " line " + std::to_string(node.line));
  }

  // --- lines -----------------------------------------------------------------------------------

  void call(const MacroName& name, int level) {
    const auto found = trees_.find(name);
    if (found == trees_.end()) return;
    const Nodes& nodes = found->second;
    std::size_t at = 0;
    while (at < nodes.size()) {
      try {
        const std::size_t line = at++;
        carry_out(nodes[line], name, level);
      } catch (const ExitMacro&) {
        return;
      } catch (const Jump& jump) {
        at = 0;
        while (nodes[at].command.verb() != Verb::label || nodes[at].command.values[0] != jump.label) ++at;
      }
    }
  }

  void all_of(const Nodes& nodes, const MacroName& macro, int level) {
    for (const Node& node : nodes) carry_out(node, macro, level);
  }

  void carry_out(const Node& node, const MacroName& macro, int level) {
    const Command& command = node.command;
    const auto& values = command.values;
    if (command.row().use.starts_motion) return drive(node, macro);
    take_step(macro, node.line);
    switch (command.verb()) {
      case Verb::set_var: variable(values[0]) = value(values[1]); return;
      case Verb::set_rvar:
        if (options_.chose(option("return_register_keeps", "execution_error")) && !returned().is_full)
          return fail(node, macro, 16);
        variable(values[0]) = returned().value;
        if (options_.chose(option("return_register_keeps", "execution_error"))) returned() = {};
        return;
      case Verb::var_calculate: return calculate_line(node, macro);
      case Verb::if_: return branch(node, macro, level);
      case Verb::for_: return loop(node, macro, level);
      case Verb::exit_for: throw ExitFor{};
      case Verb::exit_macro: throw ExitMacro{};
      case Verb::goto_: throw Jump{values[0]};
      case Verb::label: return;
      case Verb::mp_call:
        if (level < 7) return call({false, static_cast<int>(values[0])}, level + 1);
        fail(node, macro, 15);
        if (options_.chose(option("call_too_deep", "ends_the_macro"))) throw ExitMacro{};
        return;
      case Verb::timer: return timer(node, macro);
      case Verb::stop_wait:
        return wait_for(node, macro, [this, axes = values[0]] { return axes_stand(axes, now_); });
      case Verb::frnet_wait: return frnet_wait(node, macro);
      case Verb::mp_terminate:
        isrs.clear();
        note("terminated");
        throw Terminated{};
      case Verb::get_lp:
      case Verb::get_error: returned() = {reading(text_of(command), now_), true}; return;
      default: return note(resolved_text(node));
    }
  }

  void calculate_line(const Node& node, const MacroName& macro) {
    const auto& values = node.command.values;
    const std::int64_t left = value(values[0]);
    const std::int64_t right = value(values[2]);
    std::int64_t result = 0;
    if (values[1] == '+') result = left + right;
    if (values[1] == '-') result = left - right;
    if (values[1] == '*') result = left * right;
    if (values[1] == '/' && right != 0) result = left / right;
    if (values[1] == '&') result = left & right;
    if (values[1] == '|') result = left | right;
    variable(values[3]) = static_cast<std::int32_t>(static_cast<std::uint64_t>(result) & 0xFFFFFFFF);
    if (values[1] == '/' && right == 0) fail(node, macro, 16);
  }

  void branch(const Node& node, const MacroName& macro, int level) {
    const std::int64_t difference =
        std::int64_t{value(node.command.values[0])} - value(node.command.values[2]);
    const std::string text = text_of(node.command);
    const auto says = [&text](const std::string& sign) {
      return text.find(" " + sign + " ") != std::string::npos;
    };
    const bool is_true = (says("<") && difference < 0) || (says("<=") && difference <= 0) ||
                         (says(">") && difference > 0) || (says(">=") && difference >= 0) ||
                         (says("==") && difference == 0) || (says("!=") && difference != 0);
    count(macro, node.line).decide(is_true);
    if (is_true) {
      all_of(node.body, macro, level);
      take_step(macro, node.has_else ? node.else_line : node.end_line);
    } else if (node.has_else) {
      all_of(node.other, macro, level);
      take_step(macro, node.end_line);
    }
  }

  void loop(const Node& node, const MacroName& macro, int level) {
    const std::uint32_t passes = node.command.values[0];
    const bool counts_itself = passes >= 0x7FFF0000 && passes <= 0x7FFF01FF;
    std::int32_t left = value(passes);
    count(macro, node.line).decide(left > 0);
    try {
      while (left > 0) {
        all_of(node.body, macro, level);
        take_step(macro, node.end_line);
        left =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(counts_itself ? value(passes) : left) - 1U);
        if (counts_itself) variable(passes) = left;
        count(macro, node.end_line).decide(left > 0);
      }
    } catch (const ExitFor&) {
    }
  }

  void timer(const Node& node, const MacroName& macro) {
    const std::int32_t time = value(node.command.values[0]);
    if (time < 0 && options_.chose(option("timer_negative", "execution_error"))) return fail(node, macro, 16);
    wait_for(node, macro, [this, until = now_ + std::max(time, 0)] { return now_ >= until; });
  }

  void frnet_wait(const Node& node, const MacroName& macro) {
    const auto& values = node.command.values;
    const std::int64_t channel = value(values[1]);
    const std::int64_t level = value(values[2]);
    std::int64_t time = value(values[3]);
    const bool is_variable = values[3] >= 0x7FFF0000 && values[3] <= 0x7FFF01FF;
    if (!is_variable) time = values[3];
    if (time < 0 && options_.chose(option("timer_negative", "execution_error"))) return fail(node, macro, 16);
    if (channel < 0 || channel > 15 || level < 0 || level > 1) return fail(node, macro, 16);
    const std::int64_t until = time > 0 ? now_ + time : INT64_MAX;
    wait_for(node, macro, [this, group = values[0], channel, level, until] {
      return input_is_on(group, static_cast<std::uint32_t>(channel), now_) == (level == 1) || now_ >= until;
    });
  }

  void drive(const Node& node, const MacroName& macro) {
    const auto& values = node.command.values;
    const bool is_good = value(values[1]) >= -2'000'000'000 && value(values[1]) <= 2'000'000'000;
    bool has_begun = false;
    while (left_ == 0 || (is_good && !drive_begins(values[0], now_))) {
      if (left_ > 0 && !std::exchange(has_begun, true)) ++count(macro, node.line).runs;
      advance();
    }
    take_step();
    if (!has_begun) ++count(macro, node.line).runs;
    if (!is_good) return fail(node, macro, 16);
    Command command = node.command;
    command.values[1] = static_cast<std::uint32_t>(value(values[1]));
    note(plain(command));
  }

  std::string resolved_text(const Node& node) const {
    Command command = node.command;
    const std::uint32_t speed = command.values[1];
    const bool is_variable = speed >= 0x7FFF0000 && speed <= 0x7FFF01FF;
    if (is_variable) command.values[1] = static_cast<std::uint32_t>(std::max(value(speed), 0));
    return plain(command);
  }

  std::map<MacroName, Nodes> trees_;
  Options options_;
  int budget_;
  std::int64_t end_;
  std::int64_t now_ = 0;
  int left_ = 0;
  bool in_isr_ = false;
  bool has_come_ = false;
  std::function<bool()> awaited_;
  ReturnRegister returned_[2];
};

}  // namespace understudy::interpreter::rs_m8194h::naive
