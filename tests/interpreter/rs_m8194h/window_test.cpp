// The registers of the window: the manual's frames, and each code with an error.
#include "interpreter/rs_m8194h/window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "interpreter/rs_m8194h/check.h"
#include "interpreter/rs_m8194h/text.h"
#include "tests/interpreter/rs_m8194h/printed.h"

namespace understudy::interpreter::rs_m8194h {
namespace window_test {

using Registers = std::vector<std::uint16_t>;

/// Returns a state in which the code is allowed.
State state_for(std::uint16_t code) {
  if (!is_macro_code(code)) return State::ready;
  return find_code(code)->use.in_mp ? State::mp_download : State::isr_download;
}

Fault fault_of(const Registers& registers) {
  return decode(registers, state_for(registers[0]), WordOrder::high_first).fault;
}

TEST(RsM8194hWindow, TakesEveryPrintedFrameAndGivesItBack) {
  std::size_t count = 0;
  for (const Fact& frame : printed::facts("frames")) {
    const Registers registers = printed::window_registers(frame);
    if (registers.empty()) continue;
    ++count;
    SCOPED_TRACE(frame.at("frame"));
    const Decoded decoded = decode(registers, state_for(registers[0]), WordOrder::high_first);
    EXPECT_EQ(decoded.fault, Fault::none);
    EXPECT_EQ(name_of(decoded.command.code), frame.at("name"));
    EXPECT_EQ(encode(decoded.command), registers);
  }
  EXPECT_GT(count, 200U);
}

TEST(RsM8194hWindow, WordOrderSwapsTheWordsOfEvery32Bits) {
  for (const Registers& registers : printed::window_frames()) {
    const Decoded decoded = decode(registers, state_for(registers[0]), WordOrder::high_first);
    Registers swapped = registers;
    const CommandRow& row = *find_code(registers[0]);
    std::size_t at = 1;
    for (std::size_t i = 0; i < row.parameter_count(); ++i) {
      if (row.parameters[i].registers() == 2) std::swap(swapped[at], swapped[at + 1]);
      at += static_cast<std::size_t>(row.parameters[i].registers());
    }
    EXPECT_EQ(encode(decoded.command, WordOrder::low_first), swapped);
    const Decoded again = decode(swapped, state_for(registers[0]), WordOrder::low_first);
    EXPECT_EQ(again.fault, Fault::none);
    EXPECT_EQ(again.command, decoded.command);
  }
}

TEST(RsM8194hWindow, MacroLinesComeInDownloadsOnly) {
  for (const Fact& fact : printed::facts("commands")) {
    const std::uint16_t code = printed::code_of(fact);
    const bool is_real_time = fact.at("real_time") == "1";
    const auto now = [code](State state) { return why_not_now(code, state); };
    EXPECT_EQ(now(State::ready), is_real_time ? Fault::none : Fault::macro_outside) << fact.at("name");
    const Fault in_mp = fact.at("mp") == "1" ? Fault::none : Fault::isr_in_mp;
    EXPECT_EQ(now(State::mp_download), is_real_time ? Fault::real_time_in_macro : in_mp) << fact.at("name");
    const Fault in_isr = fact.at("isr") == "1" ? Fault::none : Fault::mp_in_isr;
    EXPECT_EQ(now(State::isr_download), is_real_time ? Fault::real_time_in_macro : in_isr) << fact.at("name");
  }
}

TEST(RsM8194hWindow, FirstFaultOfTheOrderAnswers) {
  const auto fault = [](const Registers& registers, State state) {
    return decode(registers, state, WordOrder::high_first).fault;
  };
  EXPECT_EQ(fault({0x0A03}, State::mp_download), Fault::undefined_command);
  EXPECT_EQ(fault({0x0C1E, 1}, State::mp_download), Fault::undefined_command);
  EXPECT_EQ(fault({0x0A4E}, State::mp_download), Fault::real_time_in_macro);
  EXPECT_EQ(fault({0x0A4E, 0, 0}, State::ready), Fault::register_count);
  EXPECT_EQ(fault({0x0A4E, 0, 0, 0}, State::ready), Fault::parameter);
  EXPECT_EQ(fault({}, State::ready), Fault::register_count);
}

TEST(RsM8194hWindow, EachCodeWantsItsCountOfRegisters) {
  const auto allowed = printed::allowed();
  for (const Fact& fact : printed::facts("commands")) {
    SCOPED_TRACE(fact.at("name"));
    const std::uint16_t code = printed::code_of(fact);
    const auto found = allowed.find(code & 0xFF);
    Registers registers = printed::good_registers(
        code, found == allowed.end() ? std::vector<printed::Allowed>{} : found->second);
    ASSERT_EQ(registers.size(), std::stoul(fact.at("registers")));
    EXPECT_EQ(fault_of(registers), Fault::none);
    registers.push_back(0);
    EXPECT_EQ(fault_of(registers), Fault::register_count);
    registers.resize(registers.size() - 2);
    if (!registers.empty()) {
      EXPECT_EQ(fault_of(registers), Fault::register_count);
    }
  }
}

/// For each code and each of its parameters.
void for_each_parameter(auto visit) {
  const auto allowed = printed::allowed();
  for (const Fact& fact : printed::facts("commands")) {
    const std::uint16_t code = printed::code_of(fact);
    const auto found = allowed.find(code & 0xFF);
    if (found == allowed.end()) continue;
    const Registers good = printed::good_registers(code, found->second);
    for (std::size_t i = 0; i < found->second.size(); ++i) {
      SCOPED_TRACE(fact.at("name") + " " + found->second[i].name);
      visit(code, found->second[i], good, printed::place_of(found->second, i));
    }
  }
}

TEST(RsM8194hWindow, RangesEndWhereTheManualSays) {
  std::size_t count = 0;
  for_each_parameter(
      [&count](std::uint16_t code, const printed::Allowed& one, Registers registers, std::size_t at) {
        const bool is_var = one.rule == "VAR";
        const bool is_bvar = one.rule == "bVAR";
        if (!one.has_range() && !is_var && !is_bvar) return;
        const auto fault = [&](std::int64_t value) {
          printed::put(registers, at, one.registers, value);
          return fault_of(registers);
        };
        // VAR_CALCULATE has its own error, which its download detects.
        const Fault beyond = (code & 0xFF) == 0xD4 ? Fault::none : Fault::parameter;
        const bool is_side = one.name == "Lp" || one.name == "Wp";
        const bool is_radius = one.name == "Rp";
        EXPECT_EQ(fault(one.min), is_side ? Fault::parameter : Fault::none);
        EXPECT_EQ(fault(one.max), is_radius ? Fault::parameter : Fault::none);
        const std::int64_t limit = one.registers == 1 ? 0xFFFF : one.type == "U32" ? 0xFFFFFFFF : INT32_MAX;
        if (one.max < limit) {
          EXPECT_EQ(fault(one.max + 1), beyond);
        }
        if (one.type == "I32" || one.min > 0) {
          EXPECT_EQ(fault(one.min - 1), beyond);
        }
        ++count;
      });
  EXPECT_GT(count, 250U);
}

TEST(RsM8194hWindow, ListsAreTheManuals) {
  for_each_parameter([](std::uint16_t, const printed::Allowed& one, Registers registers, std::size_t at) {
    if (one.list.empty()) return;
    for (std::int64_t value = 0; value < 0x80; ++value) {
      printed::put(registers, at, one.registers, value);
      const bool is_listed = std::ranges::find(one.list, value) != one.list.end();
      EXPECT_EQ(fault_of(registers), is_listed ? Fault::none : Fault::parameter) << value;
    }
  });
}

TEST(RsM8194hWindow, AxesAreTheMasksOfTheManualsTables) {
  for_each_parameter(
      [](std::uint16_t code, const printed::Allowed& one, Registers registers, std::size_t at) {
        const bool is_setting = one.rule == "setting axes" && !is_macro_code(code);
        const bool is_mask = one.rule == "axes" || one.rule == "setting axes";
        const bool is_one = one.rule.starts_with("one axis");
        if (!is_mask && !is_one) return;
        std::set<int> taken;
        for (std::size_t i = 1; i < registers.size(); ++i) {
          if (is_one && i != at) taken.insert(registers[i]);
        }
        for (int value = 0; value <= 0x12F; ++value) {
          registers[at] = static_cast<std::uint16_t>(value);
          bool is_good = is_mask && value >= 1 && value <= one.max;
          if (is_setting && value > 0x10 && value < 0x20) is_good = true;
          if (is_one && (value == 1 || value == 2 || value == 4 || value == 8)) {
            // The others of the command are 1, 2 and so on, in its first registers.
            const auto parameters = printed::allowed().at(code & 0xFF);
            is_good = true;
            for (std::size_t i = 0; i < parameters.size(); ++i) {
              const std::size_t other = printed::place_of(parameters, i);
              if (other != at && parameters[i].rule.starts_with("one axis"))
                is_good &= registers[other] != value;
            }
          }
          if (one.rule == "one axis or 0" && value == 0) is_good = true;
          EXPECT_EQ(fault_of(registers), is_good ? Fault::none : Fault::parameter) << value;
        }
      });
}

struct JointCase {
  const char* what;
  Registers registers;
  Fault fault;
};

TEST(RsM8194hWindow, ParametersThatDependOnEachOther) {
  const JointCase kCases[] = {
      {"without nINT an ISR is any number", {0x0A98, 1, 0, 0, 0, 0, 0, 999, 21, 0, 0xFFFF}, Fault::none},
      {"with nINT it is one, or none", {0x0A98, 1, 0, 0, 0, 0, 1, 20, 0, 0, 0}, Fault::none},
      {"or a fault", {0x0A98, 1, 0, 0, 0, 0, 1, 21, 0, 0, 0}, Fault::parameter},
      {"a variable may say either", {0x0C98, 1, 0, 0, 0, 0, 0x80, 999, 0, 0, 0}, Fault::none},
      {"a line has no centre", {0x0A84, 0, 1, 0x7FFF, 0, 0x8000, 0, 0, 1, 0, 1}, Fault::none},
      {"but an end", {0x0A84, 0, 1, 0, 0, 0, 0, 0x7FFE, 0, 0, 1}, Fault::parameter},
      {"a circle has no end", {0x0A84, 0, 4, 0, 1, 0, 1, 0x7FFF, 0, 0x7FFF, 0}, Fault::none},
      {"but a centre", {0x0A84, 0, 5, 0x7FFE, 0, 0, 1, 0, 0, 0, 0}, Fault::parameter},
      {"an arc has both", {0x0A84, 0, 2, 0, 1, 0, 1, 0x7FFE, 0, 0, 0}, Fault::parameter},
      {"uneven pitch is X's", {0x0A90, 1, 1, 0, 0, 0, 5}, Fault::none},
      {"alone", {0x0A90, 2, 3, 0, 0, 0, 5}, Fault::parameter},
      {"even pitch is Y's, too", {0x0A90, 2, 2, 0, 0, 0, 5}, Fault::none},
      {"two axes in SYNC_ACTION may be one", {0x0A6E, 8, 8, 0, 0x40, 0, 2, 4, 0, 0, 0, 0, 0, 0}, Fault::none},
      {"masks trigger, too", {0x0A96, 3, 0, 1}, Fault::none},
      {"U has no output, but is taken", {0x0A73, 8, 0, 0}, Fault::none},
      {"corners that fill a side",
       {0x0A78, 1, 2, 0, 0, 0, 0, 10, 0, 12, 0, 5, 0, 1, 0, 1, 0, 1, 0, 1},
       Fault::none},
      {"corners that do not fit",
       {0x0A78, 1, 2, 0, 0, 0, 0, 10, 0, 12, 0, 6, 0, 1, 0, 1, 0, 1, 0, 1},
       Fault::parameter},
  };
  for (const JointCase& one : kCases) EXPECT_EQ(fault_of(one.registers), one.fault) << one.what;
  const Registers too_round = kCases[std::size(kCases) - 1].registers;
  EXPECT_EQ(decode(too_round, State::ready, WordOrder::high_first,
                   Options{option("rectangle_radius", "drawn_shorter")})
                .fault,
            Fault::none);
}

TEST(RsM8194hWindow, ReferencesStandInMacroLinesOnly) {
  std::size_t count = 0;
  for_each_parameter(
      [&](std::uint16_t code, const printed::Allowed& one, Registers registers, std::size_t at) {
        if (!one.has_range() && one.rule != "any") return;
        const bool is_structure = one.name == "mpNo" || one.name == "labelNo";
        const bool takes = is_macro_code(code) && !is_structure;
        const std::int64_t reference = one.registers == 1 ? 0x80 + 127 : 0x7FFF0000 + 511;
        printed::put(registers, at, one.registers, reference);
        if (one.rule == "any" || one.max > reference) {
          EXPECT_EQ(fault_of(registers), Fault::none);
        } else {
          EXPECT_EQ(fault_of(registers), takes ? Fault::none : Fault::parameter);
        }
        ++count;
      });
  EXPECT_GT(count, 200U);
}

TEST(RsM8194hWindow, FewLinesTakeReferencesIfChosen) {
  const Options options{option("references", "exception_3")};
  struct Case {
    const char* line;
    std::optional<std::size_t> bad;
  };
  const Case kCases[] = {
      {"FRNET_OUT bVAR0 VAR1", std::nullopt},
      {"SET_VAR VAR1 VAR2", std::nullopt},
      {"FOR VAR1", std::nullopt},
      {"IF VAR1 < VAR2", std::nullopt},
      {"TIMER VAR1", std::nullopt},
      {"VAR_CALCULATE VAR1 + VAR2 VAR3", std::nullopt},
      {"FIXED_MOVE X VAR1", 1},
      {"FIXED_MOVE X 1", std::nullopt},
      {"SET_V X VAR1", 1},
      {"LINE_2D 1 VAR1", 1},
      {"ABS_SET_POSITION X VAR511", 1},
      {"HELIX_3D X Y Z 0 1 2 3 4 VAR0", 8},
  };
  for (const Case& each : kCases) {
    const ParsedCommand parsed = parse_command(std::string("RSM_MACRO_") + each.line);
    ASSERT_TRUE(parsed.command) << each.line;
    EXPECT_EQ(bad_parameter(*parsed.command), std::nullopt) << each.line;
    EXPECT_EQ(bad_parameter(*parsed.command, options), each.bad) << each.line;
  }
}

TEST(RsM8194hWindow, RectanglesEndEarlierIfChosen) {
  const Options options{option("rectangle_ends", "200000000")};
  constexpr std::size_t kSides[] = {5, 6, 7};  // Lp, Wp, Rp
  for (const std::size_t side : kSides) {
    for (const std::int64_t length : {200'000'000, 200'000'001, 2'000'000'000}) {
      Command command = *parse_command("RSM_RECTANGLE X Y 0 0 0 1000 1000 10 1 1 1 1").command;
      if (side == 7) command.values[5] = command.values[6] = 200'000'000;
      Options loose = options;
      loose.choose(option("rectangle_radius", "drawn_shorter"));
      command.values[side] = static_cast<std::uint32_t>(length);
      const bool is_bad = length > 200'000'000;
      EXPECT_EQ(bad_parameter(command, loose), is_bad ? std::optional(side) : std::nullopt) << length;
      loose.choose(option("rectangle_ends", "2000000000"));
      EXPECT_EQ(bad_parameter(command, loose), std::nullopt);
    }
  }
}

TEST(RsM8194hWindow, FrnetWaitMayHaveOneRegisterLessIfChosen) {
  const Options options{option("frnet_wait_registers", "8_or_7_with_a_time_of_one")};
  const Registers full = {macro_code(Verb::frnet_wait), 8, 0, 1, 0, 1, 2, 3};
  ASSERT_EQ(row_of(Verb::frnet_wait).registers(), 8);
  for (std::size_t count = 1; count <= 9; ++count) {
    Registers sent = full;
    sent.resize(count, 0);
    for (const bool may : {false, true}) {
      const Decoded decoded =
          decode(sent, State::mp_download, WordOrder::high_first, may ? options : Options{});
      const bool is_good = count == 8 || (may && count == 7);
      EXPECT_EQ(decoded.fault, is_good ? Fault::none : Fault::register_count) << count << may;
      if (!is_good) continue;
      EXPECT_EQ(decoded.command.values[3], count == 8 ? 0x20003U : 2U);
    }
  }
}

TEST(RsM8194hWindow, CodeOfAMisprintIsItsCommandIfChosen) {
  const Registers sent = {0x0CB2, 1, 2, 0, 0, 300, 0, 18000, 7, 0xA120};
  EXPECT_EQ(decode(sent, State::mp_download, WordOrder::high_first).fault, Fault::undefined_command);
  const Options options{option("code_0cb2", "that_command")};
  const Decoded decoded = decode(sent, State::mp_download, WordOrder::high_first, options);
  EXPECT_EQ(decoded.fault, Fault::none);
  EXPECT_EQ(text_of(decoded.command), "RSM_MACRO_MIX_2D_INITIAL X Y 0 300 18000 500000");
  EXPECT_EQ(encode(decoded.command, WordOrder::high_first, options)[0], 0x0C82);
  EXPECT_EQ(decode(sent, State::ready, WordOrder::high_first, options).fault, Fault::macro_outside);
}

TEST(RsM8194hWindow, FaultsHaveTheReasonsOfTheManual) {
  struct Case {
    Fault fault;
    int first_list;
    int second_list;
    int exception;
  };
  constexpr Case kCases[] = {
      {Fault::function_code, 1, 1, 1},      {Fault::parameter, 2, 2, 3},
      {Fault::undefined_command, 2, 3, 3},  {Fault::macro_memory, 3, 4, 3},
      {Fault::mp_in_isr, 4, 5, 3},          {Fault::isr_in_mp, 5, 6, 3},
      {Fault::real_time_in_macro, 6, 7, 3}, {Fault::macro_outside, 7, 8, 3},
      {Fault::if_too_deep, 0xB1, 0xB1, 3},  {Fault::goto_without_label, 0xBC, 0xBC, 3},
      {Fault::half_of_pair, 0xC0, 0xC0, 2}, {Fault::fifo_full, 0xC1, 0xC1, 6},
      {Fault::no_module, 0xC2, 0xC2, 4},    {Fault::macro_runs, 0xC3, 0xC3, 6},
      {Fault::register_count, 2, 2, 3},     {Fault::address, 2, 2, 2},
  };
  for (const Case& one : kCases) {
    const FaultRow& row = row_of(one.fault);
    EXPECT_EQ(row.reason_4_16_2, one.first_list) << row.meaning;
    EXPECT_EQ(row.reason_12_1_12, one.second_list) << row.meaning;
    EXPECT_EQ(row.exception, one.exception) << row.meaning;
  }
}

}  // namespace window_test
}  // namespace understudy::interpreter::rs_m8194h
