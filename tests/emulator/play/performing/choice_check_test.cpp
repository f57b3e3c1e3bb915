// What is wrong with the scenario of a choice is found.
#include "tests/emulator/play/performing/choice_check.h"

#include <gtest/gtest.h>

namespace understudy::emulator::play {
namespace choice_check_test {

const ChoiceRow kRow{.id = "version_encoding",
                     .section = "",
                     .question = "how Version shows firmware 1.52",
                     .options = "hundredths|bcd",
                     .why = ""};

const std::string kComment =
    "# How does the register Version show its firmware?\n"
    "# As 152, a number of hundredths, or in BCD as 0x0152, which is 338 and looks like it.\n";
const std::string kCases = "cases: [ { option: hundredths, version: 152 }, { option: bcd, version: 338 } ]\n";
const std::string kSteps = "  - expect: { d.Version: \"${version}\" }\n";

std::string choice_file(const std::string& cases = kCases, const std::string& steps = kSteps,
                        const std::string& comment = kComment) {
  return comment +
         "understudy: 1\n"
         "name: \"version_encoding: ${option}\"\n"
         "bench: { lines: { rs485: { stations: [ { name: d, model: simple2-r3, address: 1, choices: { "
         "version_encoding: \"${option}\" } } ] } } }\n" +
         cases + "steps:\n" + steps;
}

std::string complaints_of(const std::string& file) {
  std::string text;
  for (const std::string& complaint : complaints_of_choice(kRow, file, "version_encoding.yaml")) {
    text += complaint + "\n";
  }
  return text;
}

TEST(ChoiceCheck, HasNothingAgainstAGoodFile) { EXPECT_EQ(complaints_of(choice_file()), ""); }

TEST(ChoiceCheck, FindsWhatIsWrong) {
  struct Case {
    std::string file;
    std::string complaint;
  };
  const std::string one_case = "cases: [ { option: hundredths, version: 152 } ]\n";
  const std::string wrong_order =
      "cases: [ { option: bcd, version: 338 }, { option: hundredths, version: 152 } ]\n";
  const std::string twice = "cases: [ { option: bcd, version: 338 }, { option: bcd, version: 0x152 } ]\n";
  const std::string wrong_value =
      "cases: [ { option: hundredths, version: 152 }, { option: bcd, version: 339 } ]\n";
  const std::vector<Case> cases = {
      {choice_file(kCases, kSteps, "# It shows the version.\n"), "asks nothing in a comment at its top"},
      {choice_file(kCases, kSteps, "# How does it show it?\n# So.\n"), "explains nothing"},
      {choice_file(kCases, "  - expct: { d.Version: \"${version}\" }\n"), "steps[0].expct: "},
      {choice_file(one_case),
       "the cases choose hundredths; expected each option once, ours first: hundredths, "
       "bcd"},
      {choice_file(wrong_order), "the cases choose bcd, hundredths; expected"},
      {choice_file(twice), "makes a second scenario called"},
      {choice_file(wrong_value), "d.Version is 338; expected 339"},
      // The truth is looked at, but nothing of it is on the wire.
      {choice_file(kCases, "  - assert: d.Version == ${version}\n"),
       "what comes out is the same for hundredths and bcd"},
      // What differs is what the host does.
      {choice_file(kCases, kSteps + "  - write: { d.Aaxis_Speed: \"${version}\" }\n"),
       "the case of bcd does something else than the first one"},
      {choice_file(kCases, kSteps + "  - advance: ${version}ms\n"),
       "the case of bcd does something else than the first one"},
      {choice_file(kCases,
                   "  - assert: d.Version == ${version}\n  - write: { d.Aaxis_Speed: \"${version}\" }\n"),
       "what comes out by the choice alone is the same for hundredths and bcd"},
  };
  for (const Case& c : cases) {
    const std::string complaints = complaints_of(c.file);
    EXPECT_NE(complaints.find(c.complaint), std::string::npos) << c.file << "\n" << complaints;
    EXPECT_TRUE(complaints.starts_with("version_encoding: ")) << complaints;
  }
}

TEST(ChoiceCheck, LooksIntoBranchesAndBehindRawReplies) {
  const std::string replies =
      "cases: [ { option: hundredths, reply: 01 03 02 00 98 +crc }, { option: bcd, reply: 01 03 02 01 52 "
      "+crc } ]\n";
  EXPECT_EQ(complaints_of(
                choice_file(replies, "  - send: { bytes: 01 03 00 02 00 01 +crc, reply: \"${reply}\" }\n")),
            "");
  EXPECT_EQ(complaints_of(
                choice_file(kCases, "  - fork: { look: [ { expect: { d.Version: \"${version}\" } } ] }\n")),
            "");
  EXPECT_NE(complaints_of(choice_file(kCases,
                                      "  - fork: { look: [ { expect: { d.Version: \"${version}\" } }, "
                                      "{ advance: \"${version}ms\" } ] }\n"))
                .find("does something else"),
            std::string::npos);
}

}  // namespace choice_check_test
}  // namespace understudy::emulator::play
