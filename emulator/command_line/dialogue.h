// Takes steps from standard input, one by one, after those of a scenario (`run --on LINE=PORT --dialogue`).
// This lets a program in another language, such as a Python test, work with a real controller.
//
// Each message is one line of JSON, and so is each reply:
//   {"step": {"write": {"box.Aaxis_Speed": 60}}}   a step as in a scenario file
//   {"values": ["box.Cord_A", "box.STATUS.4"]}     expressions
//   {"ok": true, "now_ns": 1200000, "values": {"box.Cord_A": 3200, "box.STATUS.4": 1}}
//   {"ok": false, "kind": "failed", "error": "box.HW_Code is 1; expected 2"}
// `kind` is `failed` (the stop was sent), `skipped` (with its reason, as in a report) or `refused` (the
// message is wrong, and nothing was sent).
#pragma once

#include "emulator/device/model.h"
#include "emulator/play/performing/performance.h"
#include "emulator/play/scenario/scenario.h"

namespace understudy::emulator::command_line {

/// Returns when standard input ends, or at Ctrl-C.
void hold_dialogue(ModelList models, const play::Scenario& scenario, play::Performance& performance);

}  // namespace understudy::emulator::command_line
