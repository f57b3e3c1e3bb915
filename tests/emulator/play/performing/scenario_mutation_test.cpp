// Any text as a scenario file is a scenario or gets one diagnostic. Nothing crashes, and nothing hangs.
#include <gtest/gtest.h>

#include <random>

#include "tests/emulator/play/performing/scenario_folder.h"
#include "tests/emulator/world/bench_file/mutated_text.h"

namespace understudy::emulator::play {
namespace scenario_mutation_test {

const std::string kFull = R"(understudy: 1
name: everything at ${speed}
bench:
  lines: { rs485: { stations: [ { name: feeder, model: simple2-r3, firmware: 1.52 } ] } }
  plant: { feeder.A: { home: { at: 0, width: 200 } } }
nv: { feeder: after.json }
gap: 1ms
seed: 7
parameters: { speed: 200, far: "${speed * 2}" }
cases: [ { speed: 100 }, { speed: 400 } ]
steps:
  - write: { feeder.Aaxis_Speed: "${speed}", 0x1014: 1 }
  - write: { feeder.HW_Code: 1 }
    exception: 2
  - expect: { 'feeder["Cord_A"]': 0 +- 2, feeder.STATUS.4: off }
  - wait: { until: feeder.STATUS.4 == 0, within: 4s, takes: ..3s, poll: 20ms }
  - never: { what: feeder.A.pulses != 0, name: still }
  - end: still
  - assert: [ feeder.A.pulses == 0, time < 3s ]
  - send: { bytes: 01 03 00 01 00 01 +crc, reply: nothing }
  - input: { feeder.AIN_A: 2.5V }
  - inject: { lost_steps: feeder.A, one_in: 50, name: slippery }
  - snapshot: here
  - fork: { a: [ clear: slippery ], b: [ power: { feeder: cycle } ] }
  - restore: here
  - program: { feeder: indexing.lst }
  - repeat: { times: 2, as: i, steps: [ say: "${i} of ${far}" ] }
  - for: { each: [ A, B ], as: axis, steps: [ expect: { "Cord_${axis}": 0 } ] }
  - include: homing.yaml
)";

class ScenarioMutation : public testing::Test {
 protected:
  /// Returns true if it is a scenario or gets a diagnostic that begins with a file and a line.
  bool is_handled(const std::string& text) const {
    try {
      folder_.parse(text);
    } catch (const FileError& error) {
      bool are_lines = !error.diagnostics().empty();
      for (const FileError::Diagnostic& diagnostic : error.diagnostics()) {
        const std::string& what = diagnostic.text;
        are_lines = are_lines && what.find('\n') == std::string::npos;
        EXPECT_TRUE(what.starts_with(folder_.path("")) || what.starts_with("and ")) << what;
      }
      EXPECT_TRUE(are_lines) << error.what();
      return are_lines;
    } catch (const std::exception& other) {
      ADD_FAILURE() << other.what();
      return false;
    }
    return true;
  }

  const world::TryText try_text_ = [this](const std::string& text, const std::string& how) {
    EXPECT_TRUE(is_handled(text)) << how << ":\n" << text;
  };
  ScenarioFolder folder_;
};

TEST_F(ScenarioMutation, TheWholeIsGood) { EXPECT_EQ(folder_.diagnostic(kFull), ""); }

TEST_F(ScenarioMutation, EveryBeginningOfAFileIsHandled) { world::try_every_beginning(kFull, try_text_); }

TEST_F(ScenarioMutation, EveryByteMayBeAnyOther) {
  std::mt19937 random(815);
  world::try_every_byte(kFull, random, 1, try_text_);
}

TEST_F(ScenarioMutation, PiecesMayBeMovedRepeatedAndLost) {
  std::mt19937 random(4242);
  const std::string words[] = {
      "\n",     "  ",   "- ",       ": ",           "{ ",      " }", "[",   "]",       "'",   "\"",
      "&a ",    "*a",   "<<: ",     "? ",           "| \n",    "~",  "${",  "}",       "$${", "${speed}",
      "${1/0}", "1e99", "\xFF\xFE", "times: 99999", "steps: ", "..", "+- ", "feeder.", "0x",  "-1"};
  for (int round = 0; round < 1500; ++round) {
    try_text_(world::with_pieces_moved(kFull, random, words), "round " + std::to_string(round));
  }
}

TEST_F(ScenarioMutation, StepsWithoutEndAreRefused) {
  const auto refuse = [&](const std::string& steps) {
    const std::string text = "understudy: 1\nbench: feeder.yaml\n" + steps;
    EXPECT_TRUE(is_handled(text)) << text.substr(0, 200);
    EXPECT_NE(folder_.diagnostic(text), "") << text.substr(0, 200);
  };
  refuse("steps: &s [ repeat: { times: 100000, steps: *s } ]\n");
  refuse("steps: &s [ { say: x }, { repeat: { times: 100000, steps: *s } } ]\n");
  refuse("steps: &s [ fork: { a: *s, b: *s } ]\n");
  refuse("steps: [ &s { repeat: { times: 2, steps: [ *s, *s ] } } ]\n");
  // 99999 * 99999 * 99999 steps
  refuse(
      "steps: [ repeat: { times: 99999, steps: [ repeat: { times: 99999, steps: [ repeat: { times: 99999, "
      "steps: "
      "[ say: x ] } ] } ] } ]\n");
  std::string bomb = "steps:\n  - fork: { a: &a [ say: x, say: y ] }\n";
  for (char name = 'b'; name < 'z'; ++name) {
    bomb += std::string("  - fork: { a: &") + name + " [ ";
    for (int i = 0; i < 9; ++i) {
      bomb += std::string(i > 0 ? ", " : "") + "{ repeat: { times: 1, steps: *" +
              static_cast<char>(name - 1) + " } }";
    }
    bomb += " ] }\n";
  }
  refuse(bomb);
}

}  // namespace scenario_mutation_test
}  // namespace understudy::emulator::play
