// Commands as text and back: without loss, and with the places of errors.
#include "interpreter/rs_m8194h/text.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <string>
#include <vector>

#include "interpreter/rs_m8194h/window.h"
#include "tests/interpreter/rs_m8194h/printed.h"

namespace understudy::interpreter::rs_m8194h {
namespace text_test {

std::string error_of(const std::string& text) {
  const ParsedCommand parsed = parse_command(text);
  return parsed.error ? to_string(*parsed.error) : "none";
}

void expect_back(const Command& command) {
  const std::string text = text_of(command);
  const ParsedCommand parsed = parse_command(text, Options{option("rectangle_radius", "drawn_shorter")});
  ASSERT_TRUE(parsed.command) << text << ": " << to_string(*parsed.error);
  EXPECT_EQ(*parsed.command, command) << text;
}

TEST(RsM8194hText, IsWhatPeopleRead) {
  const std::pair<std::vector<std::uint16_t>, std::string> kCases[] = {
      {{0x0A4E, 0xF, 0, 10000}, "RSM_FIXED_MOVE XYZU 10000"},
      {{0x0C4E, 1, 0xFFFF, 0xFC18}, "RSM_MACRO_FIXED_MOVE X -1000"},
      {{0x0C4E, 1, 0x7FFF, 5}, "RSM_MACRO_FIXED_MOVE X VAR5"},
      {{0x0A10, 0x13, 1}, "RSM_SET_NHOME INITIAL_XY 1"},
      {{0x0A5A, 1, 8, 0}, "RSM_AXIS_ASSIGN X U 0"},
      {{0x0A23, 0xE4, 100}, "RSM_WRITE_bVAR bVAR100 100"},
      {{0x0A25, 0x7FFF, 100, 0, 7}, "RSM_WRITE_VAR VAR100 7"},
      {{0x0A27, 0, 1500, 0, 0, 0x3FC0, 0}, "RSM_WRITE_MD MD1500 0 1.5"},
      {{0x0C33, 0x80, 0x7FFF, 1}, "RSM_MACRO_FRNET_OUT bVAR0 VAR1"},
      {{0x0CD7, 0x7FFF, 1, 0x3D3C, 0x7FFF, 2}, "RSM_MACRO_IF VAR1 <= VAR2"},
      {{0x0CD7, 0x7FFF, 1, 0x2100, 0, 2}, "RSM_MACRO_IF VAR1 != 2"},
      {{0x0CD4, 0x7FFF, 1, 0x7C, 0x7FFF, 2, 0x7FFF, 3}, "RSM_MACRO_VAR_CALCULATE VAR1 | VAR2 VAR3"},
      {{0x0CD6}, "RSM_MACRO_NEXT"},
  };
  for (const auto& [registers, text] : kCases) {
    const State state = is_macro_code(registers[0]) ? State::mp_download : State::ready;
    const Decoded decoded = decode(registers, state, WordOrder::high_first);
    EXPECT_EQ(decoded.fault, Fault::none) << text;
    EXPECT_EQ(text_of(decoded.command), text);
    expect_back(decoded.command);
  }
}

TEST(RsM8194hText, OfEveryPrintedFrameIsReadBack) {
  for (const auto& registers : printed::window_frames()) {
    Command command;
    ASSERT_EQ(read_registers(registers, WordOrder::high_first, command), Fault::none);
    expect_back(command);
  }
}

/// For any registers: what decode() accepts is read back from its text.
TEST(RsM8194hText, OfRandomCommandsIsReadBack) {
  std::mt19937 random(20);  // NOLINT(cert-msc51-cpp): the same in every run
  const auto allowed = printed::allowed();
  int taken = 0;
  for (const Fact& fact : printed::facts("commands")) {
    const std::uint16_t code = printed::code_of(fact);
    const auto found = allowed.find(code & 0xFF);
    if (found == allowed.end()) continue;
    const State state = !is_macro_code(code)         ? State::ready
                        : find_code(code)->use.in_mp ? State::mp_download
                                                     : State::isr_download;
    for (int i = 0; i < 300; ++i) {
      auto registers = printed::good_registers(code, found->second);
      const std::size_t which = random() % found->second.size();
      const std::size_t at = printed::place_of(found->second, which);
      constexpr std::uint32_t kBits[] = {0, 0x7FFF0000, 0x80, 0xFFFFFFFF, 0x3C00, 0x21};
      const std::uint32_t value =
          random() % 2 == 0 ? random() >> random() % 32 : kBits[random() % 6] + random() % 4;
      printed::put(registers, at, found->second[which].registers, value);
      const Decoded decoded = decode(registers, state, WordOrder::high_first);
      if (decoded.fault != Fault::none || bad_operand(decoded.command)) continue;
      expect_back(decoded.command);
      ++taken;
    }
  }
  EXPECT_GT(taken, 20000);
}

TEST(RsM8194hText, RealNumbersKeepEveryBit) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same in every run
  std::vector<std::uint32_t> bits = {0,          0x80000000, 1,          0x007FFFFF,
                                     0x7F7FFFFF, 0x7F800000, 0xFF800000, 0x7FC00001};
  for (int i = 0; i < 100000; ++i) bits.push_back(static_cast<std::uint32_t>(random()));
  for (const std::uint32_t value : bits) {
    Command command{.code = real_time_code(Verb::write_md)};
    command.values = {1500, 0, value};
    expect_back(command);
  }
}

TEST(RsM8194hText, TakesWhatTheManualWrites) {
  const std::pair<std::string, std::string> kCases[] = {
      {"rsm_fixed_move axis_xyzu, 0x10", "RSM_FIXED_MOVE XYZU 16"},
      {"RSM_FIXED_MOVE UZYX 1 ; a remark", "RSM_FIXED_MOVE XYZU 1"},
      {"RSM_FIXED_MOVE 0xF 1", "RSM_FIXED_MOVE XYZU 1"},
      {"RSM_SET_NHOME initial_u 0", "RSM_SET_NHOME INITIAL_U 0"},
      {"RSM_WRITE_MD 12 5 0", "RSM_WRITE_MD MD12 5 0"},
      {"RSM_MACRO_SET_VAR var1 bvar1", ""},
      {"RSM_MACRO_FRNET_OUT BVAR1 0xFFFF", "RSM_MACRO_FRNET_OUT bVAR1 65535"},
  };
  for (const auto& [text, canonical] : kCases) {
    const ParsedCommand parsed = parse_command(text);
    EXPECT_EQ(parsed.command ? text_of(*parsed.command) : "", canonical) << text;
  }
}

TEST(RsM8194hText, ErrorsHaveAPlaceAndWhatIsExpected) {
  EXPECT_EQ(error_of(""), "1:1: is empty; expected a command");
  EXPECT_EQ(error_of("  RSM_FIXED_MOV X 1"),
            "1:3: 'RSM_FIXED_MOV' is not a command; the nearest is 'RSM_FIXED_MOVE'");
  EXPECT_EQ(error_of("RSM_FIXED_MOVE X"), "1:16: RSM_FIXED_MOVE has 1 parameters; expected axis, data");
  EXPECT_EQ(error_of("RSM_FIXED_MOVE X 1 2"), "1:20: RSM_FIXED_MOVE has 3 parameters; expected axis, data");
  EXPECT_EQ(error_of("RSM_SET_PULSE_MODE X 6"), "1:22: parameter nMode: '6' does not fit; expected 0 to 5");
  EXPECT_EQ(error_of("RSM_FIXED_MOVE XX 1"),
            "1:16: parameter axis: 'XX' does not fit; expected axes, X to XYZU");
  EXPECT_EQ(error_of("RSM_FIXED_MOVE INITIAL_X 1"),
            "1:16: parameter axis: 'INITIAL_X' does not fit; expected axes, X to XYZU");
  EXPECT_EQ(error_of("RSM_AXIS_ASSIGN X X 0"),
            "1:19: parameter axis2: 'X' does not fit; expected X, Y, Z or U, each at most once");
  EXPECT_EQ(error_of("RSM_FIXED_MOVE X VAR1"),
            "1:18: parameter data: 'VAR1' does not fit; expected -2000000000 to 2000000000");
  EXPECT_EQ(
      error_of("RSM_MACRO_FIXED_MOVE X VAR512"),
      "1:24: parameter data: 'VAR512' does not fit; expected -2000000000 to 2000000000, or VAR0 to VAR511");
  EXPECT_EQ(error_of("RSM_MACRO_IF VAR1 <> 2"),
            "1:19: parameter Operator: '<>' does not fit; expected one of < <= > >= == !=");
  EXPECT_EQ(error_of("RSM_MACRO_VAR_CALCULATE 1 + 2 3"),
            "1:31: parameter varNo2: '3' does not fit; expected VAR0 to VAR511");
  EXPECT_EQ(error_of("RSM_INTFACTOR_DISABLE X 8"),
            "1:25: parameter nINT: '8' does not fit; expected one of 0, 1, 2, 3, 4, 5, 6, 7, 10");
  EXPECT_EQ(error_of("RSM_WRITE_MD MD1 99999999999 0"),
            "1:18: parameter ldata: '99999999999' does not fit; expected -2147483648 to 2147483647");
}

TEST(RsM8194hText, WhatAChoiceRefusesIsReportedAsThat) {
  struct Case {
    const char* text;
    Options options;
    const char* error;
  };
  const Case kCases[] = {
      {"RSM_MACRO_FIXED_MOVE X VAR1",
       {option("references", "exception_3")},
       "1:24: parameter data: 'VAR1' is refused by a choice of the bench; expected a constant"},
      {"RSM_RECTANGLE X Y 0 0 0 300000000 1000 10 1 1 1 1",
       {option("rectangle_ends", "200000000")},
       "1:25: parameter Lp: '300000000' is refused by a choice of the bench; expected another value"},
      {"RSM_SET_V X 4000001",
       {option("speed_ends", "exception_3")},
       "1:13: parameter data: '4000001' is refused by a choice of the bench; expected another value"},
      {"RSM_FIXED_MOVE X 2000000001",
       {option("zero_move", "exception_3")},
       "1:18: parameter data: '2000000001' does not fit; expected -2000000000 to 2000000000"},
  };
  for (const Case& each : kCases) {
    EXPECT_TRUE(parse_command(each.text).command || each.options.chose(option("zero_move", "exception_3")))
        << each.text;
    const ParsedCommand parsed = parse_command(each.text, each.options);
    ASSERT_TRUE(parsed.error) << each.text;
    EXPECT_EQ(to_string(*parsed.error), each.error);
  }
}

TEST(RsM8194hText, TheNearestNameIsOfTheSameThing) {
  for (const auto& [word, says] : std::vector<std::pair<std::string, std::string>>{
           {"RSM_MACRO_WAIT 10", "expected one such as RSM_MACRO_FRNET_WAIT, RSM_MACRO_STOP_WAIT"},
           {"RSM_MACRO_CALL 3", "expected one such as RSM_MACRO_MP_CALL"},
           {"RSM_MACRO_ENDIF", "the nearest is 'RSM_MACRO_END_IF'"},
           {"MACRO_TIMER 3", "the nearest is 'RSM_MACRO_TIMER'"},
           {"TIMER 3", "the nearest is 'RSM_MACRO_TIMER'"}}) {
    const std::string error = error_of(word);
    EXPECT_NE(error.find(says), std::string::npos) << error;
  }
}

}  // namespace text_test
}  // namespace understudy::interpreter::rs_m8194h
