// Errors in the proof of a choice are found.
#include "tests/emulator/play/performing/choice_check.h"

#include <gtest/gtest.h>

#include "base/files/file_error.h"

namespace understudy::emulator::play {
namespace choice_check_test {

const ChoiceRow kRow{.id = "version_encoding",
                     .section = "",
                     .question = "how Version shows firmware 1.52",
                     .options = "hundredths|bcd",
                     .why = ""};

const std::string kComment =
    "  # How does the register Version show its firmware?\n"
    "  # As 152, a number of hundredths, or in BCD as 0x0152, which is 338 and looks like it.\n";
const std::string kOptions = "{ hundredths: { version: 152 }, bcd: { version: 338 } }";
const std::string kSteps = "      - expect: { d.Version: \"${version}\" }\n";

std::string proof_file(const std::string& options = kOptions, const std::string& steps = kSteps,
                       const std::string& comment = kComment) {
  return "understudy: 1\n"
         "bench: { lines: { rs485: { stations: [ { name: d, model: simple2-r3, address: 1 } ] } } }\n"
         "plays:\n" +
         comment + "  - choice: { version_encoding: " + options + " }\n    steps:\n" + steps;
}

std::string diagnostics_of(const std::string& file) {
  std::string text;
  try {
    const std::vector<Proof> proofs = proofs_in(file, "version_encoding.yaml");
    EXPECT_EQ(proofs.size(), 1U);
    EXPECT_EQ(proofs.at(0).id, "version_encoding");
    for (const std::string& diagnostic : diagnostics_of_proof(kRow, proofs.at(0))) {
      EXPECT_TRUE(diagnostic.starts_with("version_encoding: ")) << diagnostic;
      text += diagnostic + "\n";
    }
  } catch (const FileError& error) {
    text = error.what();
  }
  return text;
}

TEST(ChoiceCheck, HasNothingAgainstAGoodFile) { EXPECT_EQ(diagnostics_of(proof_file()), ""); }

TEST(ChoiceCheck, FindsWhatIsWrong) {
  struct Case {
    std::string file;
    std::string diagnostic;
  };
  const std::string one_case = "{ hundredths: { version: 152 } }";
  const std::string wrong_order = "{ bcd: { version: 338 }, hundredths: { version: 152 } }";
  const std::string twice = "[ bcd, bcd ]";
  const std::string wrong_value = "{ hundredths: { version: 152 }, bcd: { version: 339 } }";
  const std::vector<Case> cases = {
      {proof_file(kOptions, kSteps, "  # It shows the version.\n"), "asks nothing in a comment above it"},
      {proof_file(kOptions, kSteps, "  # How does it show it?\n  # So.\n"), "explains nothing"},
      {proof_file(kOptions, "      - expct: { d.Version: \"${version}\" }\n"), "steps[0].expct: "},
      {proof_file(one_case),
       "the cases choose hundredths; expected each option once, ours first: hundredths, "
       "bcd"},
      {proof_file(wrong_order), "the cases choose bcd, hundredths; expected"},
      {proof_file(twice, "      - advance: 1ms\n"), "makes a second scenario called"},
      {proof_file(wrong_value), "d.Version is 338; expected 339"},
      // The true state is checked, but nothing of it is on the wire.
      {proof_file(kOptions, "      - assert: d.Version == ${version}\n"),
       "what comes out is the same for hundredths and bcd"},
      // Only the host's actions differ.
      {proof_file(kOptions, kSteps + "      - write: { d.Aaxis_Speed: \"${version}\" }\n"),
       "the case of bcd does something else than the first one"},
      {proof_file(kOptions, kSteps + "      - advance: ${version}ms\n"),
       "the case of bcd does something else than the first one"},
      {proof_file(
           kOptions,
           "      - assert: d.Version == ${version}\n      - write: { d.Aaxis_Speed: \"${version}\" }\n"),
       "what comes out by the choice alone is the same for hundredths and bcd"},
  };
  for (const Case& c : cases) {
    const std::string diagnostics = diagnostics_of(c.file);
    EXPECT_NE(diagnostics.find(c.diagnostic), std::string::npos) << c.file << "\n" << diagnostics;
  }
}

TEST(ChoiceCheck, LooksIntoBranchesAndBehindRawReplies) {
  const std::string replies =
      "{ hundredths: { reply: 01 03 02 00 98 +crc }, bcd: { reply: 01 03 02 01 52 +crc } }";
  EXPECT_EQ(diagnostics_of(proof_file(
                replies, "      - send: { bytes: 01 03 00 02 00 01 +crc, reply: \"${reply}\" }\n")),
            "");
  EXPECT_EQ(diagnostics_of(proof_file(
                kOptions, "      - fork: { look: [ { expect: { d.Version: \"${version}\" } } ] }\n")),
            "");
  EXPECT_NE(diagnostics_of(proof_file(kOptions,
                                      "      - fork: { look: [ { expect: { d.Version: \"${version}\" } }, "
                                      "{ advance: \"${version}ms\" } ] }\n"))
                .find("does something else"),
            std::string::npos);
}

}  // namespace choice_check_test
}  // namespace understudy::emulator::play
