// Every error of a download at the device: the replies to the lines and to CLOSE, what inputs 110 to 114 and
// 102 then show, and that the old macro stays (5.2, 12.1.13).
#include <gtest/gtest.h>

#include <sstream>

#include "interpreter/rs_m8194h/commands.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"

namespace understudy::emulator::models::rs_m8194h {
namespace download_errors_test {

using Lines = std::vector<std::string>;

struct Case {
  int error;
  Lines lines;  // without RSM_MACRO_; "= 0C22 1" is sent as it is
  int refused;  // the first line with an error, counted from 0; the number of lines stands for CLOSE
  int reason;   // of the last refusal, in input 102
  int command;  // input 112
  int line;     // input 113
};

Lines nested(int depth, const std::string& open, const std::string& close) {
  Lines lines;
  for (int i = 0; i < depth; ++i) lines.push_back(open);
  for (int i = 0; i < depth; ++i) lines.push_back(close);
  return lines;
}

/// MP 41 has 16 lines.
const Case kCases[] = {
    {0x01, Lines(17, "SET_VAR VAR1 1"), 16, 0x03, 0x0AD2, 16},
    {0x02, nested(8, "IF 1 < 2", "END_IF"), 7, 0xB3, 0x0AD7, 7},  // the eighth END_IF then has no IF
    {0x03, {"ELSE"}, 0, 0xB2, 0x0AD8, 0},
    {0x04, {"SET_VAR VAR1 1", "END_IF"}, 1, 0xB3, 0x0AD9, 1},
    {0x05, {"SET_VAR VAR1 1", "IF 1 < 2"}, 2, 0xB4, 0x0AD7, 1},
    {0x06, {"= 0CD7 0000 0001 3E3C 0000 0002"}, 0, 0x02, 0x0AD7, 0},
    {0x07, nested(8, "FOR 2", "NEXT"), 7, 0xB7, 0x0AD5, 7},
    {0x08, {"EXIT_FOR"}, 0, 0xB6, 0x0ADE, 0},
    {0x09, {"SET_VAR VAR1 1", "NEXT"}, 1, 0xB7, 0x0AD6, 1},
    {0x0A, {"FOR 2", "SET_VAR VAR1 1"}, 2, 0xB8, 0x0AD5, 0},
    {0x0B, {"LABEL 1", "LABEL 2", "LABEL 1"}, 2, 0xB9, 0x0AE1, 2},
    {0x0C, {"IF 1 < 2", "LABEL 1", "END_IF"}, 1, 0xBA, 0x0AE1, 1},
    {0x0D, {"FOR 2", "LABEL 1", "NEXT"}, 1, 0xBB, 0x0AE1, 1},
    {0x0E, {"LABEL 1", "GOTO 1", "GOTO 0"}, 3, 0xBC, 0x0ADF, 2},
    {0x0F, {"SET_VAR VAR1 1", "= 0C22 0001"}, 1, 0x02, 0x0A22, 1},
    {0x10, {"= 0CD4 7FFF 0001 0025 0000 0002 7FFF 0003"}, 0, 0x02, 0x0AD4, 0},
};

std::string send_line(OneRsm& rsm, const std::string& line) {
  if (!line.starts_with("= ")) return rsm.ask(pdu_of("RSM_MACRO_" + line));
  world::Words words;
  std::istringstream text(line.substr(2));
  for (std::string word; text >> word;)
    words.push_back(static_cast<std::uint16_t>(std::stoi(word, nullptr, 16)));
  return rsm.ask(world::write_request(kWindow, words));
}

const std::string kOld = "MP 41\n  RSM_MACRO_SET_VAR VAR7 77\nEND\n";

TEST(RsM8194hDownloadErrors, AllSixteenAreShownAndTheOldMacroStays) {
  int expected_error = 0;
  for (const Case& one : kCases) {
    SCOPED_TRACE("error " + std::to_string(one.error));
    EXPECT_EQ(one.error, ++expected_error) << "each one is present";
    OneRsm rsm({.program = kOld + "ISR 3\n  RSM_MACRO_EXIT_MACRO\nEND\n"});
    rsm.send("RSM_MP_ISR_CREATE 3");  // its number stays in input 111
    rsm.send("RSM_MACRO_SET_VAR VAR1 1");
    rsm.send("RSM_MACRO_MP_ISR_CLOSE");
    rsm.send("RSM_MP_CREATE 41");
    EXPECT_EQ(rsm.get("RSM_STATE"), 1);
    const auto count = static_cast<int>(one.lines.size());
    for (int i = 0; i < count; ++i) {
      const std::string reply = send_line(rsm, one.lines[static_cast<std::size_t>(i)]);
      if (i > one.refused) continue;  // the lines after it may be refused or not
      EXPECT_EQ(reply.substr(0, 2), i < one.refused ? "10" : "90") << i;
    }
    EXPECT_EQ(rsm.exception("RSM_MACRO_MP_CLOSE"), one.refused == count ? 3 : 0);
    EXPECT_EQ(rsm.get("RSM_STATE"), 0) << "the download has ended either way";
    const std::string shown = rsm.ask("04 00 6E 00 05");
    world::Words words{41, 3, static_cast<std::uint16_t>(one.command), static_cast<std::uint16_t>(one.line),
                       static_cast<std::uint16_t>(one.error)};
    world::Bytes expected{0x04, 10};
    for (const std::uint16_t word : words) {
      expected.push_back(static_cast<std::uint8_t>(word >> 8U));
      expected.push_back(static_cast<std::uint8_t>(word));
    }
    EXPECT_EQ(shown, world::text(expected));
    EXPECT_EQ(rsm.get("IllegalFuncErr"), one.reason);
    EXPECT_EQ(rsm.device().user_program()->program_text().substr(0, kOld.size()), kOld);
    rsm.set("CALL_MP", 41);
    rsm.run(10);
    EXPECT_EQ(rsm.get("VAR7"), 77);
    // The next valid one is stored, and the error is cleared.
    rsm.send({"RSM_MP_CREATE 41", "RSM_MACRO_SET_VAR VAR7 78", "RSM_MACRO_MP_CLOSE"});
    EXPECT_EQ(rsm.ask("04 00 6E 00 05"), "04 0A 00 29 00 03 00 00 00 00 00 00");
    EXPECT_EQ(rsm.get("IllegalFuncErr"), one.reason) << "valid requests do not change the reason";
  }
  EXPECT_EQ(expected_error, 16);
}

TEST(RsM8194hDownloadErrors, EveryLineWantsItsNumberOfRegisters) {
  for (const bool is_isr : {false, true}) {
    for (const lang::CommandRow& row : lang::kCommands) {
      if (row.macro_name.empty()) continue;
      const bool closes = row.macro_name.ends_with("_CLOSE") || row.macro_name.ends_with("_CREATE");
      if (closes) continue;
      OneRsm rsm({.program = kOld});
      rsm.send(is_isr ? "RSM_MP_ISR_CREATE 20" : "RSM_MP_CREATE 157");
      const auto words = static_cast<std::size_t>(row.registers());
      for (const std::size_t count : {words - 1, words + 1}) {
        if (count == 0) continue;
        world::Words request(count, 1);
        request[0] = lang::macro_code(row.verb);
        EXPECT_EQ(rsm.ask(world::write_request(kWindow, request)), "90 03") << row.macro_name << " " << count;
      }
      EXPECT_EQ(rsm.exception(is_isr ? "RSM_MACRO_MP_ISR_CLOSE" : "RSM_MACRO_MP_CLOSE"), 0) << row.macro_name;
      EXPECT_EQ(rsm.get("DOWNLOAD_ERROR"), 0) << "a line that is refused for its registers is omitted";
    }
  }
}

/// The power fails between any two messages of a download: the old macro is present, and nothing is half
/// done.
TEST(RsM8194hDownloadErrors, APowerCutInTheMidstLeavesTheOldMacro) {
  const Lines kNew = {"RSM_MP_CREATE 41", "RSM_MACRO_FOR 3", "RSM_MACRO_SET_VAR VAR7 78", "RSM_MACRO_NEXT",
                      "RSM_MACRO_MP_CLOSE"};
  for (std::size_t cut = 0; cut <= kNew.size(); ++cut) {
    OneRsm rsm({.program = kOld});
    for (std::size_t i = 0; i < cut; ++i) rsm.send(kNew[i]);
    const std::vector<std::byte> saved = rsm.device().save_state();
    rsm.device().switch_power(false);
    rsm.device().switch_power(true);
    const bool is_new = cut == kNew.size();
    EXPECT_EQ(rsm.device().user_program()->program_text() == kOld, !is_new) << cut;
    EXPECT_EQ(rsm.get("RSM_STATE"), 0);
    EXPECT_EQ(rsm.exception("RSM_MACRO_NEXT"), 3) << "no download is in progress";
    // A snapshot of the same moment continues where it was.
    OneRsm twin;
    twin.device().restore_state(saved);
    for (std::size_t i = cut; i < kNew.size(); ++i) twin.send(kNew[i]);
    twin.send("RSM_MP_CALL 41");
    twin.run(20);
    EXPECT_EQ(twin.get("VAR7"), 78);
  }
}

}  // namespace download_errors_test
}  // namespace understudy::emulator::models::rs_m8194h
