#include "emulator/models/slim/transition_tables.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator/device/transition_table.h"
#include "emulator/models/slim/chain/chain.h"
#include "emulator/models/slim/motor/module.h"
#include "emulator/models/slim/rules/pauses.h"
#include "emulator/models/slim/rules/transitions.h"
#include "emulator/models/slim/state.h"
#include "interpreter/slim/error.h"
#include "interpreter/slim/flow.h"

namespace understudy::emulator::models::slim {

namespace {

/// Returns the task of transitions.h that corresponds to a module's activity, or nothing.
std::optional<ActiveTask> task_of(Activity activity) {
  switch (activity) {
    case Activity::move: return ActiveTask::move;
    case Activity::home: return ActiveTask::homing;
    case Activity::jog: return ActiveTask::jog;
    case Activity::thrust: return ActiveTask::thrust;
    case Activity::group: return ActiveTask::line;
    case Activity::idle:
    case Activity::stopping: break;
  }
  return std::nullopt;
}

ActiveTask task_of(const lang::Execution& execution) {
  lang::Hold hold = execution.hold;
  for (const lang::Frame& frame : execution.stack) {
    if (frame.of_event) hold = frame.hold;  // what the event routine has interrupted
  }
  switch (hold) {
    case lang::Hold::number: return ActiveTask::program_waits_for_number;
    case lang::Hold::timer: return ActiveTask::program_waits_for_time;
    case lang::Hold::machine: return ActiveTask::program_waits_for_motion;
    case lang::Hold::nothing:
    case lang::Hold::input:
    case lang::Hold::window: break;
  }
  return ActiveTask::program_runs;
}

/// Returns the names of the errors, in the order of their numbers, from 1.
std::vector<std::string> error_names() {
  std::vector<std::string> names =
      words_of<lang::Error, static_cast<std::size_t>(lang::Error::address) + 1>();
  names.erase(names.begin());  // none
  return names;
}

}  // namespace

void note_tasks(const State& state, Event event) {
  const auto meet = [&](ActiveTask task) {
    state.chain.options().noted.meet(kTaskTable, static_cast<std::size_t>(task),
                                     static_cast<std::size_t>(event));
  };
  for (int module = 0; module < kModules; ++module) {
    if (const auto task = task_of(state.chain.module_at(module).activity)) meet(*task);
  }
  if (state.execution.running) meet(task_of(state.execution));
}

std::span<const TransitionTable> transition_tables() {
  static const std::vector<TransitionTable> tables{
      {.name = "tasks",
       .states = words_of<ActiveTask, kActiveTasks>(),
       .events = {"TAPZ", "TAREDO", "TAUPZ", "TASTOP", "PZ", "REDO"}},
      {.name = "pauses",
       .states = {"no pause", "PZ", "TAPZ", "both pauses"},
       .events = {"PZ", "REDO", "CLR BUF", "TAPZ", "TAREDO", "TAUPZ", "TASTOP", "RESET", "a motion",
                  "a jog"}},
      {.name = "errors", .states = error_names(), .events = {"occurred"}}};
  return tables;
}

}  // namespace understudy::emulator::models::slim
