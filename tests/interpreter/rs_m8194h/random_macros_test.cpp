// Random macros in the product and in another implementation: the same course, to the tick, and the same
// variables. A difference is printed as text that can be loaded.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "interpreter/rs_m8194h/download.h"
#include "interpreter/rs_m8194h/listing.h"
#include "interpreter/rs_m8194h/operators.h"
#include "interpreter/rs_m8194h/run.h"
#include "tests/interpreter/rs_m8194h/naive_macros.h"
#include "tests/sanitized.h"

namespace understudy::interpreter::rs_m8194h {
namespace random_macros_test {

class World : public Machine {
 public:
  const Macro* macro(const MacroName& name) const override {
    const auto found = macros.find(name);
    return found == macros.end() ? nullptr : &found->second;
  }
  std::int32_t variable(std::size_t number) const override { return variables.at(number); }
  void set_variable(std::size_t number, std::int32_t value) override { variables.at(number) = value; }
  std::uint8_t byte_variable(std::size_t) const override { return 0; }
  std::int32_t read(const Command& command) const override {
    return naive::reading(text_of(command), now_ms);
  }
  bool stand(std::uint32_t axes) const override { return naive::axes_stand(axes, now_ms); }
  bool frnet_input(std::uint32_t group, std::uint32_t channel) const override {
    return naive::input_is_on(group, channel, now_ms);
  }
  Took carry_out(const Command& command) override {
    const bool waits = command.row().use.starts_motion && !naive::drive_begins(command.values[0], now_ms);
    if (waits) return Took::waits;
    note(naive::plain(command));
    return Took::done;
  }
  int take_isr() override {
    if (isrs.empty() || isrs.front().first > now_ms) return 0;
    const int number = isrs.front().second;
    isrs.erase(isrs.begin());
    return number;
  }
  void mp_ended() override { note("end"); }
  void terminated() override {
    isrs.clear();
    note("terminated");
  }
  void report(const ExecutionFault& fault) override {
    note("fault " + std::to_string(row_of(fault.fault).download_error) + " " + to_string(fault.macro) +
         " line " + std::to_string(fault.line));
  }
  void note(const std::string& what) { log.push_back(std::to_string(now_ms) + " " + what); }

  std::map<MacroName, Macro> macros;
  std::array<std::int32_t, kVariableCount> variables{};
  std::vector<std::pair<std::int64_t, int>> isrs;
  std::int64_t now_ms = 0;
  std::vector<std::string> log;
};

class RandomMacros {
 public:
  explicit RandomMacros(unsigned seed) : random_(seed) {}

  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  bool is_one_in(int count) { return below(count) == 0; }

  Macro make(const MacroName& name, int max_lines) {
    Download download{.name = name};
    const int count = 1 + below(max_lines);
    for (int i = 0; i < count; ++i) {
      const Command command = any_line(name.is_isr);
      const bool is_allowed = name.is_isr ? command.row().use.in_isr : command.row().use.in_mp;
      if (is_allowed) add(download, command);  // lines that do not fit here are omitted
    }
    for (Blocks open = blocks_behind(download.lines); !open.empty(); open = blocks_behind(download.lines)) {
      add(download, line(open.back().opener == Verb::if_ ? Verb::end_if : Verb::next));
    }
    for (std::uint32_t label = 0; label < 4 && !name.is_isr; ++label)
      add(download, line(Verb::label, {label}));
    add(download, line(Verb::set_var, {variable(9), 1}));  // another test covers waits in the last line
    download.fault = Fault::none;
    Closed closed = close(download);
    EXPECT_TRUE(closed.macro);
    return closed.macro.value_or(Macro{});
  }

 private:
  static Command line(Verb verb, std::vector<std::uint32_t> values = {}) {
    Command command{.code = macro_code(verb)};
    std::ranges::copy(values, command.values.begin());
    return command;
  }
  static std::uint32_t variable(int number) { return 0x7FFF0000U + static_cast<std::uint32_t>(number); }
  std::uint32_t any_variable() { return variable(below(6)); }
  std::uint32_t small(int min, int max) { return static_cast<std::uint32_t>(min + below(max - min + 1)); }
  std::uint32_t operand() {
    if (is_one_in(2)) return any_variable();
    return is_one_in(12) ? small(1'999'999'990, 2'000'000'000) : small(-4, 9);
  }
  std::uint32_t axes() { return small(1, 15); }

  Command any_line(bool is_isr) {
    switch (below(22)) {
      case 0: return line(Verb::set_var, {any_variable(), operand()});
      case 1: return line(Verb::set_rvar, {any_variable()});
      case 2:
      case 3: {
        const auto sign = static_cast<std::uint32_t>(kArithmetic[static_cast<std::size_t>(below(6))]);
        return line(Verb::var_calculate, {operand(), sign, operand(), any_variable()});
      }
      case 4:
      case 5:
      case 6: {
        const ComparisonRow& row = kComparisons[static_cast<std::size_t>(below(6))];
        return line(Verb::if_, {operand(), row.codes[0], operand()});
      }
      case 7: return line(Verb::else_);
      case 8: return line(Verb::end_if);
      case 9: return line(Verb::for_, {is_one_in(3) ? any_variable() : small(-1, 4)});
      case 10: return line(is_one_in(3) ? Verb::exit_for : Verb::next);
      case 11: return line(Verb::goto_, {small(0, 3)});
      case 12: return line(Verb::label, {small(0, 3)});
      case 13: return line(Verb::mp_call, {small(131, 134)});  // 134 does not exist
      case 14: return line(Verb::timer, {is_one_in(4) ? any_variable() : small(0, 5)});
      case 15: return line(Verb::stop_wait, {axes()});
      case 16: {
        const std::uint32_t time = is_one_in(4) ? any_variable() : small(0, 12);
        const std::uint32_t channel = is_one_in(6) ? any_variable() : small(0, 15);
        return line(Verb::frnet_wait, {small(8, 15), channel, small(0, 1), time});
      }
      case 17: return line(is_one_in(2) ? Verb::get_error : Verb::get_lp, {});
      case 18: return line(Verb::fixed_move, {axes(), operand()});
      case 19: return line(Verb::set_v, {axes(), is_one_in(2) ? any_variable() : small(0, 4000)});
      case 20: return line(is_one_in(8) && !is_isr ? Verb::exit_macro : Verb::drv_hold, {});
      default: return line(is_one_in(40) ? Verb::mp_terminate : Verb::drv_start, {});
    }
  }

  std::mt19937 random_;
};

/// GET_LP, DRV_HOLD and DRV_START were generated without an axis.
void give_axes(Macro& macro) {
  for (Command& command : macro.lines) {
    const bool has_axes =
        command.row().parameter_count() > 0 && command.row().parameters[0].kind == Kind::axes;
    if (has_axes && command.values[0] == 0) command.values[0] = 1;
  }
}

std::string pasted(const World& world) {
  Listing listing;
  for (const auto& [name, macro] : world.macros) listing.macros.push_back({name, macro});
  std::string text = text_of(listing);
  for (const auto& [when, number] : world.isrs) {
    text += "; at " + std::to_string(when) + " ms ISR" + std::to_string(number) + "\n";
  }
  return text;
}

TEST(RsM8194hRandomMacros, RunAsAnotherEvaluatorSays) {
  const int programs = fewer_if_sanitized(10'000, 4);
  constexpr int kEnd = 250;
  std::size_t events = 0;
  int ended = 0;
  for (unsigned seed = 0; seed < static_cast<unsigned>(programs); ++seed) {
    RandomMacros random(seed);
    World world;
    for (int number = 131; number < 134; ++number) {
      world.macros[{false, number}] = random.make({false, number}, number == 131 ? 40 : 14);
    }
    for (int number = 16; number < 18; ++number)
      world.macros[{true, number}] = random.make({true, number}, 12);
    for (auto& [name, macro] : world.macros) give_axes(macro);
    for (std::int64_t when = 1; random.below(3) != 0; when += 1 + random.below(20)) {
      world.isrs.emplace_back(when, 16 + random.below(3));  // ISR18 does not exist
    }
    constexpr int kBudgets[] = {1, 2, 8, 32};
    const int budget = kBudgets[random.below(4)];
    Options options;
    for (const Options::Named& one :
         {option("return_registers", "one_for_both"), option("return_register_keeps", "execution_error"),
          option("timer_negative", "execution_error"), option("call_too_deep", "ends_the_macro")}) {
      if (random.is_one_in(4)) options.choose(one);
    }
    const std::string text = pasted(world);

    naive::Evaluator evaluator(world.macros, options, budget, kEnd);
    evaluator.isrs = world.isrs;
    evaluator.run(131);

    ProgramCounts counts;
    world.set_watch(&counts);
    Execution execution;
    start_mp(execution, 131, 1, world);
    while (execution.mp.is_alive() && world.now_ms < kEnd) {
      ++world.now_ms;
      run_tick(execution, world.now_ms, budget, false, options, world);
      ASSERT_TRUE(is_sound(execution, world)) << "seed " << seed << "\n" << text;
    }
    ended += execution.mp.is_alive() ? 0 : 1;
    events += world.log.size();
    ASSERT_EQ(world.log, evaluator.log) << "seed " << seed << ", " << budget << " lines a tick\n" << text;
    ASSERT_EQ(world.variables, evaluator.variables) << "seed " << seed << "\n" << text;
    ASSERT_EQ(counts.lines, evaluator.counts) << "seed " << seed << "\n" << text;
    const ParsedListing again = parse_listing(text);
    ASSERT_TRUE(again.errors.empty()) << text;
    for (const ListedMacro& listed : again.listing.macros)
      ASSERT_EQ(listed.macro, world.macros[listed.name]) << text;
  }
  EXPECT_GT(events, static_cast<std::size_t>(programs) * 10);
  EXPECT_GT(ended, programs / 3);
}

}  // namespace random_macros_test
}  // namespace understudy::interpreter::rs_m8194h
