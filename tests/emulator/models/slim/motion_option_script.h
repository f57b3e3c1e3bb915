// Dialogues with a chain of three modules at round speeds, with an option that the bench selects. Each
// dialogue also runs without skipped ticks, and on a device that is saved and restored at each line.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "emulator/device/terminals.h"
#include "tests/emulator/device/same_state.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

/// The values FU=1, VM=1, VJ=1, VA=10 and 1000 pulses per revolution give 1000 pulses per second, reached
/// within 0.1 s and 50 pulses. Paths use 100 and 1000.
class MotionScript : public DialogueScript {
 public:
  MotionScript(const std::string& id, const std::string& option)
      : DialogueScript(3, {{id, option}, {"pulses_per_revolution", "1000"}}) {
    for (const std::string prefix : {"", "T1", "T2"}) {
      for (const char* setting : {"FU=1", "VM=1", "VJ=1", "VA=10"}) type(prefix + setting);
    }
  }

  bool output(int number) { return device().terminals()->output(terminal(0, kFirstOutput + number - 1)); }

  /// Returns how long the motion continues from now on.
  Tick finish_ms() {
    const auto busy = [&] {
      const Chain& chain = device().state().chain;
      return chain.busy(0) || chain.busy(1) || chain.busy(2);
    };
    Tick passed = 0;
    for (; busy() && passed < 100'000; ++passed) pass(1);
    return passed - 1;
  }
};

/// Returns the lines up to the next one that does something.
inline std::vector<std::string> steps_of(const std::string& script) {
  std::vector<std::string> steps;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    if (steps.empty() || line.empty() || line[0] != '<') steps.emplace_back();
    steps.back() += line + "\n";
  }
  return steps;
}

struct OptionRow {
  std::string option;
  std::string script;
};

inline void play_all(const std::string& id, const std::vector<OptionRow>& rows) {
  for (const OptionRow& row : rows) {
    SCOPED_TRACE(id + ": " + row.option);
    MotionScript bulk(id, row.option);
    MotionScript single(id, row.option);
    MotionScript restored(id, row.option);
    single.world().set_bulk_ticks(false);
    for (const std::string& step : steps_of(row.script)) {
      bulk.play(step);
      {
        SCOPED_TRACE("tick by tick");
        single.play(step);
      }
      SCOPED_TRACE("restored");
      restored.play(step);
      restored.device().restore_state(restored.device().save_state());
    }
    for (MotionScript* script : {&bulk, &single, &restored}) script->pass(50);
    EXPECT_TRUE(saves_the_same(single.device(), bulk.device()));
    EXPECT_TRUE(saves_the_same(restored.device(), bulk.device()));
  }
}

}  // namespace understudy::emulator::models::slim
