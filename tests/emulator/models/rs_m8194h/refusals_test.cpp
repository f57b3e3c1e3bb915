// Refused requests, with their exceptions, and the reasons that input 102 then shows (2.2, 4.16.2, 12.1.12).
#include <gtest/gtest.h>

#include "interpreter/rs_m8194h/commands.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace refusals_test {

struct Case {
  const char* what;
  std::vector<std::string_view> before;
  const char* request;
  const char* reply;
  int reason;
};

const Case kCases[] = {
    {"an unknown function", {}, "07", "87 01", 1},
    {"an address beyond the table", {}, "03 1F A5 00 01", "83 02", 2},
    {"a write to what can only be read", {}, "10 00 6A 00 02 04 00 00 00 01", "90 02", 2},
    {"a servo coil", {}, "05 00 80 FF 00", "85 02", 2},
    {"a read of the window", {}, "03 1F 40 00 01", "83 02", 2},
    {"parameters without the code", {}, "10 1F 41 00 01 02 00 01", "90 02", 2},
    {"the second word of a pair", {}, "04 00 1B 00 02", "84 02", 0xC0},
    {"half of a pair", {}, "04 00 1A 00 01", "84 02", 0xC0},
    {"FC6 on half of a pair", {}, "06 00 5A 00 01", "86 02", 0xC0},
    {"an undefined command", {}, "10 1F 40 00 01 02 0A 66", "90 03", 2},
    {"a code of the missing class", {}, "10 1F 40 00 04 08 0C 1E 00 01 00 00 00 01", "90 03", 2},
    {"a register too few", {}, "10 1F 40 00 03 06 0A 4E 00 01 00 00", "90 03", 2},
    {"a register too many", {}, "10 1F 40 00 05 0A 0A 4E 00 01 00 00 00 01 00 00", "90 03", 2},
    {"no axis", {}, "10 1F 40 00 04 08 0A 4E 00 00 00 00 00 01", "90 03", 2},
    {"an INITIAL axis where none belongs", {}, "10 1F 40 00 04 08 0A 4E 00 11 00 00 00 01", "90 03", 2},
    {"a mode outside its list", {}, "10 1F 40 00 03 06 0A 0C 00 01 00 06", "90 03", 2},
    {"CALL_MP of a number that is not one", {}, "06 00 08 00 9E", "86 03", 2},
    {"a position out of range", {}, "10 00 5A 00 02 04 77 35 94 01", "90 03", 2},
    {"a macro line outside a download", {}, "10 1F 40 00 01 02 0C D6", "90 03", 7},
    {"a real-time command in a download", {"RSM_MP_CREATE 1"}, "10 1F 40 00 01 02 0A 0B", "90 03", 6},
    {"a counter's write in a download", {"RSM_MP_CREATE 1"}, "10 00 5A 00 02 04 00 00 00 01", "90 03", 6},
    {"CALL_MP in a download", {"RSM_MP_CREATE 1"}, "06 00 08 00 01", "86 03", 6},
    {"an MP command in an ISR", {"RSM_MP_ISR_CREATE 1"}, "10 1F 40 00 02 04 0C B7 00 01", "90 03", 4},
    {"an ISR command in an MP", {"RSM_MP_CREATE 1"}, "10 1F 40 00 01 02 0C CE", "90 03", 5},
    {"NEXT without FOR", {"RSM_MP_CREATE 1"}, "10 1F 40 00 01 02 0C D6", "90 03", 0xB7},
};

TEST(RsM8194hRefusals, EachHasItsExceptionAndItsReason) {
  for (const Case& row : kCases) {
    SCOPED_TRACE(row.what);
    OneRsm rsm;
    for (const std::string_view command : row.before) rsm.send(command);
    EXPECT_EQ(rsm.ask(row.request), row.reply);
    EXPECT_EQ(rsm.get("IllegalFuncErr"), row.reason);
    // Valid requests do not change the reason.
    EXPECT_EQ(rsm.ask("04 00 47 00 01"), "04 02 00 1E");
    EXPECT_EQ(rsm.get("IllegalFuncErr"), row.reason);
  }
}

TEST(RsM8194hRefusals, WithoutTheModuleOnlyItsOwnWordsAnswer) {
  OneRsm rsm({.dip = {{"NO_I8094H", true}}});
  struct Row {
    const char* request;
    const char* reply;
  };
  constexpr Row kRows[] = {
      {"04 00 1A 00 02", "84 04"},
      {"04 00 52 00 02", "04 04 03 00 00 00"},
      {"04 00 51 00 01", "04 02 00 00"},
      {"04 00 54 00 02", "04 04 00 00 00 00"},
      {"04 00 57 00 01", "04 02 00 00"},
      {"04 00 64 00 01", "04 02 00 00"},
      {"04 00 65 00 01", "84 04"},
      {"04 00 66 00 01", "04 02 00 C2"},
      {"01 00 00 00 01", "81 04"},
      {"02 00 00 00 01", "82 04"},
      {"06 00 0E 00 01", "06 00 0E 00 01"},
      {"03 00 14 00 02", "03 04 00 00 00 00"},
      {"03 00 80 00 01", "83 04"},
      {"10 1F 40 00 01 02 0A 0B", "90 04"},
      {"04 00 6E 00 05", "04 0A 00 00 00 00 00 00 00 00 00 00"},
  };
  for (const Row& row : kRows) EXPECT_EQ(rsm.ask(row.request), row.reply) << row.request;
  EXPECT_EQ(rsm.get("IllegalFuncErr"), 0xC2);
}

TEST(RsM8194hRefusals, EveryCodeWantsItsNumberOfRegisters) {
  OneRsm rsm;
  for (const lang::CommandRow& row : lang::kCommands) {
    if (row.real_time_name.empty()) continue;
    const auto words = static_cast<std::size_t>(row.registers());
    for (const std::size_t count : {words - 1, words + 1}) {
      if (count == 0) continue;
      world::Words request(count, 1);
      request[0] = lang::real_time_code(row.verb);
      EXPECT_EQ(rsm.ask(world::write_request(kWindow, request)), "90 03")
          << row.real_time_name << " " << count;
      EXPECT_EQ(rsm.get("IllegalFuncErr"), 2);
    }
  }
  EXPECT_EQ(rsm.positions(), (std::vector<Value>{0, 0, 0, 0}));
  EXPECT_TRUE(rsm.rests());
}

TEST(RsM8194hRefusals, OnlyListedCodesExist) {
  OneRsm rsm;
  int codes = 0;
  for (unsigned code = 0; code <= 0xFFFF; ++code) {
    const bool is_listed = lang::find_code(static_cast<std::uint16_t>(code)) != nullptr;
    codes += is_listed ? 1 : 0;
    if (is_listed) continue;
    ASSERT_EQ(rsm.ask(world::write_request(kWindow, world::Words{static_cast<std::uint16_t>(code)})),
              "90 03");
  }
  EXPECT_EQ(codes, 229);
}

TEST(RsM8194hRefusals, TheInitSwitchMakesTheBoxDeaf) {
  OneRsm rsm({.dip = {{"INIT", true}}});
  EXPECT_EQ(rsm.device().modbus()->addressing(1), Addressing::ignore);
  OneRsm runs;
  EXPECT_EQ(runs.device().modbus()->addressing(1), Addressing::execute_and_reply);
  EXPECT_EQ(runs.device().modbus()->addressing(2), Addressing::ignore);
  EXPECT_EQ(runs.device().modbus()->addressing(0), Addressing::execute_silently);
}

TEST(RsM8194hRefusals, FirmwaresShowTheirVersions) {
  OneRsm old({.firmware = 200});
  EXPECT_EQ(old.get("RSM_FIRMWARE"), 0x02000000);
  EXPECT_EQ(old.get("I8094H_FIRMWARE"), 0x02210201);
  OneRsm later;
  EXPECT_EQ(later.get("RSM_FIRMWARE"), 0x03000000);
  EXPECT_EQ(later.get("I8094H_FIRMWARE"), 0x02210300);
}

/// Reasons 4 to 7, whatever their exception is; other reasons keep theirs.
TEST(RsM8194hRefusals, ExceptionOfTheStateIsOfItsReasonsAlone) {
  struct StateCase {
    const char* state;  // a command that leads to this state, and one that leads back
    const char* back;
    const char* sent;
    Value reason;
    bool is_of_state;
  };
  const StateCase kStateCases[] = {
      {nullptr, nullptr, "RSM_MACRO_SET_V X 1", 7, true},
      {"RSM_MP_CREATE 1", "RSM_MACRO_MP_CLOSE", "RSM_SET_V X 1", 6, true},
      {"RSM_MP_CREATE 1", "RSM_MACRO_MP_CLOSE", "RSM_MACRO_MP_ISR_CLOSE", 5, true},
      {"RSM_MP_ISR_CREATE 1", "RSM_MACRO_MP_ISR_CLOSE", "RSM_MACRO_STOP_SLOWLY X", 4, true},
      {"RSM_MP_CREATE 1", "RSM_MACRO_MP_CLOSE", "RSM_MACRO_NEXT", 0xB7, false},
  };
  for (const bool is_busy : {false, true}) {
    OneRsm rsm({.choices = {{"state_exception", is_busy ? "exception_6" : "exception_3"}}});
    for (const StateCase& each : kStateCases) {
      if (each.state != nullptr) rsm.send(each.state);
      EXPECT_EQ(rsm.exception(each.sent), is_busy && each.is_of_state ? 6 : 3) << each.sent;
      EXPECT_EQ(rsm.get("IllegalFuncErr"), each.reason) << each.sent;
      if (each.back != nullptr) rsm.send(each.back);
    }
    EXPECT_EQ(rsm.ask("10 1F 40 00 01 02 0A FF"), "90 03") << "undefined";
    EXPECT_EQ(rsm.ask("03 01 2D 00 01"), "83 02") << "half of VAR0";
  }
}

}  // namespace refusals_test
}  // namespace understudy::emulator::models::rs_m8194h
