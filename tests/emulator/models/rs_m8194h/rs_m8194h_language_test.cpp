// Macros and triggers as text: checked, loaded, listed, and as the messages of their downloads.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "emulator/device/program_cells.h"
#include "emulator/device/program_error.h"
#include "emulator/device/program_language.h"
#include "emulator/models/rs_m8194h/programs/language.h"
#include "tests/emulator/models/rs_m8194h/one_rsm.h"
#include "tests/interpreter/facts.h"

namespace understudy::emulator::models::rs_m8194h {
namespace rs_m8194h_language_test {

const std::string kMacros =
    "MP 21\n  RSM_MACRO_SET_VAR VAR1 3\n  RSM_MACRO_FOR VAR1\n    RSM_MACRO_IF VAR1 <= 2\n"
    "      RSM_MACRO_FIXED_MOVE XYZU -70000\n    RSM_MACRO_END_IF\n  RSM_MACRO_NEXT\nEND\n\n"
    "ISR 3\n  RSM_MACRO_SYNC_ACTION X YZ 64 0 2 4 0 1 0 3 0 0\nEND\n";
const std::string kTriggers = "TRIGGER 8.0 off_to_on MP21\nTRIGGER 15.15 on hold U\n";

DeviceSettings settings_with(std::map<std::string, std::string> choices = {}) {
  DeviceSettings settings;
  settings.name = "rsm";
  settings.firmware = 300;
  settings.choices = std::move(choices);
  return settings;
}

std::vector<std::string> reported(const std::string& text,
                                  const std::map<std::string, std::string>& choices = {}) {
  std::vector<std::string> texts;
  for (const ProgramMistake& mistake : language().check(text, settings_with(choices))) {
    texts.push_back(in_text(mistake));
  }
  return texts;
}

TEST(RsM8194hLanguage, InstructionsAreThe229Codes) {
  std::set<int> codes;
  for (const InstructionRow& row : language().instructions()) codes.insert(row.opcode.value_or(-1));
  const std::vector<Fact> facts = read_facts(PROJECT_FOLDER "/tests/interpreter/rs_m8194h/commands.csv");
  ASSERT_EQ(language().instructions().size(), facts.size());
  for (const Fact& fact : facts) {
    const int code = std::stoi(fact.at("code"), nullptr, 16);
    ASSERT_TRUE(codes.contains(code)) << fact.at("name");
    for (const InstructionRow& row : language().instructions()) {
      if (row.opcode != code) continue;
      EXPECT_EQ(row.mnemonic, fact.at("name"));
      const bool is_real_time = fact.at("real_time") == "1";
      EXPECT_EQ(row.size, std::stoi(fact.at(is_real_time ? "fifo_blocks" : "macro_lines"))) << row.mnemonic;
      for (const OperandRow& operand : row.operands) EXPECT_FALSE(operand.values.empty()) << row.mnemonic;
    }
  }
}

TEST(RsM8194hLanguage, MessagesHaveAsManyCellsAsTheLongestCommand) {
  std::size_t longest = 0;
  std::size_t shortest = 100;
  for (const Fact& fact : read_facts(PROJECT_FOLDER "/tests/interpreter/rs_m8194h/commands.csv")) {
    const auto count = static_cast<std::size_t>(std::stoi(fact.at("registers")));
    longest = std::max(longest, count);
    shortest = std::min(shortest, count);
  }
  const CellForm form = language().cells()->cell_form();
  EXPECT_EQ(static_cast<std::size_t>(form.max), longest);
  EXPECT_EQ(static_cast<std::size_t>(form.fewest), shortest);
}

TEST(RsM8194hLanguage, LoadingSaysWhatCheckingSays) {
  const std::vector<std::string> kWrong[] = {
      {"MP 1\nRSM_MACRO_NEXT\nRSM_MACRO_SET_V X\nEND\n",
       "line 2, column 1: RSM_MACRO_NEXT: NEXT without a FOR",
       "line 3, column 17: RSM_MACRO_SET_V has 1 parameters; expected axis, data"},
      {"TRIGGER 8.0 on MP0\n",
       "line 1, column 16: 'MP0' does not fit; expected MP1 to MP157, hold, abort_command, abort_macro, "
       "pause or "
       "clear_stop"},
  };
  for (const std::vector<std::string>& one : kWrong) {
    EXPECT_EQ(reported(one[0]), std::vector<std::string>(one.begin() + 1, one.end()));
    OneRsm rsm;
    try {
      rsm.device().user_program()->load_program(one[0]);
      ADD_FAILURE() << one[0];
    } catch (const ProgramError& error) {
      EXPECT_EQ(error.mistakes, language().check(one[0], settings_with()));
    }
    EXPECT_EQ(rsm.device().user_program()->program_text(), "");
  }
}

TEST(RsM8194hLanguage, TextOfADeviceIsWhatItTakes) {
  EXPECT_EQ(reported(kMacros + "\n" + kTriggers), std::vector<std::string>{});
  OneRsm rsm;
  rsm.device().user_program()->load_program(kTriggers + kMacros);
  EXPECT_EQ(rsm.device().user_program()->program_text(), kMacros + "\n" + kTriggers);
}

TEST(RsM8194hLanguage, ChoicesDecideWhatFits) {
  std::string text = "MP 1\n";
  for (int i = 0; i < 8; ++i) text += "RSM_MACRO_SET_VAR VAR1 1\n";
  EXPECT_EQ(reported(text), std::vector<std::string>{});
  EXPECT_EQ(reported(text, {{"close_line", "one_line"}}),
            std::vector<std::string>{
                "line 9, column 1: RSM_MACRO_SET_VAR: more lines than this macro has room for"});
}

TEST(RsM8194hLanguage, ATriggerOfNoneEndsTheOneThatWas) {
  OneRsm rsm;
  rsm.set("FRNET_EVENT", 1);
  rsm.device().user_program()->load_program("MP 5\nRSM_MACRO_SET_VAR VAR1 3\nEND\nTRIGGER 8.0 on MP5");
  rsm.device().user_program()->load_program("TRIGGER 8.0 none");
  EXPECT_EQ(rsm.device().user_program()->program_text(), "MP 5\n  RSM_MACRO_SET_VAR VAR1 3\nEND\n");
  rsm.input(kFirstDi, true);
  rsm.run(20);
  EXPECT_EQ(rsm.get("VAR1"), 0);
  rsm.device().user_program()->load_program("TRIGGER 8.0 on MP5");
  rsm.run(20);
  EXPECT_EQ(rsm.get("VAR1"), 3);
}

TEST(RsM8194hLanguage, MessagesAreThoseThatTheChoicesTake) {
  const std::string text =
      "MP 41\n  RSM_MACRO_IF VAR1 <= 2\n    RSM_MACRO_MIX_2D_CONTINUE 1 1 0 0 5 5\n"
      "    RSM_ABS_MACRO_LINE_3D_CONTINUE 1 1 2 3\n  RSM_MACRO_END_IF\n"
      "  RSM_MACRO_IF VAR1 == 2\n  RSM_MACRO_END_IF\nEND\n";
  struct Case {
    std::map<std::string, std::string> choices;
    std::int64_t less_or_equal, mix, line;
  };
  const Case kCases[] = {
      {{}, 0x3C3D, 0x0C84, 0x0CFC},
      {{{"if_operator", "as_in_the_table"}}, 0x3D3C, 0x0C84, 0x0CFC},
      {{{"if_operator", "as_in_the_frame"}}, 0x3C3D, 0x0C84, 0x0CFC},
      {{{"swapped_codes", "of_12_3"}}, 0x3C3D, 0x0CFD, 0x0C81},
  };
  for (const Case& each : kCases) {
    const DeviceSettings settings = settings_with(each.choices);
    const std::vector<CellRow> rows = language().cells()->assemble(text, settings);
    ASSERT_EQ(rows.size(), 8U);
    EXPECT_EQ(rows[1].cells[3], each.less_or_equal);
    EXPECT_EQ(rows[2].cells[0], each.mix);
    EXPECT_EQ(rows[3].cells[0], each.line);
    EXPECT_EQ(rows[5].cells[3], 0x3D3D);
    EXPECT_EQ(language().cells()->disassemble(rows, settings), text);
    OneRsm rsm({.choices = each.choices});
    for (const CellRow& row : rows) {
      const std::vector<std::uint16_t> words(row.cells.begin(), row.cells.end());
      EXPECT_EQ(rsm.ask(world::write_request(kWindow, words)).substr(0, 2), "10");
    }
    EXPECT_EQ(rsm.device().user_program()->program_text(), text);
  }
}

TEST(RsM8194hLanguage, MessagesMakeTheSameTextAgain) {
  const ProgramCells& cells = *language().cells();
  const std::vector<CellRow> rows = cells.assemble(kMacros, settings_with());
  ASSERT_EQ(rows.size(), 11U);
  EXPECT_EQ(rows.front().cells, (std::vector<std::int64_t>{0x0AC9, 21}));
  EXPECT_EQ(rows[1].cells, (std::vector<std::int64_t>{0x0CD2, 0x7FFF, 1, 0, 3}));
  EXPECT_EQ(rows[4].cells, (std::vector<std::int64_t>{0x0C4E, 15, 0xFFFE, 0xEE90}));
  EXPECT_EQ(rows.back().cells, std::vector<std::int64_t>{0x0CCE});
  EXPECT_EQ(cells.disassemble(rows, settings_with()), kMacros);
  try {
    cells.assemble(kMacros + kTriggers, settings_with());
    ADD_FAILURE() << "triggers are not messages";
  } catch (const ProgramError& error) {
    EXPECT_EQ(in_text(error.first()),
              "line 13, column 1: TRIGGER is not a message to the window; expected only macros");
  }
  try {
    cells.assemble("\xEF\xBB\xBF  TRIGGER 8.0 on MP1\n\n; no more\n", settings_with());
    ADD_FAILURE() << "triggers are not messages";
  } catch (const ProgramError& error) {
    EXPECT_EQ(in_text(error.first()).substr(0, 17), "line 1, column 3:");
  }

  // A host that sends the messages has stored the same macro.
  OneRsm rsm;
  for (const CellRow& row : rows) {
    std::vector<std::uint16_t> words;
    for (const std::int64_t cell : row.cells) words.push_back(static_cast<std::uint16_t>(cell));
    EXPECT_EQ(rsm.ask(world::write_request(kWindow, words)).substr(0, 2), "10");
  }
  EXPECT_EQ(rsm.device().user_program()->program_text(), kMacros);
}

TEST(RsM8194hLanguage, MessagesThatAreNotADownloadAreRefused) {
  const std::pair<std::vector<CellRow>, std::string> kCases[] = {
      {{{{0x0CD6}, 1}}, "line 1: a macro line outside a macro"},
      {{{{0x0A4E, 1, 0, 5}, 3}}, "line 3: RSM_FIXED_MOVE X 5 is not in a macro; expected its CREATE"},
      {{{{0x0AC9, 1}, 1}, {{0x0A4E, 1, 0, 5}, 2}}, "line 2: a real-time command in a macro"},
      {{{{0x0AC9, 1}, 1}, {{0x0C4E, 1}, 2}}, "line 2: too few or too many registers for this command"},
      {{{{0x0AC9, 158}, 1}}, "line 1: a parameter is out of range"},
      {{{{0x0AC9, 1}, 4}}, "line 4: ends inside a macro; expected its CLOSE"},
  };
  for (const auto& [rows, message] : kCases) {
    try {
      language().cells()->disassemble(rows, settings_with());
      ADD_FAILURE() << message;
    } catch (const ProgramError& error) {
      EXPECT_EQ(in_text(error.first()), message);
    }
  }
}

}  // namespace rs_m8194h_language_test
}  // namespace understudy::emulator::models::rs_m8194h
