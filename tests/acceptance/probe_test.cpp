// `understudy probe`: the proofs of choices on a controller. `serve` is the controller, or a box that counts
// what it is asked for.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "tests/acceptance/counting_box.h"
#include "tests/acceptance/running_understudy.h"

namespace understudy::acceptance {
namespace probe_test {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Probe, MeasuresAnOptionByReads) {
  const PrivateFolder folder;
  const auto served = RunningUnderstudy::of_bench(
      "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n"
      "      - { name: hidden, model: simple2-r3, choices: { version_encoding: bcd } }\n");
  const Finished probed =
      understudy({"probe", served->port(), "--model", "simple2-r3", "-o", folder / "evidence.json"});
  EXPECT_EQ(probed.exit_code, 0) << probed.output << probed.errors;
  EXPECT_TRUE(
      has(probed.output, "measured     box.version_encoding: bcd  (the model's default is different)"))
      << probed.output;
  const Finished described = understudy(
      {"describe", "simple2-r3", "choices", "--evidence", folder / "evidence.json", "--format", "csv"});
  EXPECT_TRUE(has(described.output, ",bcd,")) << described.output << described.errors;
}

TEST(Probe, DecidesNothingIfAControllerChangesItsMind) {
  constexpr int kVersion = 2;
  // One read for the option that passes, and two for the one that fails, since a failure is read again.
  constexpr int kReadsOfAllCases = 3;
  const PrivateFolder folder;
  const std::string proofs = folder / "proofs";
  std::filesystem::create_directories(proofs + "/simple2-r3");
  folder.write(
      "proofs/simple2-r3/version.yaml",
      "understudy: 1\nbench:\n  lines: { line: { stations: [ { name: d, model: simple2-r3 } ] } }\n"
      "plays:\n  - choice: { version_encoding: { hundredths: { version: 152 }, bcd: { version: 338 } } }\n"
      "    steps:\n      - expect: { d.Version: \"${version}\" }\n");
  for (const bool changes : {false, true}) {
    const CountingBox box([&](int address, int times) {
      if (address != kVersion) return 0;
      return changes && times >= kReadsOfAllCases ? 338 : 152;
    });
    const Finished probed = understudy({"probe", box.path(), "--model", "simple2-r3", "--proofs", proofs});
    EXPECT_EQ(probed.exit_code, 0) << probed.output << probed.errors;
    EXPECT_TRUE(has(probed.output, changes ? "undecided    box.version_encoding: hundredths or bcd"
                                           : "measured     box.version_encoding: hundredths"))
        << probed.output;
    EXPECT_EQ(box.writes(), 0);
  }
}

std::string served(const std::string& choices) {
  return "understudy: 1\nlines:\n  line:\n    link: port\n    stations:\n      - { name: hidden, model: "
         "simple2-r3, choices: { " +
         choices + " } }\n";
}

/// A folder with one proof.
std::string proofs_with(const PrivateFolder& folder, const std::string& plays) {
  std::filesystem::create_directories((folder / "proofs") + "/simple2-r3");
  folder.write(
      "proofs/simple2-r3/proof.yaml",
      "understudy: 1\nbench:\n  lines: { line: { stations: [ { name: d, model: simple2-r3 } ] } }\nplays:\n" +
          plays);
  return folder / "proofs";
}

const std::string kVersionProof =
    "  - choice: { version_encoding: { hundredths: { version: 152 }, bcd: { version: 338 } } }\n"
    "    steps:\n      - expect: { d.Version: \"${version}\" }\n";

/// Its proof reads Version, too, so with another encoding of it, no case ends as the manual says.
TEST(Probe, ReckonsWithWhatOtherProofsHaveMeasured) {
  const PrivateFolder folder;
  const auto box = RunningUnderstudy::of_bench(served("version_encoding: bcd"));
  const std::string proofs = proofs_with(
      folder, kVersionProof +
                  "  - choice:\n      unmapped_addresses:\n        exception_02: { reply: 01 83 02 +crc }\n"
                  "        zero_and_ignored: { reply: 01 03 08 C001 0098 0000 0000 +crc }\n"
                  "    steps:\n      - send: { bytes: 01 03 00 01 00 04 +crc, reply: \"${reply}\" }\n");
  const Finished probed = understudy({"probe", box->port(), "--model", "simple2-r3", "--proofs", proofs});
  EXPECT_EQ(probed.exit_code, 0) << probed.output << probed.errors;
  EXPECT_TRUE(has(probed.output, "measured     box.version_encoding: bcd")) << probed.output;
  EXPECT_TRUE(has(probed.output, "measured     box.unmapped_addresses: exception_02")) << probed.output;
}

TEST(Probe, SaysWhyAProofIsNotPlayed) {
  const PrivateFolder folder;
  const auto box = RunningUnderstudy::of_bench(served(""));
  const std::string proofs = proofs_with(
      folder,
      kVersionProof +
          "  - choice: { trigger_read_back: { zero: { shown: 0 }, one_while_in_progress: { shown: 1 } } }\n"
          "    bench: { plant: { d.A: { home: { at: 100, width: 20 } } } }\n"
          "    steps:\n      - expect: { d.Aaxis_SVON: \"${shown}\" }\n");
  const Finished probed = understudy(
      {"probe", box->port(), "--model", "simple2-r3", "--proofs", proofs, "-o", folder / "evidence.json"});
  EXPECT_EQ(probed.exit_code, 0) << probed.output << probed.errors;
  EXPECT_TRUE(has(probed.output, "\n  1 not exercised: needs a machine\n")) << probed.output;
  EXPECT_TRUE(has(run({"cat", folder / "evidence.json"}).output, "\"why_not\": \"needs a machine\""));
}

/// The rig knows the controller by the name in the evidence, makes the inputs of the bench, and puts them
/// back.
TEST(Probe, LetsARigMakeTheInputsOfABench) {
  const PrivateFolder folder;
  const auto box = RunningUnderstudy::of_bench(served(""));
  const std::string proofs = proofs_with(
      folder,
      "  - choice: { version_encoding: { hundredths: { version: 152 }, bcd: { version: 338 } } }\n"
      "    bench: { inputs: { d.DIN_10: on } }\n"
      "    steps:\n      - expect: { d.Version: \"${version}\" }\n");
  const std::string rig = folder.write(
      "rig.sh", "echo \"$@\" >> " + (folder / "calls") + "; case $1 in input) exit 0;; *) exit 3;; esac\n");
  const Words words{"probe", box->port(), "--model", "simple2-r3", "--proofs", proofs};
  EXPECT_TRUE(has(understudy(words).output, "1 not exercised: needs a rig or a person"));
  Words with_rig = words;
  with_rig.insert(with_rig.end(), {"--rig", "sh " + rig});
  const Finished probed = understudy(with_rig);
  EXPECT_TRUE(has(probed.output, "measured     box.version_encoding: hundredths"))
      << probed.output << probed.errors;
  const std::string calls = run({"cat", folder / "calls"}).output;
  EXPECT_TRUE(calls.starts_with("factory box\ninput box.DIN_10 on\npower box cycle\ninput box.DIN_10 off\n"))
      << calls;
}

/// A rig that fails is no verdict about the controller.
TEST(Probe, DecidesNothingIfTheRigFails) {
  const PrivateFolder folder;
  const auto box = RunningUnderstudy::of_bench(served(""));
  const Finished probed = understudy({"probe", box->port(), "--model", "simple2-r3", "--proofs",
                                      proofs_with(folder, kVersionProof), "--rig", "exit 1; :"});
  EXPECT_TRUE(has(probed.output, "0 measured, 0 contradicted, 0 undecided, 1 not exercised"))
      << probed.output;
  EXPECT_TRUE(has(probed.output, "not exercised: the rig failed at `factory box`")) << probed.output;
}

TEST(Probe, EndsWhenTheControllerStopsAnswering) {
  const PrivateFolder folder;
  std::atomic<int> asked = 0;
  const CountingBox box(
      [&](int, int) {
        ++asked;
        return 152;
      },
      [&] { return asked > 1; });
  const Finished probed = understudy({"probe", box.path(), "--model", "simple2-r3", "--proofs",
                                      proofs_with(folder, kVersionProof), "--reply-timeout", "20ms"});
  EXPECT_EQ(probed.exit_code, 1) << probed.output;
  EXPECT_TRUE(has(probed.output, "not exercised: the controller stopped answering")) << probed.output;
}

}  // namespace probe_test
}  // namespace understudy::acceptance
