// The effects of each form of SLIM's command list, as one line of steps separated by ";":
//   MA 100            is typed; there must be no reply
//   ?PE -> 100        is typed; this is the reply, or several lines separated by "|"
//   .                 an empty line is typed
//   < DONE            arrives without a request
//   @250              this many milliseconds pass
//   P3 is 1           the level of an output
//   IN3 = 1, off, on  as in dialogue_script.h
//   {name}            several steps, see expanded()
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/device/terminals.h"
#include "tests/emulator/models/slim/dialogue_script.h"

namespace understudy::emulator::models::slim {

struct Effect {
  std::string_view syntax;  // that of the row in kCommands
  std::string_view steps;
  int modules = 4;
};

inline std::vector<std::string> steps_of(std::string_view text) {
  std::vector<std::string> steps;
  while (true) {
    const std::size_t end = text.find(';');
    const std::string_view step = text.substr(0, end);
    const std::size_t first = step.find_first_not_of(' ');
    if (first != std::string_view::npos) steps.emplace_back(step.substr(first));
    if (end == std::string_view::npos) return steps;
    text.remove_prefix(end + 1);
  }
}

/// Returns the steps that a name means; `line` is the text after the name.
inline std::string meaning_of(const std::string& name, const std::string& line) {
  const std::string map = "TX=0; TY=1; TZ=2; TW=3; ";
  const std::string off = "HOFF; T1HOFF; T2HOFF; T3HOFF; @2; ";
  if (name == "map") return map;
  if (name == "runs") return "PG; WI 8; .; G; @2";  // a program that waits forever
  if (name == "full") {                             // all 32 places of T0's buffer, the first one in progress
    std::string steps = "MA 1000000; ";
    for (int i = 0; i < 31; ++i) steps += "CHG P4; ";
    return steps;
  }
  // Conditions in which a motion is refused: a motor without control, a pause.
  const std::string halted = line + " -> ERR 9; {new}; TAPZ; " + line + " -> ERR 6; ";
  if (name == "moves") return "{new}; " + off + halted;
  if (name == "moves_axis") {  // by its letter, even if no module has it
    return "{new}; " + line + " -> ERR 4; {new}; " + map + off + line + " -> ERR 9; {new}; " + map +
           "TAPZ; " + line + " -> ERR 6; ";
  }
  if (name == "moves_path") {  // even while a speed or an acceleration of the path differs
    return meaning_of("moves_axis", line) + "{new}; " + map + "T1PR3=50; " + line + " -> ERR 7; {new}; " +
           map + "T1PR2=50; " + line + " -> ERR 7; ";
  }
  if (name == "queued") return "{new}; {full}; " + line + " -> ERR 8; ";
  if (name == "stored") return "{new}; " + map + line + " -> ERR 3; ";  // cannot be typed
  ADD_FAILURE() << "no steps by the name of " << name;
  return "";
}

/// Replaces the names with their steps, except "{new}", which means a device with factory settings.
inline std::vector<std::string> expanded(std::string_view text) {
  std::vector<std::string> steps;
  for (const std::string& step : steps_of(text)) {
    if (step[0] != '{' || step == "{new}") {
      steps.push_back(step);
      continue;
    }
    const std::string inside = step.substr(1, step.size() - 2);
    const std::size_t blank = inside.find(' ');
    const std::string line = blank == std::string::npos ? "" : inside.substr(blank + 1);
    for (const std::string& meant : expanded(meaning_of(inside.substr(0, blank), line))) {
      steps.push_back(meant);
    }
  }
  return steps;
}

/// Returns the line that a step types, or an empty text if it types none.
inline std::string typed_by(const std::string& step) {
  const bool types = step[0] != '@' && step[0] != '<' && step[0] != '{' && step != "off" && step != "on" &&
                     step.find(" = ") == std::string::npos && step.find(" is ") == std::string::npos;
  if (!types || step == ".") return "";
  return step.substr(0, step.find(" -> "));
}

/// Converts a step to the form of dialogue_script.h.
inline std::string script_of(const std::string& step) {
  if (step[0] == '@') return "@ " + step.substr(1);
  if (step[0] == '<' || step == "off" || step == "on" || step.find(" = ") != std::string::npos) return step;
  if (step == ".") return "> ";
  std::string script = "> " + typed_by(step);
  const std::size_t arrow = step.find(" -> ");
  if (arrow == std::string::npos) return script;
  std::istringstream message(step.substr(arrow + 4));
  for (std::string line; std::getline(message, line, '|');) script += "\n< " + line;
  return script;
}

inline void check_output(DialogueScript& script, const std::string& step) {
  const std::string name = step.substr(0, step.find(' '));
  const auto terminals = model().terminals;
  for (std::size_t i = 0; i < terminals.size(); ++i) {
    if (terminals[i].name != name) continue;
    EXPECT_EQ(script.device().terminals()->output(static_cast<int>(i)), step.back() == '1') << step;
    return;
  }
  ADD_FAILURE() << "no output " << name;
}

/// Runs all steps, on new devices.
inline void play_effect(const Effect& effect) {
  SCOPED_TRACE(std::string(effect.syntax));
  auto script = std::make_unique<DialogueScript>(effect.modules);
  std::string pending;
  const auto play = [&] {
    SCOPED_TRACE("of the script\n" + pending);
    script->play(pending);
    pending.clear();
  };
  for (const std::string& step : expanded(effect.steps)) {
    if (step == "{new}") {
      play();
      script = std::make_unique<DialogueScript>(effect.modules);
    } else if (step.find(" is ") != std::string::npos) {
      play();
      check_output(*script, step);
    } else {
      pending += script_of(step) + "\n";
    }
  }
  play();
}

}  // namespace understudy::emulator::models::slim
