// Entering, listing and sending a program.
#include "interpreter/slim/editor.h"

#include <gtest/gtest.h>

#include "interpreter/slim/parse.h"

namespace understudy::interpreter::slim {
namespace editor_test {

using Lines = std::vector<std::string>;

struct EditRig {
  Error give(std::string_view text) {
    if (is_editing(editor)) return enter_line(editor, program, text);
    const ParseResult result = parse_line(text);
    EXPECT_EQ(result.error, Error::none) << text;
    return begin_edit(editor, program, *result.line.command);
  }
  void give_all(const Lines& lines) {
    for (const std::string& line : lines) EXPECT_EQ(give(line), Error::none) << line;
  }
  Editor editor;
  Program program;
};

TEST(SlimEditor, NewProgramsAndFurtherLines) {
  for (const std::string end : {"", "  ", "EXIT", "exit ", "\x1B", "MA 5\x1B"}) {
    EditRig rig;
    rig.give_all({"PG", " MA 100 ", "$a wt 5", end});
    EXPECT_FALSE(is_editing(rig.editor)) << end;
    EXPECT_EQ(rig.program.texts(), (Lines{"MA 100", "$a wt 5"}));
    rig.give_all({"PA", "DN", end});
    EXPECT_EQ(rig.program.texts(), (Lines{"MA 100", "$a wt 5", "DN"}));
    rig.give_all({"PG", end});
    EXPECT_EQ(rig.program.size(), 0);
  }
}

TEST(SlimEditor, SingleLines) {
  EditRig rig;
  rig.give_all({"PG", "SET P1", "SET P2", "SET P3", ""});
  rig.give_all({"PE 1", "CLR P2"});
  EXPECT_FALSE(is_editing(rig.editor));
  EXPECT_EQ(rig.program.texts(), (Lines{"SET P1", "CLR P2", "SET P3"}));
  rig.give_all({"PI 0", "DN", "PI 4", "RET"});
  EXPECT_EQ(rig.program.texts(), (Lines{"DN", "SET P1", "CLR P2", "SET P3", "RET"}));
  rig.give_all({"PD 0", "PD 3"});
  EXPECT_EQ(rig.program.texts(), (Lines{"SET P1", "CLR P2", "SET P3"}));
  rig.give_all({"PE 0", ""});  // unchanged
  EXPECT_EQ(rig.program.texts(), (Lines{"SET P1", "CLR P2", "SET P3"}));
  EXPECT_EQ(rig.program.listing(), (Lines{"0: SET P1", "1: CLR P2", "2: SET P3"}));
  for (const std::string_view wrong : {"PE 3", "PI 4", "PD 3", "PD 1000"}) {
    EXPECT_EQ(rig.give(wrong), Error::range) << wrong;
    EXPECT_FALSE(is_editing(rig.editor)) << wrong;
  }
}

TEST(SlimEditor, LabelsAreFoundWhereTheyAreAfterChanges) {
  EditRig rig;
  rig.give_all({"PG", "JP $B", "$A SET P1", "$B SET P2", ""});
  const Operand label = parse_line("JP $b").line.command->operands[0];
  EXPECT_EQ(rig.program.find(label), 2);
  rig.give_all({"PI 0", "WT 5"});
  EXPECT_EQ(rig.program.find(label), 3);
  rig.give_all({"PD 3"});
  EXPECT_EQ(rig.program.find(label), std::nullopt);
}

TEST(SlimEditor, WrongLinesAreNotStored) {
  EditRig rig;
  rig.give_all({"PG", "SET P1"});
  EXPECT_EQ(rig.give("SET P5"), Error::range);
  EXPECT_EQ(rig.give("NONSENSE"), Error::syntax);
  EXPECT_EQ(rig.give("?PE"), Error::not_allowed);
  EXPECT_EQ(rig.give("G"), Error::not_allowed);
  EXPECT_EQ(rig.give("PL"), Error::not_allowed);
  EXPECT_EQ(rig.give("END"), Error::syntax);
  rig.give_all({"SET P2", ""});
  EXPECT_EQ(rig.program.texts(), (Lines{"SET P1", "SET P2"}));
  rig.give_all({"PE 0"});
  EXPECT_EQ(rig.give("SET P5"), Error::range);
  EXPECT_TRUE(is_editing(rig.editor));
  EXPECT_EQ(rig.give("PE 1"), Error::not_allowed);
  rig.give_all({"EXIT", "PI 1"});
  EXPECT_EQ(rig.give("SET P5"), Error::range);
  rig.give_all({""});
  EXPECT_FALSE(is_editing(rig.editor));
  EXPECT_EQ(rig.program.texts(), (Lines{"SET P1", "SET P2"}));
}

TEST(SlimEditor, UploadAndDownloadAreInverse) {
  EditRig rig;
  rig.give_all({"PG", "$A SET P1", "OUT \"END\"", "JP $A", ""});
  const Lines sent = rig.program.upload();
  EXPECT_EQ(sent, (Lines{"$A SET P1", "OUT \"END\"", "JP $A", "END"}));

  EditRig other;
  other.give_all({"PG", "DN", "", "DLP"});
  EXPECT_EQ(other.program.size(), 0);
  other.give_all({"", "  "});  // empty lines of a file
  other.give_all(sent);
  EXPECT_FALSE(is_editing(other.editor));
  EXPECT_EQ(other.program, rig.program);
  other.give_all({"DLP", "SET P1", "exit"});
  EXPECT_EQ(other.program.texts(), (Lines{"SET P1"}));
}

TEST(SlimEditor, AThousandLinesFit) {
  EditRig rig;
  rig.give_all({"PG"});
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(rig.give("DN"), Error::none);
  EXPECT_EQ(rig.give("DN"), Error::buffer_full);
  EXPECT_EQ(rig.program.size(), 1000);
  rig.give_all({""});
  EXPECT_EQ(rig.give("PI 0"), Error::buffer_full);
  rig.give_all({"PE 999", "RET"});
  EXPECT_EQ(rig.program.line(999).text, "RET");
}

TEST(SlimEditor, ReportsTheNextLinesNumber) {
  EditRig rig;
  EXPECT_EQ(next_line_number(rig.editor, rig.program), std::nullopt);
  rig.give_all({"PG", "DN"});
  EXPECT_EQ(next_line_number(rig.editor, rig.program), 1);
  rig.give_all({"", "PI 0"});
  EXPECT_EQ(next_line_number(rig.editor, rig.program), 0);
}

TEST(SlimProgram, IsRestoredFromItsTexts) {
  EditRig rig;
  rig.give_all({"PG", "$A SET P1", "JP $A", ""});
  Program restored;
  EXPECT_TRUE(restored.set_texts(rig.program.texts()));
  EXPECT_EQ(restored, rig.program);
  EXPECT_FALSE(restored.set_texts({"DN", "NONSENSE"}));
  EXPECT_FALSE(restored.set_texts(Lines(1001, "DN")));
  EXPECT_EQ(restored, rig.program);
}

}  // namespace editor_test
}  // namespace understudy::interpreter::slim
